#pragma once
#include "reduce/bearing/assembly.h"
#include <optional>
#include <string>
#include <vector>

// Models of one bearing that the model of the case is compared with.
namespace mill::bearing {
/// A bearing with one ingredient of its model exchanged.
struct BearingVariant {
  std::string about;  ///< "roller on a mesh twice as coarse", "chock on two feet"
  BearingModel model;
};

/// The bearing with its rows side by side and its rollers touching where width and pitch diameter are not given:
/// under a radial load without tilt their places do not matter.
RollerBearing with_row_places(RollerBearing bearing);

/// The same without finite elements: laminae of ISO/TS 16281, or the law of the case, between rigid rings.
RollerBearing between_rigid_rings(RollerBearing bearing);

/// The same model between rigid rings.
BearingModel with_rigid_rings(BearingModel model);

/// Rows placed, rigid rings and rollers of this law.  Errors as roller_law.
BearingModel model_by_law(const RollerBearing &bearing, OneRollerLaw law);

/// The model with another published law of one roller: how well that law is known where no elements made it.
BearingModel with_neighbouring_law(BearingModel model);

/// The rows in the other usual arrangements, where the case does not state its own; named by the arrangement.
std::vector<BearingVariant> other_arrangements(const BearingModel &model);

/// What preload or interference presses every roller with before any load acts.
struct RestingFit {
  double load;         ///< N, on each roller, by the standard's law between rigid rings
  double pressure;     ///< Pa, on the inner raceway
  double yield_share;  ///< -, of preload or interference at which the raceway begins to yield
};
/// Nothing where nothing presses, or without roller or pitch diameter.  Pressure goes with the root of the
/// roller's load, that with the preload, or with the interference to the 10/9.
std::optional<RestingFit> resting_fit(RollerBearing bearing);
}  // namespace mill::bearing
