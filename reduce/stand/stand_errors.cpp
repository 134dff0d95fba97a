#include "reduce/stand/stand_errors.h"
#include "core/records/number_in_chain.h"
#include "reduce/chain/error_sum.h"
#include "reduce/chain/frame_closure.h"
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
  std::string name;
  double error;
  Keys lacks;
  std::function<void(FourHigh &, StandSprings &)> move;  ///< by 1 + step
  double kept        = 0;   ///< m/N, by which the compliance with touching rolls changes that the frame keeps
  std::string source = {};  ///< see ErrorSum
};

/// What a frame on its modulus keeps while something else moves.
struct Keeping {
  bool closed   = false;
  double K_ZW   = 0;                        ///< N/m
  bool K1_given = false, K7_given = false;  ///< else of the frame's own parts

  Keeping(const FourHigh &stand, const LumpedStand &chain)
      : closed(is_closed(stand.frame) && !std::isnan(chain.K_ww.value)), K_ZW(chain.K_ZW.value),
        K1_given(stand.given.count("K1") > 0), K7_given(stand.given.count("K7") > 0)
  {
  }
  SeriesSprings series(const FourHigh &stand, const StandSprings &s) const
  {
    return series_springs(stand.frame, {s.K_Zy_upper, s.K_Zy_lower, std::isnan(s.K_ZW) ? K_ZW : s.K_ZW});
  }
  /// m/N, but for the contact of the work rolls
  double path(const FourHigh &stand, const StandSprings &s) const
  {
    const SeriesSprings made = series(stand, s);
    return 1 / (K1_given ? s.K1 : made.K1) + 1 / made.K2 + 1 / s.K3 + 1 / s.K5 + 1 / made.K6 +
           1 / (K7_given ? s.K7 : made.K7);
  }
  /// The stiffnesses that follow the modulus take what has changed, (30.11).
  void close(FourHigh &stand, StandSprings &s, const double kept) const
  {
    stand.frame = with_closing_compliance(stand.frame, kept - path(stand, s) + closing_compliance(stand.frame));
    const SeriesSprings made = series(stand, s);
    s.K1                     = K1_given ? s.K1 : made.K1;
    s.K7                     = K7_given ? s.K7 : made.K7;
  }
};

std::vector<Uncertain> springs_of_chain(const LumpedStand &chain, const Keeping &keeping)
{
  std::vector<Uncertain> all;
  const auto add = [&](double StandSprings::*spring, const char *name, const Parameter &p) {
    all.push_back({name, p.error_estimate, p.error_lacks.empty() ? Keys{name} : p.error_lacks,
                   [spring](FourHigh &, StandSprings &s) { s.*spring *= 1 + step; }});
  };
  const LumpedModel &m = chain.model;
  if (!keeping.closed || keeping.K1_given)  // else by the modulus and the parts of the frame
    add(&StandSprings::K1, "K1", m.K[0]);
  if (!keeping.closed || keeping.K7_given)
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

std::vector<Uncertain> inputs_of(const FourHigh &stand, const LumpedStand &chain)
{
  const Keeping keeping(stand, chain);
  std::vector<Uncertain> inputs = springs_of_chain(chain, keeping);
  for (const FrameValue &part : frame_values(stand.frame))
    inputs.push_back({part.tolerance_key.substr(0, part.tolerance_key.rfind("_tolerance")),
                      part.error,
                      {part.tolerance_key},
                      [member = part.member](FourHigh &s, StandSprings &) { s.frame.*member *= 1 + step; },
                      0,
                      part.source});
  if (!keeping.closed)
    return inputs;
  const auto nothing = [](FourHigh &, StandSprings &) {};
  const Parameter &K = chain.K_ww;
  inputs.push_back({"frame.modulus",
                    stand.frame.modulus_error,
                    {"frame.modulus"},
                    nothing,
                    (1 / (1 + step) - 1) / stand.frame.modulus});
  inputs.push_back({"K_ww", K.error_estimate, K.error_lacks.empty() ? Keys{"stand.K_ww.tangent"} : K.error_lacks,
                    nothing, step / (1 + step) / K.value});
  return inputs;
}

/// The stand with one input moved; of another number of unknowns where the input is zero and stays so.
StandModel moved(const Uncertain &input, const FourHigh &stand, const StandSprings &springs,
                 const LumpedStand &chain, const StandBuilder &build)
{
  FourHigh other           = stand;
  StandSprings its_springs = springs;
  input.move(other, its_springs);
  if (const Keeping keeping(stand, chain); keeping.closed)
    keeping.close(other, its_springs, keeping.path(stand, springs) + input.kept);
  return build(other, its_springs);
}

/// Too little of a motion's stiffness or mass to matter.
bool is_felt(const ModalSensitivity &s, const Eigen::VectorXd &squared)
{
  const Eigen::VectorXd stiffness = s.dK.diagonal().cwiseAbs().cwiseQuotient(squared),
                        mass      = s.dM.diagonal().cwiseAbs();
  return std::max(stiffness.maxCoeff(), mass.maxCoeff()) > 2 * no_slope;
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
  std::vector<ErrorSum> of_mode(static_cast<std::size_t>(m));
  const Eigen::VectorXd unmoved = quotients(modes.model);
  for (const Uncertain &input : inputs_of(stand, chain)) {
    const StandModel other = moved(input, stand, springs, chain, build);
    if (other.M.rows() != modes.model.M.rows())
      continue;
    const Eigen::VectorXd quotient = quotients(other);
    for (Eigen::Index i = 0; i < m; ++i) {
      const double slope = 0.5 * std::log(quotient[i] / unmoved[i]) / step;
      if (!(std::abs(slope) > no_slope))
        continue;
      of_mode[std::size_t(i)].add(slope, input.error, input.source);
      if (std::isnan(input.error)) {
        Keys &lacks = sum.lacks[std::size_t(i)];
        for (const std::string &key : input.lacks)
          if (std::find(lacks.begin(), lacks.end(), key) == lacks.end())
            lacks.push_back(key);
      }
    }
  }
  for (Eigen::Index i = 0; i < m; ++i)
    sum.error[i] = of_mode[std::size_t(i)].error();
  return sum;
}

void set_connection_errors(StandModel &model, const FourHigh &stand, const StandSprings &springs,
                           const LumpedStand &chain, const StandBuilder &build)
{
  std::vector<ErrorSum> of_connection(model.connections.size());
  for (const Uncertain &input : inputs_of(stand, chain)) {
    const StandModel other = moved(input, stand, springs, chain, build);
    if (other.connections.size() != model.connections.size())
      continue;
    for (std::size_t c = 0; c < model.connections.size(); ++c) {
      const double slope =
          std::log(other.connections[c].stiffness.sum() / model.connections[c].stiffness.sum()) / step;
      if (std::abs(slope) > no_slope)
        of_connection[c].add(slope, input.error, input.source);
    }
  }
  for (std::size_t c = 0; c < model.connections.size(); ++c)
    model.connections[c].error_estimate = of_connection[c].error();
}

std::vector<ModalSensitivity> modal_sensitivities(const StandWithModes &modes, const FourHigh &stand,
                                                  const StandSprings &springs, const LumpedStand &chain,
                                                  const StandBuilder &build)
{
  const Eigen::MatrixXd K = stiffness_of(modes.model), &V = modes.modes.shape;
  const Eigen::VectorXd squared = (2 * M_PI * modes.modes.frequency).cwiseAbs2();
  std::vector<ModalSensitivity> all;
  for (const Uncertain &input : inputs_of(stand, chain)) {
    const StandModel other = moved(input, stand, springs, chain, build);
    if (other.M.rows() != modes.model.M.rows())
      continue;
    ModalSensitivity s{input.name, input.error, input.lacks, V.transpose() * (stiffness_of(other) - K) * V / step,
                       V.transpose() * (other.M - modes.model.M) * V / step};
    if (is_felt(s, squared))
      all.push_back(std::move(s));
  }
  return all;
}

std::vector<ModalSensitivity> modal_sensitivities(const StandWithModes &modes, const LumpedModel &chain)
{
  const Eigen::MatrixXd &V      = modes.modes.shape;
  const Eigen::VectorXd squared = (2 * M_PI * modes.modes.frequency).cwiseAbs2();
  const Eigen::MatrixXd none    = Eigen::MatrixXd::Zero(V.cols(), V.cols());
  std::vector<ModalSensitivity> all;
  const auto add = [&](const std::string &name, const Parameter &p, Eigen::MatrixXd dK, Eigen::MatrixXd dM) {
    ModalSensitivity s{name, p.error_estimate, p.error_lacks.empty() ? Keys{name} : p.error_lacks, std::move(dK),
                       std::move(dM)};
    if (is_felt(s, squared))
      all.push_back(std::move(s));
  };
  for (const Connection &spring : modes.model.connections) {
    const Eigen::MatrixXd strain = spring.rows * V;
    add(spring.name, *number_in_chain(chain, choice_named<ChainNumber>(spring.name).value()),
        strain.transpose() * spring.stiffness.asDiagonal() * strain, none);
  }
  for (Eigen::Index i = 0; i < 6; ++i)
    add("M" + std::to_string(i + 1), chain.M[std::size_t(i)], none,
        modes.model.M(i, i) * V.row(i).transpose() * V.row(i));
  return all;
}

FrequencyErrors gap_share_errors(const StandWithModes &modes, const std::vector<ModalSensitivity> &inputs)
{
  const Eigen::Index m     = modes.modes.frequency.size();
  const Eigen::VectorXd g  = modes.modes.shape.transpose() * modes.model.b;
  const Eigen::VectorXd w2 = (2 * M_PI * modes.modes.frequency).cwiseAbs2(), q = g.cwiseQuotient(w2);
  const double compliance = g.dot(q);
  FrequencyErrors sum{Eigen::VectorXd::Zero(m), std::vector<Keys>(std::size_t(m))};
  for (const ModalSensitivity &input : inputs)
    for (Eigen::Index k = 0; k < m; ++k) {
      double dg = -0.5 * g[k] * input.dM(k, k);
      for (Eigen::Index j = 0; j < m; ++j)
        if (j != k && w2[j] != w2[k])
          dg += g[j] * (input.dK(j, k) - w2[k] * input.dM(j, k)) / (w2[k] - w2[j]);
      const double d_w2  = input.dK(k, k) - w2[k] * input.dM(k, k);
      const double slope = std::abs(2 * dg / g[k] - d_w2 / w2[k] + q.dot(input.dK * q) / compliance);
      if (!(slope > no_slope))
        continue;
      if (!std::isnan(input.error))
        sum.error[k] += slope * input.error;
      else
        for (const std::string &key : input.lacks)
          if (Keys &lacks = sum.lacks[std::size_t(k)]; std::find(lacks.begin(), lacks.end(), key) == lacks.end())
            lacks.push_back(key);
    }
  for (Eigen::Index k = 0; k < m; ++k) {
    Keys &lacks = sum.lacks[std::size_t(k)];
    if (g[k] == 0)
      lacks = {"a share of zero has no relative error"};
    if (!lacks.empty())
      sum.error[k] = std::numeric_limits<double>::quiet_NaN();
  }
  return sum;
}
}  // namespace mill::reduce
