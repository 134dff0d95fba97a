#include "meshes/strip/strip_flow.h"
#include "core/base/errors.h"
#include "meshes/common/series.h"
#include <algorithm>
#include <cmath>

namespace mill::meshes {
namespace {
// Shares of the arc, 0 at the line of centres to 1, from a size that grows evenly away from ends and neutral
// point.
std::vector<double> arc_lines(const StripBlock &b)
{
  const double reach = 0.3;  // of the arc, on which the size grows from finest to largest
  const auto size    = [&](const double t) {
    const double away = std::min({t, 1 - t, std::abs(t - b.neutral)});
    return b.finest + (1 - b.finest) * std::min(1., away / reach);
  };
  const int n = 4000;
  std::vector<double> gathered{0}, out{0};
  for (int i = 0; i < n; ++i)
    gathered.push_back(gathered.back() + 1 / size((i + 0.5) / n));
  for (int line = 1; line < b.along; ++line) {
    const double wanted = gathered.back() * line / b.along;
    const auto above    = std::upper_bound(gathered.begin(), gathered.end(), wanted);
    const double part   = (wanted - *(above - 1)) / (*above - *(above - 1));
    out.push_back((double(above - gathered.begin()) - 1 + part) / n);
  }
  out.push_back(1);
  return out;
}

// n lines of a geometric series that begins with `first` and fills `length`, from 0.
std::vector<double> growing_lines(const double first, const double length, const int n)
{
  const double ratio = ratio_filling(length, first, n);
  std::vector<double> out{0};
  double element = first;
  for (int i = 0; i < n; ++i, element *= ratio)
    out.push_back(out.back() + element);
  for (double &x : out)
    x *= length / out.back();
  return out;
}

Eigen::VectorXd in_order(const std::vector<double> &values)
{
  return Eigen::Map<const Eigen::VectorXd>(values.data(), Eigen::Index(values.size()));
}

Eigen::VectorXd backwards(const std::vector<double> &values)
{
  return in_order(values).reverse();
}
}  // namespace

StripBlock strip_block(const Strip &strip, const double roll_radius, const int along, const int through)
{
  const double h1 = strip.entry_thickness, h2 = strip.exit_thickness, dh = h1 - h2;
  StripBlock b;
  b.entry_thickness = h1;
  b.exit_thickness  = h2;
  b.arc_length      = std::sqrt(dh * (roll_radius - 0.25 * dh));
  b.outside         = b.arc_length < h1 + h2 ? 1.5 * h1 : h1;
  b.along           = along;
  b.through         = through;
  const double mu   = plain_coefficient(strip.friction);
  if (mu > 0) {  // as theory.md (8.7), without tensions
    const double root = std::sqrt(roll_radius / h2), angle = std::sqrt(dh / roll_radius);
    const double half = std::atan(root * angle) - std::log(h1 / h2) / (4 * mu * root);
    b.neutral         = std::clamp(std::tan(half / 2) / (root * angle), 0.1, 0.5);
  }
  return b;
}

StripLines strip_lines(const StripBlock &b)
{
  if (!(b.along >= 4 && b.along % 4 == 0 && b.through >= 1))
    throw InputError("the mesh of the strip needs a multiple of 4 elements along the arc, not " +
                     std::to_string(b.along) + ", and one or more through half the thickness");
  if (!(b.exit_thickness > 0 && b.entry_thickness > b.exit_thickness && b.arc_length > 0 && b.outside > 0))
    throw InputError("the mesh of the strip needs an exit thinner than the entry and positive lengths");
  const std::vector<double> arc = arc_lines(b);
  const int outside_lines       = std::max(1, b.along / 4);
  const auto inlet  = growing_lines(b.arc_length * (1 - arc[arc.size() - 2]), b.outside, outside_lines);
  const auto outlet = growing_lines(b.arc_length * arc[1], b.outside, outside_lines);
  return {backwards(inlet), (1 - backwards(arc).array()).matrix(), in_order(outlet),
          Eigen::VectorXd::LinSpaced(b.through + 1, 0, 1)};
}
}  // namespace mill::meshes
