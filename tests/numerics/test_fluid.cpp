// SPDX-License-Identifier: GPL-2.0-only
// Fluid property files: what is read, and what is said about a bad one.

#include "aleisph_fluid.h"

#include <gtest/gtest.h>
#include <sstream>

namespace {

using namespace aleisph;

std::string read(const std::string &text, FluidProperties &fluid)
{
  std::istringstream in(text);
  return read_fluid(in, fluid);
}

TEST(Fluid, ReadsPropertiesInAnyOrderAndIgnoresComments)
{
  FluidProperties fluid;
  EXPECT_EQ(read("# DATE: 2026-11-22 UNITS: si\n\nnu 1.0e-6   # kinematic\n  rho0 998.2\n", fluid),
            "");
  EXPECT_EQ(fluid.rho0, 998.2);
  EXPECT_EQ(fluid.nu, 1.0e-6);
  EXPECT_EQ(fluid.sigma, 0.0);
}

TEST(Fluid, NamesLineAndReason)
{
  const struct {
    const char *text, *expected;
  } cases[] = {
      {"rho0 1000\nmu 1e-3\n", "line 2: unknown property 'mu'"},
      {"rho0\n", "line 1: no value after 'rho0'"},
      {"rho0 1000\nrho0 900\n", "line 2: 'rho0' given twice"},
      {"rho0 1000 kg/m3\n", "line 1: unexpected 'kg/m3'"},
      {"rho0 12x\n", "line 1: '12x' is not a non-negative number"},
      {"rho0 nan\n", "line 1: 'nan' is not a non-negative number"},
      {"rho0 1000\nnu -1\n", "line 2: '-1' is not a non-negative number"},
      {"rho0 0\n", "no 'rho0' line with a positive density"},
      {"# nothing\n", "no 'rho0' line with a positive density"},
  };
  for (const auto &c : cases) {
    FluidProperties fluid;
    EXPECT_EQ(read(c.text, fluid), c.expected) << c.text;
  }
}

}    // namespace
