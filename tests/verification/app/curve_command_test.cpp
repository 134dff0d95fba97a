#include "core/base/files.h"
#include "core/case/input_reference.h"
#include "core/records/csv.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <nlohmann/json.hpp>

// Contacts on their curves as a user of a lumped model meets them.
namespace {
// Short records: a second holds a hundred periods of the roll contacts.
const std::string on_curves = " --set dynamics.contact=curve --set pass.0.synthetic_duration='1 s'"
                              " --set pass.1.synthetic_duration='1 s'";

// A chain whose roll contacts are line contacts, F (a - b ln F), with the slopes of its K3 and K5 at `load` (N).
std::string case_with_curves(const std::string &name, const double load)
{
  std::string curves = "\n[curve]\n";
  for (const char *spring : {"K3", "K5"}) {
    curves += std::string(spring) + " = [";
    for (int i = 0; i < 12; ++i) {
      const double F = 5e4 * std::pow(60.0, i / 11.0);
      curves += fmt::format("{}[\"{:.6f} kN\", \"{:.9f} um\"]", i == 0 ? "" : ", ", F / 1e3,
                            1e6 * F * (5.3e-11 - 1.9e-12 * std::log(F)));
    }
    curves += "]\n";
  }
  const double K   = 1 / (5.3e-11 - 1.9e-12 * (std::log(load) + 1));
  std::string text = mill::template_of("lumped");
  for (const char *spring : {"\nK3", "\nK5"}) {
    const auto position = text.find(spring);
    EXPECT_NE(position, std::string::npos);
    const auto end = text.find('\n', position + 1);
    text.replace(position, end - position, fmt::format("{} = \"{:.9g} N/m\"", spring, K));
  }
  std::filesystem::create_directories(scratch(name));
  std::ofstream(scratch(name) + "/chain.toml") << text + curves;
  return scratch(name) + "/chain.toml";
}

nlohmann::json json_of(const std::string &path)
{
  return nlohmann::json::parse(mill::read_text(path));
}
}  // namespace

TEST(CurveCommand, DrivesALumpedModelOnItsCurves)
{
  const std::string chain = case_with_curves("curves", 976e3), out = scratch("curves") + "/out";
  const auto outcome = millstand("simulate " + chain + " -q -o " + out + on_curves);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto values = json_of(out + "/results.json").at("values");
  int seen          = 0;
  for (const auto &[name, value] : values.items()) {
    if (name.find(".rms_g.") == std::string::npos)
      continue;
    ++seen;
    double linear = NAN, fixed = NAN;
    for (const auto &check : value.at("checks")) {
      if (check.at("name") == "linear springs")
        linear = check.at("value");
      if (check.at("name") == "curves by fixed steps")
        fixed = check.at("value");
    }
    const double curve = value.at("value");
    EXPECT_TRUE(near(curve, fixed, within(1e-3, "fixed steps of 50 us")));
    EXPECT_TRUE(near(curve, linear, within(0.05, "a force that swings by a percent of its mean")));
    EXPECT_NE(curve, linear);
  }
  EXPECT_EQ(seen, 4);
  EXPECT_TRUE(values.contains("nonlinear.pass 1.least_force.K3"));
  const auto record = json_of(out + "/curves/nonlinear-pass-1.json");
  EXPECT_LT(std::abs(record.at("balance").get<double>()), 1e-6);
  EXPECT_EQ(record.at("springs").size(), 2u);
  EXPECT_TRUE(record.at("linear_enough").get<bool>()) << record.at("verdict");
  EXPECT_NE(mill::read_text(out + "/report.html").find("Linear springs were enough at this load"),
            std::string::npos);
  // The model that is written runs to the same levels.
  const std::string again = scratch("curves") + "/again";
  const auto second       = millstand("simulate " + out + "/lumped_model.toml -q -o " + again);
  ASSERT_EQ(second.exit_code, 0) << second.err;
  const auto same = json_of(again + "/results.json").at("values");
  for (const char *level : {"pass 1.rms_g.upper_work_roll", "pass 1.peak_g.lower_work_roll"})
    EXPECT_TRUE(near(same.at(level).at("value").get<double>(), values.at(level).at("value").get<double>(),
                     within(1e-9, "the same curves")));
}

TEST(CurveCommand, ContactsThatPartUnderALargeForceAreReported)
{
  const std::string chain = case_with_curves("parting", 976e3), out = scratch("parting") + "/out";
  const auto outcome = millstand("simulate " + chain + " -q -o " + out + on_curves +
                                 " --set pass.0.synthetic_range='[\"500 kN\", \"1450 kN\"]'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto record = json_of(out + "/curves/nonlinear-pass-1.json");
  EXPECT_FALSE(record.at("linear_enough").get<bool>());
  EXPECT_NE(record.at("verdict").get<std::string>().find("Linear springs were not enough"), std::string::npos);
  const auto events = mill::read_table(out + "/response/pass-1-parted.csv");
  EXPECT_GT(events.column("time")->size(), 10);
  const double scale = record.at("scale_to_part");
  EXPECT_GT(scale, 0.01);
  EXPECT_LT(scale, 1);
}

// A unit follows the curves; matrices cannot, and say so.
TEST(CurveCommand, AUnitContainsTheCurvesAndOtherFormatsWarnOfSlopes)
{
  const std::string chain = case_with_curves("curve-unit", 976e3), out = scratch("curve-unit");
  const auto unit = millstand("export fmu " + chain + " -o " + out + "/chain.fmu" + on_curves);
  ASSERT_EQ(unit.exit_code, 0) << unit.err;
  EXPECT_NE(unit.out.find("chain of six masses; K3, K5 follow their curves from "), std::string::npos) << unit.out;
  EXPECT_EQ(unit.err.find("warning: dynamics.contact"), std::string::npos) << unit.err;
  const auto matrices = millstand("export matlab " + chain + " -q -o " + out + "/chain.m" + on_curves);
  ASSERT_EQ(matrices.exit_code, 0) << matrices.err;
  EXPECT_NE(
      matrices.err.find(
          "warning: dynamics.contact = \"curve\" holds for run, simulate and export fmu with a pass; this model "
          "is linear, with the slopes of the springs at the working load\n"),
      std::string::npos)
      << matrices.err;
}
