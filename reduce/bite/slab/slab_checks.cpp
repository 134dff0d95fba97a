#include "reduce/bite/slab/slab_checks.h"
#include "core/base/errors.h"
#include "core/laws/friction_law.h"
#include "reduce/bite/sentence.h"
#include "reduce/bite/slab/flattening.h"
#include "reduce/bite/slab/pass_inputs.h"
#include "reduce/bite/slab/settle.h"

namespace mill::bite {
namespace {
constexpr double flattening_range = 5;  // R'/R up to which Hitchcock's formula is used in practice
}

void refuse_unsettled(const double entry_speed, const double roll_speed)
{
  throw SolverError({"roll bite: film and speeds do not settle",
                     sentence("speed of the strip at the entry ", entry_speed, " m/s at a roll speed of ",
                              roll_speed, " m/s after 60 steps"),
                     "the film law answers to the speeds of the strip more than they answer to the friction",
                     "a higher roll speed, or strip.friction.law = \"coulomb\"", ""});
}

void check_pass(const RollBite &bite)
{
  const Strip &s = bite.strip;
  if (!(s.exit_thickness > 0 && s.entry_thickness > s.exit_thickness))
    throw InputError(sentence("strip.exit_thickness = ", s.exit_thickness * 1e3,
                              " mm must be positive and below strip.entry_thickness = ", s.entry_thickness * 1e3,
                              " mm"));
  if (!(s.width > 0 && bite.roll_radius > 0))
    throw InputError("strip.width and the work roll diameter must be positive");
  if (!std::isnan(s.initial_thickness) && !(s.initial_thickness >= s.entry_thickness))
    throw InputError(sentence("strip.initial_thickness = ", s.initial_thickness * 1e3,
                              " mm is below strip.entry_thickness = ", s.entry_thickness * 1e3,
                              " mm: the strip would have been rolled thicker"));
  if (s.entry_thickness - s.exit_thickness >= 2 * bite.roll_radius)
    throw InputError(sentence("strip.entry_thickness = ", s.entry_thickness * 1e3,
                              " mm less strip.exit_thickness = ", s.exit_thickness * 1e3,
                              " mm is more than rolls of a diameter of ", bite.roll_radius * 2e3,
                              " mm can take off: the entry lies beyond their axes"));
  const auto in             = pass_inputs<double>(bite, bite.roll_radius);
  const double entry_stress = stress_at(s.flow_stress, in, in.entry_thickness);
  const double exit_stress  = stress_at(s.flow_stress, in, in.exit_thickness);
  if (!(entry_stress >= 0 && exit_stress > 0))
    throw InputError(sentence("strip.flow_stress gives ", entry_stress / 1e6, " MPa at the entry and ",
                              exit_stress / 1e6, " MPa at the exit; it must be positive over the bite"));
  if (!(s.entry_tension < entry_stress || s.entry_tension == 0))
    throw InputError(sentence("strip.entry_tension = ", s.entry_tension / 1e6, " MPa reaches the flow stress ",
                              entry_stress / 1e6, " MPa at the entry: the strip yields before the bite"));
  if (!(s.exit_tension < exit_stress))
    throw InputError(sentence("strip.exit_tension = ", s.exit_tension / 1e6, " MPa reaches the flow stress ",
                              exit_stress / 1e6, " MPa at the exit: the strip yields behind the bite"));
  if (!std::isnan(bite.roll_speed) && !(bite.roll_speed > 0))
    throw InputError(sentence("the roll speed of ", bite.roll_speed, " m/s must be positive"));
  if (std::isnan(bite.roll_speed) && bite.gap_rate != 0)
    throw InputError(sentence("a gap that opens at ", bite.gap_rate,
                              " m/s moves the exit of the strip by an amount that depends on the roll speed; the "
                              "roll speed is not given"));
}

bool entry_starts_from_nothing(const Strip &strip)
{
  return starts_from_nothing(strip.flow_stress, std::isnan(strip.initial_thickness)
                                                    ? 0
                                                    : std::log(strip.initial_thickness / strip.entry_thickness));
}

void check_coulomb(const RollBite &bite)
{
  const Friction &law = bite.strip.friction;
  if (needs_speed(law) && std::isnan(bite.roll_speed))
    throw InputError("strip.friction.law = \"" + name_of(law.law) +
                     "\" depends on the speed of the rolls, which is not given; give it, or use law \"coulomb\"");
  check_constants(law);
  if (follows_bite(law)) {
    const auto in = pass_inputs<double>(bite, bite.roll_radius);
    if (entry_starts_from_nothing(bite.strip) ||
        !(stress_at(bite.strip.flow_stress, in, in.entry_thickness) > bite.strip.entry_tension))
      throw InputError("strip.friction.law = \"" + name_of(law.law) +
                       "\": the strip yields at no pressure at the entry, so the film has nothing to carry there; "
                       "a flow stress law that starts above zero is needed");
    return;
  }
  // Refuses factors by the way.
  const double mu = coulomb_coefficient(law, Inlet<double>{bite.roll_speed, 0, 0, 1, 1, 1});
  if (mu > 0)
    return;
  if (!needs_speed(law))
    throw InputError("strip.friction must be positive: without friction the rolls do not pull the strip through");
  throw InputError(sentence("strip.friction: the ", name_of(law.law), " law gives mu = ", mu, " at ",
                            bite.roll_speed, " m/s; it must be positive"));
}

void check_factors(const RollBite &bite)
{
  const Friction &law = bite.strip.friction;
  if (slides(law))
    throw InputError(
        "strip.friction.law = \"" + name_of(law.law) +
        "\": the theory of Hu and Ehmann takes friction factors; law \"factor\" with entry_factor and "
        "exit_factor (m is about 2 mu p / k), or another theory");
  const auto inside = [](const double m) { return m >= 0 && m <= 1; };
  if (!(inside(law.entry_factor) && inside(law.exit_factor) && law.entry_factor + law.exit_factor > 0))
    throw InputError(sentence("strip.friction: entry_factor = ", law.entry_factor, " and exit_factor = ",
                              law.exit_factor, " must lie between 0 and 1, and not both be 0"));
}

void check_friction(const RollBite &bite)
{
  if (slides(bite.strip.friction))
    check_coulomb(bite);
  else
    check_factors(bite);
}

std::string friction_in_words(const Friction &law, const double coefficient)
{
  return !std::isnan(plain_coefficient(law))
             ? sentence("strip.friction = ", coefficient)
             : sentence("the friction, by its ", name_of(law.law), " law ", coefficient, ",");
}

void refuse_neutral_point(const std::string &friction, const double angle_of_bite, const double needed,
                          const bool beyond_exit)
{
  throw InputError(sentence(
      friction, " is too small for an angle of bite of ", angle_of_bite, " rad",
      beyond_exit
          ? ": the rolls cannot pull the strip through, the neutral point would lie beyond the exit"
          : " and this front tension: the strip is torn through, the neutral point would lie before the entry",
      "; more than ", needed, " is needed, or ",
      beyond_exit ? "a smaller reduction, more front tension or less back tension" : "less front tension"));
}

Warning large_angle(const BiteState &state, const double friction)
{
  return {WarningId::bite_angle, "",
          sentence("the angle of bite ", state.bite_angle, " rad is larger than the friction ", friction),
          "the pass runs, but the strip has to be pushed in at its head"};
}

Warning sticking_strip(const BiteState &state, const char *what_is_missing)
{
  return {WarningId::bite_sticking, "",
          sentence("the friction stress reaches ", state.largest_shear, " times the shear yield stress"),
          sentence("the strip would stick, ", what_is_missing)};
}

std::vector<Warning> range_notes(const RollBite &bite, const BiteState &state, const double friction_for_angle)
{
  std::vector<Warning> notes;
  if (state.bite_angle > friction_for_angle)
    notes.push_back(large_angle(state, friction_for_angle));
  if (state.largest_shear > 1)
    notes.push_back(sticking_strip(state, "which Coulomb friction does not know"));
  if (beyond_hitchcock(bite, state.flattened_radius))
    notes.push_back(beyond_hitchcock_note(bite, state.flattened_radius));
  return notes;
}
}  // namespace mill::bite
