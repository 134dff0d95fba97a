#pragma once
#include "app/run/run_context.h"
#include "app/stages/stand/stand_components.h"
#include "core/case/provenance.h"
#include "core/model/dynamics_settings.h"
#include "core/model/four_high.h"
#include "reduce/stand/fe_masses.h"
#include "reduce/stand/lumped_stand.h"
#include "reduce/stand/stand_comparison.h"
#include "reduce/stand/stand_errors.h"
#include <optional>

namespace mill {
/// The stand at one working load, in one state of the gap, in three depths.
struct StandModels {
  reduce::StandWithModes chain;          ///< six masses
  reduce::StandWithModes beam;           ///< rolls as beams
  reduce::StandWithModes craig_bampton;  ///< rolls, and a drawn housing, as reduced finite elements
  reduce::ChainVerdict verdict;          ///< what the six masses show of craig_bampton
};

/// Builds them for a chain; modes up to twice the frequency limit, with error estimates from coarser meshes.
StandModels stand_models(const FourHigh &stand, const reduce::LumpedStand &chain, const ComponentSets &components);

/// A stand in one state of the gap, which its dynamics.force_meaning says.
struct StandInState {
  FourHigh stand;
  StandModels models;
};

/// The states of a stand.  theory.md 22.9
struct StandStates {
  StandInState open;
  std::optional<StandInState> rolling;  ///< nothing: K4 is not known
  /// What the page and the names are of: rolling where it is known.
  const StandInState &named() const
  {
    return rolling ? *rolling : open;
  }
  /// What the force of the case drives.
  const StandInState &driven(const DynamicsSettings &settings) const
  {
    return driven_state(settings) == GapState::rolling ? named() : open;
  }
  /// Under which names the frequencies of a state stand in the results.
  GapState name_of(const StandInState &state) const
  {
    return &state == &named() ? GapState::rolling : GapState::open;
  }
};

/// Both states side by side.  Cost: twice that of stand_models().
/// @param driven_only  leave out the rolling state where the force drives the open one
StandStates stand_states(RunContext &run, const FourHigh &stand, const reduce::LumpedStand &chain,
                         const ComponentSets &components, bool driven_only = false);

/// Equivalent masses M2..M5 by the shapes of the finite elements: checks in addition to the closed forms, or the
/// values themselves when the case asks for them (dynamics.mass_source).
/// @return  as they are by both roads
reduce::FeMasses add_fe_masses(LumpedModel &chain, const FourHigh &stand, const StandModels &models);

/// A detailed model with the errors of its connections, which files and calibration state.
/// Cost: the stand is put together some thirty times.
reduce::StandWithModes with_connection_errors(reduce::StandWithModes model, const FourHigh &stand,
                                              const reduce::LumpedStand &chain, const ComponentSets &components);

/// Writes curves/models.json and adds the frequencies of beams and finite elements, of the state that is named;
/// the frequencies of the finite elements of the open one; curves/modes-*.csv of both; files of every model as it
/// is driven (app/stages/stand/model_files.h), and six masses made from beams and finite elements.
void compare_models(RunContext &run, const StandStates &states, const StandInState &driven,
                    const reduce::LumpedStand &chain, const ComponentSets &components,
                    const reduce::FeMasses &masses);

/// What an uncertain spring or mass does to the modes of the finite elements.
std::vector<reduce::ModalSensitivity> inputs_of_modes(const FourHigh &stand, const reduce::LumpedStand &chain,
                                                      const StandModels &models, const ComponentSets &components);
/// Keys behind the beams and the finite elements.
KeyList keys_of_models(MovingKeys &keys, const reduce::LumpedStand &chain);

/// Frequencies of the finite elements as checks of f1..f6 and open.f1..f6, once those are computed.
void add_model_checks(RunContext &run, const StandStates &states);

/// mode.* and open.mode.* of the finite elements.
void add_modes_by_name(RunContext &run, const StandStates &states, const reduce::LumpedStand &chain,
                       const ComponentSets &components);

/// The model that the case wants driven; nullptr: the six masses.
const reduce::StandWithModes *driven(const StandModels &models, const DynamicsSettings &settings);
}  // namespace mill
