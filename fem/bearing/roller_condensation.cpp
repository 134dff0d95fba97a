#include "core/base/errors.h"
#include "fem/bearing/roller_contact.h"
#include "fem/body/elastic_body.h"
#include "fem/body/free_unknowns.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace mill::fem {
namespace {
std::vector<char> held_raceway(const ElasticBody &body, const bool odd)
{
  std::vector<char> held(std::size_t(3 * body.nodes().rows()), 0);
  const auto hold = [&](const char *group, const std::vector<int> &directions) {
    for (const int node : body.group(group))
      for (const int direction : directions)
        held[std::size_t(3 * node + direction)] = 1;
  };
  hold("symmetry.x", {0});
  hold("symmetry.z", odd ? std::vector<int>{0, 1} : std::vector<int>{2});
  hold("back", {0, 1, 2});
  return held;
}

// Nodes of the group patch by z, then by x: the roller's grid.
std::vector<int> in_grid_order(const ElasticBody &body, const PatchGrid &half)
{
  std::vector<int> order = body.group("patch");
  const auto &p          = body.nodes();
  const double small     = 0.01 * half.x[1];
  std::sort(order.begin(), order.end(), [&](const int a, const int b) {
    return std::abs(p(a, 2) - p(b, 2)) > small ? p(a, 2) < p(b, 2) : p(a, 0) < p(b, 0);
  });
  if (int(order.size()) != half.n_x * half.n_z)
    throw SolverError({"raceway: its patch does not match that of the roller", "", "", "", ""});
  return order;
}

// Flexibility of a piece of raceway for both parities about mid-length.
CondensedRoller::Parities condense_raceway(const MeshFile &mesh, const PatchGrid &half, CondensedRoller &condensed)
{
  const ElasticBody body(mesh, condensed.setup.material, 2);
  const std::vector<int> patch = in_grid_order(body, half);
  const auto symmetry          = [&](const bool odd) {
    const FreeUnknowns f = free_unknowns(body.unit_stiffness(), held_raceway(body, odd));
    std::vector<int> retained, row(patch.size(), -1);
    for (std::size_t i = 0; i < patch.size(); ++i)
      if (const int place = f.place[std::size_t(3 * patch[i] + 1)]; place >= 0) {
        row[i] = int(retained.size());
        retained.push_back(place);
      }
    const CondensingFactor factor(f.K, f.node, retained);
    condensed.factor_bytes = std::max(condensed.factor_bytes, factor.cost().bytes);
    condensed.n_unknowns += odd ? 0 : int(f.unknown.size());
    const Eigen::MatrixXd C = inverse_from_factor(factor.schur_factor()) / body.stiffness_unit();
    return rows_and_columns(C, row, row);
  };
  return {symmetry(false), symmetry(true)};
}
}  // namespace

CondensedRoller condense_roller(const RollerSetup &setup, const RollerMeshes &meshes, const Progress &progress)
{
  CondensedRoller out;
  out.setup = completed(setup);
  CondenseOptions options;
  options.both_sides = true;
  CondensedRoll roll =
      condense(ElasticBody(meshes.roller, out.setup.material, 2), meshes.roller.geometry, options);
  out.symmetric     = {std::move(roll.symmetric.patch), std::move(roll.symmetric_odd.patch)};
  out.antisymmetric = {std::move(roll.antisymmetric.patch), std::move(roll.antisymmetric_odd.patch)};
  out.factor_bytes  = roll.factor_bytes;
  out.n_unknowns    = roll.n_unknowns;
  progress.at("roller", 0.5);
  out.inner = condense_raceway(meshes.inner, roll.grid, out);
  progress.at("roller", 0.75);
  out.outer = condense_raceway(meshes.outer, roll.grid, out);
  out.grid  = both_sides(roll.grid);
  progress.at("roller", 1);
  return out;
}

PatchGrid both_sides(const PatchGrid &half)
{
  PatchGrid whole = half;
  const int n = half.n_x, m = half.n_z;
  whole.whole = true;
  whole.n_z   = 2 * m - 1;
  whole.z.resize(whole.n_z);
  whole.area.resize(n * whole.n_z);
  for (int k = 0; k < whole.n_z; ++k) {
    const int j                  = std::abs(k - (m - 1));
    whole.z[k]                   = k < m - 1 ? -half.z[j] : half.z[j];
    whole.area.segment(n * k, n) = half.area.segment(n * j, n) * (j == 0 ? 2 : 1);
  }
  return whole;
}

Eigen::MatrixXd both_sides(const CondensedRoller::Parities &half, const int n)
{
  const int m = int(half.even.rows()) / n;
  Eigen::MatrixXd C(n * (2 * m - 1), n * (2 * m - 1));
  for (int k = 0; k < 2 * m - 1; ++k)
    for (int l = 0; l < 2 * m - 1; ++l) {
      const int i = std::abs(k - (m - 1)), j = std::abs(l - (m - 1));
      const double sign = (k < m - 1) != (l < m - 1) ? -0.5 : 0.5;
      C.block(n * k, n * l, n, n) =
          0.5 * half.even.block(n * i, n * j, n, n) + sign * half.odd.block(n * i, n * j, n, n);
    }
  return C;
}

Eigen::MatrixXd pair_flexibility(const CondensedRoller &roller)
{
  const int n_x                       = roller.grid.n_x;
  const Eigen::MatrixXd symmetric     = both_sides(roller.symmetric, n_x),
                        antisymmetric = both_sides(roller.antisymmetric, n_x);
  const Eigen::Index n                = symmetric.rows();
  Eigen::MatrixXd C(2 * n, 2 * n);
  C.topLeftCorner(n, n)     = 0.5 * (symmetric + antisymmetric) + both_sides(roller.inner, n_x);
  C.topRightCorner(n, n)    = 0.5 * (symmetric - antisymmetric);
  C.bottomLeftCorner(n, n)  = C.topRightCorner(n, n).transpose();
  C.bottomRightCorner(n, n) = 0.5 * (symmetric + antisymmetric) + both_sides(roller.outer, n_x);
  return 0.5 * (C + C.transpose());
}
}  // namespace mill::fem
