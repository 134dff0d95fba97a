#pragma once
#include "fem/roll/fourier_contact.h"

// Sums over the harmonics of a Fourier roll.  theory.md 11
namespace mill::fem {
/// Flexibility between the stations for given half widths, and its derivative with respect to that of the row.
struct StationFlexibility {
  Eigen::MatrixXd C, row_slope;  ///< (N, N) m/N; 1/N
};

StationFlexibility flexibility(const FourierSide &side, const Eigen::VectorXd &half_width);

/// Flexibility from the opposite generator: the alternating sum of the harmonics.  Far from the load nothing
/// depends on how wide it is, so it is widened until the terms fade: the window falls from 1 to 0 over the orders
/// between a quarter and three times those that are computed each.
Eigen::MatrixXd opposite(const std::vector<int> &order, const std::vector<Eigen::MatrixXd> &surface);
}  // namespace mill::fem
