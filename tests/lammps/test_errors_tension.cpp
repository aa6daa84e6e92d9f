// SPDX-License-Identifier: GPL-2.0-only
/* ----------------------------------------------------------------------
   Wrong input of fix aleisph/tension.
------------------------------------------------------------------------- */

#include "errors.h"
#include "tension_script.h"

using namespace tension;

namespace {

// in small_channel(), which has walls
std::function<void(Script &)> line(const std::string &words)
{
  return [words](Script &s) {
    s.surface = "fix surf fluid aleisph/surface\nfix tens fluid aleisph/tension " + words;
  };
}

}    // namespace

TEST(TensionErrors, Command)
{
  std::vector<ErrorCase> cases = {
      {"keyword", line("colour red"), {"ix aleisph/tension", "unknown keyword colour"}},
      {"model",
       line("sigma 1 model best"),
       {"ix aleisph/tension", "model must be tangent or published", "best"}},
      {"form",
       line("sigma 1 form strong"),
       {"ix aleisph/tension", "form must be pressure, force or both", "strong"}},
      {"viscous", line("sigma 1 viscous maybe"), {"maybe"}},
      {"sigma word", line("sigma water"), {"water"}},
      {"no sigma",
       line(""),
       {"ix aleisph/tension", "sigma is required", "fluid of fix aleisph has no surface tension"}},
      {"unknown group", line("sigma 1 angle roof 60"), {"ix aleisph/tension", "angle", "roof"}},
      {"no variable",
       line("sigma 1 angle wall v_theta"),
       {"ix aleisph/tension", "theta is not an equal- or atom-style variable"}},
  };
  for (const char *key :
       {"sigma", "model", "form", "angle", "angle wall", "filter", "viscous", "factor", "delta"}) {
    const std::string word = std::string(key).substr(0, 5) == "angle" ? "angle" : key;
    cases.push_back({"value missing " + std::string(key),
                     line("sigma 1 " + std::string(key)),
                     {"fix aleisph/tension " + word, "issing"}});
  }
  for (const char *key : {"sigma", "filter", "factor", "delta"})
    for (const char *value : {"-0.5", "-1e-30"})
      cases.push_back(
          {key,
           line(fmt::format("sigma 1 model published {} {}", key, value)),
           {"ix aleisph/tension", fmt::format("{} must not be negative, it is {}", key, value)}});
  for (const char *key : {"factor", "delta"})
    cases.push_back({key,
                     line(fmt::format("sigma 1 {} 0.3", key)),
                     {"ix aleisph/tension", fmt::format("keyword {} needs model published", key)}});
  for (const char *angle : {"0", "180", "-1", "190", "1e9"})
    cases.push_back({angle,
                     line(fmt::format("sigma 1 angle wall {}", angle)),
                     {"ix aleisph/tension", "angle must lie between 0 and 180 degrees",
                      fmt::format("not {}", angle)}});
  for (const char *value : {"nan", "inf", "many"})
    cases.push_back({value, line(fmt::format("sigma 1 angle wall {}", value)), {value}});
  expect_errors(cases);
}

TEST(TensionErrors, Variables)
{
  const auto with = [](const std::string &definition) {
    return [definition](Script &s) {
      line("sigma 1e-6 angle wall v_theta")(s);
      s.owner = definition + "\n" + s.owner;
    };
  };
  const Words outside = {"ix aleisph/tension: variable theta must lie between 0 and 180 degrees",
                         "for atom "};
  expect_errors({
      {"string style",
       with("variable theta string 60"),
       {"ix aleisph/tension", "theta is not an equal- or atom-style variable"}},
      {"zero", with("variable theta equal 0"), outside},
      {"large", with("variable theta equal 180"), outside},
      {"infinite", with("variable theta equal exp(1000)"), outside},
      {"later", with("variable theta equal 60-60*(step>0.5)"), outside},
      {"of atoms", with("variable theta atom 200"), outside},
      // on one rank only
      {"of one atom",
       with("variable theta atom 60-90*(id==1)"),
       {"ix aleisph/tension: variable theta must lie between 0 and 180 degrees", "for atom 1 "}},
  });
}

TEST(TensionErrors, Setup)
{
  const std::string tension = "\nfix tens fluid aleisph/tension sigma 1e-6";
  const std::string surface = "fix surf fluid aleisph/surface";
  expect_errors({
      {"no owner",
       [&](Script &s) { s = Script{}, s.surface = tension.substr(1); },
       {"ix aleisph/tension needs a fix aleisph", "defined before"}},
      {"no surface",
       [&](Script &s) { s.surface = tension.substr(1); },
       {"ix aleisph/tension needs a fix aleisph/surface", "defined before"}},
      {"two",
       [&](Script &s) {
         s.surface = surface + tension + "\nfix t2 fluid aleisph/tension sigma 1e-6";
       },
       {"ix aleisph/tension: there must be only one"}},
      {"group",
       [&](Script &s) { s.surface = surface + "\nfix tens all aleisph/tension sigma 1e-6"; },
       {"ix aleisph/tension: group must be that of fix pred, fluid"}},
      {"before surface",
       [&](Script &s) { s.surface = tension.substr(1) + "\n" + surface; },
       {"surf (aleisph/surface)", "must be defined before", "tens (aleisph/tension)"}},
      {"after predictor",
       [&](Script &s) { s.surface = surface, s.predictor += tension; },
       {"tens (aleisph/tension)", "must be defined before", "pred (aleisph/predictor)"}},
      {"force after predictor",
       [&](Script &s) { s.surface = surface, s.predictor += tension + " form force"; },
       {"tens (aleisph/tension)", "must be defined before", "pred (aleisph/predictor)"}},
      {"angle of no wall",
       [&](Script &s) { s.surface = surface + tension + " angle fluid 60"; },
       {"ix aleisph/tension", "angle", "fluid"}},
  });
}

TEST(TensionErrors, AngleWithoutWalls)
{
  const Scene scene = disc(4);
  Simulation sim(scene);
  expect_words(sim.error_of(tension_script(scene, "angle all 60").text() + "run 0"),
               {"ix aleisph/tension", "angle needs a fix aleisph/wall"});
}

// The surface may be inside of a frame that follows the fluid, without shifting
TEST(TensionErrors, OtherFramesAreRight)
{
  const Scene scene = disc(4);
  Script script = script_of(scene);
  script.surface = tension_script(scene).surface;
  script.timestep = tension_script(scene).timestep;
  Simulation sim(scene);
  EXPECT_EQ(sim.error_of(script.text() + "run 2"), "");
}
