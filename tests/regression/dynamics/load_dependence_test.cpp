// The stand at six rolling forces: frequencies, and the level under white force relative to 976 kN (reference
// file, entries load.*).
#include "dynamics/response/frequency_response.h"
#include "dynamics/response/modes.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include "tests/support/reference.h"
#include <map>

using namespace mill;
using namespace mill::dynamics;

// One row of load.table: force, K3 = K5, K2, K6, six frequencies, ...
namespace {
MillModel stand_at(const std::vector<double> &row)
{
  auto stand       = published_stand();
  stand.K[2].value = stand.K[4].value = row[1];
  stand.K[1].value                    = row[2];
  stand.K[5].value                    = row[3];
  return mill_model(stand, settings(ForceMeaning::measured, 0.02));
}
}  // namespace

TEST(LoadDependence, FrequenciesAtEveryLoadAreThoseOfTheReference)
{
  for (const auto &row : reference("load.table").get<std::vector<std::vector<double>>>())
    EXPECT_TRUE(near(modes(stand_at(row)).frequency, Eigen::Map<const Eigen::VectorXd>(row.data() + 4, 6),
                     within(1e-6, "eigenvalues in double precision")))
        << row[0] << " N";
}

TEST(LoadDependence, LevelUnderWhiteForceIsThatOfTheReference)
{
  // 0.1 Hz lines: the sharpest peak, 38.9 Hz at 2 %, is 1.6 Hz wide, 16 lines
  const Eigen::VectorXd lines = Eigen::VectorXd::LinSpaced(10001, 0, 1000);
  std::map<double, Eigen::Vector2d> rms;
  for (const auto &row : reference("load.table").get<std::vector<std::vector<double>>>()) {
    const auto response = frequency_response(stand_at(row), lines);
    rms[row[0]]         = {response.acceleration.col(upper_work_roll).norm(),
                           response.acceleration.col(lower_work_roll).norm()};
  }
  const Tolerance grid = within(1e-3, "grid of the frequency integral, here and in the reference");
  for (const auto &row : reference("load.rms_ratio").get<std::vector<std::vector<double>>>()) {
    EXPECT_TRUE(near(rms.at(row[0])[0] / rms.at(976217.5)[0], row[1], grid)) << row[0] << " N, upper";
    EXPECT_TRUE(near(rms.at(row[0])[1] / rms.at(976217.5)[1], row[2], grid)) << row[0] << " N, lower";
  }
}
