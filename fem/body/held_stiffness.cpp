#include "fem/body/held_stiffness.h"

namespace mill::fem {
HeldStiffness::HeldStiffness(const SymmetricSparse &stiffness, const std::vector<char> &held)
    : free(free_unknowns(stiffness, held)), factor(free.K, free.node, {})
{
  free.K = SymmetricSparse();
}

Eigen::MatrixXd HeldStiffness::on_free(const Eigen::MatrixXd &loads) const
{
  Eigen::MatrixXd out(Eigen::Index(free.node.size()), loads.cols());
  for (std::size_t i = 0; i < free.place.size(); ++i)
    if (free.place[i] >= 0)
      out.row(free.place[i]) = loads.row(Eigen::Index(i));
  return out;
}

Eigen::MatrixXd HeldStiffness::flexibility(const Eigen::MatrixXd &loads) const
{
  const Eigen::MatrixXd b = on_free(loads), C = b.transpose() * factor.solve(b);
  return 0.5 * (C + C.transpose());  // symmetric to rounding
}

Eigen::MatrixXd HeldStiffness::displacement(const Eigen::MatrixXd &loads) const
{
  const Eigen::MatrixXd u = factor.solve(on_free(loads));
  Eigen::MatrixXd out     = Eigen::MatrixXd::Zero(loads.rows(), loads.cols());
  for (std::size_t i = 0; i < free.place.size(); ++i)
    if (free.place[i] >= 0)
      out.row(Eigen::Index(i)) = u.row(free.place[i]);
  return out;
}

int HeldStiffness::n_unknowns() const
{
  return int(free.node.size());
}
}  // namespace mill::fem
