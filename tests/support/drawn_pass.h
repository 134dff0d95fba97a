#pragma once
#include "reduce/bite/bite.h"
#include <cmath>
#include <random>

namespace mill {
/// Pass number i of a campaign: every second one hot, drawn from what mills roll (thickness 0.15 to 250 mm,
/// reduction 2 to 50 %, friction 0.015 to 0.5, flow stress 20 to 1200 MPa).  Many of them are passes that no roll
/// can take.
inline bite::RollBite drawn_pass(const int i)
{
  std::mt19937_64 random(1000 + i);
  const auto even = [&](const double a, const double b) { return a + (b - a) * double(random() >> 11) * 0x1p-53; };
  const auto log_even = [&](const double a, const double b) { return a * std::pow(b / a, even(0, 1)); };
  const bool hot      = i % 2 == 1;
  bite::RollBite bite;
  Strip &s               = bite.strip;
  s.width                = 1;
  bite.roll_radius       = hot ? log_even(0.2, 0.6) : log_even(0.03, 0.35);
  s.entry_thickness      = hot ? log_even(1.5e-3, 0.25) : log_even(0.15e-3, 6e-3);
  s.exit_thickness       = s.entry_thickness * (1 - even(0.02, 0.5));
  s.flow_stress.k        = hot ? log_even(20e6, 300e6) : log_even(200e6, 1200e6);
  s.friction.coefficient = hot ? log_even(0.15, 0.5) : log_even(0.015, 0.15);
  s.entry_tension        = even(0, hot ? 0.1 : 0.4) * s.flow_stress.k;
  s.exit_tension         = even(0, hot ? 0.1 : 0.4) * s.flow_stress.k;
  s.youngs_modulus       = hot ? 120e9 : 210e9;
  s.poisson_ratio        = 0.3;
  bite.roll              = {210e9, 0.3};
  bite.roll_speed        = even(0.5, 20);
  return bite;
}
}  // namespace mill
