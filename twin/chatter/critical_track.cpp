#include "twin/chatter/critical_track.h"
#include "core/case/errors.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill::twin {
namespace {
constexpr double close_enough = 1e-9;  // m/s
constexpr int most_steps = 12, speeds_below = 16;

std::string said(const std::exception &error)
{
  if (const auto *input = dynamic_cast<const InputError *>(&error); input && !input->problems.empty())
    return input->problems.front().message;
  if (const auto *solver = dynamic_cast<const SolverError *>(&error))
    return solver->report.what + (solver->report.where.empty() ? "" : ": " + solver->report.where);
  return error.what();
}

Eigen::VectorXcd roots_at(const ChatterModel &model, const bite::RollBite &bite, const double speed)
{
  return dynamics::eigenvalues(
      dynamics::chatter_matrix(model.stand, dynamics::working_point(bite, speed, model.scheme).by));
}

std::complex<double> nearest_root(const Eigen::VectorXcd &roots, const std::complex<double> to)
{
  Eigen::Index i = 0;
  (roots.array() - to).abs().minCoeff(&i);
  return roots[i];
}

double doubt_of(const std::vector<InputDoubt> &doubts, const std::string &key, bool &streamed)
{
  const InputDoubt *best = nullptr;
  for (const InputDoubt &doubt : doubts)
    if (key.compare(0, doubt.key.size(), doubt.key) == 0 && (!best || doubt.key.size() > best->key.size()))
      best = &doubt;
  streamed = best && best->streamed;
  return best ? best->sd : 0;
}

// d(growth)/d ln p at the critical speed of everything that has a doubt, with its name.
struct Slope {
  std::string key, name;
  double growth;  // 1/s
};

std::vector<Slope> slopes_of(const ChatterModel &model, const bite::RollBite &bite, const CriticalPoint &at,
                             double &by_speed)
{
  const auto point     = dynamics::working_point(bite, at.speed, model.scheme);
  const auto pass      = bite::linear_sensitivity(point.bite, point.state, model.scheme);
  const auto A         = dynamics::chatter_matrix(model.stand, point.by);
  const auto root      = dynamics::slope_of_eigenvalue(A, at.root);
  const Eigen::Index n = model.stand.structure.n();
  const auto of_number = [&](const bite::PassNumber number) {
    return root.by(dynamics::chatter_matrix_by(model.stand, pass.by[std::size_t(number)])).real();
  };
  by_speed = of_number(bite::PassNumber::roll_speed);
  std::vector<Slope> slopes;
  for (const bite::PassNumber number : bite::numbers_of(point.bite))
    if (number != bite::PassNumber::roll_speed) {
      const auto name = name_of(number);
      slopes.push_back({name.key, name.name, of_number(number)});
    }
  for (const auto &number : model.numbers)
    slopes.push_back(
        {number.key, number.name, root.by(dynamics::chatter_matrix_by(model.stand, point.by, number)).real()});
  const char *span[][2] = {
      {"stand.entry_distance", "distance to the stand before"},
      {"stand.exit_distance",  "distance to the stand behind"}
  };
  for (int side = 0; side < 2; ++side) {  // the row of a tension goes with E/L, (27.7)
    Eigen::MatrixXd row   = Eigen::MatrixXd::Zero(A.rows(), A.cols());
    row.row(2 * n + side) = -A.row(2 * n + side);
    slopes.push_back({span[side][0], span[side][1], root.by(row).real()});
  }
  return slopes;
}
}  // namespace

bite::RollBite with_inputs(bite::RollBite bite, const ChatterInputs &in)
{
  const auto take = [](const double value, double &into) {
    if (std::isfinite(value))
      into = value;
  };
  take(in.entry_thickness, bite.strip.entry_thickness);
  take(in.exit_thickness, bite.strip.exit_thickness);
  take(in.entry_tension, bite.strip.entry_tension);
  take(in.exit_tension, bite.strip.exit_tension);
  take(in.width, bite.strip.width);
  return bite;
}

const std::vector<InputDoubt> &usual_doubts()
{
  static const std::vector<InputDoubt> doubts = {
      {"condition.entry_thickness", 0.005, true },
      {"condition.exit_thickness",  0.005, true },
      {"condition.entry_tension",   0.03,  true },
      {"condition.exit_tension",    0.03,  true },
      {"condition.width",           0.001, true },
      {"oil.",                      0.10,  false},
      {"strip.friction",            0.10,  false},
      {"strip.flow_stress",         0.03,  false},
      {"strip.initial_thickness",   0.01,  false},
      {"stand.masses[",             0.02,  false},
      {"lumped.M",                  0.02,  false},
      {"stand.stiffnesses[",        0.05,  false},
      {"lumped.K",                  0.05,  false},
      {"stand.modes[",              0.03,  false},
      {"stand.dampings[",           0.30,  false},
      {"dynamics.modal_damping",    0.30,  false},
      {"stand.entry_distance",      0.01,  false},
      {"stand.exit_distance",       0.01,  false},
  };
  return doubts;
}

CriticalTrack::CriticalTrack(ChatterModel model_) : model(std::move(model_)) {}

bool CriticalTrack::following() const
{
  return lost.empty();
}

const CriticalPoint &CriticalTrack::point() const
{
  return at;
}

const std::string &CriticalTrack::why() const
{
  return lost;
}

void CriticalTrack::begin(const dynamics::CriticalSpeed &found)
{
  at   = {};
  lost = dynamics::sentence(found, model.range);
  if (found.verdict != dynamics::Verdict::crossing)
    return;
  for (const dynamics::Crossing &c : found.crossings)
    if (c.speed == found.speed && c.slope > 0) {
      at = {c.speed, c.frequency, c.root, c.slope};
      lost.clear();
    }
}

bool CriticalTrack::follow(const bite::RollBite &bite)
{
  if (!following())
    return false;
  CriticalPoint next = at;
  try {
    Eigen::VectorXcd roots;
    double before = 0, real_before = 0;
    int step = 0;
    for (; step < most_steps; ++step) {
      roots             = roots_at(model, bite, next.speed);
      next.root         = nearest_root(roots, next.root);
      const double real = next.root.real();
      if (step > 0 && std::abs(next.speed - before) > 1e-6)
        next.slope = (real - real_before) / (next.speed - before);
      const double move = -real / next.slope;
      before            = next.speed;
      real_before       = real;
      if (std::abs(move) < close_enough)
        break;
      if (!(next.slope > 0) || !(std::abs(move) < 0.2 * at.speed)) {
        lost = "the path of the critical speed turned";
        return false;
      }
      next.speed += move;
    }
    next.frequency = std::abs(next.root.imag()) / (2 * M_PI);
    if (step == most_steps || !(next.speed > model.range.from) || !(next.speed < model.range.to)) {
      lost = fmt::format("the critical speed left the range of {:.4g} to {:.4g} m/s", model.range.from,
                         model.range.to);
      return false;
    }
    const double noise  = std::max(1e-9 * std::abs(next.root), 1e-13 * roots.cwiseAbs().maxCoeff()) + 1e-6;
    const bool vibrates = next.root.imag() != 0;
    if ((roots.array().real() > noise).any() || (vibrates && std::abs(next.frequency / at.frequency - 1) > 0.1)) {
      lost = "another mode became critical";
      return false;
    }
    // One speed below each time: a crossing that comes up there becomes the critical one.
    const double share = (0.5 + double(below++ % speeds_below)) / speeds_below;
    const double speed = model.range.from + share * (next.speed - model.range.from);
    if (const double growth = growth_at(bite, speed); growth > 1e-6) {
      lost = fmt::format("vibration grows at {:.2f} m/s, below the speed followed", speed);
      return false;
    }
  } catch (const std::exception &error) {
    lost = said(error);
    return false;
  }
  at = next;
  return true;
}

double CriticalTrack::growth_at(const bite::RollBite &bite, const double speed) const
{
  try {
    return roots_at(model, bite, speed)[0].real();
  } catch (const InputError &) {
  } catch (const SolverError &) {
  }
  return ChatterInputs::none;
}

CriticalInterval CriticalTrack::interval(const bite::RollBite &bite, const std::vector<InputDoubt> &doubts) const
{
  CriticalInterval interval;
  if (!following())
    return interval;
  double by_speed = 0, streamed = 0, model_part = 0, largest = 0;
  try {
    for (const Slope &slope : slopes_of(model, bite, at, by_speed)) {
      bool is_streamed  = false;
      const double sd   = doubt_of(doubts, slope.key, is_streamed);
      const double part = std::pow(slope.growth / by_speed * sd, 2);  // (27.4)
      (is_streamed ? streamed : model_part) += part;
      if (part > largest) {
        largest          = part;
        interval.largest = slope.name;
      }
    }
  } catch (const SolverError &) {  // two roots in one: no slope, no interval
    return interval;
  }
  const double all       = streamed + model_part;
  interval.streamed      = std::sqrt(streamed);
  interval.model         = std::sqrt(model_part);
  interval.low           = at.speed * std::exp(-1.96 * std::sqrt(all));
  interval.high          = at.speed * std::exp(1.96 * std::sqrt(all));
  interval.largest_share = all > 0 ? largest / all : 0;
  return interval;
}

double scheme_spread(const ChatterModel &model, const bite::RollBite &bite)
{
  double low = ChatterInputs::none, high = ChatterInputs::none;
  for (const auto scheme :
       {bite::Linearisation::sequential, bite::Linearisation::implicit, bite::Linearisation::frozen_friction}) {
    const auto found = dynamics::critical_speed(model.stand, bite, scheme, model.range);
    if (found.verdict != dynamics::Verdict::crossing)
      return ChatterInputs::none;
    low  = std::fmin(low, found.speed);
    high = std::fmax(high, found.speed);
  }
  return (high - low) / (high + low);
}
}  // namespace mill::twin
