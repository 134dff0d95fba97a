#include "app/stages/bite/bite_stage.h"
#include "app/trace/closed_form_chain.h"
#include "app/trace/trace.h"
#include "core/case/moving_keys.h"
#include "core/case/provenance.h"
#include "core/model/case.h"
#include "core/records/rows_of_bite.h"
#include "reduce/bite/slab/regime.h"
#include "tests/support/changed_rows.h"
#include <gtest/gtest.h>

// The lists that a run states and a trace follows.
namespace {
using namespace mill;

const std::string demo = "cases/four-high-1400.toml";

bool traced(const std::vector<std::string> &sets, const std::string &key, const std::string &result)
{
  const Trace t = trace({demo, key, sets, "no such folder"});
  for (const TraceLine &line : t.lines)
    if (line.result.name == result)
      return true;
  return false;
}
}  // namespace

TEST(ResultInputs, ProfilesTiltAndOilAreInputsOfTheirSprings)
{
  struct Wanted {
    std::vector<std::string> sets;
    std::string key, result;
  };
  const std::string table = R"(=[["-700 mm", "0 um"], ["0 mm", "30 um"], ["700 mm", "0 um"]])";
  const std::string film  = R"(strip.friction={law = "film", mu0 = 0.012, mu1 = 0.142, decay = "2.43 1/um", )"
                            R"(viscosity = "0.005 Pa s", pressure_viscosity = "2e-8 1/Pa"})";
  const std::vector<std::string> oiled{film, "pass.0.speed=2 m/s", "pass.1.speed=2 m/s"};
  const std::vector<Wanted> all{
      {{"backup_roll.crown_table" + table}, "backup_roll.crown_table", "K3"},
      {{"work_roll.thermal_crown_table" + table}, "work_roll.thermal_crown_table", "K5"},
      {{"contact.upper.tilt=0.02 mrad"}, "contact.upper.tilt", "K3"},
      {{"work_roll.end_chamfer_length=50 mm", "work_roll.end_chamfer_depth=20 um"},
       "work_roll.end_chamfer_depth",
       "K3"},
      {{"work_roll.axial_shift=100 mm"}, "work_roll.axial_shift", "K5"},
      {{R"(strip.friction={law = "coulomb", coefficient = 0.2})"}, "strip.friction.coefficient", "K4"},
      {oiled, "strip.friction.viscosity", "K4"},
      {oiled, "strip.friction.mu1", "K4"},
  };
  for (const Wanted &w : all) {
    SCOPED_TRACE(w.key);
    Case the_case;
    ASSERT_NO_THROW(the_case = read_case(demo, w.sets)) << "as millstand check reads it";
    MovingKeys keys(the_case.spec);
    EXPECT_TRUE(holds(spring_keys(keys, *spring_named(w.result), 0), w.key));
    EXPECT_TRUE(traced(w.sets, w.key, w.result));
  }
}

TEST(ResultInputs, KeysOfOneSideAreNotInputsOfTheOther)
{
  const Case the_case = read_case(demo);
  MovingKeys keys(the_case.spec);
  EXPECT_FALSE(holds(contact_keys(keys, "upper", 0), "contact.lower.tilt"));
  EXPECT_FALSE(holds(response_keys(keys, 0), "pass.1.force"));
  EXPECT_TRUE(holds(response_keys(keys, 1), "pass.1.force"));
  EXPECT_TRUE(holds(contact_keys(keys, "upper", 0, ContactReading::friction), "contact.upper.friction"));
  EXPECT_FALSE(holds(contact_keys(keys, "upper", 0), "contact.upper.friction"));
  const Trace t = trace({demo, "contact.upper.friction", {}, "no such folder"});
  EXPECT_EQ(t.only_in_a_run, std::vector<std::string>{"K3.friction_tangent"});
}

TEST(ResultInputs, EveryRowThatAStageMayReadIsChanged)
{
  // Head, what is only compared or estimated from, what other commands read, and sections that are of another form
  // of the case: [model] repeats what a roller bearing says.
  const std::vector<std::string> beside{
      "schema",        "kind",         "title",   "confirmed", "work_roll.estimate*", "backup_roll.estimate*",
      "frame.*",       "monitoring.*", "plant.*", "given.*",   "published.*",         "advice.*",
      "ball_bearing.*"};
  for (const char *file : {"four-high-1400", "four-high-drawn", "oil-film", "bearing-266", "cold-fit",
                           "two-cylinders", "elliptic-contact", "published-1400", "chatter-tandem"}) {
    const Case the_case     = read_case(std::string("cases/") + file + ".toml");
    const KeyList all       = MovingKeys(the_case.spec).all();
    const std::string other = holds(all, "contact.space.at") ? "contact.line.*"
                              : holds(all, "oil.viscosity")  ? "strip.friction.*"
                                                             : "contact.space.*";
    for (const TraceKey &key : keys_of(the_case))
      if (!fits(other, key.name) && !fits_any(beside, key.name) &&
          !(fits("model.*", key.name) && all_bearings(the_case).empty()))
        EXPECT_TRUE(holds(all, key.name)) << key.name << " of " << file;
  }
}

// A slab theory on an arc that is left open asks the strip which arc it is.
TEST(ResultInputs, TheStripDecidesTheArcOfASlabTheory)
{
  const auto inputs = [](const std::string &arc) {
    const Case the_case =
        read_case("cases/cold-strip.toml", {"bite.method=slab", "bite.strip=auto", "bite.arc=" + arc});
    MovingKeys keys(the_case.spec);
    return bite_keys(keys, 0);
  };
  EXPECT_TRUE(holds(inputs("auto"), "bite.strip"));
  EXPECT_TRUE(holds(inputs("elastic"), "bite.strip")) << "its section of the roll reaches farther";
  EXPECT_FALSE(holds(inputs("hitchcock"), "bite.strip"));
  EXPECT_FALSE(holds(inputs("rigid"), "bite.strip"));
}

TEST(ResultInputs, ElasticZonesReadTheModulusOfTheStripOnAnyArc)
{
  const auto bite_of_case = [](const std::vector<std::string> &sets) {
    const auto spec = std::get<BiteCase>(read_case("cases/cold-strip.toml", sets).spec);
    return bite_of(spec.strip, spec.passes[0], spec.roll_diameter, spec.steel);
  };
  EXPECT_NE(bite::regime_of(bite_of_case({})).elastic_share,
            bite::regime_of(bite_of_case({"strip.youngs_modulus=100 GPa"})).elastic_share);
  const Case the_case =
      read_case("cases/cold-strip.toml", {"bite.method=slab", "bite.strip=auto", "bite.arc=hitchcock"});
  MovingKeys keys(the_case.spec);
  const auto reads_modulus = [&](const ResultRow &row, const BiteAnswers by, const bool free_arc) {
    BiteReading reading = reading_of(row, by);
    reading.free_arc    = free_arc;
    return holds(bite_keys(keys, 0, reading), "strip.youngs_modulus");
  };
  EXPECT_TRUE(reads_modulus(row::bite::elastic_share, BiteAnswers::model, false));
  EXPECT_TRUE(reads_modulus(row::bite_model::force, BiteAnswers::compared, true)) << "karman-elastic-arc";
  EXPECT_FALSE(reads_modulus(row::bite_model::force, BiteAnswers::compared, false)) << "karman on a circle";
  EXPECT_FALSE(reads_modulus(row::bite::force, BiteAnswers::model, false));
}

// The section of the work roll that gives a free arc is held where the backup roll carries it.  Where arc and
// strip are left open the bite decides, and the model says which one it was.
TEST(ResultInputs, TheBackupRollIsAnInputOfAFreeArc)
{
  const auto inputs = [](const std::string &arc, const bool section = false) {
    const Case the_case = read_case(demo, {"bite.arc=" + arc});
    MovingKeys keys(the_case.spec);
    BiteReading reading;
    reading.section = section;
    return bite_keys(keys, 0, reading);
  };
  const KeyList of_section{"backup_roll.barrel_diameter", "backup_roll.barrel_length", "work_roll.barrel_length",
                           "pass.0.force"};
  for (const std::string &key : of_section) {
    EXPECT_TRUE(holds(inputs("elastic"), key)) << key;
    EXPECT_FALSE(holds(inputs("hitchcock"), key)) << key;
    EXPECT_TRUE(holds(inputs("auto", true), key)) << key;
    EXPECT_FALSE(holds(inputs("auto", false), key)) << key;
  }
}
