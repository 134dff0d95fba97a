#include "fem/roll/fourier_roll.h"
#include "core/base/errors.h"
#include "core/numerics/gauss.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace mill::fem {
namespace {
enum Direction { u_r = 0, u_theta = 1, u_z = 2 };

// Shape functions of a line of 2 or 3 nodes at s in 0..1.
Eigen::VectorXd line_shape(const Eigen::Index n_nodes, const double s)
{
  if (n_nodes == 2)
    return Eigen::Vector2d(1 - s, s);
  return Eigen::Vector3d((1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1));
}

// (nodes of the group, n): integral over each station of the shape functions along z, over its length.  As a load
// it is 1 N spread over the station, transposed it is the mean displacement of the station.
Eigen::MatrixXd spread(const Surface &surface, const Eigen::VectorXd &edge)
{
  const GaussRule gauss = gauss_legendre(3);  // exact up to degree 5
  const auto last       = surface.faces.cols() - 1;
  Eigen::MatrixXd out   = Eigen::MatrixXd::Zero(surface.points.rows(), edge.size() - 1);
  for (Eigen::Index f = 0; f < surface.faces.rows(); ++f) {
    const double from = surface.points(surface.faces(f, 0), 1), to = surface.points(surface.faces(f, last), 1);
    for (Eigen::Index k = 0; k < out.cols(); ++k) {
      const double low = std::max(std::min(from, to), edge[k]), high = std::min(std::max(from, to), edge[k + 1]);
      if (high <= low)
        continue;
      for (int g = 0; g < 3; ++g) {
        const double z          = 0.5 * (low + high) + 0.5 * (high - low) * gauss.node[g];
        const double w          = 0.5 * (high - low) * gauss.weight[g] / (edge[k + 1] - edge[k]);
        const Eigen::VectorXd N = line_shape(last + 1, (z - from) / (to - from));
        for (Eigen::Index a = 0; a <= last; ++a)
          out(surface.faces(f, a), k) += w * N[a];
      }
    }
  }
  return out;
}

// Part of the generator along which a force on neck or barrel is spread.
struct Stretch {
  double centre, reach;
};

// Load along the neck: a cosine squared around its centre, so that no edge falls between nodes.
double seat_density(const Stretch &stretch, const double z)
{
  const double s = (z - stretch.centre) / stretch.reach;
  return std::abs(s) < 1 ? 0.5 * (1 + std::cos(M_PI * s)) : 0;
}

Stretch seat_of(const RollGeometry &g)
{
  return {g.seat_centre, std::min(0.5 * g.neck_length, g.half_length + g.neck_length - g.seat_centre)};
}

// The cylinder that a point lies on, without its ends.
Stretch stretch_at(const RollGeometry &g, const double z)
{
  const bool on_neck = g.neck_length > 0 && z > g.half_length;
  const double from  = on_neck ? g.half_length : -g.half_length,
               to = g.half_length + (on_neck ? g.neck_length : 0.), radius = on_neck ? g.neck_radius : g.radius;
  return {z, std::min({radius, z - from, to - z})};
}

struct Seat {
  std::vector<int> node;
  Eigen::VectorXd share;  // sums to 1
  double lever;
};

Seat seat_load(const SectionBody &body, const std::vector<const char *> &groups, const Stretch &stretch)
{
  const GaussRule gauss = gauss_legendre(4);
  Seat seat{{}, Eigen::VectorXd(0), 0};
  std::vector<double> share;
  double sum = 0;
  for (const char *group : groups) {
    const Surface neck       = body.surface(group);
    const auto last          = neck.faces.cols() - 1;
    Eigen::VectorXd of_group = Eigen::VectorXd::Zero(neck.points.rows());
    for (Eigen::Index f = 0; f < neck.faces.rows(); ++f) {
      const double from = neck.points(neck.faces(f, 0), 1), to = neck.points(neck.faces(f, last), 1);
      for (int q = 0; q < 4; ++q) {
        const double s = 0.5 * (1 + gauss.node[q]);
        const double w = gauss.weight[q] * std::abs(to - from) * seat_density(stretch, from + s * (to - from));
        const Eigen::VectorXd N = line_shape(last + 1, s);
        for (Eigen::Index a = 0; a <= last; ++a)
          of_group[neck.faces(f, a)] += w * N[a];
      }
    }
    for (Eigen::Index i = 0; i < of_group.size(); ++i)
      if (of_group[i] != 0) {
        seat.node.push_back(neck.node[std::size_t(i)]);
        share.push_back(of_group[i]);
        sum += of_group[i];
        seat.lever += of_group[i] * neck.points(i, 1);
      }
  }
  if (!(sum > 0))
    throw InputError("a force on a roll lies outside its neck and its barrel");
  seat.share = Eigen::Map<Eigen::VectorXd>(share.data(), Eigen::Index(share.size())) / sum;
  seat.lever /= sum;
  return seat;
}

// The same resultant exactly at z: statics must not depend on a mesh.
Seat moved_to(const double z, const SectionBody &body, Seat seat)
{
  double spread = 0;
  for (std::size_t i = 0; i < seat.node.size(); ++i)
    spread += seat.share[Eigen::Index(i)] * std::pow(body.nodes()(seat.node[i], 1) - seat.lever, 2);
  const double tilt = (z - seat.lever) / spread;
  for (std::size_t i = 0; i < seat.node.size(); ++i)
    seat.share[Eigen::Index(i)] *= 1 + tilt * (body.nodes()(seat.node[i], 1) - seat.lever);
  seat.lever = z;
  return seat;
}

std::vector<int> orders(const FourierOptions &options, const double radius)
{
  const double last = 2 * radius / options.half_width;
  std::vector<int> out;
  for (int m = 0; m <= options.all_orders; ++m)
    out.push_back(m);
  while (out.back() < last)
    out.push_back(int(std::ceil(out.back() * options.ratio)));
  return out;
}

// Axis nodes by ascending z.
std::vector<int> axis_nodes(const SectionBody &body)
{
  std::vector<int> axis = body.group("axis");
  const auto &p         = body.nodes();
  std::sort(axis.begin(), axis.end(), [&](const int a, const int b) { return p(a, 1) < p(b, 1); });
  return axis;
}

// What is zero: by the plane of mid-length, on the axis (for order 1: u_r + u_theta, which stands in the place of
// u_theta there; the innermost line of a body that does not reach the axis is free), and one unknown per rigid
// motion that remains.
std::vector<char> constrained_unknowns(const SectionBody &body, const std::vector<int> &axis, const bool hollow,
                                       const int m, const bool odd, const bool slab)
{
  std::vector<char> held(3 * body.nodes().rows(), 0);
  const auto hold = [&](const std::vector<int> &nodes, const std::vector<Direction> &components) {
    for (const int node : nodes)
      for (const Direction c : components)
        held[3 * node + c] = 1;
  };
  hold(body.group("symmetry.z"), odd ? std::vector<Direction>{u_r, u_theta} : std::vector<Direction>{u_z});
  if (slab)
    hold(body.group("end"), {u_z});
  if (m == 0) {
    if (!hollow)
      hold(axis, {u_r});
    for (std::size_t i = u_theta; i < held.size(); i += 3)
      held[i] = 1;  // twist: nothing drives it
    if (odd && !slab)
      hold({axis.front()}, {u_z});
  } else if (m == 1) {
    if (!hollow)
      hold(axis, {u_theta, u_z});
    hold({odd ? axis.back() : axis.front()}, {u_r});
  } else if (!hollow)
    hold(axis, {u_r, u_theta, u_z});
  return held;
}

// Order 1 on the axis: u_theta = s - u_r with the new unknown s, zero for a single-valued field.
SymmetricSparse with_sum_on_axis(const SymmetricSparse &K, const std::vector<int> &axis)
{
  Eigen::SparseMatrix<double> full, change(K.rows(), K.cols());
  full = K.selfadjointView<Eigen::Upper>();
  change.setIdentity();
  for (const int node : axis)
    change.coeffRef(3 * node + u_theta, 3 * node + u_r) = -1;
  const Eigen::SparseMatrix<double> transformed = change.transpose() * full * change;
  return transformed.triangularView<Eigen::Upper>();
}

struct Free {
  SymmetricSparse K;
  std::vector<int> place, node;  // of each unknown in K, -1: held; of each row
};

Free free_unknowns(const SymmetricSparse &K, const std::vector<char> &held)
{
  Free f;
  f.place.assign(held.size(), -1);
  for (std::size_t i = 0; i < held.size(); ++i)
    if (!held[i]) {
      f.place[i] = int(f.node.size());
      f.node.push_back(int(i) / 3);
    }
  const int n = int(f.node.size());
  std::vector<int> start{0}, rows;
  std::vector<double> values;
  rows.reserve(K.nonZeros());
  values.reserve(K.nonZeros());
  for (int j = 0; j < K.outerSize(); ++j) {
    if (f.place[j] < 0)
      continue;
    for (SymmetricSparse::InnerIterator it(K, j); it; ++it)
      if (f.place[it.row()] >= 0) {
        rows.push_back(f.place[it.row()]);
        values.push_back(it.value());
      }
    start.push_back(int(rows.size()));
  }
  f.K = Eigen::Map<SymmetricSparse>(n, n, int(rows.size()), start.data(), rows.data(), values.data());
  return f;
}

// Rows of L22^-1 times a load on retained unknowns: products of two such give displacements.  theory.md 11
Eigen::MatrixXd half_solved(const Eigen::MatrixXd &lower, const Eigen::MatrixXd &load)
{
  return lower.triangularView<Eigen::Lower>().solve(load);
}

class Condenser {
public:
  Condenser(const SectionBody &section_body, const RollGeometry &geometry, const Eigen::VectorXd &edge,
            const FourierOptions &options)
      : body(section_body), slab(options.slab), axis(axis_nodes(section_body)),
        hollow(body.nodes()(axis.front(), 0) > 0)
  {
    const Surface contact = body.surface("contact");
    surface               = contact.node;
    station_load          = spread(contact, edge);
    Surface line          = body.surface("axis");
    on_axis               = line.node;
    axis_mean             = spread(line, edge);
    if (geometry.neck_length > 0 && geometry.seat_centre > 0)
      seat = seat_load(body, {"neck"}, seat_of(geometry));
    std::vector<const char *> groups{"contact"};
    if (geometry.contact_half_length > 0 && geometry.half_length - geometry.contact_half_length > 1e-9)
      groups.push_back("barrel");
    if (geometry.neck_length > 0)
      groups.push_back("neck");
    for (const double z : options.points)
      points.push_back(moved_to(z, body, seat_load(body, groups, stretch_at(geometry, z))));
  }
  double seat_lever() const
  {
    return seat.node.empty() ? 0 : seat.lever;
  }

  // Adds order m to the response; returns the number of unknowns.
  int add(HarmonicResponse &response, const int m, const bool odd) const
  {
    SymmetricSparse K = body.harmonic_stiffness(m);
    if (m == 1 && !hollow)
      K = with_sum_on_axis(K, axis);
    const Free f = free_unknowns(K, constrained_unknowns(body, axis, hollow, m, odd, slab));
    std::vector<int> retained;
    const Eigen::Index n = station_load.cols();
    // Rows of the loads: surface nodes, then (order 1) axis nodes.
    std::vector<std::pair<int, Eigen::RowVectorXd>> rows;
    const auto keep = [&](const std::vector<int> &nodes, const Eigen::MatrixXd &weights, const bool is_axis) {
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const int place = f.place[3 * nodes[i] + u_r];
        if (place < 0)
          continue;
        Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(2 * n);
        row.segment(is_axis ? n : 0, n) = weights.row(Eigen::Index(i));
        retained.push_back(place);
        rows.emplace_back(place, row);
      }
    };
    keep(surface, station_load, false);
    if (m == 1)
      keep(on_axis, axis_mean, true);
    Eigen::MatrixXd loads(Eigen::Index(rows.size()), m == 1 ? 2 * n : n);
    for (std::size_t i = 0; i < rows.size(); ++i)
      loads.row(Eigen::Index(i)) = rows[i].second.head(loads.cols());

    const CondensingFactor factor(f.K, f.node, retained);
    const Eigen::MatrixXd half = half_solved(factor.schur_factor(), loads);
    response.surface.push_back(half.leftCols(n).transpose() * half.leftCols(n));
    if (m == 1) {
      response.axis = half.rightCols(n).transpose() * half.leftCols(n);
      if (!seat.node.empty())
        add_seat(response, f, factor, retained, loads);
      if (!points.empty())
        add_points(response, f, factor, retained, loads);
    }
    return int(f.node.size());
  }

private:
  // 1 N along theta = 0, the same all around the neck: cos(theta) in u_r, -sin(theta) in u_theta, half each.
  static Eigen::VectorXd force_around(const Seat &neck, const Free &f)
  {
    Eigen::VectorXd load = Eigen::VectorXd::Zero(f.K.rows());
    for (std::size_t i = 0; i < neck.node.size(); ++i) {
      const double part = 0.5 * neck.share[Eigen::Index(i)];
      if (const int place = f.place[3 * neck.node[i] + u_r]; place >= 0)
        load[place] += part;
      if (const int place = f.place[3 * neck.node[i] + u_theta]; place >= 0)
        load[place] -= part;
    }
    return load;
  }

  // Means of the stations, on the surface and on the axis.
  static Eigen::VectorXd station_means(const Eigen::VectorXd &u, const std::vector<int> &retained,
                                       const Eigen::MatrixXd &means)
  {
    Eigen::VectorXd kept(Eigen::Index(retained.size()));
    for (std::size_t i = 0; i < retained.size(); ++i)
      kept[Eigen::Index(i)] = u[retained[i]];
    return means.transpose() * kept;
  }

  void add_seat(HarmonicResponse &response, const Free &f, const CondensingFactor &factor,
                const std::vector<int> &retained, const Eigen::MatrixXd &means) const
  {
    const Eigen::VectorXd mean = station_means(factor.solve(force_around(seat, f)), retained, means);
    response.seat_surface      = mean.head(mean.size() / 2);
    response.seat_axis         = mean.tail(mean.size() / 2);
  }

  void add_points(HarmonicResponse &response, const Free &f, const CondensingFactor &factor,
                  const std::vector<int> &retained, const Eigen::MatrixXd &means) const
  {
    const auto n = means.cols() / 2, p = Eigen::Index(points.size());
    Eigen::MatrixXd load(f.K.rows(), p);
    for (Eigen::Index i = 0; i < p; ++i)
      load.col(i) = force_around(points[std::size_t(i)], f);
    response.point_surface.resize(n, p);
    response.point_axis.resize(n, p);
    response.point_point.resize(p, p);
    for (Eigen::Index i = 0; i < p; ++i) {
      const Eigen::VectorXd u       = factor.solve(load.col(i));
      const Eigen::VectorXd mean    = station_means(u, retained, means);
      response.point_surface.col(i) = mean.head(n);
      response.point_axis.col(i)    = mean.tail(n);
      response.point_point.col(i)   = load.transpose() * u;
    }
  }

  const SectionBody &body;
  bool slab;
  std::vector<int> axis, surface, on_axis;  // axis: the innermost line
  bool hollow;
  Eigen::MatrixXd station_load, axis_mean;
  Seat seat;
  std::vector<Seat> points;
};
}  // namespace

Eigen::VectorXd station_centres(const Eigen::VectorXd &edge)
{
  const auto n = edge.size() - 1;
  return 0.5 * (edge.head(n) + edge.tail(n));
}

Eigen::VectorXd station_lengths(const Eigen::VectorXd &edge)
{
  const auto n = edge.size() - 1;
  return edge.tail(n) - edge.head(n);
}

Eigen::VectorXd stations_of(const SectionBody &body)
{
  const Surface contact = body.surface("contact");
  std::vector<double> z{0};
  for (Eigen::Index f = 0; f < contact.faces.rows(); ++f)
    z.push_back(std::max(contact.points(contact.faces(f, 0), 1),
                         contact.points(contact.faces(f, contact.faces.cols() - 1), 1)));
  std::sort(z.begin(), z.end());
  return Eigen::Map<Eigen::VectorXd>(z.data(), Eigen::Index(z.size()));
}

FourierRoll fourier_roll(const SectionBody &body, const RollGeometry &geometry, const Material &material,
                         const Eigen::VectorXd &edge, const FourierOptions &options, const Progress &progress)
{
  if (!(options.half_width > 0 && options.half_width < 0.2 * geometry.radius))
    throw InputError("the half width of a roll contact must lie between 0 and a fifth of the radius");
  const Eigen::VectorXd mesh = stations_of(body);
  const double end           = mesh[mesh.size() - 1];
  if (edge.size() < 2 || std::abs(edge[0]) > 1e-9 * end || std::abs(edge[edge.size() - 1] - end) > 1e-9 * end)
    throw InputError("the stations must reach from mid-length to the end of the contact");

  FourierRoll roll;
  roll.geometry   = geometry;
  roll.material   = material;
  roll.edge       = edge;
  roll.order      = orders(options, geometry.radius);
  roll.half_width = options.half_width;
  const Condenser condenser(body, geometry, edge, options);
  roll.seat_lever = condenser.seat_lever();
  roll.points     = options.points;
  for (std::size_t i = 0; i < roll.order.size(); ++i) {
    roll.n_unknowns = condenser.add(roll.even, roll.order[i], false);
    if (options.both_sides)
      condenser.add(roll.odd, roll.order[i], true);
    progress.at("harmonics", double(i + 1) / double(roll.order.size()));
  }
  return roll;
}
}  // namespace mill::fem
