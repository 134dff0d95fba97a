#pragma once
#include "dynamics/chatter/run.h"
#include <Eigen/Core>

// Right-hand side, Jacobian and edges of the nonlinear run; no integrator here.  theory.md 26.2
namespace mill::dynamics {
/// State z = (x, x', d sigma_e, d sigma_d), (2n+2).  Total tensions of z below zero mean slack.
class ChatterEquations {
public:
  /// What has a jump or a kink in it, positive on the first named side.  One roll contact each after the last.
  enum Edge {
    entry_tight,  ///< tension against slack
    exit_tight,
    held,       ///< strip between the rolls against free strip
    from_exit,  ///< neutral point inside the arc against skidding
    from_entry,
    entry_whole,  ///< against yielding under the tension
    exit_whole,
    gap_open,  ///< against rolls that meet
    n_edges
  };

  /// @throws InputError  density not positive; a contact of another size than the structure
  ChatterEquations(const ChatterStandModel &stand, const WorkingPoint &point, Linearisation scheme,
                   const ChatterRunOptions &options);

  /// The strip is between the rolls; changed by the integrator at an edge, since its speed jumps there.
  bool strip_held = true;
  long bites      = 0;  ///< evaluated so far

  Eigen::Index size() const;
  Eigen::VectorXd magnitude() const;  ///< (2n+2) motion of each state that goes with a gap change of 1 m
  void slope(const double *z, double *derivative);
  void jacobian(const double *z, Eigen::Ref<Eigen::MatrixXd> J);  ///< (2n+2, 2n+2)
  Eigen::Index edges() const;
  void edge_values(const double *z, double *value);

  bite::Moment moment(const double *z) const;  ///< tensions as they pull: never below zero
  bite::BiteAnswer answer(const double *z);    ///< a free strip with its own speed

  const StandStructure structure;
  const std::vector<RollContact> contacts;
  const bite::UnsteadyBite roll_bite;
  const bite::Moment steady_moment;
  const bite::BiteAnswer steady;

private:
  double free_speed(const bite::Moment &moment) const;

  bite::LinearCoefficients steady_by_;
  double entry_, exit_;          // Pa/m, modulus over length
  double impedance_;             // Pa s/m, of waves along the strip
  Eigen::MatrixXd K_, C_;        // (n, n) over the mass
  Eigen::VectorXd b_;            // (n) over the mass
  Eigen::MatrixXd contact_row_;  // (n, contacts) over the mass
};
}  // namespace mill::dynamics
