#pragma once
#include <Eigen/Core>

namespace mill::twin {
struct WelchSpectrum;

/// The force that shakes a stand, as its mean square around each of k frequencies.  theory.md (46.1)
struct ForceBand {
  Eigen::VectorXd frequency;  ///< (k) Hz, midpoints of even steps, rising
  Eigen::VectorXd square;     ///< (k) N2, mean square of the force within a step
  bool measured = false;      ///< from a record; false: its level is not known, and only ratios have a meaning
};

/// White force from `low` to `high`.  @param step  Hz; as many steps as fit, evened out
ForceBand white_force(double low, double high, double step, double rms = 1);

/// The force of a record: its density, linear between the bins, from `low` to `high` or to the end of its band.
ForceBand measured_force(const WelchSpectrum &spectrum, double low, double high, double step);
}  // namespace mill::twin
