#include "app/stages/bite/schedule_forces.h"
#include "app/stages/bite/bite_files.h"
#include "app/stages/bite/bite_results.h"
#include "app/stages/bite/bite_study.h"
#include "app/stages/bite/schedule_results.h"
#include "core/base/errors.h"
#include "core/records/json_archive.h"
#include "core/records/result_names.h"
#include "reduce/bite/schedule/large_flattening.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace mill {
namespace {
bite::Theory closed_theory(const bite::RollBite &bite)
{
  return slides(bite.strip.friction) ? bite::Theory::bland_ford : bite::Theory::hu_ehmann;
}

// The bite of the models: with the stress that was fitted, else that of the law at the exit.
std::optional<bite::RollBite> modelled_bite(const bite::ScheduledPass &pass, const PassForce &force)
{
  bite::RollBite one = pass.bite;
  if (!std::isnan(force.flat.flow_stress)) {
    one.strip.flow_stress   = {};
    one.strip.flow_stress.k = force.flat.flow_stress;
    return one;
  }
  if (!std::isnan(force.law_stress))
    return bite::with_exit_stress(one);
  return std::nullopt;
}

TheoryForce theory_force(const std::string &key, const std::string &name, const bite::BiteState &state)
{
  return {key, name, state.force, state.torque, state.flattened_radius, state.peak_pressure, ""};
}

// Bland and Ford on a rigid roll and with the power beyond Hitchcock's range, which no other table has.
void add_closed_theories(PassForce &force, const bite::RollBite &one)
{
  const bite::Theory theory = closed_theory(one);
  try {
    force.theories.push_back(theory_force("closed-rigid", bite::model_name({theory, bite::Arc::rigid}),
                                          bite::solve_slab(one, {theory, bite::Arc::rigid, 0})));
  } catch (const InputError &) {  // the others say why
  }
  if (force.flat.radius > bite::largest_of_hitchcock * one.roll_radius)
    try {
      const bite::FlattenedPass beyond = bite::flattened_pass(one, theory);
      TheoryForce row;
      row.key    = "closed-beyond";
      row.name   = "the same with the power 2/3 beyond R'/R = 5.235";
      row.force  = beyond.force;
      row.radius = beyond.radius;
      force.theories.push_back(row);
    } catch (const SolverError &) {
    }
}

void add_models(PassForce &force, const BiteStudy &study)
{
  for (const BiteAnswer &answer : study.answers)
    if (answer.refused.empty()) {
      force.theories.push_back(theory_force(answer.key, model_text(answer), answer.state));
    } else {
      TheoryForce row;
      row.key     = answer.key;
      row.name    = answer.key;
      row.refused = answer.refused;
      force.theories.push_back(row);
    }
}

// The pass by every model of the program, in a branch of the run of its own.
Warning no_further_models(const std::string &pass, const std::string &why, const std::string &remedy)
{
  return {WarningId::bite_model_refused,
          "pass \"" + pass + "\"",
          "no further models in addition to the closed theory",
          why,
          remedy,
          {result_name({family::bite, pass})}};
}

void study_pass(RunContext &run, const ScheduleQuestion &q, const std::size_t p, PassForce &force)
{
  const auto one = modelled_bite(q.passes[p], force);
  if (!one)
    return;
  add_closed_theories(force, *one);
  if (!q.with_models)
    return;
  BiteQuestion question;
  question.bite       = *one;
  question.setup      = q.setup;
  question.pass       = force.name;
  question.force      = force.fitted_to;
  question.force_name = force.fitted_to_what.empty() ? "the computed force" : "the " + force.fitted_to_what;
  question.stress_fitted_to_force = !std::isnan(force.flat.flow_stress);
  question.roll_key               = q.roll_key;
  question.curves                 = false;
  try {
    const BiteStudy study = study_bite(run, question);
    add_bite_results(run, study, [&](const BiteReading &) { return q.keys[p]; });
    note_bite(run, study);
    write_bite(run, study);
    add_models(force, study);
  } catch (const InputError &e) {
    run.warn(no_further_models(force.name, e.problems.front().message, ""));
  } catch (const SolverError &e) {
    run.warn(no_further_models(force.name, e.report.what, e.report.remedy));
  }
}

// Beyond this difference the two forces do not belong to the same strip.
constexpr double same_schedule_force = 0.1;

// The stress and friction of the case compared with the force of the pass; the fit has its own rows.
void note_force_of_case(RunContext &run, const PassForce &pass, const bite::RollBite &bite)
{
  if (std::isnan(pass.law_force) || !(pass.fitted_to > 0))
    return;
  const double difference   = pass.law_force / pass.fitted_to - 1;
  const std::string subject = "pass \"" + pass.name + "\"",
                    forces  = fmt::format("strip.flow_stress, {:.4g} MPa at the exit, and strip.friction give "
                                           "{:.4g} kN by {}; the {} is {:.4g} kN",
                                          1e-6 * pass.law_stress, 1e-3 * pass.law_force,
                                          bite::model_name({closed_theory(bite), bite::Arc::hitchcock}),
                                          pass.fitted_to_what, 1e-3 * pass.fitted_to);
  if (std::abs(difference) <= same_schedule_force)
    run.assume(subject + ": " + forces);
  else
    run.warn({WarningId::bite_force,
              subject,
              fmt::format("{}, {:+.0f} %", forces, 100 * difference),
              fmt::format("the results bite.{}.* use the flow stress that was fitted to the {}", pass.name,
                          pass.fitted_to_what),
              "",
              {result_name({family::bite, pass.name})}});
}
}  // namespace

ScheduleRecord add_schedule_forces(RunContext &run, const ScheduleQuestion &question)
{
  ScheduleRecord record = bite::schedule_of(question.passes);
  SideBySide models(run);
  for (std::size_t p = 0; p < record.passes.size(); ++p)
    models.add([&, p](RunContext &part_run) { study_pass(part_run, question, p, record.passes[p]); });
  models.work();
  for (std::size_t p = 0; p < record.passes.size(); ++p)
    models.take(p);
  for (std::size_t p = 0; p < record.passes.size(); ++p)
    note_force_of_case(run, record.passes[p], question.passes[p].bite);
  for (const Warning &note : record.notes)
    run.warn(note);
  add_schedule_results(run, question, record);
  run.out.write(schedule_file, json_of_record(record));
  return record;
}
}  // namespace mill
