#include "app/cluster/cluster_bite.h"
#include "app/cluster/cluster_modes.h"
#include "app/cluster/cluster_results.h"
#include "app/cluster/cluster_schedule.h"
#include "app/cluster/cluster_stage.h"
#include "app/trace/closed_form_parts.h"
#include "core/model/case.h"
#include "core/records/cluster_names.h"
#include "dynamics/cluster/response.h"
#include "reduce/bite/schedule/schedule.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
// m: a roll on the line of symmetry stays where it is, what the equilibrium leaves there is rounding.
constexpr double solved_to = 1e-15;

ClosedFormResult result_of(const KeyList &keys, const std::string &name, const double value, const char *unit,
                           const double force)
{
  ClosedFormResult r;
  r.name             = name;
  r.parameter.value  = value;
  r.parameter.unit   = unit;
  r.parameter.method = "equilibrium and modes of the stack";
  r.parameter.at     = {"{}", {{force, "kN", ".5g"}}};
  r.parameter.inputs = keys;
  r.closed           = keys;
  r.relation         = "balance of all rolls";
  r.file             = "dynamics/cluster/equilibrium";
  r.equation         = "(38.11)";
  return r;
}

// Velocities and accelerations under the dynamic force, linear.
void add_velocities_of(const ClusterStand &stand, const ClusterPass &pass, const cluster::PassState &state,
                       const double force, const KeyList &keys, std::vector<ClosedFormResult> &all)
{
  if (std::isnan(pass.dynamic_force) || std::isnan(pass.dynamic_frequency))
    return;
  const double amplitude = stand.response.force_factor * pass.dynamic_force;
  const auto u           = cluster::harmonic_response(
                state.stack, state.rest.u, cluster_dynamic_load(state.stack, force, amplitude), pass.dynamic_frequency);
  for (std::size_t i = 0; i < stand.rolls.size(); ++i)
    for (const int k : {0, 1}) {
      const double size = std::abs(u[state.stack.per_roll() * Eigen::Index(i) + k]);
      if (size <= solved_to)
        continue;
      const double omega = 2 * M_PI * pass.dynamic_frequency;
      const auto add     = [&](const char *quantity, const double value, const char *unit) {
        all.push_back(result_of(
                keys, result_name({family::cluster, pass.name, quantity, stand.rolls[i].name, k ? "y" : "x"}), value,
                unit, force));
        all.back().relation = "harmonic response with complex stiffness";
        all.back().file     = "dynamics/cluster/response";
        all.back().equation = "(38.16)";
      };
      add("velocity", omega * size, "m/s");
      add("acceleration", omega * omega * size, "m/s2");
    }
}

// Modes of the first pass by what they do to the gap, rolling and open.
void add_gap_modes_of(const Case &the_case, const ClusterStand &stand, const cluster::PassState &state,
                      const double force, std::vector<ClosedFormResult> &all)
{
  const ClusterPass &pass = stand.schedule.front();
  const double K4         = strip_spring(stand, pass, cluster_force(stand, pass));
  const auto add          = [&](const std::string &family, const double spring, const KeyList &keys) {
    const NamedStackModes named = named_modes(stand, state, spring);
    for (std::size_t k = 0; k < named.names.size(); ++k)
      if (is_listed(named.names[k])) {
        all.push_back(result_of(keys, family + named.names[k].key + ".frequency",
                                         named.modes.frequency[Eigen::Index(k)], "Hz", force));
        all.back().relation = "eigenvalue of the tangent with the strip";
        all.back().file     = "app/cluster/cluster_modes";
        all.back().equation = "(38.29)";
      }
  };
  add("open.mode.", 0, cluster_keys(the_case, 0, false));
  if (K4 > 0)
    add("mode.", K4, keys_of_bite(the_case, 0));
}

// Fits and work of the passes whose bite is drawn, as the static half has them.
void add_schedule(const Case &the_case, std::vector<ClosedFormResult> &all)
{
  const ScheduleQuestion q = schedule_question(the_case, false);
  if (q.passes.empty())
    return;
  const ScheduleRecord record = bite::schedule_of(q.passes);
  const auto add = [&](const KeyList &keys, const std::string &subject, const char *what, const double value,
                       const char *unit, const char *equation) {
    if (std::isnan(value))
      return;
    all.push_back(result_of(keys, result_name({family::cluster, subject, what}), value, unit, 0));
    ClosedFormResult &made = all.back();
    made.parameter.method  = "slab theory in closed form";
    made.parameter.at      = "";
    made.relation          = "roll bite of the pass";
    made.file              = "reduce/bite/schedule/schedule";
    made.equation          = equation;
  };
  for (std::size_t p = 0; p < record.passes.size(); ++p) {
    const PassForce &pass = record.passes[p];
    const bool fitted     = !std::isnan(pass.flat.flow_stress);
    add(q.keys[p], pass.name, "flow_stress", fitted ? pass.flat.flow_stress : pass.law_stress, "Pa", "(39.2)");
    add(q.keys[p], pass.name, "flow_stress_unflattened", pass.rigid.flow_stress, "Pa", "(39.2)");
    add(q.keys[p], pass.name, "flattened_radius", pass.flat.radius, "m", "(8.9)");
    add(q.keys[p], pass.name, "friction", pass.friction, "1", "");
    add(q.keys[p], pass.name, "deformation_power", pass.power, "W", "(39.6)");
    add(q.keys[p], pass.name, "deformation_torque", pass.torque, "N m", "(39.6)");
  }
}

// Numbers that the variants fit; one that has no fit has no result.
void add_fits(const Case &the_case, std::vector<ClosedFormResult> &all)
{
  const ClusterStand &stand = *std::get<ClusterCase>(the_case.spec).stand;
  for (std::size_t i = 0; i < stand.variants.size(); ++i) {
    const ClusterVariant &variant = stand.variants[i];
    std::size_t p                 = 0;
    for (std::size_t k = 0; k < stand.schedule.size(); ++k)
      if (stand.schedule[k].name == variant.pass)
        p = k;
    const ClusterPass &pass = stand.schedule[p];
    const double force      = cluster_force(stand, pass).value;
    const auto fit          = cluster::fit_variant(stand, variant, pass, force);
    const KeyList keys      = cluster_fit_keys(the_case, p, i);
    if (!fit.refused.empty())
      continue;
    for (const cluster::FittedNumber &n : fit.numbers) {
      all.push_back(result_of(keys, result_name({family::cluster, cluster_fit, variant.name, n.key}), n.value,
                              unit_of_cluster_key(n.key), force));
      all.back().relation = "least squares over the frequencies of the variant";
      all.back().file     = "dynamics/cluster/fit";
      all.back().equation = "(38.25)";
    }
  }
}
}  // namespace

// The run's own functions; a computed contact is a line contact by Johnson here.
std::vector<ClosedFormResult> closed_form_cluster(const Case &the_case)
{
  const ClusterStand &stand = *std::get<ClusterCase>(the_case.spec).stand;
  std::vector<ClosedFormResult> all;
  for (std::size_t p = 0; p < stand.schedule.size(); ++p) {
    const ClusterPass &pass = stand.schedule[p];
    const double force      = cluster_force(stand, pass).value;
    const auto state   = cluster::pass_state(rolled_stand(stand, pass, cluster_force(stand, pass)), pass, force);
    const KeyList keys = cluster_keys(the_case, p, false);
    const auto add = [&](const std::string &what, const std::string &more, const double value, const char *unit) {
      all.push_back(result_of(keys, result_name({family::cluster, pass.name, what, more}), value, unit, force));
    };
    add("force", "", force, "N");
    for (std::size_t i = 0; i < state.stack.contacts.size(); ++i) {
      const cluster::Contact &c = state.stack.contacts[i];
      const double f            = state.rest.contact_loads[i],
                   d            = cluster::contact_state(state.stack, c, state.rest.u).approach;
      add(c.name, "force", f, "N");
      if (!c.one_sided || f <= 0)
        continue;
      add(c.name, "approach", d, "m");
      add(c.name, "tangent", cluster::contact_tangent(c, d), "N/m");
      add(c.name, "secant", f / d, "N/m");
    }
    for (const cluster::Support &support : state.stack.supports) {
      if (support.type != cluster::Support::Type::rollers)
        continue;
      const auto loads = cluster::roller_forces(support, state.rest.u.segment<2>(2 * support.roll));
      for (const std::size_t k : {0, 1})
        all.push_back(result_of(
            keys, result_name({family::cluster, pass.name, "roller_load", support.name, fmt::format("{}", k + 1)}),
            loads[k], "N", force));
    }
    for (std::size_t i = 0; i < stand.rolls.size(); ++i)
      for (const int k : {0, 1})
        if (std::abs(state.rest.u[2 * Eigen::Index(i) + k]) > solved_to)
          add(stand.rolls[i].name, k ? "y" : "x", state.rest.u[2 * Eigen::Index(i) + k], "m");
    for (std::size_t k = 0; k < state.modes.size(); ++k) {
      add(fmt::format("f{}", k + 1), "", state.modes[k].frequency, "Hz");
      all.back().relation = "eigenvalue of the tangent";
      all.back().file     = "dynamics/cluster/modes";
      all.back().equation = "(38.13)";
    }
    if (p == 0)
      add_gap_modes_of(the_case, stand, state, force, all);
    add_velocities_of(stand, pass, state, force, cluster_keys(the_case, p, true), all);
  }
  add_schedule(the_case, all);
  add_fits(the_case, all);
  return all;
}
}  // namespace mill
