#pragma once
#include "core/model/stack.h"
#include "fem/roll/fourier_roll.h"
#include "fem/roll/fourier_series.h"
#include <Eigen/Core>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

namespace mill::fem {
/// How one roll of a stack answers to forces across its axis, in its own frame and without the motions of a rigid
/// roll: forces on M stations from one end of the barrel to the other, and on P points of neck, barrel or shaft. A
/// force in a plane through the axis moves all in the same plane: that is order 1 of a Fourier series around the
/// roll, or a beam. All other orders act between the contact lines of a Fourier roll; a beam has none.
/// theory.md 51.4
class RollKernel {
public:
  Eigen::VectorXd edge;     ///< (M + 1) m, ends of the stations
  Eigen::VectorXd point;    ///< (P) m
  Eigen::MatrixXd bending;  ///< (M + P, M + P) m/N, order 1: means over the stations, then the points
  Eigen::MatrixXd axis;     ///< (M, M + P) m/N, the same of the axis

  /// (M, M) m/N, towards the axis, of the surface at an angle (rad) from the load; zero for a beam.  Each angle is
  /// summed once: the stands of a run, and the halves of a stand, share their kernels.
  const Eigen::MatrixXd &around(double angle) const;
  /// (M, M) m/N, of a patch under its own pressure.
  const Eigen::MatrixXd &under_itself(double half_width, PatchPressure pressure) const;
  bool has_surface() const
  {
    return roll != nullptr;
  }
  /// Place of a point.  @throws std::logic_error  the kernel was made without it
  Eigen::Index place_of(double z) const;

  std::shared_ptr<const FourierRoll> roll;  ///< absent: a beam

private:
  struct Sums {
    std::mutex access;
    std::map<std::array<double, 3>, Eigen::MatrixXd> known;
  };
  const Eigen::MatrixXd &remembered(const std::array<double, 3> &key,
                                    const std::function<Eigen::VectorXd()> &weights) const;
  Eigen::MatrixXd summed(const Eigen::VectorXd &weights) const;

  std::shared_ptr<Sums> sums = std::make_shared<Sums>();
};

/// Of a roll that is symmetric about mid-length, condensed for both sides.
RollKernel fourier_kernel(std::shared_ptr<const FourierRoll> roll);
/// Of a shaft with its rings, or of a roll with several steps: Timoshenko beam.  theory.md (51.19)
/// @param longest  m, of its stations
RollKernel beam_kernel(const StackRoll &roll, double longest);

/// The solid of a roll if it is one barrel with a neck or none on both sides, alike; nothing for other shafts.
std::optional<RollGeometry> solid_of(const StackRoll &roll);
/// Distances from mid-length of its supports and forces, increasing.
Eigen::VectorXd points_of(const StackRoll &roll);
/// m, half width of contact for which a roll of a stack is condensed: a part of the radius, so that one
/// condensation serves every load and partner.
double condensed_half_width(const RollGeometry &geometry);
}  // namespace mill::fem
