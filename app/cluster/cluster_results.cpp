#include "app/cluster/cluster_results.h"
#include "core/base/files.h"
#include "core/base/short_number.h"
#include "core/records/cluster_names.h"
#include "core/records/rows_of_cluster.h"
#include "dynamics/cluster/stability.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <tuple>

namespace mill {
namespace {
Parameter parameter(const ClusterPassRun &pass, const double value, const char *unit, const std::string &method)
{
  Parameter p;
  p.value  = value;
  p.unit   = unit;
  p.method = method;
  p.at     = {"{}", {{pass.force.value, "kN", ".5g"}}};
  p.inputs = pass.keys;
  return p;
}

// The error of the stiffness of a support, or of the law of a contact, is not known.
void lacks_error(Parameter &p, const ClusterStand &stand)
{
  for (std::size_t i = 0; i < stand.supports.size(); ++i)
    if (stand.supports[i].like.empty())
      p.error_lacks.push_back(fmt::format("support.{}.stiffness", i));
}

bool has_fitted_support(const ClusterStand &stand)
{
  return std::any_of(stand.supports.begin(), stand.supports.end(),
                     [](const ClusterSupport &s) { return s.fitted; });
}

const char *const static_method = "equilibrium of the stack, damped Newton (38.11)";

// A law would otherwise be the check of itself.
bool is_same(const cluster::ContactLaw &a, const cluster::ContactLaw &b)
{
  return std::tie(a.form, a.k, a.p, a.length, a.S, a.T) == std::tie(b.form, b.k, b.p, b.length, b.S, b.T);
}

double displacement(const ClusterPassRun &pass, const std::size_t roll, const int direction)
{
  return pass.state.rest.u[2 * Eigen::Index(roll) + direction];
}

// Straight up: what the rolls below and between weigh is taken off the force.
void add_contact(RunContext &run, const ClusterStand &stand, const ClusterPassRun &pass, const std::size_t i)
{
  const cluster::Contact &c = pass.state.stack.contacts[i];
  const double f            = pass.state.rest.contact_loads[i],
               d            = cluster::contact_state(pass.state.stack, c, pass.state.rest.u).approach;
  const auto name           = [&](const RowOf<2> &row) { return row.of(pass.pass->name, c.name); };
  Parameter force           = parameter(pass, f, "N", static_method);
  force.error_estimate      = f != 0 ? pass.state.rest.residual / std::abs(f) : 0;
  run.results.add(name(row::cluster::contact_force), force);
  if (c.strip) {
    Parameter K4   = parameter(pass, cluster::contact_tangent(c, d), "N/m",
                             std::isnan(stand.stack.strip_stiffness)
                                   ? "bite of the pass: plastic slope in series with both rolls (8.13)"
                                   : "stack.strip_stiffness");
    K4.error_lacks = {std::isnan(stand.stack.strip_stiffness) ? "strip.flow_stress" : "stack.strip_stiffness"};
    run.results.add(name(row::cluster::contact_tangent), K4);
  }
  if (!c.one_sided || f <= 0)
    return;
  Parameter approach = parameter(pass, d, "m", "law of the contact (38.3)-(38.5)"),
            tangent = parameter(pass, cluster::contact_tangent(c, d), "N/m", "law of the contact, dF/d(approach)"),
            secant  = parameter(pass, f / d, "N/m", "law of the contact, F/approach");
  // The other laws of a line contact under the same force.
  for (const auto &[law, named] :
       {std::pair(ClusterLaw::power, "Palmgren (38.4)"), std::pair(ClusterLaw::foeppl, "Foeppl (38.5)"),
        std::pair(ClusterLaw::johnson, "Johnson (38.5)")}) {
    ClusterStand variant = stand;
    for (ClusterContact &contact : variant.contacts)
      if (contact.like.empty())
        contact.law = law;
    const auto other = cluster::stack_of(variant, *pass.pass, pass.force.value).contacts[i].law;
    if (is_same(other, c.law))
      continue;
    const double depth = cluster::approach(other, f);
    approach.checks.push_back({named, depth, ""});
    tangent.checks.push_back({named, cluster::tangent(other, depth), ""});
    secant.checks.push_back({named, f / depth, ""});
  }
  for (Parameter *p : {&approach, &tangent, &secant})
    p->error_lacks.push_back(fmt::format("contact.{}.law", i));
  run.results.add(name(row::cluster::contact_approach), approach);
  run.results.add(name(row::cluster::contact_tangent), tangent);
  run.results.add(name(row::cluster::contact_secant), secant);
}

// Load of each roller of a support on two rollers: what its bearing carries.
void add_roller_loads(RunContext &run, const ClusterPassRun &pass)
{
  for (const cluster::Support &support : pass.state.stack.supports) {
    if (support.type != cluster::Support::Type::rollers)
      continue;
    const auto loads      = cluster::roller_forces(support, pass.state.rest.u.segment<2>(2 * support.roll));
    const auto directions = cluster::roller_directions(support);
    for (const std::size_t k : {0, 1}) {
      const double angle = std::atan2(directions[k].y(), directions[k].x()) * 180 / M_PI;
      Parameter load     = parameter(
              pass, loads[k], "N",
              fmt::format("{}; the roller lies at {:.4g} deg from the rolling direction", static_method, angle));
      load.error_estimate = loads[k] != 0 ? pass.state.rest.residual / loads[k] : 0;
      run.results.add(row::cluster::roller_load.of(pass.pass->name, support.name, std::to_string(k + 1)), load);
    }
  }
}

ClusterModeRecord mode_record(const ClusterStand &stand, const ClusterPassRun &pass, const std::size_t k)
{
  const cluster::Mode &mode = pass.state.modes[k];
  ClusterModeRecord r;
  r.frequency = mode.frequency;
  r.label     = mode.label;
  for (std::size_t i = 0; i < pass.state.identity.size(); ++i)
    if (pass.state.identity[i] == int(k))
      r.identity = stand.modes[i].name;
  const int per_roll = pass.state.stack.per_roll();
  r.shape.resize(2 * Eigen::Index(stand.rolls.size()));
  for (Eigen::Index i = 0; i < r.shape.size() / 2; ++i)
    r.shape.segment<2>(2 * i) = mode.shape.segment<2>(per_roll * i);
  for (const cluster::Share &s : mode.elastic)
    r.elastic.push_back({s.name, s.value});
  for (const cluster::Share &s : mode.kinetic)
    r.kinetic.push_back({s.name, s.value});
  return r;
}
}  // namespace

ClusterPassRecord pass_record(const ClusterStand &stand, const ClusterPassRun &pass)
{
  const cluster::PassState &state = pass.state;
  ClusterPassRecord r;
  r.name         = pass.pass->name;
  r.force        = pass.force.value;
  r.force_source = pass.force.given ? "given" : "computed: " + pass.force.method;
  r.displacement = state.rest.u;
  r.least_root   = state.rest.least_root;
  for (std::size_t i = 0; i < state.stack.contacts.size(); ++i) {
    const cluster::Contact &c = state.stack.contacts[i];
    const double f            = state.rest.contact_loads[i],
                 d            = cluster::contact_state(state.stack, c, state.rest.u).approach;
    r.contacts.push_back({c.name, f, d, cluster::contact_tangent(c, d), !c.strip && d > 0 ? f / d : not_given});
  }
  const cluster::Tangent K =
      cluster::tangent(state.stack, state.stack.coupled ? cluster::with_rotation(state.rest.u) : state.rest.u);
  for (std::size_t i = 0; i < state.stack.supports.size(); ++i) {
    const cluster::Support &s = state.stack.supports[i];
    const Eigen::Vector2d u   = state.rest.u.segment<2>(2 * s.roll);
    const auto f              = cluster::support_force(s, u);
    r.supports.push_back({s.name, f.norm(), (u - s.anchor).norm(), not_given, not_given});
    if (f.norm() > 0) {
      const Eigen::Index index  = state.stack.per_roll() * s.roll;
      r.supports.back().tangent = f.normalized().dot(K.supports[i].block<2, 2>(index, index) * f.normalized());
    }
  }
  for (std::size_t k = 0; k < state.modes.size(); ++k)
    r.modes.push_back(mode_record(stand, pass, k));
  return r;
}

void add_state_results(RunContext &run, const ClusterStand &stand, const ClusterPassRun &pass)
{
  Parameter force = parameter(pass, pass.force.value, "N", pass.force.method);
  force.source    = pass.force.given ? Source::given : Source::computed;
  force.at        = {};
  if (!std::isnan(pass.force.closed))
    force.checks.push_back({pass.force.closed_method + ", same stress", pass.force.closed,
                            "the closed theory leaves out one term of the slab equation"});
  if (!std::isnan(pass.pass->published_force))
    force.checks.push_back(check(CheckId::published, pass.pass->published_force));
  if (!std::isnan(pass.pass->measured_force[0]))
    force.checks.push_back(check(CheckId::measured,
                                 0.5 * (pass.pass->measured_force[0] + pass.pass->measured_force[1]),
                                 fmt::format("middle of {:.4g} .. {:.4g} kN", 1e-3 * pass.pass->measured_force[0],
                                             1e-3 * pass.pass->measured_force[1])));
  run.results.add(row::cluster::force.of(pass.pass->name), force);
  for (std::size_t i = 0; i < pass.state.stack.contacts.size(); ++i)
    add_contact(run, stand, pass, i);
  add_roller_loads(run, pass);
  const cluster::Motion start = cluster::closed_form_approaches(pass.state.stack);
  for (std::size_t i = 0; i < stand.rolls.size(); ++i)
    for (const int direction : {0, 1}) {
      Parameter u = parameter(pass, displacement(pass, i, direction), "m", static_method);
      lacks_error(u, stand);
      if (direction == 1 && int(i) == cluster::strip_roll(stand))
        u.checks.push_back({"sum of approaches at the rolling force (38.10)", start[2 * Eigen::Index(i) + 1],
                            "without weight and without the supports next to the column"});
      run.results.add((direction ? row::cluster::y : row::cluster::x).of(pass.pass->name, stand.rolls[i].name), u);
    }
}

void add_mode_results(RunContext &run, const ClusterStand &stand, const ClusterPassRun &pass)
{
  for (std::size_t k = 0; k < pass.state.modes.size(); ++k) {
    const cluster::Mode &mode = pass.state.modes[k];
    Parameter f = parameter(pass, mode.frequency, "Hz", "tangent of the stack, " + mode.label + " (38.13)");
    lacks_error(f, stand);
    for (std::size_t i = 0; i < pass.state.identity.size(); ++i)
      if (pass.state.identity[i] == int(k) && !std::isnan(stand.modes[i].frequency))
        f.checks.push_back(check(
            CheckId::published, stand.modes[i].frequency,
            fmt::format("\"{}\", recognised by its shape with {:.2f}", stand.modes[i].name,
                        cluster::assurance(pass.state.stack,
                                           cluster::parsed_shape(pass.state.stack, stand.modes[i].shape), mode))));
    run.results.add(row::cluster::frequency.of(pass.pass->name, std::to_string(k + 1)), f);
  }
  for (std::size_t i = 0; i < pass.state.identity.size(); ++i) {
    if (pass.state.identity[i] < 0)
      continue;
    const cluster::Mode &mode = pass.state.modes[std::size_t(pass.state.identity[i])];
    Parameter f = parameter(pass, mode.frequency, "Hz", "mode recognised by its shape (38.14), " + mode.label);
    lacks_error(f, stand);
    if (!std::isnan(stand.modes[i].frequency))
      f.checks.push_back(check(
          CheckId::published, stand.modes[i].frequency,
          has_fitted_support(stand)
              ? "supports are fitted to some of the published frequencies: agreement with these is not evidence"
              : ""));
    run.results.add(row::cluster::mode.of(pass.pass->name, stand.modes[i].name), f);
  }
}

void add_stability(RunContext &run, const ClusterStand &stand, const ClusterPassRun &pass,
                   ClusterPassRecord &record)
{
  const cluster::Stack &stack = pass.state.stack;
  const std::string &name     = pass.pass->name;
  if (const auto buckling = cluster::buckling_load(stack)) {
    record.buckling_factor = buckling->factor;
    record.buckling_motion = buckling->motion;
    Parameter p =
        parameter(pass, buckling->factor, "1", "smallest eigenvalue zero, " + buckling->motion + " (38.24)");
    lacks_error(p, stand);
    run.results.add(row::cluster::buckling_factor.of(name), p);
  }
  for (std::size_t i = 0; i < stack.supports.size(); ++i)
    if (stack.supports[i].type == cluster::Support::Type::guide) {
      const auto least = cluster::least_guide(stack, i);
      record.least_guides.push_back({stack.supports[i].name, least.value_or(not_given)});
      if (!least)
        continue;
      Parameter p = parameter(pass, *least, "N/m", "smallest eigenvalue zero over the guide (38.24)");
      lacks_error(p, stand);
      run.results.add(row::cluster::least_guide.of(name, stack.supports[i].name), p);
    }
  const int roll = cluster::strip_roll(stand);
  if (const auto lost = cluster::leaving_load(stack, roll, {1, 0}, pass.force.value)) {
    record.leaving_force   = lost->load;
    record.leaving_contact = lost->contact;
    Parameter p            = parameter(pass, lost->load, "N",
                                       "horizontal force on " + stand.rolls[std::size_t(roll)].name + " at which contact " +
                                           lost->contact + " opens");
    lacks_error(p, stand);
    run.results.add(row::cluster::leaving_force.of(name), p);
  }
}
}  // namespace mill
