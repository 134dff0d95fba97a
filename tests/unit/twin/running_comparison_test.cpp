// Measured beside simulated: levels, delay with its uncertainty, incoherent shares; any block length gives the
// same.
#include "tests/support/near.h"
#include "tests/support/synthetic_record.h"
#include "twin/comparison/running_comparison.h"
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

using namespace mill::twin;

namespace {
constexpr double rate = 2000;  // Hz

// The same band-limited noise, later by a time that is not a multiple of the step: phases of its lines turned.
Eigen::VectorXd delayed(const Eigen::VectorXd &x, const double tau)
{
  Eigen::FFT<double> fft;
  std::vector<double> in(x.data(), x.data() + x.size());
  std::vector<std::complex<double>> X;
  fft.fwd(X, in);
  const auto n = x.size();
  for (Eigen::Index k = 0; k <= n / 2; ++k) {
    const auto turned = X[std::size_t(k)] * std::polar(1.0, -2 * M_PI * double(k) * rate / double(n) * tau);
    X[std::size_t(k)] = turned;
    if (k > 0 && k < n / 2)
      X[std::size_t(n - k)] = std::conj(turned);
  }
  X[std::size_t(n / 2)] = 0;
  fft.inv(in, X);
  return Eigen::Map<Eigen::VectorXd>(in.data(), n);
}

std::vector<PlaceSecond> rows(const Eigen::VectorXd &measured, const Eigen::VectorXd &simulated,
                              const Eigen::Index block = 500)
{
  RunningComparison comparison(rate, 1);
  std::vector<PlaceSecond> all;
  for (Eigen::Index begin = 0; begin < measured.size(); begin += block) {
    const auto n    = std::min(block, measured.size() - begin);
    const auto news = comparison.take(begin, measured.segment(begin, n), simulated.segment(begin, n));
    for (const auto &second : news.seconds)
      all.insert(all.end(), second.begin(), second.end());
  }
  return all;
}
}  // namespace

TEST(RunningComparison, LevelsOfASecond)
{
  const Eigen::Index n = 4000;
  Eigen::VectorXd x(n), y(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double t = double(k) / rate;
    x[k]           = 0.25 + 2 * std::sin(2 * M_PI * 100 * t);
    y[k]           = 1 * std::sin(2 * M_PI * 100 * t);
  }
  x[700]         = NAN;
  const auto all = rows(x, y);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_TRUE(near(all[1].measured.rms, std::sqrt(2.),
                   within_absolute(1e-12, "closed form of a sine over whole periods, rounding")));
  EXPECT_TRUE(near(all[1].measured.peak, 2, within_absolute(1e-12, "a sample lies on the crest, rounding")));
  EXPECT_TRUE(near(all[1].measured.crest, std::sqrt(2.),
                   within_absolute(1e-12, "closed form of a sine over whole periods, rounding")));
  EXPECT_TRUE(near(all[1].measured.offset, 0.25,
                   within_absolute(1e-12, "closed form of a sine over whole periods, rounding")));
  EXPECT_TRUE(near(all[1].ratio, 20 * std::log10(2.),
                   within_absolute(1e-12, "closed form of a sine over whole periods, rounding")));
  EXPECT_TRUE(near(all[0].missing, 1. / 2000, within_absolute(1e-12, "one sample of 2000, rounding")));
  EXPECT_TRUE(near(all[1].delay.value, 0,
                   within_absolute(1e-9, "one line determines it up to its period; the least one is taken")));
  EXPECT_GT(all[1].delay.rival, 0.95) << "and it is said that others are as good";
}

TEST(RunningComparison, DelayBetweenSamplesAndItsUncertainty)
{
  // noise of 30 to 800 Hz, late by 6.74 samples, in as much noise of the sensor: 40 records of one second
  constexpr double tau    = 3.37e-3;
  const Eigen::Index n    = 100000;
  const auto force        = synthetic::band_force(11, n, rate, 1, 30, 800).force;
  const Eigen::VectorXd x = delayed(force, tau) + synthetic::white(12, n, rate, 1 / std::sqrt(770.));
  const auto all          = rows(x, force);
  ASSERT_EQ(all.size(), 50u);
  double squares = 0, sum = 0;
  int counted = 0;
  for (std::size_t i = 9; i < all.size(); ++i, ++counted) {
    const double z = (all[i].delay.value - tau) / all[i].delay.sd;
    squares += z * z;
    sum += z;
    EXPECT_GT(all[i].delay.sd, 1e-6);
    EXPECT_LT(all[i].delay.sd, 2e-5) << "a fiftieth of a sample and more";
    EXPECT_TRUE(near(all[i].delay.correlation, std::sqrt(0.5),
                     within_absolute(0.08, "correlation estimated from one second")));
  }
  // errors over their own standard deviation; a Hann window uses less of the record than the law supposes
  EXPECT_GT(std::sqrt(squares / counted), 0.7);
  EXPECT_LT(std::sqrt(squares / counted), 1.4);
  EXPECT_LT(std::abs(sum / counted), 0.5);
}

TEST(RunningComparison, ReportsAnInvertedSensor)
{
  const auto force = synthetic::band_force(21, 8000, rate, 1, 30, 800).force;
  const auto all   = rows(-delayed(force, -0.02), force);
  EXPECT_TRUE(near(all[3].delay.value, -0.02,
                   within_absolute(1e-6, "s; a copy without noise, interpolation of the peak")));
  EXPECT_LT(all[3].delay.correlation, -0.9);
}

TEST(RunningComparison, IncoherentShareIsUnbiased)
{
  // a third of the energy in every band has nothing to do with the simulation
  const Eigen::Index n    = 40000;
  const auto y            = synthetic::white(31, n, rate, 1);
  const auto rest         = synthetic::white(32, n, rate, 1);
  const Eigen::VectorXd x = std::sqrt(2. / 3) * y + std::sqrt(1. / 3) * rest;
  const auto all          = rows(x, y);
  ASSERT_EQ(all.size(), 20u);
  EXPECT_TRUE(std::isnan(all[0].bands.back().share)) << "not known from one second";
  int bands = 0;
  for (const auto &band : all.back().bands) {
    const double bins = (band.high - band.low) / (rate / 1024);
    EXPECT_TRUE(near(band.share, 1. / 3,
                     within_absolute(4 * std::sqrt(2. / 9 / (bins * 25)),
                                     "four deviations of a share over this number of bins")))
        << band.centre << " Hz";
    bands += band.low > 30;
  }
  EXPECT_GE(bands, 13);
  EXPECT_LT(all.back().bands.back().high, rate / 2.56);
  EXPECT_TRUE(near(all.back().bands.back().centre, 630.957,
                   within_absolute(0.01, "six digits of 10^2.8; centres are ten to a decade")));
  const auto same = rows(y, y).back().bands;
  for (const auto &band : same)
    EXPECT_TRUE(near(band.share, 0, within_absolute(1e-12, "the same record twice, rounding")));
  double mean          = 0;
  const auto unrelated = rows(y, rest).back().bands;
  for (const auto &band : unrelated)
    mean += band.share / double(unrelated.size());
  EXPECT_TRUE(near(mean, 1, within_absolute(0.02, "the bias is removed; a raw share would be 1 - 1/nd")));
}

TEST(RunningComparison, DoesNotDependOnBlockLengthAndStartsAgainAfterAGap)
{
  const auto y = synthetic::white(41, 12000, rate, 1), x = synthetic::white(42, 12000, rate, 1);
  const auto one = rows(x, y, 12000), many = rows(x, y, 77);
  ASSERT_EQ(one.size(), 6u);
  ASSERT_EQ(many.size(), 6u);
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].measured.rms, many[i].measured.rms);
    EXPECT_EQ(one[i].delay.value, many[i].delay.value);
    EXPECT_EQ(one[i].bands.back().energy, many[i].bands.back().energy);
  }
  RunningComparison comparison(rate, 1);
  comparison.take(0, x.head(1500), y.head(1500));
  const auto after = comparison.take(1600, x.segment(1600, 1000), y.segment(1600, 1000));
  EXPECT_TRUE(after.seconds.empty()) << "of the second that is over only a fifth is there";
  const auto next = comparison.take(2600, x.segment(2600, 1400), y.segment(2600, 1400));
  ASSERT_EQ(next.seconds.size(), 1u);
  EXPECT_TRUE(near(next.seconds[0][0].missing, 0, within_absolute(1e-12, "each sample is there, rounding")));
  ASSERT_EQ(next.spectra.size(), 1u);
  EXPECT_EQ(next.spectra[0].measured.size(), 513);
  EXPECT_TRUE(near(next.spectra[0].measured.segment(20, 480).mean(), 1,
                   within_absolute(0.2, "three deviations of the mean of 480 bins of one segment")))
      << "density of the noise";
}
