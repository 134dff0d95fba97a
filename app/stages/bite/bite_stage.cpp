#include "app/stages/bite/bite_stage.h"
#include "app/stages/bite/bite_curves.h"
#include "app/stages/bite/bite_files.h"
#include "app/stages/bite/bite_results.h"
#include "app/stages/bite/fit_stage.h"
#include "core/base/errors.h"
#include "core/model/bite_case.h"
#include "core/model/case.h"
#include "core/model/four_high.h"
#include "core/records/result_names.h"
#include "reduce/chain/line_contact.h"
#include <algorithm>
#include <cmath>

namespace mill {
namespace {
// Where the back-up roll carries the work roll, Hertz.
double backup_half_width(const FourHigh &stand, const double force)
{
  const double length = std::min(stand.work_roll.barrel_length, stand.backup_roll.barrel_length);
  return reduce::line_contact(
             {stand.work_roll.barrel_diameter, stand.backup_roll.barrel_diameter, length, stand.steel}, force)
      .half_width;
}

// A flattened arc is flatter than the roll's own circle and asks for less friction: a pass is refused where no arc
// takes it.
bool some_arc_takes(const bite::RollBite &bite)
{
  for (const bite::Arc arc : {bite::Arc::hitchcock, bite::Arc::elastic})
    try {
      bite::solve_slab(bite, {bite::Theory::karman, arc, 0});
      return true;
    } catch (const InputError &) {
    } catch (const SolverError &) {  // it is left to the run
      return true;
    }
  return false;
}

// The friction of a film is computed together with the flattened arc only.
void check_pass(const bite::RollBite &bite, const BiteSetup &setup, const Pass &pass,
                std::vector<Problem> &problems)
{
  if (follows_bite(bite.strip.friction) || !setup.fit.empty())  // of a fit the case's friction is a start only
    return;
  try {
    bite::solve_slab(bite, {fem::slab_model(setup).theory, bite::Arc::rigid});
  } catch (const InputError &e) {
    if (!some_arc_takes(bite))
      problems.push_back({pass.place, "pass \"" + pass.name + "\": " + e.problems.front().message, {}});
  } catch (const SolverError &e) {
    problems.push_back({pass.place, "pass \"" + pass.name + "\": " + e.what(), {}});
  }
}

// A theory that was asked for and that has no answer ends the run, whatever the others say; on the free arc it is
// asked on the section of the roll, which only a run meshes.
void check_theory(const bite::RollBite &bite, const BiteSetup &setup, const Pass &pass,
                  std::vector<Problem> &problems)
{
  if (setup.method != BiteMethod::slab || setup.arc == BiteArc::elastic || !setup.fit.empty())
    return;
  const auto refuse = [&](const std::string &why) {
    problems.push_back({pass.place, "pass \"" + pass.name + "\": " + why, {}});
  };
  try {
    const BiteSetup settled = fem::settled_setup(setup, bite::regime_of(bite));
    bite::SlabModel model   = fem::slab_model(settled);
    model.curve_points      = 0;
    if (model.arc == bite::Arc::hitchcock)
      bite::solve_slab(bite, model);
  } catch (const InputError &e) {
    refuse(e.problems.front().message);
  } catch (const SolverError &e) {
    refuse(e.report.what + (e.report.remedy.empty() ? "" : "; " + e.report.remedy));
  }
}

void check_whole_pass(const bite::RollBite &bite, const BiteSetup &setup, const Pass &pass,
                      std::vector<Problem> &problems)
{
  const std::size_t before = problems.size();
  check_pass(bite, setup, pass, problems);
  if (problems.size() == before)
    check_theory(bite, setup, pass, problems);
}

// Measured values are checks of the computed ones; after a fit the agreement of the force is by construction.
void add_measured(BiteQuestion &q, const Pass &pass)
{
  q.measured_slip   = pass.forward_slip;
  q.measured_torque = pass.torque;
  if (std::count(q.setup.fit.begin(), q.setup.fit.end(), PassMeasure::force) > 0)
    q.force_deviation = pass.force_deviation;
}

// What the slab theories say is kept also where the finite elements fail.
void add_study(RunContext &run, const BiteStudy &study, const BiteKeys &keys)
{
  add_bite_results(run, study, keys);
  note_bite(run, study);
  write_bite(run, study);
}
}  // namespace

bite::RollBite bite_of(const Strip &strip, const Pass &pass, const double roll_diameter, const Material &roll)
{
  bite::RollBite bite;
  bite.strip       = with_values_of_pass(strip, pass);
  bite.roll_radius = 0.5 * roll_diameter;
  bite.roll        = roll;
  bite.roll_speed  = pass.speed;
  return bite;
}

void check_bites(const Case &the_case)
{
  std::vector<Problem> problems;
  if (const auto *stand = std::get_if<FourHigh>(&the_case.spec); stand && !stand->given.count("K4"))
    for (const Pass &pass : stand->passes)
      check_whole_pass(bite_of(stand->strip, pass, stand->work_roll.barrel_diameter, stand->steel), stand->bite,
                       pass, problems);
  if (const auto *bite = std::get_if<BiteCase>(&the_case.spec))
    for (const Pass &pass : bite->passes)
      check_whole_pass(bite_of(bite->strip, pass, bite->roll_diameter, bite->steel), bite->bite, pass, problems);
  if (!problems.empty())
    throw InputError(std::move(problems));
}

namespace {
// The theory that was asked for on a free arc, here that of a half plane.
std::optional<Warning> free_arc_refused(const bite::RollBite &bite, const BiteSetup &setup, const Pass &pass)
{
  try {
    bite::SlabModel model = fem::slab_model(fem::settled_setup(setup, bite::regime_of(bite)));
    model.curve_points    = 0;
    if (model.arc == bite::Arc::elastic)
      bite::solve_slab(bite, model);
  } catch (const InputError &) {  // check_bites() says so
  } catch (const SolverError &e) {
    return Warning{WarningId::bite_model_refused,
                   "bite of " + pass.name,
                   e.report.what,
                   e.report.cause + "; a run asks the section of the roll, here it is a half plane",
                   e.report.remedy,
                   {result_name({family::bite, pass.name})},
                   "",
                   pass.place};
  }
  return {};
}
}  // namespace

std::optional<Warning> bite_without_theory(const bite::RollBite &bite, const BiteSetup &setup, const Pass &pass)
{
  if (!setup.fit.empty())
    return {};
  if (setup.method == BiteMethod::slab)
    return free_arc_refused(bite, setup, pass);
  BiteQuestion q;
  q.bite  = bite;
  q.setup = setup;
  q.pass  = pass.name;
  try {
    auto warning = bite_without_theory(q);
    if (warning)
      warning->place = pass.place;
    return warning;
  } catch (const InputError &) {  // check_bites() says so
  } catch (const SolverError &) {
  }
  return {};
}

namespace {
// What was computed before stays in the results: a bite that is refused then is a failure of the run.
BiteStudy study_after_others(RunContext &run, const BiteQuestion &question)
{
  try {
    return study_bite(run, question);
  } catch (const SystemError &) {
    throw;
  } catch (const InputError &e) {
    throw SolverError({e.problems.front().message, "", "", "", ""});
  }
}
}  // namespace

BiteSpring solve_bite_spring(RunContext &run, const FourHigh &stand, const std::size_t p, const double force,
                             const bool curves)
{
  const Pass &pass = stand.passes[p];
  BiteQuestion q;
  q.bite              = bite_of(stand.strip, pass, stand.work_roll.barrel_diameter, stand.steel);
  q.setup             = stand.bite;
  q.pass              = pass.name;
  q.force             = force;
  q.force_name        = std::isnan(pass.load) ? "the mean of the recorded force" : "the load of the pass";
  q.roll_key          = "work_roll.barrel_diameter";
  q.backup_half_width = backup_half_width(stand, force);
  add_measured(q, pass);
  const BiteStudy study = study_after_others(run, q);
  const BiteKeys keys   = keys_of_bite(run, p);
  add_study(run, study, keys);
  const BiteSpring spring = bite_spring(study, keys);
  if (p == 0) {
    add_bite_spring(run, spring);
    if (curves)
      write_bite_curves(run, study);
  }
  return spring;
}

void solve_bite_case(RunContext &run, const BiteCase &spec)
{
  const Strip strip = fitted_strip(run, fit_question(spec));
  for (std::size_t p = 0; p < spec.passes.size(); ++p) {
    BiteQuestion q;
    q.bite       = bite_of(strip, spec.passes[p], spec.roll_diameter, spec.steel);
    q.setup      = spec.bite;
    q.pass       = spec.passes[p].name;
    q.force      = spec.passes[p].load;
    q.force_name = "the load of the pass";
    q.roll_key   = "work_roll.diameter";
    q.curves     = p == 0;
    add_measured(q, spec.passes[p]);
    const BiteStudy study = p == 0 ? study_bite(run, q) : study_after_others(run, q);
    const BiteKeys keys   = keys_of_bite(run, p);
    add_study(run, study, keys);
    const BiteSpring spring = bite_spring(study, keys);
    if (p == 0) {
      add_bite_spring(run, spring);
      write_bite_curves(run, study);
    }
  }
}
}  // namespace mill
