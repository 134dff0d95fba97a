#pragma once
#include "dynamics/chatter/chatter.h"
#include <array>
#include <string>

// Stands that the chatter cases share.
namespace mill::verify {
/// Masses, springs and dampers of a six-mass stand in the order of dynamics::six_mass_structure.
struct SixMasses {
  std::array<double, 6> mass;       ///< kg
  std::array<double, 6> stiffness;  ///< N/m
  std::array<double, 6> damping;    ///< N s/m
  double distance;                  ///< m, to the stands before and behind
};

/// Five variants of the stand of Liu et al. (2017), whose table of data is only partly legible: "D" (default),
/// "D36" (light upper backup roll), "C" (weak screw-down and lower dampers), "A" (lower backup roll and housing
/// exchanged), "B" (dampers of 1e8 as printed).  The distances were fitted to the critical speed of condition 2.
SixMasses six_masses(const std::string &name);

/// Stand D with all dampers on the scale c = scale (6.05, 4.25, 6.05, 6.05, 4.25, 6.05), N s/m.
SixMasses stand_on_damping_scale(double scale);

dynamics::ChatterStandModel chatter_stand(const SixMasses &stand);
dynamics::ChatterStandModel chatter_stand(const std::string &name);

/// Where the references of the stands come from, up to the names of their entries; what all stands share.
extern const char *const chatter_source;
extern const char *const chatter_stands;
}  // namespace mill::verify
