// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   A silent LAMMPS that knows the styles of this package, filled with the
   particles of a scene, and the questions that tests ask it. Everything
   works on any number of ranks, and answers are the same on all of them.
------------------------------------------------------------------------- */

#ifndef LMP_ALEISPH_TEST_SIMULATION_H
#define LMP_ALEISPH_TEST_SIMULATION_H

#include "lammps.h"
#include "scene.h"

#include <memory>
#include <string>
#include <vector>

class Simulation {
 public:
  Simulation();
  // with the box, the particles, their masses, and the groups fluid and wall
  explicit Simulation(const Scene &scene);
  // on these ranks; MPI_COMM_SELF: every rank has a simulation of its own
  Simulation(const Scene &scene, MPI_Comm comm);
  ~Simulation();

  // the lines of an input script
  void run(const std::string &script);
  // the same for a script that is wrong: what LAMMPS says about it, "" if it says nothing
  std::string error_of(const std::string &script);
  // what has been logged so far
  std::string log() const;

  double fix(const std::string &id, int n) const;       // f_ID[n]
  double variable(const std::string &formula) const;    // of an equal-style variable

  // one value per particle, at index ID - 1
  std::vector<double> x(int a) const;
  std::vector<double> v(int a) const;
  std::vector<double> pressure() const;
  std::vector<double> compute(const std::string &id, int column) const;    // c_ID[column]
  std::vector<double> type() const;
  // same order; f(x, y, z) of the present positions
  template <class Function> std::vector<double> at_particles(Function f) const
  {
    const auto px = x(0), py = x(1), pz = x(2);
    std::vector<double> values(px.size());
    for (std::size_t i = 0; i < px.size(); i++) values[i] = f(px[i], py[i], pz[i]);
    return values;
  }

  // component a of a vector field of the atom with this ID, on the rank that has it
  void set(double **field, int id, int a, double value);

  LAMMPS_NS::LAMMPS &lammps() const { return *lammps_; }
  int ranks() const;

 private:
  explicit Simulation(MPI_Comm comm);
  void create(const Scene &scene);
  template <class Value> std::vector<double> by_id(Value value) const;

  std::string logfile_;
  std::unique_ptr<LAMMPS_NS::LAMMPS> lammps_;
};

// a name in the scratch directory of this process, which all ranks share and nobody else has
std::string scratch_file(const std::string &name);
std::string read_text(const std::string &path);
void write_text(const std::string &path, const std::string &text);

// every particle counts once; largest: max |a_i - b_i|
double largest(const std::vector<double> &a);
double largest(const std::vector<double> &a, const std::vector<double> &b);
// sqrt(sum (a_i - b_i)^2/sum b_i^2)
double relative_l2(const std::vector<double> &a, const std::vector<double> &b);
double mean(const std::vector<double> &a);
std::vector<double> without_mean(std::vector<double> a);

#endif
