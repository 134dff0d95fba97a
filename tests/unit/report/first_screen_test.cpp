#include "core/model/material.h"
#include "core/records/result_names.h"
#include "report/page/sections.h"
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

using namespace mill::report;
using mill::not_given;

namespace {
Result result(const char *name, const double value, const char *unit,
              const mill::OperatingPoint &operating_point = {}, const double error = 0.01)
{
  Result r{};
  r.name           = name;
  r.value          = value;
  r.unit           = unit;
  r.source         = "computed: test";
  r.at             = operating_point.text();
  r.at_values      = operating_point.values();
  r.error_estimate = error;
  return r;
}

// As a run writes it: the name, what decided, the model.
Result mode(const std::string &key, const std::string &name, const double frequency)
{
  Result r = result(("mode." + key + ".frequency").c_str(), frequency, "Hz");
  r.source = "computed: " + name + ": K3 60 % of the strain energy; six masses";
  return r;
}

Run four_high()
{
  Run run;
  run.case_name     = "stand";
  run.status        = "ok";
  run.manifest.kind = mill::KindOfCase::four_high;
  run.results       = {result("M1", 9000, "kg"),
                       result("stand.modulus.tangent", 4.5e9, "N/m", mill::operating_point_of("10 MN")),
                       result("stand.modulus.kiss", 5.0e9, "N/m", mill::operating_point_of("10 MN")),
                       mode("frame_upper", "frame, upper", 60),
                       mode("gap_second_kind", "gap mode, second kind (fifth octave)", 620),
                       mode("gap_first_kind", "gap mode, first kind (third octave)", 128)};
  return run;
}

bool says(const std::string &html, const std::string &text)
{
  return html.find(text) != std::string::npos;
}
}  // namespace

TEST(FirstScreen, HasOneCardForEachGapModeAndTheModulus)
{
  mill::report::Run run = four_high();
  run.results.push_back(result("open.mode.gap_first_kind.frequency", 96, "Hz"));
  const std::string html = first_screen(run);
  EXPECT_TRUE(says(html, "<div class=\"verdict ok\"><p><b>Finished.</b></p></div>")) << html;
  const auto tile = [&](const std::string &name) { return html.find("<span>" + name + "</span>"); };
  EXPECT_LT(tile("gap mode, first kind (third octave)"), tile("gap mode, second kind (fifth octave)"));
  EXPECT_LT(tile("gap mode, second kind (fifth octave)"), tile("mill modulus with strip"));
  EXPECT_TRUE(says(html, "open stand 96.0\u00a0Hz")) << html;
  EXPECT_TRUE(says(html, "rolls touching 5000\u00a0kN/mm")) << html;
  EXPECT_EQ(tile("frame, upper"), std::string::npos) << "no gap mode";
}

TEST(FirstScreen, BeginsWithTheVerdictOfTheWorstPass)
{
  mill::report::Run run = four_high();
  mill::SpeedVerdict v;
  v.finding           = mill::SpeedFinding::below;
  v.pass              = "stand 5";
  v.speed             = 16;
  v.critical          = 18.9;
  v.low               = 15;
  v.high              = 23;
  v.range             = {1, 30};
  v.mode              = "gap mode at 107 Hz (third octave)";
  v.frequency         = 107;
  v.damping           = 0.004;
  run.manifest.speeds = {v};
  run.results.push_back(result("chatter.stand 5.gap_mode_frequency", 126, "Hz"));
  const std::string html = first_screen(run);
  EXPECT_TRUE(
      says(html, "<div class=\"verdict warnings\"><p><b>At 16.0 m/s, 15 % below the critical speed of 18.9 m/s "
                 "(15 to 23); the gap mode at 107 Hz (third octave) becomes unstable first.</b> The working speed "
                 "lies in the interval. </p>"))
      << html;
  EXPECT_TRUE(says(html, "class=\"card fair\" title=\"95 % interval\"")) << html;
  run.manifest.speeds[0].low = 16.5;
  EXPECT_TRUE(says(first_screen(run), "<div class=\"verdict ok\"><p><b>At 16.0 m/s, 15 %"));
  EXPECT_TRUE(says(first_screen(run), "class=\"card\" title=\"95 % interval\""));
  EXPECT_TRUE(
      says(html, "<span>critical speed</span><b>18.9</b> m/s<small>15 to 23; margin 15 % at 16.0 m/s</small>"))
      << html;
  EXPECT_TRUE(says(html, "damping 0.40 % at 16.0 m/s")) << html;
  v.pass    = "stand 4";
  v.finding = mill::SpeedFinding::not_searched;
  v.missing = {"pass.speed"};
  run.manifest.speeds.push_back(v);
  EXPECT_TRUE(says(first_screen(run), "<b>stand 5: At 16.0 m/s, 15 %"));
  run.manifest.speeds = {v};
  EXPECT_TRUE(says(first_screen(run), "<b>Critical speed not searched: pass.speed is not given.</b>"));
  EXPECT_FALSE(says(first_screen(run), "<span>critical speed"));
}

TEST(FirstScreen, StatesTheRangeThatHasNoCriticalSpeed)
{
  mill::report::Run run = four_high();
  mill::SpeedVerdict v;
  v.finding           = mill::SpeedFinding::stable;
  v.pass              = "1";
  v.speed             = 16;
  v.growth            = -2.4e-5;
  v.range             = {1, 30};
  v.mode              = "gap mode at 126 Hz (third octave)";
  run.manifest.speeds = {v};
  EXPECT_TRUE(says(first_screen(run), "<span>critical speed</span><b>none</b> <small>from 1 to 30 m/s</small>"))
      << first_screen(run);
  v.finding           = mill::SpeedFinding::unstable;
  run.manifest.speeds = {v};
  EXPECT_TRUE(says(first_screen(run), "card bad")) << first_screen(run);
  EXPECT_TRUE(says(first_screen(run), "<b>unstable</b>"));
}

// Between 12.1 and 12.4 m/s the bite had no answer, and the critical speed lies there: it is not said to be
// absent.
TEST(FirstScreen, StatesTheGapThatHidesACriticalSpeed)
{
  mill::SpeedVerdict v;
  v.finding = mill::SpeedFinding::stable;
  v.speed   = 10;
  v.range   = {1, 30};
  v.gap     = {12.1, 12.4};
  v.mode    = "gap mode at 107 Hz";
  EXPECT_EQ(sentence_of(v),
            "At 10.0 m/s, stable; the critical speed lies between 12.100 and 12.400 m/s, where the "
            "search has no answer; the gap mode at 107 Hz has the least damping.");
  v.finding = mill::SpeedFinding::unstable;
  v.speed   = 16;
  EXPECT_EQ(sentence_of(v), "Unstable: the gap mode at 107 Hz grows at 16.0 m/s; the critical speed lies between "
                            "12.100 and 12.400 m/s, where the search has no answer.");
  EXPECT_EQ(sentence_of(mill::speed_verdict_of(json_of(v))), sentence_of(v));
  mill::report::Run run = four_high();
  run.manifest.speeds   = {v};
  EXPECT_TRUE(says(first_screen(run), "<span>critical speed</span><b>12.100 to 12.400</b> m/s"))
      << first_screen(run);
  EXPECT_TRUE(says(first_screen(run), "card bad"));
}

TEST(FirstScreen, BeginsAWarningWithACapitalAndLeavesKeysAsTheyAre)
{
  mill::report::Run run  = four_high();
  run.manifest.passes    = {PassInfo{"p", "p", not_given, true, mill::ForceMeaning::measured}};
  using Id               = mill::WarningId;
  run.warnings           = {{Id::bite_angle, "bite of pass 1", "the content of the force ends early"},
                            {Id::force_band, "p", "nothing was simulated"},
                            {Id::output_rate, "", "output_rate = 20 kHz gives 5.44 points per period of the highest mode",
                             "", "raise it"},
                            {Id::value_doubtful, "", "strip.width is not known"}};
  const std::string html = first_screen(run);
  EXPECT_TRUE(says(html, "<li data-id=\"bite-angle\">Bite of pass 1: the content")) << html;
  EXPECT_TRUE(says(html, "<summary>output_rate = 20 kHz"));
  EXPECT_TRUE(says(html, "<li data-id=\"value-doubtful\">strip.width"));
  EXPECT_TRUE(says(html, "<li data-id=\"force-band\">p: nothing"));
}

// The mode that chatter finds in the gap is not always the one of the card.
TEST(FirstScreen, StatesADampingOnlyForTheModeThatHasIt)
{
  mill::report::Run run = four_high();
  mill::SpeedVerdict v;
  v.finding           = mill::SpeedFinding::stable;
  v.pass              = "1";
  v.speed             = 16;
  v.damping           = 0.004;
  run.manifest.speeds = {v};
  run.results.push_back(result("chatter.1.gap_mode_frequency", 300, "Hz"));
  EXPECT_TRUE(says(first_screen(run), "six masses</small>")) << first_screen(run);
  EXPECT_FALSE(says(first_screen(run), "damping 0.40"));
}

TEST(FirstScreen, TheWorstConditionGivesTheVerdict)
{
  mill::report::Run run = four_high();
  run.results.push_back(result("chatter.1.growth_rate", -3, "1/s", mill::operating_point_of("20 m/s")));
  run.results.push_back(result("chatter.1.critical_speed", 25, "m/s", mill::operating_point_of("25 m/s")));
  run.results.push_back(result("chatter.2.growth_rate", -1, "1/s", mill::operating_point_of("20 m/s")));
  run.results.push_back(result("chatter.2.critical_speed", 21, "m/s", mill::operating_point_of("21 m/s")));
  run.results.push_back(result("chatter.2.frequency", 107.2, "Hz"));
  std::string html = first_screen(run);
  EXPECT_TRUE(says(html,
                   "<b>pass 2: At 20.0 m/s, 4.8 % below the critical speed of 21 m/s; the mode at 107 Hz becomes "
                   "unstable first.</b>"))
      << html;
  EXPECT_TRUE(says(html, "card fair")) << "a margin below a tenth";
  run.results.push_back(result("chatter.3.growth_rate", 2, "1/s", mill::operating_point_of("20 m/s")));
  run.results.push_back(result("chatter.3.critical_speed", 18, "m/s", mill::operating_point_of("18 m/s")));
  html = first_screen(run);
  EXPECT_TRUE(says(html,
                   "verdict failed\"><p><b>pass 3: Unstable: 20.0 m/s is 11 % above the critical speed of 18 m/s; "
                   "the least damped mode becomes unstable first.</b>"))
      << html;
}

TEST(FirstScreen, ShowsTheBiteThatDisagreesMostWithItsForce)
{
  mill::report::Run run = four_high();
  for (const auto &[pass, force] : {std::pair("pass 1", 0.9e6), {"pass 2", 0.74e6}, {"pass 3", 0.5e6}}) {
    run.results.push_back(result((std::string("bite.") + pass + ".force").c_str(), 1e6, "N"));
    run.results.back().checks = {
        {"the mean of the recorded force", force, std::string(pass) == "pass 3" ? "" : mill::force_remedy}};
  }
  const std::string html = first_screen(run);
  EXPECT_TRUE(says(html, "<span>force of the bite against the mean of the recorded force, pass 2</span><b>+35.1"))
      << html;
  EXPECT_TRUE(says(html, "1000 kN against 740 kN; bite.fit = [&quot;force&quot;]")) << html;
  EXPECT_FALSE(says(html, ", pass 1</span>")) << "the worst pass only";
}

// Half of the users run the program for these numbers.
TEST(FirstScreen, ShowsTheChainInNumbersWithErrorAndOrigin)
{
  mill::report::Run run = four_high();
  run.results.push_back(result("K1", 6.3e9, "N/m", {}, not_given));
  run.results.back().source = "given";
  run.results.push_back(result("K3.tangent", 3.995e10, "N/m", mill::operating_point_of("10 MN"), 0.0077));
  run.results.push_back(result("K4.combined", 2.26e8, "N/m", mill::operating_point_of("10 MN"), 0.1));
  run.results.back().estimated = {"strip.friction"};
  run.results.back().inputs    = {"strip.friction", "strip.width"};
  run.results.push_back(result("Kzc1.tangent", 5.11e10, "N/m", mill::operating_point_of("10 MN"), 0.033));
  const std::string html = first_screen(run), table = html.substr(html.find("<div class=\"chain\">"));
  EXPECT_TRUE(says(table, "K1</th><td class=\"num\"><b>6300</b></td><td>kN/mm</td><td class=\"num\">\u2013</td>"
                          "<td>given</td>"))
      << table;
  EXPECT_TRUE(says(
      table, "K3</th><td class=\"num\"><b>39\u202f950</b></td><td>kN/mm</td><td class=\"num\">\u00b10.77\u00a0%"
             "</td><td>computed</td>"));
  EXPECT_TRUE(says(table, "\u00b110\u00a0%</td><td>partly estimated</td>"));
  EXPECT_LT(table.find("K4</th>"), table.find("M1</th>"));
  EXPECT_LT(table.find("M1</th>"), table.find("Kzc1</th>"));
}

// A level that comes from a made record says nothing about the mill.
TEST(FirstScreen, LevelsOfSyntheticForcesAreNotShown)
{
  mill::report::Run run = four_high();
  run.manifest.passes   = {{"pass 1", "pass-1", 1e7, true, mill::ForceMeaning::measured},
                           {"pass 2", "pass-2", 1e7, false, mill::ForceMeaning::measured}};
  run.results.push_back(result("pass 1.peak_g.upper_work_roll", 90, "m/s2"));
  run.results.push_back(result("pass 2.peak_g.upper_work_roll", 5, "m/s2"));
  run.results.push_back(result("pass 2.peak_g.lower_work_roll", 8, "m/s2"));
  const std::string html = first_screen(run);
  EXPECT_TRUE(says(html, "<span>largest level, lower work roll, pass 2</span><b>0.82</b> g")) << html;
  EXPECT_FALSE(says(html, "pass 1"));
}

TEST(FirstScreen, ShowsFiveWarningsAndFoldsTheRest)
{
  mill::report::Run run = four_high();
  for (int i = 1; i <= 7; ++i)
    run.warnings.push_back({mill::WarningId::bearing_arrangement,
                            "",
                            "fact number " + std::to_string(i) + " says what it is about; in two parts",
                            "what follows from it",
                            "what to do about it",
                            {},
                            "bearing.trb.arrangement",
                            {"case.toml", 12, 3}});
  const std::string html = first_screen(run);
  EXPECT_TRUE(says(html, "<summary>Fact number 5 says what it is about; in two parts</summary>"
                         "<div>What follows from it</div><div>What to do about it</div>"
                         "<div class=\"place\"><code>bearing.trb.arrangement</code>, line 12</div>"))
      << html;
  EXPECT_TRUE(says(html, "<summary>2 more</summary>"));
  EXPECT_LT(html.find("<summary>2 more</summary>"), html.find("Fact number 6"));
}

TEST(FirstScreen, EstimatesAreFoldedWithTheirEffect)
{
  mill::report::Run run = four_high();
  EXPECT_FALSE(says(first_screen(run), "estimated"));
  run.estimates = {
      {"frame.upper_post_stiffness", 6e10, 4e10, 8e10, "N/m", "rule of thumb", {{"K1", 0.2}, {"f1", -0.05}}}};
  const std::string html = first_screen(run);
  EXPECT_TRUE(says(html, "1 value is estimated; frame.upper_post_stiffness costs most accuracy")) << html;
  EXPECT_TRUE(says(html, "<td>K1 \u00b120\u00a0%</td><td>rule of thumb</td>")) << html;
  EXPECT_TRUE(says(html, "40\u202f000 .. 80\u202f000"));
}

TEST(StandToScale, DrawsHousingAndScrewdownWhereTheyAreGiven)
{
  mill::report::Run run = four_high();
  EXPECT_EQ(stand_to_scale(run), "");
  run.manifest.geometry   = {{"work_roll_diameter", 0.42},  {"work_roll_length", 1.4},
                             {"work_neck_diameter", 0.267}, {"work_total_length", 2.32},
                             {"work_bearing_span", 2.0},    {"backup_diameter", 1.45},
                             {"backup_length", 1.4},        {"backup_neck_diameter", 0.95},
                             {"backup_neck_length", 0.95},  {"backup_bearing_span", 2.45},
                             {"strip_width", 1.0}};
  const std::string rolls = stand_to_scale(run);
  EXPECT_TRUE(says(rolls, "class=\"strip\""));
  EXPECT_FALSE(says(rolls, "class=\"window\""));
  for (const auto &[name, length] : {std::pair("housing_thickness", 0.75),
                                     {"housing_post_width", 0.65},
                                     {"housing_window_width", 1.65},
                                     {"housing_window_height", 5.8},
                                     {"housing_upper_beam_height", 1.3},
                                     {"housing_lower_beam_height", 1.3},
                                     {"screw_diameter", 0.44},
                                     {"screw_length", 0.3}})
    run.manifest.geometry[name] = length;
  const std::string stand = stand_to_scale(run);
  EXPECT_TRUE(says(stand, "class=\"window\""));
  EXPECT_TRUE(says(stand, "[mm]"));
}
