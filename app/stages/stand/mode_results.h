#pragma once
#include "app/run/run_context.h"
#include "core/case/provenance.h"
#include "core/model/dynamics_settings.h"
#include "core/model/lumped_model.h"
#include "core/records/result_row.h"
#include "reduce/stand/stand_comparison.h"
#include "reduce/stand/stand_errors.h"
#include <limits>
#include <string>
#include <vector>

namespace mill {
/// "craig-bampton" -> "rolls as reduced finite elements".
const char *title_of(const std::string &model);

/// Whether K4 of a chain is a number above zero, so that the stand has a rolling state.
bool knows_strip(const LumpedModel &chain);

/// Says that names and frequencies are those of the open stand, since `key` is not given.
void assume_open(RunContext &run, const std::string &key);

/// What is in the place "open" of the names of modes: "open", or "" of the rolling stand.  theory.md 22.9
const char *word_of_state(GapState state);

/// The chain of six masses with its modes and their names: without K4 where the force of the settings is measured.
reduce::StandWithModes chain_with_modes(LumpedModel model, const DynamicsSettings &dynamics);

/// curves/modes-<model>.csv, of the open stand curves/modes-<model>-open.csv: frequency of every mode, its share
/// of the gap's compliance and the displacement of every point, largest as 1.
void write_mode_table(RunContext &run, const reduce::StandWithModes &stand, GapState state = GapState::rolling);

/// Under which name a frequency of a model stands in the results: "craig-bampton.f3" for mode 2.
ResultName frequency_result(const StandModel &model, std::size_t mode, GapState state = GapState::rolling);

/// Springs of the static compliance of the gap, which the shares of the modes divide: those of both halves,
/// whether or not anything joins the halves.  theory.md (22.23)
std::vector<ChainNumber> gap_compliance_parts(const DynamicsSettings &settings);
/// The keys behind those springs.
KeyList gap_compliance_keys(const LumpedModel &model, const DynamicsSettings &settings);

/// The modes of a stand in one state of the gap, for results by name.
struct NamedModes {
  GapState state = GapState::rolling;  ///< whose names the results get
  /// The most detailed model first: its frequencies are in the results already.
  std::vector<const reduce::StandWithModes *> models;
  const std::vector<reduce::ModalSensitivity> &uncertain;  ///< inputs of the first one
  double limit = std::numeric_limits<double>::infinity();  ///< Hz
  KeyList of_gap;  ///< inputs of the shares of the gap's compliance that a frequency lacks
};

/// mode.<name>.frequency and mode.<name>.gap_share of every mode below the limit that the gap or a sensor sees
/// (ModeName::listed) and that has a name of its own: of the first model, compared with those of the other models
/// that have the same name.
void add_named_modes(RunContext &run, const NamedModes &named);
}  // namespace mill
