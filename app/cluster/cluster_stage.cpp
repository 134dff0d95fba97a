#include "app/cluster/cluster_stage.h"
#include "app/cluster/cluster_bite.h"
#include "app/cluster/cluster_chatter.h"
#include "app/cluster/cluster_modes.h"
#include "app/cluster/cluster_results.h"
#include "app/cluster/cluster_schedule.h"
#include "app/run/curve_files.h"
#include "core/model/case.h"
#include "core/records/cluster_names.h"
#include "core/records/json_archive.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
ClusterRecord stack_record(const ClusterStand &written, const cluster::Stack &stack)
{
  const ClusterStand stand = cluster::written_out(written);
  ClusterRecord r;
  r.strip = stand.stack.strip;
  for (const cluster::Roll &roll : stack.rolls)
    r.rolls.push_back({roll.name, roll.centre.x(), roll.centre.y(), roll.radius, roll.mass});
  for (std::size_t i = 0; i < stack.contacts.size(); ++i)
    r.contacts.push_back({stack.contacts[i].name, stack.contacts[i].a, stack.contacts[i].b,
                          word_of(i < stand.contacts.size() ? stand.contacts[i].law : ClusterLaw::spring)});
  for (std::size_t i = 0; i < stack.supports.size(); ++i)
    r.supports.push_back({stack.supports[i].name, word_of(stand.supports[i].type), stack.supports[i].roll,
                          stand.supports[i].fitted});
  for (const ClusterMode &mode : stand.modes)
    r.published.push_back({mode.name, mode.shape, mode.frequency});
  return r;
}

std::string first_guide(const ClusterPassRecord &record)
{
  for (const ClusterShare &guide : record.least_guides)
    if (!std::isnan(guide.value))
      return fmt::format("; with guide {} of at least {:.3g} N/m the stack is stable", guide.name, guide.value);
  return "";
}

// A stack that buckles has no vibration: its numbers so far are kept, and the run ends there.
void refuse_buckled(const ClusterPassRun &pass, const ClusterPassRecord &record)
{
  if (pass.state.rest.stable())
    return;
  const cluster::Mode &worst = pass.state.modes.front();
  throw SolverError(
      {fmt::format("pass \"{}\": the stack buckles under {:.5g} kN", pass.pass->name, 1e-3 * pass.force.value),
       fmt::format("{} grows: its eigenvalue is {:.4g} 1/s2{}", worst.label, pass.state.rest.least_root,
                   first_guide(record)),
       "contacts push a roll out of the line of forces, and no support is stiff enough to hold it",
       "stiffer guides or supports of that roll, or a smaller force", ""});
}

// What has no equilibrium says in which pass, and under what.
cluster::PassState state_of_pass(const ClusterStand &stand, const ClusterPass &pass, const double force,
                                 const cluster::ComputedLaws &computed)
{
  try {
    return cluster::pass_state(stand, pass, force, computed);
  } catch (const SolverError &e) {
    SolverError::Report named = e.report;
    named.what = fmt::format("pass \"{}\", {:.5g} kN, {:.4g} kN across: {}", pass.name, 1e-3 * force,
                             1e-3 * pass.horizontal_force, named.what);
    throw SolverError(named);
  }
}

void warn_of_preload(RunContext &run, const ClusterStand &stand, const ClusterPassRun &pass)
{
  const std::string subject = "pass \"" + pass.pass->name + "\"";
  for (std::size_t i = 0; i < pass.state.stack.supports.size(); ++i) {
    const cluster::Support &s = pass.state.stack.supports[i];
    if (s.type != cluster::Support::Type::rollers)
      continue;
    const auto f = cluster::roller_forces(s, pass.state.rest.u.segment<2>(2 * s.roll));
    if (f[0] <= 0 || f[1] <= 0)
      run.warn({WarningId::support_preload,
                subject,
                fmt::format("the preload of support {} is lost, its rollers carry {:.4g} and {:.4g} N", s.name,
                            f[0], f[1]),
                "the roll is not held by all of its rollers",
                "",
                {},
                "",
                stand.supports[i].place});
  }
  for (std::size_t i = 0; i < pass.state.stack.contacts.size(); ++i)
    if (pass.state.stack.contacts[i].one_sided && pass.state.rest.contact_loads[i] <= 0)
      run.warn({WarningId::contact_partly_open,
                subject,
                fmt::format("contact {} is open, its rolls are {:.3g} um apart", pass.state.stack.contacts[i].name,
                            -1e6 * cluster::contact_state(pass.state.stack, pass.state.stack.contacts[i],
                                                          pass.state.rest.u)
                                       .approach),
                "",
                "",
                {},
                "",
                i < stand.contacts.size() ? stand.contacts[i].place : Place{}});
}

// Every frequency over the rolling force, from a quarter of the smallest to twice the largest of the passes.
void write_load_curve(RunContext &run, const ClusterStand &stand, const std::vector<ClusterPassRun> &passes,
                      const cluster::ComputedLaws &computed)
{
  double least = passes[0].force.value, most = least;
  for (const ClusterPassRun &pass : passes) {
    least = std::min(least, pass.force.value);
    most  = std::max(most, pass.force.value);
  }
  const ClusterStand rolled = rolled_stand(stand, *passes[0].pass, passes[0].force);
  constexpr int samples     = 25;
  const Eigen::Index n      = Eigen::Index(passes[0].state.modes.size());
  std::vector<double> forces;
  std::vector<Eigen::VectorXd> rows;
  for (int i = 0; i < samples; ++i) {
    const double force = 0.25 * least * std::pow(8 * most / least, i / double(samples - 1));
    try {
      const auto state = cluster::pass_state(rolled, *passes[0].pass, force, computed);
      Eigen::VectorXd f(n);
      for (Eigen::Index k = 0; k < n; ++k)
        f[k] = state.modes[std::size_t(k)].frequency;
      forces.push_back(force);
      rows.push_back(f);
    } catch (const SolverError &) {  // beyond buckling
    }
  }
  Table t;
  t.add("force", "N", Eigen::Map<const Eigen::VectorXd>(forces.data(), Eigen::Index(forces.size())));
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::VectorXd column(Eigen::Index(rows.size()));
    for (Eigen::Index i = 0; i < column.size(); ++i)
      column[i] = rows[std::size_t(i)][k];
    t.add(fmt::format("f{}", k + 1), "Hz", column);
  }
  write_curve(run, curve::cluster_load, "", t);
}

void solve_fits(RunContext &run, const ClusterStand &stand, const std::vector<ClusterPassRun> &passes,
                const cluster::ComputedLaws &computed, ClusterRecord &record)
{
  for (std::size_t i = 0; i < stand.variants.size(); ++i) {
    const ClusterVariant &variant = stand.variants[i];
    const ClusterPassRun *chosen  = &passes.front();
    for (const ClusterPassRun &pass : passes)
      if (pass.pass->name == variant.pass)
        chosen = &pass;
    const auto fit            = cluster::fit_variant(stand, variant, *chosen->pass, chosen->force.value, computed);
    const std::string subject = "variant \"" + variant.name + "\"";
    const std::vector<std::string> concerned{result_name({family::cluster, cluster_fit, variant.name})};
    if (!fit.refused.empty())
      run.warn({WarningId::variant_fit, subject, "no fit", fit.refused, "", concerned});
    else if (!fit.converged)
      run.warn({WarningId::variant_fit, subject,
                fmt::format("the fit has not converged after {} steps", fit.steps), "", "", concerned});
    else if (!fit.undetermined.empty())
      run.warn({WarningId::variant_fit, subject, "the frequencies do not identify " + fit.undetermined, "", "",
                concerned});
    add_fit_results(run, fit, cluster_fit_keys(run.the_case, chosen->p, i));
    record.fits.push_back(fit_record(stand, variant, fit));
  }
}

void say_what_is_assumed(RunContext &run, const ClusterStand &stand)
{
  for (const ClusterSupport &s : stand.supports)
    if (s.fitted && s.like.empty())
      run.assume(fmt::format(
          "the stiffness of support {} is fitted to frequencies; agreement with these frequencies is not evidence",
          s.own_name()));
  if (stand.stack.spin == ClusterSpin::free)
    run.assume(
        "contacts of the stack are frictionless; rolls turn freely in every vibration (stack.spin = \"coupled\" "
        "has the other limit)");
  if (stand.stack.strip.find('-') == std::string::npos)
    run.assume(
        "cluster.*: the strip is a force on the half of the stack that is drawn, not a spring; mode.* have the "
        "spring of the strip between both halves");
}
}  // namespace

KeyList cluster_keys(const Case &the_case, const std::size_t p, const bool driven)
{
  KeyList keys;
  const std::string pass = fmt::format("pass.{}.", p);
  const bool given       = the_case.places.count(pass + "load") > 0;
  // The spring of the strip between two rolls is that of the bite where it is not given.
  const bool of_bite = std::get<ClusterCase>(the_case.spec).stand->stack.strip.find('-') != std::string::npos &&
                       !the_case.places.count("stack.strip_stiffness");
  const auto ends = [](const std::string &key, const std::string &end) {
    return key.size() >= end.size() && key.compare(key.size() - end.size(), end.size(), end) == 0;
  };
  for (const auto &place : the_case.places) {
    const std::string &key = place.first;
    const auto begins_with = [&](const std::string &section) { return key.rfind(section, 0) == 0; };
    const bool dynamic =
        key == pass + "dynamic_force" || key == pass + "dynamic_frequency" || key == pass + "loss_factor";
    // Damping is not in the state at rest nor in the modes; a mark "fitted" is in no number.
    if (ends(key, ".fitted") ||
        (!driven && (ends(key, ".loss_factor") || ends(key, ".damping") || ends(key, ".damping_depth"))))
      continue;
    if (given && !of_bite && begins_with("stack.flattening_"))  // of the bite, which then gives no force
      continue;
    if (begins_with("steel.") || begins_with("stack.") || begins_with("roll.") || begins_with("contact.") ||
        begins_with("support.") || key == pass + "load" || key == pass + "horizontal_force" ||
        (driven && (begins_with("response.") || dynamic)))
      keys.push_back(key);
    const bool strip = begins_with("strip.") || begins_with("bite.") || key == pass + "entry_thickness" ||
                       key == pass + "exit_thickness" || key == pass + "entry_pull" || key == pass + "exit_pull" ||
                       key == pass + "speed";
    // What the strip was before the first pass, where nothing says it.
    const bool first_entry =
        p > 0 && key == "pass.0.entry_thickness" && !the_case.places.count("strip.initial_thickness");
    if ((strip || first_entry) && (!given || of_bite))
      keys.push_back(key);
  }
  return keys;
}

KeyList cluster_fit_keys(const Case &the_case, const std::size_t p, const std::size_t variant)
{
  KeyList keys = cluster_keys(the_case, p, false);
  for (const auto &[key, place] : the_case.places)
    if (key.rfind("mode.", 0) == 0 || key.rfind(fmt::format("variant.{}.", variant), 0) == 0)
      keys.push_back(key);
  return keys;
}

void solve_cluster(RunContext &run, const ClusterStand &stand, const Goal goal)
{
  const cluster::ComputedLaws computed = computed_laws(run, stand);
  StageTimer timer(run, "stack");
  std::vector<ClusterPassRun> passes;
  for (std::size_t p = 0; p < stand.schedule.size(); ++p) {
    ClusterPassRun pass;
    pass.p     = p;
    pass.pass  = &stand.schedule[p];
    pass.force = cluster_force(stand, *pass.pass);
    pass.state =
        state_of_pass(rolled_stand(stand, *pass.pass, pass.force), *pass.pass, pass.force.value, computed);
    pass.keys        = cluster_keys(run.the_case, p, false);
    pass.driven_keys = cluster_keys(run.the_case, p, true);
    passes.push_back(std::move(pass));
  }
  ClusterRecord record = stack_record(stand, passes.front().state.stack);
  for (const ClusterPassRun &pass : passes) {
    record.passes.push_back(pass_record(stand, pass));
    add_state_results(run, stand, pass);
    warn_of_preload(run, stand, pass);
    if (goal != Goal::stiffness) {
      add_mode_results(run, stand, pass);
      add_stability(run, stand, pass, record.passes.back());
      refuse_buckled(pass, record.passes.back());
      if (pass.p == 0)
        add_gap_modes(run, stand, pass);
    }
    if (goal == Goal::simulate)
      add_vibration(run, stand, pass, record.passes.back());
  }
  say_what_is_assumed(run, stand);
  if (goal == Goal::simulate)
    add_critical_speeds(run, stand, passes);
  if (goal == Goal::chatter)
    solve_cluster_chatter(run, stand, passes);
  else if (goal != Goal::stiffness) {
    write_load_curve(run, stand, passes, computed);
    solve_fits(run, stand, passes, computed, record);
  }
  run.out.write(cluster_file, json_of_record(record));
  if (const ScheduleQuestion schedule = schedule_question(run.the_case, goal == Goal::simulate);
      goal != Goal::modes && goal != Goal::chatter && !schedule.passes.empty())
    add_schedule_forces(run, schedule);
}
}  // namespace mill
