#include "fem/stack/roll_kernel.h"
#include "core/base/errors.h"
#include "core/numerics/gauss.h"
#include "reduce/chain/beam_shapes.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

namespace mill::fem {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double same_place = 1e-6;  // m

// From answers to even and odd loads on one side: those to loads on both, from negative to positive z.
MatrixXd whole_roll(const MatrixXd &even, const MatrixXd &odd)
{
  const Index n = even.rows(), k = even.cols();
  MatrixXd out(2 * n, 2 * k);
  const MatrixXd near = 0.5 * (even + odd), far = 0.5 * (even - odd);
  out.bottomRightCorner(n, k) = near;
  out.topLeftCorner(n, k)     = near.reverse();
  out.bottomLeftCorner(n, k)  = far.rowwise().reverse();
  out.topRightCorner(n, k)    = far.colwise().reverse();
  return out;
}

VectorXd both_ways(const VectorXd &z, const bool with_zero)
{
  const Index skipped = with_zero ? 1 : 0, n = z.size();
  VectorXd out(2 * n - skipped);
  out << -z.reverse(), z.tail(n - skipped);
  return out;
}

double shaft_diameter(const StackRoll &roll, const double z)
{
  for (const StackSection &section : roll.sections)
    if (z > section.from && z < section.to)
      return section.diameter;
  throw InputError("roll " + roll.name + ": its sections leave a gap");
}

// Places of integration along a shaft: between any two of stations, points and steps.
struct ShaftPoint {
  double z, weight, bending, shear;  // m, m, N m2, N
};

std::vector<ShaftPoint> shaft_points(const StackRoll &roll, const VectorXd &edge, const VectorXd &point)
{
  std::vector<double> breaks(edge.begin(), edge.end());
  breaks.insert(breaks.end(), point.begin(), point.end());
  for (const StackSection &section : roll.sections)
    breaks.insert(breaks.end(), {section.from, section.to});
  std::sort(breaks.begin(), breaks.end());
  const GaussRule gauss = gauss_legendre(3);  // products of two moments are of the power 4
  std::vector<ShaftPoint> points;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double from = breaks[i], length = breaks[i + 1] - from;
    if (length < 1e-12)
      continue;
    const auto section = reduce::round_section(shaft_diameter(roll, from + length / 2), roll.material);
    for (int g = 0; g < 3; ++g)
      points.push_back(
          {from + length * (1 + gauss.node[g]) / 2, length * gauss.weight[g] / 2, section.bending, section.shear});
  }
  return points;
}

// Moment and shear force of the shaft on a support at either end under 1 N from a to b.
std::array<double, 2> moment_and_shear(const std::array<double, 2> &ends, const double a, const double b,
                                       const double z)
{
  const double reaction = (ends[1] - (a + b) / 2) / (ends[1] - ends[0]);
  double left = 0, lever = 0;  // force left of z, and its moment about z
  if (z >= b) {
    left  = 1;
    lever = z - (a + b) / 2;
  } else if (z > a) {
    left  = (z - a) / (b - a);
    lever = left * (z - a) / 2;
  }
  return {reaction * (z - ends[0]) - lever, reaction - left};
}

// Virtual work of all pairs of unit forces on the stations and points, (51.19): exact to the last digits, which a
// stiffness matrix of short elements is not.
MatrixXd shaft_flexibility(const StackRoll &roll, const VectorXd &edge, const VectorXd &point)
{
  const Index M = edge.size() - 1, n = M + point.size();
  const auto along           = shaft_points(roll, edge, point);
  std::array<double, 2> ends = {roll.sections.front().from, roll.sections.back().to};
  MatrixXd moments(Index(along.size()), n), shears(Index(along.size()), n);
  for (Index i = 0; i < n; ++i)
    for (Index g = 0; g < moments.rows(); ++g) {
      const ShaftPoint &station = along[std::size_t(g)];
      const double a = i < M ? edge[i] : point[i - M], b = i < M ? edge[i + 1] : a;
      const auto [moment, shear] = moment_and_shear(ends, a, b, station.z);
      moments(g, i)              = moment * std::sqrt(station.weight / station.bending);
      shears(g, i)               = shear * std::sqrt(station.weight / station.shear);
    }
  return moments.transpose() * moments + shears.transpose() * shears;
}
}  // namespace

MatrixXd RollKernel::summed(const VectorXd &weights) const
{
  const Index M = edge.size() - 1;
  if (!roll)
    return MatrixXd::Zero(M, M);
  MatrixXd even = MatrixXd::Zero(M / 2, M / 2), odd = even;
  for (Index s = 0; s < weights.size(); ++s) {
    even += weights[s] * roll->even.surface[std::size_t(s)];
    odd += weights[s] * roll->odd.surface[std::size_t(s)];
  }
  return whole_roll(even, odd);
}

const MatrixXd &RollKernel::remembered(const std::array<double, 3> &key,
                                       const std::function<VectorXd()> &weights) const
{
  const std::lock_guard<std::mutex> lock(sums->access);
  const auto known = sums->known.find(key);
  return known != sums->known.end() ? known->second : sums->known.emplace(key, summed(weights())).first->second;
}

const MatrixXd &RollKernel::around(const double angle) const
{
  constexpr double same_angle = 1e-12;  // rad, rounding of the places of rolls
  return remembered({0, std::round(angle / same_angle), 0},
                    [&] { return roll ? angle_weights(roll->order, angle) : VectorXd(); });
}

const MatrixXd &RollKernel::under_itself(const double half_width, const PatchPressure pressure) const
{
  return remembered({1, half_width, double(pressure)}, [&] {
    return roll ? own_weights(roll->order, roll->geometry.radius, half_width, pressure) : VectorXd();
  });
}

Index RollKernel::place_of(const double z) const
{
  for (Index p = 0; p < point.size(); ++p)
    if (std::abs(point[p] - z) < same_place)
      return p;
  throw std::logic_error("a roll of a stack was condensed without one of its points");
}

RollKernel fourier_kernel(std::shared_ptr<const FourierRoll> roll)
{
  RollKernel kernel;
  kernel.edge      = both_ways(roll->edge, true);
  kernel.point     = both_ways(roll->points, false);
  const auto &even = roll->even;
  const auto &odd  = roll->odd;
  const Index M = kernel.edge.size() - 1, P = kernel.point.size();
  kernel.bending.resize(M + P, M + P);
  kernel.axis.resize(M, M + P);
  kernel.bending.topLeftCorner(M, M) = whole_roll(even.surface[1], odd.surface[1]);
  kernel.axis.leftCols(M)            = whole_roll(even.axis, odd.axis);
  if (P > 0) {
    kernel.bending.topRightCorner(M, P)    = whole_roll(even.point_surface, odd.point_surface);
    kernel.bending.bottomLeftCorner(P, M)  = kernel.bending.topRightCorner(M, P).transpose();
    kernel.bending.bottomRightCorner(P, P) = whole_roll(even.point_point, odd.point_point);
    kernel.axis.rightCols(P)               = whole_roll(even.point_axis, odd.point_axis);
  }
  kernel.roll = std::move(roll);
  return kernel;
}

RollKernel beam_kernel(const StackRoll &roll, const double longest)
{
  RollKernel kernel;
  const Index M = Index(std::ceil(roll.length / longest));
  kernel.edge   = VectorXd::LinSpaced(M + 1, -roll.length / 2, roll.length / 2);
  std::set<double> points;
  for (const StackSupport &support : roll.supports)
    points.insert(support.z);
  for (const StackLoad &load : roll.loads)
    points.insert(load.z);
  kernel.point.resize(Index(points.size()));
  std::copy(points.begin(), points.end(), kernel.point.begin());
  kernel.bending = shaft_flexibility(roll, kernel.edge, kernel.point);
  kernel.axis    = kernel.bending.topRows(M);
  return kernel;
}

VectorXd points_of(const StackRoll &roll)
{
  std::vector<double> z;
  for (const StackSupport &support : roll.supports)
    z.push_back(std::abs(support.z));
  for (const StackLoad &load : roll.loads)
    z.push_back(std::abs(load.z));
  std::sort(z.begin(), z.end());
  z.erase(std::unique(z.begin(), z.end(), [](const double a, const double b) { return b - a < same_place; }),
          z.end());
  return Eigen::Map<VectorXd>(z.data(), Index(z.size()));
}

std::optional<RollGeometry> solid_of(const StackRoll &roll)
{
  std::vector<StackSection> sections;  // neighbours of one diameter joined
  for (const StackSection &section : roll.sections)
    if (!sections.empty() && std::abs(sections.back().diameter - section.diameter) < same_place)
      sections.back().to = section.to;
    else
      sections.push_back(section);
  const double end = sections.back().to, barrel = roll.length / 2;
  const auto same = [](const double a, const double b) { return std::abs(a - b) < same_place; };
  if (!same(sections.front().from, -end))
    return std::nullopt;
  RollGeometry g;
  g.radius = roll.diameter / 2;
  if (sections.size() == 1 && same(sections[0].diameter, roll.diameter)) {
    g.half_length = end;
    if (end > barrel + same_place)
      g.contact_half_length = barrel;
    return g;
  }
  if (sections.size() != 3 || !same(sections[1].diameter, roll.diameter) || !same(sections[1].to, barrel) ||
      !same(sections[1].from, -barrel) || !same(sections[0].diameter, sections[2].diameter) ||
      sections[0].diameter > roll.diameter)
    return std::nullopt;
  g.half_length = barrel;
  g.neck_radius = sections[0].diameter / 2;
  g.neck_length = end - barrel;
  return g;
}

double condensed_half_width(const RollGeometry &geometry)
{
  return geometry.radius / 50;
}
}  // namespace mill::fem
