#pragma once
#include "core/base/choice.h"
#include "core/base/errors.h"
#include "core/model/bite_setup.h"
#include "core/model/chatter.h"
#include "core/model/dynamics_settings.h"
#include "core/model/pass.h"
#include "core/model/roller_bearing.h"
#include "core/model/stack.h"
#include "core/model/strip.h"

// kind = "stack" as it is written; core/case/stack_resolution.cpp makes a Stack of it.
namespace mill {
enum class LowerHalf { mirrored, turned, listed };
constexpr auto words_of(LowerHalf)
{
  return choice_words<LowerHalf>("mirrored", "turned", "listed");
}
enum class BendingAt { chock, window };
constexpr auto words_of(BendingAt)
{
  return choice_words<BendingAt>("chock", "window");
}

/// [stack]
struct StackSettings {
  LowerHalf lower      = LowerHalf::turned;
  BendingAt bending_at = BendingAt::chock;
};

/// [roll.saddles]: a backing shaft with rings between saddles.
struct StackSaddles {
  double shaft_diameter = 0;                 ///< m
  std::vector<double> positions;             ///< m, in the roll's own frame
  std::vector<double> stiffness;             ///< N/m, one for all or one of each saddle
  std::vector<double> eccentric;             ///< m, towards the strip; empty: none
  std::vector<std::array<double, 2>> rings;  ///< m, from and to of each; empty: the barrel
  double ring_stiffness = not_given;         ///< Pa, of a ring per length; absent: rigid
  bool given            = false;
};

/// [[roll]]; of Roll the barrel, the profile, neck diameter, bearing, its span and bending forces.
struct StackRollInput : Roll {
  std::string name;
  double total_length = not_given;                          ///< m
  std::vector<std::array<double, 3>> shaft;                 ///< m, (from, to, diameter)
  std::vector<std::string> on;                              ///< rolls that it leans on, away from the strip
  std::array<double, 2> position = {not_given, not_given};  ///< m, x and y of the axis
  std::vector<double> bearing_stiffness;                    ///< N/m, a side; two: upper, lower
  std::vector<double> housing_stiffness;  ///< N/m, in series with `bearing`; as bearing_stiffness
  std::vector<double> chock_mass;         ///< kg, a side; two: upper, lower; empty: none
  std::string material;                   ///< of a [material.NAME]; empty: [steel]
  StackSaddles saddles;
  Place place;  ///< of the [[roll]] header
  StackRollInput()
  {
    neck_diameter = bearing_span = not_given;
  }
};

/// Line load of the strip over its exit thickness.
enum class StackStripLaw { uniform, modulus, bite };
constexpr auto words_of(StackStripLaw)
{
  return choice_words<StackStripLaw>("uniform", "modulus", "bite");
}
enum class StackModel { condensed, beams };
constexpr auto words_of(StackModel)
{
  return choice_words<StackModel>("condensed", "beams");
}
enum class StackFlattening { half_space, local };
constexpr auto words_of(StackFlattening)
{
  return choice_words<StackFlattening>("half-space", "local");
}

/// [strip] and [engine].
struct StackStripInput : StackStrip {
  double given_force = not_given;  ///< N
  double gap         = not_given;  ///< m, S; replaces the force
  StackStripLaw law  = StackStripLaw::modulus;
  // Of its bite, for law = "bite" and for chatter.
  double entry_tension     = 0;          ///< Pa, back tension
  double exit_tension      = 0;          ///< Pa, front tension
  double initial_thickness = not_given;  ///< m, of zero strain; absent: entry thickness
  double youngs_modulus    = 210e9;      ///< Pa, of the strip
  double poisson_ratio     = 0.3;        ///< -, of the strip
  double coulomb           = not_given;  ///< -, friction; absent: a section of its own, or none
  StackStripInput()
  {
    modulus = entry_modulus = arc = entry_thickness = exit_thickness = not_given;
  }
};
struct StackEngine {
  StackModel model           = StackModel::condensed;
  StackFlattening flattening = StackFlattening::half_space;
};

/// [window]: what is computed around the settings of the case; a range that is not given: no map of it.
struct StackWindow {
  std::string bent, shifted;                               ///< rolls whose bending and shift vary
  std::array<double, 2> bending = {not_given, not_given};  ///< N, of each chock
  std::array<double, 2> shift   = {not_given, not_given};  ///< m
  std::array<double, 2> force   = {not_given, not_given};  ///< N
  std::array<double, 2> width   = {not_given, not_given};  ///< m, of the strip
  int points                    = 9;                       ///< along each of two settings
};

/// [material.NAME]
struct StackMaterial : Material {
  std::string name;
};

struct StackInput {
  Material steel;
  StackSettings settings;
  std::vector<StackMaterial> materials;
  std::vector<RollerBearing> bearings;
  std::vector<StackRollInput> rolls;
  StackStripInput strip;
  StackEngine engine;
  StackWindow window;
  Strip bite;                 ///< the strip with its laws; flow_stress.k NaN: not given, friction as in Strip
  std::vector<Pass> passes;   ///< what drives the solved stack; may be empty
  DynamicsSettings dynamics;  ///< frame, contact, mass_* and model unused
  StandSpan span;             ///< strip before and behind the stand, for chatter
  ChatterAnalysis analysis;   ///< of chatter
};
}  // namespace mill
