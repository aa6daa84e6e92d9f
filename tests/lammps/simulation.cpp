// SPDX-License-Identifier: GPL-2.0-only

#include "simulation.h"

#include "aleisph_each_style.h"
#include "atom.h"
#include "compute.h"
#include "domain.h"
#include "exceptions.h"
#include "fix.h"
#include "input.h"
#include "library.h"
#include "modify.h"
#include "variable.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>
#include <stdexcept>

using namespace LAMMPS_NS;

namespace {

std::string scratch;    // directory

// MPI and the scratch directory live as long as the tests of this process
class Surroundings : public ::testing::Environment {
 public:
  void SetUp() override
  {
    MPI_Init(nullptr, nullptr);
    char path[4096] = "";
    int rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == 0) {
      const std::string pattern = ::testing::TempDir() + "aleisph_test_XXXXXX";
      std::snprintf(path, sizeof(path), "%s", pattern.c_str());
      if (!mkdtemp(path)) throw std::runtime_error("cannot make " + pattern);
    }
    MPI_Bcast(path, sizeof(path), MPI_CHAR, 0, MPI_COMM_WORLD);
    scratch = path;
  }

  void TearDown() override
  {
    int rank;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Barrier(MPI_COMM_WORLD);
    std::error_code ignored;
    if (rank == 0) std::filesystem::remove_all(scratch, ignored);
    MPI_Finalize();
  }
};

[[maybe_unused]] const auto *const surroundings = ::testing::AddGlobalTestEnvironment(
    new Surroundings);

// a new name each time, so that no two simulations write to the same file
std::string next_logfile(MPI_Comm comm)
{
  static int count = 0;
  const std::string name = "log." + std::to_string(count++);
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return scratch_file(comm == MPI_COMM_SELF ? fmt::format("{}.{}", name, rank) : name);
}

std::unique_ptr<LAMMPS> start(const std::string &logfile, MPI_Comm comm)
{
  LAMMPS::argv args = {"lammps", "-screen", "none", "-nocite", "-log", logfile};
  auto lammps = std::make_unique<LAMMPS>(args, comm);
  Modify &modify = *lammps->modify;
  aleisph::each_style(
      [&](const char *name, Modify::FixCreator creator) { (*modify.fix_map)[name] = creator; },
      [&](const char *name, Modify::ComputeCreator creator) {
        (*modify.compute_map)[name] = creator;
      });
  return lammps;
}

}    // namespace

/* ---------------------------------------------------------------------- */

Simulation::Simulation(MPI_Comm comm) : logfile_(next_logfile(comm)), lammps_(start(logfile_, comm))
{
}

Simulation::Simulation() : Simulation(MPI_COMM_WORLD)
{
}

Simulation::Simulation(const Scene &scene) : Simulation(scene, MPI_COMM_WORLD)
{
}

Simulation::Simulation(const Scene &scene, MPI_Comm comm) : Simulation(comm)
{
  create(scene);
}

Simulation::~Simulation() = default;

int Simulation::ranks() const
{
  int n;
  MPI_Comm_size(lammps_->world, &n);
  return n;
}

void Simulation::create(const Scene &scene)
{
  const auto &low = scene.low, &high = scene.high;
  run(fmt::format("units {}\ndimension {}\nboundary {}\natom_style atomic\n"
                  "region box block {} {} {} {} {} {} units box\ncreate_box 4 box",
                  scene.units, scene.dimension, scene.boundary, low[0], high[0], low[1], high[1],
                  low[2], high[2]));
  std::vector<double> x;
  for (const auto &position : scene.x) x.insert(x.end(), position.begin(), position.end());
  std::vector<tagint> id(scene.x.size());
  std::iota(id.begin(), id.end(), 1);
  const int n = static_cast<int>(id.size());
  const int created = lammps_create_atoms(lammps_.get(), n, id.data(), scene.type.data(), x.data(),
                                          nullptr, nullptr, 0);
  if (created != n) throw std::runtime_error("scene: particles outside of the box");
  run(fmt::format("mass * {}\n"
                  "neighbor {} bin\nneigh_modify every 1 delay 0 check yes\n"
                  "group wall type 2\ngroup fluid subtract all wall\n"
                  "group inlet type 3 4\ngroup buffer type 4",
                  scene.rho0 * std::pow(scene.d, scene.dimension), 0.3 * scene.d));
}

void Simulation::run(const std::string &script)
{
  std::istringstream lines(script);
  for (std::string line; std::getline(lines, line);) lammps_->input->one(line);
}

std::string Simulation::error_of(const std::string &script)
{
  try {
    run(script);
  } catch (const LAMMPSException &error) {
    return error.what();
  }
  return "";
}

std::string Simulation::log() const
{
  if (lammps_->logfile) std::fflush(lammps_->logfile);
  MPI_Barrier(lammps_->world);
  return read_text(logfile_);
}

double Simulation::fix(const std::string &id, int n) const
{
  Fix *fix = lammps_->modify->get_fix_by_id(id);
  if (!fix) throw std::runtime_error("no fix " + id);
  return fix->compute_vector(n - 1);
}

double Simulation::variable(const std::string &formula) const
{
  return lammps_->input->variable->compute_equal(formula);
}

template <class Value> std::vector<double> Simulation::by_id(Value value) const
{
  const Atom &atom = *lammps_->atom;
  std::vector<double> values(atom.natoms, 0.0);
  for (int i = 0; i < atom.nlocal; i++) values.at(atom.tag[i] - 1) = value(i);
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM,
                lammps_->world);
  return values;
}

std::vector<double> Simulation::x(int a) const
{
  return by_id([&](int i) { return lammps_->atom->x[i][a]; });
}

std::vector<double> Simulation::v(int a) const
{
  return by_id([&](int i) { return lammps_->atom->v[i][a]; });
}

std::vector<double> Simulation::type() const
{
  return by_id([&](int i) { return static_cast<double>(lammps_->atom->type[i]); });
}

std::vector<double> Simulation::pressure() const
{
  int is_double, columns;
  const int index = lammps_->atom->find_custom("aleisph_p", is_double, columns);
  if (index < 0) throw std::runtime_error("no pressure");
  return by_id([&](int i) { return lammps_->atom->dvector[index][i]; });
}

std::vector<double> Simulation::compute(const std::string &id, int column) const
{
  Compute *compute = lammps_->modify->get_compute_by_id(id);
  if (!compute) throw std::runtime_error("no compute " + id);
  compute->compute_peratom();
  return by_id([&](int i) {
    return compute->size_peratom_cols ? compute->array_atom[i][column - 1]
                                      : compute->vector_atom[i];
  });
}

void Simulation::set(double **field, int id, int a, double value)
{
  const Atom &atom = *lammps_->atom;
  for (int i = 0; i < atom.nlocal; i++)
    if (atom.tag[i] == id) field[i][a] = value;
}

/* ---------------------------------------------------------------------- */

std::string scratch_file(const std::string &name)
{
  return scratch + "/" + name;
}

std::string read_text(const std::string &path)
{
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_text(const std::string &path, const std::string &text)
{
  int rank;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  if (rank == 0) std::ofstream(path) << text;
  MPI_Barrier(MPI_COMM_WORLD);
}

double largest(const std::vector<double> &a)
{
  return largest(a, std::vector<double>(a.size(), 0.0));
}

double largest(const std::vector<double> &a, const std::vector<double> &b)
{
  double worst = 0.0;
  for (std::size_t i = 0; i < a.size(); i++) {
    const double difference = std::fabs(a[i] - b.at(i));
    if (!(difference <= worst)) worst = difference;    // a NaN stays
    if (std::isnan(worst)) break;
  }
  return worst;
}

double relative_l2(const std::vector<double> &a, const std::vector<double> &b)
{
  double error = 0.0, norm = 0.0;
  for (std::size_t i = 0; i < a.size(); i++) {
    error += (a[i] - b.at(i)) * (a[i] - b[i]);
    norm += b[i] * b[i];
  }
  return std::sqrt(error / norm);
}

double mean(const std::vector<double> &a)
{
  double sum = 0.0;
  for (const double value : a) sum += value;
  return sum / static_cast<double>(a.size());
}

std::vector<double> without_mean(std::vector<double> a)
{
  const double shift = mean(a);
  for (double &value : a) value -= shift;
  return a;
}
