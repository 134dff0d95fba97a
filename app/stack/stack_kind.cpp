#include "app/review/case_review.h"
#include "app/run/kind_rolls.h"
#include "app/run/run_kind.h"
#include "app/stack/stack_bearings.h"
#include "app/stack/stack_bite.h"
#include "app/stack/stack_motion.h"
#include "app/stack/stack_stage.h"
#include "app/trace/closed_form_parts.h"
#include "core/model/case.h"
#include "dynamics/marks/marks.h"
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

namespace mill {
namespace {
// The engine itself is quick enough to be followed.
std::vector<ClosedFormResult> traced(const Case &the_case)
{
  const auto &spec   = std::get<StackCase>(the_case.spec);
  const KeyList keys = keys_of_stack(the_case);
  std::vector<ClosedFormResult> all;
  const auto add = [&](const StackNumber &number, const char *relation, const char *file, const char *equation) {
    ClosedFormResult result;
    result.name             = number.name;
    result.parameter.value  = number.value;
    result.parameter.unit   = number.unit;
    result.parameter.method = number.method;
    result.parameter.inputs = keys;
    result.closed           = keys;
    result.own_keys         = keys;
    result.relation         = relation;
    result.file             = file;
    result.equation         = equation;
    all.push_back(std::move(result));
  };
  const Stack stack = with_rigid_bearings(*spec.input, with_slopes_of_bite(*spec.input, *spec.stack));
  for (const StackNumber &number : traced_stack(*spec.input, stack))
    add(number, "equilibrium of rolls as beams, on the coarser mesh", "reduce/stack/beam_stack", "(51.9)");
  for (const StackNumber &number : bearing_numbers(stack))
    add(number, "equilibrium of all rollers", "reduce/bearing/assembly", "(5.23)");
  return all;
}
}  // namespace

const RunKind &run_kind(const StackCase &)
{
  static const RunKind kind = [] {
    RunKind k;
    k.verbs   = {Verb::run, Verb::modes, Verb::chatter, Verb::simulate};
    k.refusal = [](const Case &the_case, const Verb verb) {
      return std::string("millstand ") + word_of(verb) +
             " computes parts of a four-high stand; for kind = \"stack\" (" + the_case.path +
             ") use run, modes, simulate or chatter";
    };
    k.stages = [](const Case &) -> std::vector<std::pair<std::string, double>> {
      return {{"stack", 1}, {"modes", 1}};
    };
    k.run = [](RunContext &run, const Goal goal, const std::string &force_file) {
      const auto &spec  = std::get<StackCase>(run.the_case.spec);
      StackInput driven = *spec.input;
      for (Pass &pass : driven.passes)
        if (!force_file.empty())
          pass.force_file = force_file;
      run_stack(run, driven, *spec.stack, goal);
    };
    k.review = [](const Case &the_case, const std::string &) {
      CaseReview review;
      const StackInput &input = *std::get<StackCase>(the_case.spec).input;
      for (std::size_t p = 0; p < input.passes.size(); ++p)
        review_speed(input.passes[p], missing_for_speed(the_case, input, p), review);
      return review;
    };
    k.driven = [](RunContext &run, const std::string &pass) {
      const auto &spec = std::get<StackCase>(run.the_case.spec);
      const Stack held = with_bearing_curves(*spec.stack, solve_stack_bearings(run, *spec.input, *spec.stack));
      return driven_stack(*spec.input, with_slopes_of_bite(*spec.input, held), pass, run.threads);
    };
    k.mark_sources = [](const Case &the_case) {
      dynamics::MarkSources sources;
      const StackInput &input = *std::get<StackCase>(the_case.spec).input;
      for (std::size_t i = 0; i < input.rolls.size(); ++i)
        sources.rolls.push_back(mark_roll(input.rolls[i].name, i, input.rolls[i].barrel_diameter));
      sources.damping = input.dynamics.modal_damping;
      return sources;
    };
    k.describe = [](const Case &the_case, nlohmann::ordered_json &manifest) {
      manifest["geometry"] = nlohmann::ordered_json::object();
      for (const StackRoll &roll : std::get<StackCase>(the_case.spec).stack->rolls)
        describe_roll(manifest, roll.name, roll.diameter);
    };
    k.trace = [](const Case &the_case, ClosedFormMemory &, const std::map<std::string, double> &) {
      return traced(the_case);
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
