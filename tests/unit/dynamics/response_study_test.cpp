// Frequency responses of a stand: one mass on a spring in closed form, six masses by two solutions.
#include "dynamics/response/response_study.h"
#include "reduce/stand/six_masses.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include "tests/support/refusal.h"
#include <cmath>

using namespace mill;
using dynamics::response_study;

namespace {
constexpr double mass = 2000, natural = 80, ratio = 0.03;  // kg, Hz, -

// A work roll on a spring, and another, three times as fast, that is not connected with it.
reduce::StandWithModes one_mass(const double frequency, const std::string &name)
{
  reduce::StandWithModes stand;
  const double w = 2 * M_PI * frequency;
  StandModel &m  = stand.model;
  m.name         = name;
  m.M            = Eigen::Matrix2d::Identity() * mass;
  m.K_parts      = Eigen::Vector2d(w * w, 9 * w * w).asDiagonal() * mass;
  m.b            = Eigen::Vector2d(1, -1);
  m.points       = {{"upper work roll", Eigen::Vector2d(1, 0)}, {"lower work roll", Eigen::Vector2d(0, 1)}};
  m.parts        = {"upper work roll", "lower work roll"};
  m.part_of      = {0, 1};
  m.unknowns.resize(2);
  stand.modes.frequency      = Eigen::Vector2d(frequency, 3 * frequency);
  stand.modes.error_estimate = Eigen::Vector2d::Zero();
  return stand;
}

// w^2 / |w0^2 - w^2 + 2 i zeta w0 w| is largest at w0 / sqrt(1 - 2 zeta^2).
double peak_frequency(const double frequency)
{
  return frequency / std::sqrt(1 - 2 * ratio * ratio);
}

FrequencyResponseSettings with_tolerance(const double tolerance)
{
  FrequencyResponseSettings settings;
  settings.damping_tolerance = tolerance;
  return settings;
}

// Half the width of what a tolerance of the damping makes of 1 / (2 zeta), log-normal and 1.96 deviations wide.
const auto sampled = within(0.12, "400 samples, ends of an interval of 95 %");
}  // namespace

TEST(ResponseStudy, PeakOfAMassOnASpring)
{
  const auto stand = one_mass(natural, "beam"), other = one_mass(1.1 * natural, "six-mass");
  const auto study = response_study({{&stand, &other}, {}, 0, not_given}, with_tolerance(0.2), ratio);
  EXPECT_EQ(study.range, (std::array<double, 2>{0.5 * natural, 4.5 * natural}));
  ASSERT_EQ(study.peaks.size(), 4u) << "two places, each under the bite and under its own force";
  const auto &bite = study.peaks[0], &roll = study.peaks[1];
  const double magnitude = 1 / (mass * 2 * ratio * std::sqrt(1 - ratio * ratio));
  EXPECT_TRUE(near(bite.peak.frequency, peak_frequency(natural), within(1e-6, "a maximum is flat")));
  EXPECT_TRUE(near(bite.peak.magnitude, magnitude, within(1e-9, "the sum of one mode")));
  EXPECT_TRUE(near(bite.direct, magnitude, within(1e-9, "no modes")));
  EXPECT_EQ(roll.force, 1u);
  EXPECT_TRUE(near(roll.peak.magnitude, magnitude, within(1e-9, "the bite pushes it with the same force")));
  ASSERT_EQ(bite.others.size(), 1u);
  EXPECT_TRUE(near(bite.others[0].frequency, peak_frequency(1.1 * natural), within(1e-6, "a maximum is flat")));
  EXPECT_TRUE(roll.others.empty()) << "companions answer the bite alone";
  EXPECT_TRUE(near(bite.error, std::sinh(0.2), sampled));
  EXPECT_TRUE(study.uncertain);
}

TEST(ResponseStudy, AnInputWithoutAnErrorLeavesThePeakWithout)
{
  const auto stand           = one_mass(natural, "beam");
  const Eigen::Matrix2d none = Eigen::Matrix2d::Zero();
  dynamics::StandInModels question{
      {&stand}, {{"K3", not_given, {"given.K3_tolerance"}, none, none}}, 0, not_given};
  const auto study = response_study(question, with_tolerance(0), ratio);
  EXPECT_EQ(study.lacks, std::vector<std::string>{"given.K3_tolerance"});
  EXPECT_FALSE(study.uncertain);
  EXPECT_TRUE(std::isnan(study.peaks.at(0).error));
  EXPECT_EQ(response_study({{&stand}, {}, 0, not_given}, {}, ratio).lacks,
            std::vector<std::string>{"frequency_response.damping_tolerance"});
  question.uncertain[0].error = 0.1;
  question.uncertain[0].dK    = Eigen::Vector2d(1, 9).asDiagonal() * std::pow(2 * M_PI * natural, 2);
  EXPECT_LT(response_study(question, with_tolerance(0), ratio).peaks.at(0).error, 1e-6)
      << "a stiffer spring moves the peak and leaves its height";
}

// A companion mesh may have fewer modes: those beyond them have no error, and are not taken as exact.
TEST(ResponseStudy, AModeWithoutAnErrorLeavesThePeakWithout)
{
  auto stand                 = one_mass(natural, "beam");
  stand.modes.error_estimate = Eigen::Vector2d(0.01, not_given);
  const auto study           = response_study({{&stand}, {}, 0, not_given}, with_tolerance(0.1), ratio);
  EXPECT_EQ(study.lacks, std::vector<std::string>{"the mode at 240 Hz"});
  EXPECT_TRUE(std::isnan(study.peaks.at(0).error));
  EXPECT_TRUE(study.uncertain) << "the band is that of what is known";
  stand.modes.error_estimate = Eigen::Vector2d(0.01, 0);
  EXPECT_TRUE(response_study({{&stand}, {}, 0, not_given}, with_tolerance(0.1), ratio).lacks.empty());
}

TEST(ResponseStudy, FrequenciesFollowTheSettings)
{
  const auto stand                   = one_mass(natural, "beam");
  FrequencyResponseSettings settings = with_tolerance(0.1);
  settings.range                     = {10, 20};
  settings.resolution                = 0.5;
  const auto study                   = response_study({{&stand}, {}, 0, not_given}, settings, ratio);
  EXPECT_EQ(study.models[0].frequency.size(), 21);
  EXPECT_EQ(study.models[0].response.size(), 3u);
  EXPECT_TRUE(study.peaks.empty()) << "the response only rises up to 20 Hz";
  settings.resolution = 1e-4;
  EXPECT_NE(refusal([&] {
              response_study({{&stand}, {}, 0, not_given}, settings, ratio);
            }).find("at most 20000"),
            std::string::npos);
  EXPECT_TRUE(response_study({{&stand}, {}, 0, not_given}, {}, 0).peaks.empty()) << "infinite without damping";
}

TEST(ResponseStudy, PeaksOfSixMassesAreThoseOfTheMatrices)
{
  reduce::StandWithModes chain;
  chain.model      = reduce::chain_stand(published_stand());
  chain.modes      = reduce::stand_modes(chain.model);
  const auto study = response_study({{&chain}, {}, 1e5, not_given}, with_tolerance(0.1), 0.01);
  EXPECT_GE(study.peaks.size(), 6u);
  ASSERT_TRUE(std::isnan(chain.modes.error_estimate[0]));
  EXPECT_TRUE(study.lacks.empty()) << "six masses have no mesh";
  for (const auto &peak : study.peaks)
    EXPECT_TRUE(near(peak.peak.magnitude, peak.direct, within(1e-9, "two solutions of one equation")));
}
