// Errors of frequencies from those of springs and masses.
#include "reduce/stand/six_masses.h"
#include "reduce/stand/stand_errors.h"
#include "tests/support/beam_demo.h"
#include "tests/support/near.h"
#include <algorithm>
#include <cmath>
#include <utility>

using namespace mill;
using namespace mill::reduce;

namespace {
StandModel beams(const FourHigh &stand, const StandSprings &springs)
{
  return beam_stand(stand, springs, 8);
}

FrequencyErrors errors_of(const FourHigh &stand, const LumpedStand &chain)
{
  const StandSprings springs = stand_springs(stand, chain);
  StandWithModes s{beams(stand, springs), {}};
  s.modes = stand_modes(s.model, 200);
  return frequency_errors(s, stand, springs, chain, beams);
}

/// The demo stand whose every input is exact.
std::pair<FourHigh, LumpedStand> exact_stand()
{
  FourHigh stand = demo_drawing();
  for (const char *part : {"post", "beam", "packing"})
    for (const char *half : {"upper_", "lower_"})
      for (const char *what : {"_mass", "_stiffness"})
        stand.frame.tolerance[std::string(half) + part + what] = 0;
  for (const char *key :
       {"piston_mass", "cylinder_mass", "balance_mass", "load_cell_mass", "piston_stiffness",
        "oil_column_stiffness", "cylinder_body_stiffness", "upper_chock_stiffness", "lower_chock_stiffness"})
    stand.frame.tolerance[key] = 0;
  LumpedStand chain = demo_chain(stand);
  for (Parameter *p : {&chain.model.K[0], &chain.model.K[2], &chain.model.K[4], &chain.model.K[6],
                       &chain.model.M[0], &chain.model.M[5], &chain.K_Zy_upper, &chain.K_Zy_lower})
    p->error_estimate = 0;
  return {stand, chain};
}
}  // namespace

TEST(StandErrors, FollowTheFrequenciesOfAMovedStand)
{
  auto [stand, chain]                            = exact_stand();
  chain.model.K[0].error_estimate                = 0.1;
  stand.frame.tolerance["upper_chock_stiffness"] = 0.2;
  stand.frame.tolerance["cylinder_mass"]         = 0.3;
  const Eigen::VectorXd f = stand_modes(beams(stand, stand_springs(stand, chain)), 200).frequency;
  const auto moved = [&, &chain = chain, &stand = stand](const double K1, const double chock, const double mass) {
    LumpedStand c = chain;
    FourHigh s    = stand;
    c.model.K[0].value *= K1;
    s.frame.upper_chock_stiffness *= chock;
    s.frame.cylinder_mass *= mass;
    return stand_modes(beams(s, stand_springs(s, c)), 250).frequency;
  };
  constexpr double d      = 1e-3;
  const Eigen::VectorXd a = moved(1 + d, 1, 1), b = moved(1, 1 + d, 1), c = moved(1, 1, 1 + d);
  const FrequencyErrors errors = errors_of(stand, chain);
  for (Eigen::Index i = 0; i < f.size(); ++i) {
    const double expected =
        (0.1 * std::abs(a[i] / f[i] - 1) + 0.2 * std::abs(b[i] / f[i] - 1) + 0.3 * std::abs(c[i] / f[i] - 1)) / d;
    EXPECT_TRUE(near(errors.error[i], expected, within(2e-3, "difference of 1e-3, first order", 1e-3)))
        << "mode " << i + 1;
    EXPECT_TRUE(errors.lacks[std::size_t(i)].empty());
  }
}

// The halves of an open frame know nothing of each other: only the modes above miss what is not stated above.
TEST(StandErrors, AModeNamesWhatItLacks)
{
  auto [stand, chain] = exact_stand();
  stand.frame.tolerance.erase("oil_column_stiffness");
  chain.model.K[0].error_estimate = not_given;
  chain.model.K[0].error_lacks    = {"frame.upper_post_stiffness_tolerance"};
  const FrequencyErrors errors    = errors_of(stand, chain);
  const auto unknown =
      std::count_if(errors.error.begin(), errors.error.end(), [](const double e) { return std::isnan(e); });
  EXPECT_GT(unknown, 0);
  EXPECT_LT(unknown, errors.error.size());
  for (Eigen::Index i = 0; i < errors.error.size(); ++i) {
    const Keys &lacks = errors.lacks[std::size_t(i)];
    EXPECT_EQ(std::isnan(errors.error[i]), !lacks.empty());
    if (!lacks.empty()) {
      EXPECT_EQ(std::count(lacks.begin(), lacks.end(), "frame.oil_column_stiffness_tolerance"), 1);
    }
  }
}

TEST(StandErrors, ModalSensitivitiesAreThoseOfTheFrequencies)
{
  auto [stand, chain]                            = exact_stand();
  chain.model.K[0].error_estimate                = 0.1;
  stand.frame.tolerance["upper_chock_stiffness"] = 0.2;
  stand.frame.tolerance["cylinder_mass"]         = 0.3;
  const StandSprings springs                     = stand_springs(stand, chain);
  StandWithModes s{beams(stand, springs), {}};
  s.modes                       = stand_modes(s.model, 200);
  const FrequencyErrors sums    = frequency_errors(s, stand, springs, chain, beams);
  Eigen::VectorXd by_modes      = Eigen::VectorXd::Zero(s.modes.frequency.size());
  const Eigen::VectorXd squared = (2 * M_PI * s.modes.frequency).cwiseAbs2();
  for (const ModalSensitivity &input : modal_sensitivities(s, stand, springs, chain, beams))
    if (input.error > 0)
      by_modes +=
          input.error * 0.5 * (input.dK.diagonal().cwiseQuotient(squared) - input.dM.diagonal()).cwiseAbs();
  EXPECT_TRUE(near(by_modes, sums.error,
                   within(2e-3, "steps of 1e-4 in Rayleigh's quotient, slopes below 1e-5 left out", 0.01)));
}

TEST(StandErrors, ModalSensitivitiesOfTheChainSumUp)
{
  const auto [stand, chain] = exact_stand();
  StandWithModes s{chain_stand(chain.model), {}};
  s.modes           = stand_modes(s.model);
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(6, 6), M = K;
  for (const ModalSensitivity &input : modal_sensitivities(s, chain.model)) {
    K += input.dK;
    M += input.dM;
  }
  const Eigen::MatrixXd squared = (2 * M_PI * s.modes.frequency).cwiseAbs2().asDiagonal();
  EXPECT_LT((K - squared).norm(), 1e-12 * squared.norm()) << "all springs together are the stiffness";
  EXPECT_LT((M - Eigen::MatrixXd::Identity(6, 6)).norm(), 1e-12) << "all masses together are the mass";
}
