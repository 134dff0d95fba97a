#include "app/stages/stability/uncertain_numbers.h"
#include "core/base/files.h"
#include "core/model/four_high.h"
#include "tests/support/coarse_run.h"
#include "tests/support/near.h"
#include <fmt/format.h>

// The critical speed of a pass as every run of a four-high states it.
namespace {
nlohmann::json json_of(const std::string &path)
{
  return nlohmann::json::parse(mill::read_text(path));
}

double value(const std::string &folder, const std::string &result)
{
  return json_of(folder + "/results.json").at("values").at(result).at("value").get<double>();
}

/// The demo stand with a thin hard strip, so that a speed is critical.
const std::string thin_strip =
    " --set strip.entry_thickness='0.9 mm' --set strip.exit_thickness='0.6 mm' --set strip.friction=0.03"
    " --set strip.flow_stress.k='700 MPa' --set pass.0.entry_tension='160 MPa'"
    " --set pass.0.exit_tension='180 MPa' --set pass.0.speed='8 m/s' ";

const std::string &cold_run()
{
  static const std::string folder = coarse_run("run", "critical-speed", thin_strip);
  return folder;
}

nlohmann::json verdict_of(const std::string &folder, const std::size_t pass = 0)
{
  return json_of(folder + "/run.json").at("critical_speed").at(pass);
}

/// A case of kind chatter around the model that the run has written, in its own search.
std::string chatter_of(const std::string &folder)
{
  const std::string path = scratch("same-structure") + ".toml";
  mill::write_atomically(path, fmt::format(R"(schema = 1
kind = "chatter"
title = "the stand of a run"
[steel]
poisson_ratio = 0.28
[work_roll]
diameter = "{}"
[strip]
flow_stress = {{ law = "constant", k = "700 MPa" }}
friction = 0.03
[stand]
from = "{}"
entry_distance = "5 m"
exit_distance = "5 m"
[[condition]]
name = "pass 1"
entry_thickness = "0.9 mm"
exit_thickness = "0.6 mm"
entry_tension = "160 MPa"
exit_tension = "180 MPa"
width = "1000 mm"
speed = "8 m/s"
)",
                                           "420 mm", folder + "/lumped_model-craig-bampton.toml"));
  return path;
}
}  // namespace

// The structure leaves the run as matrices in files and is read again by the other kind of case.
TEST(CriticalSpeedLong, OfARunIsThatOfKindChatterWithTheSameStructure)
{
  const std::string other = scratch("same-structure");
  const auto outcome      = millstand("chatter " + chatter_of(cold_run()) + " -q -o " + other +
                                      " --set analysis.map_points=0 --set analysis.duration='0.05 s'");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto rounding = within(1e-9, "the same matrices; modes solved again from numbers of 17 digits");
  EXPECT_TRUE(near(value(cold_run(), "chatter.pass 1.critical_speed"),
                   value(other, "chatter.pass 1.critical_speed"), rounding));
  EXPECT_TRUE(
      near(value(cold_run(), "chatter.pass 1.frequency"), value(other, "chatter.pass 1.frequency"), rounding));
}

TEST(CriticalSpeedLong, OfARunIsThatOfTheVerbChatter)
{
  const std::string other = coarse_run(
      "chatter", "verb-chatter", thin_strip + "--set analysis.map_points=0 --set analysis.duration='0.05 s'");
  EXPECT_TRUE(near(value(cold_run(), "chatter.pass 1.critical_speed"),
                   value(other, "chatter.pass 1.critical_speed"), within(1e-9, "components solved twice")));
}

TEST(CriticalSpeed, HasAnIntervalAVerdictAndTheDampingOfTheGapMode)
{
  const auto verdict = verdict_of(cold_run());
  const double speed = verdict.at("critical_speed"), low = verdict.at("critical_speed_low"),
               high = verdict.at("critical_speed_high");
  EXPECT_EQ(verdict.at("id"), "below");
  EXPECT_LT(low, speed);
  EXPECT_LT(speed, high);
  EXPECT_TRUE(near(verdict.at("margin").get<double>(), 1 - 8 / speed, within(1e-12, "its definition")));
  EXPECT_LE(low, verdict.at("critical_speed_low_by_inputs").get<double>());
  EXPECT_GE(high, verdict.at("critical_speed_high_by_inputs").get<double>());
  const std::string sentence = verdict.at("sentence");
  EXPECT_EQ(sentence.rfind("At 8.00 m/s, ", 0), 0u) << sentence;
  EXPECT_NE(sentence.find(" % below the critical speed of "), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("becomes unstable first."), std::string::npos) << sentence;
  EXPECT_TRUE(near(value(cold_run(), "chatter.pass 1.gap_mode_frequency"),
                   value(cold_run(), "mode.gap_first_kind.frequency"),
                   within(0.3, "the same mode, which the tensions move as well")));
  EXPECT_GT(value(cold_run(), "chatter.pass 1.gap_mode_damping"), 0);
  EXPECT_LT(value(cold_run(), "chatter.pass 1.gap_mode_damping"), 1);
  EXPECT_LT(value(cold_run(), "chatter.pass 1.growth_rate"), 0) << "below the critical speed";
}

TEST(CriticalSpeed, OfAPassThatSaysTooLittleNamesTheKeys)
{
  const auto verdict = verdict_of(cold_run(), 1);  // the second pass of the demo has no speed and no tensions
  EXPECT_EQ(verdict.at("id"), "not-searched");
  EXPECT_EQ(verdict.at("sentence"), "Critical speed not searched: pass.1.speed, strip.entry_tension and "
                                    "strip.exit_tension are not given.");
  EXPECT_EQ(verdict.at("missing").size(), 3u);
}

TEST(CriticalSpeed, AbovePassIsUnstable)
{
  const double critical = verdict_of(cold_run()).at("critical_speed");
  const std::string folder =
      coarse_run("run", "above", thin_strip + fmt::format("--set pass.0.speed='{:.1f} m/s' ", 1.1 * critical));
  const auto verdict = verdict_of(folder);
  EXPECT_EQ(verdict.at("id"), "unstable");
  EXPECT_EQ(verdict.at("sentence").get<std::string>().rfind("Unstable: ", 0), 0u);
  EXPECT_GT(value(folder, "chatter.pass 1.growth_rate"), 0);
}

// A bite without a steady state is a sentence, and the run goes on.
TEST(CriticalSpeed, OfABiteThatDoesNotConvergeIsASentence)
{
  const std::string folder = coarse_run("run", "no-bite",
                                        thin_strip + "--set given.K4='5000 kN/mm' "
                                                     "--set strip.friction=0.0005 ");
  const auto verdict       = verdict_of(folder);
  EXPECT_EQ(verdict.at("id"), "not-searched");
  EXPECT_NE(verdict.at("sentence").get<std::string>().find("has no steady state at 8 m/s"), std::string::npos)
      << verdict;
}

// A tolerance of 0 % makes a number exact; of two inputs from one number the other one remains.
TEST(CriticalSpeed, ANumberWithAToleranceOfZeroIsNotAmongTheUncertainOnes)
{
  const auto input = [](const char *name, const double error, const double dK) {
    return mill::reduce::ModalSensitivity{
        name, error, {}, Eigen::MatrixXd::Constant(1, 1, dK), Eigen::MatrixXd::Zero(1, 1)};
  };
  const auto all = mill::uncertain_numbers(
      {}, mill::FourHigh(), mill::bite::RollBite(),
      {input("K2", 0, 1), input("K3", 0, 1), input("K5", 0.1, 2), input("K1", 0.2, 3), input("K7", 0.1, 4)}, 1);
  ASSERT_GE(all.numbers.size(), 2u);
  EXPECT_EQ(all.numbers[0].name, "K3_and_K5");
  EXPECT_EQ(all.numbers[0].error, 0.1);
  EXPECT_EQ(all.numbers[0].structure.dK(0, 0), 2);
  EXPECT_EQ(all.numbers[1].name, "K1_and_K7");
  EXPECT_EQ(all.numbers[1].error, 0.2);
  EXPECT_TRUE(near(all.numbers[1].structure.dK(0, 0), 3 + 0.5 * 4, within(1e-14, "half of the larger error")));
  for (std::size_t i = 2; i < all.numbers.size(); ++i)
    EXPECT_EQ(all.numbers[i].structure.dK.size(), 0) << all.numbers[i].name;
}
