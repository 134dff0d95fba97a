#include "fem/strip/bite_roll.h"
#include "core/base/errors.h"
#include "core/numerics/gauss.h"
#include "fem/body/free_unknowns.h"
#include "fem/body/section_body.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <sstream>

namespace mill::fem {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// A point of the quarter circle as its face sees it.
struct OnFace {
  Index face;
  double s;  // -1..1
};

// The quarter circle of the mesh, by angle from the contact line.
class Rim {
public:
  Rim(const SectionBody &body, const double roll_radius)
      : surface(body.surface("surface")), radius(roll_radius), unknowns(body.stiffness().rows())
  {
    for (Index f = 0; f < surface.faces.rows(); ++f) {
      const double a = angle(surface.faces(f, 0)), b = angle(surface.faces(f, 2));
      ends.push_back({a, b});
    }
  }
  double angle(const int point) const
  {
    return std::atan2(surface.points(point, 0), surface.points(point, 1));
  }
  Index n_faces() const
  {
    return surface.faces.rows();
  }
  double low(const Index f) const
  {
    return std::min(ends[std::size_t(f)][0], ends[std::size_t(f)][1]);
  }
  double high(const Index f) const
  {
    return std::max(ends[std::size_t(f)][0], ends[std::size_t(f)][1]);
  }
  // Shape functions of the face at an angle.
  std::array<double, 3> shape(const Index f, const double phi) const
  {
    const auto &[a, b] = ends[std::size_t(f)];
    const double s     = (2 * phi - a - b) / (b - a);
    return {0.5 * s * (s - 1), (1 - s) * (1 + s), 0.5 * s * (s + 1)};
  }
  int node(const Index f, const int k) const
  {
    return surface.node[std::size_t(surface.faces(f, k))];
  }
  Index face_of(const double phi) const
  {
    for (Index f = 0; f < n_faces(); ++f)
      if (phi >= low(f) - 1e-12 && phi <= high(f) + 1e-12)
        return f;
    throw InputError("roll in the bite: a point lies outside the mesh");
  }
  // Nodal forces of a radial pressure (inwards) and of a shear stress along +x, both functions of the angle given
  // with the angles where they have kinks.
  struct Traction {
    std::function<double(double phi)> pressure, shear;
    std::vector<double> kinks;
  };
  VectorXd load(const Traction &t) const
  {
    static const GaussRule rule = gauss_legendre(5);
    VectorXd out                = VectorXd::Zero(unknowns);
    for (Index f = 0; f < n_faces(); ++f) {
      std::vector<double> cut{low(f)};
      for (const double k : t.kinks)
        if (k > low(f) + 1e-14 && k < high(f) - 1e-14)
          cut.push_back(k);
      cut.push_back(high(f));
      std::sort(cut.begin(), cut.end());
      if (!t.kinks.empty() && (cut.back() < *std::min_element(t.kinks.begin(), t.kinks.end()) ||
                               cut.front() > *std::max_element(t.kinks.begin(), t.kinks.end())))
        continue;
      for (std::size_t c = 0; c + 1 < cut.size(); ++c)
        for (Index q = 0; q < rule.node.size(); ++q) {
          const double half = 0.5 * (cut[c + 1] - cut[c]), phi = 0.5 * (cut[c] + cut[c + 1]) + half * rule.node[q];
          const double ds = radius * half * rule.weight[q], sine = std::sin(phi), cosine = std::cos(phi);
          const double p = t.pressure ? t.pressure(phi) : 0, tau = t.shear ? t.shear(phi) : 0;
          const auto N = shape(f, phi);
          for (int k = 0; k < 3; ++k) {
            out[2 * node(f, k)] += N[k] * ds * (-p * sine + tau * cosine);
            out[2 * node(f, k) + 1] += N[k] * ds * (-p * cosine - tau * sine);
          }
        }
    }
    return out;
  }
  // (unknowns) that read the displacement towards the axis at an angle.
  Eigen::RowVectorXd reading(const MatrixXd &field, const double phi) const
  {
    const Index f          = face_of(phi);
    const auto N           = shape(f, phi);
    Eigen::RowVectorXd out = Eigen::RowVectorXd::Zero(field.cols());
    for (int k = 0; k < 3; ++k)
      out -= N[k] * (std::sin(phi) * field.row(2 * node(f, k)) + std::cos(phi) * field.row(2 * node(f, k) + 1));
    return out;
  }

private:
  Surface surface;
  double radius;
  Index unknowns;
  std::vector<std::array<double, 2>> ends;  // angles of the first and last node of each face
};

// Unit forces spread over the section.
struct Spread {
  VectorXd x, y;    // (unknowns) uniform, sum 1
  VectorXd moment;  // tangential, growing with the radius, unit moment (counter-clockwise)
};
Spread spread_forces(const SectionBody &body)
{
  const Index n = body.stiffness().rows();
  Spread out{VectorXd::Zero(n), VectorXd::Zero(n), VectorXd::Zero(n)};
  // Shape functions of a nine-node cell integrate to these shares of it: corners, edges, middle.
  const auto share = [](const std::size_t k) { return k < 4 ? 1. / 36 : k < 8 ? 1. / 9 : 4. / 9; };
  body.each_cell([&](const std::vector<int> &nodes, const std::vector<CellPoint> &points) {
    double area = 0;
    for (const CellPoint &p : points)
      area += p.weight;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const int node = nodes[k];
      out.x[2 * node] += share(k) * area;
      out.y[2 * node + 1] += share(k) * area;
      out.moment[2 * node] -= share(k) * area * body.nodes()(node, 1);
      out.moment[2 * node + 1] += share(k) * area * body.nodes()(node, 0);
    }
  });
  out.x /= out.x.sum();
  out.y /= out.y.sum();
  double moment = 0;
  for (Index i = 0; i < body.nodes().rows(); ++i)
    moment += body.nodes()(i, 0) * out.moment[2 * i + 1] - body.nodes()(i, 1) * out.moment[2 * i];
  out.moment /= moment;
  return out;
}

int node_at(const SectionBody &body, const double x, const double y)
{
  Index best = 0;
  (body.nodes().rowwise() - Eigen::RowVector2d(x, y)).rowwise().squaredNorm().minCoeff(&best);
  return int(best);
}

// The quarter under one symmetry case: even or odd in x (the field mirrored at the line of centres) and in y.
class QuarterCase {
public:
  QuarterCase(const SectionBody &body, const double radius, const bool even_x, const bool even_y)
      : free(held_out(body, radius, even_x, even_y)), factor(free.K, free.node, {})
  {
  }
  MatrixXd displacement(const MatrixXd &load) const
  {
    MatrixXd b(Index(free.unknown.size()), load.cols());
    for (Index i = 0; i < b.rows(); ++i)
      b.row(i) = load.row(free.unknown[std::size_t(i)]);
    const MatrixXd u = factor.solve(b);
    MatrixXd out     = MatrixXd::Zero(load.rows(), load.cols());
    for (Index i = 0; i < b.rows(); ++i)
      out.row(free.unknown[std::size_t(i)]) = u.row(i);
    return out;
  }
  int n_unknowns() const
  {
    return int(free.unknown.size());
  }

private:
  static FreeUnknowns held_out(const SectionBody &body, const double radius, const bool even_x, const bool even_y)
  {
    std::vector<char> held(std::size_t(body.stiffness().rows()), 0);
    for (const int node : body.group("symmetry.x"))
      held[std::size_t(2 * node + (even_x ? 0 : 1))] = 1;
    for (const int node : body.group("symmetry.y"))
      held[std::size_t(2 * node + (even_y ? 1 : 0))] = 1;
    // What rigid motion is left is stopped at one node; balanced loads leave nothing to carry there.
    if (even_x != even_y)
      held[std::size_t(2 * node_at(body, 0, 0) + (even_x ? 1 : 0))] = 1;
    if (!even_x && !even_y)
      held[std::size_t(2 * node_at(body, 0, radius))] = 1;
    FreeUnknowns out = free_unknowns(body.stiffness(), held);
    for (std::size_t i = 0; i < out.node.size(); ++i)
      out.node[i] = out.unknown[i] / 2;  // two unknowns per node here
    return out;
  }
  FreeUnknowns free;
  CondensingFactor factor;
};

// Sum of the x or y components of nodal forces.
VectorXd resultant(const MatrixXd &load, const int direction)
{
  VectorXd out = VectorXd::Zero(load.cols());
  for (Index i = direction; i < load.rows(); i += 2)
    out += load.row(i).transpose();
  return out;
}
VectorXd moment_of(const SectionBody &body, const MatrixXd &load)
{
  VectorXd out = VectorXd::Zero(load.cols());
  for (Index i = 0; i < body.nodes().rows(); ++i)
    out += (body.nodes()(i, 0) * load.row(2 * i + 1) - body.nodes()(i, 1) * load.row(2 * i)).transpose();
  return out;
}

class RollSection {
public:
  RollSection(const BiteRoll &r, const MeshFile &mesh)
      : roll(r), body(mesh, r.material, 2, Section::plane_strain, {{"surface", {0, 0}, r.radius}}),
        rim(body, r.radius), spread(spread_forces(body)), even_even(body, r.radius, true, true),
        even_odd(body, r.radius, true, false), odd_even(body, r.radius, false, true),
        odd_odd(body, r.radius, false, false), half(r.position.size() / 2), n_half(r.position.size() - half)
  {
    for (Index i = 0; i < n_half; ++i)
      angle.push_back(std::asin(std::max(0., r.position[half + i]) / r.radius));
    if (r.backup_half_width > 0) {
      const double edge = std::asin(r.backup_half_width / r.radius);
      const auto p = [edge](const double phi) { return std::sqrt(std::max(0., 1 - phi * phi / (edge * edge))); };
      backup       = rim.load({p, nullptr, {0, edge}});
      backup /= resultant(backup, 1)[0];
    }
  }

  // (n, n): displacement towards the axis by unit pressures (or friction stresses) at the points.
  MatrixXd influence(const bool by_shear) const
  {
    // Loads of the points x >= 0 on the quarter x > 0.  Of these only the point at 0 reaches over x = 0.
    MatrixXd load(body.stiffness().rows(), n_half);
    for (Index j = 0; j < n_half; ++j) {
      const Rim::Traction t = hat(j, by_shear);
      load.col(j)           = rim.load(t);
    }
    // A load at x and its image at -x: the even part takes half of each.  The point at 0 is its own image: its
    // load on the quarter is already half of it, and a friction stress along x there is wholly odd.
    MatrixXd even = 0.5 * load, odd = 0.5 * load;
    (by_shear ? odd : even).col(0) *= 2;
    (by_shear ? even : odd).col(0).setZero();
    const MatrixXd u_even = even_part(even), u_odd = odd_part(odd);
    const Index n = roll.position.size();
    MatrixXd out(n, n);
    // Mirrored load: the pressure gives the mirrored shape, the friction stress the mirrored shape with the sign
    // turned, since its image points along -x.
    const double sign = by_shear ? -1 : 1;
    for (Index j = 0; j < n_half; ++j)
      for (Index i = 0; i < n_half; ++i) {
        const double plus = u_even(i, j) + u_odd(i, j), minus = u_even(i, j) - u_odd(i, j);
        const Index right_i = half + i, left_i = n - 1 - right_i, right_j = half + j, left_j = n - 1 - right_j;
        out(right_i, right_j) = plus;
        out(left_i, right_j)  = minus;
        if (left_j != right_j) {  // the point at 0 is its own image
          out(left_i, left_j)  = sign * plus;
          out(right_i, left_j) = sign * minus;
        }
      }
    return out;
  }
  int n_unknowns() const
  {
    return std::max({even_even.n_unknowns(), even_odd.n_unknowns(), odd_even.n_unknowns(), odd_odd.n_unknowns()});
  }

private:
  // Hat of the point half + j over x, on the side x > 0.
  Rim::Traction hat(const Index j, const bool by_shear) const
  {
    const VectorXd &x = roll.position;
    const Index c = half + j, n = x.size();
    const double left = c > 0 ? x[c - 1] : x[c], right = c + 1 < n ? x[c + 1] : x[c], middle = x[c];
    const double R   = roll.radius;
    const auto value = [=](const double phi) {
      const double place = R * std::sin(phi);
      if (place <= left || place >= right)
        return 0.;
      return place < middle ? (place - left) / (middle - left) : (right - place) / (right - middle);
    };
    Rim::Traction t;
    (by_shear ? t.shear : t.pressure) = value;
    for (const double k : {left, middle, right})
      t.kinks.push_back(std::asin(std::max(0., k) / R));
    return t;
  }
  MatrixXd read(const MatrixXd &field) const
  {
    MatrixXd out(n_half, field.cols());
    for (Index i = 0; i < n_half; ++i)
      out.row(i) = rim.reading(field, angle[std::size_t(i)]);
    return out;
  }
  // Half of the load on this quarter and half on its image below, once with the same sign and once with the other,
  // add up to the load above alone; likewise for the back-up roll below.
  MatrixXd even_part(const MatrixXd &load) const
  {
    const Eigen::RowVectorXd vertical = resultant(load, 1).transpose();
    if (backup.size() == 0)
      return read(even_even.displacement(0.5 * load)) +
             read(even_odd.displacement(0.5 * (load - spread.y * vertical)));
    const MatrixXd below = backup * vertical;  // as it looks from above, turned upside down
    return read(even_even.displacement(0.5 * (load + below))) + read(even_odd.displacement(0.5 * (load - below)));
  }
  MatrixXd odd_part(const MatrixXd &load) const
  {
    const Eigen::RowVectorXd sideways = resultant(load, 0).transpose(), moment = moment_of(body, load).transpose();
    return read(odd_even.displacement(0.5 * (load - spread.x * sideways))) +
           read(odd_odd.displacement(0.5 * (load - spread.moment * moment)));
  }

  const BiteRoll &roll;
  SectionBody body;
  Rim rim;
  Spread spread;
  QuarterCase even_even, even_odd, odd_even, odd_odd;
  Index half, n_half;         // points x < 0, points x >= 0
  std::vector<double> angle;  // of the points x >= 0
  VectorXd backup;            // of the contact with the back-up roll, mirrored to the top: unit vertical force
};
}  // namespace

double arc_difference(const bite::ArcFlexibility &a, const bite::ArcFlexibility &b, const double arc)
{
  const VectorXd &x = a.position;
  if (x.size() != b.position.size() || (x - b.position).cwiseAbs().maxCoeff() > 1e-9 * x.cwiseAbs().maxCoeff())
    throw InputError("roll in the bite: two flexibilities can only be compared at the same points");
  const Eigen::ArrayXd share = (x.array() / arc).max(0.).min(1.);
  const VectorXd p = 4 * share * (1 - share), u = a.influence * p, v = b.influence * p;
  Index zero = 0;
  x.cwiseAbs().minCoeff(&zero);
  double range = 0, difference = 0;
  for (Index i = 0; i < x.size(); ++i)
    if (x[i] >= -0.3 * arc && x[i] <= 1.2 * arc) {
      range      = std::max(range, std::abs(u[i] - u[zero]));
      difference = std::max(difference, std::abs((u[i] - u[zero]) - (v[i] - v[zero])));
    }
  return difference / range;
}

void require_roll(const BiteRoll &roll)
{
  const VectorXd &x = roll.position;
  const Index n     = x.size();
  if (n < 3 || n % 2 == 0)
    throw InputError("roll in the bite: the arc needs an odd number of points, three at least, one of them on the "
                     "line of centres");
  for (Index i = 0; i < n; ++i)
    if ((i > 0 && !(x[i] > x[i - 1])) || std::abs(x[i] + x[n - 1 - i]) > 1e-9 * x[n - 1])
      throw InputError(
          "roll in the bite: the points of the arc must rise and be symmetric about the line of centres");
  if (!(roll.backup_half_width >= 0 && roll.backup_half_width < 0.5 * roll.radius))
    throw InputError("roll in the bite: the contact with the back-up roll must be narrower than half the radius");
}

BiteRollResult bite_roll_flexibility(const BiteRoll &roll, const MeshFile &mesh, const MeshFile *coarse)
{
  require_roll(roll);
  const RollSection section(roll, mesh);
  BiteRollResult out;
  out.n_unknowns            = section.n_unknowns();
  out.flexibility.position  = roll.position;
  out.flexibility.influence = section.influence(false);
  std::ostringstream method;
  method << "finite elements of the roll's section, " << out.n_unknowns << " unknowns";
  out.flexibility.method = method.str();
  if (roll.with_shear)
    out.shear_influence = section.influence(true);
  if (coarse) {
    bite::ArcFlexibility other{roll.position, RollSection(roll, *coarse).influence(false), ""};
    out.error_estimate = arc_difference(out.flexibility, other, roll.arc);
  }
  return out;
}
}  // namespace mill::fem
