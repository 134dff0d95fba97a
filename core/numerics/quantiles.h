#pragma once

// Values that a random number exceeds with a probability between 0 and 1, by Boost.Math.
namespace mill {
double chi_square_above(double probability, double degrees_of_freedom);
double student_above(double probability, double degrees_of_freedom);
}  // namespace mill
