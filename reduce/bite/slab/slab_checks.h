#pragma once
#include "reduce/bite/bite.h"

// What is asked of a pass before a closed theory is tried, and what is said of its state afterwards.
namespace mill::bite {
/// Checks thicknesses, width, radius, strain reference, flow stress, tensions and speeds.
/// @throws InputError  with the key, its value and what is allowed
void check_pass(const RollBite &bite);

/// True where the strip's flow stress at the entry is left open by its law.
bool entry_starts_from_nothing(const Strip &strip);

/// Checks a Coulomb, speed or film law.  @throws InputError
void check_coulomb(const RollBite &bite);

/// Checks a law of friction factors.  @throws InputError
void check_factors(const RollBite &bite);

/// One of both, by the law.  @throws InputError
void check_friction(const RollBite &bite);

/// "strip.friction = 0.02", or the coefficient with the law that gives it.
std::string friction_in_words(const Friction &law, double coefficient);

/// Refuses a bite without a neutral point: the strip is not pulled through, or torn through.
/// @param friction     the friction in words
/// @param needed       -, friction at which the neutral point reaches the end of the arc
/// @param beyond_exit  true: it lies behind the exit; false: before the entry
/// @throws InputError  always
[[noreturn]] void refuse_neutral_point(const std::string &friction, double angle_of_bite, double needed,
                                       bool beyond_exit);

/// Sentences on where the closed theories leave their range.
/// The strip has to be pushed in at its head.
Warning large_angle(const BiteState &state, double friction);
/// @param what_is_missing  "but no limit is set"
Warning sticking_strip(const BiteState &state, const char *what_is_missing);
std::vector<Warning> range_notes(const RollBite &bite, const BiteState &state, double friction_for_angle);
}  // namespace mill::bite
