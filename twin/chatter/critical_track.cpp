#include "twin/chatter/critical_track.h"
#include "core/base/errors.h"
#include "twin/chatter/critical_slopes.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill::twin {
namespace {
constexpr double close_enough = 1e-9;  // m/s
constexpr int most_steps = 12, speeds_below = 16;

std::string message_of(const std::exception &error)
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
      {"condition.entry_thickness", 0.005, true},
      {"condition.exit_thickness", 0.005, true},
      {"condition.entry_tension", 0.03, true},
      {"condition.exit_tension", 0.03, true},
      {"condition.width", 0.001, true},
      {"oil.", 0.10, false},
      {"strip.friction", 0.10, false},
      {"strip.flow_stress", 0.03, false},
      {"strip.initial_thickness", 0.01, false},
      {"stand.masses[", 0.02, false},
      {"M", 0.02, false},
      {"stand.stiffnesses[", 0.05, false},
      {"K", 0.05, false},
      {"stand.modes[", 0.03, false},
      {"stand.dampings[", 0.30, false},
      {"dynamics.modal_damping", 0.30, false},
      {"stand.entry_distance", 0.01, false},
      {"stand.exit_distance", 0.01, false},
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
  return last;
}

const std::string &CriticalTrack::why() const
{
  return lost;
}

void CriticalTrack::begin(const dynamics::CriticalSpeed &searched)
{
  last = {};
  lost = dynamics::sentence(searched, model.range);
  if (const auto critical = critical_point(searched)) {
    last = *critical;
    lost.clear();
  }
}

bool CriticalTrack::follow(const bite::RollBite &bite)
{
  if (!following())
    return false;
  CriticalPoint next = last;
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
      if (!(next.slope > 0) || !(std::abs(move) < 0.2 * last.speed)) {
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
    if ((roots.array().real() > noise).any() ||
        (vibrates && std::abs(next.frequency / last.frequency - 1) > 0.1)) {
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
    lost = message_of(error);
    return false;
  }
  last = next;
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
  double streamed = 0, model_part = 0, largest = 0;
  try {
    for (const CriticalSlope &slope : critical_slopes(model, bite, last)) {
      const InputDoubt *doubt = doubt_of(doubts, slope.key);
      if (!doubt)
        continue;
      const double part = std::pow(slope.slope * doubt->sd, 2);
      (doubt->streamed ? streamed : model_part) += part;
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
  interval.low           = last.speed * std::exp(-1.96 * std::sqrt(all));
  interval.high          = last.speed * std::exp(1.96 * std::sqrt(all));
  interval.largest_share = all > 0 ? largest / all : 0;
  return interval;
}

double scheme_spread(const ChatterModel &model, const bite::RollBite &bite)
{
  double low = ChatterInputs::none, high = ChatterInputs::none;
  for (const auto scheme : {Linearisation::sequential, Linearisation::implicit, Linearisation::frozen_friction}) {
    const auto critical = dynamics::critical_speed(model.stand, bite, scheme, model.range);
    if (critical.verdict != dynamics::Verdict::crossing)
      return ChatterInputs::none;
    low  = std::fmin(low, critical.speed);
    high = std::fmax(high, critical.speed);
  }
  return (high - low) / (high + low);
}
}  // namespace mill::twin
