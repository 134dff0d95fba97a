#include "fem/contact/reachable.h"
#include <Eigen/QR>
#include <algorithm>
#include <cmath>

namespace mill::contact {
Support pressing_support(const Eigen::MatrixXd &G, const Eigen::VectorXd &resultant)
{
  Support out;
  out.force.resize(0);
  out.missing       = resultant;
  const double size = resultant.norm();
  for (int step = 0; step < 20 * int(G.cols()) + 20 && out.missing.norm() > 1e-14 * size; ++step) {
    // The node whose push points most towards what is missing.
    int best        = -1;
    double steepest = 1e-12 * out.missing.norm();
    for (int i = 0; i < G.rows(); ++i) {
      const double length = G.row(i).norm();
      if (length == 0 || std::find(out.nodes.begin(), out.nodes.end(), i) != out.nodes.end())
        continue;
      const double slope = G.row(i).dot(out.missing) / length;
      if (slope > steepest) {
        steepest = slope;
        best     = i;
      }
    }
    if (best < 0)
      break;
    out.nodes.push_back(best);
    out.force.conservativeResize(out.nodes.size());
    out.force[out.force.size() - 1] = 0;
    // Unconstrained on the nodes taken; back to the boundary as long as one of them would pull.
    while (!out.nodes.empty()) {
      const Eigen::MatrixXd E    = G(out.nodes, Eigen::all).transpose();
      const Eigen::VectorXd free = E.colPivHouseholderQr().solve(resultant);
      if ((free.array() > 0).all()) {
        out.force = free;
        break;
      }
      double share = 1;
      for (int i = 0; i < free.size(); ++i)
        if (free[i] <= 0)
          share = std::min(share, out.force[i] / (out.force[i] - free[i]));
      if (!std::isfinite(share))
        share = 0;
      out.force += share * (free - out.force);
      std::vector<int> nodes;
      std::vector<double> force;
      const double floor = 1e-15 * out.force.cwiseAbs().maxCoeff();
      for (int i = 0; i < free.size(); ++i)
        if (!(free[i] <= 0 && out.force[i] <= floor)) {
          nodes.push_back(out.nodes[i]);
          force.push_back(out.force[i]);
        }
      if (nodes.size() == out.nodes.size())
        return out;
      out.nodes = nodes;
      out.force = Eigen::Map<Eigen::VectorXd>(force.data(), Eigen::Index(force.size()));
    }
    out.missing = resultant;
    if (!out.nodes.empty())
      out.missing -= G(out.nodes, Eigen::all).transpose() * out.force;
  }
  out.relative_missing = size > 0 ? out.missing.norm() / size : 0;
  return out;
}
}  // namespace mill::contact
