#pragma once
#include <Eigen/Core>
#include <gtest/gtest.h>
#include <string>

/// A relative tolerance and the reason for it.  No comparison without a reason.
struct Tolerance {
  double relative;
  std::string why;
  double scale    = 0;  ///< reference size when the expected value may be zero
  double absolute = 0;  ///< allowed whatever the size, in the unit of the values
};

Tolerance within(double relative, std::string why, double scale = 0);

/// An absolute tolerance, in the unit of the compared values: half of the last printed digit, an angle, a
/// rounding.
Tolerance within_absolute(double absolute, std::string why);

/// Passes if |actual - expected| <= relative * max(|expected|, scale); NaN fails, an empty reason fails.
/// The run ends with the five comparisons that used most of their tolerance.
testing::AssertionResult near(double actual, double expected, const Tolerance &tolerance);

/// Component by component; without a scale in the tolerance each component is compared relative to itself.
testing::AssertionResult near(const Eigen::VectorXd &actual, const Eigen::VectorXd &expected,
                              const Tolerance &tolerance);
