// Faults of roll-neck bearings in the envelope: TW-09 on a record of the same make, and what is no fault.
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include "tests/support/synthetic_record.h"
#include "twin/bearings/fault_lines.h"
#include <cmath>

using namespace mill;
using namespace mill::twin;

namespace {
TurningBearing bearing_of_reference()
{
  const auto orders = reference("envelope.orders", "twin")["classic"];
  return {"trb", "work_roll", 0.42, orders["FTF"], orders["BPFO"], orders["BPFI"], orders["BSF"]};
}

// Impacts at the outer ring with slip of each spacing, ring-down, a strong tone and noise.
Eigen::VectorXd record(const std::uint64_t seed, const double impact)
{
  const auto in     = reference("envelope.inputs", "twin");
  const double rate = in["fs"], T = in["T"], shaft = in["v"].get<double>() / (M_PI * in["D"].get<double>());
  const auto n         = Eigen::Index(T * rate);
  Eigen::VectorXd x    = synthetic::white(seed, n, rate, in["density"]);
  const double spacing = 1 / (reference("envelope.orders", "twin")["classic"]["BPFO"].get<double>() * shaft);
  const double w = 2 * M_PI * in["ring_f"].get<double>(), z = in["ring_z"];
  const Eigen::VectorXd slips = synthetic::normals(seed + 1, Eigen::Index(T / spacing) + 50);
  double t                    = 0;
  for (Eigen::Index i = 0; t < T && i < slips.size(); ++i) {
    const auto first = Eigen::Index(std::ceil(t * rate));
    for (Eigen::Index k = first; k < std::min(n, first + Eigen::Index(0.02 * rate)); ++k) {
      const double since = double(k) / rate - t;
      x[k] += impact * std::exp(-z * w * since) * std::sin(w * since);
    }
    t += spacing * (1 + in["slip"].get<double>() * slips[i]);
  }
  for (Eigen::Index k = 0; k < n; ++k)
    x[k] += in["tone"][1].get<double>() * std::cos(2 * M_PI * in["tone"][0].get<double>() * double(k) / rate);
  return x;
}
}  // namespace

TEST(FaultLines, OuterRingAndNothingElse)
{
  const auto in      = reference("envelope.inputs", "twin");
  const double shaft = reference("envelope.orders", "twin")["shaft_hz"];
  Fourier fourier;
  for (const std::uint64_t seed : {601, 701}) {
    const auto s = envelope_spectrum(record(seed, in["impact"]), in["fs"], in["band"][0], in["band"][1], fourier);
    const auto found = fault_lines(s, bearing_of_reference(), shaft);
    ASSERT_EQ(found.size(), 4u);
    EXPECT_EQ(found[0].family, "BPFO");
    EXPECT_TRUE(found[0].indicated()) << found[0].score;
    EXPECT_NEAR(found[0].frequency, reference("envelope.lines", "twin")["BPFO"]["hz"].get<double>(), 1e-9);
    EXPECT_NEAR(found[0].slip, 0, 0.002);
    for (std::size_t i = 1; i < 4; ++i)
      EXPECT_LT(found[i].score, 5) << found[i].family << ", seed " << seed;
  }
}

TEST(FaultLines, AHealthyBearingShowsNone)
{
  const auto in = reference("envelope.inputs", "twin");
  Fourier fourier;
  for (const std::uint64_t seed : {601, 801, 901}) {
    const auto s = envelope_spectrum(record(seed, 0), in["fs"], in["band"][0], in["band"][1], fourier);
    for (const FaultLines &f :
         fault_lines(s, bearing_of_reference(), reference("envelope.orders", "twin")["shaft_hz"]))
      EXPECT_LT(f.score, 5) << f.family << ", seed " << seed;
  }
}

TEST(FaultLines, TheBandIsFoundByItsKurtosis)
{
  Fourier fourier;
  const auto s = envelope_spectrum(record(601, 1), 20000, 0, 0, fourier);
  EXPECT_LT(s.low, 3200);
  EXPECT_GT(s.high, 3200);
  EXPECT_GT(s.kurtosis, 3.2) << "noise has 3 with a standard deviation of 0.03";
}

TEST(FaultLines, WithoutPitchNothingIsGuessed)
{
  Fourier fourier;
  const double nan = std::nan("");
  const auto s     = envelope_spectrum(synthetic::normals(1, 40000), 20000, 2000, 5000, fourier);
  EXPECT_TRUE(fault_lines(s, {"trb", "work_roll", 0.42, nan, nan, nan, nan}, 3).empty());
  EXPECT_EQ(quick_length(1000003), 1000000);
}
