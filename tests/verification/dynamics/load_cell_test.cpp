// What a load cell shows of the bite force: frequency response, and a time run of sines.
#include "dynamics/response/frequency_response.h"
#include "dynamics/response/response.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include "tests/support/reference.h"
#include <cmath>

using namespace mill;
using namespace mill::dynamics;

namespace {
const MillModel &line_contact_stand()
{
  static const MillModel model = [] {
    const auto set = parameter_set("R1");
    return mill_model(set.stand, set.dynamics);
  }();
  return model;
}
}  // namespace

TEST(LoadCell, FrequencyResponse)
{
  for (const auto &row : reference("load_cell.R1").get<std::vector<std::vector<double>>>()) {
    const auto response = frequency_response(line_contact_stand(), Eigen::VectorXd::Constant(1, row[0]));
    EXPECT_TRUE(near(std::abs(response.load_cell[0]), row[1], within(1e-6, "one complex solve")))
        << row[0] << " Hz";
  }
}

TEST(LoadCell, TimeRunOfASineSettlesToIt)
{
  for (const double f : {20.0, 100.0, 200.0, 500.0}) {
    const double amplitude = 1000, rate = 20e3;
    const Eigen::ArrayXd time = Eigen::ArrayXd::LinSpaced(80001, 0, 80000) / rate;
    const ForceRecord force{time, 976e3 + amplitude * (2 * M_PI * f * time).sin(), {}};
    const Response response = mill_response(line_contact_stand(), force, rate);
    // after 3 s the slowest mode (38.9 Hz, 2 %) has fallen to exp(-0.02 * 244 * 3) = 4e-7
    const Eigen::ArrayXd end = response.load_cell.tail(20000).array() - 976e3;
    const double shown       = (end.maxCoeff() - end.minCoeff()) / 2;
    const auto exact         = frequency_response(line_contact_stand(), Eigen::VectorXd::Constant(1, f));
    EXPECT_TRUE(
        near(shown / amplitude, std::abs(exact.load_cell[0]),
             within(0.01, "straight lines take (pi f/rate)^2/3 = 0.2 %, crests fall between outputs 0.3 %")))
        << f << " Hz";
  }
}

TEST(LoadCell, AccelerationOfTheRollsInTheSameRun)
{
  const double f = 650, rate = 40e3;
  const Eigen::ArrayXd time = Eigen::ArrayXd::LinSpaced(160001, 0, 160000) / rate;
  const ForceRecord force{time, 976e3 + 1000 * (2 * M_PI * f * time).sin(), {}};
  const Response response = mill_response(line_contact_stand(), force, rate);
  const auto exact        = frequency_response(line_contact_stand(), Eigen::VectorXd::Constant(1, f));
  for (const Mass roll : {upper_work_roll, lower_work_roll}) {
    const double rms = std::sqrt(response.acceleration.col(roll).tail(40000).array().square().mean());
    EXPECT_TRUE(
        near(rms * std::sqrt(2), 1000 * std::abs(exact.acceleration(0, roll)),
             within(2e-3, "straight lines take (pi f/rate)^2/3 = 0.09 % of the sine, and fold (f/rate)^2 = 0.03 % "
                          "back onto it")));
  }
}
