#include "app/bearing_study.h"
#include "app/bite_stage.h"
#include "app/contact_stage.h"
#include "app/quick_parts.h"
#include "app/second_engine.h"
#include "app/stand_components.h"
#include "app/strip_flow_stage.h"
#include "bite/members.h"
#include "core/files.h"
#include "core/record_text.h"
#include "tests/support/changed_rows.h"
#include "tests/support/film_pass.h"
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <unistd.h>

// What the cache keeps is found by a text of everything it depends on.  Every row of every section is changed, and the
// text of each kept stage must follow, unless the row stands in the list of those that the stage does not see.
namespace {
using namespace mill;
using Texts = std::map<std::string, std::string>;  // of the inputs, by stage

std::string text_of_pair(const PlannedPair &plan, const Material &steel)
{
  std::string text;
  for (const PlannedRoll *roll : {&plan.backup, &plan.work})
    for (const bool companion : {false, true})
      text += roll_inputs(roll->geometry, roll->size, steel, plan.wanted, companion);
  return text;
}

void add_contact(Texts &texts, const FourHigh &stand, const std::string &name, const ContactSettings &settings)
{
  std::vector<double> loads;
  for (const Pass &pass : stand.passes)
    loads.push_back(pass.load);
  const auto range       = swept_range(name, settings, loads);
  const PlannedPair plan = planned_rolls(stand, settings, range[1], first_reach);
  texts["rolls"] += text_of_pair(plan, stand.steel);
  fem::FourierOptions options;
  options.half_width = range[1];  // whatever it is made of, the largest load is in it
  options.both_sides = plan.wanted.both_sides;
  for (const PlannedRoll *roll : {&plan.backup, &plan.work})
    texts["second engine"] += fourier_inputs(roll->geometry, stand.steel, options, {});
}

Texts texts_of(const FourHigh &stand)
{
  Texts texts;
  add_contact(texts, stand, "upper", stand.upper_contact);
  add_contact(texts, stand, "lower", stand.lower_contact);
  for (const Pass &pass : stand.passes) {
    for (const QuickResult &seat : quick_bearings(stand, pass.load, 0))
      for (const Roll *roll : {&stand.work_roll, &stand.backup_roll}) {
        const auto &bearing = bearing_of(stand.bearings, roll->bearing);
        texts["rollers"] += roller_inputs(bearing, roller_load_bound(bearing, seat.load, 0));
        texts["rings"] += ring_inputs(bearing);
      }
    const FlowQuestion q{bite_of(stand.strip, pass, stand.work_roll.barrel_diameter, stand.steel), stand.bite, ""};
    texts["bite"] += flow_inputs(q, nullptr);
  }
  for (const bool coarse : {false, true}) {
    for (const Roll *roll : {&stand.work_roll, &stand.backup_roll})
      texts["components of the rolls"] += roll_component_inputs(*roll, stand, coarse);
    texts["component of the housing"] += housing_component_inputs(stand, coarse);
  }
  return texts;
}

Texts texts_of(const TwoCylinders &pair)
{
  Texts texts;
  for (const double diameter : {pair.upper_diameter, pair.lower_diameter}) {
    const PlannedRoll plan = planned_cylinder(pair, diameter);
    for (const bool companion : {false, true})
      texts["rolls"] += roll_inputs(plan.geometry, plan.size, pair.steel, {true, false, false}, companion);
  }
  return texts;
}

Texts texts_of(const BearingCase &spec)
{
  BearingQuestion q;
  q.bearing = bearing_of(spec.bearings, spec.load.bearing);
  q.radial  = spec.load.radial;
  q.axial   = spec.load.axial;
  q.tilt    = spec.load.tilt;
  q.loads   = {spec.load.loads[0], spec.load.loads[1]};
  return {
      {"rollers", roller_inputs(q.bearing, largest_roller_load(q))},
      {"rings",   ring_inputs(q.bearing)                          }
  };
}

Texts texts_of(const BiteCase &spec)
{
  Texts texts;
  for (const Pass &pass : spec.passes) {
    const FlowQuestion q{bite_of(spec.strip, pass, spec.roll_diameter, spec.steel), spec.bite, ""};
    texts["bite"] += flow_inputs(q, nullptr);
  }
  return texts;
}

// Nothing of these is kept.
Texts texts_of(const Lumped &)
{
  return {};
}
Texts texts_of(const ChatterCase &)
{
  return {};
}

Texts texts_of(const Case &the_case)
{
  return std::visit([](const auto &spec) { return texts_of(spec); }, the_case.spec);
}

using Patterns = std::map<std::string, std::vector<std::string>>;  // by stage

// Changes each row of the case and compares the stages that followed with those whose list does not have it.
// @param unseen  rows that a stage does not see
void expect_followed(const BaseCase &base, const Patterns &unseen)
{
  const Case the_case = read(base);
  const Texts before  = texts_of(the_case);
  for (const TraceKey &key : keys_of(the_case)) {
    const auto others = changed(base, the_case, key.name);
    for (const auto &[stage, text] : before) {
      const bool blind = fits_any(unseen.at(stage), key.name);
      bool followed    = false;
      for (const Case &other : others)
        followed = followed || texts_of(other).at(stage) != text;
      if (others.empty())
        EXPECT_TRUE(blind) << key.name << " took no other value, so nobody knows whether " << stage << " see it";
      else
        EXPECT_EQ(followed, !blind) << key.name << (followed ? " enters " : " does not enter ") << "what the "
                                    << stage << " are kept under";
    }
  }
}

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string> &b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const std::vector<std::string> head{"schema", "kind", "title"};
// Of a pass what is no load and no number of the bite.
const std::vector<std::string> records{
    "pass.#.name",           "pass.#.force",           "pass.#.measured",           "pass.#.synthetic",
    "pass.#.published_peak", "pass.#.measured_peak",   "pass.#.synthetic_range",    "pass.#.synthetic_duration",
    "pass.#.synthetic_seed", "pass.#.synthetic_bandwidth"};
const std::vector<std::string> pass_of_strip{"pass.#.entry_thickness", "pass.#.exit_thickness", "pass.#.entry_tension",
                                             "pass.#.exit_tension", "pass.#.speed"};
const std::vector<std::string> after_the_springs{"dynamics.*", "stand.*", "analysis.*", "given.*", "published.*"};
const std::vector<std::string> of_the_stand{"frame.*", "housing.*", "screwdown.*"};
const std::vector<std::string> rolls{"work_roll.*", "backup_roll.*", "steel.*", "contact.*"};
// Ground and thermal profile: the right-hand side of the contact, which is solved anew in every run.
std::vector<std::string> profile(const std::string &roll)
{
  return {roll + ".crown*", roll + ".thermal_crown*", roll + ".end_chamfer_*"};
}
std::vector<std::string> seat(const std::string &roll)
{
  return {roll + ".bearing", roll + ".bearing_mass", roll + ".bearing_load", roll + ".chock_mass_*"};
}
const std::vector<std::string> no_roll_mesh =
    head + records + pass_of_strip + after_the_springs + of_the_stand + profile("work_roll") + profile("backup_roll") +
    seat("work_roll") + seat("backup_roll") + std::vector<std::string>{"bearing.*", "strip.*", "bite.*"};

// A stand with a drawn frame, its forces as numbers, without swept ranges: those follow from the loads.
BaseCase drawn_stand()
{
  std::string text   = read_text("cases/four-high-drawn.toml");
  const auto replace = [&](const std::string &from, const std::string &to) {
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  };
  replace("force          = \"data/pass-1.csv\"", "load = \"976 kN\"");
  replace("force          = \"data/pass-2.csv\"", "load = \"738 kN\"");
  replace("loads = [\"100 kN\", \"2000 kN\"]", "");
  const std::string file = testing::TempDir() + "cache-keys-" + std::to_string(getpid()) + ".toml";
  write_atomically(file, text);
  return {file, {"bearing.trb.roller_total_length=34 mm"}};
}
}  // namespace

TEST(CacheKeys, EveryRowOfAFourHighEntersOrIsKnownNotTo)
{
  const BaseCase base = drawn_stand();
  const auto line     = std::vector<std::string>{"contact.upper.samples", "contact.lower.samples"} +
                    std::vector<std::string>{"contact.upper.path_trim", "contact.lower.path_trim"} +
                    std::vector<std::string>{"contact.upper.axis_offset", "contact.lower.axis_offset"} +
                    std::vector<std::string>{"contact.upper.cross_angle", "contact.lower.cross_angle"};
  expect_followed(
      base,
      {
          {"rolls", no_roll_mesh + line + std::vector<std::string>{"steel.density", "steel.yield_stress"}},
          {"second engine", no_roll_mesh + line + std::vector<std::string>{"steel.density", "steel.yield_stress"}},
          {"rollers",
           head + records + pass_of_strip + after_the_springs + of_the_stand + rolls +
               std::vector<std::string>{"bearing.crb.*", "strip.*", "bite.*"}},
          {"rings",
           head + records + pass_of_strip + after_the_springs + of_the_stand + rolls +
               std::vector<std::string>{"bearing.crb.*", "strip.*", "bite.*", "pass.#.load"}},
          {"bite", head + records + after_the_springs + of_the_stand + std::vector<std::string>{"bearing.*"}},
          {"components of the rolls", head},
          {"component of the housing", head},
  });
  std::filesystem::remove(base.file);
}
