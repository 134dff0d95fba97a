#include "app/stages/bite/schedule_results.h"
#include "app/stages/contact/contact_stage.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_cluster.h"
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill {
namespace {
std::string fit_text(const std::string &what, const PassForce &pass, const std::string &arc)
{
  return fmt::format("fit of one unknown: {} that returns the {} of {} on {}, met by construction", what,
                     pass.fitted_to_what, in_kN(pass.fitted_to), arc);
}

OperatingPoint pass_at(const PassForce &pass)
{
  return {"{} -> {}", {{pass.entry_thickness, "mm", ".4g"}, {pass.exit_thickness, "mm", ".4g"}}};
}

/// Adds results of one pass, or of all of them.
class ScheduleAdder {
public:
  ScheduleAdder(RunContext &run_, std::string subject_, OperatingPoint operating_point_, KeyList keys_)
      : run(run_), subject(std::move(subject_)), operating_point(std::move(operating_point_)),
        keys(std::move(keys_))
  {
  }
  void operator()(const RowOf<1> &row, const double value, const std::string &method,
                  std::vector<Check> checks = {}, const std::string &lacks = "friction and flow stress",
                  const Source source = Source::computed) const
  {
    if (std::isnan(value))
      return;
    Parameter p;
    p.value       = value;
    p.unit        = row.unit;
    p.source      = source;
    p.method      = method;
    p.at          = operating_point;
    p.checks      = std::move(checks);
    p.error_lacks = {lacks};
    p.inputs      = keys;
    run.results.add(row.of(subject), p);
  }

private:
  RunContext &run;
  std::string subject;
  OperatingPoint operating_point;
  KeyList keys;
};

KeyList keys_of_all(const ScheduleQuestion &q)
{
  KeyList all;
  for (const KeyList &keys : q.keys)
    all = joined(std::move(all), keys);
  return all;
}

// What the other theories say of the force with the fitted stress tells how far the stress itself may be off.
std::vector<Check> by_other_theories(const PassForce &pass)
{
  std::vector<Check> checks;
  for (const TheoryForce &theory : pass.theories)
    if (theory.refused.empty() && theory.force > 0)
      checks.push_back({"times fitted force over that of: " + theory.name,
                        pass.flat.flow_stress * pass.fitted_to / theory.force, "first order: force over stress"});
  return checks;
}

void add_pass(RunContext &run, const ScheduleQuestion &q, const std::size_t p, const PassForce &pass)
{
  const ScheduleAdder add(run, pass.name, pass_at(pass), q.keys[p]);
  const bool fitted = !std::isnan(pass.flat.flow_stress);
  if (fitted) {
    std::vector<Check> checks{
        {"on the roll's own radius, without flattening", pass.rigid.flow_stress, "also fitted"}};
    if (!std::isnan(pass.law_stress))
      checks.push_back({"flow stress law of the case at the exit", pass.law_stress, ""});
    for (const Check &other : by_other_theories(pass))
      checks.push_back(other);
    add(row::schedule::flow_stress, pass.flat.flow_stress, fit_text("flow stress", pass, "Hitchcock's arc"),
        checks, "one equation for two unknowns, friction is taken as it is");
    add(row::schedule::flow_stress_unflattened, pass.rigid.flow_stress,
        fit_text("flow stress", pass, "the roll's own radius"), {},
        "one equation for two unknowns, friction is taken as it is");
    std::vector<Check> radii;
    if (pass.radius_beyond != pass.flat.radius)
      radii.push_back({"power 2/3 beyond R'/R = 5.235 (39.1)", pass.radius_beyond, ""});
    add(row::schedule::flattened_radius, pass.flat.radius, "Hitchcock (8.9) under the " + pass.fitted_to_what,
        radii, "that the arc stays a circle");
  } else {
    add(row::schedule::flow_stress, pass.law_stress, "flow stress law of the case at the exit");
  }
  add(row::schedule::friction, pass.friction, "friction law of the strip at the speed of the pass", {},
      "the friction law");
  const std::string work =
      fitted ? "homogeneous deformation (39.6) with the fitted flow stress" : "homogeneous deformation (39.6)";
  add(row::schedule::deformation_power, pass.power, work, {},
      "a lower bound: friction and redundant work come on top");
  add(row::schedule::deformation_torque, pass.torque, work + ", one roll", {},
      "a lower bound: friction and redundant work come on top");
}

void add_common(RunContext &run, const ScheduleQuestion &q, const ScheduleRecord &record)
{
  for (const ScheduleLaw &law : record.laws) {
    if (!law.flattened)
      continue;
    const ScheduleAdder add(run, schedule_subject, fmt::format("{} passes", law.data), keys_of_all(q));
    const std::string how = fmt::format("fit of {} unknowns to {} passes, flow stress on Hitchcock's arc (39.4)",
                                        law.unknowns, law.data);
    add(row::schedule::hardening_stress, law.Y, how, {}, "what the fitted stresses lack");
    add(row::schedule::hardening_exponent, law.n, how, {}, "what the fitted stresses lack");
  }
  for (const DynamicForces &dynamics : record.dynamics) {
    if (!dynamics.flattened)
      continue;
    const ScheduleAdder add(run, schedule_subject, fmt::format("{} passes", dynamics.data), keys_of_all(q));
    add(row::schedule::dynamic_constant, dynamics.common,
        fmt::format("fit of one unknown to {} dynamic forces, geometric mean (39.8)", dynamics.data), {},
        "span, amplitude and mode of the strip are not known");
  }
}

void add_dynamic(RunContext &run, const ScheduleQuestion &q, const ScheduleRecord &record)
{
  for (const DynamicForces &dynamics : record.dynamics)
    for (const DynamicForce &force : dynamics.passes) {
      if (!dynamics.flattened)
        continue;
      const ScheduleAdder add(run, force.name, "", keys_of_all(q));
      std::vector<Check> checks;
      if (force.printed > 0)
        checks.push_back(check(CheckId::published, force.printed, force.in_fit ? "in the fit" : "blind test"));
      add(row::schedule::dynamic_force, force.with_common, "one constant for all passes (39.8), (39.9)", checks,
          "span, amplitude and mode of the strip are not known");
      add(row::schedule::force_per_displacement, force.per_displacement,
          "slope of (39.9), with the fitted flow stress");
    }
}
}  // namespace

void add_schedule_results(RunContext &run, const ScheduleQuestion &question, const ScheduleRecord &record)
{
  for (std::size_t p = 0; p < record.passes.size(); ++p)
    add_pass(run, question, p, record.passes[p]);
  add_common(run, question, record);
  add_dynamic(run, question, record);
}
}  // namespace mill
