#include "report/chatter/figures.h"
#include "report/page/curves.h"
#include "tests/support/html_page.h"
#include "tests/support/near.h"
#include "tests/support/sample_chatter.h"
#include <gtest/gtest.h>
#include <regex>
#include <sstream>

using namespace mill;
using namespace mill::report;
using nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {
ChatterCondition condition_with(const ordered_json &json)
{
  const fs::path run = sample::run_with_chatter();
  std::ofstream(run / "curves" / "chatter-2.json") << json.dump();
  return read_chatter(read_run(run.string())).conditions.front();
}

struct Text {
  double x, y;
  std::string anchor, content;
};
std::vector<Text> texts_of(const std::string &svg, const std::string &classes)
{
  std::vector<Text> texts;
  const std::regex text("<text class=\"" + classes +
                        "\" x=\"([-0-9.]+)\" y=\"([-0-9.]+)\"(?: text-anchor=\"([a-z]+)\")?>([^<]*)</text>");
  for (std::sregex_iterator match(svg.begin(), svg.end(), text), end; match != end; ++match)
    texts.push_back({std::stod((*match)[1]), std::stod((*match)[2]), (*match)[3], (*match)[4]});
  return texts;
}
}  // namespace

// 18 against 17.5 is 2.8 %; ln 2 / 0.75 = 0.924 s, times 128 Hz 118 periods.
TEST(ChatterAnswer, SaysSpeedDistanceCausesAndTrust)
{
  const auto sentences = chatter_answer(condition_with(sample::chatter_json("2")));
  ASSERT_EQ(sentences.size(), 4u);
  EXPECT_EQ(sentences[0], "Stable below 18.00 m/s and unstable above <128 Hz>.");
  EXPECT_EQ(sentences[1], "The working speed of 17.50 m/s is 0.50 m/s (2.8\u00a0%) below the critical one; a "
                          "disturbance there halves in 0.92 s, 120 periods of the chatter.");
  EXPECT_EQ(sentences[2],
            "Inputs with the largest effect on the limit: entry thickness (+5.2\u00a0% when 10\u00a0% lower, "
            "+0.10\u00a0% when 10\u00a0% higher); lower backup roll, mass (no crossing when "
            "10\u00a0% lower, \u22123.0\u00a0% when 10\u00a0% higher); viscosity of the oil "
            "(+2.9\u00a0% when 10\u00a0% lower, \u22122.5\u00a0% when 10\u00a0% higher).");
  EXPECT_EQ(sentences[3],
            "How certain this is: critical speed by the 3 linearisations: 17.46 \u2026 18.90 m/s. By the "
            "2 variants of the stand: 18.00 \u2026 18.18 m/s. By the models of the stand: 18.00 m/s; "
            "beam stable throughout. Measured: 20.00 m/s.");
}

TEST(ChatterAnswer, WithoutACrossing)
{
  ordered_json json    = sample::chatter_json("2");
  json["critical"]     = {{"verdict", "stable"},
                          {"speed", nullptr},
                          {"growth_at_working_speed", 0.5},
                          {"margin", -0.82},
                          {"margin_speed", 24.0}};
  const auto sentences = chatter_answer(condition_with(json));
  ASSERT_GE(sentences.size(), 2u);
  EXPECT_EQ(sentences[0], "Condition 2: stable throughout.");
  EXPECT_EQ(sentences[1], "The least damped state of the range is that at 24.0 m/s, with a growth rate of "
                          "\u22120.820 1/s; a disturbance there halves in 0.85 s.");
}

TEST(ChatterTables, SummaryAndPublished)
{
  const ChatterCondition c  = condition_with(sample::chatter_json("2"));
  const std::string summary = chatter_summary_table({c});
  EXPECT_TRUE(says(summary, "<span class=\"good-word\">stable</span>"));
  EXPECT_TRUE(says(summary, "18.90 <span class=\"deviation\">(\u22124.8\u00a0%)")) << summary;   // 18/18.9 - 1
  EXPECT_TRUE(says(summary, "20.00 <span class=\"deviation\">(\u221210.0\u00a0%)")) << summary;  // 18/20 - 1
  EXPECT_TRUE(says(summary, "<td class=\"num\">\u22122.8\u00a0%</td>")) << summary;              // 17.5/18 - 1
  EXPECT_TRUE(says(chatter_published_table({c}), "critical speed [m/s]"));
  EXPECT_EQ(chatter_published_table({ChatterCondition{}}), "");
  ChatterCondition fast           = c;
  fast.critical.growth_at_working = 0.3;
  EXPECT_TRUE(says(chatter_summary_table({fast}), "<span class=\"poor-word\">chatters</span>"));
}

TEST(ChatterTables, SchemesVariantsConclusionsEventsTandem)
{
  const ChatterCondition c = condition_with(sample::chatter_json("2"));
  EXPECT_TRUE(says(chatter_scheme_table(c), "everything follows</td><td class=\"num\">18.90 <span "
                                            "class=\"deviation\">(+5.0\u00a0%)"));  // 18.9/18 - 1
  EXPECT_TRUE(says(chatter_variant_table(c), "18.18 <span class=\"deviation\">(+1.0\u00a0%)"));
  EXPECT_TRUE(says(chatter_structure_table(c), "stable throughout"));
  const std::string conclusions = chatter_conclusion_table(c);
  EXPECT_TRUE(says(conclusions, "<span class=\"good-word\">holds in all</span>"));
  EXPECT_TRUE(says(conclusions, "<span class=\"poor-word\">depends on the variant</span>"));
  // Forty events, every second one of a kind; the last but one at 0.1 + 38/127.5 = 0.3980 s.
  const std::string events = chatter_event_table(c.limit_cycle);
  EXPECT_TRUE(says(events, "entry strip slack</th><td class=\"num\">0.1000</td><td class=\"num\">0.3980</td>"
                           "<td class=\"num\">20</td>"))
      << events;
  const ChatterData data = read_chatter(read_run(sample::run_with_chatter()));
  EXPECT_TRUE(says(chatter_tandem_table(*data.tandem), "17.44 <span class=\"deviation\">(+2.0\u00a0%)"));
  EXPECT_TRUE(says(chatter_tandem_table(*data.tandem), "stand 2 alone</th><td class=\"num\">18.00 <span"));
}

// Speeds 5 .. 30 m/s on 64 .. 380 px, tension 50 .. 150 % on 290 .. 40 px.
TEST(ChatterMap, CellsBoundaryAndWorkingPointInTheirPlaces)
{
  const report::Run run    = read_run(sample::run_with_chatter());
  const ChatterCondition c = read_chatter(run).conditions[0];
  const std::string map    = chatter_map(run, c, "tension");
  const std::regex point("<circle class=\"point\" cx=\"([0-9.]+)\" cy=\"([0-9.]+)\"");
  std::smatch match;
  ASSERT_TRUE(std::regex_search(map, match, point));
  EXPECT_TRUE(near(std::stod(match[1]), 64 + 316 * 12.5 / 25,
                   within(0.01 / 222, "17.5 m/s; coordinates have two decimals")));
  EXPECT_TRUE(near(std::stod(match[2]), 165, within(0.01 / 165, "100 %; coordinates have two decimals")));
  // The line between stable and unstable: 19 m/s at 50 %, and one point less since the last has no crossing.
  const std::regex line("<polyline class=\"pen boundary\" points=\"([^\"]*)\"");
  ASSERT_TRUE(std::regex_search(map, match, line));
  const std::string points = match[1];
  EXPECT_EQ(count(points, ","), 10);
  std::istringstream first(points);
  double x = 0, y = 0;
  char comma = 0;
  first >> x >> comma >> y;
  EXPECT_TRUE(near(x, 64 + 316 * 14. / 25, within(0.01 / 241, "coordinates have two decimals")));
  EXPECT_TRUE(near(y, 290, within(0.01 / 290, "coordinates have two decimals")));
  // Cells begin behind the first column, which has no bite, and change colour at the boundary: 1.5 (v - v_c).
  const std::regex cell("<rect class=\"growth s([0-7])\" x=\"([0-9.]+)\" y=\"([0-9.]+)\" width=\"([0-9.]+)\"");
  int cells = 0;
  for (std::sregex_iterator match(map.begin(), map.end(), cell), end; match != end; ++match) {
    const double left = std::stod((*match)[2]), right = left + std::stod((*match)[4]);
    if (left > 380)
      continue;  // the scale
    ++cells;
    EXPECT_GE(left, 64 + 316 * 0.5 / 25 - 0.01);
    const double tension = 150 - (std::stod((*match)[3]) - 40) / 250 * 100,
                 middle  = 5 + ((left + right) / 2 - 64) / 316 * 25;
    const bool unstable  = (*match)[1].str()[0] >= '4';
    if (std::abs(middle - sample::chatter_boundary(tension)) > 1.5) {
      EXPECT_EQ(unstable, middle > sample::chatter_boundary(tension)) << tension << " %, " << middle << " m/s";
    }
  }
  EXPECT_GE(cells, 11 * 5);
  // The oil is stored in Pa s and shown in mPa s.
  const std::string viscosity = chatter_map(run, c, "viscosity");
  EXPECT_TRUE(says(viscosity, "viscosity of the oil [mPa s]"));
  EXPECT_TRUE(says(viscosity, "works here"));
}

TEST(ChatterMap, ATableThatIsNoGridDrawsNothing)
{
  report::Run run          = read_run(sample::run_with_chatter());
  const ChatterCondition c = read_chatter(run).conditions[0];
  Table &table             = run.tables.at("curves/chatter-2-map-tension");
  for (Eigen::VectorXd &column : table.columns)
    column.conservativeResize(column.size() - 1);
  EXPECT_EQ(chatter_map(run, c, "tension"), "");
  EXPECT_EQ(chatter_map(run, c, "width"), "");
}

// The strongest first, by the larger of both changes; what no change moves is left out.
TEST(ChatterTornado, OrderNotesAndBars)
{
  const ChatterCondition c = condition_with(sample::chatter_json("2"));
  const std::string speed  = tornado_of_speed(c);
  const std::size_t first = speed.find("entry thickness"), second = speed.find("lower backup roll, mass"),
                    third = speed.find("viscosity of the oil");
  EXPECT_LT(first, second);
  EXPECT_LT(second, third);
  EXPECT_NE(third, std::string::npos);
  EXPECT_TRUE(says(speed, "curved: both one way"));
  EXPECT_TRUE(says(speed, "no crossing at \u221210 %"));
  EXPECT_EQ(count(speed, "class=\"bar pale\""), 1 + 2) << "legend and two changes that were found";
  EXPECT_EQ(count(speed, "class=\"bar dark\""), 1 + 3);
  const std::string friction = tornado_of_friction(c);
  EXPECT_FALSE(says(friction, "mass")) << "a mass does not move the friction";
  EXPECT_LT(friction.find("entry thickness"), friction.find("viscosity of the oil"));
  EXPECT_EQ(tornado_of_speed(ChatterCondition{}), "");
}

TEST(ChatterPhases, ArrowsAndLabels)
{
  ChatterPhases phases{128, 0.5, 90, -60.7, -61, 179.99, {}};
  const std::string drawing = chatter_phasors(phases);
  const auto labels         = texts_of(drawing, "t");
  ASSERT_EQ(labels.size(), 5u);
  for (std::size_t i = 0; i < labels.size(); ++i)
    for (std::size_t j = i + 1; j < labels.size(); ++j)
      if (labels[i].anchor == labels[j].anchor)
        EXPECT_GE(std::abs(labels[i].y - labels[j].y), 17.9) << labels[i].content << ", " << labels[j].content;
  EXPECT_TRUE(says(drawing, "force +90.0\u00b0"));
  EXPECT_TRUE(says(drawing, "friction 180.0\u00b0"));
  EXPECT_TRUE(says(drawing, "back tension \u221260.7\u00b0"));
  // A quarter of a turn ahead points upwards from the middle (270, 172).
  EXPECT_TRUE(says(drawing, "<polygon class=\"head warm\" points=\"270,54 "));
  EXPECT_EQ(chatter_phasors(ChatterPhases{}), "");
}

// Phase 0 is away from the strip while the gap opens: up for the upper roll, down for the lower one.
TEST(ChatterPhases, DirectionsAtTheStand)
{
  const std::string in_phase = chatter_shape({{"upper work roll", 2, 0}, {"lower work roll", 4, 0}}, "Mode");
  const std::regex head("<polygon class=\"head dark\" points=\"220,([0-9.]+) ");
  std::vector<double> tips;
  for (std::sregex_iterator match(in_phase.begin(), in_phase.end(), head), end; match != end; ++match)
    tips.push_back(std::stod((*match)[1]));
  ASSERT_EQ(tips.size(), 2u);
  EXPECT_LT(tips[0], 34 + 22);
  EXPECT_GT(tips[1], 34 + 44 + 22);
  EXPECT_TRUE(says(in_phase, ">0.50, 0.0\u00b0<")) << in_phase;
  EXPECT_TRUE(says(in_phase, "strip-line"));
  EXPECT_TRUE(says(chatter_shape({{"upper work roll", 1, 180}}, "Mode"), "head warm"));
  EXPECT_EQ(chatter_shape({{"upper work roll", 0, 0}}, "Mode"), "");
  EXPECT_EQ(chatter_shape({}, "Mode"), "");
}

TEST(ChatterCurves, MarksZeroLineAndWindow)
{
  const report::Run run    = read_run(sample::run_with_chatter());
  const ChatterCondition c = read_chatter(run).conditions[0];
  const std::string growth = chatter_growth(run, c, 510);
  EXPECT_TRUE(says(growth, "working 17.50"));
  EXPECT_TRUE(says(growth, "critical 18.00"));
  EXPECT_TRUE(says(growth, "pen pale"));
  const std::string locus = chatter_locus(run, c);
  EXPECT_TRUE(says(locus, "18.00 m/s, 128.0 Hz"));
  EXPECT_TRUE(says(locus, "dot shade-5"));
  EXPECT_FALSE(says(locus, "1400")) << "a mode damped that much would press the others on one line";
  EXPECT_TRUE(says(chatter_tandem_growth(run, *read_chatter(run).tandem), "tension alone"));
}

TEST(ChatterCurves, UnitsOfTheMill)
{
  EXPECT_DOUBLE_EQ(factor_between("MN s/m", "kN s/m"), 1e3);
  EXPECT_DOUBLE_EQ(factor_between("N s/m", "MN s/m"), 1e-6);
  EXPECT_DOUBLE_EQ(factor_between("Pa s", "mPa s"), 1e3);
  EXPECT_TRUE(std::isnan(factor_between("Pa s", "Pa")));
}
