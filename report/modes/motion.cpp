#include "report/modes/drawing.h"
#include <cmath>

namespace mill::report {
Eigen::VectorXd StandDrawing::of(const ComparedModel &model, const ModelMode &mode) const
{
  Eigen::VectorXd d = Eigen::VectorXd::Zero(Eigen::Index(displacements.size()));
  for (std::size_t i = 0; i < displacements.size(); ++i) {
    const Displacement &from = displacements[i];
    double value             = 0;
    if (from.point >= 0)
      value = mode.points[from.point];
    else if (from.line >= 0) {
      const Eigen::VectorXd &z = model.lines[std::size_t(from.line)].z, &y = mode.lines[std::size_t(from.line)];
      const Eigen::Index n = z.size();
      Eigen::Index k       = 1;  // straight between the stations, and on beyond the last
      while (k + 1 < n && z[k] < from.z)
        ++k;
      value = n == 1 ? y[0] : y[k - 1] + (from.z - z[k - 1]) / (z[k] - z[k - 1]) * (y[k] - y[k - 1]);
    }
    d[Eigen::Index(i)] = std::isfinite(value) ? value : 0;
  }
  return d;
}

std::vector<Eigen::Vector2d> moved(const MovingShape &shape, const Eigen::VectorXd &displacement,
                                   const double swing)
{
  std::vector<Eigen::Vector2d> points;
  for (const Corner &c : shape.corners) {
    const double d = (1 - c.share) * displacement[c.from] + c.share * displacement[c.to];
    points.emplace_back(c.x, c.y - swing * d);
  }
  return points;
}
}  // namespace mill::report
