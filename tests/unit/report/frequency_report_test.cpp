// Frequency response and Campbell diagram as the page shows them.
#include "core/base/files.h"
#include "core/records/json_archive.h"
#include "report/frequency/figures.h"
#include "report/page/sections.h"
#include "report/results/names.h"
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace mill;
using namespace mill::report;

namespace {
bool shows(const std::string &html, const std::string &text)
{
  return html.find(text) != std::string::npos;
}

Table response(const std::vector<std::string> &places)
{
  const Eigen::VectorXd f = Eigen::VectorXd::LinSpaced(50, 20, 1000);
  Table table;
  table.add("frequency", "Hz", f);
  for (const std::string &place : places) {
    table.add(place + "_real", "1/kg", -1e-5 * f.array().sin());
    table.add(place + "_imag", "1/kg", 1e-5 * f.array().cos() + 2e-5);
  }
  return table;
}

Result result(const std::string &name, const double value, const std::string &unit)
{
  Result r{};
  r.name           = name;
  r.value          = value;
  r.unit           = unit;
  r.error_estimate = 0.02;
  return r;
}

report::Run sample()
{
  report::Run run;
  run.manifest.kind                                         = KindOfCase::four_high;
  run.directory                                             = "/nonexistent";
  run.tables["curves/frf-craig-bampton-bite"]               = response({"upper-work-roll", "lower-backup-chock"});
  run.tables["curves/frf-six-mass-bite"]                    = response({"upper-work-roll"});
  run.tables["curves/frf-craig-bampton-lower-backup-chock"] = response({"upper-work-roll", "lower-backup-chock"});
  run.results = {result("M1", 9300, "kg"), result("frf.bite.upper_work_roll.peak", 0.0123, "1/kg"),
                 result("frf.bite.upper_work_roll.frequency", 746.5, "Hz")};
  run.results[1].error_estimate = std::nan("");
  run.results[1].error_lacks    = {"frame.balance_mass_tolerance"};
  return run;
}

CampbellRecord campbell()
{
  CampbellRecord r;
  r.model     = "craig-bampton";
  r.speeds    = {0, 15};
  r.working   = {2, 6};
  r.modes     = {{"gap_first_kind", "gap mode, first kind", 52.5, 0.03}};
  r.lines     = {{"work roll, order 20", "work roll", "work roll", 20, 20 / (M_PI * 0.42)},
                 {"drive, <teeth>", "drive", "work roll", 12, 12 / (M_PI * 0.42)}};
  r.crossings = {{0, 0, 3.464, 0}, {0, 1, 5.773, -0.0}, {0, 7, 5, 0}};
  r.notes     = {"the bearing of the backup rolls has no roller diameter"};
  return r;
}
}  // namespace

TEST(FrequencyReport, ShowsFiguresTableAndTheInputsMissingInTheBand)
{
  const report::Run run = sample();
  EXPECT_EQ(responding_model(run), "craig-bampton");
  EXPECT_EQ(responding_places(run, "craig-bampton"),
            (std::vector<std::string>{"upper work roll", "lower backup chock"}));
  Page page(run);
  frequency_section(page, run);
  for (const char *text :
       {"Frequency response and speeds", "Magnitude, upper work roll", "Phase, upper work roll",
        "acceleration / bite force [(m/s\u00b2)/kN]", "frequency [Hz]", "six masses", "Chocks, force in the bite",
        "<b>12.30</b>", "<b>746</b>", "<code>frame.balance_mass_tolerance</code>", "No Campbell diagram"})
    EXPECT_TRUE(shows(page.body(), text)) << text;
}

TEST(FrequencyReport, IsEmptyWithoutResponses)
{
  report::Run run = sample();
  run.tables.clear();
  Page page(run);
  frequency_section(page, run);
  EXPECT_EQ(page.body(), "");
}

TEST(FrequencyReport, ShowsCampbellDiagramAndCrossings)
{
  const std::string folder =
      (std::filesystem::temp_directory_path() / ("campbell-" + std::to_string(::getpid()))).string();
  std::filesystem::create_directories(folder + "/curves");
  write_atomically(folder + "/curves/campbell.json", json_of_record(campbell()));
  report::Run run = sample();
  run.directory   = folder;
  Page page(run);
  frequency_section(page, run);
  for (const char *text :
       {"speed of the rolls&#39; surface [m/s]", "gap mode, first kind", "working from", "work roll, order 20",
        "drive, &lt;teeth&gt;", "<b>3.46</b>", "inside", "at most 24 of 2", "no roller diameter"})
    EXPECT_TRUE(shows(page.body(), text)) << text;
  write_atomically(folder + "/curves/campbell.json", "{");
  Page broken(run);
  frequency_section(broken, run);
  EXPECT_TRUE(shows(broken.body(), "curves/campbell.json is not what this program writes"));
  std::filesystem::remove_all(folder);
}

TEST(FrequencyReport, ResultsHaveWords)
{
  EXPECT_EQ(meaning_of("frf.bite.upper_work_roll.peak"),
            "accelerance at the upper work roll under a force in the bite, largest magnitude");
  EXPECT_EQ(
      meaning_of("frf.lower_backup_chock.lower_backup_chock.frequency"),
      "accelerance at the lower backup-roll chock under a force on the lower backup-roll chock, frequency of "
      "the largest magnitude");
  EXPECT_EQ(meaning_of("campbell.gap_first_kind.distance"),
            "resonance of mode gap first kind with what turns, distance from the working range");
  EXPECT_EQ(meaning_of("mode.gap_first_kind.frequency"), "mode gap first kind, natural frequency");
  EXPECT_EQ(meaning_of("open.mode.gap_first_kind.gap_share"),
            "open stand, without the strip between the work rolls, mode gap first kind, share of the static "
            "compliance of the gap");
  EXPECT_EQ(meaning_of("open.f3"),
            "open stand, without the strip between the work rolls, natural frequency 3, vertical");
}
