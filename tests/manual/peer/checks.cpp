#include "tests/manual/peer/checks.h"
#include <cmath>
#include <fmt/format.h>

namespace mill::verify::peer {
void add(std::vector<Check> &checks, const PeerPair &p, const Refinement &r, const double tolerance)
{
  const double limit = p.fine + (p.fine - p.coarse) / (std::pow(2, r.order) - 1);
  checks.push_back(
      reported(fmt::format("{}: peer, {} nodes", p.quantity, r.coarse_nodes), p.unit, p.coarse, limit));
  checks.push_back(reported(fmt::format("{}: peer, {} nodes", p.quantity, r.fine_nodes), p.unit, p.fine, limit));
  checks.push_back(
      relative(p.quantity + ": ours against the peer extrapolated", p.unit, p.ours, limit, tolerance));
}

std::vector<int> plane(const Mesh &mesh, const int axis, const double position)
{
  return nodes_where(mesh, [=](const Eigen::Vector3d &x) { return std::abs(x[axis] - position) < 1e-9; });
}
}  // namespace mill::verify::peer
