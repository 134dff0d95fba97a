#include "app/stages/bite/fit_stage.h"
#include "app/stages/bite/bite_stage.h"
#include "app/stages/bite/bite_study.h"
#include "app/stages/bite/fit_results.h"
#include "core/base/errors.h"
#include "core/case/bite_inputs.h"
#include "core/model/bite_case.h"
#include "core/model/four_high.h"
#include "reduce/bite/fit/fit_to_model.h"
#include <algorithm>
#include <cmath>

namespace mill {
namespace {
using bite::Measured;

bool asked(const BiteSetup &setup, const Measured kind)
{
  return std::count(setup.fit.begin(), setup.fit.end(), kind) > 0;
}

std::vector<bite::FitUnknown> unknowns_of(const BiteSetup &setup)
{
  std::vector<bite::FitUnknown> unknowns;
  const std::vector<std::string> both{"friction", "flow_stress"};
  for (const std::string &name : setup.fit_for.empty() ? both : setup.fit_for)
    unknowns.push_back(bite::fit_unknown(name));
  return unknowns;
}

bite::MeasuredPass measured_pass(const FitQuestion &q, const std::size_t p)
{
  const Pass &pass = q.passes[p];
  bite::MeasuredPass measured;
  measured.name   = pass.name;
  measured.bite   = bite_of(q.strip, pass, q.roll_diameter, q.steel);
  const auto give = [&](const Measured kind, const double value, const double deviation) {
    if (!asked(q.setup, kind) || std::isnan(value))
      return;
    measured.value[std::size_t(kind)]     = value;
    measured.deviation[std::size_t(kind)] = deviation;
  };
  give(Measured::force, q.loads[p], pass.force_deviation * q.loads[p]);
  give(Measured::slip, pass.forward_slip, pass.slip_deviation);
  give(Measured::torque, pass.torque, pass.torque_deviation * std::abs(pass.torque));
  return measured;
}

// The strip of the case with the laws of the passes at x, logarithms of the factors.
Strip strip_of(const FitQuestion &q, const bite::FitProblem &problem, const Eigen::VectorXd &x)
{
  const Strip fitted = with_factors(problem.passes.front().bite.strip, problem.unknowns, x);
  Strip strip        = q.strip;
  strip.friction     = fitted.friction;
  strip.flow_stress  = fitted.flow_stress;
  return strip;
}

bool has_data(const bite::MeasuredPass &pass)
{
  return std::any_of(pass.value.begin(), pass.value.end(), [](const double x) { return !std::isnan(x); });
}

// Karman's slab on Hitchcock's circle or a rigid roll is what the fit computes with anyway.
bool is_the_slab(const BiteSetup &setup)
{
  return setup.method == BiteMethod::slab && setup.theory == SlabTheory::karman &&
         (setup.arc == BiteArc::rigid || setup.arc == BiteArc::hitchcock);
}

/// The model of the run for one pass of the fitted strip.
struct ModelValue {
  Eigen::Vector3d value{not_given, not_given, not_given};
  std::string model, refused;
};

// All passes in parallel; the notes of their stages belong to strips that are not the last one and are dropped.
std::vector<ModelValue> values_of_run(RunContext &run, const FitQuestion &q, const bite::FitProblem &problem,
                                      const Strip &strip)
{
  std::vector<ModelValue> values(q.passes.size());
  SideBySide all(run);
  for (std::size_t p = 0; p < q.passes.size(); ++p)
    all.add([&, p](RunContext &pass_run) {
      if (!has_data(problem.passes[p]))
        return;
      BiteQuestion one;
      one.bite     = bite_of(strip, q.passes[p], q.roll_diameter, q.steel);
      one.setup    = q.setup;
      one.pass     = q.passes[p].name;
      one.roll_key = q.roll_key;
      one.curves   = false;
      try {
        const BiteStudy study    = study_bite(pass_run, one);
        const BiteAnswer &chosen = study.chosen();
        const bite::BiteState &s = chosen.state;
        values[p]                = {{s.force, s.forward_slip, s.torque}, model_text(chosen), ""};
      } catch (const InputError &e) {
        values[p].refused = e.problems.front().message;
      } catch (const SolverError &e) {
        values[p].refused = e.report.what;
      }
    });
  all.work();
  return values;
}

/// The model of the run has no answer for one of the passes.
struct NoAnswer : InputError {
  using InputError::InputError;
};

/// Fits by the model of the run; by the slab alone where that model has no answer for the strip of the slab's fit.
void fit_by_run(RunContext &run, StripFit &fit)
{
  std::vector<std::string> models;
  const auto model = [&](const Eigen::VectorXd &x) {
    const Strip strip = strip_of(fit.question, fit.answer.problem, x);
    const auto values = values_of_run(run, fit.question, fit.answer.problem, strip);
    std::vector<Eigen::Vector3d> numbers;
    std::vector<std::string> names;
    for (const ModelValue &value : values) {
      if (!value.refused.empty())
        throw NoAnswer(value.refused);
      numbers.push_back(value.value);
      names.push_back(value.model);
    }
    models = names;
    return numbers;
  };
  try {
    fit.answer.best = fit_to_model(fit.answer.problem, fit.answer.best, model);
    fit.models      = models;
  } catch (const NoAnswer &e) {
    fit.uncorrected = e.problems.front().message;
  }
}

StripFit solved_fit(RunContext &run, const FitQuestion &question)
{
  StageTimer timer(run, "fit of friction and flow stress");
  StripFit fit;
  fit.question = question;
  fit.inputs   = bite_keys(*run.keys, 0);
  fit.slab     = bite::identify(fit_problem(question), one_number_only(question.setup));
  fit.answer   = fit.slab;
  if (!is_the_slab(question.setup))
    fit_by_run(run, fit);
  bite::find_intervals(fit.answer);
  fit.strip = strip_of(question, fit.answer.problem, fit.answer.best.x);
  return fit;
}
}  // namespace

FitQuestion fit_question(const BiteCase &spec)
{
  FitQuestion q{spec.strip, spec.bite, spec.passes, {}, spec.roll_diameter, spec.steel, "work_roll.diameter"};
  for (const Pass &pass : spec.passes)
    q.loads.push_back(pass.load);
  return q;
}

FitQuestion fit_question(const FourHigh &stand, const std::vector<double> &loads)
{
  return {stand.strip,
          stand.bite,
          stand.passes,
          loads,
          stand.work_roll.barrel_diameter,
          stand.steel,
          "work_roll.barrel_diameter"};
}

bool one_number_only(const BiteSetup &setup)
{
  return setup.fit.size() == 1 && setup.fit_for.empty();
}

bite::FitProblem fit_problem(const FitQuestion &question)
{
  bite::FitProblem problem;
  problem.arc      = question.setup.arc == BiteArc::rigid ? bite::Arc::rigid : bite::Arc::hitchcock;
  problem.unknowns = unknowns_of(question.setup);
  for (std::size_t p = 0; p < question.passes.size(); ++p)
    problem.passes.push_back(measured_pass(question, p));
  return problem;
}

Strip fitted_strip(RunContext &run, const FitQuestion &question)
{
  if (question.setup.fit.empty())
    return question.strip;
  const StripFit fit = solved_fit(run, question);
  add_fit_results(run, fit);
  note_fit(run, fit);
  write_fit(run, fit);
  return fit.strip;
}

Strip quickly_fitted_strip(const FitQuestion &question)
{
  if (question.setup.fit.empty())
    return question.strip;
  try {
    const bite::FitAnswer answer = bite::identify(fit_problem(question), one_number_only(question.setup));
    return strip_of(question, answer.problem, answer.best.x);
  } catch (const InputError &) {
  } catch (const SolverError &) {
  }
  return question.strip;
}
}  // namespace mill
