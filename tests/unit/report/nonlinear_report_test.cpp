// The chapter of contacts on their curves: what is stored is shown, what is not stays away.
#include "core/records/json_archive.h"
#include "core/records/nonlinear_record.h"
#include "report/page/page.h"
#include "report/page/run.h"
#include "report/page/sections.h"
#include "tests/support/sample_run.h"
#include <fstream>
#include <gtest/gtest.h>

using namespace mill;
using namespace mill::report;

namespace {
NonlinearRecord sample()
{
  NonlinearRecord record;
  record.pass          = "pass 1";
  record.model         = "six-mass chain";
  record.load          = 976.2e3;
  record.force_range   = 8e3;
  record.scale_to_part = 12.34;
  record.verdict       = "Linear springs were enough at this load: <levels>.";
  record.linear_enough = true;
  record.springs.resize(1);
  record.springs[0].name  = "K3";
  record.springs[0].least = 0.877;
  record.rolls.resize(1);
  record.rolls[0] = {"upper work roll", 20, 4, 10, 2, 20, 4};
  NonlinearMode mode;
  mode.number            = 3;
  mode.name              = "third octave, upper stack";
  mode.frequency         = 218.3;
  mode.opens             = "K3";
  mode.mover             = "upper work roll";
  mode.amplitude         = {0, 1e-5, 2e-5};
  mode.followed          = {218.3, 217.9, 215};
  mode.least             = {1, 0.5, 0};
  mode.parting_amplitude = 2e-5;
  mode.bend              = -0.015;
  mode.harmonics         = {9.80665, 0.0980665, 0.00980665};
  record.modes           = {mode};
  return record;
}

std::string section_of(const std::string &folder)
{
  const Run run = read_run(folder);
  Page page(run);
  nonlinear_section(page, run);
  return page.body();
}
}  // namespace

TEST(NonlinearReport, ShowsWhatARunStored)
{
  const std::string folder = write_sample_run();
  EXPECT_EQ(section_of(folder), "");
  const std::string slug = read_run(folder).manifest.passes.at(0).slug;
  std::ofstream(folder + "/curves/nonlinear-" + slug + ".json") << json_of_record(sample());
  const std::string html = section_of(folder);
  for (const char *words : {"Linear springs were enough at this load: &lt;levels&gt;.", "<b>12.3</b> times",
                            "87.7 %", "third octave, upper stack", "\u22121.5", "1.0 %", "+100", "<svg"})
    EXPECT_NE(html.find(words), std::string::npos) << words;
}

TEST(NonlinearReport, AFileOfAnotherProgramIsReported)
{
  const std::string folder = write_sample_run();
  const std::string slug   = read_run(folder).manifest.passes.at(0).slug;
  std::ofstream(folder + "/curves/nonlinear-" + slug + ".json") << "[1, 2";
  EXPECT_NE(section_of(folder).find("is not what this program writes"), std::string::npos);
}
