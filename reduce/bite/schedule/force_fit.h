#pragma once
#include "reduce/bite/slab/slab_bite.h"

// One unknown of a pass from its force: one equation, one unknown.  The force is met with any model, so that
// the agreement says nothing about it.  theory.md 39.2
namespace mill::bite {
/// The closed form that knows the friction of a strip: Bland and Ford's where it slides, Hu and Ehmann's where a
/// share of the shear yield stress is given.
inline Theory closed_form_theory(const Strip &strip)
{
  return slides(strip.friction) ? Theory::bland_ford : Theory::hu_ehmann;
}

/// False of a Coulomb coefficient of zero, with which no bite draws its strip in.
inline bool has_friction(const Friction &friction)
{
  return friction.law != FrictionLaw::coulomb || friction.coefficient > 0;
}

/// The unknown that meets the force, and the pass with it.
struct ForceFit {
  double value = 0;  ///< flow stress Pa, or friction -
  RollBite bite;     ///< with the value: constant flow stress, or plain friction
  BiteState state;   ///< of that bite on the arc of the fit
};

/// Constant plane-strain flow stress that returns the force, the friction being given.
/// On Hitchcock's arc the force gives R' at once; that the found stress leads to this R' as its *first* root is
/// verified.
/// @param arc    rigid or hitchcock
/// @param force  N, over the strip width
/// @throws InputError   a force that is not positive, below what tensions and friction allow, a bite without
///                      neutral point, another theory than bland_ford and hu_ehmann
/// @throws SolverError  the roll under this stress rests at a smaller force, or at none
/// Cost: some 50 us, 0.3 ms with factors
ForceFit fit_flow_stress(const RollBite &bite, Theory theory, Arc arc, double force);

/// Coulomb's coefficient, or the friction factor of both sides, that returns the force, the flow stress being
/// given.  @param most  largest friction that is tried
/// @throws as fit_flow_stress; InputError where no friction between nil and `most` returns the force
ForceFit fit_friction(const RollBite &bite, Theory theory, Arc arc, double force, double most = 1);
}  // namespace mill::bite
