#pragma once
#include "fem/roll/condensed_roll.h"
#include "meshes/roll/roll.h"
#include <memory>
#include <string>

namespace mill::verify {
/// A roll meshed in the system's temporary folder, condensed.
struct RollModel {
  std::shared_ptr<fem::ElasticBody> body;
  fem::CondensedRoll roll;
};
RollModel roll_model(const std::string &name, const RollGeometry &geometry, const meshes::RollMeshSize &size,
                     const Material &steel, const fem::CondenseOptions &options, int degree = 2);

/// Plane-strain slab for half widths from `smallest` to `largest` (m).
RollModel slab_model(const std::string &name, double diameter, double smallest, double largest, int per_half_width,
                     double thickness, const Material &steel);
}  // namespace mill::verify
