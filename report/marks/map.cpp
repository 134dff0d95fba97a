#include "report/marks/figures.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/ticks.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
constexpr double step_dB   = 6;  // of the scale; below the first one nothing is drawn
constexpr int map_steps    = 5;
constexpr double row_space = 12;  // px between the names of two modes

struct MapFrame {
  double left, right, top, bottom;  // px
  double v_low, v_high, n_low, n_high;
  double x(const double v) const
  {
    return left + (v - v_low) / (v_high - v_low) * (right - left);
  }
  double y(const double n) const
  {
    return bottom - (n - n_low) / (n_high - n_low) * (bottom - top);
  }
};

int step_of_gain(const double dB)
{
  return std::isfinite(dB) ? std::min(map_steps, int(std::floor(dB / step_dB))) - 1 : -1;
}

std::string class_of_step(const int step)
{
  return "heat h" + std::to_string(2 + step);
}

// Neighbours of one step along the speed are drawn as one.
void draw_gain(Svg &svg, const MarkMap &map, const MapFrame &frame)
{
  const Eigen::Index n = map.speed.size();
  const double half    = 0.5 * (map.speed[1] - map.speed[0]);
  for (Eigen::Index j = 0; j < map.waves.size(); ++j)
    for (Eigen::Index i = 0; i < n;) {
      const int step   = step_of_gain(map.gain(i, j));
      Eigen::Index end = i + 1;
      while (end < n && step_of_gain(map.gain(end, j)) == step)
        ++end;
      if (step >= 0) {
        const double x0 = frame.x(std::max(frame.v_low, map.speed[i] - half)),
                     x1 = frame.x(std::min(frame.v_high, map.speed[end - 1] + half));
        svg.rect(x0, frame.y(map.waves[j] + 0.5), x1 - x0,
                 frame.y(map.waves[j] - 0.5) - frame.y(map.waves[j] + 0.5), class_of_step(step));
      }
      i = end;
    }
}

void draw_axes_of_map(Svg &svg, const MapFrame &frame)
{
  svg.rect(frame.left, frame.top, frame.right - frame.left, frame.bottom - frame.top, "frame");
  const Ticks along  = linear_ticks(frame.v_low, frame.v_high, 7),
              across = linear_ticks(frame.n_low, frame.n_high, 6);
  for (std::size_t i = 0; i < along.at.size(); ++i)
    svg.text(frame.x(along.at[i]), frame.bottom + 16, along.labels[i], "t tx", Anchor::middle);
  for (std::size_t i = 0; i < across.at.size(); ++i)
    svg.text(frame.left - 6, frame.y(across.at[i]) + 4, across.labels[i], "t ty", Anchor::end);
  svg.text((frame.left + frame.right) / 2, frame.bottom + 34, "speed of the strip [m/s]", "axis", Anchor::middle);
  svg.upright_text(14, (frame.top + frame.bottom) / 2, "waves per turn [-]", "axis");
}

// Names where the line of a mode leaves the map on the right, as far as they find room.
void draw_names(Svg &svg, const MarksData &data, const double length, const MapFrame &frame)
{
  double last = INFINITY;
  for (const ModeMarks &mode : data.modes) {
    const double n = length * mode.frequency / frame.v_high;
    if (!(n > frame.n_low && n < frame.n_high) || last - frame.y(n) < row_space)
      continue;
    last = frame.y(n);
    svg.text(frame.right + 6, last + 4, mode.name + ", " + fixed(mode.frequency, 0) + " Hz", "small");
  }
}

void draw_scale_of_map(Svg &svg, const MapFrame &frame)
{
  double x = frame.left;
  svg.text(x, 31, "magnified by [dB]", "axis");
  x += 112;
  for (int s = 0; s < map_steps; ++s) {
    svg.rect(x, 21, 14, 12, class_of_step(s));
    const std::string low = fixed((s + 1) * step_dB, 0);
    svg.text(x + 19, 31, s + 1 == map_steps ? "> " + low : low + " \u2026 " + fixed((s + 2) * step_dB, 0), "t");
    x += 76;
  }
}
}  // namespace

std::string marks_map(const MarksData &data, const MarkMap &map)
{
  const Eigen::Index n = map.speed.size(), m = map.waves.size();
  const auto roll =
      std::find_if(data.rolls.begin(), data.rolls.end(), [&](const RollMarks &r) { return r.roll == map.roll; });
  if (n < 2 || m < 2 || map.gain.rows() != n || map.gain.cols() != m || roll == data.rolls.end())
    return "";
  const MapFrame frame{
      64, 690, 44, 400, map.speed[0], map.speed[n - 1], map.waves[0] - 0.5, map.waves[m - 1] + 0.5};
  if (!(frame.v_high > frame.v_low && frame.n_high > frame.n_low))
    return "";
  Svg svg(900, 444, "magnification over speed and waves around the " + map.roll);
  svg.text(34, 15, "Waves around the " + map.roll, "title");
  draw_scale_of_map(svg, frame);
  draw_gain(svg, map, frame);
  draw_axes_of_map(svg, frame);
  const MarksQuestion &q = data.question;
  draw_names(svg, data, M_PI * roll->diameter * (1 + q.forward_slip), frame);
  const double x = frame.x(q.speed), y = frame.y(roll->per_turn);
  if (x >= frame.left && x <= frame.right && y >= frame.top && y <= frame.bottom) {
    svg.line(frame.left, y, frame.right, y, "mark");
    svg.line(x, frame.top, x, frame.bottom, "mark");
    svg.circle(x, y, 5, "point");
    svg.text(x + 9, y - 6, "the marks", "flag halo");
  }
  return svg.str();
}
}  // namespace mill::report
