/* -*- c++ -*- ----------------------------------------------------------
   LAMMPS - Large-scale Atomic/Molecular Massively Parallel Simulator
   USER-ALEISPH package
   SPDX-License-Identifier: GPL-2.0-only

   Prescribed pressure on a group (inlet, outlet). The particles beyond the
   boundary plane may be a buffer, three layers deep, that copies the
   velocity of its neighbor towards the fluid: zero normal gradient. Without
   it the Laplacian at the boundary would be one-sided, which is unstable.
------------------------------------------------------------------------- */

#ifdef FIX_CLASS
// clang-format off
FixStyle(aleisph/pressure,FixAleisphPressure);
// clang-format on
#else

#ifndef LMP_FIX_ALEISPH_PRESSURE_H
#define LMP_FIX_ALEISPH_PRESSURE_H

#include "aleisph_scene.h"
#include "fix.h"

#include <memory>
#include <vector>

namespace LAMMPS_NS {

class AleisphVariable;

class FixAleisphPressure : public Fix, public aleisph::VelocityCondition {
 public:
  FixAleisphPressure(class LAMMPS *, int, char **);
  ~FixAleisphPressure() override;
  int setmask() override;
  void init() override;
  void setup_pre_force(int) override;
  void pre_force(int) override;

  void impose(const aleisph::Field &v) override;
  int source(int i) const override;

 private:
  void add_claims() const;
  void set_pressure();
  void find_sources();
  int nearest_source(int i) const;
  void find_depth();

  std::unique_ptr<AleisphVariable> value_;
  int buffer_group_, buffer_bit_;    // index and bit of the buffer's group; -1, 0 if there is none
  double towards_[3];                // unit vector from the buffer to the fluid
  class FixAleisph *owner_;
  long version_;                        // of the positions that the sources belong to
  std::vector<int> buffer_, source_;    // owned buffer particles and what they copy
  std::vector<int> slot_;               // per owned particle: index into buffer_, or -1
  int depth_;                           // layers of the buffer, the largest over all ranks
};

}    // namespace LAMMPS_NS

#endif
#endif
