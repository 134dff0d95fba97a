#pragma once
#include "core/model/bite_setup.h"
#include "reduce/bite/bite.h"

// One door to the slab theories of the roll bite.
namespace mill::bite {
using Theory = SlabTheory;

/// A theory with the shape of the arc it is solved on.
struct SlabModel {
  Theory theory = Theory::bland_ford;
  Arc arc       = Arc::hitchcock;
  int curve_points =
      101;  ///< of the curves along the arc, each side of the neutral point; 0: none, and the state is cheaper
};

/// Name of a model as reports call it: "Bland-Ford slab, Hitchcock's arc".
std::string model_name(const SlabModel &model);

/// Force, torque, pressure, film, flattened arc and every derivative of one pass by a slab theory.
/// Where Strip::initial_thickness is not given the strain is measured from the entry thickness, and the derivative
/// by the entry thickness takes that reference along.
///
/// @param flexibility  of the roll's surface, for Arc::elastic only
/// @throws InputError   what no roll can do with this strip (see bland_ford.h, hu_ehmann.h, karman.h), a friction
/// law
///                      that the theory does not know, Arc::elastic with a closed form
/// @throws SolverError  no flattened radius exists; the coupled iteration does not settle
/// Cost: closed forms some 10 us on a given arc, below 0.2 ms with flattening.
BiteState solve_slab(const RollBite &bite, const SlabModel &model, const ArcFlexibility *flexibility = nullptr);

/// Thickness with which the strip leaves the stand, under its front tension, m.  On a circle that of the gap (the
/// slab is rigid-plastic there); on a free arc Strip::exit_thickness is the smallest thickness under load, and the
/// strip springs back to where (17.12) has no pressure left.
double leaving_thickness(const RollBite &bite, const BiteState &state, Arc arc);

/// The four stiffnesses of a solved state.  theory.md 8.5
BiteStiffness slab_stiffness(const RollBite &bite, const BiteState &state);
}  // namespace mill::bite
