#include "fem/contact_study.h"
#include "core/errors.h"
#include <cmath>

namespace mill::fem {
namespace {
// Half width and peak of one station, from p^2 = p0^2 (1 - x^2 / b^2) through its active nodes: finer than the
// grid.
struct Section {
  double half_width = 0, peak = 0;
};
Section fit_section(const CondensedRoll &grid, const ContactState &state, const int station)
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
  return slope < 0 && top > 0 ? Section{std::sqrt(-top / slope), std::sqrt(top)} : Section{next, highest};
}

Eigen::VectorXd axis_motion(const ContactPair &pair, const Eigen::VectorXd &nodal, const double force)
{
  return pair.axis * nodal + force * pair.axis_support;
}
}  // namespace

Eigen::VectorXd profile_gap(const CondensedRoll &grid, const double R1, const double R2,
                            const Eigen::VectorXd &drop)
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
  if (first.n_x != second.n_x || first.n_z != second.n_z)
    throw std::logic_error("the two rolls of contact " + name + " have different patch grids");
  ContactPair pair;
  pair.name                = name;
  pair.grid                = &first;
  pair.problem.C           = a.flexibility + b.flexibility;
  pair.problem.support     = a.support + b.support;
  pair.problem.initial_gap = profile_gap(first, first.geometry.radius, second.geometry.radius, drop);
  const double length      = first.z[first.n_z - 1];
  if (first.translate.size() == 0) {
    pair.multiplicity = 2 / length;  // a slab has no mirror in z: loads per metre of length
    pair.axis         = Eigen::MatrixXd::Zero(1, pair.problem.C.rows());
    pair.axis_support = Eigen::VectorXd::Zero(1);
    pair.mean         = Eigen::VectorXd::Ones(1);
  } else {
    // Both axes have the stations of the patch; what lies beyond the contact does not count.
    pair.axis         = a.axis.topRows(first.n_z) + b.axis.topRows(first.n_z);
    pair.axis_support = a.axis_support.head(first.n_z) + b.axis_support.head(first.n_z);
    pair.mean         = axial_weights(first.z, length, first.degree) / length;
  }
  return pair;
}

ContactPoint solve_load(const ContactPair &pair, const double load, const std::vector<char> &start)
{
  ContactPoint point;
  const double force = load / pair.multiplicity;
  point.load         = load;
  point.state        = solve_contact(pair.problem, force, start);
  point.approach     = point.state.q - pair.mean.dot(axis_motion(pair, point.state.nodal, force));
  const double slope = point.state.d_q - pair.mean.dot(axis_motion(pair, point.state.d_nodal, 1));
  point.tangent      = pair.multiplicity / slope;
  return point;
}

ContactCurve sweep(const ContactPair &pair, const Eigen::VectorXd &loads, const Progress &progress)
{
  const Eigen::Index n = loads.size();
  ContactCurve curve;
  curve.name      = pair.name;
  curve.reference = pair.reference;
  curve.load      = loads;
  for (Eigen::VectorXd *column :
       {&curve.approach, &curve.half_width, &curve.peak_pressure, &curve.tangent, &curve.secant})
    column->resize(n);
  curve.iterations.resize(n);
  std::vector<char> active;
  for (Eigen::Index i = 0; i < n; ++i) {
    ContactPoint point;
    try {
      point = solve_load(pair, loads[i], active);
    } catch (const SolverError &e) {
      auto report = e.report;
      report.what = "contact " + pair.name + ": no convergence at load step " + std::to_string(i + 1) + " of " +
                    std::to_string(n) + " (F = " + std::to_string(loads[i] / 1e3) + " kN)";
      report.kept = std::to_string(i) + " converged steps";
      throw SolverError(report);
    }
    active                 = point.state.active;
    const Section section  = fit_section(*pair.grid, point.state, 0);
    curve.approach[i]      = point.approach;
    curve.tangent[i]       = point.tangent;
    curve.secant[i]        = loads[i] / point.approach;
    curve.half_width[i]    = section.half_width;
    curve.peak_pressure[i] = section.peak;
    curve.iterations[i]    = point.state.iterations;
    curve.residual         = std::max(curve.residual, point.state.residual);
    progress.at("contact " + pair.name, double(i + 1) / double(n));
  }
  return curve;
}

BarrelProfile barrel_profile(const ContactPair &pair, const ContactPoint &point)
{
  const CondensedRoll &grid    = *pair.grid;
  const double force           = point.load / pair.multiplicity;
  const Eigen::VectorXd w      = axial_weights(grid.z, grid.z[grid.n_z - 1], grid.degree);
  const Eigen::VectorXd away   = axis_motion(pair, point.state.nodal, force);
  const Eigen::VectorXd d_away = axis_motion(pair, point.state.d_nodal, 1);
  BarrelProfile out;
  out.load = point.load;
  out.z    = grid.z;
  for (Eigen::VectorXd *column :
       {&out.line_load, &out.approach, &out.tangent, &out.half_width, &out.peak_pressure})
    column->resize(grid.n_z);
  for (int k = 0; k < grid.n_z; ++k) {
    const auto row        = Eigen::seqN(k * grid.n_x, grid.n_x);
    const Section section = fit_section(grid, point.state, k);
    const double motion   = away.size() == grid.n_z ? away[k] : 0;
    const double d_motion = d_away.size() == grid.n_z ? d_away[k] : 0;
    out.line_load[k]      = pair.axial_mirror * point.state.nodal(row).sum() / w[k];
    out.approach[k]       = point.state.q - motion;
    out.tangent[k]    = pair.axial_mirror * point.state.d_nodal(row).sum() / w[k] / (point.state.d_q - d_motion);
    out.half_width[k] = section.half_width;
    out.peak_pressure[k] = section.peak;
  }
  return out;
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
