#pragma once
#include "core/model/linearisation.h"
#include "reduce/bite/bite.h"
#include <array>

// The bite as a vibrating mill sees it: linear in gap, gap rate and tensions.  theory.md 8.9
namespace mill::bite {
/// Derivatives by gap h_d, gap rate, entry tension, exit tension and entry thickness, in this order
/// (units of the row's quantity per m, per m/s, per Pa, per Pa, per m).
using StripRow = std::array<double, 5>;
struct LinearCoefficients {
  StripRow entry_speed;       ///< of m/s
  StripRow exit_speed;        ///< of m/s
  StripRow force;             ///< of N
  StripRow friction;          ///< of -
  StripRow neutral_position;  ///< of m
};

/// Exact derivatives of the theory of Bland and Ford at a solved state.
/// @throws InputError  no roll speed given; a factor as friction
/// Cost: 10 us
LinearCoefficients linear_coefficients(const RollBite &bite, const BiteState &state, Linearisation scheme);
}  // namespace mill::bite
