#include "core/files.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

// Equivalent masses and the models of the stand as a user meets them.
namespace fs = std::filesystem;

namespace {
// Quick to condense: coarse contacts, slab bite, bearings by the standard.
const std::string quick =
    " -q --cache " + scratch("cache") +
    " --set contact.upper.elements_per_half_width=2 --set contact.lower.elements_per_half_width=2 "
    "--set contact.upper.samples=7 --set contact.lower.samples=7 --set bite.method=slab --set bite.arc=rigid "
    "--set dynamics.output_rate='5 kHz' --set bearing.trb.roller_law=iso --set bearing.trb.rings=rigid ";

Outcome run(const std::string &verb, const std::string &file, const std::string &name,
            const std::string &more = "")
{
  return millstand(verb + " " + file + " -o " + scratch(name) + quick + more);
}

nlohmann::json json_of(const std::string &path)
{
  return nlohmann::json::parse(mill::read_text(path));
}

double value(const std::string &name, const std::string &result)
{
  return json_of(scratch(name) + "/results.json").at("values").at(result).at("value").get<double>();
}

const std::string demo = "cases/four-high-1400.toml", drawn = "cases/four-high-drawn.toml";

// The demo stand as it is, run once.
const std::string &demo_masses()
{
  static const std::string folder = [] {
    const auto outcome = run("masses", demo, "demo");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return scratch("demo");
  }();
  return folder;
}
}  // namespace

TEST(Masses, BothRoadsBesideThePublishedValues)
{
  const auto results = json_of(demo_masses() + "/results.json");
  for (const char *mass : {"M2", "M3", "M4", "M5"}) {
    const auto &entry = results.at("values").at(mass);
    int roads         = 0;
    for (const auto &check : entry.at("checks")) {
      const std::string name = check.at("name");
      if (name.find("finite") == std::string::npos)
        continue;
      ++roads;
      EXPECT_TRUE(near(check.at("value").get<double>(), entry.at("value").get<double>(),
                       within(0.03, "what shoulder, rotation and a solid roll do to the shape")))
          << mass << ": " << name;
    }
    EXPECT_EQ(roads, 2) << mass;
  }
  std::string loud = "masses " + demo + " -o " + scratch("loud") + quick;
  loud.erase(loud.find(" -q"), 3);
  const auto shown = millstand(loud);
  for (const char *text : {"closed form", "FE, integral", "FE, all", "published", "59716.9", "42200.6"})
    EXPECT_NE(shown.out.find(text), std::string::npos) << text << "\n" << shown.out;
}

TEST(Masses, FiniteElementsGiveTheMassesWhenAsked)
{
  ASSERT_EQ(run("masses", demo, "solid", "--set dynamics.mass_source=fe").exit_code, 0);
  const auto entry = json_of(scratch("solid") + "/results.json").at("values").at("M5");
  EXPECT_NE(entry.at("source").get<std::string>().find("finite-element shape"), std::string::npos);
  const auto closed = json_of(demo_masses() + "/results.json").at("values").at("M5");
  const auto &all   = closed.at("checks");
  const auto solid  = std::find_if(all.begin(), all.end(), [](const auto &check) {
    return check.at("name").template get<std::string>().find("all points") == 0;
  });
  ASSERT_NE(solid, all.end());
  EXPECT_EQ(entry.at("value"), solid->at("value")) << "the same number by both settings";
  EXPECT_GT(entry.at("error_estimate").get<double>(), 0.005) << "what the integral and all points differ by";
}

TEST(Models, EachDrivesTheStandAndMakesAChainThatRuns)
{
  for (const std::string model : {"six-mass", "beam", "craig-bampton"}) {
    const auto outcome = run("simulate", demo, model, "--set dynamics.model=" + model);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const std::string table = mill::read_text(scratch(model) + "/response/pass-1.csv");
    EXPECT_EQ(table.find("lower_work_roll_chock [g]") != std::string::npos, model != "six-mass") << model;
  }
  // Six masses lack modes that the force excites, and the run says so; the others have them.
  const auto warned = [](const std::string &model) {
    return json_of(scratch(model) + "/results.json").at("warnings").dump().find("no counterpart") !=
           std::string::npos;
  };
  EXPECT_TRUE(warned("six-mass"));
  EXPECT_FALSE(warned("craig-bampton"));
  // The two stand modes are all but the same in beams and finite elements; the chain has them 3 % too high.
  for (const std::string mode : {"f1", "f2"}) {
    const double fe = value("craig-bampton", "craig-bampton." + mode);
    EXPECT_TRUE(near(value("craig-bampton", "beam." + mode), fe, within(3e-3, "the rolls hardly bend")));
    EXPECT_TRUE(near(value("craig-bampton", mode) / fe, 1.03, within(0.01, "3 % in the specification")));
  }
  for (const std::string file : {"lumped_model.toml", "lumped_model-beam.toml", "lumped_model-craig-bampton.toml"})
    EXPECT_EQ(millstand("modes " + scratch("craig-bampton") + "/" + file + " -q -o " + scratch(file)).exit_code, 0)
        << file;
}

TEST(Models, CachedRunGivesTheSameModels)
{
  ASSERT_EQ(run("masses", demo, "again").exit_code, 0);
  EXPECT_EQ(mill::read_text(demo_masses() + "/curves/models.json"),
            mill::read_text(scratch("again") + "/curves/models.json"));
}

TEST(Housing, DrawingReplacesTheFrame)
{
  ASSERT_EQ(run("masses", drawn, "drawn").exit_code, 0);
  const auto values = json_of(scratch("drawn") + "/results.json").at("values");
  const auto at     = [&](const std::string &name) { return values.at(name).at("value").get<double>(); };
  // K1 is the drawn posts, beam, screw, nut and piston with the given packing in series.
  EXPECT_TRUE(near(at("K1"),
                   1 / (1 / at("frame.upper_post_stiffness") + 1 / at("frame.upper_beam_stiffness") +
                        1 / at("frame.piston_stiffness") + 1 / 4.5e11),
                   within(1e-12, "series springs")));
  EXPECT_TRUE(near(at("M1"), at("frame.upper_post_mass") + at("frame.upper_beam_mass") + 420 + 1000,
                   within(1e-12, "sum of the reduced masses")));
  EXPECT_GT(values.at("K1").at("error_estimate").get<double>(), 0);
  EXPECT_TRUE(fs::exists(scratch("drawn") + "/fields/housing.vtu"));
  const auto models = json_of(scratch("drawn") + "/curves/models.json");
  bool housing      = false;
  for (const auto &model : models.at("models"))
    for (const auto &part : model.at("parts"))
      housing = housing || part == "housing";
  EXPECT_TRUE(housing) << "the reduced housing is a part of the assembled stand";
}

TEST(Models, LimitAboveTheMeshesIsRefused)
{
  const auto refused = run("masses", demo, "limit", "--set 'dynamics.frequency_limit=15 kHz'");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(
      refused.err.find("dynamics.frequency_limit = 15000 Hz is above what the mesh of the work roll can follow, "),
      std::string::npos)
      << refused.err;
}

TEST(Models, FrameWithoutMassIsRefused)
{
  std::string sets;
  for (const char *key : {"upper_post_mass", "upper_beam_mass", "upper_packing_mass", "piston_mass"})
    sets += std::string(" --set 'frame.") + key + "=0 kg'";
  const auto refused = millstand("check " + demo + sets);
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("frame.upper_post_mass, frame.upper_beam_mass, frame.upper_packing_mass and "
                             "frame.piston_mass are all zero; M1 needs a mass: give one of them, or given.M1"),
            std::string::npos)
      << refused.err;
}

TEST(Models, LumpedCaseHasNoOtherModel)
{
  const auto refused = millstand("check cases/published-1400.toml --set dynamics.model=beam");
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("unknown key 'model' in [dynamics]"), std::string::npos) << refused.err;
}
