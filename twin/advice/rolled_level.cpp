#include "twin/advice/rolled_level.h"
#include "core/base/errors.h"
#include "dynamics/chatter/loop.h"
#include <array>
#include <cmath>
#include <complex>
#include <utility>

namespace mill::twin {
namespace {
using Complex = std::complex<double>;

// N, rolling force over the one before; 1 where no bite is solved.
double force_ratio(const ChangedPass &pass, const double speed, const ChatterModel &model, const double before)
{
  try {
    return dynamics::working_point(pass.bite, speed, model.scheme).state.force / before;
  } catch (const InputError &) {  // the search says why
  } catch (const SolverError &) {
  }
  return 1;
}
// There is a critical speed, or nothing grows up to the end of the range.
bool is_known(const CriticalState &state)
{
  return state.at_least || state.search.verdict == dynamics::Verdict::crossing;
}
}  // namespace

RolledLevel::RolledLevel(const RolledPass &pass, OpenStand open, const ForceBand &force)
    : pass_(pass), open_(std::move(open)), force_(force)
{
  const auto without_bite = open_({});
  if (!without_bite)
    throw InputError("the stand has no model without its bite");
  const auto model = around(*without_bite, {});
  now_ = critical_state(model, pass.model.bite, pass.model.scheme, pass.model.range, pass.working_speed);
  if (!settled())
    return;
  const auto point         = dynamics::working_point(pass.model.bite, pass.working_speed, pass.model.scheme);
  const Eigen::MatrixXcd X = bite_receptances(*without_bite, {}, force.frequency);
  weight_.resize(force.frequency.size());
  for (Eigen::Index k = 0; k < weight_.size(); ++k) {  // (46.13)
    const double w = 2 * M_PI * force.frequency[k];
    const auto F   = 1.0 - dynamics::process_stiffness(model, point.by, Complex(0, w)) * X(k, X.cols() - 1);
    weight_[k]     = force.square[k] * std::pow(w, 4) * (pass.disturbance ? 1 : std::norm(F));
  }
  level_ = level_of(*without_bite, {}, point);
}

const Eigen::VectorXd &RolledLevel::level() const
{
  return level_;
}

const CriticalState &RolledLevel::now() const
{
  return now_;
}

bool RolledLevel::settled() const
{
  return !now_.no_bite && now_.growth < 0;
}

dynamics::ChatterStandModel RolledLevel::around(const VibratingStand &open,
                                                const std::vector<Attachment> &joined) const
{
  dynamics::ChatterStandModel model = pass_.model.stand;
  model.structure                   = joined_structure(open, joined);
  return model;
}

std::optional<RolledState> RolledLevel::after(StandChange change, const std::vector<Attachment> &joined,
                                              const std::vector<ProcessAction> &process) const
{
  const ChangedPass pass = changed_pass(pass_.model.bite, process);
  const double speed     = pass_.working_speed * pass.speed_factor;
  const auto scheme      = pass_.model.scheme;
  if (!process.empty())
    change.force = force_ratio(pass, speed, pass_.model, now_.force);
  const auto open = open_(change);
  if (!open)
    return {};
  RolledState state;
  const auto model = around(*open, joined);
  state.critical   = critical_state(model, pass.bite, scheme, pass_.model.range, speed);
  state.violated   = violations(pass, now_, state.critical, pass_.working_speed, pass_.process);
  if (is_known(now_) && is_known(state.critical))
    state.nearer = state.critical.speed / pass.speed_factor / now_.speed - 1;
  if (process.empty() || !settled() || state.critical.no_bite || !(state.critical.growth < 0))
    return state;
  state.level = level_of(*open, joined, dynamics::working_point(pass.bite, speed, scheme));
  return state;
}

Eigen::VectorXd RolledLevel::level_of(const VibratingStand &open, const std::vector<Attachment> &joined,
                                      const dynamics::WorkingPoint &point) const
{
  const auto model         = around(open, joined);
  const Eigen::MatrixXcd X = bite_receptances(open, joined, force_.frequency);
  const Eigen::Index m     = X.cols() - 1;
  Eigen::VectorXd square   = Eigen::VectorXd::Zero(m);
  for (Eigen::Index k = 0; k < weight_.size(); ++k) {  // (46.14)
    const Complex s(0, 2 * M_PI * force_.frequency[k]);
    const double answer = std::norm(1.0 - dynamics::process_stiffness(model, point.by, s) * X(k, m));
    square += weight_[k] / answer * X.row(k).head(m).cwiseAbs2().transpose();
  }
  return square.cwiseSqrt();
}

Eigen::VectorXd RolledLevel::slope(ProcessAction action) const
{
  constexpr double step = 1e-3;  // of the logarithm
  std::array<Eigen::VectorXd, 2> levels;
  try {
    for (const int side : {0, 1}) {
      action.factor         = std::exp(side == 0 ? -step : step);
      const ChangedPass one = changed_pass(pass_.model.bite, {action});
      const auto point =
          dynamics::working_point(one.bite, pass_.working_speed * one.speed_factor, pass_.model.scheme);
      StandChange change;
      change.force    = point.state.force / now_.force;
      const auto open = open_(change);
      if (!open)
        return {};
      levels[std::size_t(side)] = level_of(*open, {}, point);
    }
  } catch (const InputError &) {
    return {};
  } catch (const SolverError &) {
    return {};
  }
  return (levels[1].array() / levels[0].array()).log() / (2 * step);
}
}  // namespace mill::twin
