#include "fem/bearing/chock_flexibility.h"
#include "core/numerics/gauss.h"
#include "core/process/parallel.h"
#include "fem/body/harmonic_body.h"
#include "fem/body/held_stiffness.h"
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>

namespace mill::fem {
namespace {
const std::vector<int> none;

const std::vector<int> &group_or_none(const ElasticBody &body, const std::string &name)
{
  try {
    return body.group(name);
  } catch (const std::out_of_range &) {
    return none;
  }
}

// Where a contact line's load acts: a quadrature point of the surface around the axis.
struct LinePoint {
  double psi, x;     // azimuth; place along the contact line from mid-roller
  double weight;     // d psi d x
  const int *nodes;  // of the face, in its surface
  std::array<double, 9> shape;
};

// Visits the quadrature points of one row's contact line on the meshed half.
template <class Visit>
void each_line_point(const Surface &surface, const RacewayLine &line, const double length, const Visit &visit)
{
  const int side = surface.faces.cols() == 4 ? 2 : 3;
  if (side != 3)
    throw std::logic_error("the block is meshed with quadratic elements");
  const GaussRule gauss = gauss_legendre(4);  // a wave of three elements and a polynomial to 1e-6
  std::vector<int> nodes(9);
  for (Eigen::Index f = 0; f < surface.faces.rows(); ++f) {
    Eigen::Matrix<double, 9, 3> X;
    for (int k = 0; k < 9; ++k) {
      nodes[std::size_t(k)] = surface.faces(f, k);
      X.row(k)              = surface.points.row(surface.faces(f, k));
    }
    const Eigen::RowVector3d middle = X.row(4);
    const Eigen::Vector2d in_section(middle.head<2>().norm(), middle[2]);
    if (std::abs((in_section - line.middle).dot(line.along)) > 0.5 * length ||
        std::abs((in_section - line.middle).dot(line.normal)) > 0.1 * length)
      continue;
    for (int gt = 0; gt < 4; ++gt)
      for (int gs = 0; gs < 4; ++gs) {
        const double s = 0.5 * (1 + gauss.node[gs]), t = 0.5 * (1 + gauss.node[gt]);
        const Eigen::Vector3d Ns = line_shape(3, s), Nt = line_shape(3, t);
        const Eigen::Vector3d Ds(4 * s - 3, 4 - 8 * s, 4 * s - 1), Dt(4 * t - 3, 4 - 8 * t, 4 * t - 1);
        LinePoint point;
        Eigen::RowVector3d position = Eigen::RowVector3d::Zero(), by_s = position, by_t = position;
        for (int j = 0; j < 3; ++j)
          for (int i = 0; i < 3; ++i) {
            const int k                 = i + 3 * j;
            point.shape[std::size_t(k)] = Ns[i] * Nt[j];
            position += Ns[i] * Nt[j] * X.row(k);
            by_s += Ds[i] * Nt[j] * X.row(k);
            by_t += Ns[i] * Dt[j] * X.row(k);
          }
        const double r = position.head<2>().norm(), c = position[0] / r, sn = position[1] / r;
        const auto around = [&](const Eigen::RowVector3d &d) { return (c * d[1] - sn * d[0]) / r; };
        const auto along  = [&](const Eigen::RowVector3d &d) {
          return (c * d[0] + sn * d[1]) * line.along[0] + d[2] * line.along[1];
        };
        point.psi    = std::atan2(position[1], position[0]);
        point.x      = (Eigen::Vector2d(r, position[2]) - line.middle).dot(line.along);
        point.weight = 0.25 * gauss.weight[gs] * gauss.weight[gt] *
                       std::abs(around(by_s) * along(by_t) - around(by_t) * along(by_s));
        point.nodes = nodes.data();
        visit(point);
      }
  }
}

// (3 N, k) N: loads along the normal of one row, of density amplitudes(psi, x) (k) N per radian and metre.
template <class Amplitudes>
Eigen::MatrixXd row_loads(const ElasticBody &body, const Surface &surface, const RacewayLine &line,
                          const double length, const Eigen::Index k, const Amplitudes &amplitudes)
{
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(3 * body.nodes().rows(), k);
  each_line_point(surface, line, length, [&](const LinePoint &p) {
    const Eigen::RowVectorXd density = p.weight * amplitudes(p.psi, p.x);
    const Eigen::Vector3d normal(line.normal[0] * std::cos(p.psi), line.normal[0] * std::sin(p.psi),
                                 line.normal[1]);
    for (std::size_t a = 0; a < 9; ++a)
      out.middleRows<3>(3 * surface.node[std::size_t(p.nodes[a])]) += p.shape[a] * normal * density;
  });
  return out;
}

std::vector<char> supports(const ElasticBody &body, const bool sine, const bool odd)
{
  std::vector<char> held(std::size_t(3 * body.nodes().rows()), 0);
  const auto hold = [&](const std::vector<int> &nodes, const std::vector<int> &components) {
    for (const int node : nodes)
      for (const int c : components)
        held[std::size_t(3 * node + c)] = 1;
  };
  hold(group_or_none(body, "support"), {0, 1, 2});
  hold(group_or_none(body, "barrel"), {0, 1, 2});
  hold(body.group("symmetry.y"), sine ? std::vector<int>{0, 2} : std::vector<int>{1});
  hold(group_or_none(body, "symmetry.z"), odd ? std::vector<int>{0, 1} : std::vector<int>{2});
  return held;
}

// Amplitudes of a unit roller load in its harmonics, per radian: 1/(2 pi), then 1/pi.
double per_radian(const int m)
{
  return (m == 0 ? 0.5 : 1) / M_PI;
}

// (3 N, (orders) rows_meshed modes): index ((m - first) rows + r) modes + a over the rows that are meshed.
Eigen::MatrixXd harmonic_loads(const ElasticBody &body, const RingSection &cup, const bool halved, const bool sine,
                               const int harmonics, const int modes)
{
  const int first = sine ? 1 : 0, n_rows = int(cup.raceways.size()), first_row = halved ? n_rows / 2 : 0;
  const int meshed = n_rows - first_row, orders = harmonics - first;
  Eigen::MatrixXd out(3 * body.nodes().rows(), orders * meshed * modes);
  const Surface surface = body.surface("contact");
  for (int r = 0; r < meshed; ++r) {
    const Eigen::MatrixXd loads = row_loads(
        body, surface, cup.raceways[std::size_t(first_row + r)], cup.length, orders * modes,
        [&](const double psi, const double x) {
          const Eigen::VectorXd P = legendre(2 * x / cup.length, modes);
          Eigen::RowVectorXd f(orders * modes);
          for (int m = first; m < harmonics; ++m)
            for (int a = 0; a < modes; ++a)
              f[(m - first) * modes + a] =
                  per_radian(m) * (sine ? std::sin(m * psi) : std::cos(m * psi)) * (2 * a + 1) / cup.length * P[a];
          return f;
        });
    for (int m = 0; m < orders; ++m)
      out.middleCols((m * meshed + r) * modes, modes) = loads.middleCols(m * modes, modes);
  }
  return out;
}

// Response to loads of both halves from the even and the odd one about the mid-plane.  The mirror image of row r
// is row n - 1 - r, and of P_a(x) it is (-1)^a P_a(x), since x runs towards greater z on both sides.
Eigen::MatrixXd both_halves(const Eigen::MatrixXd &even, const Eigen::MatrixXd &odd, const int orders,
                            const int rows, const int modes)
{
  struct Image {
    Eigen::Index from;
    double side, sign;
  };
  std::vector<Image> images;
  for (int m = 0; m < orders; ++m)
    for (int r = 0; r < rows; ++r)
      for (int a = 0; a < modes; ++a) {
        const bool mirrored = r < rows / 2;
        const int meshed    = mirrored ? rows / 2 - 1 - r : r - rows / 2;
        images.push_back(
            {(m * (rows / 2) + meshed) * modes + a, mirrored ? -1. : 1., mirrored && a % 2 == 1 ? -1. : 1.});
      }
  const auto n = Eigen::Index(images.size());
  Eigen::MatrixXd out(n, n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < n; ++i) {
      const Image &a = images[std::size_t(i)], &b = images[std::size_t(j)];
      out(i, j) = 0.5 * a.sign * b.sign * (even(a.from, b.from) + a.side * b.side * odd(a.from, b.from));
    }
  return out;
}
}  // namespace

ChockFlexibility chock_flexibility(const RingSection &cup, const MeshFile &mesh, const bool halved,
                                   const Material &material, const int harmonics, const int modes,
                                   const int threads)
{
  const ElasticBody body(mesh, material, 2);
  const SymmetricSparse &K = body.stiffness();
  const int rows           = int(cup.raceways.size());
  // Even and odd about the mid-plane by cosine and sine; a block that is not halved has no odd one.
  std::array<Eigen::MatrixXd, 4> symmetry;
  std::array<int, 4> n_unknowns{};
  share_tasks(4, threads, [&](const long i) {
    const bool sine = i >= 2, odd = i % 2 == 1;
    if (harmonics == (sine ? 1 : 0) || (odd && !halved))
      return;
    const Eigen::MatrixXd loads = harmonic_loads(body, cup, halved, sine, harmonics, modes);
    const HeldStiffness held(K, supports(body, sine, odd));
    n_unknowns[std::size_t(i)] = held.n_unknowns();
    symmetry[std::size_t(i)]   = 2 * held.flexibility(loads);  // the other side of the load line does as much work
  });
  ChockFlexibility out;
  out.harmonics   = harmonics;
  const auto side = [&](const std::size_t even, const int orders) -> Eigen::MatrixXd {
    if (orders == 0)
      return Eigen::MatrixXd(0, 0);
    return halved ? both_halves(symmetry[even], symmetry[even + 1], orders, rows, modes) : symmetry[even];
  };
  out.cosine     = side(0, harmonics);
  out.sine       = side(2, harmonics - 1);
  out.n_unknowns = *std::max_element(n_unknowns.begin(), n_unknowns.end());
  return out;
}

void write_chock_vtu(const std::string &path, const RingSection &cup, const MeshFile &mesh, const bool halved,
                     const Material &material, const Eigen::MatrixXd &load)
{
  const ElasticBody body(mesh, material, 2);
  const Surface surface = body.surface("contact");
  const int rows = int(cup.raceways.size()), Z = int(load.cols());
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * body.nodes().rows());
  for (int r = halved ? rows / 2 : 0; r < rows; ++r)
    force += row_loads(body, surface, cup.raceways[std::size_t(r)], cup.length, 1, [&](const double psi, double) {
      // Each roller over its share of the circumference; the mean of the four (two) mirror images.
      const int j = int(std::lround(psi / (2 * M_PI) * Z)) % Z, mirrored = (Z - j) % Z;
      double sum = load(r, j) + load(r, mirrored);
      if (halved)
        sum = 0.5 * (sum + load(rows - 1 - r, j) + load(rows - 1 - r, mirrored));
      return Eigen::RowVectorXd::Constant(1, 0.5 * sum * Z / (2 * M_PI) / cup.length);
    });
  const HeldStiffness held(body.stiffness(), supports(body, false, false));
  body.write_vtu(path, held.displacement(force), Eigen::VectorXd::Zero(body.nodes().rows()));
}
}  // namespace mill::fem
