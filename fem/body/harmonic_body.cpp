#include "fem/body/harmonic_body.h"
#include "core/numerics/gauss.h"
#include "fem/body/held_stiffness.h"
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mill::fem {
namespace {
enum Component { u_r = 0, u_theta = 1, u_z = 2 };

// Group of the mesh, empty if it has no group of that name.
std::vector<int> group_or_none(const SectionBody &body, const std::string &name)
{
  try {
    return body.group(name);
  } catch (const std::out_of_range &) {
    return {};
  }
}

// Volume around each node: the integral of its shape function by the rule whose points are the nodes, exact for
// straight cells with parallel sides.
Eigen::VectorXd nodal_volumes(const SectionBody &body)
{
  const auto &p       = body.nodes();
  Eigen::VectorXd out = Eigen::VectorXd::Zero(p.rows());
  const Eigen::VectorXd share =
      body.degree() == 1
          ? Eigen::VectorXd(Eigen::VectorXd::Constant(4, 0.25))
          : (Eigen::VectorXd(9) << 1, 1, 1, 1, 4, 4, 4, 4, 16).finished() / 36.;  // corners, sides, middle
  body.each_cell([&](const std::vector<int> &nodes, const std::vector<CellPoint> &) {
    const Eigen::RowVector2d one = p.row(nodes[3]) - p.row(nodes[0]), two = p.row(nodes[2]) - p.row(nodes[1]);
    const double area = 0.5 * std::abs(one[0] * two[1] - one[1] * two[0]);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      out[nodes[i]] += area * share[Eigen::Index(i)] * 2 * M_PI * p(nodes[i], 0);
  });
  return out;
}

// Order 1 on the axis: u_theta = s - u_r with the new unknown s, zero for a single-valued field.
Eigen::SparseMatrix<double> sum_on_axis(const std::vector<int> &axis, const Eigen::Index n)
{
  Eigen::SparseMatrix<double> change(n, n);
  change.setIdentity();
  for (const int node : axis)
    change.coeffRef(3 * node + u_theta, 3 * node + u_r) = -1;
  return change;
}
}  // namespace

HarmonicBody::HarmonicBody(const SectionBody &section)
    : body(section), axis(group_or_none(section, "axis")), held(group_or_none(section, "held")),
      volume(nodal_volumes(section))
{
  std::sort(axis.begin(), axis.end(),
            [&](const int a, const int b) { return body.nodes()(a, 1) < body.nodes()(b, 1); });
  if (is_free() && axis.empty())
    throw std::logic_error("a body of revolution that is free must reach its axis");
}

bool HarmonicBody::is_free() const
{
  return held.empty();
}
int HarmonicBody::n_unknowns() const
{
  return 3 * int(body.nodes().rows());
}
const Eigen::VectorXd &HarmonicBody::volumes() const
{
  return volume;
}

Eigen::MatrixXd HarmonicBody::rigid_motions(const int m) const
{
  const auto &p     = body.nodes();
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(n_unknowns(), m > 1 ? 0 : m + 1);
  for (Eigen::Index n = 0; n < p.rows() && m < 2; ++n) {
    if (m == 0)
      R(3 * n + u_z, 0) = 1;
    else {
      R.block<3, 1>(3 * n, 0) << 1, -1, 0;
      R.block<3, 1>(3 * n, 1) << p(n, 1), -p(n, 1), -p(n, 0);
    }
  }
  return R;
}

// What is zero: at the support, on the axis (for order 1 the sum u_r + u_theta, which stands in the place of
// u_theta there), the twist, and one unknown per rigid motion of a free body.
std::vector<char> HarmonicBody::supports(const int m) const
{
  std::vector<char> out(std::size_t(n_unknowns()), 0);
  const auto hold = [&](const std::vector<int> &nodes, const std::vector<Component> &components) {
    for (const int node : nodes)
      for (const Component c : components)
        out[std::size_t(3 * node + c)] = 1;
  };
  hold(held, {u_r, u_theta, u_z});
  if (m == 0) {
    hold(axis, {u_r});
    for (std::size_t i = u_theta; i < out.size(); i += 3)
      out[i] = 1;
    if (is_free())
      hold({axis.front()}, {u_z});
  } else if (m == 1) {
    hold(axis, {u_theta, u_z});
    if (is_free())
      hold({axis.front(), axis.back()}, {u_r});
  } else
    hold(axis, {u_r, u_theta, u_z});
  return out;
}

Eigen::MatrixXd HarmonicBody::flexibility(const int m, const Eigen::MatrixXd &loads) const
{
  SymmetricSparse K = body.harmonic_stiffness(m);
  Eigen::MatrixXd B = loads;
  if (is_free() && m < 2) {
    const Eigen::MatrixXd R = rigid_motions(m);
    Eigen::VectorXd weight(n_unknowns());
    for (Eigen::Index n = 0; n < volume.size(); ++n)
      weight.segment<3>(3 * n).setConstant(volume[n]);
    const Eigen::MatrixXd WR = weight.asDiagonal() * R;
    B -= WR * (R.transpose() * WR).ldlt().solve(R.transpose() * loads);
  }
  if (m == 1 && !axis.empty()) {
    const auto change                        = sum_on_axis(axis, K.rows());
    const Eigen::SparseMatrix<double> full   = K.selfadjointView<Eigen::Upper>();
    const Eigen::SparseMatrix<double> turned = change.transpose() * full * change;
    K                                        = turned.triangularView<Eigen::Upper>();
    B                                        = change.transpose() * B;
  }

  return HeldStiffness(K, supports(m)).flexibility(B);
}

Eigen::VectorXd legendre(const double s, const int modes)
{
  Eigen::VectorXd P(modes);
  for (int a = 0; a < modes; ++a)
    P[a] = a == 0 ? 1 : a == 1 ? s : ((2 * a - 1) * s * P[a - 1] - (a - 1) * P[a - 2]) / a;
  return P;
}

Eigen::VectorXd line_shape(const Eigen::Index n_nodes, const double s)
{
  Eigen::VectorXd N(n_nodes);
  if (n_nodes == 2)
    N << 1 - s, s;
  else
    N << (1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1);
  return N;
}

Eigen::MatrixXd raceway_loads(const SectionBody &body, const std::string &group, const RacewayLine &line,
                              const double length, const int modes, const int sign)
{
  const Surface raceway = body.surface(group);
  const GaussRule gauss = gauss_legendre(modes / 2 + 3);  // polynomial of degree modes - 1 times shape function
  const auto last       = raceway.faces.cols() - 1;
  Eigen::MatrixXd out   = Eigen::MatrixXd::Zero(3 * body.nodes().rows(), modes);
  for (Eigen::Index f = 0; f < raceway.faces.rows(); ++f) {
    const auto value_at = [&](const Eigen::Index corner) {
      return (raceway.points.row(raceway.faces(f, corner)).transpose() - line.middle).dot(line.along);
    };
    const double from = value_at(0), to = value_at(last);
    for (Eigen::Index g = 0; g < gauss.node.size(); ++g) {
      const double s = 0.5 * (1 + gauss.node[g]), x = from + s * (to - from);
      const Eigen::VectorXd P = legendre(2 * x / length, modes), N = line_shape(last + 1, s);
      for (Eigen::Index k = 0; k <= last; ++k) {
        const int node = raceway.node[std::size_t(raceway.faces(f, k))];
        for (int a = 0; a < modes; ++a) {
          const double amount =
              sign * 0.5 * std::abs(to - from) * gauss.weight[g] * N[k] * (2 * a + 1) / length * P[a];
          out(3 * node + u_r, a) += amount * line.normal[0];
          out(3 * node + u_z, a) += amount * line.normal[1];
        }
      }
    }
  }
  return out;
}
}  // namespace mill::fem
