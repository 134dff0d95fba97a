// Statistics of force records and the synthetic record.
#include "core/base/errors.h"
#include "dynamics/response/rolling_force.h"
#include "dynamics/response/spectrum.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill;
using namespace mill::dynamics;

namespace {
NoiseSettings pass_1()
{
  NoiseSettings settings;
  settings.range = {972898, 979537};
  return settings;
}
}  // namespace

TEST(SyntheticForce, ReachesItsRangeExactlyAndRepeats)
{
  const ForceRecord record = synthetic_force(pass_1());
  EXPECT_EQ(record.force.minCoeff(), 972898);
  EXPECT_EQ(record.force.maxCoeff(), 979537);
  EXPECT_EQ(record.time.size(), 100001);
  EXPECT_TRUE(near(record.time[100000], 10, within(1e-15, "rounding of one division")));
  EXPECT_TRUE(synthetic_force(pass_1()).force == record.force);
  auto other = pass_1();
  other.seed = 2;
  EXPECT_FALSE(synthetic_force(other).force == record.force);
}

TEST(SyntheticForce, IsWhiteToItsBandwidthAndGaussian)
{
  const ForceRecord record = synthetic_force(pass_1());
  const Spectrum spectrum  = amplitude_spectral_density(record.force, 10e3, 2048);
  const auto line          = [&](const double f) { return Eigen::Index(std::lround(f / spectrum.frequency[1])); };
  const double inside      = std::sqrt(spectrum.density.segment(line(20), line(960)).array().square().mean());
  const double lower       = std::sqrt(spectrum.density.segment(line(20), line(480)).array().square().mean());
  const double above       = spectrum.density.tail(spectrum.density.size() - line(1020)).maxCoeff();
  EXPECT_TRUE(near(lower, inside,
                   within(0.03, "half of 9600 independent lines: 1.4 % of power, 0.7 % of amplitude; "
                                "four of these")));
  // the record is a cut-out of a longer one: its ends jump, and the window lets 1/f^3 of the jump through
  EXPECT_LT(above, 1e-2 * inside);
  const Eigen::ArrayXd normal = (record.force.array() - record.force.mean());
  const double variance       = normal.square().mean();
  EXPECT_TRUE(
      near(normal.square().square().mean() / (variance * variance), 3,
           within(0.08, "kurtosis of 20000 independent values: sqrt(24/20000) = 0.035, four of these are 5 %, "
                        "correlation of neighbours leaves 8 %")));
}

TEST(SyntheticForce, RefusesImpossibleSettings)
{
  auto settings      = pass_1();
  settings.bandwidth = 5001;
  EXPECT_THROW(synthetic_force(settings), InputError);
  settings       = pass_1();
  settings.range = {979537, 972898};
  EXPECT_THROW(synthetic_force(settings), InputError);
  settings          = pass_1();
  settings.duration = 1e-5;
  EXPECT_THROW(synthetic_force(settings), InputError);
}

TEST(ForceStatistics, OfASampledSineAreThoseOfTheSine)
{
  const double rate = 2000, f = 62.5, amplitude = 5e3, mean = 1e6;
  ForceRecord record;
  record.time                      = Eigen::ArrayXd::LinSpaced(16385, 0, 16384) / rate;
  record.force                     = mean + amplitude * (2 * M_PI * f * record.time.array()).sin();
  const ForceStatistics statistics = force_statistics(record);
  EXPECT_TRUE(near(statistics.mean, mean, within(1e-9, "whole periods and one sample of zero")));
  EXPECT_TRUE(
      near(statistics.largest - statistics.smallest, 2 * amplitude, within(1e-12, "a sample falls on the crest")));
  EXPECT_TRUE(near(statistics.rms, amplitude / std::sqrt(2), within(1e-4, "16385 samples instead of 16384")));
  EXPECT_TRUE(near(statistics.bandwidth, rate / 2, within(1e-12, "definition")));
  EXPECT_TRUE(near(statistics.content, f, within(2 * rate / 2048 / f, "the Hann window is three lines wide")));
}

TEST(ForceStatistics, ContentOfWhiteNoiseIsItsCutOff)
{
  for (const double cut : {250.0, 1000.0, 3000.0}) {
    auto settings         = pass_1();
    settings.bandwidth    = cut;
    const auto statistics = force_statistics(synthetic_force(settings));
    EXPECT_TRUE(near(statistics.content, cut, within(5 / cut, "two lines of 1.2 Hz each, and one that scatters")));
  }
}

TEST(ForceStatistics, UnevenSamplesGiveTheSameSpectrum)
{
  ForceRecord even = synthetic_force(pass_1()), uneven = even;
  // one sample in a thousand left out: the record is read on its straight lines
  Eigen::Index kept = 0;
  for (Eigen::Index i = 0; i < even.time.size(); ++i)
    if (i % 1000 != 500) {
      uneven.time[kept]    = even.time[i];
      uneven.force[kept++] = even.force[i];
    }
  uneven.time.conservativeResize(kept);
  uneven.force.conservativeResize(kept);
  EXPECT_TRUE(
      near(force_statistics(uneven).content, 1000, within(6e-3, "as above, and one line for the resampling")));
}

TEST(ForceStatistics, ConstantForceHasNoContent)
{
  ForceRecord record;
  record.time  = Eigen::Vector3d(0, 1, 2);
  record.force = Eigen::Vector3d(5, 5, 5);
  EXPECT_EQ(force_statistics(record).content, 0);
}

TEST(BandwidthWarning, NamesTheFrequencyThatTheForceDoesNotReach)
{
  ForceStatistics s{};
  s.sample_rate = 200, s.bandwidth = 100, s.content = 80;
  const auto text = [&] { return text_of(bandwidth_warning(s, 745.8).value()); };
  EXPECT_EQ(text(), "the rolling force is sampled at 200 Hz and contains nothing above 100 "
                    "Hz, but the highest mode is at 745.8 Hz: "
                    "the accelerations of that mode are missing, not small");
  s.sample_rate = 10e3, s.bandwidth = 5e3, s.content = 500;
  EXPECT_EQ(text(), "the content of the rolling force ends near 500 Hz, below the highest mode at "
                    "745.8 Hz: a sensor or filter of that bandwidth hides the excitation of the mode");
  s.content = 1000;
  EXPECT_FALSE(bandwidth_warning(s, 745.8));
}
