#include "app/stack/stack_bite.h"
#include "app/stack/stack_motion.h"
#include "app/stages/response/dynamics_stage.h"
#include "app/stages/stability/stability_question.h"
#include "app/stages/stability/uncertain_numbers.h"
#include "app/stages/stand/mode_results.h"
#include "core/case/fields.h"
#include "core/model/case.h"
#include "core/records/key_list.h"
#include "dynamics/chatter/stand_structure.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double usual_free_strip = 5;  // m, of free strip

// A chain that has no numbers: its place in what drives a detailed stand.
LumpedModel no_chain()
{
  LumpedModel chain;
  chain.C.value = not_given;
  return chain;
}

KeyList keys_of_response(const Case &the_case)
{
  KeyList keys = keys_of_stack(the_case);
  for (const std::string &key : all_keys_of_stack(the_case))
    if (key.rfind("pass.", 0) == 0 || key.rfind("dynamics.", 0) == 0)
      keys.push_back(key);
  return keys;
}
}  // namespace

std::vector<std::string> missing_for_speed(const Case &the_case, const StackInput &input, const std::size_t p)
{
  std::vector<std::string> missing = split(missing_of_bite(input, p), ", ");
  missing.erase(std::remove(missing.begin(), missing.end(), ""), missing.end());
  const std::string speed = fmt::format("pass.{}.speed", p);
  if (std::isnan(input.passes[p].speed) && !holds(missing, speed))
    missing.push_back(speed);
  for (const char *tension : {"entry_tension", "exit_tension"})
    if (!the_case.places.count(fmt::format("pass.{}.{}", p, tension)) &&
        !the_case.places.count(std::string("strip.") + tension))
      missing.push_back(std::string("strip.") + tension);
  return missing;
}

StackSpeedInputs stack_speed_inputs(RunContext &run, const StackInput &input, const MovingPass &pass)
{
  const StackBite rolled = stack_bite(input, pass.stack, pass.pass, pass.force);
  run.assume(fmt::format("pass \"{}\": the critical speed is that of a bite with the flow stress {}",
                         pass.pass.name, rolled.stress));
  const auto or_usual = [&](const double given, const char *key) {
    if (!std::isnan(given))
      return given;
    run.assume(fmt::format("stand.{} is not given: {:g} m of free strip are assumed", key, usual_free_strip));
    return usual_free_strip;
  };
  return {rolled.bite, or_usual(input.span.entry_distance, "entry_distance"),
          or_usual(input.span.exit_distance, "exit_distance")};
}

namespace {

StabilityQuestion stability_of(RunContext &run, const StackInput &input, const MovingPass &pass)
{
  const StackSpeedInputs inputs = stack_speed_inputs(run, input, pass);
  const auto around             = [&](const reduce::StandWithModes &stand) {
    return dynamics::ChatterStandModel{structure_of(input, stand), inputs.entry_distance, inputs.exit_distance,
                                       inputs.bite.strip.youngs_modulus};
  };
  StabilityQuestion q;
  q.pass                  = pass.pass.name;
  q.speed                 = pass.pass.speed;
  q.model                 = title_of(pass.open.model.name);
  q.leading.bite          = inputs.bite;
  q.leading.modal_damping = input.dynamics.modal_damping;
  q.leading.scheme        = input.analysis.linearisation;
  q.leading.range         = speed_range(input.analysis);
  q.leading.stand         = around(pass.open);
  q.others                = {{title_of(pass.lumped_open.model.name), around(pass.lumped_open)}};
  UncertainNumbers uncertain;
  const Eigen::Index kept = q.leading.stand.structure.n();
  for (const Connection &connection : pass.open.model.connections) {
    const Eigen::MatrixXd strain = connection.rows * pass.open.modes.shape.leftCols(kept);
    dynamics::UncertainNumber one{connection.name, usual_error::spring_or_mass};
    one.structure = {strain.transpose() * connection.stiffness.asDiagonal() * strain,
                     Eigen::MatrixXd::Zero(kept, kept)};
    uncertain.numbers.push_back(std::move(one));
  }
  uncertain.assumed = fmt::format("{:g} % for contacts and bearings", 100 * usual_error::spring_or_mass);
  add_pass_numbers(uncertain, fitted_errors(run), inputs.bite, input.span, not_given);
  q.uncertain = std::move(uncertain.numbers);
  q.assumed   = std::move(uncertain.assumed);
  q.inputs    = all_keys_of_stack(run.the_case);
  return q;
}
}  // namespace

dynamics::StandStructure structure_of(const StackInput &input, const reduce::StandWithModes &stand)
{
  dynamics::StandStructure s = dynamics::structure_of(
      dynamics::modal_model(stand.model, stand.modes.frequency, stand.modes.shape, input.dynamics.modal_damping,
                            2 * input.dynamics.frequency_limit));
  s.name = title_of(stand.model.name);
  return s;
}

void simulate_stack(RunContext &run, const StackInput &input, const std::vector<MovingPass> &passes)
{
  for (std::size_t p = 0; p < passes.size(); ++p) {
    if (passes[p].record.force.size() > 0) {
      PassModel model = pass_model(passes[p].driven(input.dynamics), no_chain(), input.dynamics);
      model.of_pass   = keys_of_response(run.the_case);
      simulate_pass(run, model, input.dynamics, passes[p].pass, passes[p].record);
    }
    run.progress.at("passes", double(p + 1) / double(passes.size()));
  }
}

void add_stack_speeds(RunContext &run, const StackInput &input, const std::vector<MovingPass> &passes)
{
  for (std::size_t p = 0; p < input.passes.size() && p < passes.size(); ++p) {
    const MovingPass &pass = passes[p];
    search_critical_speed(run, pass.pass.name, pass.pass.speed, missing_for_speed(run.the_case, input, p),
                          [&] { return stability_of(run, input, pass); });
  }
}

DrivenStand driven_stack(const StackInput &input, const Stack &stack, const std::string &wanted, const int threads)
{
  const std::string name = wanted.empty() && !input.passes.empty() ? input.passes.front().name : wanted;
  MovingPass pass        = std::move(moving_passes(input, stack, threads, name).front());
  DrivenStand driven;
  driven.chain    = no_chain();
  driven.dynamics = input.dynamics;
  driven.detailed = std::make_shared<const reduce::StandWithModes>(pass.driven(input.dynamics));
  driven.modes    = driven_modes(*driven.detailed, driven.chain, driven.dynamics);
  driven.pass     = pass.pass;
  driven.force    = std::move(pass.record);
  driven.load     = pass.force;
  return driven;
}
}  // namespace mill
