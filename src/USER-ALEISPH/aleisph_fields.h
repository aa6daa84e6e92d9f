// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   A per-particle field that knows whether its ghosts are valid now. Who holds
   the data makes a Field of it where it is needed, as arrays move when
   particles come and go; a Field is a few words and passed by value.

     owned()   to read owned entries
     edit()    to change owned entries: the ghosts are no longer valid
     all()     to read ghosts, too: they must be valid, which debug builds check
   Ranks::forward() makes them valid.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_FIELDS_H
#define LMP_ALEISPH_FIELDS_H

#include <cassert>

namespace aleisph {

class Field {
 public:
  // data: `width` doubles per particle, owned ones first, then ghosts; both live longer than this
  Field(double *data, int width, bool &ghosts_valid) :
      data_(data), width_(width), ghosts_valid_(&ghosts_valid)
  {
  }

  int width() const { return width_; }
  bool ghosts_valid() const { return *ghosts_valid_; }

  const double *owned() const { return data_; }
  double *edit() const
  {
    *ghosts_valid_ = false;
    return data_;
  }
  const double *all() const
  {
    assert(*ghosts_valid_);
    return data_;
  }

  // for Ranks::forward(), which fills the ghosts
  double *exchanged() const
  {
    *ghosts_valid_ = true;
    return data_;
  }

 private:
  double *data_;
  int width_;
  bool *ghosts_valid_;
};

}    // namespace aleisph
#endif
