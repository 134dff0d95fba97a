#include "report/plot/heat_map.h"
#include "report/plot/svg.h"
#include "report/plot/ticks.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
constexpr int hues = 8;
}  // namespace

Eigen::VectorXd cell_borders(const Eigen::VectorXd &positions)
{
  Eigen::VectorXd edge(positions.size() + 1);
  edge[0]                = positions[0];
  edge[positions.size()] = positions[positions.size() - 1];
  for (Eigen::Index i = 1; i < positions.size(); ++i)
    edge[i] = 0.5 * (positions[i - 1] + positions[i]);
  return edge;
}

std::string heat_map(const HeatMap &map)
{
  const double left = 64, right = map.width - 110, top = 26, bottom = map.height - 44;
  Svg svg(map.width, map.height,
          map.title + ": " + map.quantity + " over " + map.x.quantity + " and " + map.y.quantity);
  svg.text(34, 15, map.title, "title");
  const Eigen::Index n = map.at_x.size(), m = map.at_y.size();
  const double peak = map.value.size() > 0 ? map.value.maxCoeff() : 0;
  if (n < 2 || m < 2 || !(peak > 0)) {
    svg.text((left + right) / 2, (top + bottom) / 2, "nothing touches", "t", Anchor::middle);
    return svg.str();
  }
  const Eigen::VectorXd x = cell_borders(map.at_x), y = cell_borders(map.at_y);
  const auto to_x = [&](const double v) { return left + (v - x[0]) / (x[n] - x[0]) * (right - left); };
  const auto to_y = [&](const double v) { return bottom - (v - y[0]) / (y[m] - y[0]) * (bottom - top); };
  const auto step = [&](const Eigen::Index i, const Eigen::Index j) {
    const double v = map.value(i, j);
    return v > 0 ? std::min(hues - 1, int(hues * v / peak)) : -1;
  };
  for (Eigen::Index j = 0; j < m; ++j)
    for (Eigen::Index i = 0; i < n;) {
      Eigen::Index end = i + 1;
      while (end < n && step(end, j) == step(i, j))
        ++end;
      if (step(i, j) >= 0)
        svg.rect(to_x(x[i]), to_y(y[j + 1]), to_x(x[end]) - to_x(x[i]), to_y(y[j]) - to_y(y[j + 1]),
                 "heat h" + std::to_string(step(i, j)));
      i = end;
    }
  svg.rect(left, top, right - left, bottom - top, "frame");
  const Ticks along = linear_ticks(x[0], x[n], 8), across = linear_ticks(y[0], y[m], 5);
  for (std::size_t i = 0; i < along.at.size(); ++i)
    svg.text(to_x(along.at[i]), bottom + 16, along.labels[i], "t tx", Anchor::middle);
  for (std::size_t i = 0; i < across.at.size(); ++i)
    svg.text(left - 6, to_y(across.at[i]) + 4, across.labels[i], "t ty", Anchor::end);
  svg.text((left + right) / 2, bottom + 34, map.x.quantity + " [" + map.x.unit + "]", "axis", Anchor::middle);
  svg.upright_text(14, (top + bottom) / 2, map.y.quantity + " [" + map.y.unit + "]", "axis");
  // The scale.
  const double cell = (bottom - top) / hues;
  for (int s = 0; s < hues; ++s)
    svg.rect(right + 18, bottom - (s + 1) * cell, 14, cell, "heat h" + std::to_string(s));
  const Ticks scale = linear_ticks(0, peak, 5);
  for (std::size_t i = 0; i < scale.at.size(); ++i)
    svg.text(right + 37, bottom - scale.at[i] / peak * (bottom - top) + 4, scale.labels[i], "t");
  svg.text(right + 18, top - 8, map.quantity + " [" + map.unit + "]", "axis", Anchor::start);
  return svg.str();
}
}  // namespace mill::report
