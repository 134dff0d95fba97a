#include "app/kinds/pipeline.h"
#include "app/stages/response/campbell_stage.h"
#include "app/stages/response/contact_curves.h"
#include "app/stages/response/detailed_model_stage.h"
#include "app/stages/response/dynamics_stage.h"
#include "app/stages/response/frf_stage.h"
#include "app/stages/response/turning_rolls.h"
#include "app/stages/stand/mode_results.h"
#include "core/case/chain_curves.h"
#include "core/case/lumped_model_toml.h"
#include "core/case/moving_keys.h"
#include "core/case/provenance.h"
#include "core/model/case.h"
#include "core/model/lumped.h"
#include <cmath>
#include <memory>
#include <utility>

// Kind "lumped": from the chain that the case gives to modes, response and history.
namespace mill {
namespace {
void add_turning_and_response(RunContext &run, const Lumped &lumped, const LumpedModel &model,
                              const reduce::StandWithModes &rolling, const reduce::StandWithModes &chain)
{
  const bool measured = driven_state(lumped.dynamics) == GapState::open;
  RespondingStand responding;
  responding.models     = {&chain};
  responding.named      = &chain == &rolling ? GapState::rolling : GapState::open;
  responding.uncertain  = reduce::modal_sensitivities(chain, model);
  responding.gap_damper = measured || std::isnan(model.C.value) ? 0 : model.C.value;
  responding.inputs     = joined(chain_mode_keys(*run.keys, model, lumped.dynamics, Half::upper),
                                 chain_mode_keys(*run.keys, model, lumped.dynamics, Half::lower),
                             measured ? KeyList() : model.C.inputs);
  add_frequency_responses(run, lumped.frequency_response, lumped.dynamics, responding);
  add_campbell(run, lumped.campbell, {&rolling, turning_rolls(lumped), lumped.passes, lumped.drive});
}

// mode.* of the chain, open.mode.* of the open one, frequency response and Campbell diagram.
void add_modes_and_response(RunContext &run, const Lumped &lumped, const LumpedModel &model)
{
  const auto open = chain_with_modes(model, in_state(lumped.dynamics, GapState::open));
  const auto add  = [&](const GapState named, const GapState state, const reduce::StandWithModes &chain) {
    const auto uncertain = reduce::modal_sensitivities(chain, model);
    NamedModes modes{named, {&chain}, uncertain};
    modes.of_gap = gap_compliance_keys(model, in_state(lumped.dynamics, state));
    add_named_modes(run, modes);
  };
  if (!knows_strip(model)) {
    assume_open(run, "given.K4");
    add(GapState::rolling, GapState::open, open);
    return add_turning_and_response(run, lumped, model, open, open);
  }
  const auto rolling = chain_with_modes(model, in_state(lumped.dynamics, GapState::rolling));
  add(GapState::rolling, GapState::rolling, rolling);
  add(GapState::open, GapState::open, open);
  const bool measured = driven_state(lumped.dynamics) == GapState::open;
  add_turning_and_response(run, lumped, model, rolling, measured ? open : rolling);
}

// The chain as it is given, or at the load of the pass on its curves.
// @param of_pass  keys of the force and of how it drives
void simulate_lumped_pass(RunContext &run, const LumpedModel &given, const Lumped &lumped, const Pass &pass,
                          const ForceRecord &force, const KeyList &of_pass)
{
  if (lumped.dynamics.contact != ContactSprings::curve) {
    PassModel linear = pass_model(given, lumped.dynamics);
    linear.of_pass   = of_pass;
    return simulate_pass(run, linear, lumped.dynamics, pass, force);
  }
  const double load       = working_load(pass, force);
  const LumpedModel model = at_load(run, given, lumped.curves, lumped.dynamics, pass, load);
  PassModel driven        = pass_model(model, lumped.dynamics);
  driven.of_pass          = of_pass;
  driven.curves = std::make_shared<CurveDrive>(curve_drive(lumped.curves, lumped.dynamics, given, model, load));
  simulate_pass(run, driven, lumped.dynamics, pass, force);
}
}  // namespace

void run_lumped(RunContext &run, Lumped lumped, const Goal goal, const std::string &force_file)
{
  if (lumped.detailed)
    return run_detailed_model(run, lumped, goal, force_file);
  LumpedModel model = lumped_model_of(run.the_case);
  set_given_inputs(model);
  add_chain_results(run, model, "");
  run.out.write("lumped_model.toml",
                lumped_model_toml(model, run.the_case, run.out.path()) + chain_curves_toml(lumped.curves));
  if (goal >= Goal::modes)
    add_modes(run, model, lumped.dynamics, not_given, {0, 0});
  if (goal >= Goal::modes)
    add_modes_and_response(run, lumped, model);
  if (goal < Goal::simulate)
    return;
  for (std::size_t p = 0; p < lumped.passes.size(); ++p) {
    Pass &pass = lumped.passes[p];
    if (!force_file.empty())
      pass.force_file = force_file;
    if (has_force(pass))
      simulate_lumped_pass(run, model, lumped, pass, force_of(pass), response_keys(*run.keys, p));
    run.progress.at("passes", double(p + 1) / double(lumped.passes.size()));
  }
}

DrivenStand driven_lumped(RunContext &run, const Lumped &lumped, const std::string &pass)
{
  DrivenStand driven_stand;
  driven_stand.dynamics = lumped.dynamics;
  if (lumped.detailed)
    drive_files(driven_stand, lumped.model);
  else
    driven_stand.chain = lumped_model_of(run.the_case);
  if (!lumped.passes.empty() || !pass.empty()) {
    driven_stand.pass = lumped.passes[place_of_pass(lumped.passes, pass)];
    if (has_force(driven_stand.pass))
      driven_stand.force = force_of(driven_stand.pass);
    if (driven_stand.force.force.size() > 0 || !std::isnan(driven_stand.pass.load))
      driven_stand.load = working_load(driven_stand.pass, driven_stand.force);
    if (lumped.dynamics.contact == ContactSprings::curve && !lumped.detailed) {
      const LumpedModel given = driven_stand.chain;
      driven_stand.chain =
          at_load(run, given, lumped.curves, lumped.dynamics, driven_stand.pass, driven_stand.load);
      driven_stand.curves = std::make_shared<CurveDrive>(
          curve_drive(lumped.curves, lumped.dynamics, given, driven_stand.chain, driven_stand.load));
    }
  }
  return driven_stand;
}
}  // namespace mill
