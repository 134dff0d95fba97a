#pragma once
#include "report/page/run.h"
#include <string>
#include <vector>

// Drawings of a stack of rolls that bend, from its stored curves; empty where nothing is stored.
namespace mill::report {
/// Rolls to scale with the resultants of their contacts and the angles of these.
std::string stack_section_drawing(const Run &run);
/// Line load of every contact of the upper half, in small on one scale.
std::vector<std::string> line_load_drawings(const Run &run);
std::vector<std::string> strip_drawings(const Run &run);
/// Change of the profile per unit of each input: forces, eccentrics.
std::vector<std::string> influence_drawings(const Run &run);
std::vector<std::string> deflection_drawings(const Run &run);
/// Modulus and crown over the rolling force.
std::vector<std::string> modulus_drawings(const Run &run);
/// Crown over bending force for each shift; states in which a contact is partly open have dots.
std::string settings_drawing(const Run &run);
/// Crown over rolling force for each width, and the largest pressure.
std::vector<std::string> window_drawings(const Run &run);
/// Axes of the rolls of both halves in each of the modes that open the gap most.
std::vector<std::string> mode_drawings(const Run &run);
}  // namespace mill::report
