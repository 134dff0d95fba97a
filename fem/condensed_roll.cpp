#include "fem/condensed_roll.h"
#include "core/errors.h"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace mill::fem {
namespace {
// Stiffness without the held unknowns, and the way back.
struct Free {
  SymmetricSparse K;
  std::vector<int> place;    // of each unknown of the body in K, -1: held
  std::vector<int> unknown;  // of each row of K
  std::vector<int> node;     // of each row of K
};

Free free_unknowns(const ElasticBody &body, const std::vector<char> &held)
{
  const SymmetricSparse &A = body.stiffness();
  Free f;
  f.place.assign(A.rows(), -1);
  for (int i = 0; i < A.rows(); ++i)
    if (!held[i]) {
      f.place[i] = int(f.unknown.size());
      f.unknown.push_back(i);
      f.node.push_back(i / 3);
    }
  const int n = int(f.unknown.size());
  std::vector<int> start(n + 1, 0), rows;
  std::vector<double> values;
  rows.reserve(A.nonZeros());
  values.reserve(A.nonZeros());
  for (int j = 0; j < n; ++j) {
    for (SymmetricSparse::InnerIterator it(A, f.unknown[j]); it; ++it)
      if (f.place[it.row()] >= 0) {
        rows.push_back(f.place[it.row()]);
        values.push_back(it.value());
      }
    start[j + 1] = int(rows.size());
  }
  f.K = Eigen::Map<SymmetricSparse>(n, n, int(rows.size()), start.data(), rows.data(), values.data());
  return f;
}

// Bearing load over the seat: cosine-squared along the neck, so that no edge falls between nodes.
double seat_pressure(const double z, const void *context)
{
  const auto &g      = *static_cast<const RollGeometry *>(context);
  const double width = std::min(0.5 * g.neck_length, g.half_length + g.neck_length - g.seat_centre);
  const double s     = (z - g.seat_centre) / width;
  return std::abs(s) < 1 ? std::pow(std::cos(0.5 * M_PI * s), 2) : 0;
}

void read_grid(const ElasticBody &body, const std::vector<int> &patch, CondensedRoll &roll)
{
  const auto &p      = body.nodes();
  const double small = 1e-7 * roll.geometry.radius;
  roll.n_x           = 0;
  while (roll.n_x < int(patch.size()) && std::abs(p(patch[roll.n_x], 2) - p(patch[0], 2)) <= small)
    ++roll.n_x;
  roll.n_z = int(patch.size()) / roll.n_x;
  roll.x.resize(roll.n_x);
  roll.z.resize(roll.n_z);
  for (int i = 0; i < roll.n_x; ++i)
    roll.x[i] = p(patch[i], 0);
  for (int k = 0; k < roll.n_z; ++k)
    roll.z[k] = p(patch[k * roll.n_x], 2);
}
}  // namespace

// Symmetry planes x = 0 and z = 0, and the parity about y = 0.
std::vector<char> held_unknowns(const ElasticBody &body, const bool squeeze, const bool slab)
{
  std::vector<char> held(body.stiffness().rows(), 0);
  const auto hold = [&](const char *group, const int direction) {
    for (const int node : body.group(group))
      held[3 * node + direction] = 1;
  };
  hold("symmetry.x", 0);
  hold("symmetry.z", 2);
  if (slab)
    hold("end", 2);
  if (squeeze)
    hold("symmetry.y", 1);
  else {
    hold("symmetry.y", 0);
    hold("symmetry.y", 2);
    held[3 * body.axis().front() + 1] = 1;  // rigid motion along y: pinned, carried by the approach
  }
  return held;
}

std::vector<int> patch_in_grid_order(const ElasticBody &body)
{
  std::vector<int> patch = body.group("contact");
  const auto &p          = body.nodes();
  double reach           = 0;
  for (const int node : patch)
    reach = std::max(reach, p(node, 1));
  const double small =
      1e-7 * reach;  // stations of one layer agree to rounding, layers are micrometres thick at least
  std::sort(patch.begin(), patch.end(), [&](const int a, const int b) {
    return std::abs(p(a, 2) - p(b, 2)) > small ? p(a, 2) < p(b, 2) : p(a, 0) < p(b, 0);
  });
  return patch;
}

CondensedRoll condense(const ElasticBody &body, const RollGeometry &geometry, const CondenseOptions &options,
                       const Progress &progress)
{
  CondensedRoll roll;
  roll.geometry                = geometry;
  roll.degree                  = body.degree();
  const std::vector<int> patch = patch_in_grid_order(body);
  read_grid(body, patch, roll);
  const int n                = int(patch.size());
  const Eigen::VectorXd area = body.face_weights("contact");
  roll.area.resize(n);
  for (int i = 0; i < n; ++i)
    roll.area[i] = area[patch[i]];

  const auto solve_parity = [&](const bool squeeze) {
    const Free f                = free_unknowns(body, held_unknowns(body, squeeze, options.slab));
    const std::vector<int> axis = squeeze ? std::vector<int>() : body.axis();
    std::vector<int> retained;
    for (const int node : axis)
      if (f.place[3 * node + 1] >= 0)
        retained.push_back(f.place[3 * node + 1]);
    const int n_axis = int(retained.size());
    for (const int node : patch)
      retained.push_back(f.place[3 * node + 1]);
    const CondensingFactor factor(f.K, f.node, retained, options.memory);
    const Eigen::MatrixXd C                   = inverse_from_factor(factor.schur_factor());
    roll.n_unknowns                           = int(f.unknown.size());
    roll.factor_bytes                         = factor.cost().bytes;
    roll.factor_flops                         = factor.cost().n_flops;
    (squeeze ? roll.squeeze : roll.translate) = C.bottomRightCorner(n, n);
    if (!squeeze) {
      // The pinned axis node is the first; it does not move.
      const int n_all = int(axis.size());
      roll.axis_z.resize(n_all);
      for (int k = 0; k < n_all; ++k)
        roll.axis_z[k] = body.nodes()(axis[k], 2);
      roll.axis.setZero(n_all, n);
      roll.axis.bottomRows(n_axis) = C.topRightCorner(n_axis, n);
      const Eigen::VectorXd seat   = body.face_load("neck", seat_pressure, &geometry);
      Eigen::VectorXd load         = Eigen::VectorXd::Zero(roll.n_unknowns);
      for (int i = 0; i < seat.size(); ++i)
        if (f.place[3 * i + 1] >= 0)
          load[f.place[3 * i + 1]] = seat[i] / seat.sum();
      const Eigen::VectorXd u = factor.solve(load);
      roll.seat_patch.resize(n);
      for (int i = 0; i < n; ++i)
        roll.seat_patch[i] = u[f.place[3 * patch[i] + 1]];
      roll.seat_axis.setZero(n_all);
      for (int k = 0; k < n_all; ++k)
        if (const int i = f.place[3 * axis[k] + 1]; i >= 0)
          roll.seat_axis[k] = u[i];
    }
    if (options.keep_fields) {
      Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(roll.n_unknowns, n);
      for (int i = 0; i < n; ++i)
        loads(f.place[3 * patch[i] + 1], i) = -1;  // towards the axis is -y
      const Eigen::MatrixXd u = factor.solve(loads);
      Eigen::MatrixXd &field  = squeeze ? roll.field_squeeze : roll.field_translate;
      field.setZero(body.stiffness().rows(), n);
      for (int i = 0; i < roll.n_unknowns; ++i)
        field.row(f.unknown[i]) = u.row(i);
    }
  };
  solve_parity(true);
  progress.at("condensation", options.slab ? 1 : 0.5);
  if (!options.slab)
    solve_parity(false);
  progress.at("condensation", 1);
  return roll;
}

Eigen::VectorXd axial_weights(const Eigen::VectorXd &z, const double length, const int degree)
{
  Eigen::VectorXd w      = Eigen::VectorXd::Zero(z.size());
  const double gauss[]   = {0.5 - 0.5 * std::sqrt(0.6), 0.5, 0.5 + 0.5 * std::sqrt(0.6)};
  const double weights[] = {5. / 18, 8. / 18, 5. / 18};
  for (Eigen::Index k = 0; k + degree < z.size(); k += degree) {
    const double h = z[k + degree] - z[k], part = std::min(1., std::max(0., (length - z[k]) / h));
    for (int g = 0; g < 3; ++g) {
      const double s = part * gauss[g], dz = part * weights[g] * h;
      if (degree == 1)
        w.segment<2>(k) += dz * Eigen::Vector2d(1 - s, s);
      else
        w.segment<3>(k) += dz * Eigen::Vector3d((1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1));
    }
  }
  return w;
}

HeldRoll held_by_necks(const CondensedRoll &roll)
{
  return {0.5 * (roll.squeeze + roll.translate), -0.5 * roll.seat_patch, 0.5 * roll.axis, -0.5 * roll.seat_axis};
}

HeldRoll held_by_strip(const CondensedRoll &roll, const double strip_width)
{
  // The strip presses the other generator, uniformly over its width and over the width of the patch.
  const Eigen::VectorXd share = axial_weights(roll.z, 0.5 * strip_width, roll.degree),
                        whole = axial_weights(roll.z, roll.z[roll.n_z - 1], roll.degree);
  Eigen::VectorXd strip       = roll.area;
  for (int k = 0; k < roll.n_z; ++k)
    strip.segment(k * roll.n_x, roll.n_x) *= share[k] / whole[k];
  strip /= strip.sum();
  return {0.5 * (roll.squeeze + roll.translate), 0.5 * (roll.squeeze - roll.translate) * strip, 0.5 * roll.axis,
          -0.5 * roll.axis * strip};
}

HeldRoll held_by_mirror(const CondensedRoll &roll)
{
  const auto n = roll.squeeze.rows(), n_axis = std::max<Eigen::Index>(1, roll.axis_z.size());
  return {roll.squeeze, Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n_axis, n), Eigen::VectorXd::Zero(n_axis)};
}
}  // namespace mill::fem
