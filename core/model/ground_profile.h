#pragma once
#include <array>
#include <vector>

// What a ground roller lacks in radius towards its ends, for bearings and for any two bodies in contact.
namespace mill {
/// Johns and Gohar's logarithm, m, at x (m) from mid-length; with rounding 0 Lundberg's, which has no end.
/// theory.md (5.7)
/// @param line_load   N/m, for which it is ground
/// @param half_width  m, Hertz half width under that load
/// @param modulus     Pa, E* of both bodies
/// @param length      m, of the face
/// Source: P. M. Johns, R. Gohar, Tribology International 14 (1981) 131.
double logarithmic_drop(double line_load, double half_width, double modulus, double length, double rounding,
                        double x);
constexpr double johns_gohar = 0.3033;  ///< -, rounding that bounds the drop at the end

/// m, straight between the points of a table that increases; mirrored when it begins at x >= 0.
double table_drop(const std::vector<std::array<double, 2>> &table, double x);
}  // namespace mill
