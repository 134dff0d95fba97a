#include "app/trace/trace_text.h"
#include "core/model/case.h"
#include "tests/support/changed_rows.h"
#include "tests/support/near.h"
#include "tests/support/short_records.h"
#include <gtest/gtest.h>

// Every input of every kind of case, and the roads against the lists that results carry.
namespace {
using namespace mill;

const TraceLine *line(const Trace &trace, const std::string &result)
{
  for (const TraceLine &l : trace.lines)
    if (l.result.name == result)
      return &l;
  return nullptr;
}

// Through a soft strip a mode of one half follows the other half so weakly that one per cent of a key moves it by
// less than rounding.  A trace does not resolve that; values far from the present one show it.
bool moves_far_away(const BaseCase &base, const TraceKey &key, const ClosedFormResult &result,
                    ClosedFormMemory &memory)
{
  for (const std::string &value : far_values(key))
    if (const auto other = with_value(base, key, value)) {
      const auto results           = closed_form_chain(*other, memory);
      const ClosedFormResult *same = find(results, result.name);
      if (same && differs(same->parameter.value, result.parameter.value))
        return true;
    }
  return false;
}

// A result moves with a key exactly when its list of inputs has the key.  Results of later passes repeat the
// first.
void compare_with_lists(const BaseCase &base, const Trace &t, ClosedFormMemory &memory)
{
  for (const ClosedFormResult &r : t.base) {
    if (r.name.rfind("pass 2.", 0) == 0)
      continue;
    const TraceLine *reached = line(t, r.name);
    const bool listed        = holds(r.closed, t.key.name),
               moves         = reached ? reached->moves : listed && moves_far_away(base, t.key, r, memory);
    EXPECT_EQ(moves, listed) << t.key.name << " -> " << r.name
                             << (reached ? ": moves, and its inputs lack the key" : ": does not move");
    for (const std::string &key : r.closed)
      EXPECT_TRUE(holds(r.parameter.inputs, key)) << r.name << " " << key;
  }
}
}  // namespace

TEST(TraceRoadsLong, EveryKeyOfTheDemoStandIsTraced)
{
  const ShortRecords demo("four-high-1400");
  const std::string &file = demo.file;
  const auto keys         = keys_of(read_case(file));
  EXPECT_GT(keys.size(), 200u);
  ClosedFormMemory memory;
  int sizes = 0;
  for (const TraceKey &key : keys) {
    SCOPED_TRACE(key.name);
    Trace t;
    ASSERT_NO_THROW(t = trace({file, key.name, {}, "no such folder"}, memory));
    EXPECT_FALSE(trace_text(t).empty());
    EXPECT_EQ(t.per.empty(), !t.reason.empty());
    if (t.per.empty() || key.name.rfind("given.", 0) == 0)
      continue;  // what is not given yet stands in no list
    compare_with_lists({file, {}}, t, memory);
    ++sizes;
  }
  EXPECT_GT(sizes, 100);
}

TEST(TraceRoads, AGivenValueReachesItselfAndItsResults)
{
  const ShortRecords demo("four-high-1400");
  const std::string &file = demo.file;
  ClosedFormMemory memory;
  for (const char *name : {"M1", "M2", "M3", "M4", "M5", "M6", "K1", "K2", "K3", "K4", "K5", "K6", "K7", "K_Zy",
                           "K_ZW", "Kzc1", "Kzc2", "Kzc3", "Kzc4"}) {
    const Trace t = trace({file, std::string("given.") + name, {}, "no such folder"}, memory);
    ASSERT_TRUE(line(t, name)) << name;
    EXPECT_TRUE(near(line(t, name)->slope, 1, within(1e-9, "the value itself"))) << name;
    EXPECT_EQ(t.key.origin, "not given: computed");
  }
  // K1 stands in the load path, so the masses of the upper rolls hang on it; the lower half does not, and its
  // modes follow through the strip alone.
  const Trace K1 = trace({file, "given.K1", {}, "no such folder"}, memory);
  EXPECT_TRUE(line(K1, "M2") && line(K1, "M3") && line(K1, "f1"));
  EXPECT_TRUE(line(K1, "f2") && line(K1, "open.f1"));
  EXPECT_FALSE(line(K1, "M5") || line(K1, "M4") || line(K1, "open.f2"));
}

TEST(TraceRoads, EveryKeyOfTheOtherKindsIsTraced)
{
  const ShortRecords published("published-1400");
  for (const std::string &file : {published.file, std::string("cases/two-cylinders.toml"),
                                  std::string("cases/bearing-266.toml"), std::string("cases/cold-strip.toml")}) {
    ClosedFormMemory memory;
    int reached = 0;
    for (const TraceKey &key : keys_of(read_case(file))) {
      SCOPED_TRACE(file + " " + key.name);
      Trace t;
      ASSERT_NO_THROW(t = trace({file, key.name, {}, "no such folder"}, memory));
      EXPECT_FALSE(trace_text(t).empty());
      reached += t.lines.empty() ? 0 : 1;
      for (const TraceLine &l : t.lines)
        if (!t.per.empty() && l.moves && !l.result.closed.empty())
          EXPECT_TRUE(holds(l.result.closed, key.name)) << l.result.name << " moves, and its inputs lack the key";
    }
    EXPECT_GE(reached, 7) << file;
  }
}

TEST(TraceRoads, FrequenciesFollowStiffnessAndMassByHalf)
{
  // Sum over all springs of d ln f / d ln K is 1/2, over all masses -1/2: Rayleigh's quotient is of degree one.
  const ShortRecords published("published-1400");
  const std::string &file = published.file;
  ClosedFormMemory memory;
  double springs = 0, masses = 0;
  for (int i = 1; i <= 7; ++i)
    if (const Trace t = trace({file, "given.K" + std::to_string(i), {}, "no such folder"}, memory); line(t, "f3"))
      springs += line(t, "f3")->slope;
  for (int i = 1; i <= 6; ++i)
    masses += line(trace({file, "given.M" + std::to_string(i), {}, "no such folder"}, memory), "f3")->slope;
  EXPECT_TRUE(near(springs, 0.5, within(1e-4, "central differences over 1 %: third order, 1e-4 of each")));
  EXPECT_TRUE(near(masses, -0.5, within(1e-4, "central differences over 1 %: third order, 1e-4 of each")));
}

TEST(TraceRoads, AKeyOfADrawnFrameIsTraced)
{
  // Oil column 2 E A/h: one for one with its inverse height, two for one with its diameter; K1 and K2 carry on.
  const std::string file = "cases/four-high-1400.toml";
  const std::vector<std::string> drawn{"screwdown.piston_diameter=800 mm", "screwdown.stroke=40 mm"};
  ClosedFormMemory memory;
  const Trace stroke = trace({file, "screwdown.stroke", drawn, "no such folder"}, memory);
  const Trace piston = trace({file, "screwdown.piston_diameter", drawn, "no such folder"}, memory);
  ASSERT_TRUE(line(stroke, "K2") && line(piston, "K2"));
  EXPECT_TRUE(near(line(piston, "K2")->slope / line(stroke, "K2")->slope, -2,
                   within(2e-3, "series springs are not straight over 1 %")));
  compare_with_lists({file, drawn}, stroke, memory);
}
