#pragma once
#include "twin/calibration/fitted_stand.h"
#include <Eigen/Core>
#include <string>
#include <vector>

// What a record would tell, before anyone measures; what two levels tell.  theory.md 45
namespace mill::twin {
/// A record that is thought of: white force, white noise of equal sensors.
struct PlannedRecord {
  std::vector<Eigen::Index> places;  ///< (m) places, from 0
  double duration      = 20;         ///< s
  double force_density = 0;          ///< N/sqrt(Hz), one-sided, up to force_highest
  double force_highest = 0;          ///< Hz
  bool force_recorded  = true;       ///< else the density of the force is one more unknown
  double noise         = 0.005;      ///< m/s2/sqrt(Hz), of each sensor
  double low = 20, high = 900;       ///< Hz, band that is fitted
};

/// What information says about unknowns in units of their priors.
struct Identification {
  std::vector<std::string> names;  ///< (p)
  Eigen::MatrixXd covariance;      ///< (p, p)
  Eigen::VectorXd shrink;          ///< (p) posterior over prior sd
  Eigen::VectorXd singular;        ///< (p) of A^(1/2) diag(prior sd), descending
  Eigen::MatrixXd direction;  ///< (p, p) column i: unit vector of theta over prior sd that belongs to singular i
  int effective() const;      ///< directions of which the record knows more than the prior
};
Identification identification(const Eigen::MatrixXd &information, const std::vector<Unknown> &unknowns);

/// The name of the force's density among the unknowns of a record without force.
constexpr const char *force_density_name = "S_F";

/// Information of a planned record at the case, theta = 0; midpoints of 0.02 Hz.  (45.3), without force (45.4)
/// Every unknown of fitted_stand.h may be asked for.
/// Cost: (high - low)/0.02 times p n^2: 0.2 s.
Identification planned(const FittedStand &stand, const std::vector<Unknown> &unknowns,
                       const PlannedRecord &record);

/// What one more sensor would add.
struct NextSensor {
  Eigen::Index place;  ///< from 0
  Identification identification;
  double gain;  ///< nats: half the logarithm of the ratio of the determinants of the covariances
};
/// Every place that has none yet; the one that adds most first.  Cost: as one plan where the force is recorded.
std::vector<NextSensor> next_sensors(const FittedStand &stand, const std::vector<Unknown> &unknowns,
                                     const PlannedRecord &record);

/// Root mean square of accelerations under white force up to a frequency, with their slopes.
struct WhiteForceLevels {
  Eigen::VectorXd rms;             ///< (m) m/s2
  std::vector<std::string> names;  ///< (p) "zeta", "bandwidth", then springs
  Eigen::MatrixXd slope;           ///< (m, p) -, dln rms/dln
};
/// @param bandwidth  Hz; its slope keeps the rms of the force: a wider force has less density
/// (45.6); midpoints of 0.02 Hz
WhiteForceLevels white_force_levels(const FittedStand &stand, const std::vector<Eigen::Index> &places,
                                    double force_rms, double bandwidth, const std::vector<std::string> &springs);
}  // namespace mill::twin
