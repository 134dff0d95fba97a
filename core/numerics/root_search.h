#pragma once
#include <functional>
#include <limits>
#include <optional>

// Searches in one unknown.  All stop by one rule: the bracket is narrower than `within` times its larger end.
namespace mill {
constexpr double last_digits = 4 * std::numeric_limits<double>::epsilon();

/// A place and the value of a function there.
struct Evaluated {
  double argument;  ///< unit of the argument
  double value;     ///< unit of the function
};

/// Root of f between two ends: G. E. Alefeld, F. A. Potra, Y. Shi, ACM Transactions on Mathematical Software 21
/// (1995) 327, by Boost.Math.  Nothing where f has one sign at both ends, or is not a number there.  f may jump
/// through zero; it must be finite.
/// Cost: the ends and 6 to 12 evaluations of a smooth f.
/// @throws SolverError after 500 evaluations
std::optional<double> root_between(double low, double high, const std::function<double(double)> &f,
                                   double within = last_digits);
/// The same where the values at the ends are known.
std::optional<double> root_between(Evaluated low, Evaluated high, const std::function<double(double)> &f,
                                   double within = last_digits);

/// Least value of f between two ends and its place, by R. P. Brent's method of Boost.Math; the least of one valley
/// where f has several.  The place is known to 1e-8 of low..high: nearer to it a double does not show the change
/// of a smooth function.
/// Cost: some 15 evaluations of a smooth f, 40 of another.
Evaluated minimum_between(double low, double high, const std::function<double(double)> &f);

/// Where a property changes.
struct Border {
  double holds, fails;  ///< unit of the argument; nearest places known on either side
};

/// Border between a place where the property holds and one where it does not, which are not tried again, by
/// halves. Cost: one evaluation for each binary digit of `within`.
Border border_between(double holds, double fails, const std::function<bool(double)> &property,
                      double within = last_digits);
}  // namespace mill
