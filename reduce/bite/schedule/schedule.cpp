#include "reduce/bite/schedule/schedule.h"
#include "core/base/errors.h"
#include "reduce/bite/schedule/arc_force.h"
#include "reduce/bite/schedule/deformation_power.h"
#include "reduce/bite/schedule/dynamic_force.h"
#include "reduce/bite/schedule/force_fit.h"
#include "reduce/bite/schedule/hardening_fit.h"
#include "reduce/bite/schedule/large_flattening.h"
#include "reduce/bite/schedule/rising_root.h"
#include "reduce/bite/slab/hu_ehmann.h"
#include "reduce/bite/slab/pass_inputs.h"
#include <cmath>
#include <functional>

namespace mill::bite {
namespace {
Theory theory_for(const RollBite &bite)
{
  return slides(bite.strip.friction) ? Theory::bland_ford : Theory::hu_ehmann;
}

Arc arc_of(const bool flattened)
{
  return flattened ? Arc::hitchcock : Arc::rigid;
}

RollBite with_constant_stress(RollBite bite, const double stress)
{
  bite.strip.flow_stress   = {};
  bite.strip.flow_stress.k = stress;
  return bite;
}

// Carries out what may be refused; `why` says so then.
void attempt(std::string &why, const std::function<void()> &action)
{
  try {
    action();
  } catch (const InputError &e) {
    why = e.problems.front().message;
  } catch (const SolverError &e) {
    why = e.report.what;
  }
}

PassFit fitted_stress(const RollBite &bite, const bool flattened, const double force)
{
  PassFit fit;
  attempt(fit.refused, [&] {
    const ForceFit fitted = fit_flow_stress(bite, theory_for(bite), arc_of(flattened), force);
    const BiteState &s    = fitted.state;
    fit.flow_stress       = fitted.value;
    fit.radius            = s.flattened_radius;
    fit.mean_pressure     = force / (bite.strip.width * (s.arc_length - s.exit_position));
    fit.neutral_point     = s.neutral_position / s.arc_length;
    fit.peak_pressure     = s.peak_pressure;
  });
  return fit;
}

// The factor of Hu and Ehmann, exact and as published, with the force of Coulomb's friction on the same arc.
void add_factors(PassForce &pass, const RollBite &bite)
{
  if (!slides(bite.strip.friction) || std::isnan(pass.flat.flow_stress))
    return;
  RollBite other             = with_constant_stress(bite, pass.flat.flow_stress);
  other.roll_radius          = pass.flat.radius;
  other.strip.friction       = {};
  other.strip.friction.law   = FrictionLaw::factor;
  pass.factor_of_mean        = 2 * pass.friction * pass.flat.mean_pressure / pass.flat.flow_stress;
  const Strip &s             = bite.strip;
  const RisingRoot published = rising_root(1e-6, 1, pass.fitted_to, [&](const double m) {
    return s.width * published_hu_ehmann_force(pass.flat.radius, s.entry_thickness, s.exit_thickness,
                                               s.entry_tension, s.exit_tension, 0.5 * pass.flat.flow_stress, m, m,
                                               0);
  });
  if (published.met)
    pass.factor_published = published.argument;
  std::string why;  // no factor up to one is answer enough
  attempt(why,
          [&] { pass.factor_exact = fit_friction(other, Theory::hu_ehmann, Arc::rigid, pass.fitted_to).value; });
}

void add_law_of_case(PassForce &pass, const RollBite &bite)
{
  if (!has_flow_stress(bite.strip))
    return;
  attempt(pass.law_refused, [&] {
    const RollBite one = with_exit_stress(bite);
    pass.law_stress    = one.strip.flow_stress.k;
    pass.law_force     = solve_slab(one, {theory_for(one), Arc::hitchcock, 0}).force;
  });
}

std::string what_is_fitted(const ScheduledPass &pass)
{
  if (pass.load > 0)
    return "load of the pass";
  return pass.published > 0 ? "published force" : "middle of the measured range";
}

PassForce pass_force(const ScheduledPass &from)
{
  const Strip &s = from.bite.strip;
  PassForce pass;
  pass.name            = from.name;
  pass.entry_thickness = s.entry_thickness;
  pass.exit_thickness  = s.exit_thickness;
  pass.entry_tension   = s.entry_tension;
  pass.exit_tension    = s.exit_tension;
  pass.speed           = from.bite.roll_speed;
  pass.strain =
      std::log((std::isnan(s.initial_thickness) ? s.entry_thickness : s.initial_thickness) / s.exit_thickness);
  pass.given         = from.load;
  pass.published     = from.published;
  pass.measured      = from.measured;
  pass.in_common_fit = from.in_common_fit;
  pass.fitted_to     = force_to_fit(from);
  if (pass.fitted_to > 0) {
    pass.fitted_to_what = what_is_fitted(from);
    pass.rigid          = fitted_stress(from.bite, false, pass.fitted_to);
    pass.flat           = fitted_stress(from.bite, true, pass.fitted_to);
    pass.radius_beyond  = flattened_radius_under(from.bite, pass.fitted_to);
  }
  pass.friction = friction_value(
      s.friction, follows_bite(s.friction) || !slides(s.friction)
                      ? not_given
                      : coulomb_coefficient(s.friction, Inlet<double>{from.bite.roll_speed, 0, 0, 1, 1, 1}));
  add_factors(pass, from.bite);
  add_law_of_case(pass, from.bite);
  const double stress = !std::isnan(pass.flat.flow_stress) ? pass.flat.flow_stress : pass.law_stress;
  if (stress > 0 && pass.speed > 0) {
    const auto work =
        deformation_power(stress, s.width, pass.speed, s.entry_thickness, s.exit_thickness, from.bite.roll_radius);
    pass.power      = work.power;
    pass.roll_force = work.roll_force;
    pass.torque     = work.torque;
  }
  return pass;
}

const PassFit &fit_on(const PassForce &pass, const bool flattened)
{
  return flattened ? pass.flat : pass.rigid;
}

// Passes of the common fit, without one of them.
std::vector<HardeningPoint> points_of(const ScheduleRecord &record, const bool flattened,
                                      const std::size_t without)
{
  std::vector<HardeningPoint> points;
  for (std::size_t i = 0; i < record.passes.size(); ++i) {
    const PassForce &pass = record.passes[i];
    if (i != without && pass.in_common_fit && !std::isnan(fit_on(pass, flattened).flow_stress))
      points.push_back({pass.name, pass.strain, fit_on(pass, flattened).flow_stress});
  }
  return points;
}

double force_by_stress(const RollBite &bite, const bool flattened, const double stress)
{
  return solve_slab(with_constant_stress(bite, stress), {theory_for(bite), arc_of(flattened), 0}).force;
}

void add_law(ScheduleRecord &record, const std::vector<ScheduledPass> &passes, const bool flattened)
{
  const std::size_t all     = passes.size();
  const HardeningFit fitted = fit_hardening(points_of(record, flattened, all));
  ScheduleLaw law;
  law.flattened   = flattened;
  law.Y           = fitted.Y;
  law.n           = fitted.n;
  law.Y_deviation = fitted.Y_deviation;
  law.n_deviation = fitted.n_deviation;
  law.unknowns    = fitted.unknowns;
  law.data        = fitted.data;
  for (std::size_t i = 0; i < all; ++i) {
    const RollBite &bite  = passes[i].bite;
    const PassForce &pass = record.passes[i];
    LawPass of;
    of.flow_stress = fitted.flow_stress(pass.strain);
    attempt(of.refused, [&] { of.force = force_by_stress(bite, flattened, of.flow_stress); });
    if (pass.fitted_to > 0)
      attempt(of.refused, [&] {
        of.friction = fit_friction(with_constant_stress(bite, of.flow_stress), theory_for(bite), arc_of(flattened),
                                   pass.fitted_to)
                          .value;
      });
    const auto others = points_of(record, flattened, i);
    if (others.size() > 1 && others.size() < std::size_t(fitted.data))
      attempt(of.refused, [&] {
        of.blind_force = force_by_stress(bite, flattened, fit_hardening(others).flow_stress(pass.strain));
      });
    law.passes.push_back(of);
  }
  record.laws.push_back(law);
}

void add_dynamics(ScheduleRecord &record, const std::vector<ScheduledPass> &passes, const bool flattened)
{
  std::vector<DynamicPass> dynamic;
  std::vector<bool> in_fit;
  for (std::size_t i = 0; i < passes.size(); ++i) {
    const PassFit &fit = fit_on(record.passes[i], flattened);
    if (std::isnan(fit.flow_stress))
      continue;
    const Strip &s = passes[i].bite.strip;
    dynamic.push_back({passes[i].name, fit.flow_stress, 0.5 * (s.entry_tension + s.exit_tension), s.width,
                       fit.radius, s.entry_thickness, s.exit_thickness, passes[i].bite.roll_speed,
                       passes[i].dynamic});
    in_fit.push_back(passes[i].in_common_fit);
  }
  DynamicForces fitted = dynamic_forces(dynamic, in_fit);
  fitted.flattened     = flattened;
  record.dynamics.push_back(std::move(fitted));
}
}  // namespace

bool has_flow_stress(const Strip &strip)
{
  return strip.flow_stress.k > 0 || strip.flow_stress.k0 > 0 || !strip.flow_stress.table.empty();
}

RollBite with_exit_stress(RollBite bite)
{
  const auto in       = pass_inputs<double>(bite, bite.roll_radius);
  const double stress = stress_at(bite.strip.flow_stress, in, in.exit_thickness);
  if (!(stress > 0))
    throw InputError("strip.flow_stress gives no stress at the exit thickness");
  return with_constant_stress(std::move(bite), stress);
}

double force_to_fit(const ScheduledPass &pass)
{
  if (pass.load > 0)
    return pass.load;
  return pass.published > 0 ? pass.published : 0.5 * (pass.measured[0] + pass.measured[1]);
}

ScheduleRecord schedule_of(const std::vector<ScheduledPass> &passes)
{
  require_input(!passes.empty(), "a pass schedule needs a pass");
  ScheduleRecord record;
  for (const ScheduledPass &pass : passes) {
    record.passes.push_back(pass_force(pass));
    for (const bool flattened : {false, true})
      if (const std::string &why = fit_on(record.passes.back(), flattened).refused; !why.empty())
        record.notes.push_back({WarningId::fit_refused,
                                "pass \"" + pass.name + "\"",
                                std::string("no fit of the flow stress on ") +
                                    (flattened ? "Hitchcock's arc" : "the roll's own radius"),
                                why,
                                "",
                                {pass.name}});
  }
  for (const bool flattened : {false, true}) {
    std::string why;
    if (points_of(record, flattened, passes.size()).size() > 0)
      attempt(why, [&] { add_law(record, passes, flattened); });
    if (!why.empty() && flattened)
      record.notes.push_back({WarningId::fit_refused, "schedule", "no hardening law was fitted", why});
    why      = "";
    bool any = false;
    for (const ScheduledPass &pass : passes)
      any = any || pass.dynamic > 0;
    if (any)
      attempt(why, [&] { add_dynamics(record, passes, flattened); });
    if (!why.empty() && flattened)
      record.notes.push_back({WarningId::fit_refused, "schedule", "the dynamic forces were not fitted", why});
  }
  return record;
}
}  // namespace mill::bite
