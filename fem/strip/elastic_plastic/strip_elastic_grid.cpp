#include "fem/strip/elastic_plastic/strip_elastic_grid.h"
#include <algorithm>
#include <cmath>

namespace mill::fem {
using Eigen::VectorXd;

const GaussRows &gauss_rows()
{
  static const double d = std::sqrt(0.15);
  static const GaussRows rule{{0.5 - d, 0.5, 0.5 + d}, {5. / 18, 8. / 18, 5. / 18}};
  return rule;
}

ElasticGrid elastic_grid(const std::vector<double> &corners, const int n_through, const double from,
                         const double to)
{
  ElasticGrid g;
  g.n_along        = int(corners.size()) - 1;
  g.n_through      = n_through;
  const int spines = 2 * g.n_along + 1, rows = 2 * n_through + 1, last = spines - 1;
  g.x.resize(spines);
  g.tributary.setZero(spines);
  for (int i = 0; i < spines; ++i)
    g.x[i] = i % 2 ? 0.5 * (corners[i / 2] + corners[i / 2 + 1]) : corners[i / 2];
  for (int I = 0; I < g.n_along; ++I) {
    const double h = corners[I + 1] - corners[I];
    g.tributary[2 * I] += h / 6;
    g.tributary[2 * I + 1] += 4 * h / 6;
    g.tributary[2 * I + 2] += h / 6;
  }
  g.may_touch.assign(spines, 0);
  g.velocity_of.assign(2 * spines * rows, -1);
  g.height_of.assign(spines * n_through, -1);
  g.pressure_of.assign(3 * g.n_along * n_through, -1);
  g.state_of.assign(12 * g.n_along * n_through, -1);
  g.force_of.assign(spines, -1);
  // Along the strip, so that a good order of elimination is easy to find.
  int n = 0;
  for (int i = 0; i < spines; ++i) {
    const bool end = i == 0 || i == last;
    for (int j = 0; j < rows; ++j) {
      if (!end)
        g.velocity_of[2 * (i * rows + j)] = n++;
      if (!end && j > 0)
        g.velocity_of[2 * (i * rows + j) + 1] = n++;
      if (j > 0 && j % 2 == 0)
        g.height_of[i * n_through + j / 2 - 1] = n++;
    }
    g.may_touch[i] = !end && g.x[i] > from && g.x[i] < to;
    if (g.may_touch[i])
      g.force_of[i] = n++;
    if (i % 2)
      for (int J = 0; J < n_through; ++J) {
        for (int m = 0; m < 3; ++m)
          g.pressure_of[3 * (i / 2 * n_through + J) + m] = n++;
        for (int m = 0; m < 12; ++m)
          g.state_of[12 * (i / 2 * n_through + J) + m] = n++;
      }
  }
  g.n_unknowns = n + n_bulk;
  // At both ends the strip moves as a whole.
  for (int j = 0; j < rows; ++j) {
    g.velocity_of[2 * j]                 = g.bulk(Bulk::entry_speed);
    g.velocity_of[2 * (last * rows + j)] = g.bulk(Bulk::exit_speed);
  }
  return g;
}

std::vector<double> elastic_lines(const std::vector<double> &fixed, const double from, const double to,
                                  const double size, const std::vector<ElasticFocus> &foci)
{
  const auto spacing = [&](const double x) {
    const double away = std::max({0., from - x, x - to});
    double h          = away > 0 ? std::max(size, std::min(0.25, size + 0.3 * away)) : size;
    for (const ElasticFocus &f : foci)
      h = std::min(h, f.size + 0.2 * std::max({0., f.from - x, x - f.to}));
    return h;
  };
  std::vector<double> out{fixed.front()};
  for (std::size_t part = 1; part < fixed.size(); ++part) {
    const int n        = 10000;
    const double begin = fixed[part - 1], step = (fixed[part] - begin) / n;
    std::vector<double> gathered{0};
    for (int i = 0; i < n; ++i)
      gathered.push_back(gathered.back() + step / spacing(begin + (i + 0.5) * step));
    const int elements = int(std::ceil(gathered.back()));
    for (int line = 1; line < elements; ++line) {
      const double wanted = gathered.back() * line / elements;
      const auto above    = std::upper_bound(gathered.begin(), gathered.end(), wanted);
      const double share  = (wanted - *(above - 1)) / (*above - *(above - 1));
      out.push_back(begin + step * (double(above - gathered.begin()) - 1 + share));
    }
    out.push_back(fixed[part]);
  }
  return out;
}

double stretch(const ElasticGrid &g, const VectorXd &u)
{
  return g.moves()
             ? (u[g.bulk(Bulk::exit_end)] - u[g.bulk(Bulk::entry_end)]) / (g.x[g.exit_spine] - g.x[g.entry_spine])
             : 1;
}

ElasticGrid moved(const ElasticGrid &g, const VectorXd &u)
{
  ElasticGrid out = g;
  if (!g.moves())
    return out;
  const double entry = u[g.bulk(Bulk::entry_end)] - g.x[g.entry_spine],
               exit  = u[g.bulk(Bulk::exit_end)] - g.x[g.exit_spine];
  for (int i = 0; i < g.x.size(); ++i)
    out.x[i] += g.share(i)[0] * entry + g.share(i)[1] * exit;
  out.tributary.setZero();
  for (int i = 0; i + 2 < g.x.size(); i += 2)
    for (int a = 0; a < 3; ++a)
      out.tributary[i + a] += (a == 1 ? 4 : 1) * (out.x[i + 2] - out.x[i]) / 6;
  return out;
}

int thinnest_spine(const ElasticGrid &g, const VectorXd &u, const int before)
{
  int thinnest    = before;
  const auto high = [&](const int i) { return u[g.height(i, g.n_through)]; };
  if (before == 0)
    for (int i = 0; i < g.x.size(); ++i)
      if (g.force(i) >= 0 && g.x[i] <= 1e-9)
        thinnest = i;
  for (int i = 0; i < g.x.size(); ++i)
    if (g.force(i) >= 0 && u[g.force(i)] > 1e-2 * g.tributary[i] && high(i) < high(thinnest))
      thinnest = i;
  return thinnest;
}

namespace {
// Place of an abscissa in a grid: element and share of it.
std::pair<int, double> locate(const ElasticGrid &g, const double x)
{
  int I = 0;
  while (I + 1 < g.n_along && g.x[2 * I + 2] < x)
    ++I;
  const double t = (x - g.x[2 * I]) / (g.x[2 * I + 2] - g.x[2 * I]);
  return {I, std::clamp(t, 0., 1.)};
}
}  // namespace

VectorXd interpolated(const ElasticGrid &from, const VectorXd &u, const ElasticGrid &to)
{
  VectorXd out     = VectorXd::Zero(to.n_unknowns);
  out.tail(n_bulk) = u.tail(n_bulk);
  const auto value = [&](const int id) { return id < 0 ? 0 : u[id]; };
  // Rows keep their share of the thickness: both grids divide it evenly.
  const auto row = [&](const double share) {
    const double s = share * from.n_through;
    const int J    = std::min(int(s + 1e-12), from.n_through - 1);
    return std::pair(J, s - J);
  };
  for (int i = 0; i < to.x.size(); ++i) {
    const auto [I, t] = locate(from, to.x[i]);
    for (int j = 0; j <= 2 * to.n_through; ++j) {
      const auto [J, s] = row(0.5 * j / to.n_through);
      for (int c = 0; c < 2; ++c) {
        const int id = to.velocity(i, j, c);
        if (id < 0 || id >= to.n_unknowns - n_bulk)
          continue;
        for (int a = 0; a < 3; ++a)
          for (int b = 0; b < 3; ++b)
            out[id] += along_shape(t, a) * along_shape(s, b) * value(from.velocity(2 * I + a, 2 * J + b, c));
      }
      if (j > 0 && j % 2 == 0)
        for (int a = 0; a < 3; ++a)
          out[to.height(i, j / 2)] += along_shape(t, a) * ((1 - s) * value(from.height(2 * I + a, J)) +
                                                           s * value(from.height(2 * I + a, J + 1)));
    }
    if (to.force(i) >= 0)  // pressures, linear between the spines
      for (int k = 0; k < 2; ++k) {
        const int node     = 2 * I + (t > 0.5) + k;
        const double share = 2 * t - (t > 0.5), weight = k ? share : 1 - share;
        out[to.force(i)] += weight * to.tributary[i] * value(from.force(node)) / from.tributary[node];
      }
    if (i % 2)
      for (int J = 0; J < to.n_through; ++J) {
        const auto [K, s] = row((J + 0.5) / to.n_through);
        const int middle  = to.pressure(i / 2, J, 0);
        for (int m = 0; m < 3; ++m)
          out[middle] += (m == 0 ? 1 : m == 1 ? t - 0.5 : s - 0.5) * u[from.pressure(I, K, m)];
      }
  }
  return out;
}
}  // namespace mill::fem
