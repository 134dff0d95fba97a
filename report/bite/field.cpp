#include "report/bite/figures.h"
#include "report/page/curves.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/ticks.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int steps = 8;

struct Quantity {
  const char *column, *title, *name, *unit;
};
const Quantity field_quantities[] = {
    {"strain", "Plastic strain", "strain", "-"},
    {"strain_rate", "Strain rate", "strain rate", "1/s"},
    {"pressure", "Mean pressure", "pressure", "MPa"},
    {"velocity_x", "Speed", "speed", "m/s"},
};

// Points of the mesh, (station along the strip, place through the half thickness).
struct Field {
  MatrixXd x, y, value;
};

// Written station by station from the middle plane to the surface: a new one begins where y falls.
Field field_of(const Table &table, const Quantity &quantity)
{
  const VectorXd x = values_of(table, {"x", "mm"}), y = values_of(table, {"y", "mm"}),
                 v = values_of(table, {quantity.column, quantity.unit});
  Index through    = 1;
  while (through < y.size() && y[through] > y[through - 1])
    ++through;
  if (through < 2 || x.size() == 0 || x.size() % through != 0 || v.size() != x.size() || y.size() != x.size())
    return {};
  const Index along = x.size() / through;
  Field field{x.reshaped(through, along).transpose(), y.reshaped(through, along).transpose(),
              v.reshaped(through, along).transpose()};
  if (along < 2)
    return {};
  if (field.x(along - 1, 0) < field.x(0, 0))
    for (MatrixXd *m : {&field.x, &field.y, &field.value})
      *m = m->colwise().reverse().eval();
  return field;
}

// Above this lie the fiftieth part of the values: one point at an edge must not take the whole scale.
double top_of(const MatrixXd &value)
{
  std::vector<double> sorted;
  for (const double v : value.reshaped())
    if (std::isfinite(v))
      sorted.push_back(v);
  if (sorted.empty())
    return 0;
  const auto position = sorted.begin() + std::ptrdiff_t(0.98 * double(sorted.size() - 1));
  std::nth_element(sorted.begin(), position, sorted.end());
  return *position;
}
}  // namespace

std::string bite_field(const Table &table, const std::string &column)
{
  const auto *quantity = std::find_if(std::begin(field_quantities), std::end(field_quantities),
                                      [&](const Quantity &q) { return column == q.column; });
  if (quantity == std::end(field_quantities))
    return "";
  const Field f    = field_of(table, *quantity);
  const double top = f.value.size() > 0 ? top_of(f.value) : 0;
  if (!(top > 0))
    return "";
  const double width = 1000, height = 230, left = 64, right = width - 110, above = 26, below = height - 44;
  const double x0 = f.x.minCoeff(), x1 = f.x.maxCoeff(), y1 = f.y.maxCoeff();
  const auto to_x     = [&](const double x) { return left + (x - x0) / (x1 - x0) * (right - left); };
  const auto to_y     = [&](const double y) { return below - y / y1 * (below - above); };
  const auto point_at = [&](const Index i, const Index j) {
    return Eigen::Vector2d(to_x(f.x(i, j)), to_y(f.y(i, j)));
  };
  const auto step = [&](const Index i, const Index j) {
    const double v = 0.25 * (f.value(i, j) + f.value(i + 1, j) + f.value(i, j + 1) + f.value(i + 1, j + 1));
    return std::isfinite(v) ? std::clamp(int(steps * v / top), 0, steps - 1) : -1;
  };
  Svg svg(width, height, std::string(quantity->title) + " in the strip, over its length and half thickness");
  svg.text(34, 15, quantity->title, "title");
  for (Index j = 0; j + 1 < f.x.cols(); ++j)
    for (Index i = 0; i + 1 < f.x.rows();) {
      Index end = i + 1;  // neighbouring cells of one step are one polygon
      while (end + 1 < f.x.rows() && step(end, j) == step(i, j))
        ++end;
      if (step(i, j) >= 0) {
        std::vector<Eigen::Vector2d> outline;
        for (Index k = i; k <= end; ++k)
          outline.push_back(point_at(k, j));
        // One row too high, where the next one is drawn over it: no hairline shows between the rows.
        const Index above_it = std::min(j + 2, f.x.cols() - 1);
        for (Index k = end; k >= i; --k)
          outline.push_back(point_at(k, above_it));
        svg.polyline(outline, "heat h" + std::to_string(step(i, j)), true);
      }
      i = end;
    }
  svg.line(to_x(x0), below, to_x(x1), below, "frame");
  const Ticks along = linear_ticks(x0, x1, 8), across = linear_ticks(0, y1, 4);
  for (std::size_t i = 0; i < along.at.size(); ++i)
    svg.text(to_x(along.at[i]), below + 16, along.labels[i], "t tx", Anchor::middle);
  for (std::size_t i = 0; i < across.at.size(); ++i)
    svg.text(left - 6, to_y(across.at[i]) + 4, across.labels[i], "t ty", Anchor::end);
  svg.text((left + right) / 2, below + 34, "distance from the line of centres, entry to the right [mm]", "axis",
           Anchor::middle);
  svg.upright_text(14, (above + below) / 2, "half thickness [mm]", "axis");
  const double cell = (below - above) / steps;
  for (int s = 0; s < steps; ++s)
    svg.rect(right + 18, below - (s + 1) * cell, 14, cell, "heat h" + std::to_string(s));
  const Ticks scale = linear_ticks(0, top, 5);
  for (std::size_t i = 0; i < scale.at.size(); ++i)
    svg.text(right + 37, below - scale.at[i] / top * (below - above) + 4, scale.labels[i], "t");
  svg.text(right + 18, above - 8, std::string(quantity->name) + " [" + quantity->unit + "]", "axis",
           Anchor::start);
  return svg.str();
}
}  // namespace mill::report
