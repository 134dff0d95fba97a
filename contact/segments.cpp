#include "contact/segments.h"
#include "contact/mortar.h"
#include "core/gauss.h"
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace mill::contact {
namespace {
using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;

int nodes_along(const Surface &surface)
{
  const Eigen::Index m = surface.faces.cols();
  return surface.points.cols() == 2 ? int(m) : int(std::lround(std::sqrt(double(m))));
}

// Values and derivatives of the shape functions of degree n - 1 on 0..1, and the hats of the same nodes.
struct Shapes {
  Eigen::VectorXd value, slope, hat;
};

Shapes shapes_along(const int n, const double s)
{
  Shapes out{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  if (n == 2) {
    out.value << 1 - s, s;
    out.slope << -1, 1;
    out.hat = out.value;
  } else {
    out.value << (1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1);
    out.slope << 4 * s - 3, 4 - 8 * s, 4 * s - 1;
    out.hat << std::max(0., 1 - 2 * s), 1 - std::abs(2 * s - 1), std::max(0., 2 * s - 1);
  }
  return out;
}

Eigen::VectorXd product(const Eigen::VectorXd &a, const Eigen::VectorXd &b)
{
  Eigen::VectorXd out(a.size() * b.size());
  for (Eigen::Index j = 0; j < b.size(); ++j)
    out.segment(j * a.size(), a.size()) = a * b[j];
  return out;
}

// Shape functions, hats, place and tangents at one point of a face.
struct At {
  Eigen::VectorXd value, hat, x;
  Eigen::MatrixXd tangents;  // (d, 1 or 2)
};

At at_point(const Surface &surface, const Eigen::MatrixXd &corners, const Eigen::VectorXd &p)
{
  const int n      = nodes_along(surface);
  const Shapes one = shapes_along(n, p[0]);
  At out;
  if (p.size() == 1) {
    out.value    = one.value;
    out.hat      = one.hat;
    out.tangents = corners.transpose() * one.slope;
  } else {
    const Shapes two = shapes_along(n, p[1]);
    out.value        = product(one.value, two.value);
    out.hat          = product(one.hat, two.hat);
    out.tangents.resize(3, 2);
    out.tangents.col(0) = corners.transpose() * product(one.slope, two.value);
    out.tangents.col(1) = corners.transpose() * product(one.value, two.slope);
  }
  out.x = corners.transpose() * out.value;
  return out;
}

// Nodes of a face, (m, d).
Eigen::MatrixXd corners_of(const Surface &surface, const Eigen::Index face)
{
  return surface.points(surface.faces.row(face), Eigen::all);
}

Eigen::VectorXd normal_of(const At &at)
{
  if (at.tangents.cols() == 1)
    return Vector2(at.tangents(1, 0), -at.tangents(0, 0));  // the body is on the left
  return Vector3(at.tangents.col(0)).cross(Vector3(at.tangents.col(1)));
}

double ring(const Surface &surface, const Eigen::VectorXd &x)
{
  return surface.axisymmetric ? 2 * M_PI * x[0] : 1;
}

// Points of a rule gathered one by one.
class Points {
public:
  void add(const At &slave, const double weight, const double gap, const Eigen::VectorXd &master = {},
           const Eigen::VectorXi &master_node = {})
  {
    rows.push_back(
        {slave.value, slave.hat, slave.x, normal_of(slave).normalized(), master, master_node, weight, gap});
  }

  void fill(FaceRule &rule) const
  {
    if (rows.empty())
      return;
    const auto q = Eigen::Index(rows.size()), m = rows[0].value.size(), p = rows[0].master.size();
    rule.weight.resize(q);
    rule.gap.resize(q);
    rule.slave.resize(q, m);
    rule.hat.resize(q, m);
    rule.master.resize(q, p);
    rule.master_node.resize(q, p);
    rule.points.resize(q, rows[0].x.size());
    rule.normals.resize(q, rows[0].x.size());
    for (Eigen::Index i = 0; i < q; ++i) {
      const Row &r        = rows[i];
      rule.weight[i]      = r.weight;
      rule.gap[i]         = r.gap;
      rule.slave.row(i)   = r.value;
      rule.hat.row(i)     = r.hat;
      rule.points.row(i)  = r.x;
      rule.normals.row(i) = r.normal;
      if (p > 0) {
        rule.master.row(i)      = r.master;
        rule.master_node.row(i) = r.master_node;
      }
    }
  }

private:
  struct Row {
    Eigen::VectorXd value, hat, x, normal, master;
    Eigen::VectorXi master_node;
    double weight, gap;
  };
  std::vector<Row> rows;
};

// Gauss points of a whole face; halves, because hats bend in the middle.
Points whole_face(const Surface &surface, const Eigen::Index face)
{
  const Eigen::MatrixXd corners = corners_of(surface, face);
  const int halves              = nodes_along(surface) - 1;
  const GaussRule rule          = gauss_legendre(5);
  std::vector<std::array<double, 2>> line;  // place, weight
  for (int h = 0; h < halves; ++h)
    for (int i = 0; i < 5; ++i)
      line.push_back({(h + 0.5 + 0.5 * rule.node[i]) / halves, 0.5 * rule.weight[i] / halves});
  Points out;
  const auto add = [&](const Eigen::VectorXd &p, const double weight) {
    const At at = at_point(surface, corners, p);
    out.add(at, weight * normal_of(at).norm() * ring(surface, at.x), 0);
  };
  for (const auto &[s, ws] : line) {
    if (surface.points.cols() == 2)
      add(Eigen::VectorXd::Constant(1, s), ws);
    else
      for (const auto &[t, wt] : line)
        add(Vector2(s, t), ws * wt);
  }
  return out;
}

void measure_whole(const Surface &surface, const Eigen::Index face, FaceRule &rule)
{
  FaceRule whole;
  whole_face(surface, face).fill(whole);
  rule.measure   = whole.weight.sum();
  rule.whole_hat = whole.hat.transpose() * whole.weight;
}

double cross(const Vector2 &a, const Vector2 &b)
{
  return a[0] * b[1] - a[1] * b[0];
}

// Parameter of the point of a line face at which  (x(s) - from) x direction(s) = 0 , Newton from the middle.
// @param direction  (m, 2) at the nodes of the face, interpolated between them
double meet(const Surface &surface, const Eigen::MatrixXd &corners, const Vector2 &from,
            const Eigen::MatrixXd &direction)
{
  double s = 0.5;
  for (int i = 0; i < 30; ++i) {
    const At at     = at_point(surface, corners, Eigen::VectorXd::Constant(1, s));
    const Vector2 n = direction.transpose() * at.value, off = Vector2(at.x) - from;
    const Vector2 dn  = direction.transpose() * shapes_along(nodes_along(surface), s).slope;
    const double step = cross(off, n) / (cross(Vector2(at.tangents.col(0)), n) + cross(off, dn));
    s -= step;
    if (std::abs(step) < 1e-15 || !(std::abs(s) < 1e3))
      break;
  }
  return s;
}
}  // namespace

Eigen::MatrixXd node_parameters(const Surface &surface)
{
  const int n = nodes_along(surface);
  if (surface.points.cols() == 2)
    return Eigen::VectorXd::LinSpaced(n, 0, 1);
  Eigen::MatrixXd out(n * n, 2);
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      out.row(j * n + i) << double(i) / (n - 1), double(j) / (n - 1);
  return out;
}

Eigen::VectorXd area_vector(const Surface &surface, const Eigen::Index face, const Eigen::VectorXd &at)
{
  return normal_of(at_point(surface, corners_of(surface, face), at));
}

std::vector<FaceRule> whole_faces(const Surface &slave)
{
  std::vector<FaceRule> out(slave.faces.rows());
  for (Eigen::Index f = 0; f < slave.faces.rows(); ++f) {
    whole_face(slave, f).fill(out[f]);
    measure_whole(slave, f, out[f]);
  }
  return out;
}

std::vector<FaceRule> line_overlaps(const Surface &slave, const Surface &master, const double reach)
{
  const Eigen::MatrixXd normals = nodal_normals(slave);
  const GaussRule gauss         = gauss_legendre(5);
  std::vector<FaceRule> out(slave.faces.rows());
  for (Eigen::Index e = 0; e < slave.faces.rows(); ++e) {
    measure_whole(slave, e, out[e]);
    const Eigen::MatrixXd X = corners_of(slave, e), N = normals(slave.faces.row(e), Eigen::all);
    const Eigen::Index last = X.rows() - 1;
    const double length     = (X.row(last) - X.row(0)).norm();
    const Vector2 middle = 0.5 * (X.row(0) + X.row(last)), normal = N.colwise().mean();
    Points points;
    for (Eigen::Index f = 0; f < master.faces.rows(); ++f) {
      const Eigen::MatrixXd Y = corners_of(master, f);
      const Vector2 run       = Y.row(Y.rows() - 1) - Y.row(0), facing(run[1], -run[0]);
      const Vector2 offset    = 0.5 * Vector2(Y.row(0) + Y.row(Y.rows() - 1)) - middle;
      if (facing.dot(normal) >= 0 || std::abs(offset.dot(normal)) > reach + run.norm() ||
          std::abs(cross(normal, offset)) > run.norm() + length)
        continue;
      const double s1 = meet(slave, X, Y.row(0), N), s2 = meet(slave, X, Y.row(Y.rows() - 1), N);
      const double low = std::max(0., std::min(s1, s2)), high = std::min(1., std::max(s1, s2));
      if (!(high - low > 1e-10))
        continue;
      // Hats bend at the middle of a quadratic face, so a segment across it is split there.
      std::vector<double> ends{low, high};
      if (last == 2 && low < 0.5 && high > 0.5)
        ends.insert(ends.begin() + 1, 0.5);
      for (std::size_t k = 0; k + 1 < ends.size(); ++k)
        for (int i = 0; i < 5; ++i) {
          const double half = 0.5 * (ends[k + 1] - ends[k]), s = ends[k] + half * (1 + gauss.node[i]);
          const At at         = at_point(slave, X, Eigen::VectorXd::Constant(1, s));
          const Vector2 n     = (N.transpose() * at.value).normalized();
          const double t      = std::clamp(meet(master, Y, at.x, n.transpose().replicate(Y.rows(), 1)), 0., 1.);
          const At partner    = at_point(master, Y, Eigen::VectorXd::Constant(1, t));
          const double weight = half * gauss.weight[i] * at.tangents.norm() * ring(slave, at.x);
          points.add(at, weight, Vector2(partner.x - at.x).dot(n), partner.value, master.faces.row(f).transpose());
        }
    }
    points.fill(out[e]);
  }
  return out;
}

namespace {
using Polygon = std::vector<Vector2>;

// Part of a polygon inside a convex one, both counter-clockwise.  Sutherland and Hodgman.
Polygon clipped(Polygon polygon, const Polygon &window)
{
  for (std::size_t k = 0; k < window.size() && !polygon.empty(); ++k) {
    const Vector2 a = window[k], edge = window[(k + 1) % window.size()] - a;
    const auto inside = [&](const Vector2 &p) { return cross(edge, p - a); };
    Polygon next;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vector2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
      const double hp = inside(p), hq = inside(q);
      if (hp >= 0)
        next.push_back(p);
      if ((hp > 0 && hq < 0) || (hp < 0 && hq > 0))
        next.push_back(p + hp / (hp - hq) * (q - p));
    }
    polygon = next;
  }
  return polygon;
}

double area(const Polygon &p)
{
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    sum += 0.5 * cross(p[i], p[(i + 1) % p.size()]);
  return sum;
}

// A face, or for a quadratic one a quarter of it between neighbouring nodes, as four corners.
struct Quarter {
  Eigen::Index face;
  std::array<Vector3, 4> corner;  // around
  Vector2 centre;                 // parameters
  Vector3 middle, normal;
  double size;  // m, longest distance of a corner from the middle
};

std::vector<Quarter> quarters(const Surface &surface)
{
  const int n = nodes_along(surface);
  std::vector<Quarter> out;
  for (Eigen::Index f = 0; f < surface.faces.rows(); ++f)
    for (int j = 0; j + 1 < n; ++j)
      for (int i = 0; i + 1 < n; ++i) {
        Quarter q;
        q.face        = f;
        q.centre      = Vector2(i + 0.5, j + 0.5) / (n - 1);
        const auto at = [&](const int a, const int b) -> Vector3 {
          return surface.points.row(surface.faces(f, b * n + a));
        };
        q.corner = {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
        q.middle = 0.25 * (q.corner[0] + q.corner[1] + q.corner[2] + q.corner[3]);
        q.normal = (q.corner[2] - q.corner[0]).cross(q.corner[3] - q.corner[1]).normalized();
        q.size   = 0;
        for (const Vector3 &c : q.corner)
          q.size = std::max(q.size, (c - q.middle).norm());
        out.push_back(q);
      }
  return out;
}

// The two axes of the plane of a slave face.
struct Plane {
  Vector3 origin, first, second;
};

Vector2 across(const Plane &plane, const Vector3 &v)
{
  return {plane.first.dot(v), plane.second.dot(v)};
}

// Point of a face straight above or below `from` along a fixed normal, Newton from a point of the quarter.
Vector2 meet(const Surface &surface, const Eigen::MatrixXd &corners, const Vector3 &from, const Plane &in_plane,
             Vector2 p)
{
  for (int i = 0; i < 30; ++i) {
    const At at         = at_point(surface, corners, p);
    const Vector3 first = at.tangents.col(0), second = at.tangents.col(1), off = Vector3(at.x) - from;
    const Vector2 a = across(in_plane, first), b = across(in_plane, second), c = across(in_plane, off);
    const Vector2 step = Vector2(cross(c, b), cross(a, c)) / cross(a, b);
    p -= step;
    if (step.cwiseAbs().maxCoeff() < 1e-15)
      break;
  }
  return p;
}
}  // namespace

std::vector<FaceRule> polygon_overlaps(const Surface &slave, const Surface &master, const double reach)
{
  const std::vector<Quarter> on_slave = quarters(slave), on_master = quarters(master);
  std::vector<FaceRule> out(slave.faces.rows());
  std::vector<Points> points(slave.faces.rows());
  for (Eigen::Index f = 0; f < slave.faces.rows(); ++f)
    measure_whole(slave, f, out[f]);
  // Multiplier times shape function: degree 2 per direction and factor, so total degree 4 or 8 in the plane.
  const int n_gauss     = nodes_along(slave) == 2 && nodes_along(master) == 2 ? 4 : 6;
  const GaussRule gauss = gauss_legendre(n_gauss);
  for (const Quarter &q : on_slave) {
    const Eigen::MatrixXd X = corners_of(slave, q.face);
    const Vector3 edge      = q.corner[1] - q.corner[0];
    Plane plane;
    plane.origin    = q.middle;
    plane.first     = (edge - edge.dot(q.normal) * q.normal).normalized();
    plane.second    = q.normal.cross(plane.first);
    const auto flat = [&](const Vector3 &x) -> Vector2 { return across(plane, x - plane.origin); };
    Polygon subject;
    for (const Vector3 &c : q.corner)
      subject.push_back(flat(c));
    const double small = 1e-10 * area(subject);
    for (const Quarter &m : on_master) {
      const Vector3 offset = m.middle - q.middle;
      const double height  = offset.dot(q.normal);
      if (m.normal.dot(q.normal) >= 0 || std::abs(height) > reach + m.size + q.size ||
          (offset - height * q.normal).norm() > m.size + q.size)
        continue;
      Polygon window;
      for (int k = 3; k >= 0; --k)  // the master is seen from behind
        window.push_back(flat(m.corner[k]));
      const Polygon common = clipped(subject, window);
      if (common.size() < 3 || area(common) < small)
        continue;
      const Eigen::MatrixXd Y = corners_of(master, m.face);
      Vector2 centre          = Vector2::Zero();
      for (const Vector2 &p : common)
        centre += p / double(common.size());
      for (std::size_t k = 0; k < common.size(); ++k) {
        const Vector2 a = common[k] - centre, b = common[(k + 1) % common.size()] - centre;
        const double twice = cross(a, b);
        if (twice < 1e-3 * small)
          continue;
        // Square folded onto the triangle: the collapsed corner at the centre.
        for (int i = 0; i < n_gauss; ++i)
          for (int j = 0; j < n_gauss; ++j) {
            const double u = 0.5 + 0.5 * gauss.node[i], v = 0.5 + 0.5 * gauss.node[j];
            const Vector2 p      = centre + u * ((1 - v) * a + v * b);
            const double dA      = 0.25 * gauss.weight[i] * gauss.weight[j] * u * twice;
            const Vector3 origin = plane.origin + p[0] * plane.first + p[1] * plane.second;
            const At at          = at_point(slave, X, meet(slave, X, origin, plane, q.centre));
            const At partner     = at_point(master, Y, meet(master, Y, origin, plane, m.centre));
            const Vector3 normal = normal_of(at);
            points[q.face].add(at, dA * normal.norm() / std::abs(normal.dot(q.normal)),
                               Vector3(partner.x - at.x).dot(q.normal), partner.value,
                               master.faces.row(m.face).transpose());
          }
      }
    }
  }
  for (Eigen::Index f = 0; f < slave.faces.rows(); ++f)
    points[f].fill(out[f]);
  return out;
}
}  // namespace mill::contact
