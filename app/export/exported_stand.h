#pragma once
#include "app/kinds/pipeline.h"
#include "dynamics/fmu/exported_model.h"
#include "dynamics/response/response.h"

namespace mill {
struct Case;

/// A stand in its modes.
fmu::ModelData modal_data(const dynamics::ModalModel &modes);

/// The stand in its modes, or its chain.
dynamics::DrivenModel driven_of(const DrivenStand &stand);

/// The stand as a unit needs it: model data, where each start value comes from, the force that travels along, and
/// the run that the unit must reproduce.  theory.md 35
fmu::ExportedModel exported_model(const DrivenStand &stand, const Case &of);
}  // namespace mill
