#include "reduce/chain/roll_body.h"
#include "core/base/errors.h"
#include "core/base/short_number.h"
#include "core/numerics/gauss.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace mill::reduce {
namespace {
BeamSection scaled(BeamSection section, const double factor)
{
  section.bending *= factor;
  section.shear *= factor;
  return section;
}

/// P_0, P_2, .., P_2(n-1) at x.
Eigen::RowVectorXd even_legendre(const int n, const double x)
{
  Eigen::RowVectorXd value(n);
  double before = 0, now = 1;  // P_k-1, P_k
  for (int k = 0; k < 2 * n - 1; ++k) {
    if (k % 2 == 0)
      value[k / 2] = now;
    const double next = ((2 * k + 1) * x * now - k * before) / (k + 1);
    before            = now;
    now               = next;
  }
  return value;
}

/// Piece of [nodes[i], nodes[i + 1]] that x lies in; the last one at and beyond the end.
Eigen::Index piece_of(const Eigen::VectorXd &nodes, const double x)
{
  const auto above = std::upper_bound(nodes.begin(), nodes.end(), x) - nodes.begin();
  return std::clamp<Eigen::Index>(above - 1, 0, nodes.size() - 2);
}

std::string size_text(const Eigen::MatrixXd &m)
{
  return std::to_string(m.rows()) + " x " + std::to_string(m.cols());
}

void require_roll(const std::string &name, const Roll &r)
{
  const double h = r.barrel_length / 2, a = r.bearing_span / 2, end = h + r.neck_length;
  if (!(r.barrel_diameter > 0 && r.barrel_length > 0 && r.neck_diameter > 0 && r.neck_length > 0))
    throw InputError(name + ": barrel " + short_number(r.barrel_diameter) + " x " + short_number(r.barrel_length) +
                     " m, neck " + short_number(r.neck_diameter) + " x " + short_number(r.neck_length) +
                     " m: every dimension must be positive");
  if (!(a > h && a <= end * (1 + 1e-9)))
    throw InputError(name + ": bearing span " + short_number(r.bearing_span) +
                     " m; the bearing centres must lie on the necks, between " + short_number(r.barrel_length) +
                     " m (barrel length) and " + short_number(2 * end) + " m (length of the roll)");
}
}  // namespace

RollBody beam_roll(const std::string &name, const Roll &roll, const Material &steel, const int elements,
                   const double common_half_barrel, const double scale)
{
  require_roll(name, roll);
  const double h = roll.barrel_length / 2, a = roll.bearing_span / 2, end = h + roll.neck_length;
  const BeamSection barrel = scaled(beam_section(barrel_section(roll), steel), scale),
                    neck   = scaled(beam_section(neck_section(roll), steel), scale);
  const double barrel_mass = mass_per_length(barrel_section(roll), steel),
               neck_mass   = mass_per_length(neck_section(roll), steel);
  const double negligible  = 1e-9 * end;
  std::vector<BeamSpan> spans;
  const double common = h - common_half_barrel > negligible ? common_half_barrel : h;
  spans.push_back({common, elements, barrel, barrel_mass});
  if (common < h)
    spans.push_back(
        {h - common, std::max(2, int(std::ceil(elements * (h - common) / common))), barrel, barrel_mass});
  spans.push_back({a - h, elements, neck, neck_mass});
  const Eigen::Index seat_node = Eigen::Index(spans[0].elements) + (common < h ? spans[1].elements : 0) + elements;
  if (end - a > negligible)
    spans.push_back({end - a, elements, neck, neck_mass});

  const SymmetricBeam beam = symmetric_beam(spans);
  const Eigen::Index n     = beam.z.size();
  RollBody body;
  body.name        = name;
  body.M           = beam.mass.asDiagonal();
  body.K           = beam.K;
  body.half_barrel = h;
  body.nodes = body.axis_z = beam.z;
  body.seat                = Eigen::VectorXd::Unit(n, seat_node);
  body.axis                = Eigen::MatrixXd::Identity(n, n);
  for (const double z : beam.z)
    body.unknowns.push_back({"node", z, "m"});
  return body;
}

std::vector<StandUnknown> component_unknowns(const Component &component)
{
  std::vector<StandUnknown> unknowns;
  for (const std::string &displacement : component.interface)
    unknowns.push_back({displacement, std::numeric_limits<double>::quiet_NaN(), "m"});
  for (Eigen::Index i = component.n_interface(); i < component.M.rows(); ++i)
    unknowns.push_back({"fixed-interface mode " + std::to_string(i - component.n_interface() + 1),
                        std::numeric_limits<double>::quiet_NaN(), "kg^0.5 m"});
  return unknowns;
}

RollBody component_roll(const std::string &name, const Component &component)
{
  const Eigen::Index n = component.M.rows(), n_i = component.n_interface();
  const auto seat = std::find(component.interface.begin(), component.interface.end(), "seat");
  if (component.n_barrel < 1 || !(component.half_barrel > 0) || seat == component.interface.end())
    throw InputError("component \"" + component.name + "\" cannot be the " + name +
                     ": it needs barrel functions and an interface displacement \"seat\"");
  if (component.M.cols() != n || component.K.rows() != n || component.K.cols() != n ||
      component.axis.cols() != n || component.axis.rows() != component.axis_z.size() ||
      component.axis_z.size() < 2 || n_i > n)
    throw InputError("component \"" + component.name + "\": matrices of unlike size (" + std::to_string(n_i) +
                     " interface displacements, M " + size_text(component.M) + ", K " + size_text(component.K) +
                     ", axis " + size_text(component.axis) + " at " + std::to_string(component.axis_z.size()) +
                     " stations)");
  RollBody body;
  body.name        = name;
  body.M           = component.M;
  body.K           = component.K;
  body.half_barrel = component.half_barrel;
  body.n_barrel    = component.n_barrel;
  body.seat        = Eigen::VectorXd::Unit(n, seat - component.interface.begin());
  body.axis_z      = component.axis_z;
  body.axis        = component.axis;
  body.unknowns    = component_unknowns(component);
  if (component.residual.rows() == n_i) {
    body.residual                         = Eigen::MatrixXd::Zero(n, n);
    body.residual.topLeftCorner(n_i, n_i) = component.residual;
  }
  return body;
}

Eigen::MatrixXd barrel_rows(const RollBody &roll, const Eigen::VectorXd &z)
{
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(z.size(), roll.M.rows());
  for (Eigen::Index i = 0; i < z.size(); ++i)
    if (roll.n_barrel > 0)
      rows.row(i).head(roll.n_barrel) = even_legendre(roll.n_barrel, z[i] / roll.half_barrel);
    else
      rows.row(i) = axis_row(roll, z[i]);
  return rows;
}

Eigen::VectorXd axis_row(const RollBody &roll, const double z)
{
  const Eigen::Index i = piece_of(roll.axis_z, z);
  const double t       = (z - roll.axis_z[i]) / (roll.axis_z[i + 1] - roll.axis_z[i]);
  return (1 - t) * roll.axis.row(i) + t * roll.axis.row(i + 1);
}

LinePoints line_points(const RollBody &a, const RollBody &b, const double half_length)
{
  LinePoints points;
  if (a.n_barrel == 0 && b.n_barrel == 0) {
    // Integral of each hat function over 0..half_length, which may end inside an element.
    const Eigen::VectorXd &node = a.nodes;
    Eigen::VectorXd share       = Eigen::VectorXd::Zero(node.size());
    Eigen::Index last           = 0;
    for (Eigen::Index i = 0; i + 1 < node.size() && node[i] < half_length * (1 - 1e-12); ++i) {
      const double l = node[i + 1] - node[i], t = std::min(1., (half_length - node[i]) / l);
      share[i] += l * (t - t * t / 2);
      share[i + 1] += l * t * t / 2;
      last = i + 1;
    }
    points.z     = node.head(last + 1);
    points.share = share.head(last + 1) / half_length;
    return points;
  }
  // Products of two barrel functions have degree 4 (n - 1) at most: 2 n points are exact.
  const GaussRule rule = gauss_legendre(2 * std::max(a.n_barrel, b.n_barrel));
  points.z             = half_length / 2 * (1 + rule.node.array());
  points.share         = rule.weight / 2;
  return points;
}
}  // namespace mill::reduce
