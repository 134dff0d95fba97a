#include "reduce/stack/strip_flattening.h"
#include <algorithm>
#include <cmath>

namespace mill::reduce {
namespace {
// Fourfold antiderivative of 1/r, twice in x and twice in z; even in both.
double rectangle_potential(const double x, const double z)
{
  const double r = std::hypot(x, z);
  double sum     = -r * r * r / 6;
  if (x != 0 && z != 0)
    sum += 0.5 * x * x * std::abs(z) * std::asinh(std::abs(z / x)) +
           0.5 * std::abs(x) * z * z * std::asinh(std::abs(x / z));
  return sum;
}

// Unit line load from 0 to z, on a patch as wide as the arc: the part of the mean that its end at z adds.
double across_patch(const double arc, const double z)
{
  return 2 * (rectangle_potential(arc, z) - rectangle_potential(0, z));
}

// Line load at a place, by a straight line between the centres of elements.
void add_local(Eigen::VectorXd &row, const Eigen::VectorXd &edges, const double z, const double factor)
{
  const Eigen::Index n = row.size();
  const auto centre    = [&](const Eigen::Index k) { return 0.5 * (edges[k] + edges[k + 1]); };
  if (n == 1 || z <= centre(0)) {
    row[0] += factor;
    return;
  }
  Eigen::Index i = 0;
  while (i + 2 < n && centre(i + 1) < z)
    ++i;
  const double t = std::min(1., (z - centre(i)) / (centre(i + 1) - centre(i)));
  row[i] += (1 - t) * factor;
  row[i + 1] += t * factor;
}
}  // namespace

Eigen::VectorXd flattening_between(const FlattenedRoll &roll, const double z1, const double z2)
{
  const Eigen::Index n = roll.edges.size() - 1;
  const double nu = roll.material.poisson_ratio, E = roll.material.youngs_modulus, R = roll.radius;
  const double A = 2 * (1 - nu * nu) / (M_PI * E), z = 0.5 * (z1 + z2);
  Eigen::VectorXd row = Eigen::VectorXd::Zero(n);
  if (roll.law == Flattening::local) {
    add_local(row, roll.edges, z, A * (std::log(8 * R / roll.arc) - 0.5));  // (51.6)
    return row;
  }
  // (51.7): each end of an element once, for the two elements that share it.
  const double surface = 0.5 * A / (roll.arc * roll.arc * (z2 - z1)), depth = (1 + nu) / (2 * M_PI * E);
  const auto from_end = [&](const double end) {
    const double s = end - z;
    return surface * (across_patch(roll.arc, end - z1) - across_patch(roll.arc, end - z2)) -
           depth * (s / std::hypot(s, R) + 2 * (1 - nu) * std::asinh(s / R));
  };
  double left = from_end(roll.edges[0]);
  for (Eigen::Index j = 0; j < n; ++j) {
    const double right = from_end(roll.edges[j + 1]);
    row[j]             = right - left;
    left               = right;
  }
  add_local(row, roll.edges, z, A * (std::log(8.) - 2 + 1 / (2 * (1 - nu))));
  return row;
}

Eigen::MatrixXd flattening_matrix(const FlattenedRoll &roll)
{
  const Eigen::Index n = roll.edges.size() - 1;
  Eigen::MatrixXd C(n, n);
  for (Eigen::Index i = 0; i < n; ++i)
    C.row(i) = flattening_between(roll, roll.edges[i], roll.edges[i + 1]).transpose();
  return C;
}
}  // namespace mill::reduce
