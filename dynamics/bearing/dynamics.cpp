#include "dynamics/bearing/dynamics.h"
#include "core/base/errors.h"
#include "dynamics/bearing/motion.h"
#include "dynamics/response/mill_model.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::dynamics {
namespace {
using Eigen::Vector2d;

void require(const bool good, const std::string &message)
{
  if (!good)
    throw InputError("bearing dynamics: " + message);
}

void require_oscillator(const BearingOscillator &o, const double duration, const double output_rate)
{
  require(std::isfinite(o.mass) && o.mass > 0, fmt::format("mass {:g} kg has to be positive", o.mass));
  require(std::isfinite(o.damping) && o.damping >= 0,
          fmt::format("damping {:g} N s/m must not be negative", o.damping));
  require(o.tolerance >= 1e-13 && o.tolerance <= 1e-3,
          fmt::format("tolerance {:g} is outside 1e-13 .. 1e-3", o.tolerance));
  require(o.mean_load.allFinite(), "the mean load is not a number");
  require(std::isfinite(o.amplitude) && (o.amplitude == 0 || o.frequency > 0),
          fmt::format("a harmonic force of {:g} N needs a frequency above zero, not {:g} Hz", o.amplitude,
                      o.frequency));
  require((o.amplitude == 0 && !o.record) || (o.direction.allFinite() && o.direction.norm() > 0),
          "a force that varies needs a direction");
  require(std::isfinite(duration) && duration > 0, fmt::format("duration {:g} s has to be positive", duration));
  require(std::isfinite(output_rate) && output_rate > 0,
          fmt::format("output rate {:g} Hz has to be positive", output_rate));
  require(duration * output_rate >= 1 && duration * output_rate <= 5e7,
          fmt::format("{:g} s at {:g} Hz are {:.3g} outputs; between 1 and 5e7 are possible", duration,
                      output_rate, duration * output_rate));
  if (!o.record)
    return;
  const Eigen::VectorXd &time = o.record->time;
  require(time.size() >= 2 && time.size() == o.record->force.size(),
          "the force record needs two samples at least");
  require(duration <= (time[time.size() - 1] - time[0]) * (1 + 1e-12),
          fmt::format("duration {:g} s is longer than the force record, {:g} s; shorten it", duration,
                      time[time.size() - 1] - time[0]));
}

// One output: what the motion is at this instant.
void record_output(BearingResponse &response, const Eigen::Index k, const BearingMotion &motion,
                   const BearingState &state)
{
  response.position.row(k)     = state.position;
  response.velocity.row(k)     = state.velocity;
  response.acceleration.row(k) = acceleration(motion, response.time[k], state);
  response.force[k]            = force_at(motion.law, state.position.norm()).force;
}

// Small motions about the mean position: along the load the slope of the curve, across it the secant, since a
// force that always points to the middle turns with the mass.
void add_frequencies(BearingResponse &response, const BearingMotion &motion)
{
  const double load            = motion.mean_load.norm();
  response.static_displacement = displacement_under(motion.law, load);
  if (load == 0)
    return;
  const double along        = force_at(motion.law, response.static_displacement).tangent;
  response.frequency_along  = std::sqrt(along / motion.mass) / (2 * M_PI);
  response.frequency_across = std::sqrt(load / response.static_displacement / motion.mass) / (2 * M_PI);
}

void add_spectra(BearingResponse &response, const BearingMotion &motion, const double output_rate)
{
  if (response.time.size() < 16)
    return;  // nothing to see in so few samples
  response.spectrum       = amplitude_spectral_density(response.acceleration * motion.direction, output_rate);
  response.force_spectrum = amplitude_spectral_density(response.force, output_rate);
  Eigen::Index highest    = 0;
  response.spectrum.density.maxCoeff(&highest);
  response.spectrum_peak = response.spectrum.frequency[highest];
}

void add_notes(BearingResponse &response, const BearingMotion &motion)
{
  const double farthest = response.position.rowwise().norm().maxCoeff(), end = motion.law.largest();
  if (farthest > end)
    response.notes.push_back(
        fmt::format("the mass moves up to {:.4g} um from the middle, the curve of the bearing "
                    "ends at {:.4g} um and is continued straight on; widen the swept loads",
                    1e6 * farthest, 1e6 * end));
  if (motion.law.limited)
    response.notes.push_back(
        "the slopes of the bearing's curve were reduced so that its force does not fall between "
        "two samples; sweep more loads");
}

// Share of the time between loss and return; the motion starts with `touching`.
double share_without_contact(const std::vector<ContactEvent> &events, bool touching, const double begin,
                             const double end)
{
  double apart = 0, since = begin;
  for (const ContactEvent &event : events) {
    if (!touching)
      apart += event.time - since;
    touching = event.regained;
    since    = event.time;
  }
  if (!touching)
    apart += end - since;
  return apart / (end - begin);
}
}  // namespace

BearingResponse simulate(const BearingOscillator &oscillator, const double duration, const double output_rate)
{
  require_oscillator(oscillator, duration, output_rate);
  const BearingMotion motion = bearing_motion(oscillator);
  const auto n               = Eigen::Index(std::floor(duration * output_rate * (1 + 1e-12))) + 1;
  BearingResponse response;
  response.time         = Eigen::VectorXd::LinSpaced(n, 0, double(n - 1) / output_rate).array() + motion.begin;
  response.position     = Eigen::MatrixXd(n, 2);
  response.velocity     = Eigen::MatrixXd(n, 2);
  response.acceleration = Eigen::MatrixXd(n, 2);
  response.force        = Eigen::VectorXd(n);

  BearingState state  = oscillator.start ? *oscillator.start : at_rest(motion);
  const bool touching = touches(motion, state);
  record_output(response, 0, motion, state);
  MotionIntegrator integrator(motion, state);
  for (Eigen::Index k = 1; k < n; ++k) {
    state = integrator.advance(response.time[k], response.events);
    record_output(response, k, motion, state);
  }
  response.steps           = integrator.steps();
  response.without_contact = share_without_contact(response.events, touching, motion.begin, response.time[n - 1]);
  response.peak_force      = response.force.maxCoeff();
  response.peak_acceleration = response.acceleration.rowwise().norm().maxCoeff();
  add_frequencies(response, motion);
  add_spectra(response, motion, output_rate);
  add_notes(response, motion);
  return response;
}

Table bearing_response_table(const BearingResponse &response)
{
  Table table;
  table.add("time", "s", response.time)
      .add("x", "m", response.position.col(0))
      .add("y", "m", response.position.col(1))
      .add("force", "N", response.force)
      .add("acceleration_x", "m/s2", response.acceleration.col(0))
      .add("acceleration_y", "m/s2", response.acceleration.col(1));
  return table;
}

Table bearing_spectrum_table(const BearingResponse &response)
{
  Table table;
  table.add("frequency", "Hz", response.spectrum.frequency)
      .add("acceleration", "g/sqrt(Hz)", response.spectrum.density / standard_gravity)
      .add("force", "N/sqrt(Hz)", response.force_spectrum.density);
  return table;
}
}  // namespace mill::dynamics
