#pragma once
#include <Eigen/Core>
#include <vector>

namespace mill::dynamics {
/// Load and compression of a contact without the steps of its mesh.
struct SmoothSamples {
  std::vector<double> load;         ///< N
  std::vector<double> compression;  ///< m
  double deviation = 0;             ///< -, largest, of the samples; 0: they stand as they are
};

/// Compression over load as a polynomial in ln(load) of degree 2, the form of a line contact, else of degree 4, by
/// least squares of the relative deviation: nodes that come into contact one after the other step the slope of the
/// samples by percents, and a curve through them would bend frequencies by that.  Samples that no such form meets
/// within half a percent stay as they are.  theory.md 36.1
/// @param load         (n) N, > 0, increasing
/// @param compression  (n) m, > 0
SmoothSamples smooth_contact(const Eigen::VectorXd &load, const Eigen::VectorXd &compression);
}  // namespace mill::dynamics
