#pragma once
#include "fem/roll/fourier_contact.h"

// Sums over the harmonics of a Fourier roll.  theory.md 11
namespace mill::fem {
/// Flexibility between the stations for given half widths, and its derivative with respect to that of the row.
struct StationFlexibility {
  Eigen::MatrixXd C, row_slope;  ///< (N, N) m/N; 1/N
};

StationFlexibility flexibility(const FourierSide &side, const Eigen::VectorXd &half_width);

/// How a pressure is distributed across its patch.
enum class PatchPressure { semi_ellipse, uniform };

/// Factors of the computed orders in the mean displacement of a patch under itself, the sum over m of j_m^2 G_m:
/// (orders), that of order 1 left out.
Eigen::VectorXd own_weights(const std::vector<int> &order, double radius, double half_width,
                            PatchPressure pressure);
/// The same in the displacement at an angle (rad) from the load: the sum over m of j_m^2 cos(m angle) G_m, both
/// patches with a half width of 0.04 of the radius.  Far from the load nothing depends on that width.
Eigen::VectorXd angle_weights(const std::vector<int> &order, double angle);

/// Flexibility from the opposite generator: the alternating sum of the harmonics.  Far from the load nothing
/// depends on how wide it is, so it is widened until the terms fade: the window falls from 1 to 0 over the orders
/// between a quarter and three times those that are computed each.
Eigen::MatrixXd opposite(const std::vector<int> &order, const std::vector<Eigen::MatrixXd> &surface);
}  // namespace mill::fem
