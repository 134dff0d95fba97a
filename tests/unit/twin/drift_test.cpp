// Drift of a mode: cumulative sums and their law (TW-22), frequency of one mode from a block.
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include "tests/support/synthetic_record.h"
#include "twin/drift/cusum.h"
#include "twin/drift/mode_fit.h"
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

using namespace mill::twin;

namespace {
// Mean number of values to the alarm over `runs` sequences of one stream of normals.
double simulated_length(const std::uint64_t seed, const int runs, const double shift)
{
  const Eigen::VectorXd x =
      synthetic::normals(seed, Eigen::Index(runs * (siegmund_run_length(shift) * 1.3 + 100)));
  Eigen::Index index = 0;
  for (int run = 0; run < runs; ++run) {
    Cusum cusum;
    while (!cusum.take(x[index++] + shift))
      ;
  }
  return double(index) / runs;
}
}  // namespace

TEST(Cusum, BlocksToAlarm)
{
  const auto known = reference("drift", "twin");
  for (const auto &entry : known["detection"]) {
    const double shift = entry["shift"], law = entry["law"], simulated = entry["simulated"];
    EXPECT_TRUE(near(siegmund_run_length(shift), law, within(1e-12, "the same closed form")));
    EXPECT_TRUE(near(cusum_run_length(shift), simulated, within(0.05, "asked for; 2000 runs")));
    EXPECT_TRUE(near(simulated_length(701, 2000, shift), simulated, within(0.05, "asked for")));
    EXPECT_TRUE(
        near(simulated_length(11, 2000, shift), cusum_run_length(shift), within(0.02, "3 sd of 2000 runs")));
  }
  const double false_alarm = known["in_control_two_sided"];
  EXPECT_TRUE(near(siegmund_run_length(0) / 2, false_alarm, within(1e-9, "the same closed form")));
  EXPECT_TRUE(near(two_sided_run_length(0), false_alarm, within(0.02, "the closed form's own approximation")));
  EXPECT_GT(two_sided_run_length(0) * 10 / 86400, 59) << "days between false alarms of one mode";
}

// A short rule whose length without a shift a simulation reaches: the integral equation against it.
TEST(Cusum, LengthOfAShortRuleAgainstSimulation)
{
  const CusumRule rule{0.5, 3};
  const Eigen::VectorXd x = synthetic::normals(5, 600000);
  Cusum cusum(rule);
  int alarms        = 0;
  Eigen::Index last = 0;
  for (Eigen::Index k = 0; k < x.size(); ++k)
    if (cusum.take(x[k])) {
      ++alarms;
      last = k + 1;
      cusum.restart();
    }
  EXPECT_TRUE(near(double(last) / alarms, two_sided_run_length(0, rule),
                   within(4 / std::sqrt(double(alarms)), "run lengths scatter like an exponential")));
}

TEST(Cusum, EstimatesTimeAndSizeOfTheChange)
{
  Cusum cusum;
  for (int k = 0; k < 50; ++k)
    EXPECT_FALSE(cusum.take(k % 2 ? 0.4 : -0.4));
  EXPECT_FALSE(cusum.take(NAN)) << "not counted";
  int n = 0;
  std::optional<Shift> shift;
  while (!shift) {
    shift = cusum.take(-2);
    ++n;
  }
  EXPECT_EQ(n, 9) << "1.5 a value to above 12";
  EXPECT_EQ(shift->sign, -1);
  EXPECT_EQ(shift->since, 50);
  EXPECT_EQ(shift->taken, 58);
  EXPECT_TRUE(near(shift->mean, -2, within_absolute(1e-12, "mean of equal values, rounding")));
  EXPECT_FALSE(cusum.take(-2)) << "one alarm";
  cusum.restart();
  EXPECT_EQ(cusum.downward(), 0);
}

namespace {
synthetic::Chain six_masses(const double k3)
{
  const auto in = reference("oma.inputs", "twin");
  auto M = in["M"].get<std::vector<double>>(), K = in["K"].get<std::vector<double>>();
  K[2] *= k3;
  return synthetic::chain(Eigen::Map<Eigen::VectorXd>(M.data(), 6), Eigen::Map<Eigen::VectorXd>(K.data(), 7),
                          0.01);
}

// Blocks of 10 s of one record at both work rolls, in the noise of TW-15.
std::vector<BlockSpectra> blocks_of(const synthetic::Chain &chain, const std::uint64_t seed, const int count)
{
  constexpr double rate = 4000, T = 10;
  const auto n              = Eigen::Index(T * rate);
  const auto force          = synthetic::band_force(seed, count * n, rate, 1000, 0, 1600);
  const Eigen::MatrixXd all = synthetic::response(chain, force.drive, rate);
  Eigen::FFT<double> fft;
  const auto lines = [&](const Eigen::VectorXd &x) {
    std::vector<double> in(x.data(), x.data() + n);
    std::vector<std::complex<double>> X;
    fft.fwd(X, in);
    return Eigen::VectorXcd(Eigen::Map<Eigen::VectorXcd>(X.data(), n / 2));
  };
  std::vector<BlockSpectra> blocks;
  Eigen::MatrixXd seen(count * n, 2);
  for (int s = 0; s < 2; ++s)
    seen.col(s) = all.col(2 + s) + synthetic::white(seed + 1000 + std::uint64_t(s), count * n, rate, 0.005);
  for (int b = 0; b < count; ++b) {
    BlockSpectra block;
    block.duration = T;
    block.force    = lines(force.force.segment(b * n, n));
    block.response.resize(n / 2, 2);
    for (int s = 0; s < 2; ++s)
      block.response.col(s) = lines(seen.col(s).segment(b * n, n));
    blocks.push_back(std::move(block));
  }
  return blocks;
}
}  // namespace

// Sensors at the work rolls: the mode of 218 Hz does not move them, which has to be said.
TEST(ModeFit, FrequencyWithinItsOwnInterval)
{
  const auto twin = six_masses(1);
  std::vector<ExpectedMode> expected;
  for (int i = 0; i < 6; ++i)
    expected.push_back({twin.frequency[i], 0.012});  // the damping is not known
  for (const double k3 : {1., 0.9}) {
    const auto stand  = six_masses(k3);
    const auto blocks = blocks_of(stand, k3 == 1 ? 900 : 950, 6);
    for (int i = 0; i < 6; ++i) {
      auto others = expected;
      others.erase(others.begin() + i);
      double squares = 0;
      for (const BlockSpectra &block : blocks) {
        const ModeFit fit = fit_mode(block, expected[std::size_t(i)], others);
        ASSERT_EQ(fit.why_not.empty(), i != 2) << i << ": " << fit.why_not;
        if (i == 2)
          continue;
        squares += std::pow((fit.frequency / stand.frequency[i] - 1) / fit.sd, 2);
        EXPECT_LT(fit.sd, i > 3 ? 3e-5 : 2e-3) << "that of the work rolls is known to 0.002 %";
        EXPECT_LT(std::abs(std::log(fit.damping / 0.01)), 4.5 * fit.damping_sd);
      }
      EXPECT_LT(std::sqrt(squares / double(blocks.size())), 1.9) << stand.frequency[i] << " Hz";
    }
  }
}

// Gains, a sensor upside down and a delay of the vibration against the force do not move the frequency.
TEST(ModeFit, DoesNotDependOnGainAndDelay)
{
  const auto stand   = six_masses(1);
  BlockSpectra block = blocks_of(stand, 77, 1)[0];
  std::vector<ExpectedMode> others;
  for (int i = 0; i < 5; ++i)
    others.push_back({stand.frequency[i], 0.01});
  const ExpectedMode mode{stand.frequency[5], 0.01};
  const ModeFit plain = fit_mode(block, mode, others);
  for (Eigen::Index k = 0; k < block.response.rows(); ++k)
    block.response.row(k) *= -1.3 * std::polar(1.0, -2 * M_PI * double(k) / block.duration * 0.8e-3);
  const ModeFit late = fit_mode(block, mode, others);
  EXPECT_LT(std::abs(late.frequency / plain.frequency - 1), 3 * plain.sd);
  EXPECT_TRUE(fit_mode(block, {5000, 0.01}, {}).why_not == "its band lies beyond the record's");
  block.force.setRandom();
  EXPECT_FALSE(fit_mode(block, mode, others).why_not.empty()) << "a force that does not move it";
}
