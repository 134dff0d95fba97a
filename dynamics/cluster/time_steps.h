#pragma once
#include "dynamics/cluster/collocation.h"
#include "dynamics/cluster/motion_equations.h"
#include <map>
#include <memory>
#include <vector>

namespace mill::cluster {
/// Steps of the equations of motion by collocation, solved in the modes of the state at rest, about which the
/// motion is nearly linear: some three evaluations a point.  A contact that opens or closes ends a step.
class TimeSteps {
public:
  /// @param tolerance  -, of the largest displacement so far
  TimeSteps(const MotionEquations &equations, const Stack &stack, const Motion &rest, const Eigen::VectorXd &state,
            double tolerance, double length);

  /// Which contact has ended a step before its time.
  struct Crossing {
    int contact = -1;
    bool opens  = false;
  };
  /// One or more steps up to `time`, or to the first contact that opens or closes.
  /// @throws SolverError  no step is short enough
  std::vector<Crossing> advance(double time);

  double time() const
  {
    return time_;
  }
  const double *state() const
  {
    return state_.data();
  }
  double longest_step() const
  {
    return longest_;
  }
  long steps = 0, evaluations = 0;

private:
  using Stages = Eigen::Matrix<double, Eigen::Dynamic, Collocation::stages>;  // modes x points
  struct Result {
    bool converged = false;
    double error   = 0;  // -, highest coefficient over the largest displacement
    Stages acceleration, position, velocity;
    Eigen::Matrix<double, 3, Collocation::stages> sums;
  };
  const std::vector<Collocation::Square> &inverses(double h);
  void start_from_modes(double h, Stages &acceleration) const;
  Result solve(double h);
  std::vector<int> changed(double time, const Eigen::VectorXd &state) const;
  double first_crossing(const Result &r, double h, int &contact) const;
  void accept(const Result &r, double h);
  Eigen::VectorXd physical(const Eigen::VectorXd &q, const Eigen::VectorXd &p) const;

  const MotionEquations &equations_;
  Collocation rule_;
  Eigen::MatrixXd V_, VtM_;    // mass-normalised modes
  Eigen::VectorXd roots_;      // 1/s2
  Eigen::VectorXd dampings_;   // 1/s, of every mode, uncoupled
  Eigen::VectorXd q_, p_;      // modal state
  Eigen::VectorXd state_;      // physical, with sums
  std::vector<char> closed_;   // of every contact
  std::vector<char> watched_;  // one-sided
  std::map<double, std::vector<Collocation::Square>> kept_;
  double time_ = 0, longest_ = 0, step_ = 0, tolerance_, length_;
};
}  // namespace mill::cluster
