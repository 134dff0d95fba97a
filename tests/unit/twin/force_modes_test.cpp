// Modes from the response to a recorded force, H1 and coherence, against a chain whose modes are known.
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include "tests/support/synthetic_record.h"
#include "twin/modes/force_delay.h"
#include <cmath>
#include <cstdlib>

using namespace mill;
using namespace mill::twin;

namespace {
constexpr double rate = 2500, T = 40;  // Hz, s

struct Record {
  CleanChannel force;
  std::vector<CleanChannel> channels;
};

CleanChannel channel_of(Eigen::VectorXd value)
{
  CleanChannel channel;
  channel.pieces = {{0, value.size()}};
  channel.value  = std::move(value);
  return channel;
}

synthetic::Chain chain_of_reference()
{
  const auto in = reference("oma.inputs", "twin");
  auto M = in["M"].get<std::vector<double>>(), K = in["K"].get<std::vector<double>>();
  return synthetic::chain(Eigen::Map<Eigen::VectorXd>(M.data(), 6), Eigen::Map<Eigen::VectorXd>(K.data(), 7),
                          0.01);
}

Record record(const synthetic::Chain &chain, const std::uint64_t seed, const double noise, const double top = 1000)
{
  const auto n              = Eigen::Index(T * rate);
  const auto force          = synthetic::band_force(seed, n, rate, 1000, 0, top);
  const Eigen::MatrixXd all = synthetic::response(chain, force.drive, rate);
  Record result{channel_of(force.force), {}};
  for (int j = 0; j < 6; ++j)
    result.channels.push_back(
        channel_of(all.col(j) + synthetic::white(seed + 1000 + std::uint64_t(j), n, rate, noise)));
  return result;
}

ForcedModes modes_of(const Record &record, const std::size_t sensors = 6)
{
  std::vector<const CleanChannel *> channels;
  for (std::size_t j = 0; j < sensors; ++j)
    channels.push_back(&record.channels[j]);
  return forced_modes(channels, record.force, rate, rate / 2.56, {}, 1);
}
}  // namespace

TEST(ForceModes, APoleAsWindowedSegmentsSeeIt)
{
  // the same integral by summing: exp(lambda t) rho(t) exp(-i w t), rho the autocorrelation of a Hann window
  const std::complex<double> lambda(-2.4, 245.0);
  const double length = 3;
  for (const double w : {200.0, 243.0, 245.0, 260.0}) {
    std::complex<double> sum = 0;
    const int n              = 200000;
    for (int k = 0; k < n; ++k) {
      const double u   = (k + 0.5) / n;
      const double rho = (1 - u) * (2.0 / 3 + std::cos(2 * M_PI * u) / 3) + std::sin(2 * M_PI * u) / (2 * M_PI);
      sum += rho * std::exp((lambda - std::complex<double>(0, w)) * (u * length)) * length / double(n);
    }
    EXPECT_LT(std::abs(windowed_pole(lambda, w, length) - sum), 1e-8) << w;
  }
}

// Frequencies, dampings and shapes within their intervals.  All seeds: MILLSTAND_ALL_SEEDS=1.
TEST(ForceModes, KnownModesLieInTheIntervals)
{
  const auto chain = chain_of_reference();
  const int runs   = std::getenv("MILLSTAND_ALL_SEEDS") ? 20 : 2;
  double zf = 0, zz = 0, zs = 0, sharpest = 1;
  int confirmed = 0;
  for (int run = 0; run < runs; ++run) {
    const ForcedModes modes = modes_of(record(chain, 301 + std::uint64_t(10 * run), 0.002));
    EXPECT_GT(modes.best_coherence, 0.7);
    for (const ForcedMode &mode : modes.modes) {
      if (!mode.confirmed)
        continue;
      Eigen::Index i = 0;
      (chain.frequency.array() - mode.frequency).abs().minCoeff(&i);
      ASSERT_LT(std::abs(mode.frequency / chain.frequency[i] - 1), 0.01) << "a mode that is none, run " << run;
      EXPECT_GT(modal_assurance(mode.shape, chain.shape.col(i)), 0.99) << mode.frequency;
      ++confirmed;
      zf += std::pow((mode.frequency - chain.frequency[i]) / mode.sd_frequency, 2);
      zz += std::pow((mode.damping - 0.01) / mode.sd_damping, 2);
      Eigen::Index largest = 0;
      mode.shape.cwiseAbs().maxCoeff(&largest);
      for (Eigen::Index j = 0; j < 6; ++j)
        if (j != largest)
          zs += std::norm(mode.shape[j] - chain.shape(j, i) / chain.shape(largest, i)) /
                (2 * std::pow(mode.sd_shape[j], 2)) / 5;
      sharpest = std::min(sharpest, mode.sd_frequency / mode.frequency);
    }
  }
  if (runs > 2)
    std::printf("%d of %d confirmed, z of frequency %.2f, damping %.2f, shape %.2f\n", confirmed, 6 * runs,
                std::sqrt(zf / confirmed), std::sqrt(zz / confirmed), std::sqrt(zs / confirmed));
  EXPECT_GE(confirmed, 6 * runs - runs / 2);
  // twelve squares of unit variance have a mean below 2.6 in 999 of 1000
  EXPECT_LT(std::sqrt(zf / confirmed), 1.6);
  EXPECT_LT(std::sqrt(zz / confirmed), 1.6);
  EXPECT_LT(std::sqrt(zs / confirmed), 1.6);
  EXPECT_LT(sharpest, 2e-5) << "the response alone has a law of 2e-4";
}

TEST(ForceModes, TheEdgeOfTheForceIsNoMode)
{
  const auto chain = chain_of_reference();
  int confirmed    = 0;
  for (const ForcedMode &mode : modes_of(record(chain, 77, 0.002, 300), 3).modes)
    if (mode.confirmed) {
      EXPECT_LT((chain.frequency.array() / mode.frequency).log().abs().minCoeff(), 0.01) << mode.frequency;
      EXPECT_LT(mode.frequency, 300);
      ++confirmed;
    }
  EXPECT_GE(confirmed, 2) << "of three below 300 Hz";
}

TEST(ForceModes, ADelayOfTheOtherClockIsIdentified)
{
  const auto chain = chain_of_reference();
  Record late      = record(chain, 57, 0.002);
  const auto none  = force_delay(modes_of(late).modes, 2);
  EXPECT_TRUE(none.identified);
  EXPECT_LT(std::abs(none.seconds), std::max(4 * none.deviation, 2e-5));
  constexpr Eigen::Index samples = 7;
  late.force.value = late.force.value.tail(late.force.value.size() - samples).eval();  // the force comes early
  late.force.pieces[0].end -= samples;
  for (CleanChannel &channel : late.channels) {
    channel.value.conservativeResize(late.force.value.size());
    channel.pieces[0].end -= samples;
  }
  ForcedModes modes      = modes_of(late);
  const ForceDelay delay = force_delay(modes.modes, 2);
  EXPECT_TRUE(delay.identified);
  EXPECT_TRUE(near(delay.seconds, samples / rate,
                   within_absolute(std::max(4 * delay.deviation, 2e-5),
                                   "four deviations; at least the least delay that is reported, 20 us")));
  EXPECT_LT(delay.deviation, 1e-4);
  // what is left after aligning: response of mode 6 in its middle is imaginary for an acceleration
  align(modes.response, delay.seconds);
  const auto k = Eigen::Index(std::lround(chain.frequency[5] / modes.response.resolution()));
  EXPECT_LT(std::abs(std::abs(std::arg(modes.response.H(k, 2))) - M_PI / 2), 0.25);
  EXPECT_FALSE(force_delay({}, 2).identified);
}

TEST(ForceModes, NothingFollowsAForceOfAnotherMill)
{
  const auto chain = chain_of_reference();
  Record other     = record(chain, 91, 0.002);
  other.force      = channel_of(synthetic::band_force(4711, other.force.value.size(), rate, 1000, 0, 1000).force);
  const ForcedModes modes = modes_of(other);
  EXPECT_LT(modes.best_coherence, 0.3);
  EXPECT_TRUE(modes.modes.empty());
}

TEST(ForceModes, TheBackgroundOfSharpModesIsNoMode)
{
  const auto mode = [](const double frequency, const double damping) {
    ForcedMode m{};
    m.frequency = frequency;
    m.damping   = damping;
    m.confirmed = true;
    return m;
  };
  // As fits of records of 12 and 30 s left them, beside modes of 38.9 and 54.0 Hz with 0.5 and 1 % of damping.
  std::vector<ForcedMode> modes{mode(34.2, 0.29), mode(38.9, 0.01), mode(54.0, 0.005),
                                mode(61.6, 0.14), mode(218, 0.04),  mode(230, 0.01)};
  drop_backgrounds(modes);
  std::string kept;
  for (const ForcedMode &m : modes)
    kept += m.confirmed ? "1" : "0";
  EXPECT_EQ(kept, "011011") << "a broad mode beside a sharp one stays where their bands are apart";
}
