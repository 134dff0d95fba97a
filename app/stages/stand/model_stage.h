#pragma once
#include "app/run/run_context.h"
#include "app/stages/stand/stand_components.h"
#include "core/case/provenance.h"
#include "core/model/dynamics_settings.h"
#include "reduce/stand/fe_masses.h"
#include "reduce/stand/lumped_stand.h"
#include "reduce/stand/stand_comparison.h"
#include "reduce/stand/stand_errors.h"

namespace mill {
struct FourHigh;

/// The stand at one working load in three depths.
struct StandModels {
  reduce::StandWithModes chain;          ///< six masses
  reduce::StandWithModes beam;           ///< rolls as beams
  reduce::StandWithModes craig_bampton;  ///< rolls, and a drawn housing, as reduced finite elements
  reduce::ChainVerdict verdict;          ///< what the six masses show of craig_bampton
};

/// Builds them for a chain; modes up to twice the frequency limit, with error estimates from coarser meshes.
StandModels stand_models(const FourHigh &stand, const reduce::LumpedStand &chain, const ComponentSets &components);

/// Equivalent masses M2..M5 by the shapes of the finite elements: checks in addition to the closed forms, or the
/// values themselves when the case asks for them (dynamics.mass_source).
/// @return  as they are by both roads
reduce::FeMasses add_fe_masses(LumpedModel &chain, const FourHigh &stand, const StandModels &models);

/// A detailed model with the errors of its connections, which files and calibration state.
/// Cost: the stand is put together some thirty times.
reduce::StandWithModes with_connection_errors(reduce::StandWithModes model, const FourHigh &stand,
                                              const reduce::LumpedStand &chain, const ComponentSets &components);

/// Writes curves/models.json, curves/modes-beam.csv, curves/modes-craig-bampton.csv, the files of every model
/// (app/stages/stand/model_files.h), six masses made from the other two, and adds their frequencies to the
/// results.
void compare_models(RunContext &run, const FourHigh &stand, const reduce::LumpedStand &chain,
                    const StandModels &models, const ComponentSets &components, const reduce::FeMasses &masses);

/// What an uncertain spring or mass does to the modes of the finite elements.
std::vector<reduce::ModalSensitivity> inputs_of_modes(const FourHigh &stand, const reduce::LumpedStand &chain,
                                                      const StandModels &models, const ComponentSets &components);
/// Keys behind the beams and the finite elements.
KeyList keys_of_models(const reduce::LumpedStand &chain);

/// Frequencies of the other models as checks of f1..f6, once those are computed.
void add_model_checks(RunContext &run, const StandModels &models);

/// The model that the case wants driven; nullptr: the six masses.
const reduce::StandWithModes *driven(const StandModels &models, const DynamicsSettings &settings);
}  // namespace mill
