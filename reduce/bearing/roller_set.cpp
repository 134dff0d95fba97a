#include "reduce/bearing/roller_set.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace mill::bearing {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

RollerSet::RollerSet(RollerLaw law, const double roller_length, const int modes, const double least)
    : law_(with_limits(std::move(law))), shape_(line_modes(law_.position, roller_length, modes)), least_(least)
{
}

RollerForces RollerSet::forces(const VectorXd &approach, const RollerForces *start) const
{
  const Index m = shape_.cols(), n = shape_.rows(), rollers = approach.size() / m;
  RollerForces out{VectorXd::Zero(rollers * m), MatrixXd::Zero(m, rollers * m), MatrixXd::Zero(n, rollers),
                   std::vector<char>(std::size_t(rollers), 0)};
  for (Index j = 0; j < rollers; ++j) {
    const VectorXd d = shape_ * approach.segment(j * m, m);
    if ((d - law_.drop).maxCoeff() > 0) {
      const bool warm = start && start->slice_load.col(j).maxCoeff() > 0;
      const SliceLoads loads =
          slice_loads(law_, d, shape_, warm ? VectorXd(start->slice_load.col(j)) : VectorXd());
      if (loads.load.sum() > least_) {
        const MatrixXd K               = shape_.transpose() * loads.slope;
        out.slice_load.col(j)          = loads.load;
        out.slope.middleCols(j * m, m) = (K + K.transpose()) / 2;
        out.on_raceway[std::size_t(j)] = 1;
      }
    }
    if (!out.on_raceway[std::size_t(j)] && least_ > 0)
      out.slice_load.col(j).setConstant(least_ / double(n));
    out.load.segment(j * m, m) = shape_.transpose() * out.slice_load.col(j);
  }
  return out;
}

VectorXd RollerSet::even_load() const
{
  return shape_.colwise().mean();
}

const RollerLaw &RollerSet::law() const
{
  return law_;
}

double rib_angle(const RollerBearing &b)
{
  return std::isfinite(b.rib_angle) ? b.rib_angle : M_PI / 2 - (b.cup_angle - b.roller_cone_angle / 2);
}

RollerTriangle roller_triangle(const RollerBearing &b, const double cup, const double centrifugal)
{
  const double outer = b.cup_angle, inner = outer - b.roller_cone_angle, rib = rib_angle(b);
  const double base = std::sin(inner + rib);
  return {std::max(0.0, (cup * std::sin(outer + rib) - centrifugal * std::sin(rib)) / base),
          std::max(0.0, (cup * std::sin(outer - inner) + centrifugal * std::sin(inner)) / base)};
}

bool carries(const double load, const double heaviest)
{
  return load > 1e-9 * heaviest;
}

double least_cup_load(const RollerBearing &b, const double centrifugal)
{
  const double rib = rib_angle(b);
  return centrifugal * std::sin(rib) / std::sin(b.cup_angle + rib);
}
}  // namespace mill::bearing
