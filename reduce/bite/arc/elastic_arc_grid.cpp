#include "reduce/bite/arc/elastic_arc_grid.h"
#include "core/base/errors.h"
#include "reduce/bite/arc/half_plane.h"
#include "reduce/bite/sentence.h"
#include <algorithm>
#include <cmath>
#include <vector>

namespace mill::bite {
Eigen::VectorXd arc_weights(const Eigen::VectorXd &x)
{
  const Eigen::Index n = x.size();
  Eigen::VectorXd w    = Eigen::VectorXd::Zero(n);
  for (Eigen::Index i = 0; i + 1 < n; ++i) {
    w[i] += 0.5 * (x[i + 1] - x[i]);
    w[i + 1] += 0.5 * (x[i + 1] - x[i]);
  }
  return w;
}

namespace {
constexpr double growth = 1.0 / 5;  // of the spacing per spacing

std::vector<double> marched(const ArcEnds &e, const double wide)
{
  const double contact = e.last - e.first, margin = 0.08 * contact;
  // Spacing wanted at a place, least of all wishes for that place.
  const struct {
    double place, spacing;
  } fine[]           = {{e.entry, std::min(wide, (e.last - e.entry) / 50)},
                        {e.last, std::min(wide, (e.last - e.entry) / 50)},
                        {e.exit, std::min(wide, (e.exit - e.first) / 400)},
                        {e.first, std::min(wide, (e.exit - e.first) / 80)},
                        {e.neutral, 0.1 * wide}};
  const auto spacing = [&](const double x) {
    double d = wide;
    for (const auto &f : fine)
      d = std::min(d, f.spacing + growth * std::abs(x - f.place));
    return d;
  };
  std::vector<double> x{e.first - margin};
  while (x.back() < e.last + margin && x.size() < 100000) {
    const double half = spacing(x.back() + 0.5 * spacing(x.back()));  // midpoint of the coming cell
    x.push_back(x.back() + half);
  }
  return x;
}
}  // namespace

Eigen::VectorXd graded_arc(const ArcEnds &ends, const int n)
{
  // The number of points falls with the widest spacing.  Ends of a fixed fineness take a part of them.
  double wide           = 2 * (ends.last - ends.first) / n;
  std::vector<double> x = marched(ends, wide);
  for (int i = 0; i < 30 && std::abs(static_cast<int>(x.size()) - n) > n / 50; ++i) {
    wide *= std::clamp(static_cast<double>(x.size()) / n, 0.7, 1.4);
    if (wide > 0.05 * (ends.last - ends.first)) {
      wide = 0.05 * (ends.last - ends.first);
      x    = marched(ends, wide);
      break;
    }
    x = marched(ends, wide);
  }
  return Eigen::Map<Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

ArcMatrices flexibility_at(const Eigen::VectorXd &x, const Material &roll, const double roll_radius,
                           const ArcFlexibility *given)
{
  ArcMatrices flexibility{half_plane_flexibility(x, roll, roll_radius).influence, half_plane_slope(x, roll)};
  if (!given)
    return flexibility;
  const Eigen::VectorXd &y = given->position;
  const Eigen::Index m     = y.size();
  if (m < 2 || !(x[0] >= y[0] && x[x.size() - 1] <= y[m - 1]))
    throw SolverError(
        {"roll bite: the elastic arc leaves the surface whose flexibility is given",
         sentence("contact with its margin from ", x[0] * 1e3, " to ", x[x.size() - 1] * 1e3, " mm, flexibility (",
                  given->method, ") from ", m > 0 ? y[0] * 1e3 : 0, " to ", m > 0 ? y[m - 1] * 1e3 : 0, " mm"),
         "the arc grows by flattening", "give the flexibility over a longer piece of the surface", ""});
  // Per force: the difference of two bodies under a line load is smooth, the logarithm has cancelled.
  Eigen::MatrixXd difference  = given->influence - half_plane_flexibility(y, roll, roll_radius).influence;
  const Eigen::VectorXd w_old = arc_weights(y), w = arc_weights(x);
  for (Eigen::Index j = 0; j < m; ++j)
    difference.col(j) /= w_old[j];
  // Rows of the interpolation, straight between the given points.
  Eigen::MatrixXd between = Eigen::MatrixXd::Zero(x.size(), m);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    Eigen::Index c    = std::upper_bound(y.data(), y.data() + m, x[i]) - y.data();
    c                 = std::clamp<Eigen::Index>(c, 1, m - 1);
    const double s    = (x[i] - y[c - 1]) / (y[c] - y[c - 1]);
    between(i, c - 1) = 1 - s;
    between(i, c)     = s;
  }
  const Eigen::MatrixXd more = between * difference * between.transpose() * w.asDiagonal();
  flexibility.value += more;
  for (Eigen::Index i = 1; i + 1 < x.size(); ++i) {  // slopes of the parabola through three points
    const double a = x[i] - x[i - 1], b = x[i + 1] - x[i];
    flexibility.slope.row(i) +=
        ((more.row(i) - more.row(i - 1)) * (b / a) + (more.row(i + 1) - more.row(i)) * (a / b)) / (a + b);
  }
  return flexibility;
}
}  // namespace mill::bite
