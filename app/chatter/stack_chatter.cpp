#include "app/chatter/stack_chatter.h"
#include "app/chatter/chatter_question.h"
#include "app/chatter/pass_studies.h"
#include "app/run/asked_speeds.h"
#include "app/stack/stack_bite.h"
#include "core/model/case.h"
#include "dynamics/response/modal_model.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
ChatterQuestion question_of(RunContext &run, const StackInput &input, const MovingPass &pass)
{
  const StackSpeedInputs inputs = stack_speed_inputs(run, input, pass);
  ChatterQuestion q;
  q.bite      = inputs.bite;
  q.condition = condition_of(pass.pass, q.bite.strip);
  q.label     = pass.pass.name;
  q.analysis  = input.analysis;
  q.scheme    = input.analysis.linearisation;
  for (const reduce::StandWithModes *stand : {&pass.open, &pass.lumped_open}) {
    const auto modal = dynamics::modal_model(stand->model, stand->modes.frequency, stand->modes.shape,
                                             input.dynamics.modal_damping, 2 * input.dynamics.frequency_limit);
    q.structures.push_back(
        {stand->model.name,
         {structure_of(input, *stand), inputs.entry_distance, inputs.exit_distance, q.bite.strip.youngs_modulus},
         dynamics::modal_numbers(modal)});
  }
  q.stand     = q.structures.front().stand;
  q.numbers   = q.structures.front().numbers;
  q.structure = fmt::format("roll stack under {:.5g} kN, modal damping {:g} %", 1e-3 * pass.force,
                            100 * input.dynamics.modal_damping);
  q.inputs    = all_keys_of_stack(run.the_case);
  return q;
}
}  // namespace

void solve_stack_chatter(RunContext &run, const StackInput &input, const std::vector<MovingPass> &passes)
{
  if (input.passes.empty())
    throw InputError("millstand chatter needs a [[pass]] with name, speed, entry_tension and exit_tension (" +
                     run.the_case.path + ")");
  study_passes(run, passes.size(), [&](const std::size_t p) {
    const MovingPass &pass = passes[p];
    std::string missing;
    for (const std::string &key : missing_for_speed(run.the_case, input, p))
      missing += (missing.empty() ? "" : ", ") + key;
    if (!missing.empty())
      throw InputError(pass.pass.place,
                       fmt::format("pass \"{}\": its critical speed needs {}", pass.pass.name, missing));
    const ChatterQuestion q = question_of(run, input, pass);
    ChatterStudy study      = study_chatter(run, q);
    if (run.asked)
      run.asked->add(
          {q.condition.name, q.condition.speed, {study.question.stand, 0, q.bite, q.scheme, chatter_range(q)}});
    return study;
  });
}
}  // namespace mill
