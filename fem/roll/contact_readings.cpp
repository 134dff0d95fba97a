#include "fem/roll/contact_readings.h"
#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace mill::fem {
Eigen::MatrixXd pressure_map(const ContactPair &pair, const ContactPoint &point)
{
  const PatchGrid &g = pair.grid;
  Eigen::MatrixXd p(g.n_z, 2 * g.n_x - 1);
  for (int k = 0; k < g.n_z; ++k)
    for (int i = 0; i < p.cols(); ++i) {
      const int node = k * g.n_x + std::abs(i - (g.n_x - 1));
      p(k, i)        = point.state.nodal[node] / g.area[node];
    }
  return p;
}

Eigen::Matrix<double, 6, 6> joint_stiffness(const ContactPair &contact_pair, const ContactPoint &point)
{
  const ContactPair &pair = complete(contact_pair);
  const PatchGrid &g      = pair.grid;
  if (!g.whole || !pair.axis.isZero(0))
    throw std::logic_error("a joint stiffness needs the whole contact between axes that stay straight");
  // Closing of the gap by a motion of the second roll along y (towards the first), along z (by the slope of the
  // profiles), and about x.
  Eigen::VectorXd slope(g.n_z);
  for (int k = 0; k < g.n_z; ++k) {
    const int a = std::max(0, k - 1), b = std::min(g.n_z - 1, k + 1);
    slope[k] = (pair.drop[b] - pair.drop[a]) / (g.z[b] - g.z[a]);
  }
  Eigen::MatrixXd closing(g.n_x * g.n_z, 3);
  for (int k = 0; k < g.n_z; ++k)
    closing.middleRows(k * g.n_x, g.n_x).rowwise() = Eigen::RowVector3d(1, slope[k], g.z[k]);
  std::vector<int> active;
  for (std::size_t i = 0; i < point.state.active.size(); ++i)
    if (point.state.active[i])
      active.push_back(int(i));
  const Eigen::MatrixXd G = closing(active, Eigen::all);
  const Eigen::MatrixXd C = pair.problem.C(active, active);
  const Eigen::Matrix3d K = pair.multiplicity * G.transpose() * C.llt().solve(G);
  const double second =
      pair.multiplicity * point.state.nodal.dot(closing.col(2).cwiseAbs2());  // integral of q z^2
  Eigen::Matrix<double, 6, 6> joint = Eigen::Matrix<double, 6, 6>::Zero();
  const std::array<int, 3> place{1, 2, 3};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      joint(place[i], place[j]) = K(i, j);
  joint(0, 0) = -point.load / pair.radii_sum;
  joint(4, 4) = -second / pair.radii_sum;
  joint(0, 4) = joint(4, 0) = -point.moment / pair.radii_sum;
  return joint;
}

Eigen::Matrix<double, 6, 6> fitted_joint_stiffness(const ContactPair &pair, const double load,
                                                   const double largest)
{
  // Eleven loads span about three steps of a contact with twelve nodes on its half width.
  constexpr double reach = 0.35;
  constexpr int n        = 11;
  const double above     = std::clamp(std::log(largest / load), 0., reach);
  Eigen::MatrixXd form(n, 3);
  Eigen::MatrixXd entries(n, 36);
  std::vector<char> active;
  for (int i = 0; i < n; ++i) {
    const double u   = -reach + (reach + above) * i / (n - 1);
    const auto point = solve_load(pair, load * std::exp(u), active);
    active           = point.state.active;
    form.row(i) << 1, u, u * u;
    entries.row(i) = joint_stiffness(pair, point).reshaped().transpose();
  }
  const Eigen::MatrixXd fit         = form.colPivHouseholderQr().solve(entries);
  Eigen::Matrix<double, 6, 6> joint = joint_stiffness(pair, solve_load(pair, load, active));
  joint.block<3, 3>(1, 1)           = Eigen::Matrix<double, 6, 6>(fit.row(0).reshaped(6, 6)).block<3, 3>(1, 1);
  return joint;
}

PathPlateau path_plateau(const ContactPair &pair, const ContactPoint &point, const double trim)
{
  const PatchGrid &g       = pair.grid;
  const auto profile       = barrel_profile(pair, point);
  const Eigen::VectorXd &w = pair.path;
  const double centre      = g.whole ? 0.5 * (g.z[0] + g.z[g.n_z - 1]) : 0;
  const double inside      = (g.z[g.n_z - 1] - centre) * (1 - 2 * trim);
  PathPlateau out{0, 0, 0};
  for (int k = 0; k < g.n_z; ++k)
    if (std::abs(g.z[k] - centre) <= inside * (1 + 1e-9) && profile.approach[k] > 0) {
      // A station on the plane of symmetry of a quarter represents both sides.
      const double length = (!g.whole && k == 0 ? 2 : 1) * w[k];
      out.mean += profile.line_load[k] * length / profile.approach[k];
      out.tributary_length += length;
      ++out.stations;
    }
  if (out.stations > 0) {
    out.mean /= out.stations;
    out.tributary_length /= out.stations;
  }
  return out;
}
}  // namespace mill::fem
