// The first calibration of a plant, through the program (RE-6): a case from a drawing with few keys, the rest
// estimated; a true stand within the errors that the case states; its record simulated by the program, with noise
// of sensors; 20 s, two sensors.
#include "app/twin/calibrate/calibrated_case.h"
#include "core/base/files.h"
#include "core/case/case_file.h"
#include "core/model/case.h"
#include "core/records/csv.h"
#include "dynamics/response/modes.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/synthetic_record.h"
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;
using namespace mill;

namespace {
constexpr double rate          = 5000;
constexpr Eigen::Index samples = 100000;

/// A stand within the errors that the drawing states.
struct TrueStand {
  LumpedModel model;
  double damping = 0;  ///< -
};

TrueStand drawn_stand(const PriorChain &prior, const std::uint64_t seed)
{
  TrueStand stand{prior.model, prior.stand.damping[0]};
  const auto u      = synthetic::uniforms(seed, 20);
  Eigen::Index next = 0;
  const auto factor = [&](const double sd) { return std::exp(sd * (2 * u[next++] - 1)); };
  for (const twin::Unknown &spring : prior.springs)
    (spring.name == "zeta" ? stand.damping : stand.model.K[std::size_t(spring.name[1] - '1')].value) *=
        factor(spring.prior_sd);
  for (const twin::Unknown &mass : prior.masses)
    stand.model.M[std::size_t(mass.name[1] - '1')].value *= factor(mass.prior_sd);
  return stand;
}

std::string case_of(const TrueStand &stand)
{
  std::string text = "schema = 1\nkind = \"lumped\"\n[given]\n";
  for (std::size_t i = 0; i < 6; ++i)
    text += fmt::format("M{} = \"{:.15g} kg\"\n", i + 1, stand.model.M[i].value);
  for (std::size_t i = 0; i < 7; ++i)
    text += fmt::format("K{} = \"{:.15g} N/m\"\n", i + 1, stand.model.K[i].value);
  return text + fmt::format("[[pass]]\nname = \"1\"\nforce = \"force.csv\"\n[dynamics]\nforce_meaning = "
                            "\"measured\"\nmodal_damping = \"{:.12g} %\"\noutput_rate = \"{:.15g} Hz\"\n",
                            100 * stand.damping, rate);
}

std::string force_of(const double mean)
{
  const Eigen::VectorXd force = synthetic::white(41, samples, rate, 60);  // 3 kN rms
  std::string text            = "time [s],force [kN]\n";
  for (Eigen::Index k = 0; k < samples; ++k)
    text += fmt::format("{:.4f},{:.9g}\n", double(k) / rate, (mean + force[k]) / 1e3);
  return text;
}

/// What two sensors record of a simulated response.
std::string recorded(const Table &response)
{
  constexpr double gravity = 9.80665, density = 0.005;  // m/s2 per root Hz
  std::string text = "time [s],force [kN],upper_work_roll [m/s2],lower_work_roll [m/s2]\n";
  EXPECT_EQ(response.column("force")->size(), samples) << "the response has another rate than the record";
  const Eigen::VectorXd upper = gravity * *response.column("upper_work_roll") +
                                synthetic::white(51, samples, rate, density),
                        lower = gravity * *response.column("lower_work_roll") +
                                synthetic::white(52, samples, rate, density);
  for (Eigen::Index k = 0; k < samples; ++k)
    text += fmt::format("{:.4f},{:.9g},{:.8g},{:.8g}\n", double(k) / rate, (*response.column("force"))[k],
                        upper[k], lower[k]);
  return text;
}
}  // namespace

TEST(CalibrateDrawing, AStandWithinTheStatedErrorsIsAcceptedWithItsFrequencies)
{
  const std::string folder = scratch("calibrate-drawing");
  ASSERT_EQ(millstand("new four-high -o drawing.toml", folder).exit_code, 0);
  const PriorChain prior = prior_chain(read_case(folder + "/drawing.toml"), std::nan(""));
  const TrueStand stand  = drawn_stand(prior, 77);
  write_atomically(folder + "/true.toml", case_of(stand));
  write_atomically(folder + "/force.csv", force_of(976.2e3));
  const Outcome simulated = millstand("simulate true.toml -q -o simulated", folder);
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  fs::create_directories(folder + "/measured");
  write_atomically(folder + "/measured/record.csv", recorded(read_table(folder + "/simulated/response/1.csv")));
  write_atomically(folder + "/measured/records.toml", "[[record]]\nfile = \"record.csv\"\nbetween = \"lines\"\n");
  const Outcome done =
      millstand("calibrate drawing.toml --model six-mass --measured measured -o calibrated", folder);
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  const auto json = nlohmann::json::parse(read_text(folder + "/calibrated/calibration.json"));
  DynamicsSettings measured;
  measured.force_meaning      = ForceMeaning::measured;
  const Eigen::VectorXd truth = dynamics::modes(dynamics::mill_model(stand.model, measured)).frequency;
  ASSERT_EQ(Eigen::Index(json["modes"].size()), (truth.array() < 900).count());
  int determined = 0, missed = 0;
  for (std::size_t i = 0; i < json["modes"].size(); ++i) {
    const auto &mode   = json["modes"][i];
    const double right = truth[Eigen::Index(i)], low = mode["interval"][0], high = mode["interval"][1];
    missed += low > right || high < right;
    EXPECT_LT(std::abs(right - 0.5 * (low + high)), 3.5 / 1.96 * 0.5 * (high - low))
        << "mode " << i + 1 << ": 3.5 standard deviations are exceeded once in two thousand";
    if (!mode["determined"].get<bool>())
      continue;
    ++determined;
    EXPECT_TRUE(near(mode["frequency"].get<double>(), right, within(0.005, "RE-6")));
  }
  EXPECT_LE(missed, 2) << "of six intervals of 95 % three miss with a probability of 0.2 %";
  EXPECT_GE(determined, 5);
}
