#include "reduce/chain/stand_errors.h"
#include "reduce/chain/spring_chain.h"
#include <algorithm>
#include <cmath>

namespace mill::reduce {
namespace {
constexpr double step = 1e-4;
constexpr double no_slope =
    1e-5;  // above rounding, and too little to matter even of a spring that is twice as stiff

/// An input of the stand that may be off.
struct Uncertain {
  double error;
  Keys lacks;
  std::function<void(FourHigh &, StandSprings &)> move;  ///< by 1 + step
};

std::vector<Uncertain> springs_of_chain(const LumpedStand &chain)
{
  std::vector<Uncertain> all;
  const auto add = [&](double StandSprings::*spring, const char *name, const Parameter &p) {
    all.push_back({p.error_estimate, p.error_lacks.empty() ? Keys{name} : p.error_lacks,
                   [spring](FourHigh &, StandSprings &s) { s.*spring *= 1 + step; }});
  };
  const LumpedModel &m = chain.model;
  add(&StandSprings::K1, "K1", m.K[0]);
  add(&StandSprings::K7, "K7", m.K[6]);
  add(&StandSprings::M1, "M1", m.M[0]);
  add(&StandSprings::M6, "M6", m.M[5]);
  add(&StandSprings::K3, "K3", m.K[2]);
  add(&StandSprings::K4, "K4", m.K[3]);
  add(&StandSprings::K5, "K5", m.K[4]);
  add(&StandSprings::K_Zy_upper, "K_Zy", chain.K_Zy_upper);
  add(&StandSprings::K_Zy_lower, "K_Zy_lower", chain.K_Zy_lower);
  add(&StandSprings::K_ZW, "K_ZW", chain.K_ZW);  // where it is given
  add(&StandSprings::Kzc_upper, "Kzc2", m.Kzc[1]);
  add(&StandSprings::Kzc_lower, "Kzc3", m.Kzc[2]);
  return all;
}
}  // namespace

FrequencyErrors frequency_errors(const StandWithModes &modes, const FourHigh &stand, const StandSprings &springs,
                                 const LumpedStand &chain, const StandBuilder &build)
{
  const Eigen::Index m = modes.modes.frequency.size();
  FrequencyErrors sum{Eigen::VectorXd::Zero(m), std::vector<Keys>(std::size_t(m))};
  const auto quotients = [&](const StandModel &model) {
    const Eigen::MatrixXd K = stiffness_of(model);
    Eigen::VectorXd all(m);
    for (Eigen::Index i = 0; i < m; ++i) {
      const auto v = modes.modes.shape.col(i);
      all[i]       = v.dot(K * v) / v.dot(model.M * v);
    }
    return all;
  };
  const Eigen::VectorXd unmoved = quotients(modes.model);
  std::vector<Uncertain> inputs = springs_of_chain(chain);
  for (const FrameValue &part : frame_values(stand.frame))
    inputs.push_back({part.error, {part.tolerance_key}, [member = part.member](FourHigh &s, StandSprings &) {
                        s.frame.*member *= 1 + step;
                      }});
  for (const Uncertain &input : inputs) {
    FourHigh other           = stand;
    StandSprings its_springs = springs;
    input.move(other, its_springs);
    const StandModel moved = build(other, its_springs);
    if (moved.M.rows() != modes.model.M.rows())
      continue;
    const Eigen::VectorXd quotient = quotients(moved);
    for (Eigen::Index i = 0; i < m; ++i) {
      const double slope = 0.5 * std::log(quotient[i] / unmoved[i]) / step;
      if (!(std::abs(slope) > no_slope))
        continue;
      sum.error[i] += std::abs(slope) * input.error;
      if (std::isnan(input.error)) {
        Keys &lacks = sum.lacks[std::size_t(i)];
        for (const std::string &key : input.lacks)
          if (std::find(lacks.begin(), lacks.end(), key) == lacks.end())
            lacks.push_back(key);
      }
    }
  }
  return sum;
}
}  // namespace mill::reduce
