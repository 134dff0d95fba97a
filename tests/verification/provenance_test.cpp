#include "app/bearing_model.h"
#include "app/bite_stage.h"
#include "app/contact_model.h"
#include "app/contact_stage.h"
#include "app/quick_chain.h"
#include "app/strip_flow_stage.h"
#include "core/files.h"
#include "core/members.h"
#include "core/record_text.h"
#include "tests/support/changed_rows.h"
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <set>
#include <unistd.h>

// The inputs that a result states, against what moves it: every row of the case is changed and every result
// computed again by closed forms.  What those do not follow is read from the texts that the finite elements are
// kept under.
namespace {
using namespace mill;
using Results = std::vector<QuickResult>;

// Eigenvalues of an unchanged block round differently.
constexpr double rounding = 1e-11;

bool differs(const double a, const double b)
{
  return std::isnan(a) != std::isnan(b) || std::abs(a - b) > rounding * std::max(std::abs(a), std::abs(b));
}

// What the finite elements behind a result are made from; nothing for the others.
std::string text_of(const FourHigh &stand, const std::string &name)
{
  if (name == "K3" || name == "K5") {
    const bool upper         = name == "K3";
    ContactSettings settings = upper ? stand.upper_contact : stand.lower_contact;
    std::vector<double> loads;
    for (const Pass &pass : stand.passes)
      loads.push_back(std::isnan(pass.load) ? pass.synthetic_range[0] + pass.synthetic_range[1] : pass.load);
    settings.loads    = swept_range(upper ? "upper" : "lower", settings, loads);
    settings.friction = settings.path_trim = 0;  // of other results
    const auto plan                        = planned_rolls(stand, settings, settings.loads[1], first_reach);
    std::string text =
        record_text(settings, stand.strip.width, stand.work_roll.bending_force, stand.work_roll.axial_shift,
                    profile_drop(stand, settings, upper ? 1 : -1, Eigen::VectorXd::LinSpaced(41, -.7, .7)));
    for (const PlannedRoll *roll : {&plan.backup, &plan.work})
      text += roll_inputs(roll->geometry, roll->size, stand.steel, plan.wanted, false);
    return text;
  }
  if (name.rfind("Kzc", 0) == 0) {
    const bool backup   = name == "Kzc1" || name == "Kzc4";
    const auto &bearing = bearing_of(stand.bearings, (backup ? stand.backup_roll : stand.work_roll).bearing);
    return roller_inputs(bearing, 1e5) + ring_inputs(bearing);
  }
  return name == "K4" && stand.bite.method == "fe"
             ? flow_inputs({bite_of(stand.strip, stand.passes[0], stand.work_roll.barrel_diameter, stand.steel),
                            stand.bite, ""},
                           nullptr)
             : "";
}

std::string text_of(const Case &the_case, const std::string &name)
{
  if (const auto *stand = std::get_if<FourHigh>(&the_case.spec))
    return text_of(*stand, name);
  if (const auto *spec = std::get_if<BearingCase>(&the_case.spec)) {
    const auto &bearing = bearing_of(spec->bearings, spec->load.bearing);
    return roller_inputs(bearing, 1e5) + ring_inputs(bearing);
  }
  if (const auto *pair = std::get_if<TwoCylinders>(&the_case.spec)) {
    const auto plan = planned_cylinder(*pair, pair->upper_diameter);
    return roll_inputs(plan.geometry, plan.size, pair->steel, {true, false, false}, false);
  }
  return "";
}

struct Exceptions {
  std::vector<std::string>
      not_moved;  // declared, though no value that the case accepts shows it; the reason beside
  std::vector<std::string> kept_apart;  // enter a text without moving the result
};

// Both ways: no key that moves a result is missing from its list, and none stands in it that cannot move it.
void expect_complete(const BaseCase &base, const Exceptions &known)
{
  const Case the_case = read(base);
  QuickMemory memory;
  const Results before = quick_chain(the_case, memory);
  std::set<std::string> names;
  for (const TraceKey &key : keys_of(the_case)) {
    names.insert(key.name);
    std::vector<std::pair<Case, Results>> others;
    for (Case &other : changed(base, the_case, key.name))
      try {
        Results results = quick_chain(other, memory);
        others.emplace_back(std::move(other), std::move(results));
      } catch (const InputError &) {
        // The closed forms refuse it.
      } catch (const SolverError &) {
      }
    for (const QuickResult &r : before) {
      if (r.name.rfind("pass 2.", 0) == 0)
        continue;  // as the first
      bool moved = false, entered = false;
      for (const auto &[other, results] : others)
        if (const QuickResult *same = find(results, r.name)) {
          moved   = moved || differs(same->parameter.value, r.parameter.value);
          entered = entered || text_of(other, r.name) != text_of(the_case, r.name);
        }
      const bool closed = holds(r.closed, key.name), declared = holds(r.parameter.inputs, key.name);
      EXPECT_TRUE(declared || !closed) << key.name << " is followed by the closed form of " << r.name << " alone";
      if (fits_any(known.not_moved, key.name))
        continue;
      EXPECT_EQ(moved, closed) << key.name << (moved ? " moves " : " does not move ") << r.name
                               << ", and its closed list says otherwise";
      if (!text_of(the_case, r.name).empty() && !fits_any(known.kept_apart, key.name))
        EXPECT_EQ(moved || entered, declared)
            << key.name << (declared ? " is idle in" : " is missing from") << " the inputs of " << r.name;
    }
  }
  for (const QuickResult &r : before)
    for (const std::string &key : r.parameter.inputs)
      EXPECT_TRUE(names.count(key) || key.rfind("strip.friction", 0) == 0)
          << r.name << " states an unknown key " << key;
}

// The demo stand, or the one with a drawn frame, with a made force and a load.
BaseCase stand(const std::string &name, std::vector<std::string> sets = {})
{
  std::string text   = read_text("cases/" + name + ".toml");
  const auto replace = [&](const std::string &from, const std::string &to) {
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  };
  replace("force          = \"data/pass-1.csv\"",
          "synthetic_range = [\"972 kN\", \"979 kN\"]\nsynthetic_duration = \"0.2 s\"");
  replace("force          = \"data/pass-2.csv\"", "load = \"738 kN\"");
  replace("crown            = \"0 um\"", "");
  const std::string file = testing::TempDir() + "provenance-" + std::to_string(getpid()) + "-" + name + ".toml";
  write_atomically(file, text);
  return {file, std::move(sets)};
}
}  // namespace

TEST(Provenance, OfAStand)
{
  const BaseCase base = stand("four-high-1400");
  expect_complete(base, {});
  std::filesystem::remove(base.file);
}

TEST(Provenance, OfAStandWithADrawnFrame)
{
  const BaseCase base = stand("four-high-drawn");
  expect_complete(base, {});
  std::filesystem::remove(base.file);
}

TEST(Provenance, OfTheOtherKinds)
{
  for (const char *file :
       {"cases/two-cylinders.toml", "cases/published-1400.toml", "cases/chatter-two-stands.toml"})
    expect_complete({file, {}}, {});
}

TEST(Provenance, OfBearings)
{
  for (const char *profile : {"none", "iso", "log", "crown"})
    expect_complete({"cases/bearing-266.toml", {std::string("bearing.trb.profile=\"") + profile + "\""}}, {});
}

TEST(Provenance, OfBitesByEveryLaw)
{
  expect_complete({"cases/cold-strip.toml", {}}, {});
}
