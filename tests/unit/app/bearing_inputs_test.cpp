#include "app/run/scratch_folder.h"
#include "app/stages/bearing/bearing_results.h"
#include "app/stages/bearing/bearing_stage.h"
#include "core/base/files.h"
#include "core/model/case.h"
#include "tests/support/changed_rows.h"
#include "tests/support/near.h"
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <unistd.h>

// The inputs that the results of a bearing state, against what moves them: every row of small cases is changed,
// the bearing is solved again, and each result that has moved states the row.
namespace {
using namespace mill;
using Moved = std::map<std::string, std::set<std::string>>;  // keys, by the name of the result

// Two short rows, so that one solution takes a millisecond.
constexpr const char *small_bearing = R"(
schema = 1
kind   = "bearing"
title  = "Small"

[bearing.small]
type              = "four-row {}"
bore              = "60 mm"
outside_diameter  = "100 mm"
width             = "44 mm"
rows              = 2
rollers_per_row   = 13
roller_length     = "15 mm"
roller_diameter   = "10 mm"
slices            = 7

[load]
bearing = "small"
radial  = "40 kN"
loads   = ["10 kN", "80 kN"]
samples = 3

[model]
roller_law = "iso"
rings      = "rigid"
)";

// A case file of its own, removed with it.
struct SmallBearing {
  BaseCase base;
  explicit SmallBearing(const std::string &type, const std::vector<std::string> &sets = {})
      : base{testing::TempDir() + "bearing-inputs-" + std::to_string(getpid()) + ".toml", {}}
  {
    write_atomically(base.file, fmt::format(fmt::runtime(small_bearing), type));
    if (type == "tapered")
      base.sets = {"bearing.small.cup_angle=16.36 deg", "bearing.small.roller_cone_angle=3.6 deg"};
    base.sets.insert(base.sets.end(), sets.begin(), sets.end());
  }
  ~SmallBearing()
  {
    std::filesystem::remove(base.file);
  }
};

// Solves cases that differ in a row each; all of them state the lists of the first.
class Solver {
public:
  explicit Solver(const Case &of) : out(scratch.path(), of, true, "bearing"), keys(moving_keys_of(of)) {}
  Results solve(const Case &the_case) const
  {
    RunContext run{the_case, out, scratch.path(), true};
    run.keys         = keys;
    const auto &spec = std::get<BearingCase>(the_case.spec);
    note_bearing(run, "Kzc", add_bearing_case(run, spec));
    return run.results;
  }
  // Nothing where the bearing has no equilibrium, or is refused.
  std::optional<Results> solve_or_none(const Case &the_case) const
  {
    try {
      return solve(the_case);
    } catch (const InputError &) {
    } catch (const SolverError &) {
    }
    return {};
  }

private:
  const ScratchFolder scratch{"bearing-inputs", true};
  const OutputDir out;
  const std::shared_ptr<MovingKeys> keys;
};

// More than the rounding of an equilibrium, which is found to 1e-11 of its load.
bool has_moved(const Parameter &before, const Parameter &now)
{
  return std::abs(before.value - now.value) > 1e-7 * std::max(std::abs(before.value), std::abs(now.value));
}

// One number near by, or all words that ask for no finite elements.
std::vector<std::string> values_to_try(const TraceKey &key)
{
  if (key.name == "bearing.small.arrangement")
    return {"\"+-\"", "\"-+\"", "\"+\""};
  const bool rings = key.name == "bearing.small.rings" || key.name == "model.rings";
  std::vector<std::string> values;
  for (const std::string &value : other_values(key))
    if (!rings && value != "\"fe\"")
      values.push_back(value);
  return values;
}

Moved moved_by_every_row(const BaseCase &base, const Case &the_case, const Solver &solver, const Results &before)
{
  Moved moved;
  for (const TraceKey &key : keys_of(the_case)) {
    const TraceKey in_case = find_key(the_case, base.sets, key.name, {});
    for (const std::string &value : values_to_try(in_case)) {
      const std::optional<Case> other = with_value(base, in_case, value);
      const auto now                  = other ? solver.solve_or_none(*other) : std::nullopt;
      if (!now)
        continue;
      for (const auto &[name, p] : before.values)
        if (const Parameter *same = now->find(name); same && has_moved(p, *same))
          moved[name].insert(key.name);
      if (key.row.kind != Kind::choice && key.row.kind != Kind::text)
        break;
    }
  }
  return moved;
}

std::string listed(const std::set<std::string> &keys)
{
  std::string text;
  for (const std::string &key : keys)
    text += " " + key;
  return text;
}

// Every key that moves a result stands in its list.  With MILLSTAND_IDLE set, the keys that were not seen to move
// it are printed: some of them do for other values.
void expect_listed(const std::string &type, const std::vector<std::string> &sets = {})
{
  const SmallBearing bearing(type, sets);
  SCOPED_TRACE(type + listed({sets.begin(), sets.end()}));
  const Case the_case = read(bearing.base);
  const Solver solver(the_case);
  const Results before = solver.solve(the_case);
  Moved moved          = moved_by_every_row(bearing.base, the_case, solver, before);
  for (const auto &[name, p] : before.values) {
    std::set<std::string> missing, idle;
    for (const std::string &key : moved[name])
      if (!holds(p.inputs, key))
        missing.insert(key);
    for (const std::string &key : p.inputs)
      if (!moved[name].count(key))
        idle.insert(key);
    EXPECT_TRUE(missing.empty()) << name << " is moved by" << listed(missing);
    if (std::getenv("MILLSTAND_IDLE"))
      fmt::print("{}{}: {} not moved by{}\n", type, listed({sets.begin(), sets.end()}), name, listed(idle));
  }
}
}  // namespace

TEST(BearingInputs, EveryRowThatMovesAResultStandsInItsList)
{
  expect_listed("tapered");
  expect_listed("tapered", {"bearing.small.pitch_diameter=80.1 mm", "bearing.small.rib_angle=75 deg"});
  expect_listed("tapered", {"bearing.small.dynamic_rating=90 kN", "bearing.small.static_rating=120 kN"});
  expect_listed("tapered", {"published.Kzc=1500 kN/mm"});
  expect_listed("cylindrical");
}

TEST(BearingInputs, AProfileAddsItsRows)
{
  for (const char *profile : {"iso", "log"})
    expect_listed("tapered", {std::string("bearing.small.profile=") + profile});
  expect_listed("cylindrical", {"bearing.small.profile=crown", "bearing.small.crown_drop=5 um"});
  expect_listed("cylindrical", {"bearing.small.profile=three-parameter", "bearing.small.crown_drop=20 um",
                                "bearing.small.profile_share=0.5"});
  expect_listed("cylindrical", {"bearing.small.roller_law=elastic", "model.roller_law=elastic"});
}

TEST(BearingInputs, AnAskewLoadAddsThePlacesOfTheRows)
{
  for (const char *type : {"tapered", "cylindrical"}) {
    expect_listed(type, {"load.tilt=0.2 mrad"});
    expect_listed(type, {"load.moment=300 N m"});
  }
  expect_listed("tapered", {"load.axial=10 kN"});
  expect_listed("tapered", {"load.axial_displacement=5 um"});
  expect_listed("tapered", {"bearing.small.arrangement=+"});
}

TEST(BearingInputs, AShaftThatTurnsAddsTheForceOfTheRollers)
{
  for (const char *type : {"tapered", "cylindrical"})
    expect_listed(type, {"load.speed=100 Hz"});
  expect_listed("tapered", {"load.speed=100 Hz", "bearing.small.roller_total_length=16 mm"});
}

TEST(BearingInputs, AWarningOfFewRollersStatesTheClearanceThatTheEndPlayGives)
{
  const SmallBearing bearing(
      "tapered", {"bearing.small.end_play=0.5 mm", "load.radial=1 kN", "load.loads=[\"0.5 kN\", \"80 kN\"]"});
  const Case the_case   = read(bearing.base);
  const Results results = Solver(the_case).solve(the_case);
  std::string detail;
  for (const Warning &warning : results.warnings)
    if (warning.id == WarningId::bearing_few_rollers)
      detail = warning.detail;
  // 0.5 mm tan(16.36 deg) = 0.1468 mm of diametral clearance
  EXPECT_EQ(detail, "with a clearance of 0.1468 mm the stiffness depends on the position of the cage");
}
