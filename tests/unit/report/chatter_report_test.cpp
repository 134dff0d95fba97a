#include "report/chatter/figures.h"
#include "report/front/html.h"
#include "report/page/curves.h"
#include "report/results/names.h"
#include "tests/support/html_page.h"
#include "tests/support/sample_chatter.h"
#include <gtest/gtest.h>
#include <regex>

using namespace mill;
using namespace mill::report;
using nlohmann::ordered_json;
namespace fs = std::filesystem;

namespace {
}  // namespace

TEST(ReadChatter, NumbersTextsAndGaps)
{
  const report::Run run  = read_run(sample::run_with_chatter());
  const ChatterData data = read_chatter(run);
  EXPECT_TRUE(data.problems.empty());
  ASSERT_EQ(data.conditions.size(), 2u);
  const ChatterCondition &c = data.conditions[0];
  EXPECT_EQ(c.name, "2");
  EXPECT_EQ(c.speed, 17.5);
  EXPECT_EQ(c.critical.verdict, "crossing");
  EXPECT_EQ(c.critical.growth_at_working, -0.75);
  EXPECT_EQ(c.critical.searched[1], 30);
  EXPECT_TRUE(std::isnan(c.critical.margin));
  ASSERT_EQ(c.histories.size(), 3u);
  EXPECT_EQ(c.histories[2].file, "response/chatter-2-above");
  EXPECT_TRUE(c.limit_cycle.settled);
  EXPECT_EQ(c.limit_cycle.events.size(), 40u);
  EXPECT_EQ(c.phases.shape.size(), 6u);
  ASSERT_EQ(c.sensitivities.size(), 3u);
  EXPECT_FALSE(c.sensitivities[1].monotone);
  EXPECT_TRUE(std::isnan(c.sensitivities[2].lowered.critical_speed));
  EXPECT_TRUE(std::isnan(c.structures[1].critical_speed));
  ASSERT_TRUE(data.tandem);
  EXPECT_EQ(data.tandem->sentences.size(), 1u);
  EXPECT_EQ(data.tandem->single.size(), 2u);
  // The second has tables and no JSON.
  EXPECT_EQ(data.conditions[1].name, "10");
  EXPECT_TRUE(std::isnan(data.conditions[1].critical.speed));
  EXPECT_NE(stored_curve(run, curve::chatter_speed, data.conditions[1].slug), nullptr);
  EXPECT_NE(stored_curve(run, curve::chatter_locus, data.conditions[1].slug), nullptr);
  EXPECT_EQ(stored_curve(run, curve::chatter_map, data.conditions[1].slug, "tension"), nullptr);
}

// As the results have them; what has no result comes after them, numbers as numbers.
TEST(ReadChatter, OrderOfTheConditions)
{
  const fs::path run = sample::run_with_chatter();
  for (const char *name : {"9", "thin", "10"})
    std::ofstream(run / "curves" / ("chatter-" + std::string(name) + ".json"))
        << sample::chatter_json(name).dump();
  std::vector<std::string> names;
  for (const ChatterCondition &condition : read_chatter(read_run(run.string())).conditions)
    names.push_back(condition.name);
  EXPECT_EQ(names, (std::vector<std::string>{"2", "9", "10", "thin"}));
}

TEST(ReadChatter, AFileThatIsNoneIsSaidAndNotThrown)
{
  for (const char *text : {"{\"condition\": ", "[1, 2]", "", "7"}) {
    const fs::path run = sample::run_with_chatter();
    std::ofstream(run / "curves" / "chatter-2.json") << text;
    std::string html;
    ASSERT_NO_THROW(html = html_report(run.string())) << text;
    EXPECT_TRUE(says(html, "curves/chatter-2.json is not what this program writes, so what it holds is not shown; "
                           "run the case again."))
        << text;
    EXPECT_TRUE(says(html, "Growth rate of the least stable mode")) << "its tables are still drawn";
    expect_sound(html, text);
  }
}

TEST(ChatterReport, EveryFigureAndTableIsThere)
{
  const std::string html = html_report(sample::run_with_chatter());
  for (const char *title : {"Growth rate of the least stable mode",
                            "Frequency of the least stable mode",
                            "Modes in the plane of",
                            "Damping by strip and bite",
                            ">Friction<",
                            ">Oil film<",
                            ">Rolling force<",
                            "Speed and reduction",
                            "Speed and tension",
                            "Speed and viscosity",
                            "Below the critical speed, 17.80 m/s",
                            "At the critical speed, 18.00 m/s",
                            "Above the critical speed, 18.20 m/s",
                            ">Phases<",
                            "Eight periods",
                            "Critical mode at the stand",
                            "Gap, last three periods",
                            "Tensions, last three periods",
                            "Events of the nonlinear motion",
                            ">Critical speed<",
                            "Friction at the working speed",
                            "The linearisation of the bite",
                            "Variants of the data",
                            "Conclusions that these variants share",
                            "by models of growing detail",
                            "Stands in tandem: 1, 2",
                            "Critical mode of all stands",
                            "Compared with published and measured"})
    EXPECT_EQ(count(html, title) > 0, true) << title;
  expect_sound(html, "whole page");
  EXPECT_EQ(count(html, "class=\"absent\""), 0);
  EXPECT_FALSE(says(html, "Roll bite")) << "the bite is a part of the section on chatter";
  EXPECT_FALSE(says(html, "Roll contact"));
  EXPECT_TRUE(says(html, "href=\"#chatter\""));
  EXPECT_LT(html.size(), 2000000u) << "a report is mailed";
}

// A figure without a unit cannot be used.
TEST(ChatterReport, EveryFigureNamesItsUnits)
{
  const std::string html = html_report(sample::run_with_chatter());
  int drawings           = 0;
  for (const std::string &svg : elements(html, "svg role")) {
    ++drawings;
    const std::regex unit("<text class=\"axis\"[^>]*>[^<]*\\[[^\\]<]+\\][^<]*</text>");
    EXPECT_TRUE(std::regex_search(svg, unit)) << svg.substr(0, 200);
  }
  EXPECT_GE(drawings, 25);
}

TEST(ChatterReport, TextsOfFilesAreEscaped)
{
  const std::string html = html_report(sample::run_with_chatter());
  EXPECT_TRUE(says(html, "unstable above &lt;128 Hz&gt;"));
  EXPECT_TRUE(says(html, "a &lt;note&gt;"));
  EXPECT_TRUE(says(html, "B &amp; more"));
  EXPECT_FALSE(says(html, "a <note>"));
}

TEST(ChatterReport, NamesAreEscapedOnce)
{
  const fs::path run  = sample::run_with_chatter();
  const fs::path file = run / "curves" / "chatter-2.json";
  auto json           = nlohmann::ordered_json::parse(std::ifstream(file));
  json["condition"]   = "2 & <b>";
  std::ofstream(file) << json.dump();
  const std::string html = html_report(run.string());
  EXPECT_TRUE(says(html, "Condition 2 &amp; &lt;b&gt;</h3>"));
  expect_sound(html, "a name with marks");
}

TEST(ChatterReport, EveryFileMayBeMissing)
{
  const fs::path run = sample::run_with_chatter();
  std::vector<fs::path> files;
  for (const char *folder : {"curves", "response"})
    for (const auto &file : fs::directory_iterator(run / folder))
      files.push_back(file.path());
  EXPECT_EQ(files.size(), 2u + 6 + 1 + 4 + 4 + 3u);
  for (const fs::path &file : files) {
    const fs::path kept = file.string() + ".kept";
    fs::rename(file, kept);
    std::string html;
    EXPECT_NO_THROW(html = html_report(run.string())) << file;
    expect_sound(html, file.string());
    fs::rename(kept, file);
  }
  for (const fs::path &file : files)
    fs::remove(file);
  const std::string html = html_report(run.string());
  EXPECT_TRUE(says(html, "Figures on chatter are left out: this run stored no <code>curves/chatter-*</code>."));
  expect_sound(html, "nothing stored");
}

TEST(ChatterReport, NumbersThatWereNotStored)
{
  const fs::path run = sample::run_with_chatter();
  ordered_json json = sample::chatter_json("2"), tandem = sample::chatter_tandem_json();
  make_null(json);
  make_null(tandem);
  std::ofstream(run / "curves" / "chatter-2.json") << json.dump();
  std::ofstream(run / "curves" / "chatter-tandem.json") << tandem.dump();
  expect_sound(html_report(run.string()), "nulls");
  std::ofstream(run / "curves" / "chatter-2.json") << "{\"critical\": 7, \"histories\": {}, \"phases\": []}";
  expect_sound(html_report(run.string()), "entries of other types");
}

// A stand whose other stages ran before: the section stands between theirs, the masses keep theirs.
TEST(ChatterReport, FourHighRunWithChatter)
{
  const fs::path run = write_sample_run();
  EXPECT_FALSE(says(html_report(run.string()), "id=\"chatter\""));
  sample::write_chatter(run);
  const std::string html = html_report(run.string());
  EXPECT_EQ(count(html, "id=\"chatter\""), 1);
  EXPECT_EQ(count(html, "id=\"modes\""), 1);
  expect_sound(html, "four-high");
  EXPECT_LT(html.size(), 2000000u);
}

TEST(ChatterReport, TilesGroupsAndNames)
{
  const report::Run run = read_run(sample::run_with_chatter());
  const auto groups     = short_groups(run);
  ASSERT_EQ(groups.size(), 2u);
  EXPECT_EQ(groups[0].title, "Chatter, condition 2");
  EXPECT_EQ(groups[0].results.size(), 3u) << "variants have a table of their own";
  EXPECT_EQ(groups[1].title, "Bite, condition 2");
  const std::string html = html_page(run);
  EXPECT_TRUE(says(html, "<span>critical speed</span><b>18")) << "the only condition";
  EXPECT_TRUE(says(html, "128 Hz")) << "in the verdict";
  EXPECT_TRUE(says(html, "<code>chatter.2.variant.C.critical_speed</code>"));
  EXPECT_EQ(meaning_of("chatter.2.critical_speed"), "chatter, 2, roll speed at which vibration begins to grow");
  EXPECT_EQ(meaning_of("chatter.2.frequency"), "chatter, 2, frequency of the critical mode");
  EXPECT_FALSE(says(html, "speed_slope.oil")) << "45 inputs of every condition are a chart and no table";
  EXPECT_TRUE(says(html, "Slopes by single inputs"));
  EXPECT_EQ(meaning_of("chatter.2.speed_slope.oil.viscosity"),
            "chatter, 2, relative change of the critical speed per relative change of oil.viscosity");
  EXPECT_EQ(meaning_of("chatter.tandem.frequency"), "chatter, tandem, frequency of the critical mode");
  EXPECT_EQ(meaning_of("bite.2.F.gap_rate"), "bite, 2, roll force, derivative by opening rate of the gap");
  EXPECT_EQ(meaning_of("bite.2.force"), "bite, 2, roll force");
  EXPECT_EQ(meaning_of("chatter.2.variant.D36.critical_speed"),
            "chatter, 2, variant D36, roll speed at which vibration begins to grow");
}
