#include "core/records/stand_place.h"
#include "report/chatter/figures.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/svg_plot.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
using Eigen::Vector2d;

struct Phasor {
  std::string label;
  double angle;  // degrees, counterclockwise from the gap
  Pen pen;
  bool reference = false;  // whose angle is 0 by definition
};

std::string degrees(const double angle)
{
  const bool opposite = std::abs(std::abs(angle) - 180) < 0.05;  // neither ahead nor behind
  return opposite ? "180.0\u00b0" : (angle > 0 ? "+" : "") + fixed(angle, 1) + "\u00b0";
}

void draw_arrow(Svg &svg, const Vector2d &from, const Vector2d &to, const std::string &pen)
{
  const Vector2d along = (to - from).normalized(), across(-along[1], along[0]);
  svg.line(from[0], from[1], to[0] - 8 * along[0], to[1] - 8 * along[1], "pen phasor " + pen);
  svg.polyline({to, to - 11 * along + 4.5 * across, to - 11 * along - 4.5 * across}, "head " + pen, true);
}

constexpr double radius = 118, label_row = 18;  // px

struct Label {
  const Phasor *phasor;
  double y;  // px
};

// Labels of one side from top to bottom, each at least a label_row below the one before it; those that would leave
// the drawing at the bottom push the others up.
void spread(std::vector<Label> &labels, const double top, const double bottom)
{
  std::sort(labels.begin(), labels.end(), [](const Label &a, const Label &b) { return a.y < b.y; });
  for (std::size_t i = 0; i < labels.size(); ++i)
    labels[i].y = std::max(labels[i].y, i > 0 ? labels[i - 1].y + label_row : top);
  for (std::size_t i = labels.size(); i-- > 0;)
    labels[i].y = std::min(labels[i].y, i + 1 < labels.size() ? labels[i + 1].y - label_row : bottom);
}
}  // namespace

std::string chatter_phasors(const ChatterPhases &phases)
{
  std::vector<Phasor> all{
      {"gap", 0, Pen::dark, true},
      {"force", phases.force, Pen::warm},
      {"back tension", phases.entry_tension, Pen::dashed},
      {"front tension", phases.exit_tension, Pen::dotted},
      {"friction", phases.friction, Pen::chained},
  };
  all.erase(std::remove_if(all.begin(), all.end(), [](const Phasor &p) { return !std::isfinite(p.angle); }),
            all.end());
  if (all.size() < 2)
    return "";
  const double width = 540, height = 350;
  const Vector2d centre(width / 2, 172);
  Svg svg(width, height, "phases against the gap in degrees");
  svg.text(34, 15, "Phases", "title");
  svg.circle(centre[0], centre[1], radius, "unit-circle");
  svg.line(centre[0] - radius - 8, centre[1], centre[0] + radius + 8, centre[1], "grid");
  svg.line(centre[0], centre[1] - radius - 8, centre[0], centre[1] + radius + 8, "grid");
  svg.text(centre[0], centre[1] - radius - 12, "+90\u00b0, ahead of the gap", "small", Anchor::middle);
  svg.text(centre[0], centre[1] + radius + 22, "\u221290\u00b0, behind the gap", "small", Anchor::middle);
  std::vector<Label> left, right;
  for (const Phasor &phasor : all) {
    const double turn  = phasor.angle * EIGEN_PI / 180;
    const Vector2d tip = centre + radius * Vector2d(std::cos(turn), -std::sin(turn));
    draw_arrow(svg, centre, tip, class_of(phasor.pen));
    (std::cos(turn) < 0 ? left : right).push_back({&phasor, tip[1]});
  }
  for (auto *side : {&left, &right}) {
    spread(*side, centre[1] - radius, centre[1] + radius);
    const double way = side == &left ? -1 : 1;
    for (const Label &label : *side) {
      const double turn = label.phasor->angle * EIGEN_PI / 180, x = centre[0] + way * (radius + 26);
      const Vector2d tip = centre + (radius + 3) * Vector2d(std::cos(turn), -std::sin(turn));
      svg.polyline({tip, {x - way * 4, label.y}}, "leader");
      svg.text(x, label.y + 4,
               label.phasor->label + (label.phasor->reference ? "" : " " + degrees(label.phasor->angle)), "t",
               side == &left ? Anchor::end : Anchor::start);
    }
  }
  svg.text(centre[0], height - 10,
           "phase against the gap [\u00b0]" +
               (std::isfinite(phases.frequency) ? " at " + fixed(phases.frequency, 1) + " Hz" : std::string()),
           "axis", Anchor::middle);
  return svg.str();
}

namespace {
// Housings as boxes, rolls as circles.
void draw_body(Svg &svg, const StandPlace &place, const double x, const double y)
{
  if (place.roll)
    svg.circle(x, y, place.backup ? 19 : 11, "steel");
  else
    svg.rect(x - 30, y - 12, 60, 24, "steel");
}
}  // namespace

std::string chatter_shape(const std::vector<ChatterPoint> &shape, const std::string &title)
{
  double largest = 0;
  for (const ChatterPoint &point : shape)
    if (std::isfinite(point.amplitude))
      largest = std::max(largest, point.amplitude);
  if (!(largest > 0))
    return "";
  constexpr double top = 34, height = 44, names = 128, bodies = 172, bars = 236, longest = 150;
  const double bottom = top + height * double(shape.size());
  Svg svg(480, bottom + 40, title + ": amplitude and direction of each body");
  svg.text(34, 15, title, "title");
  svg.line(bars, top, bars, bottom, "frame");
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const ChatterPoint &point = shape[i];
    const StandPlace place    = stand_place(point.label);
    const double y            = top + height * (double(i) + 0.5);
    svg.text(names, y + 4, point.label, "t", Anchor::end);
    draw_body(svg, place, bodies, y);
    if (i > 0 && place.lower && !stand_place(shape[i - 1].label).lower)
      svg.line(bodies - 40, y - height / 2, bodies + 40, y - height / 2, "strip-line");
    if (!std::isfinite(point.amplitude) || !std::isfinite(point.phase))
      continue;
    const double size = point.amplitude / largest, cosine = std::cos(point.phase * EIGEN_PI / 180);
    const double way   = (cosine >= 0) == place.lower ? 1 : -1;  // away from the strip is down for the lower ones
    const double reach = std::max(2.0, longest * size);
    svg.rect(bars, y - 6, reach, 12, cosine >= 0 ? "bar dark" : "bar warm");
    if (size >= 0.02)
      draw_arrow(svg, {bodies + 48, y - way * 15}, {bodies + 48, y + way * 15}, cosine >= 0 ? "dark" : "warm");
    svg.text(bars + reach + 6, y + 4, fixed(size, 2) + (size >= 0.005 ? ", " + degrees(point.phase) : ""), "t");
  }
  svg.text(bars + longest / 2, bottom + 18, "amplitude, largest = 1 [-], phase against the gap [\u00b0]", "axis",
           Anchor::middle);
  svg.text(bars + longest / 2, bottom + 34, "arrow: motion while the gap opens", "small", Anchor::middle);
  return svg.str();
}
}  // namespace mill::report
