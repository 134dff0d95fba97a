#pragma once
#include "app/study/varied_key.h"
#include "core/model/material.h"
#include <string>
#include <vector>

namespace mill {
/// How an input is distributed; numbers in the unit of its key.
struct Spread {
  enum class Kind {
    uniform,     ///< low .. high
    normal,      ///< mean, sd; without ends
    truncated,   ///< normal between low and high
    triangular,  ///< low, most likely = mean, high
    tolerance,   ///< mean +- 3 sd, truncated there: a drawing's tolerance
    none         ///< takes the values of a list or grid
  };
  Kind kind   = Kind::none;
  double mean = not_given, sd = not_given, low = not_given, high = not_given;
};

/// One input of a study.
struct UncertainKey {
  VariedKey key;        ///< its values are those of a grid or list; empty with a spread
  Spread spread;        ///< in key.unit
  std::string written;  ///< "normal(5, 0.2) MN/mm", as the user wrote it
};

/// Reads "KEY~normal(mean, sd) UNIT", uniform(low, high), truncated(mean, sd, low, high), triangular(low, most
/// likely, high), tolerance(mean, half width).  A unit may follow every number or the bracket; "%" is of the mean.
/// With one number less, the mean is the value of the case: normal(2 %), tolerance(0.5 mm).
/// @throws InputError  unknown key or distribution; numbers missing, without unit, of another dimension, reversed;
/// a
///                     spread that is not positive; a normal of which more than 1e-6 lies outside of the key's
///                     range
UncertainKey uncertain_key(const Case &the_case, const std::vector<std::string> &sets, const std::string &written);

/// Does a --vary name a distribution and not values?
bool is_distribution(const std::string &written);

/// Part of a spread that lies outside of a range, -.
double share_outside(const Spread &spread, double low, double high);

/// The value as --set takes it: a number with its unit, or the word of this number (lists and grids).
std::string set_value(const UncertainKey &key, double number);
}  // namespace mill
