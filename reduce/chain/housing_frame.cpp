#include "reduce/chain/housing_frame.h"
#include "core/base/errors.h"
#include "core/numerics/gauss.h"
#include "reduce/chain/quoted_mm.h"
#include <Eigen/Dense>
#include <cmath>
#include <utility>
#include <vector>

namespace mill::reduce {
namespace {
// Halves x >= 0 that the two housings consist of.
constexpr double n_halves = 4;

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// A straight stretch between two nodes; what is not flexible at its ends moves with the node.
struct Member {
  int from, to;
  FramePart part;
  double height;             // m, in the plane
  double rigid[2] = {0, 0};  // m, at its ends
  double load     = 0;       // N/m, along its second axis
};

struct Plane {
  std::vector<Eigen::Vector2d> node;
  std::vector<Member> member;
};

// Node 0 in the middle of the lower beam, around to node 6 in the middle of the upper one.
Plane half_frame(const MillHousing &h, const FrameChoice &choice)
{
  const double axis = 0.5 * (h.window_width + h.post_width), low = -0.5 * h.lower_beam_height,
               high         = h.window_height + 0.5 * h.upper_beam_height,
               rigid_corner = 0.5 * choice.rigid_corner * h.post_width;
  const double lower_corner = 0.5 * choice.rigid_corner * h.lower_beam_height,
               upper_corner = 0.5 * choice.rigid_corner * h.upper_beam_height;
  Plane p;
  p.node             = {{0, low},     {0.5 * h.seat_pad, low},   {axis, low}, {axis, h.foot_height},
                        {axis, high}, {0.5 * h.screw_pad, high}, {0, high}};
  const double force = 1 / n_halves;
  // Second axes: up along the lower beam, inwards along the post, down along the upper beam.
  const auto add = [&](const int from, const FramePart part, const double height, const double rigid_start,
                       const double rigid_end, const double load) {
    Member m;
    m.from = from, m.to = from + 1, m.part = part, m.height = height, m.load = load;
    m.rigid[0] = rigid_start, m.rigid[1] = rigid_end;
    p.member.push_back(m);
  };
  add(0, lower_beam, h.lower_beam_height, 0, 0, -force / (0.5 * h.seat_pad));
  add(1, lower_beam, h.lower_beam_height, 0, rigid_corner, 0);
  add(2, lower_post, h.post_width, lower_corner, 0, 0);
  add(3, upper_post, h.post_width, 0, upper_corner, 0);
  add(4, upper_beam, h.upper_beam_height, rigid_corner, 0, 0);
  add(5, upper_beam, h.upper_beam_height, 0, 0, -force / (0.5 * h.screw_pad));
  return p;
}

// A member with its numbers: length of the flexible part, stiffnesses, axes.
struct Beam {
  double length, tension, bending, shear, phi;
  Eigen::Vector2d along;
  double m, rotary;  // kg/m and kg m

  Beam(const MillHousing &h, const Plane &p, const Member &member)
  {
    const Eigen::Vector2d span = p.node[std::size_t(member.to)] - p.node[std::size_t(member.from)];
    along                      = span.normalized();
    length                     = span.norm() - member.rigid[0] - member.rigid[1];
    const double nu = h.steel.poisson_ratio, E = h.steel.youngs_modulus, A = h.thickness * member.height;
    const double kappa = 10 * (1 + nu) / (12 + 11 * nu);  // Cowper 1966, rectangle
    const double I     = A * member.height * member.height / 12;
    tension            = E * A;
    bending            = E * I;
    shear              = kappa * E / (2 * (1 + nu)) * A;
    phi                = 12 * bending / (shear * length * length);
    m                  = h.steel.density * A;
    rotary             = h.steel.density * I;
  }
  // (6, 6): displacements of the ends of the flexible part, along and across, from those of the nodes.
  Matrix6 from_nodes(const Member &member) const
  {
    Matrix6 T = Matrix6::Zero();
    for (const int end : {0, 1}) {
      const int place = 3 * end;
      T.block<1, 2>(place, place) << along[0], along[1];
      T.block<1, 2>(place + 1, place) << -along[1], along[0];
      T(place + 1, place + 2) = end == 0 ? member.rigid[0] : -member.rigid[1];
      T(place + 2, place + 2) = 1;
    }
    return T;
  }
  Matrix6 stiffness() const
  {
    const double l = length, f = bending / (l * l * l * (1 + phi));
    Matrix6 k = Matrix6::Zero();
    k(0, 0) = k(3, 3) = tension / l;
    k(0, 3) = k(3, 0) = -tension / l;
    Eigen::Matrix4d b;
    b << 12, 6 * l, -12, 6 * l,                               //
        6 * l, (4 + phi) * l * l, -6 * l, (2 - phi) * l * l,  //
        -12, -6 * l, 12, -6 * l,                              //
        6 * l, (2 - phi) * l * l, -6 * l, (4 + phi) * l * l;
    const int place[] = {1, 2, 4, 5};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j)
        k(place[i], place[j]) = f * b(i, j);
    return k;
  }
  Vector6 load(const double q) const
  {
    Vector6 f;
    f << 0, 0.5 * q * length, q * length * length / 12, 0, 0.5 * q * length, -q * length * length / 12;
    return f;
  }
  // Integral of q times the displacement that q makes with the ends built in.
  double built_in_work(const double q) const
  {
    return q * q * (std::pow(length, 5) / (720 * bending) + std::pow(length, 3) / (12 * shear));
  }
  // Along, across, rotation at the share s of the flexible part.
  Eigen::Vector3d at(const Vector6 &d, const double q, const double s) const
  {
    const double l = length, n = 1 / (1 + phi), t = 1 - s;
    const double across =
        n * ((1 - 3 * s * s + 2 * s * s * s + phi * t) * d[1] + l * (s * t * t + 0.5 * phi * s * t) * d[2] +
             (3 * s * s - 2 * s * s * s + phi * s) * d[4] - l * (s * s * t + 0.5 * phi * s * t) * d[5]);
    const double turn = n * (6 / l * (s * s - s) * (d[1] - d[4]) + (1 - 4 * s + 3 * s * s + phi * t) * d[2] +
                             (3 * s * s - 2 * s + phi * s) * d[5]);
    return {t * d[0] + s * d[3],
            across + q * l * l * (l * l * s * s * t * t / (24 * bending) + s * t / (2 * shear)),
            turn + q * l * l * l * (2 * s - 6 * s * s + 4 * s * s * s) / (24 * bending)};
  }
};

void require(const MillHousing &h, const FrameChoice &choice)
{
  const std::vector<std::pair<const char *, double>> lengths{{"thickness", h.thickness},
                                                             {"post_width", h.post_width},
                                                             {"window_width", h.window_width},
                                                             {"window_height", h.window_height},
                                                             {"upper_beam_height", h.upper_beam_height},
                                                             {"lower_beam_height", h.lower_beam_height},
                                                             {"screw_pad", h.screw_pad},
                                                             {"seat_pad", h.seat_pad}};
  for (const auto &[key, value] : lengths)
    if (!(value > 0))
      throw InputError(std::string("housing.") + key + " = " + quoted_mm(value) +
                       " must be positive: give the length of the drawing");
  if (!(h.foot_height > 0 && h.foot_height < h.window_height))
    throw InputError("housing.foot_height = " + quoted_mm(h.foot_height) +
                     " is outside the posts: give more than 0 mm and less than housing.window_height = " +
                     quoted_mm(h.window_height));
  if (!(choice.rigid_corner >= 0 && choice.rigid_corner <= 1))
    throw InputError("frame of the housing: " + short_number(choice.rigid_corner) +
                     " of a corner cannot be rigid; 0 to 1 can");
}

Vector6 ends(const Eigen::VectorXd &u, const Member &m)
{
  Vector6 d;
  d << u.segment<3>(3 * m.from), u.segment<3>(3 * m.to);
  return d;
}

void add_member(HousingFrame &out, const Beam &beam, const Member &m, const Vector6 &nodes)
{
  static const GaussRule gauss = gauss_legendre(6);  // quartic shapes squared are of degree 8
  const Vector6 d              = beam.from_nodes(m) * nodes;
  out.energy[m.part] += n_halves * (d.dot(beam.stiffness() * d) + beam.built_in_work(m.load));
  // Masses still without their reference: kg m2 per N2.
  const auto add = [&](const double length, const Eigen::Vector3d &u) {
    const double vertical = beam.along[1] * u[0] + beam.along[0] * u[1];
    const double dm       = n_halves * beam.m * length;
    out.mass[m.part] += dm;
    out.reduced_mass[m.part] += dm * u.head<2>().squaredNorm() + n_halves * beam.rotary * length * u[2] * u[2];
    out.vertical_mass[m.part] += dm * vertical * vertical;
  };
  for (int i = 0; i < gauss.node.size(); ++i) {
    const double s = 0.5 * (1 + gauss.node[i]), w = 0.5 * gauss.weight[i];
    add(w * beam.length, beam.at(d, m.load, s));
    for (const int end : {0, 1}) {
      Eigen::Vector3d u = d.segment<3>(3 * end);
      u[1] += u[2] * m.rigid[end] * (end == 0 ? s - 1 : s);
      add(w * m.rigid[end], u);
    }
  }
}
}  // namespace

HousingFrame housing_frame(const MillHousing &h, const FrameChoice &choice)
{
  require(h, choice);
  const Plane plane = half_frame(h, choice);
  const int n       = int(3 * plane.node.size());
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(n);
  for (const Member &m : plane.member) {
    const Beam beam(h, plane, m);
    const Matrix6 T = beam.from_nodes(m), k = T.transpose() * beam.stiffness() * T;
    const Vector6 load = T.transpose() * beam.load(m.load);
    const int place[]  = {3 * m.from, 3 * m.to};
    for (int i = 0; i < 2; ++i) {
      f.segment<3>(place[i]) += load.segment<3>(3 * i);
      for (int j = 0; j < 2; ++j)
        K.block<3, 3>(place[i], place[j]) += k.block<3, 3>(3 * i, 3 * j);
    }
  }
  // Symmetry holds the middles of the beams; the foot node is pinned upwards, the loads balance.
  const int foot = 3 * 3;
  std::vector<int> free;
  for (int i = 0; i < n; ++i)
    if (i != 0 && i != 2 && i != n - 3 && i != n - 1 && i != foot + 1)
      free.push_back(i);
  Eigen::VectorXd u            = Eigen::VectorXd::Zero(n);
  const Eigen::MatrixXd free_K = K(free, free);
  const Eigen::VectorXd free_f = f(free);
  const Eigen::VectorXd free_u = free_K.ldlt().solve(free_f);
  u(free)                      = free_u;
  const double rise = u[foot + 1] + 0.5 * h.post_width * u[foot + 2];  // of the foot, on the outside of the post
  for (int i = 1; i < n; i += 3)
    u[i] -= rise;

  HousingFrame out;
  for (const Member &m : plane.member)
    add_member(out, Beam(h, plane, m), m, ends(u, m));
  // Work of each pad's load: through the nodes, and of the bulge between them.
  const auto pad = [&](const Member &m) {
    const Beam beam(h, plane, m);
    return n_halves * ((beam.from_nodes(m) * ends(u, m)).dot(beam.load(m.load)) + beam.built_in_work(m.load));
  };
  out.u_seat    = -pad(plane.member.front());
  out.u_screw   = pad(plane.member.back());
  out.exchanged = out.energy[upper_post] + out.energy[upper_beam] - out.u_screw;
  for (const auto &[post, beam, whole] :
       {std::tuple{upper_post, upper_beam, out.u_screw}, std::tuple{lower_post, lower_beam, -out.u_seat}})
    for (const FramePart part : {post, beam}) {
      out.flexibility[part] = whole * out.energy[part] / (out.energy[post] + out.energy[beam]);
      out.reduced_mass[part] /= whole * whole;
      out.vertical_mass[part] /= whole * whole;
    }
  // Moment at the upper joint: end forces of the member from there to the pad, times the distance to the joint.
  const Member &m     = plane.member[4];
  const Vector6 force = Beam(h, plane, m).from_nodes(m).transpose() *
                        (Beam(h, plane, m).stiffness() * (Beam(h, plane, m).from_nodes(m) * ends(u, m)));
  const double span = 2 * plane.node[4][0], c = 0.5 * h.screw_pad, per_housing = 0.5;
  out.fixity = std::abs(force[2]) / (per_housing * (3 * span * span - 4 * c * c) / (24 * span));
  return out;
}

std::array<double, n_frame_parts> masses_by_rule(const MillHousing &h)
{
  const auto parts = housing_frame(h).mass;
  std::array<double, n_frame_parts> out{};
  for (const FramePart post : {upper_post, lower_post})
    out[post] = parts[post] / 3;
  for (const FramePart beam : {upper_beam, lower_beam})
    out[beam] = parts[beam] * 17 / 35;
  return out;
}
}  // namespace mill::reduce
