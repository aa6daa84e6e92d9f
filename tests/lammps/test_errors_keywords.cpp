// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Keywords and values that are wrong by themselves: the error comes from
   the command, before any run.
------------------------------------------------------------------------- */

#include "errors.h"

using Lines = std::vector<std::pair<std::string, Words>>;

// LAMMPS takes no such number from a script; it then quotes the command
static Words not_a_number(const std::string &command, const std::string &value)
{
  return {"floating point", "'" + value + "'", "Last input line: " + command};
}

// each line after the fixes that `before` has
static void expect_line_errors(const std::string &before, const Lines &lines)
{
  for (const auto &item : lines) {
    SCOPED_TRACE(item.first);
    Simulation sim(small_channel());
    sim.run(before);
    expect_words(sim.error_of(item.first), item.second);
  }
}

TEST(KeywordErrors, SmallScriptIsRight)
{
  Simulation sim(small_channel());
  EXPECT_EQ(sim.error_of(small_script().text() + "run 1"), "");
}

TEST(KeywordErrors, Owner)
{
  const std::string start = "fix sph all aleisph ";
  expect_line_errors(
      "",
      {
          {start + "rho0 1.0", {"ix aleisph", "spacing", "required"}},
          {start + "spacing 0.2", {"ix aleisph", "rho0 or fluid", "required"}},
          {start + "spacing", {"ix aleisph", "spacing"}},
          {start + "spacing 0.2 rho0", {"ix aleisph", "rho0"}},
          {start + "spacing 0.2 rho0 1.0 kernel", {"ix aleisph", "kernel"}},
          {start + "spacing 0.2 rho0 1.0 h/d", {"ix aleisph", "h/d"}},
          {start + "spacing 0.2 rho0 1.0 fluid", {"ix aleisph", "fluid"}},
          {start + "spacing 0.0 rho0 1.0", {"ix aleisph", "spacing", "positive", "0.0"}},
          {start + "spacing -0.2 rho0 1.0", {"ix aleisph", "spacing", "positive", "-0.2"}},
          {start + "spacing nan rho0 1.0", not_a_number(start, "nan")},
          {start + "spacing inf rho0 1.0", not_a_number(start, "inf")},
          {start + "spacing abc rho0 1.0", not_a_number(start, "abc")},
          {start + "spacing 0.2 rho0 0", {"ix aleisph", "rho0", "positive", "not 0"}},
          {start + "spacing 0.2 rho0 -1", {"ix aleisph", "rho0", "positive", "-1"}},
          {start + "spacing 0.2 rho0 nan", not_a_number(start, "nan")},
          {start + "spacing 0.2 rho0 1.0 h/d 0", {"ix aleisph", "h/d", "0.8 and 3", "not 0"}},
          {start + "spacing 0.2 rho0 1.0 h/d -1.2", {"ix aleisph", "h/d", "-1.2"}},
          {start + "spacing 0.2 rho0 1.0 h/d nan", not_a_number(start, "nan")},
          {start + "spacing 0.2 rho0 1.0 kernel gauss",
           {"ix aleisph", "unknown kernel gauss", "cubic-spline", "wendland-c4"}},
          {start + "spacing 0.2 rho0 1.0 colour red", {"ix aleisph", "unknown keyword colour"}},
      });
}

TEST(KeywordErrors, Wall)
{
  const std::string start = "fix wall wall aleisph/wall ";
  expect_line_errors(
      small_script().owner,
      {
          {start + "condition", {"ix aleisph/wall", "condition"}},
          {start + "condition sticky", {"ix aleisph/wall", "slip or no-slip", "sticky"}},
          {start + "velocity 1 0", {"ix aleisph/wall", "velocity"}},
          {start + "velocity 1 0 abc", not_a_number(start, "abc")},
          {start + "velocity nan 0 0", not_a_number(start, "nan")},
          {start + "normals", {"ix aleisph/wall", "normals"}},
          {start + "normals given", {"ix aleisph/wall", "normals"}},
          {start + "normals guessed", {"ix aleisph/wall", "auto or given", "guessed"}},
          {start + "vstar", {"ix aleisph/wall", "vstar"}},
          {start + "vstar best", {"ix aleisph/wall", "default or curlcurl", "best"}},
          {start + "colour red", {"ix aleisph/wall", "unknown keyword colour"}},
      });
}

TEST(KeywordErrors, Pressure)
{
  const std::string start = "fix out fluid aleisph/pressure";
  expect_line_errors(
      small_script().owner,
      {
          {start, {"ix aleisph/pressure"}},
          {start + " abc", not_a_number(start, "abc")},
          {start + " nan", not_a_number(start, "nan")},
          {start + " 1.0 colour red", {"ix aleisph/pressure", "unknown keyword colour"}},
          {start + " 1.0 buffer", {"ix aleisph/pressure", "buffer"}},
          {start + " 1.0 buffer fluid 1 0", {"ix aleisph/pressure", "buffer"}},
          {start + " 1.0 buffer nobody 1 0 0", {"ix aleisph/pressure", "group nobody"}},
          {start + " 1.0 buffer fluid 0 0 0", {"ix aleisph/pressure", "direction", "zero"}},
          {start + " 1.0 buffer fluid nan 0 0", not_a_number(start, "nan")},
      });
}

TEST(KeywordErrors, Predictor)
{
  const std::string start = "fix pred fluid aleisph/predictor ";
  expect_line_errors(
      small_script().owner,
      {
          {start + "frame", {"ix aleisph/predictor", "frame"}},
          {start + "frame rotating",
           {"ix aleisph/predictor", "lagrangian, eulerian or ale", "rotating"}},
          {start + "nu", {"ix aleisph/predictor", "nu"}},
          {start + "nu -1", {"ix aleisph/predictor", "nu", "negative", "-1"}},
          {start + "nu nan", not_a_number(start, "nan")},
          {start + "nu inf", not_a_number(start, "inf")},
          {start + "mu -1", {"ix aleisph/predictor", "mu", "negative", "-1"}},
          {start + "mu nan", not_a_number(start, "nan")},
          {start + "scheme", {"ix aleisph/predictor", "scheme"}},
          {start + "scheme leapfrog", {"ix aleisph/predictor", "explicit, be or cn", "leapfrog"}},
          {start + "integrator", {"ix aleisph/predictor", "integrator"}},
          {start + "integrator rk4", {"ix aleisph/predictor", "euler or ab2", "rk4"}},
          {start + "tol", {"ix aleisph/predictor", "tol"}},
          {start + "tol 0", {"ix aleisph/predictor", "tol", "between 0 and 1", "not 0"}},
          {start + "tol 1", {"ix aleisph/predictor", "tol", "between 0 and 1", "not 1"}},
          {start + "tol nan", not_a_number(start, "nan")},
          {start + "preconditioner", {"ix aleisph/predictor", "preconditioner"}},
          {start + "preconditioner magic",
           {"ix aleisph/predictor", "unknown preconditioner magic", "auto", "jacobi", "ilu0"}},
          {start + "frame ale transport 1 0", {"ix aleisph/predictor", "transport"}},
          {start + "transport 1 0 0", {"ix aleisph/predictor", "transport needs frame ale"}},
          {start + "frame eulerian transport 1 0 0",
           {"ix aleisph/predictor", "transport needs frame ale"}},
          {start + "colour red", {"ix aleisph/predictor", "unknown keyword colour"}},
      });
}

TEST(KeywordErrors, Ppe)
{
  const std::string start = "fix ppe all aleisph/ppe ";
  expect_line_errors(
      small_script().owner,
      {
          {start + "tol", {"ix aleisph/ppe", "tol"}},
          {start + "tol 0", {"ix aleisph/ppe", "tol", "between 0 and 1", "not 0"}},
          {start + "tol -1e-8", {"ix aleisph/ppe", "tol", "-1e-8"}},
          {start + "tol 2", {"ix aleisph/ppe", "tol", "not 2"}},
          {start + "tol nan", not_a_number(start, "nan")},
          {start + "divergence", {"ix aleisph/ppe", "divergence"}},
          {start + "divergence 0", {"ix aleisph/ppe", "divergence", "between 0 and 1", "not 0"}},
          {start + "divergence -1e-5", {"ix aleisph/ppe", "divergence", "-1e-5"}},
          {start + "divergence 1", {"ix aleisph/ppe", "divergence", "not 1"}},
          {start + "divergence nan", not_a_number(start, "nan")},
          {start + "divergence 1e-4 tol 1e-8",
           {"ix aleisph/ppe", "tol 1e-8", "divergence 1e-4", "exclude each other"}},
          {start + "maxiter", {"ix aleisph/ppe", "maxiter"}},
          {start + "maxiter 0", {"ix aleisph/ppe", "maxiter", "at least 1", "not 0"}},
          {start + "maxiter 1.5", {"1.5"}},
          {start + "preconditioner", {"ix aleisph/ppe", "preconditioner"}},
          {start + "preconditioner magic",
           {"ix aleisph/ppe", "unknown preconditioner magic", "auto", "jacobi", "ilu0", "amg"}},
          {start + "reuse", {"ix aleisph/ppe", "reuse"}},
          {start + "reuse often", {"often"}},
          {start + "failure", {"ix aleisph/ppe", "failure"}},
          {start + "failure ignore", {"ix aleisph/ppe", "error or warn", "ignore"}},
          {start + "colour red", {"ix aleisph/ppe", "unknown keyword colour"}},
      });
}

TEST(KeywordErrors, Computes)
{
  expect_line_errors(
      "",
      {
          {"compute c all aleisph/atom", {"ompute aleisph/atom"}},
          {"compute c all aleisph/atom p colour",
           {"ompute aleisph/atom", "unknown field colour", "lambda", "nneigh"}},
          {"compute c all aleisph/exact", {"ompute aleisph/exact"}},
          {"compute c all aleisph/exact cube 1",
           {"ompute aleisph/exact", "unknown case cube", "taylor-green"}},
          {"compute c all aleisph/exact plane 1 1", {"ompute aleisph/exact plane"}},
          {"compute c all aleisph/exact plane 1 nan 1",
           not_a_number("compute c all aleisph/exact", "nan")},
          {"compute c all aleisph/exact plane 1 1 1 early",
           {"ompute aleisph/exact", "unknown keyword early"}},
          {"compute c all aleisph/exact taylor-green 1 1 1 1 steady",
           {"ompute aleisph/exact", "taylor-green", "no steady state"}},
          // sizes and viscosities that have no meaning must not end in nan or zero columns
          {"compute c all aleisph/exact plane 0 1 1", {"ompute aleisph/exact", "positive"}},
          {"compute c all aleisph/exact plane -1 1 1", {"ompute aleisph/exact", "positive"}},
          {"compute c all aleisph/exact pipe 1 1 0", {"ompute aleisph/exact", "positive"}},
          {"compute c all aleisph/exact stokes 0 1 1 1 1", {"ompute aleisph/exact", "positive"}},
      });
}
