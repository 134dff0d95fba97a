#pragma once
#include "dynamics/exchange/exchanged_stand.h"
#include "dynamics/fmu/exported_model.h"

namespace mill {
struct DrivenStand;

/// The stand of an exported unit as matrices: the same pass, model, names, sources and force.  Compared with the
/// model that simulate drives before it is returned.  theory.md 35.7
/// @throws std::logic_error  they differ: an error of this program
dynamics::ExchangedStand exchanged_stand(const DrivenStand &stand, const fmu::ExportedModel &unit);
}  // namespace mill
