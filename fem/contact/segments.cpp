#include "fem/contact/segments.h"
#include "core/numerics/gauss.h"
#include "fem/contact/mortar.h"
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

constexpr int most = 9;                                                     // nodes of a face
using Values       = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most, 1>;  // at the nodes of a face, on the stack
using Nodes        = std::array<Vector3, most>;                             // places; z = 0 in the plane

// Values and derivatives of the shape functions of degree n - 1 on 0..1, and the hats of the same nodes.
struct Shapes {
  std::array<double, 3> value, slope, hat;
};

Shapes shapes_along(const int n, const double s)
{
  Shapes out;
  if (n == 2) {
    out.value = {1 - s, s, 0};
    out.slope = {-1, 1, 0};
    out.hat   = out.value;
  } else {
    out.value = {(1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1)};
    out.slope = {4 * s - 3, 4 - 8 * s, 4 * s - 1};
    out.hat   = {std::max(0., 1 - 2 * s), 1 - std::abs(2 * s - 1), std::max(0., 2 * s - 1)};
  }
  return out;
}

// A face: its nodes, and n of them along each of its one or two parameters.
struct Face {
  Nodes node;
  int n, dim;
  int size() const
  {
    return dim == 1 ? n : n * n;
  }
};

Face face_of(const Surface &surface, const Eigen::Index face)
{
  Face out{{}, nodes_along(surface), int(surface.points.cols()) - 1};
  for (int k = 0; k < out.size(); ++k) {
    out.node[k].setZero();
    for (Eigen::Index c = 0; c < surface.points.cols(); ++c)
      out.node[k][c] = surface.points(surface.faces(face, k), c);
  }
  return out;
}

// Shape functions, hats, place and tangents at one point of a face; a line has the second tangent z, so that the
// product of the two points outwards when the body is on the left.
struct At {
  Values value, hat;
  Vector3 x, first, second;
  Vector3 normal() const
  {
    return first.cross(second);
  }
};

At at_point(const Face &face, const Vector2 &p)
{
  const Shapes one = shapes_along(face.n, p[0]), two = face.dim == 2 ? shapes_along(face.n, p[1]) : Shapes();
  At out;
  out.value.resize(face.size());
  out.hat.resize(face.size());
  out.x = out.first = out.second = Vector3::Zero();
  for (int j = 0; j < (face.dim == 2 ? face.n : 1); ++j)
    for (int i = 0; i < face.n; ++i) {
      const int k     = j * face.n + i;
      const double vj = face.dim == 2 ? two.value[j] : 1;
      out.value[k]    = one.value[i] * vj;
      out.hat[k]      = one.hat[i] * (face.dim == 2 ? two.hat[j] : 1);
      out.x += out.value[k] * face.node[k];
      out.first += one.slope[i] * vj * face.node[k];
      if (face.dim == 2)
        out.second += one.value[i] * two.slope[j] * face.node[k];
    }
  if (face.dim == 1)
    out.second = Vector3::UnitZ();
  return out;
}

double ring(const Surface &surface, const Vector3 &x)
{
  return surface.axisymmetric ? 2 * M_PI * x[0] : 1;
}

// Points of a rule gathered one by one.
class Points {
public:
  // The master's nodes are those of a face, or none.
  void add(const At &slave, const double weight, const double gap, const Values &master = {},
           const int master_face = -1)
  {
    rows.push_back(
        {slave.value, slave.hat, master, slave.x, slave.normal().normalized(), master_face, weight, gap});
  }

  void fill(const Eigen::Index d, const Eigen::MatrixXi &master_faces, FaceRule &rule) const
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
    rule.points.resize(q, d);
    rule.normals.resize(q, d);
    for (Eigen::Index i = 0; i < q; ++i) {
      const Row &r        = rows[i];
      rule.weight[i]      = r.weight;
      rule.gap[i]         = r.gap;
      rule.slave.row(i)   = r.value;
      rule.hat.row(i)     = r.hat;
      rule.points.row(i)  = r.x.head(d);
      rule.normals.row(i) = r.normal.head(d);
      if (p > 0) {
        rule.master.row(i)      = r.master;
        rule.master_node.row(i) = master_faces.row(r.master_face);
      }
    }
  }

private:
  struct Row {
    Values value, hat, master;
    Vector3 x, normal;
    int master_face;
    double weight, gap;
  };
  std::vector<Row> rows;
};

// Gauss points of a whole face; halves, because hats bend in the middle.
void whole_face(const Surface &surface, const Eigen::Index index, FaceRule &out)
{
  const Face face      = face_of(surface, index);
  const GaussRule rule = gauss_legendre(5);
  std::vector<std::array<double, 2>> line;  // place, weight
  for (int h = 0; h < face.n - 1; ++h)
    for (int i = 0; i < 5; ++i)
      line.push_back({(h + 0.5 + 0.5 * rule.node[i]) / (face.n - 1), 0.5 * rule.weight[i] / (face.n - 1)});
  Points points;
  const auto add = [&](const Vector2 &p, const double weight) {
    const At foot = at_point(face, p);
    points.add(foot, weight * foot.normal().norm() * ring(surface, foot.x), 0);
  };
  for (const auto &[s, ws] : line) {
    if (face.dim == 1)
      add(Vector2(s, 0), ws);
    else
      for (const auto &[t, wt] : line)
        add(Vector2(s, t), ws * wt);
  }
  points.fill(surface.points.cols(), {}, out);
}

void measure_whole(const Surface &surface, const Eigen::Index face, FaceRule &rule)
{
  FaceRule whole;
  whole_face(surface, face, whole);
  rule.measure   = whole.weight.sum();
  rule.whole_hat = whole.hat.transpose() * whole.weight;
}

// The part of a product out of the plane.
template <class Vector> double cross(const Vector &a, const Vector &b)
{
  return a[0] * b[1] - a[1] * b[0];
}

// Parameter of the point of a line face at which  (x(s) - from) x direction(s) = 0 , Newton from the middle.
// @param direction  at the nodes of the face, interpolated between them
double meet(const Face &face, const Vector3 &from, const Nodes &direction)
{
  double s = 0.5;
  for (int i = 0; i < 30; ++i) {
    const At foot       = at_point(face, Vector2(s, 0));
    const Shapes shapes = shapes_along(face.n, s);
    Vector3 n = Vector3::Zero(), dn = Vector3::Zero();
    for (int k = 0; k < face.n; ++k) {
      n += shapes.value[k] * direction[k];
      dn += shapes.slope[k] * direction[k];
    }
    const Vector3 off = foot.x - from;
    const double step = cross(off, n) / (cross(foot.first, n) + cross(off, dn));
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

Eigen::VectorXd area_vector(const Surface &surface, const Eigen::Index face, const Eigen::VectorXd &position)
{
  const Eigen::VectorXd normal =
      at_point(face_of(surface, face), Vector2(position[0], position.size() > 1 ? position[1] : 0)).normal();
  return normal.head(surface.points.cols());
}

std::vector<FaceRule> whole_faces(const Surface &slave)
{
  std::vector<FaceRule> out(slave.faces.rows());
  for (Eigen::Index f = 0; f < slave.faces.rows(); ++f) {
    whole_face(slave, f, out[f]);
    out[f].measure   = out[f].weight.sum();
    out[f].whole_hat = out[f].hat.transpose() * out[f].weight;
  }
  return out;
}

std::vector<FaceRule> line_overlaps(const Surface &slave, const Surface &master, const double reach)
{
  const Eigen::MatrixXd normals = nodal_normals(slave);
  const GaussRule gauss         = gauss_legendre(5);
  std::vector<Face> facing;
  for (Eigen::Index f = 0; f < master.faces.rows(); ++f)
    facing.push_back(face_of(master, f));
  std::vector<FaceRule> out(slave.faces.rows());
  for (Eigen::Index e = 0; e < slave.faces.rows(); ++e) {
    measure_whole(slave, e, out[e]);
    const Face face = face_of(slave, e);
    Nodes direction;
    Vector3 normal = Vector3::Zero();
    for (int k = 0; k < face.n; ++k) {
      direction[k] = Vector3(normals(slave.faces(e, k), 0), normals(slave.faces(e, k), 1), 0);
      normal += direction[k] / face.n;
    }
    const Vector3 &start = face.node[0], &end = face.node[face.n - 1];
    const double length = (end - start).norm();
    Points points;
    for (std::size_t f = 0; f < facing.size(); ++f) {
      const Face &other   = facing[f];
      const Vector3 &from = other.node[0], &to = other.node[other.n - 1];
      const Vector3 run = to - from, offset = 0.5 * (from + to - start - end);
      const double size = run.norm();
      if (cross(run, normal) <= 0 ||  // its outward normal, right of its run, does not oppose the slave's
          std::abs(offset.dot(normal)) > reach + size || std::abs(cross(normal, offset)) > size + length)
        continue;
      const double s1 = meet(face, from, direction), s2 = meet(face, to, direction);
      const double low = std::max(0., std::min(s1, s2)), high = std::min(1., std::max(s1, s2));
      if (!(high - low > 1e-10))
        continue;
      // Hats bend at the middle of a quadratic face, so a segment across it is split there.
      std::vector<double> ends{low, high};
      if (face.n == 3 && low < 0.5 && high > 0.5)
        ends.insert(ends.begin() + 1, 0.5);
      for (std::size_t k = 0; k + 1 < ends.size(); ++k)
        for (int i = 0; i < 5; ++i) {
          const double half = 0.5 * (ends[k + 1] - ends[k]), s = ends[k] + half * (1 + gauss.node[i]);
          const At foot = at_point(face, Vector2(s, 0));
          Vector3 n     = Vector3::Zero();
          for (int l = 0; l < face.n; ++l)
            n += foot.value[l] * direction[l];
          n.normalize();
          Nodes fixed;
          fixed.fill(n);
          const At partner    = at_point(other, Vector2(std::clamp(meet(other, foot.x, fixed), 0., 1.), 0));
          const double weight = half * gauss.weight[i] * foot.first.norm() * ring(slave, foot.x);
          points.add(foot, weight, (partner.x - foot.x).dot(n), partner.value, int(f));
        }
    }
    points.fill(2, master.faces, out[e]);
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
    const auto inside = [&](const Vector2 &p) { return cross<Vector2>(edge, p - a); };
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
        q.face              = f;
        q.centre            = Vector2(i + 0.5, j + 0.5) / (n - 1);
        const auto value_at = [&](const int a, const int b) -> Vector3 {
          return surface.points.row(surface.faces(f, b * n + a));
        };
        q.corner = {value_at(i, j), value_at(i + 1, j), value_at(i + 1, j + 1), value_at(i, j + 1)};
        q.middle = 0.25 * (q.corner[0] + q.corner[1] + q.corner[2] + q.corner[3]);
        q.normal = (q.corner[2] - q.corner[0]).cross(q.corner[3] - q.corner[1]).normalized();
        q.size   = 0;
        for (const Vector3 &c : q.corner)
          q.size = std::max(q.size, (c - q.middle).norm());
        out.push_back(q);
      }
  return out;
}

bool is_parallelogram(const Quarter &q)
{
  return (q.corner[0] - q.corner[1] + q.corner[2] - q.corner[3]).norm() < 1e-10 * q.size;
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
At meet(const Face &face, const Vector3 &from, const Plane &in_plane, Vector2 p)
{
  At foot = at_point(face, p);
  for (int i = 0; i < 30; ++i) {
    const Vector3 off = foot.x - from;
    const Vector2 a = across(in_plane, foot.first), b = across(in_plane, foot.second), c = across(in_plane, off);
    const Vector2 step = Vector2(cross(c, b), cross(a, c)) / cross(a, b);
    p -= step;
    foot = at_point(face, p);
    if (step.cwiseAbs().maxCoeff() < 1e-8)  // Newton squares it: the next step is at rounding level
      break;
  }
  return foot;
}
}  // namespace

std::vector<FaceRule> polygon_overlaps(const Surface &slave, const Surface &master, const double reach)
{
  const std::vector<Quarter> on_slave = quarters(slave), on_master = quarters(master);
  std::vector<FaceRule> out(slave.faces.rows());
  std::vector<Points> points(slave.faces.rows());
  for (Eigen::Index f = 0; f < slave.faces.rows(); ++f)
    measure_whole(slave, f, out[f]);
  // Multiplier times shape function: degree 2 or 4 in each parameter, so total degree 4 or 8 in the plane, and one
  // more for the folding of the square onto a triangle.  On general quadrilaterals no rule is exact: two points
  // more.
  const bool exact = std::all_of(on_slave.begin(), on_slave.end(), is_parallelogram) &&
                     std::all_of(on_master.begin(), on_master.end(), is_parallelogram);
  const int n_gauss     = (nodes_along(slave) == 2 && nodes_along(master) == 2 ? 3 : 5) + (exact ? 0 : 2);
  const GaussRule gauss = gauss_legendre(n_gauss);
  for (const Quarter &q : on_slave) {
    const Face face    = face_of(slave, q.face);
    const Vector3 edge = q.corner[1] - q.corner[0];
    Plane plane;
    plane.origin    = q.middle;
    plane.first     = (edge - edge.dot(q.normal) * q.normal).normalized();
    plane.second    = q.normal.cross(plane.first);
    const auto flat = [&](const Vector3 &x) -> Vector2 {
      const Vector3 from_origin = x - plane.origin;
      return across(plane, from_origin);
    };
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
      const Face other = face_of(master, m.face);
      for (std::size_t k = 1; k + 1 < common.size(); ++k) {
        const Vector2 a = common[k] - common[0], b = common[k + 1] - common[0];
        const double twice = cross(a, b);
        if (twice < 1e-3 * small)
          continue;
        for (int i = 0; i < n_gauss; ++i)
          for (int j = 0; j < n_gauss; ++j) {
            const double u = 0.5 + 0.5 * gauss.node[i], v = 0.5 + 0.5 * gauss.node[j];
            const Vector2 p      = common[0] + u * ((1 - v) * a + v * b);
            const double dA      = 0.25 * gauss.weight[i] * gauss.weight[j] * u * twice;
            const Vector3 origin = plane.origin + p[0] * plane.first + p[1] * plane.second;
            const At foot = meet(face, origin, plane, q.centre), partner = meet(other, origin, plane, m.centre);
            const Vector3 normal = foot.normal();
            points[q.face].add(foot, dA * normal.norm() / std::abs(normal.dot(q.normal)),
                               (partner.x - foot.x).dot(q.normal), partner.value, int(m.face));
          }
      }
    }
  }
  for (Eigen::Index f = 0; f < slave.faces.rows(); ++f)
    points[f].fill(3, master.faces, out[f]);
  return out;
}
}  // namespace mill::contact
