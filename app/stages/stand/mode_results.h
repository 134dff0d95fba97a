#pragma once
#include "app/run/run_context.h"
#include "core/model/dynamics_settings.h"
#include "core/model/lumped_model.h"
#include "reduce/stand/stand_comparison.h"
#include <limits>
#include <vector>

namespace mill {
/// "craig-bampton" -> "rolls as reduced finite elements".
const char *title_of(const std::string &model);

/// The chain of six masses as it vibrates: without K4 where the measured force holds the reaction of the bite.
reduce::StandWithModes chain_with_modes(LumpedModel model, const DynamicsSettings &dynamics);

/// curves/modes-<model>.csv: frequency of every mode and the displacement of every point, largest as 1.
void write_mode_table(RunContext &run, const reduce::StandWithModes &stand);
/// Under which name a frequency of a model stands in the results: "craig-bampton.f3" for mode 2.
std::string frequency_result(const StandModel &model, std::size_t mode);

/// mode.<name>.frequency of every mode below the limit (Hz) that has a name: of the first model, whose frequencies
/// are in the results already, compared with those of the other models that have the same name.
void add_named_modes(RunContext &run, const std::vector<const reduce::StandWithModes *> &models,
                     double limit = std::numeric_limits<double>::infinity());
}  // namespace mill
