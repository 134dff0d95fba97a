#pragma once
#include "core/model/four_high.h"
#include "core/records/records.h"
#include "core/records/stand_model.h"
#include "reduce/chain/line_contact.h"
#include "reduce/chain/mill_modulus.h"
#include "reduce/stand/lumped_stand.h"
#include <array>
#include <functional>

// Numbers of the mill modulus of a stand with their error models: no text, no files.  theory.md 30
namespace mill::reduce {
/// The two work rolls on each other.
CylinderPair work_roll_pair(const FourHigh &stand);

/// Both work rolls on each other over the barrel.
struct TouchingWorkRolls {
  LineContact contact;
  SecantLaws laws;
  double error;           ///< -, relative, of the tangent
  double by_differences;  ///< N/m, the tangent from (3.4) at 1 % more and less force
};
/// @param load    N
/// @param off_K3  -, relative difference of K3 at this force from its closed form: what ends and profiles make of
///                a line contact; NaN: not computed, then the laws of the secant give the error
/// Errors and cost as line_contact.
TouchingWorkRolls touching_work_rolls(const FourHigh &stand, double load, double off_K3);

/// A share of the flexibility of K3 below which the strip is treated as wide as the barrel.
inline constexpr double least_bending = 1e-6;

/// Bending of both work rolls between a strip of this width (m) and their contact lines, as compliance of the gap:
/// m/N, (30.3).
/// @param solid  the work roll by finite elements; null: Euler's beam
double work_rolls_bending(const FourHigh &stand, const Component *solid, double width, double K3, double K5);

/// The same for the strip of the stand, as a spring.
struct BendingSpring {
  double compliance = 0;           ///< m/N
  bool meshed       = false;       ///< of rolls by finite elements
  bool bends        = false;       ///< the strip is narrower than the barrel; else nothing follows
  double by_width   = 0;           ///< 1/N, slope of the compliance over the width, by central differences
  double beam       = not_given;   ///< N/m, by Euler's beam
  double solid      = not_given;   ///< N/m, by finite elements; NaN without
  double error      = not_given;   ///< -, relative: mesh, K3 and K5, a beam against the mesh; NaN: not known
  std::vector<std::string> lacks;  ///< the contacts, where they state no error
};
/// @param rolls  the rolls by finite elements, as far as there are any; they are the spring where the case wants
///               solid rolls, and compared with it where it does not
/// Cost: two to eight bent rolls.
BendingSpring bending_spring(const FourHigh &stand, const SolidRolls &rolls, const Parameter &K3,
                             const Parameter &K5);

/// Slopes of a spring at one force.
struct SpringAtForce {
  double tangent, secant;  ///< N/m
};

/// A spring on the path of the force, and what it is at another one (N); empty: the same.
struct PathSpring : PathPart {
  std::function<SpringAtForce(double)> at_others;
};

/// A spring of the chain whose bearings deflect along their curve.
/// @param K_Zy      N/m, the bearings at the rolling force
/// @param secant    N/m, the same, from zero force
/// @param bearings  lives as long as the answer; null: not known
PathSpring spring_with_bearings(PathPart part, double K_Zy, double secant, const LoadDeflection *bearings);

/// A path at its rolling force.
struct PathModulus {
  MillModulus modulus;
  double by_differences;  ///< N/m, the tangent from secants at 2 % more and less force; where a contact has no
                          ///< samples there, from three forces beside, at most 4 % away, with a parabola; NaN: the
                          ///< contacts have samples at this one force only
  double by_tangents;     ///< N/m, the secant from tangents, summed from the smallest force of the stretch
  LoadDeflection stretch;  ///< 41 forces, a tenth to twice the rolling force as far as both contacts have samples
};
/// Where the frame follows a measured modulus, (30.12) gives the error in place of (30.5).
/// @param touching  the same path with work rolls that touch each other, which that modulus was measured on
/// @param load      N
/// @param contacts  their curves; null: given
/// Errors as mill_modulus.  Cost: 110 times the springs of the path.
PathModulus path_modulus(const std::vector<PathSpring> &path, const std::vector<PathSpring> &touching,
                         const Frame &frame, double load, const std::array<const ContactCurve *, 2> &contacts);

/// Opening of the gap of a model of the stand per rolling force, bite left out, at mid-length or as mean.  m/N,
/// (30.4)
double gap_opening(const StandModel &stand, MassReference reference);
}  // namespace mill::reduce
