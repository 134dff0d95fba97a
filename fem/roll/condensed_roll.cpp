#include "fem/roll/condensed_roll.h"
#include "core/base/errors.h"
#include "core/process/memory.h"
#include "core/process/parallel.h"
#include "fem/body/free_unknowns.h"
#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace mill::fem {
namespace {
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
  PatchGrid &grid    = roll.grid;
  grid.degree        = body.degree();
  grid.n_x           = 0;
  while (grid.n_x < int(patch.size()) && std::abs(p(patch[grid.n_x], 2) - p(patch[0], 2)) <= small)
    ++grid.n_x;
  grid.n_z = int(patch.size()) / grid.n_x;
  grid.x.resize(grid.n_x);
  grid.z.resize(grid.n_z);
  for (int i = 0; i < grid.n_x; ++i)
    grid.x[i] = p(patch[i], 0);
  for (int k = 0; k < grid.n_z; ++k)
    grid.z[k] = p(patch[k * grid.n_x], 2);
  const Eigen::VectorXd area = body.face_weights("contact");
  grid.area.resize(Eigen::Index(patch.size()));
  for (std::size_t i = 0; i < patch.size(); ++i)
    grid.area[Eigen::Index(i)] = area[patch[i]];
}
}  // namespace

std::vector<char> constrained_unknowns(const ElasticBody &body, const SymmetryCase &symmetry, const bool slab)
{
  std::vector<char> held(3 * body.nodes().rows(), 0);
  const auto hold = [&](const char *group, const std::vector<int> &directions) {
    for (const int node : body.group(group))
      for (const int direction : directions)
        held[3 * node + direction] = 1;
  };
  hold("symmetry.x", {0});
  if (slab)
    hold("end", {2});
  hold("symmetry.y", symmetry.symmetric ? std::vector<int>{1} : std::vector<int>{0, 2});
  hold("symmetry.z", symmetry.odd ? std::vector<int>{0, 1} : std::vector<int>{2});
  // What stays free: translation along y, rotation about x, or (squeezed one way on each side) translation along
  // z.
  if (symmetry.symmetric && symmetry.odd)
    held[3 * body.axis().front() + 2] = 1;
  else if (!symmetry.symmetric)
    held[3 * (symmetry.odd ? body.axis().back() : body.axis().front()) + 1] = 1;
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

namespace {
// Places of the retained unknowns in the reduced matrix: axis along y, then the patch by component.
struct Retained {
  std::vector<int> all;
  std::vector<int> axis_row;   // of each axis node among the retained, -1: held
  std::vector<int> patch_row;  // of each of the n or 3n patch unknowns among the retained, -1: held
};

Retained choose(const FreeUnknowns &f, const std::vector<int> &axis, const std::vector<int> &patch,
                const bool tractions)
{
  Retained r;
  const auto keep = [&](const int node, const int direction) {
    const int place = f.place[3 * node + direction];
    if (place < 0)
      return -1;
    r.all.push_back(place);
    return int(r.all.size()) - 1;
  };
  for (const int node : axis)
    r.axis_row.push_back(keep(node, 1));
  for (const int direction : tractions ? std::vector<int>{1, 0, 2} : std::vector<int>{1})
    for (const int node : patch)
      r.patch_row.push_back(keep(node, direction));
  return r;
}
}  // namespace

CondensedRoll condense(const ElasticBody &body, const RollGeometry &geometry, const CondenseOptions &options,
                       const Progress &progress, const int threads)
{
  CondensedRoll roll;
  roll.geometry                = geometry;
  const std::vector<int> patch = patch_in_grid_order(body);
  read_grid(body, patch, roll);
  const int n = int(patch.size());

  const SymmetricSparse &stiffness = body.unit_stiffness();
  if (geometry.neck_length > 0 && !options.slab) {
    const Eigen::VectorXd seat = body.face_load("neck", seat_pressure, &geometry);
    roll.seat_lever            = seat.dot(body.nodes().col(2)) / seat.sum();
  }
  if (!options.slab) {
    roll.axis_z.resize(Eigen::Index(body.axis().size()));
    for (std::size_t k = 0; k < body.axis().size(); ++k)
      roll.axis_z[Eigen::Index(k)] = body.nodes()(body.axis()[k], 2);
  }
  struct Size {
    int n_unknowns = 0;
    FactorCost cost;
  };
  const auto solve_case = [&](const SymmetryCase &symmetry, Size &size) {
    CaseFlexibility out;
    const FreeUnknowns f = free_unknowns(stiffness, constrained_unknowns(body, symmetry, options.slab));
    const auto axis      = symmetry.symmetric ? std::vector<int>() : body.axis();
    const bool traction  = options.tractions && symmetry.symmetric;
    const Retained kept  = choose(f, axis, patch, traction);
    // Loads, solution and its copy on the free unknowns, then the field of every node.
    const bool fields   = options.keep_fields && symmetry.symmetric;
    const double values = fields ? n * (3. * double(f.unknown.size()) + 3. * double(body.nodes().rows())) : 0;
    const double left   = options.memory > 0 ? options.memory : memory_left().bytes;
    const CondensingFactor factor(f.K, f.node, kept.all, std::max(1., left - 8 * values));
    const Eigen::MatrixXd C = inverse_from_factor(factor.schur_factor()) / body.stiffness_unit();
    size                    = {int(f.unknown.size()), factor.cost()};
    const std::vector<int> normal(kept.patch_row.begin(), kept.patch_row.begin() + n);
    out.patch = rows_and_columns(C, normal, normal);
    if (traction) {
      out.traction = rows_and_columns(C, kept.patch_row, kept.patch_row);
      out.traction.topRows(n) *= -1;
      out.traction.leftCols(n) *= -1;
    }
    if (!symmetry.symmetric)
      out.axis = rows_and_columns(C, kept.axis_row, normal);
    if (!symmetry.symmetric && geometry.neck_length > 0) {
      const Eigen::VectorXd seat = body.face_load("neck", seat_pressure, &geometry);
      Eigen::VectorXd load       = Eigen::VectorXd::Zero(size.n_unknowns);
      for (int i = 0; i < seat.size(); ++i)
        if (f.place[3 * i + 1] >= 0)
          load[f.place[3 * i + 1]] = seat[i] / seat.sum();
      const Eigen::VectorXd u = factor.solve(load) / body.stiffness_unit();
      const auto along_y      = [&](const std::vector<int> &nodes) {
        Eigen::VectorXd v = Eigen::VectorXd::Zero(Eigen::Index(nodes.size()));
        for (std::size_t k = 0; k < nodes.size(); ++k)
          if (const int i = f.place[3 * nodes[k] + 1]; i >= 0)
            v[Eigen::Index(k)] = u[i];
        return v;
      };
      out.seat_patch = along_y(patch);
      out.seat_axis  = along_y(axis);
    }
    if (fields) {
      Eigen::MatrixXd loads = Eigen::MatrixXd::Zero(size.n_unknowns, n);
      for (int i = 0; i < n; ++i)
        if (const int place = f.place[3 * patch[i] + 1]; place >= 0)
          loads(place, i) = -1;  // towards the axis is -y
      const Eigen::MatrixXd u = factor.solve(loads) / body.stiffness_unit();
      out.field.setZero(3 * body.nodes().rows(), n);
      for (int i = 0; i < size.n_unknowns; ++i)
        out.field.row(f.unknown[i]) = u.row(i);
    }
    return out;
  };
  const bool odd_symmetric     = !options.slab && (options.both_sides || options.odd_symmetric);
  const bool odd_antisymmetric = !options.slab && options.both_sides;
  std::vector<std::pair<SymmetryCase, CaseFlexibility *>> cases{{{true, false}, &roll.symmetric}};
  if (!options.slab)
    cases.push_back({{false, false}, &roll.antisymmetric});
  if (odd_symmetric)
    cases.push_back({{true, true}, &roll.symmetric_odd});
  if (odd_antisymmetric)
    cases.push_back({{false, true}, &roll.antisymmetric_odd});
  std::vector<Size> sizes(cases.size());
  std::atomic<int> done{0};
  share_tasks(long(cases.size()), threads, [&](const long i) {
    const auto &[symmetry, out] = cases[std::size_t(i)];
    *out                        = solve_case(symmetry, sizes[std::size_t(i)]);
    progress.at("condensation", double(++done) / double(cases.size()));
  });
  roll.n_unknowns   = sizes.back().n_unknowns;
  roll.factor_bytes = sizes.back().cost.bytes;
  roll.factor_flops = sizes.back().cost.n_flops;
  return roll;
}

Eigen::VectorXd axial_weights(const Eigen::VectorXd &z, const double from, const double to, const int degree)
{
  Eigen::VectorXd w      = Eigen::VectorXd::Zero(z.size());
  const double gauss[]   = {0.5 - 0.5 * std::sqrt(0.6), 0.5, 0.5 + 0.5 * std::sqrt(0.6)};
  const double weights[] = {5. / 18, 8. / 18, 5. / 18};
  for (Eigen::Index k = 0; k + degree < z.size(); k += degree) {
    // Part of this element inside the range, in its own coordinate.
    const double h  = z[k + degree] - z[k];
    const double s0 = std::clamp((from - z[k]) / h, 0., 1.), s1 = std::clamp((to - z[k]) / h, 0., 1.);
    for (int g = 0; g < 3; ++g) {
      const double s = s0 + (s1 - s0) * gauss[g], dz = (s1 - s0) * weights[g] * h;
      if (degree == 1)
        w.segment<2>(k) += dz * Eigen::Vector2d(1 - s, s);
      else
        w.segment<3>(k) += dz * Eigen::Vector3d((1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1));
    }
  }
  return w;
}

Eigen::VectorXd axial_weights(const Eigen::VectorXd &z, const double length, const int degree)
{
  return axial_weights(z, -length, length, degree);
}
}  // namespace mill::fem
