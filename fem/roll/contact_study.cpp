#include "fem/roll/contact_study.h"
#include "core/base/errors.h"
#include "fem/contact/active_set.h"
#include "fem/contact/mortar.h"
#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mill::fem {
namespace {
// Half width and peak of one station, from p^2 = p0^2 (1 - x^2 / b^2) through its active nodes: finer than the
// grid.
struct ContactSection {
  double half_width = 0, peak = 0;
};
ContactSection fit_section(const PatchGrid &grid, const contact::State &state, const int station)
{
  std::vector<double> x, p;
  double highest = 0;
  for (int i = 0; i < grid.n_x; ++i) {
    const int node = station * grid.n_x + i;
    if (!state.active[node])
      continue;
    x.push_back(grid.x[i]);
    p.push_back(state.nodal[node] / grid.area[node]);
    highest = std::max(highest, p.back());
  }
  if (x.empty())
    return {};
  const double next = x.back() + 0.5 * (grid.x[1] - grid.x[0]);
  if (x.size() < 4)
    return {next, highest};
  x.pop_back();  // the last node sits on the edge, where its share of the element is a matter of chance
  double n = 0, sx = 0, sxx = 0, sy = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = x[i] * x[i], v = p[i] * p[i];
    n += 1, sx += u, sxx += u * u, sy += v, sxy += u * v;
  }
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx), top = (sy - slope * sx) / n;
  return slope < 0 && top > 0 ? ContactSection{std::sqrt(-top / slope), std::sqrt(top)}
                              : ContactSection{next, highest};
}

// Axes moving away from the contact at the stations.
Eigen::VectorXd axis_motion(const ContactPair &pair, const Eigen::VectorXd &nodal,
                            const Eigen::VectorXd &resultant)
{
  return pair.axis * nodal + pair.axis_support * resultant;
}

// Stations of both axes that belong to the patch: the first of a quarter, the middle ones of the whole.
Eigen::MatrixXd patch_rows(const Eigen::MatrixXd &axis, const PatchGrid &grid)
{
  return grid.whole ? axis.middleRows((axis.rows() - grid.n_z) / 2, grid.n_z) : axis.topRows(grid.n_z);
}

// Position along the contact of each node of the patch.
Eigen::VectorXd node_z(const PatchGrid &grid)
{
  Eigen::VectorXd z(grid.n_x * grid.n_z);
  for (int k = 0; k < grid.n_z; ++k)
    z.segment(k * grid.n_x, grid.n_x).setConstant(grid.z[k]);
  return z;
}

// Weights of mean and mean slope; both motions of a whole contact.
void drive_whole(ContactPair &pair)
{
  const Eigen::VectorXd &w = pair.path, &z = pair.grid.z;
  pair.mean = w / w.sum();
  if (!pair.grid.whole)
    return;
  pair.multiplicity     = 2;
  pair.problem.G.col(1) = node_z(pair.grid);
  // Least squares of a straight line through the stations: mean at z = 0, and slope.
  const double w0 = w.sum(), w1 = w.dot(z), w2 = w.dot(z.cwiseAbs2()), determinant = w0 * w2 - w1 * w1;
  pair.mean.resize(z.size(), 2);
  pair.mean.col(0) = w.cwiseProduct(Eigen::VectorXd((w2 - w1 * z.array()) / determinant));
  pair.mean.col(1) = w.cwiseProduct(Eigen::VectorXd((w0 * z.array() - w1) / determinant));
}
}  // namespace

Eigen::VectorXd profile_gap(const PatchGrid &grid, const double R1, const double R2, const Eigen::VectorXd &drop)
{
  const auto sagitta = [](const double R, const double x) { return x * x / (R + std::sqrt(R * R - x * x)); };
  Eigen::VectorXd gap(grid.n_x * grid.n_z);
  for (int k = 0; k < grid.n_z; ++k)
    for (int i = 0; i < grid.n_x; ++i)
      gap[k * grid.n_x + i] = sagitta(R1, grid.x[i]) + sagitta(R2, grid.x[i]) + drop[k];
  return gap.array() - gap.minCoeff();
}

ContactPair make_pair(const std::string &name, const CondensedRoll &first, const HeldRoll &a,
                      const CondensedRoll &second, const HeldRoll &b, const Eigen::VectorXd &drop)
{
  if (a.grid.n_x != b.grid.n_x || a.grid.n_z != b.grid.n_z)
    throw std::logic_error("the two rolls of contact " + name + " have different patch grids");
  ContactPair pair;
  pair.name                = name;
  pair.grid                = a.grid;
  pair.drop                = drop;
  pair.radii_sum           = first.geometry.radius + second.geometry.radius;
  const int n              = a.grid.n_x * a.grid.n_z;
  const double length      = a.grid.z[a.grid.n_z - 1];
  const bool slab          = first.antisymmetric.patch.size() == 0;
  pair.problem.C           = a.flexibility + b.flexibility;
  pair.problem.W           = a.support + b.support;
  pair.problem.initial_gap = profile_gap(a.grid, first.geometry.radius, second.geometry.radius, drop);
  pair.problem.G           = Eigen::MatrixXd::Ones(n, a.grid.whole ? 2 : 1);
  if (slab) {
    pair.multiplicity = 2 / length;  // a slab has no mirror in z: loads per metre of length
    pair.axis         = Eigen::MatrixXd::Zero(1, n);
    pair.axis_support = Eigen::MatrixXd::Zero(1, 1);
    pair.mean         = Eigen::MatrixXd::Ones(1, 1);
    pair.path         = axial_weights(a.grid.z, length, a.grid.degree);
    return pair;
  }
  // Both axes have the stations of the patch; what lies beyond the contact does not count.
  pair.axis         = patch_rows(a.axis, a.grid) + patch_rows(b.axis, b.grid);
  pair.axis_support = patch_rows(a.axis_support, a.grid) + patch_rows(b.axis_support, b.grid);
  pair.path         = axial_weights(a.grid.z, length, a.grid.degree);
  drive_whole(pair);
  return pair;
}

namespace {
// Stations as a line along z, the body on its left.
Surface station_line(const PatchGrid &grid, const double shift, const bool forward)
{
  Surface line;
  const int n = grid.n_z, per_face = grid.degree + 1;
  line.points = Eigen::MatrixXd::Zero(n, 2);
  for (int k = 0; k < n; ++k) {
    line.points(k, 0) = grid.z[k] + shift;
    line.node.push_back(k);
  }
  line.faces.resize((n - 1) / grid.degree, per_face);
  for (int f = 0; f < line.faces.rows(); ++f)
    for (int i = 0; i < per_face; ++i)
      line.faces(f, i) = f * grid.degree + (forward ? i : per_face - 1 - i);
  return line;
}

// (T x 1) A for a matrix whose rows run over stations and, within, over `width` nodes.
Eigen::MatrixXd along_stations(const contact::Coupling::Sparse &T, const Eigen::MatrixXd &A, const int width)
{
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(T.rows() * width, A.cols());
  for (int j = 0; j < T.outerSize(); ++j)
    for (contact::Coupling::Sparse::InnerIterator it(T, j); it; ++it)
      out.middleRows(j * width, width) += it.value() * A.middleRows(it.col() * width, width);
  return out;
}

Eigen::MatrixXd congruent(const contact::Coupling::Sparse &T, const Eigen::MatrixXd &C, const int width)
{
  return along_stations(T, along_stations(T, C, width).transpose(), width);
}
}  // namespace

ContactPair make_pair(const std::string &name, const CondensedRoll &first, const HeldRoll &a,
                      const CondensedRoll &second, const HeldRoll &b, const std::function<double(double)> &drop,
                      const double shift)
{
  if (!a.grid.whole || !b.grid.whole || a.grid.n_x != b.grid.n_x)
    throw std::logic_error("shifted rolls of contact " + name + " must both be whole, with the same nodes across");
  contact::CouplingOptions options;
  options.reach   = 1e-3 * first.geometry.radius;
  const auto link = contact::couple(station_line(a.grid, 0, true), station_line(b.grid, shift, false), options);
  const int n_x = a.grid.n_x, n_z = int(link.node.size());
  ContactPair pair;
  pair.name      = name;
  pair.radii_sum = first.geometry.radius + second.geometry.radius;
  pair.path      = link.weight;
  pair.grid      = a.grid;
  pair.grid.n_z  = n_z;
  pair.grid.z.resize(n_z);
  pair.grid.area.resize(n_x * n_z);
  pair.drop.resize(n_z);
  const Eigen::VectorXd whole = axial_weights(a.grid.z, a.grid.z[a.grid.n_z - 1], a.grid.degree);
  Eigen::VectorXd profile(link.points.rows());
  for (Eigen::Index q = 0; q < profile.size(); ++q)
    profile[q] = drop(link.points(q, 0));
  for (int k = 0; k < n_z; ++k) {
    const int station = link.node[std::size_t(k)];
    pair.grid.z[k]    = a.grid.z[station];
    pair.grid.area.segment(k * n_x, n_x) =
        a.grid.area.segment(station * n_x, n_x) * link.weight[k] / whole[station];
    pair.drop[k] = drop(pair.grid.z[k]);
  }
  pair.problem.initial_gap =
      profile_gap(pair.grid, first.geometry.radius, second.geometry.radius, link.mean * profile);
  pair.problem.C = congruent(link.slave, a.flexibility, n_x) + congruent(link.master, b.flexibility, n_x);
  // Moments of the second roll count about its own mid-length.
  Eigen::Matrix2d moved;
  moved << 1, 0, -shift, 1;
  pair.problem.W =
      along_stations(link.slave, a.support, n_x) + along_stations(link.master, b.support * moved, n_x);
  // Multipliers act on each roll by the transposed coupling, and its axis is read at the stations of the pair.
  const auto axis_of = [&](const contact::Coupling::Sparse &T, const Eigen::MatrixXd &axis) {
    return along_stations(T, along_stations(T, axis.transpose(), n_x).transpose(), 1);
  };
  pair.axis = axis_of(link.slave, patch_rows(a.axis, a.grid)) + axis_of(link.master, patch_rows(b.axis, b.grid));
  pair.axis_support = along_stations(link.slave, patch_rows(a.axis_support, a.grid), 1) +
                      along_stations(link.master, patch_rows(b.axis_support, b.grid) * moved, 1);
  pair.transfer  = link.master;
  pair.problem.G = Eigen::MatrixXd::Ones(n_x * n_z, 2);
  drive_whole(pair);
  return pair;
}

void bend(ContactPair &pair, const HeldRoll &roll, const double right, const double left)
{
  // Forces of the model are those on x >= 0, of a quarter also on z >= 0.
  Eigen::VectorXd forces(roll.bend.cols());
  if (pair.grid.whole)
    forces << 0.5 * right, 0.5 * left;
  else
    forces << 0.25 * (right + left);
  const bool shifted    = pair.transfer.size() > 0;
  Eigen::VectorXd patch = roll.bend * forces;
  Eigen::VectorXd axis  = patch_rows(roll.axis_bend, roll.grid) * forces;
  if (shifted) {
    patch = along_stations(pair.transfer, patch, pair.grid.n_x);
    axis  = along_stations(pair.transfer, axis, 1);
  }
  // Approach and tilt are those of the bent axes: their mean motion belongs to the frames, not to the gap.
  const Eigen::VectorXd motion = pair.mean.transpose() * axis;
  pair.problem.initial_gap += patch - pair.problem.G * motion;
  pair.problem.initial_gap.array() -= pair.problem.initial_gap.minCoeff();
}

void change_profiles(ContactPair &pair, const Eigen::VectorXd &drop)
{
  const Eigen::VectorXd change = drop - pair.drop;
  for (int k = 0; k < pair.grid.n_z; ++k)
    pair.problem.initial_gap.segment(k * pair.grid.n_x, pair.grid.n_x).array() += change[k];
  pair.problem.initial_gap.array() -= pair.problem.initial_gap.minCoeff();
  pair.drop   = drop;
  pair.solved = std::make_shared<SolvedLoads>();
}

namespace {
struct Axes {
  Eigen::VectorXd motion;      // (k) mean approach and tilt of the axes
  Eigen::MatrixXd compliance;  // (k, k) by resultants of the model
};

Axes axes_of(const ContactPair &pair, const contact::State &s)
{
  Axes axes;
  axes.motion     = s.motion - pair.mean.transpose() * axis_motion(pair, s.nodal, s.resultant);
  axes.compliance = s.compliance - pair.mean.transpose() * (pair.axis * s.d_nodal + pair.axis_support);
  return axes;
}

// The whole with a tilt of the axes: the moment that produces it.  The tilt grows with the moment, so the root of
// a monotone piecewise linear function: Newton's method inside a bracket.
contact::State solve_tilted(const ContactPair &pair, contact::ActiveSet &solver, const double force,
                            const std::vector<char> &start)
{
  contact::Loading loading{Eigen::Vector2d(force, 0), {0, 0}};
  if (pair.axis.isZero(0) && pair.axis_support.isZero(0)) {
    loading.value[1]   = pair.tilt;
    loading.prescribed = {0, 1};
    return solver.solve(loading, start);
  }
  const Eigen::VectorXd &z = pair.grid.z;
  double low               = force * z[0] * (1 - 1e-6),
         high              = force * z[z.size() - 1] * (1 - 1e-6);  // line of action on the contact
  contact::State s         = solver.solve(loading, start);
  const double reach       = z.cwiseAbs().maxCoeff();
  for (int step = 0; step < 100; ++step) {
    const Axes axes    = axes_of(pair, s);
    const double error = pair.tilt - axes.motion[1];
    const double scale = std::abs(axes.motion[0]) + std::abs(pair.tilt) * reach;
    if (std::abs(error) * reach <= 1e-13 * scale || high - low <= 1e-14 * force * reach)
      return s;
    (error > 0 ? low : high) = loading.value[1];
    const double newton      = loading.value[1] + error / axes.compliance(1, 1);
    loading.value[1]         = newton > low && newton < high ? newton : 0.5 * (low + high);
    s                        = solver.solve(loading, s.active);
  }
  throw SolverError({"contact " + pair.name + ": no moment gives the tilt asked for", "after 100 steps",
                     "a tilt that stands the rolls on their edge", "lower contact." + pair.name + ".tilt", ""});
}

// Gap of the undeformed rolls at the stations, on the contact line.
Eigen::VectorXd gap_along(const ContactPair &pair)
{
  Eigen::VectorXd gap(pair.grid.n_z);
  for (int k = 0; k < pair.grid.n_z; ++k)
    gap[k] = pair.problem.initial_gap[k * pair.grid.n_x];
  return gap;
}

// Largest approach without contact, at the place where approach is counted.
double approach_at_touch(const ContactPair &pair)
{
  return pair.grid.whole ? touching_approach(pair.grid.z, gap_along(pair), pair.tilt, pair.load_offset) : 0;
}

ContactPoint solve_with(const ContactPair &pair, contact::ActiveSet &solver, const double load,
                        const std::vector<char> &start)
{
  ContactPoint point;
  const double force = load / pair.multiplicity;
  point.load         = load;
  const bool whole = pair.grid.whole, offset = !std::isnan(pair.load_offset);
  if (!whole)
    point.state = solver.solve({Eigen::VectorXd::Constant(1, force), {}}, start);
  else if (offset)
    point.state = solver.solve({Eigen::Vector2d(force, force * pair.load_offset), {}}, start);
  else
    point.state = solve_tilted(pair, solver, force, start);
  const Axes axes = axes_of(pair, point.state);
  // Under a force off the middle the approach is that of the place where it acts, so that force times approach is
  // work.
  point.approach =
      axes.motion[0] + (whole && offset ? pair.load_offset * axes.motion[1] : 0) - approach_at_touch(pair);
  point.compliance = axes.compliance / pair.multiplicity;
  if (whole) {
    point.tilt   = axes.motion[1];
    point.moment = pair.multiplicity * point.state.resultant[1];
  }
  const auto &c = point.compliance;
  if (!whole)
    point.tangent = 1 / c(0, 0);
  else if (offset)
    point.tangent =
        1 / (c(0, 0) + (c(0, 1) + c(1, 0)) * pair.load_offset + c(1, 1) * std::pow(pair.load_offset, 2));
  else
    point.tangent = c(1, 1) / (c(0, 0) * c(1, 1) - c(0, 1) * c(1, 0));
  return point;
}

// d(state)/d(force) with what else is imposed held: change of the resultants per newton of the model.
Eigen::VectorXd along_the_load(const ContactPair &pair, const ContactPoint &point)
{
  if (!pair.grid.whole)
    return Eigen::VectorXd::Ones(1);
  if (!std::isnan(pair.load_offset))
    return Eigen::Vector2d(1, pair.load_offset);
  return Eigen::Vector2d(1, -point.compliance(1, 0) / point.compliance(1, 1));
}
}  // namespace

const ContactPair &complete(const ContactPair &pair)
{
  return pair.completed ? pair.completed() : pair;
}

ContactPoint solve_load(const ContactPair &pair, const double load, const std::vector<char> &start)
{
  const auto solve = [&] {
    const ContactPair &whole = complete(pair);
    contact::ActiveSet solver(whole.problem);
    return solve_with(whole, solver, load, start);
  };
  return pair.solved && start.empty() ? pair.solved->point(load, solve) : solve();
}

ContactCurve sweep(const ContactPair &contact_pair, const Eigen::VectorXd &loads, const Progress &progress)
{
  const ContactPair &pair = complete(contact_pair);
  const Eigen::Index n    = loads.size();
  ContactCurve curve;
  curve.name      = pair.name;
  curve.reference = pair.reference;
  curve.load      = loads;
  for (Eigen::VectorXd *column :
       {&curve.approach, &curve.half_width, &curve.peak_pressure, &curve.tangent, &curve.secant})
    column->resize(n);
  curve.iterations.resize(n);
  const int middle = middle_station(pair.grid);
  contact::ActiveSet solver(pair.problem);
  std::vector<char> active;
  for (Eigen::Index i = 0; i < n; ++i) {
    ContactPoint point;
    try {
      point = solve_with(pair, solver, loads[i], active);
    } catch (const SolverError &e) {
      auto report = e.report;
      report.what = "contact " + pair.name + ": no convergence at load step " + std::to_string(i + 1) + " of " +
                    std::to_string(n) + " (F = " + std::to_string(loads[i] / 1e3) + " kN)";
      report.kept = std::to_string(i) + " converged steps";
      throw SolverError(report);
    }
    active                       = point.state.active;
    const ContactSection section = fit_section(pair.grid, point.state, middle);
    curve.approach[i]            = point.approach;
    curve.tangent[i]             = point.tangent;
    curve.secant[i]              = loads[i] / point.approach;
    curve.half_width[i]          = section.half_width;
    curve.peak_pressure[i]       = section.peak;
    curve.iterations[i]          = point.state.iterations;
    curve.residual               = std::max(curve.residual, point.state.residual);
    progress.at("contact " + pair.name, double(i + 1) / double(n));
  }
  return curve;
}

int middle_station(const PatchGrid &grid)
{
  if (!grid.whole)
    return 0;
  Eigen::Index middle;
  (grid.z.array() - 0.5 * (grid.z[0] + grid.z[grid.n_z - 1])).abs().minCoeff(&middle);
  return int(middle);
}

BarrelProfile barrel_profile(const ContactPair &pair, const ContactPoint &point)
{
  const PatchGrid &grid          = pair.grid;
  const Eigen::VectorXd &w       = pair.path;
  const Eigen::VectorXd along    = along_the_load(pair, point);
  const Eigen::VectorXd d_nodal  = point.state.d_nodal * along;
  const Eigen::VectorXd d_motion = point.state.compliance * along;
  const Eigen::VectorXd away     = axis_motion(pair, point.state.nodal, point.state.resultant),
                        d_away   = axis_motion(pair, d_nodal, along);
  const auto value_at            = [](const Eigen::VectorXd &v, const int k) {
    return v.size() > k ? v[k] : 0;
  };  // a slab has one
  BarrelProfile out;
  out.load = point.load;
  out.z    = grid.z;
  for (Eigen::VectorXd *column :
       {&out.line_load, &out.approach, &out.tangent, &out.half_width, &out.peak_pressure})
    column->resize(grid.n_z);
  for (int k = 0; k < grid.n_z; ++k) {
    const auto row               = Eigen::seqN(k * grid.n_x, grid.n_x);
    const ContactSection section = fit_section(grid, point.state, k);
    const double tilt            = grid.whole ? point.state.motion[1] * grid.z[k] : 0;
    const double turn            = grid.whole ? d_motion[1] * grid.z[k] : 0;
    out.line_load[k]             = pair.axial_mirror * point.state.nodal(row).sum() / w[k];
    out.approach[k]              = point.state.motion[0] + tilt - value_at(away, k);
    out.tangent[k]    = pair.axial_mirror * d_nodal(row).sum() / w[k] / (d_motion[0] + turn - value_at(d_away, k));
    out.half_width[k] = section.half_width;
    out.peak_pressure[k] = section.peak;
  }
  return out;
}

double touching_approach(const Eigen::VectorXd &z, const Eigen::VectorXd &gap, const double tilt,
                         const double offset)
{
  if (std::isnan(offset))
    return (gap - tilt * z).minCoeff();
  // Free to tilt: the rolls come to rest on the lower convex hull of the gap.
  double hull = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < z.size() && z[i] <= offset; ++i)
    for (Eigen::Index j = z.size() - 1; j >= 0 && z[j] >= offset; --j) {
      const double t = j == i ? 0 : (offset - z[i]) / (z[j] - z[i]);
      hull           = std::min(hull, gap[i] + t * (gap[j] - gap[i]));
    }
  return hull;
}

Eigen::VectorXd log_spaced(const double low, const double high, const int n)
{
  Eigen::VectorXd loads(n);
  for (int i = 0; i < n; ++i)
    loads[i] = low * std::pow(high / low, double(i) / (n - 1));
  loads[n - 1] = high;
  return loads;
}
}  // namespace mill::fem
