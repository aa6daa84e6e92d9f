// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   The roles that occur among the neighbours of each row, in a table made in one
   pass over the stencil. By it rows in the bulk, which are most of them, skip
   the work for walls and surfaces without a loop over their pairs.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_SEEN_H
#define LMP_ALEISPH_SEEN_H

#include "aleisph_roles.h"
#include "aleisph_stencil.h"

#include <vector>

namespace aleisph {

class SeenRoles {
 public:
  // table: as from make_table() with the present roles; null: rows are searched when asked for
  SeenRoles(const Stencil &s, const Role *role, const Role *table = nullptr) :
      s_(s), role_(role), table_(table)
  {
  }

  // whether a neighbour of owned particle i has one of these roles
  bool any(int i, Role wanted) const { return ((table_ ? table_[i] : of(i)) & wanted) != 0; }

  // the roles of all neighbours of each owned particle
  void make_table(std::vector<Role> &table) const
  {
    table.resize(s_.rows());
    for_rows(s_.rows(), [&](int i) { table[i] = of(i); });
  }

 private:
  Role of(int i) const
  {
    Role seen = 0;
    for (int k = s_.begin(i); k < s_.end(i); k++) seen |= role_[s_.col()[k]];
    return seen;
  }

  const Stencil &s_;
  const Role *role_, *table_;
};

}    // namespace aleisph
#endif
