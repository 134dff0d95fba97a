#pragma once
#include "core/model/frame.h"

// A frame whose estimated stiffnesses are what a measured mill modulus leaves for them.  theory.md 30.3
namespace mill::reduce {
/// A modulus is given, and stiffnesses of the frame follow it.
bool is_closed(const Frame &frame);

/// Sum of 1/K over the stiffnesses that follow the modulus, m/N.
double closing_compliance(const Frame &frame);

/// The frame whose stiffnesses that follow the modulus have this compliance together and keep their proportion.
/// @param compliance  m/N, > 0, (30.11)
Frame with_closing_compliance(Frame frame, double compliance);

/// The frame on its modulus, (30.11).
/// @param rest  m/N, of everything on the path of the force with touching rolls but the stiffnesses that follow
/// @throws InputError  the rest alone is softer than the modulus, both numbers
Frame closed_on_modulus(Frame frame, double rest);
}  // namespace mill::reduce
