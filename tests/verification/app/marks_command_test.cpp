#include "core/base/files.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

// Marks on the strip as a user meets them.
namespace {
const std::string stand = "cases/four-high-1400.toml";
const std::string asked = " --spacing '50 mm' --speed '300 m/min' -o ";

nlohmann::json values_in(const std::string &folder)
{
  return nlohmann::json::parse(mill::read_text(folder + "/results.json")).at("values");
}

bool holds(const std::string &text, const std::string &part)
{
  return text.find(part) != std::string::npos;
}
}  // namespace

TEST(MarksCommand, TheSpacingIsComparedWithRollsBearingsAndModes)
{
  const std::string folder = scratch("marks"), drawn = MILLSTAND_SOURCE_DIR "/" + stand;
  // In a separate folder: with out/four-high-1400 of a run present, the modes would be those of that run.
  const Outcome run =
      millstand("marks " + drawn + asked + folder + " --side-bands '4 Hz'", scratch("marks-home"), "true");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(holds(run.out, "marks every 50 mm on a strip of 5 m/s: 100 Hz")) << run.out;
  EXPECT_TRUE(holds(run.out, "work-roll bearing, cage")) << run.out;
  EXPECT_TRUE(holds(run.out, "side bands 4 Hz apart")) << run.out;
  EXPECT_TRUE(holds(run.out, "modes are those of closed forms; millstand modes " + drawn + " first")) << run.out;
  const auto all         = values_in(folder);
  const Tolerance closed = within(1e-12, "closed form");
  const auto value       = [&](const char *name) { return all.at(name).at("value").get<double>(); };
  EXPECT_TRUE(near(value("marks.frequency"), 100, closed));
  EXPECT_TRUE(near(value("marks.work_roll.per_turn"), M_PI * 0.420 / 0.050, closed));
  EXPECT_TRUE(near(value("marks.backup_roll.rotation"), 5 / (M_PI * 1.450), closed));
  EXPECT_EQ(all.at("marks.backup_roll.per_turn").at("inputs"),
            nlohmann::json::array({"backup_roll.barrel_diameter"}));
  const auto record = nlohmann::json::parse(mill::read_text(folder + "/curves/marks.json"));
  for (const auto &mode : record.at("modes"))  // a frequency makes this spacing at f times 50 mm
    EXPECT_TRUE(near(value(("marks." + mode.at("key").get<std::string>() + ".speed").c_str()),
                     0.050 * mode.at("frequency").get<double>(), closed));
  EXPECT_GT(record.at("modes").size(), 3u);
  EXPECT_EQ(record.at("maps").size(), 2u);
  const std::string page = mill::read_text(folder + "/report.html");
  EXPECT_TRUE(holds(page, "Marks on the strip"));
  EXPECT_TRUE(holds(page, "magnification over speed and waves around the backup roll"));
}

TEST(MarksCommand, TakesTheModesOfARunOfThisCase)
{
  const std::string model = "cases/published-1400.toml", run_folder = scratch("marks-run");
  const std::string rolls = " --set campbell.work_roll_diameter='420 mm'";
  ASSERT_EQ(millstand("modes " + model + " -q -o " + run_folder + rolls).exit_code, 0);
  const auto modes = values_in(run_folder);
  const Outcome run =
      millstand("marks " + model + asked + scratch("marks-of-run") + rolls + " --run " + run_folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(holds(run.out, "modes of the run in " + run_folder)) << run.out;
  EXPECT_TRUE(holds(run.out, "note: the diameter of the backup roll is not known: it is left out")) << run.out;
  const auto record = nlohmann::json::parse(mill::read_text(scratch("marks-of-run") + "/curves/marks.json"));
  ASSERT_GT(record.at("modes").size(), 0u);
  for (const auto &mode : record.at("modes"))
    EXPECT_EQ(mode.at("frequency"),
              modes.at("mode." + mode.at("key").get<std::string>() + ".frequency").at("value"));
  // The same folder for another case is not such a run.
  const Outcome other = millstand("marks " + model + asked + scratch("marks-other") + rolls + " --run " +
                                  run_folder + " --set given.M1='12 t'");
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_EQ(other.err, "error: --run " + run_folder + ": the run in " + run_folder +
                           " is of other inputs; leave --run out to take modes by closed forms\n");
}

TEST(MarksCommand, RefusalsAreSentences)
{
  const auto message_of = [](const std::string &flags) {
    const Outcome run = millstand("marks " + flags + " -o " + scratch("marks-refused"));
    EXPECT_EQ(run.exit_code, 2) << run.out;
    return run.err;
  };
  EXPECT_EQ(message_of(stand + " --spacing 2 --speed '500 m/min'"),
            "error: --spacing \"2\" has no unit; it takes a number with one of m, mm, um\n");
  EXPECT_EQ(message_of(stand + " --spacing '2,5 mm' --speed '500 m/min'"),
            "error: --spacing \"2,5 mm\" has a comma in its number; write \"2.5 mm\"\n");
  EXPECT_EQ(message_of(stand + " --spacing '1.75 in' --speed '500 m/min'"),
            "error: --spacing \"1.75 in\" is in inches; 1.75 in = 44.45 mm: write \"44.45 mm\"\n");
  EXPECT_EQ(message_of(stand + " --frequency '315 Hz' --speed '1640 fpm'"),
            "error: --speed \"1640 fpm\" is in feet per minute; 1640 fpm = 8.3312 m/s: write \"8.3312 m/s\"\n");
  EXPECT_EQ(message_of(stand + " --frequency '315,5 Hz' --speed '5 m/s'"),
            "error: --frequency \"315,5 Hz\" has a comma in its number; write \"315.5 Hz\"\n");
  EXPECT_EQ(message_of(stand + " --spacing '2 mm' --speed '500 mm'"),
            "error: --speed \"500 mm\" is a length; it takes a number with one of m/s, mm/s, m/min\n");
  EXPECT_EQ(message_of(stand + " --spacing '-2 mm' --speed '5 m/s'"),
            "error: the spacing of the marks must be positive\n");
  EXPECT_EQ(message_of(stand + " --spacing 'two' --speed '5 m/s'"),
            "error: --spacing \"two\" does not begin with a number; it takes a number with one of m, mm, um\n");
  EXPECT_EQ(
      message_of("cases/bearing-266.toml --spacing '2 mm' --speed '5 m/s'"),
      "error: millstand marks: nothing turns in kind = \"bearing\" (cases/bearing-266.toml); it takes cases with "
      "work rolls\n");
  EXPECT_EQ(message_of("cases/published-1400.toml --spacing '2 mm' --speed '5 m/s'"),
            "error: marks: no roll of the case has a diameter, so that no spacing can be laid around it\n");
  EXPECT_TRUE(
      holds(message_of(stand + " --speed '5 m/s'"), "takes either --spacing \"2 mm\" or --frequency \"315 Hz\""));
  EXPECT_TRUE(
      holds(message_of(stand + " --speed '5 m/s' --spacing '2 mm' --frequency '9 Hz'"), "takes either --spacing"));
  EXPECT_TRUE(holds(message_of(stand + " --speed '5 m/s' --frequency '0 Hz'"), "is not above zero"));
}
