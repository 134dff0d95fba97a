// Growth has a sign: over the record by correlation, and over time by the logarithm of the envelope.
#include "tests/support/near.h"
#include "tests/support/synthetic_record.h"
#include "twin/analysis/analysis.h"
#include "twin/onset/growth.h"
#include "twin/onset/growth_stretch.h"
#include <cmath>
#include <gtest/gtest.h>

using namespace mill;
using namespace mill::twin;

namespace {
constexpr double values_rate = 50;  // 1/s

ComplexEnvelope exponential(const double sigma, const Eigen::Index n)
{
  Eigen::VectorXcd z(n);
  for (Eigen::Index k = 0; k < n; ++k)
    z[k] = std::polar(std::exp(sigma * double(k) / values_rate), 0.3 * double(k));
  return {100, values_rate, {z}, {0}};
}

ComplexEnvelope calm_mode(const std::uint64_t seed, const double sigma, const Eigen::Index n)
{
  const double pole       = std::exp(sigma / values_rate);
  const Eigen::VectorXd w = synthetic::normals(seed, 2 * (n + 2000)) * std::sqrt((1 - pole * pole) / 2);
  Eigen::VectorXcd z(n);
  std::complex<double> now = 0;
  for (Eigen::Index k = 0; k < n + 2000; ++k) {
    now = pole * now + std::complex<double>(w[2 * k], w[2 * k + 1]);
    if (k >= 2000)
      z[k - 2000] = now;
  }
  return {100, values_rate, {z}, {0}};
}
}  // namespace

TEST(GrowthRate, HasItsSign)
{
  for (const double sigma : {-3.0, -0.5, 0.5, 3.0})
    EXPECT_TRUE(near(growth_rate(exponential(sigma, 600)).sigma, sigma, within(1e-9, "one exponential is exact")));
}

// Noise that the low-pass colours fills its length and no more: the first lag lies beyond it, and the mean is that
// of the mode.  120 records, standard deviation of their mean 0.03 1/s.
TEST(GrowthRate, OfAFastModeIsNotPulledByTheFilter)
{
  constexpr int runs = 120;
  double sum         = 0;
  for (int seed = 1; seed <= runs; ++seed) {
    const auto record = synthetic::onset(std::uint64_t(1000 * seed), 60 * 200, 200, 45.1174, 0.05, 0.002, {-4.4});
    sum += growth_rate(complex_envelope(record.signal, {{0, record.signal.size()}}, 200, 45.1174)).sigma;
  }
  EXPECT_TRUE(
      near(sum / runs, -4.4, within_absolute(0.1, "three deviations of the mean of 120 records, each 0.03 1/s")));
}

// Two peaks in one band beat, and the slope of their correlation is that of neither; the image of a slow mode at
// minus its frequency does the same.
TEST(GrowthRate, IsThatOfOneModeWhereTheBandHoldsNoOther)
{
  constexpr double rate = 500, slow = -1.1, fast = -3;
  constexpr Eigen::Index n = 100 * Eigen::Index(rate);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const Eigen::VectorXd both = synthetic::onset(7000 * seed, n, rate, 26.5, 0.05, 0.001, {slow}).signal +
                                 synthetic::onset(9000 * seed, n, rate, 41.9, 0.05, 0.001, {fast}).signal;
    const GrowthRate lonely = growth_rate(complex_envelope(both, {{0, n}}, rate, 26.5, 7.7));
    EXPECT_LT(lonely.lower(), slow + 0.3) << seed;
    EXPECT_GT(lonely.upper(), slow - 0.3) << seed;
    RawRecord raw;
    raw.rate = rate;
    raw.channels.push_back({"chock", "chock", "m/s2", Quantity::acceleration, true, {}, both});
    for (const Finding &finding : analyse(clean_record(std::move(raw)), nullptr, {}, {}).findings)
      EXPECT_NE(finding.kind, FindingKind::near_instability) << seed << ": " << finding.evidence.front();
  }
}

TEST(GrowthStretch, CalmThenGrowingIsFoundWithBothSigns)
{
  int stretches = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const double rate = 500;
    std::vector<double> sigma;
    for (int k = 0; k < int(22 * rate); ++k)
      sigma.push_back(k < 20 * rate ? -2.2 : 5.0);
    const auto record = synthetic::onset(300 * seed, Eigen::Index(sigma.size()), rate, 101.3, 0.05, 0.0005, sigma);
    const auto envelope = complex_envelope(record.signal, {{0, record.signal.size()}}, rate, 101.3);
    const auto stretch  = growth_stretch(envelope);
    const auto before   = complex_envelope(record.signal, {{0, Eigen::Index(20 * rate)}}, rate, 101.3);
    EXPECT_LT(growth_rate(before).sigma, 0) << seed;
    if (!stretch)
      continue;
    ++stretches;
    EXPECT_GT(stretch->sigma, 0);
    EXPECT_GT(stretch->to, 21) << seed;
  }
  EXPECT_GE(stretches, 19);
}

// A mode that noise drives rises and falls without end; none of its rises is growth.
TEST(GrowthStretch, ACalmModeDoesNotGrow)
{
  int warned = 0;
  for (const double sigma : {-0.2, -0.5, -1.0, -3.0, -10.0})
    for (std::uint64_t seed = 1; seed <= 100; ++seed)
      warned += growth_stretch(calm_mode(seed, sigma, seed % 2 ? 200 : 3000)).has_value();
  EXPECT_EQ(warned, 0) << "of 500 records of 4 and of 60 s";
}

TEST(GrowthStretch, HalfPerSecondOverThreeSecondsIsEnough)
{
  int stretches = 0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    ComplexEnvelope envelope = calm_mode(seed, -30, 600);
    for (Eigen::Index k = 0; k < 600; ++k) {
      const double t = double(k) / values_rate;
      envelope.z[0][k] =
          0.1 * envelope.z[0][k] + std::polar(std::exp(0.5 * (std::clamp(t, 5.0, 8.0) - 5)), 2.0 * t);
    }
    stretches += growth_stretch(envelope).has_value();
  }
  EXPECT_GE(stretches, 49);
}
