// Mill modulus and names of modes as the page shows them.
#include "report/modes/named_modes.h"
#include "report/page/sections.h"
#include "report/results/names.h"
#include <cmath>
#include <gtest/gtest.h>

using namespace mill;
using namespace mill::report;

namespace {
bool shows(const std::string &html, const std::string &text)
{
  return html.find(text) != std::string::npos;
}

Result result(const std::string &name, const double value, const std::string &source)
{
  Result r{};
  r.name           = name;
  r.value          = value;
  r.source         = source;
  r.error_estimate = 0.02;
  return r;
}
}  // namespace

TEST(ModulusReport, ShowsFigureAndTableOfTheThickness)
{
  report::Run run;
  EXPECT_EQ(
      [&] {
        Page empty(run);
        modulus_part(empty, run);
        return empty.body();
      }(),
      "")
      << "nothing without its curve";
  Table curve;
  curve.add("load", "N", Eigen::Vector2d(1e5, 2e6));
  for (const char *prefix : {"kiss_", ""}) {
    curve.add(std::string(prefix) + "stretch", "m", Eigen::Vector2d(2e-5, 4e-4));
    curve.add(std::string(prefix) + "tangent", "N/m", Eigen::Vector2d(4.9e9, 5.1e9));
    curve.add(std::string(prefix) + "secant", "N/m", Eigen::Vector2d(4.8e9, 5e9));
  }
  run.tables["curves/stand-modulus"] = curve;
  run.results.push_back(
      result("stand.screw_sensitivity", 0.886, "computed: mill modulus and plastic slope (29.7)"));
  run.results.back().checks = {{"differences of the coupled solution h2 = S + F/M", 0.8849, ""}};
  Page page(run);
  modulus_part(page, run);
  EXPECT_TRUE(shows(page.body(), "Mill modulus"));
  EXPECT_TRUE(shows(page.body(), "work rolls touching, tangent"));
  EXPECT_TRUE(shows(page.body(), "<b>8.86</b>")) << "10 um of the screw";
  EXPECT_TRUE(shows(page.body(), "8.85 <span class=\"deviation\">"));
}

TEST(ModulusReport, ShowsNamesOfModesWithTheDecidingNumbers)
{
  report::Run run;
  EXPECT_EQ(named_mode_table(run), "");
  run.results.push_back(
      result("mode.fifth_octave_upper.frequency", 868.6,
             "computed: fifth octave, upper stack: K3 and K5 91 % of the strain energy; rolls as "
             "reduced finite elements"));
  run.results.back().checks = {{"six masses", 761.3, ""}};
  const std::string table   = named_mode_table(run);
  EXPECT_TRUE(shows(table, "<th scope=\"row\">fifth octave, upper stack</th>"));
  EXPECT_TRUE(shows(table, "<td>K3 and K5 91 % of the strain energy</td>"));
  EXPECT_TRUE(shows(table, "six masses 761.3"));
}

// A mode of both states has one row; one that only the open stand has follows.
TEST(ModulusReport, ShowsTheStandAsItRollsAndOpenSideBySide)
{
  report::Run run;
  const std::string why = ": work roll with its backup roll; 30 % of the static compliance of the gap; six masses";
  run.results           = {result("f1", 75.6, "computed: six-mass chain"),
                           result("mode.gap_first_kind.frequency", 150.9, "computed: gap mode, first kind" + why),
                           result("mode.gap_first_kind.gap_share", 0.363, "computed: share"),
                           result("open.f1", 58.7, "computed: six-mass chain"),
                           result("open.mode.gap_first_kind.frequency", 58.7, "computed: gap mode, first kind" + why),
                           result("open.mode.frame_upper.frequency", 83.2, "computed: frame, upper" + why)};
  const std::string table = named_mode_table(run);
  const auto row          = table.find("<th scope=\"row\">gap mode, first kind</th>");
  ASSERT_NE(row, std::string::npos) << table;
  const auto rolling = table.find("<b>150.9", row), open = table.find("<b>58.7", row);
  EXPECT_LT(rolling, open);
  EXPECT_LT(open, table.find(">36.3<", row)) << "share of the gap";
  EXPECT_EQ(table.find("<th scope=\"row\">gap mode, first kind</th>", row + 1), std::string::npos);
  EXPECT_TRUE(shows(table, "<th scope=\"row\">frame, upper</th><td class=\"num\">\u2013</td>"));
  EXPECT_EQ(short_groups(run).size(), 1u);
}

// The modes of the best model lead the short table, the six masses follow for comparison; alone they are the whole
// table.
TEST(ModulusReport, TheBestModelLeadsTheFrequencies)
{
  report::Run run;
  run.results       = {result("f1", 38.9, "computed: six-mass chain"),
                       result("mode.third_octave_upper.frequency", 37.8,
                              "computed: third octave, upper stack: K2 and K6 97 %; rolls as reduced finite elements")};
  const auto titles = [&] {
    std::vector<std::string> all;
    for (const Group &group : short_groups(run))
      all.push_back(group.title);
    return all;
  };
  EXPECT_EQ(titles(), std::vector<std::string>{"Natural frequency"});
  run.results.push_back(result("craig-bampton.f1", 37.8, "computed: rolls as reduced finite elements"));
  EXPECT_EQ(titles(), (std::vector<std::string>{"Natural frequency, rolls as reduced finite elements",
                                                "Natural frequency, compared with six masses"}));
  const NamedMode mode = named_mode(run.results[1]);
  EXPECT_EQ(mode.name, "third octave, upper stack");
  EXPECT_EQ(mode.why, "K2 and K6 97 %");
  EXPECT_EQ(mode.model, "rolls as reduced finite elements");
}
