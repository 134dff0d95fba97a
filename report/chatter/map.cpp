#include "report/chatter/figures.h"
#include "report/page/curves.h"
#include "report/plot/heat_map.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/ticks.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace mill::report {
namespace {
using Eigen::VectorXd;

struct Grid {
  VectorXd speed;          // (n) m/s
  VectorXd other;          // (m) in the unit of its axis
  Eigen::MatrixXd growth;  // (n, m) 1/s, NaN: no steady bite
};

struct OtherAxis {
  const char *key, *quantity, *unit, *title;
  double (*working)(const ChatterCondition &);  // where the condition is on it
};
constexpr OtherAxis axes[] = {
    {"reduction", "reduction", "%", "Speed and reduction", [](const ChatterCondition &c) { return c.reduction; }},
    {"tension", "tension of the condition", "%", "Speed and tension",
     [](const ChatterCondition &) { return 100.; }},
    {"viscosity", "viscosity of the oil", "mPa s", "Speed and viscosity",
     [](const ChatterCondition &c) { return c.viscosity; }},
};

// Speed runs fastest; a table that is not such a grid draws nothing.
std::optional<Grid> grid_of(const Table &table, const OtherAxis &axis)
{
  const VectorXd v = values_of(table, {"speed", "m/s"}), y = values_of(table, {axis.key, axis.unit}),
                 g = values_of(table, {"growth_rate", "1/s"});
  Eigen::Index n   = 0;
  while (n < y.size() && y[n] == y[0])
    ++n;
  if (n < 2 || v.size() != y.size() || g.size() != y.size() || y.size() % n != 0 || y.size() / n < 2)
    return std::nullopt;
  const Eigen::Index m = y.size() / n;
  Grid grid{v.head(n), VectorXd(m), Eigen::Map<const Eigen::MatrixXd>(g.data(), n, m)};
  for (Eigen::Index j = 0; j < m; ++j)
    grid.other[j] = y[j * n];
  const auto rises = [](const VectorXd &x) {
    return (x.tail(x.size() - 1) - x.head(x.size() - 1)).minCoeff() > 0;
  };
  if (!v.allFinite() || !y.allFinite() || !rises(grid.speed) || !rises(grid.other))
    return std::nullopt;
  return grid;
}

constexpr int sides = 4;  // steps on each side of zero
using Limits        = std::array<double, sides - 1>;

// 1, 3, 10 times a power of ten, so that the outermost step holds what is larger than about a third of everything.
Limits limits_of(const Grid &grid)
{
  double largest = 0;
  for (const double g : grid.growth.reshaped())
    if (std::isfinite(g))
      largest = std::max(largest, std::abs(g));
  const double unit = largest > 0 ? std::pow(10.0, std::floor(std::log10(largest / 3)) - 1) : 1;
  const double k    = 30 * unit <= largest / 2 ? 3 : 1;
  return k > 1 ? Limits{3 * unit, 10 * unit, 30 * unit} : Limits{unit, 3 * unit, 10 * unit};
}

// 0 .. 3 from strongly to hardly damped, 4 .. 7 from hardly to strongly growing.
int step_of(const double growth, const Limits &limits)
{
  const int size = int(std::upper_bound(limits.begin(), limits.end(), std::abs(growth)) - limits.begin());
  return growth > 0 ? sides + size : sides - 1 - size;
}

std::string range_of_step(const int step, const Limits &limits)
{
  const auto number = [](const double v) { return significant(v, 1); };
  const int size    = step >= sides ? step - sides : sides - 1 - step;
  const double low  = size == 0 ? 0 : limits[std::size_t(size - 1)];
  if (step >= sides)
    return size == sides - 1 ? "> " + number(low) : number(low) + " \u2026 " + number(limits[std::size_t(size)]);
  return size == sides - 1 ? "< " + number(-low) : number(-limits[std::size_t(size)]) + " \u2026 " + number(-low);
}

struct Frame {
  double left, right, top, bottom;  // px
  double x_low, x_high, y_low, y_high;
  double x(const double v) const
  {
    return left + (v - x_low) / (x_high - x_low) * (right - left);
  }
  double y(const double v) const
  {
    return bottom - (v - y_low) / (y_high - y_low) * (bottom - top);
  }
  bool holds(const double at_x, const double at_y) const
  {
    return at_x >= x_low && at_x <= x_high && at_y >= y_low && at_y <= y_high;
  }
};

constexpr double seam = 0.6;  // px by which a row reaches under the one below it, so that no paper shows between

// Neighbours of one step along the speed are drawn as one.
void draw_cells(Svg &svg, const Grid &grid, const Limits &limits, const Frame &frame)
{
  const VectorXd x = cell_borders(grid.speed), y = cell_borders(grid.other);
  const auto step = [&](const Eigen::Index i, const Eigen::Index j) {
    return std::isfinite(grid.growth(i, j)) ? step_of(grid.growth(i, j), limits) : -1;
  };
  const Eigen::Index n = grid.speed.size();
  for (Eigen::Index j = grid.other.size() - 1; j >= 0; --j)
    for (Eigen::Index i = 0; i < n;) {
      Eigen::Index end = i + 1;
      while (end < n && step(end, j) == step(i, j))
        ++end;
      if (step(i, j) >= 0)
        svg.rect(frame.x(x[i]), frame.y(y[j + 1]), frame.x(x[end]) - frame.x(x[i]),
                 frame.y(y[j]) - frame.y(y[j + 1]) + seam, "growth s" + std::to_string(step(i, j)));
      i = end;
    }
}

void draw_axes(Svg &svg, const Frame &frame, const OtherAxis &axis)
{
  svg.rect(frame.left, frame.top, frame.right - frame.left, frame.bottom - frame.top, "frame");
  const Ticks along  = linear_ticks(frame.x_low, frame.x_high, 6),
              across = linear_ticks(frame.y_low, frame.y_high, 6);
  for (std::size_t i = 0; i < along.at.size(); ++i)
    svg.text(frame.x(along.at[i]), frame.bottom + 16, along.labels[i], "t tx", Anchor::middle);
  for (std::size_t i = 0; i < across.at.size(); ++i)
    svg.text(frame.left - 6, frame.y(across.at[i]) + 4, across.labels[i], "t ty", Anchor::end);
  svg.text((frame.left + frame.right) / 2, frame.bottom + 34, "roll speed [m/s]", "axis", Anchor::middle);
  svg.upright_text(14, (frame.top + frame.bottom) / 2, std::string(axis.quantity) + " [" + axis.unit + "]",
                   "axis");
}

void draw_scale(Svg &svg, const Frame &frame, const Limits &limits)
{
  constexpr double cell = 18;
  const double x = frame.right + 14, chatters = frame.top + 20, stable = chatters + 8 + sides * cell + 20;
  svg.text(x, frame.top + 2, "growth rate [1/s]", "axis");
  svg.text(x, chatters, "chatters", "small");
  svg.text(x, stable, "stable", "small");
  for (int s = 0; s < 2 * sides; ++s) {
    const double y = s < sides ? stable + 6 + (sides - 1 - s) * cell : chatters + 6 + (2 * sides - 1 - s) * cell;
    svg.rect(x, y, 14, cell, "growth s" + std::to_string(s));
    svg.text(x + 20, y + 13, range_of_step(s, limits), "t");
  }
  svg.text(x, stable + 6 + sides * cell + 22, "blank: no steady bite", "small");
}

void draw_boundary(Svg &svg, const Table &table, const OtherAxis &axis, const Frame &frame)
{
  const VectorXd y = values_of(table, {axis.key, axis.unit}), v = values_of(table, {"critical_speed", "m/s"});
  std::vector<Eigen::Vector2d> stroke;
  const auto finish = [&] {
    if (stroke.size() > 1)
      svg.polyline(stroke, "pen boundary");
    stroke.clear();
  };
  for (Eigen::Index i = 0; i < std::min(y.size(), v.size()); ++i)
    if (frame.holds(v[i], y[i]))
      stroke.emplace_back(frame.x(v[i]), frame.y(y[i]));
    else
      finish();
  finish();
}

void draw_working_point(Svg &svg, const ChatterCondition &condition, const OtherAxis &axis, const Frame &frame)
{
  const double other = axis.working(condition);
  if (frame.holds(condition.speed, other)) {
    const double x = frame.x(condition.speed), y = frame.y(other);
    const bool left = x + 9 + text_width("works here", 11) > frame.right;
    svg.circle(x, y, 5, "point");
    svg.text(x + (left ? -9 : 9), y + 4, "works here", "flag halo", left ? Anchor::end : Anchor::start);
  } else if (condition.speed >= frame.x_low && condition.speed <= frame.x_high) {
    svg.line(frame.x(condition.speed), frame.top, frame.x(condition.speed), frame.bottom, "mark");
    svg.text(frame.x(condition.speed), frame.top - 6, "working speed", "flag", Anchor::middle);
  }
}
}  // namespace

std::string chatter_map(const Run &run, const ChatterCondition &condition, const std::string &quantity)
{
  const auto axis =
      std::find_if(std::begin(axes), std::end(axes), [&](const OtherAxis &a) { return quantity == a.key; });
  const Table *table             = stored_curve(run, curve::chatter_map, condition.slug, quantity);
  const std::optional<Grid> grid = table && axis != std::end(axes) ? grid_of(*table, *axis) : std::nullopt;
  if (!grid)
    return "";
  const Frame frame{64,
                    380,
                    40,
                    290,
                    grid->speed[0],
                    grid->speed[grid->speed.size() - 1],
                    grid->other[0],
                    grid->other[grid->other.size() - 1]};
  Svg svg(510, 334, std::string("growth rate over roll speed and ") + axis->quantity);
  svg.text(34, 15, axis->title, "title");
  const Limits limits = limits_of(*grid);
  draw_cells(svg, *grid, limits, frame);
  if (const Table *boundary = stored_curve(run, curve::chatter_boundary, condition.slug, quantity))
    draw_boundary(svg, *boundary, *axis, frame);
  draw_axes(svg, frame, *axis);
  draw_scale(svg, frame, limits);
  draw_working_point(svg, condition, *axis, frame);
  return svg.str();
}
}  // namespace mill::report
