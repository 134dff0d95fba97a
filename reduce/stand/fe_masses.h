#pragma once
#include "core/records/stand_model.h"
#include "reduce/stand/lumped_stand.h"
#include <array>

namespace mill {
struct FourHigh;
}
namespace mill::reduce {
/// f1 and f2 of a stand model under a bite force of 1 N, at the stations of its lines.
struct StandShapes {
  RollShape f1_upper, f1_lower;  ///< work rolls, mid-length to end
  RollShape f2_upper, f2_lower;  ///< backup rolls, mid-length to end
};
StandShapes stand_shapes(const StandModel &stand);

/// M2..M5 by two roads from the shapes of a stand model (beams or components).  theory.md (22.14), (22.15)
struct FeMasses {
  std::array<double, 4> integral;  ///< kg, M2..M5: integrals (4.14)-(4.16) with the axis shapes of the model
  std::array<double, 4> solid;     ///< kg, M2..M5: kinetic energy of all material points
};
/// @param reference  of the backup rolls
FeMasses fe_masses(const FourHigh &stand, const StandModel &model, MassReference reference = MassReference::mid);
}  // namespace mill::reduce
