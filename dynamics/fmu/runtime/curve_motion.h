#pragma once
#include "motion.h"
#include <memory>
#include <vector>

namespace mill::fmu {
/// The modes of kind "curves": the linear stand with what each spring's curve adds to its tangent, by the
/// fixed-step kernel of the program itself.  theory.md 36.3, 36.8
class CurveMotion {
public:
  /// @throws std::runtime_error  a curve that does not rise
  /// Cost: some thousand logarithms for each law.
  explicit CurveMotion(const ModelData &model);
  ~CurveMotion();
  CurveMotion(const CurveMotion &)            = delete;
  CurveMotion &operator=(const CurveMotion &) = delete;

  /// @param damping  -, of every mode; gap_damper  N s/m
  void tune(double damping, double gap_damper);

  /// A stretch of force in steps of equal length, none above CurveData::longest_step; implicit, of second order.
  /// The length of the steps depends on `length` alone.
  /// @throws std::runtime_error  compressions that could not be solved for; the state is that of the beginning
  /// Cost per step: 4 n + 2 s n + some s^2 (n modes, s springs); a new length n exponentials of 4 x 4.
  void advance(ModalState &state, double length, const StraightForce &force);

  /// At rest under a force (N) about the mean.
  /// @throws std::runtime_error  no equilibrium: the force pulls the stand apart
  ModalState equilibrium(double force) const;

  /// Takes the springs' additions from the accelerations of the linear stand, (n).
  void add_springs(const ModalState &state, std::vector<double> &acceleration) const;
  /// The same of the rate of the accelerations.
  void add_spring_rates(const ModalState &state, std::vector<double> &jerk) const;

  double rest_force() const;  ///< N, largest of the springs at rest

private:
  struct Kernel;
  std::unique_ptr<Kernel> kernel_;
};
}  // namespace mill::fmu
