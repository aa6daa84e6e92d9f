// SPDX-License-Identifier: GPL-2.0-only

#include "errors.h"

#include <filesystem>

namespace {

const std::string HEADER = "# DATE: 2025-11-22 UNITS: lj CONTRIBUTOR: nobody CITATION: none\n";

std::string error_with(const std::string &text)
{
  const std::string path = scratch_file("fluid.aleisph");
  write_text(path, text);
  Simulation sim(small_channel());
  Script script = small_script();
  script.owner = "fix sph all aleisph spacing 0.2 fluid " + path;
  return sim.error_of(script.text() + "run 1");
}

}    // namespace

TEST(FluidFile, Right)
{
  EXPECT_EQ(error_with(HEADER + "# water-like\nrho0 1.0  # density\n\nnu 0.01\nsigma 0.07\n"), "");
  EXPECT_EQ(error_with(HEADER + "rho0 1"), "");
}

// its density and viscosity are the ones in force: the same flow as with numbers in the script
TEST(FluidFile, IsUsed)
{
  const std::string path = scratch_file("thick.aleisph");
  write_text(path, HEADER + "rho0 1.0\nnu 0.25\n");
  const auto flow = [](const std::string &fluid, const std::string &viscosity) {
    Simulation sim(small_channel());
    Script script = small_script();
    script.owner = "fix sph all aleisph spacing 0.2 " + fluid;
    script.body = "fix push all addforce 0.04 0 0";
    script.predictor += viscosity;
    sim.run(script.text() + "run 10");
    return sim.v(0);
  };
  const auto expected = flow("rho0 1.0", " nu 0.25");
  EXPECT_EQ(flow("fluid " + path, ""), expected);
  EXPECT_EQ(flow("fluid " + path, " nu 0.25"), expected);
  EXPECT_EQ(flow("fluid " + path, " mu 0.25"), expected);    // rho0 is 1
  EXPECT_NE(flow("fluid " + path, " nu 0.0"), expected);
}

// the files that come with the package, in the units that they are written in
TEST(FluidFile, OfThePackage)
{
  int files = 0;
  for (const auto &entry : std::filesystem::directory_iterator(ALEISPH_SOURCE_DIR "/potentials")) {
    if (entry.path().extension() != ".aleisph") continue;
    SCOPED_TRACE(entry.path());
    files++;
    Scene scene = small_channel();
    scene.units = "si";
    Simulation sim(scene);
    EXPECT_EQ(sim.error_of("fix sph all aleisph spacing 0.2 fluid " + entry.path().string()), "");
  }
  EXPECT_GE(files, 2);
}

TEST(FluidFile, Missing)
{
  Simulation sim(small_channel());
  expect_words(sim.error_of("fix sph all aleisph spacing 0.2 fluid nowhere.aleisph"),
               {"ix aleisph", "nowhere.aleisph", "cannot be opened", "LAMMPS_POTENTIALS"});
}

TEST(FluidFile, Garbled)
{
  const std::vector<std::pair<std::string, Words>> cases = {
      {"", {"rho0"}},
      {"nu 0.01\n", {"rho0"}},
      {"rho0 0.0\n", {"rho0"}},
      {"rho0 1.0\ncolour 3\n", {"line 3", "unknown property 'colour'"}},
      {"rho0 1.0\nnu\n", {"line 3", "no value after 'nu'"}},
      {"rho0 1.0 2.0\n", {"line 2", "unexpected '2.0'"}},
      {"rho0 1.0\nrho0 2.0\n", {"line 3", "'rho0' given twice"}},
      {"rho0 -1.0\n", {"line 2", "'-1.0'"}},
      {"rho0 1.0\nnu -0.01\n", {"line 3", "'-0.01'"}},
      {"rho0 1.0\nnu nan\n", {"line 3", "'nan'"}},
      {"rho0 inf\n", {"line 2", "'inf'"}},
      {"rho0 1.0x\n", {"line 2", "'1.0x'"}},
      {"rho0 water\n", {"line 2", "'water'"}},
  };
  for (const auto &item : cases) {
    SCOPED_TRACE(item.first);
    const std::string message = error_with(HEADER + item.first);
    expect_words(message, {"ix aleisph", "fluid.aleisph"});
    expect_words(message, item.second);
  }
}

TEST(FluidFile, Units)
{
  const std::string rows = "rho0 1.0\n";
  expect_words(error_with("# DATE: 2025-11-22 UNITS: si CONTRIBUTOR: nobody\n" + rows),
               {"ix aleisph", "fluid.aleisph", "'si'", "units lj"});
  // a file that does not say which units it has is not to be trusted
  expect_words(error_with("# some fluid\n" + rows),
               {"ix aleisph", "fluid.aleisph", "no UNITS", "first line"});
}
