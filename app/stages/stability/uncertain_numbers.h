#pragma once
#include "dynamics/chatter/speed_interval.h"
#include "reduce/stand/stand_errors.h"
#include <string>
#include <vector>

// What of a pass and its stand is off by how much, as far as the critical speed feels it.  theory.md 27.6
namespace mill {
struct FourHigh;
struct RunContext;
struct StandSpan;

/// What the interval takes for inputs whose error no case states, half of 95 %, relative.
namespace usual_error {
constexpr double friction = 0.2, flow_stress = 0.1, tension = 0.05, entry_thickness = 0.01, exit_thickness = 0.01,
                 distance = 0.02, assumed_distance = 0.3, modal_damping = 0.3, spring_or_mass = 0.1;
}  // namespace usual_error

/// Errors that bite.fit has found of a pass, -, half of 95 %; NaN: not fitted, the usual ones are taken.
struct FittedErrors {
  double friction = not_given, flow_stress = not_given;
};
FittedErrors fitted_errors(const RunContext &run);

struct UncertainNumbers {
  std::vector<dynamics::UncertainNumber> numbers;
  std::string assumed;  ///< a sentence on the errors that the case does not state
};

/// Bite, strip and damping of a pass.
/// @param damping_tolerance  -, of the damping of the modes; NaN: the usual one
void add_pass_numbers(UncertainNumbers &all, const FittedErrors &fitted, const bite::RollBite &bite,
                      const StandSpan &span, double damping_tolerance);

/// Springs and masses of the stand with the errors that they state, twins of one number together (upper and lower
/// contact of one model, bearing of one drawing, frame part of one rule); then bite, strip and damping.
/// @param inputs  of the modes that the search uses
/// @param n       modes that it uses
UncertainNumbers uncertain_numbers(const FittedErrors &fitted, const FourHigh &stand, const bite::RollBite &bite,
                                   const std::vector<reduce::ModalSensitivity> &inputs, Eigen::Index n);
}  // namespace mill
