// Alarm and growth of a live source: sample by sample the same as from a whole record.
#include "tests/support/near.h"
#include "tests/support/synthetic_record.h"
#include "twin/onset/onset_watch.h"
#include "twin/onset/running_envelopes.h"
#include <cmath>

using namespace mill::twin;

namespace {
constexpr double rate = 500, band = 128.1174;  // Hz

Eigen::VectorXd run_into_chatter(const std::uint64_t seed, const Eigen::Index n)
{
  std::vector<double> sigma;
  for (Eigen::Index k = 0; k < n; ++k)
    sigma.push_back(-1.5 + 5.5 * std::clamp((double(k) / rate - 40) / 4, 0.0, 1.0));
  return synthetic::onset(seed, n, rate, band, 0.05, 0.002, sigma).signal;
}

struct Watched {
  std::vector<double> time, level, growth;
  std::vector<Alarm> alarms;
};

Watched streamed(const Eigen::MatrixXd &x, const Eigen::Index column, const Eigen::Index block)
{
  RunningEnvelopes envelopes(rate, x.cols(), Eigen::Vector2d(60, band));
  AlarmSettings rule;
  rule.limit = 2;
  OnsetWatch watch(band, envelopes.rate(), rule);
  Watched watched;
  for (Eigen::Index begin = 0; begin < x.rows(); begin += block)
    envelopes.take(begin, x.middleRows(begin, std::min(block, x.rows() - begin)),
                   [&](const double time, const Eigen::MatrixXcd &z) {
                     if (const auto alarm = watch.take(time, z(1, column)))
                       watched.alarms.push_back(*alarm);
                     watched.time.push_back(time);
                     watched.level.push_back(watch.level());
                   });
  watched.growth.push_back(watch.growth().sigma);
  return watched;
}
}  // namespace

TEST(OnsetWatch, SameAsTheWholeRecord)
{
  const Eigen::Index n = 500 * 46;
  Eigen::MatrixXd x(n, 2);
  x << run_into_chatter(7010, n), run_into_chatter(7020, n);
  AlarmSettings rule;
  rule.limit = 2;
  for (Eigen::Index column = 0; column < 2; ++column) {
    const auto whole  = complex_envelope(x.col(column), {{0, n}}, rate, band);
    const auto raised = alarms(whole, rule);
    ASSERT_FALSE(raised.empty());
    for (const Eigen::Index block : {Eigen::Index(1), Eigen::Index(333), n}) {
      const Watched watched = streamed(x, column, block);
      ASSERT_EQ(Eigen::Index(watched.level.size()), whole.z[0].size());
      for (std::size_t k = 0; k < watched.level.size(); ++k)
        ASSERT_TRUE(
            near(watched.level[k], std::abs(whole.z[0][Eigen::Index(k)]), within(1e-11, "sums in another order")));
      EXPECT_TRUE(near(watched.time.back(), whole.start[0] + double(watched.level.size() - 1) / 50,
                       within_absolute(1e-9, "sample number over the rate, rounding")));
      ASSERT_EQ(watched.alarms.size(), raised.size());
      EXPECT_TRUE(near(watched.alarms[0].time, raised[0].time,
                       within_absolute(1e-9, "sample number over the rate, rounding")));
      EXPECT_TRUE(
          near(watched.alarms[0].baseline, raised[0].baseline, within_absolute(1e-12, "sums in another order")));
      EXPECT_TRUE(near(watched.alarms[0].to_limit, raised[0].to_limit,
                       within_absolute(1e-9, "sums in another order, divided by the growth rate")));
      EXPECT_TRUE(
          near(watched.growth[0], growth_rate(whole).sigma,
               within_absolute(1e-9, "sums in another order; the record is shorter than the 60 s that are kept")));
    }
  }
}

// The rule itself once more, written apart: median of the 30 s before less the last, five of them, twice running.
TEST(OnsetWatch, BaselineByDefinition)
{
  const Eigen::VectorXd noise = synthetic::normals(3, 6000);
  OnsetWatch watch(band, 50, {});
  std::vector<double> squares;
  for (Eigen::Index k = 0; k < 3000; ++k) {
    const std::complex<double> z(noise[2 * k], noise[2 * k + 1]);
    watch.take(double(k) / 50, z);
    squares.push_back(std::norm(z));
    if (k < 300 || k % 50 != 0)
      continue;
    const std::size_t from = k > 1500 ? std::size_t(k - 1500) : 0, to = std::size_t(k - 50);
    std::vector<double> part(squares.begin() + std::ptrdiff_t(from), squares.begin() + std::ptrdiff_t(to));
    std::sort(part.begin(), part.end());
    EXPECT_TRUE(near(watch.baseline(), std::sqrt(part[part.size() / 2] / std::log(2.)),
                     within_absolute(1e-12, "median by sorting, rounding")))
        << k;
  }
  EXPECT_TRUE(
      near(watch.baseline(), std::sqrt(2.), within_absolute(0.08, "median of 1450 squares, three deviations")))
      << "rms of |z| of two normals";
}

TEST(OnsetWatch, MissingValuesBeginANewPiece)
{
  OnsetWatch watch(band, 50, {});
  const Eigen::VectorXd noise = synthetic::normals(5, 2000);
  for (Eigen::Index k = 0; k < 1000; ++k)
    EXPECT_FALSE(watch.take(double(k) / 50, {noise[2 * k], noise[2 * k + 1]})) << "no value of noise is an alarm";
  watch.take(20, {NAN, 0});
  EXPECT_TRUE(std::isnan(watch.level()));
  for (Eigen::Index k = 0; k < 299; ++k)
    EXPECT_FALSE(watch.take(20 + double(k) / 50, {100, 0})) << "less than 5 s of baseline";
  EXPECT_TRUE(std::isnan(watch.growth().sigma)) << "six seconds tell no growth";
  Eigen::MatrixXd x = Eigen::MatrixXd::Ones(1000, 2);
  x(500, 1)         = NAN;
  RunningEnvelopes envelopes(rate, 2, Eigen::VectorXd::Constant(1, 0.));
  int finite = 0, missing = 0;
  envelopes.take(0, x, [&](double, const Eigen::MatrixXcd &z) {
    EXPECT_TRUE(
        near(z(0, 0).real(), 2, within_absolute(1e-12, "0-peak of what mixes to zero frequency, rounding")));
    (std::isfinite(std::abs(z(0, 1))) ? finite : missing)++;
  });
  EXPECT_EQ(missing, 6) << "every tenth of the 51 places of the missing sample in the filter of 0.1 s";
  EXPECT_GT(finite, 50);
}

TEST(OnsetWatch, ACarriedBaselineHoldsUntilThereIsAnother)
{
  OnsetWatch watch(band, 50, {});
  const Eigen::VectorXd noise = synthetic::normals(5, 2000);
  watch.carry(0.1);
  EXPECT_DOUBLE_EQ(watch.baseline(), 0.1);
  std::optional<Alarm> alarm;
  for (Eigen::Index k = 0; k < 20 && !alarm; ++k)
    alarm = watch.take(double(k) / 50, {1, 0});
  ASSERT_TRUE(alarm) << "ten times what was calm";
  EXPECT_DOUBLE_EQ(alarm->baseline, 0.1);
  EXPECT_TRUE(watch.above_half_threshold());
  watch.restart();
  EXPECT_TRUE(std::isnan(watch.baseline())) << "a restart forgets it";
  watch.carry(0.1);
  for (Eigen::Index k = 0; k < 400; ++k)
    watch.take(double(k) / 50, {noise[2 * k], noise[2 * k + 1]});
  EXPECT_TRUE(
      near(watch.baseline(), std::sqrt(2.), within_absolute(0.3, "median of 350 squares, five deviations")))
      << "its own, after six seconds";
  OnsetWatch other(band, 50, {});
  other.carry(std::nan(""));
  EXPECT_TRUE(std::isnan(other.baseline()));
}
