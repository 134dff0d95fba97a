// The generator of the records that other tests analyse: TW-01.
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include "tests/support/synthetic_record.h"
#include <algorithm>
#include <array>

using namespace synthetic;

namespace {
const Tolerance digits = within(1e-12, "same arithmetic", 1e-3);
}

TEST(SyntheticRecord, NumbersOfTheGenerator)
{
  EXPECT_TRUE(near(uniforms(1, 2)[0], 0.56656158, within_absolute(5e-9, "half of the last printed digit")));
  EXPECT_TRUE(near(uniforms(1, 2)[1], 0.74578176, within_absolute(5e-9, "half of the last printed digit")));
  EXPECT_TRUE(near(normals(1, 2)[0], -0.03426732, within_absolute(5e-9, "half of the last printed digit")));
  EXPECT_TRUE(near(normals(1, 2)[1], -1.29260853, within_absolute(5e-9, "half of the last printed digit")));
}

TEST(SyntheticRecord, LinesAndNoise)
{
  const auto in    = reference("lines.inputs", "twin");
  const auto lines = in["lines"].get<std::vector<std::array<double, 3>>>();
  const auto n     = Eigen::Index(in["n"].get<int>());
  const auto record =
      lines_record(lines, in["offset"], in["drift"], in["density"], in["seed"].get<int>(), n, in["fs"]);
  const auto known = reference("lines.samples", "twin");
  for (int i = 0; i < 3; ++i)
    EXPECT_TRUE(near(record[i], known["x"][std::size_t(i)], digits));
  EXPECT_TRUE(near(record[n - 1], known["x"][3], within(1e-9, "angles of 1e5 turns")));
  EXPECT_TRUE(near(std::sqrt(record.squaredNorm() / double(n)), known["rms"], digits));
}

// Records that a calibration is tried on; that of the closed frame is held against its entry by calibration_test.
TEST(SyntheticRecord, ResponseOfTheChain)
{
  const char *const places[] = {"upper_frame",     "upper_backup_roll", "upper_work_roll",
                                "lower_work_roll", "lower_backup_roll", "lower_frame"};
  Eigen::MatrixXd all;
  BandForce band;
  for (const std::string name : {"two", "six", "noisy", "low"}) {
    const auto in    = reference("calibrate." + name + ".inputs", "twin"),
               known = reference("calibrate." + name + ".record", "twin");
    auto M = in["M"].get<std::vector<double>>(), K = in["K"].get<std::vector<double>>();
    for (const auto &[key, change] : in["truth"].items())
      if (key != "zeta")
        K[std::size_t(key[1] - '1')] *= std::exp(change.get<double>());
    const double rate = in["fs"];
    const auto n      = Eigen::Index(in["T"].get<double>() * rate);
    const int seed    = in["seed"];
    if (name == "two" || name == "low") {  // the others are driven by the force of the first
      const auto truth = chain(Eigen::Map<Eigen::VectorXd>(M.data(), 6), Eigen::Map<Eigen::VectorXd>(K.data(), 7),
                               in["zeta"].get<double>() * std::exp(in["truth"]["zeta"].get<double>()));
      band = band_force(std::uint64_t(seed), n, rate, in["force_rms"], in["force_band"][0], in["force_band"][1]);
      all  = response(truth, band.drive, rate);
    }
    const Eigen::Index shown[] = {0, 1, n - 1};
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_TRUE(
          near(in["F0"].get<double>() + band.force[shown[i]], known["F"][i], within(1e-12, "same arithmetic")));
    for (std::size_t j = 0; j < in["sensors"].size(); ++j) {
      const auto place = std::find(std::begin(places), std::end(places), in["sensors"][j].get<std::string>());
      const Eigen::VectorXd x =
          all.col(place - std::begin(places)) + white(std::uint64_t(seed) + 1000 + j, n, rate, in["density"]);
      for (int i = 0; i < 3; ++i)
        EXPECT_TRUE(near(x[i], known["first"][j][std::size_t(i)], within(1e-9, "response", 1))) << name;
      const double rms = std::sqrt((x.array() - x.mean()).square().mean());
      EXPECT_TRUE(near(rms, known["rms"][j], within(1e-9, "response"))) << name;
    }
  }
}
