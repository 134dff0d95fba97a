#pragma once
#include "reduce/bite/bite.h"
#include <string>

// Which solver serves a pass: numbers that tell thick from thin, soft from hard, gripping from skidding.
// theory.md 8.10
namespace mill::bite {
struct Regime {
  double arc_over_thickness = 0;          ///< -, projected arc over mean thickness, (8.34)
  double flattening         = not_given;  ///< -, R'/R of Hitchcock's circle by Karman's slab; nan: there is none
  double friction_margin    = not_given;  ///< -, friction over the least one with a neutral point, on that circle
  double elastic_share      = 0;          ///< -, length of the elastic zones over the plastic arc, (8.35)
  bool elastic_strip        = false;  ///< an elastic-plastic strip on a free arc; else rigid-plastic on a circle
  std::string reason;                 ///< for it, in numbers
};

/// Numbers and choice for one pass.
/// @throws InputError  thicknesses, tensions or friction with which no theory of slices can begin
/// Cost: some 3 ms.
Regime regime_of(const RollBite &bite);
}  // namespace mill::bite
