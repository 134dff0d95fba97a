#include "report/cluster/figures.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
/// From metres to pixels, y up in the stack and down in the drawing.
struct StackView {
  double scale = 1, left = 0, top = 0, width = 0, height = 0;  // px/m, m, m, px, px

  double x(const double metres) const
  {
    return (metres - left) * scale;
  }
  double y(const double metres) const
  {
    return (top - metres) * scale;
  }
};

StackView view_of(const ClusterRecord &record, const double largest, const double border)
{
  double left = 1e9, right = -1e9, bottom = 1e9, top = -1e9;
  for (const ClusterRollRecord &r : record.rolls) {
    left   = std::min(left, r.x - r.radius);
    right  = std::max(right, r.x + r.radius);
    bottom = std::min(bottom, r.y - r.radius);
    top    = std::max(top, r.y + r.radius);
  }
  StackView v;
  v.scale  = (largest - 2 * border) / std::max(right - left, top - bottom);
  v.left   = left - border / v.scale;
  v.top    = top + border / v.scale;
  v.width  = (right - left) * v.scale + 2 * border;
  v.height = (top - bottom) * v.scale + 2 * border;
  return v;
}

std::string in_kilonewton(const double newton)
{
  return std::abs(newton) < 1e-3 ? "0 kN" : significant(1e-3 * newton, 4) + " kN";
}

// Where two rolls touch.
Eigen::Vector2d touching_point(const ClusterRecord &record, const ClusterContactRecord &c)
{
  const ClusterRollRecord &a = record.rolls[std::size_t(c.a)], &b = record.rolls[std::size_t(c.b)];
  const Eigen::Vector2d from(a.x, a.y), to(b.x, b.y);
  return from + a.radius * (to - from).normalized();
}

bool complete(const ClusterRecord &record, const ClusterPassRecord &pass)
{
  const auto known = [&](const int roll) { return roll >= 0 && std::size_t(roll) < record.rolls.size(); };
  return !record.rolls.empty() && pass.contacts.size() == record.contacts.size() &&
         std::all_of(record.contacts.begin(), record.contacts.end(),
                     [&](const ClusterContactRecord &c) { return known(c.a) && known(c.b); }) &&
         std::all_of(record.supports.begin(), record.supports.end(),
                     [&](const ClusterSupportRecord &s) { return known(s.roll); });
}

// Text next to the drawing about a point of it.
struct PointLabel {
  double x, y;  // px
  std::string text, classes;
  bool to_left;
};

// From the top down on either side, a line apart at least.
void write_labels(Svg &svg, std::vector<PointLabel> labels, const double left, const double right)
{
  std::stable_sort(labels.begin(), labels.end(),
                   [](const PointLabel &a, const PointLabel &b) { return a.y < b.y; });
  double lines[] = {0, 0};
  for (const PointLabel &label : labels) {
    double &line      = lines[label.to_left];
    line              = std::max(line + 15, label.y + 4);
    const double edge = label.to_left ? left : right;
    svg.line(label.x, label.y, edge, line - 4, "leader");
    svg.text(edge + (label.to_left ? -3 : 3), line, label.text, label.classes,
             label.to_left ? Anchor::end : Anchor::start);
  }
}

// One mode in small: rolls at rest as outlines, and moving by the shape.
std::string moving_mode(const ClusterRecord &record, const ClusterModeRecord &mode)
{
  const StackView v  = view_of(record, 190, 16);
  const double reach = 11;  // px, of the largest component
  const auto number  = [](const double value) { return pixel(value); };
  std::string body;
  for (std::size_t i = 0; i < record.rolls.size(); ++i) {
    const ClusterRollRecord &r = record.rolls[i];
    const double x = v.x(r.x), y = v.y(r.y), radius = v.scale * r.radius;
    const double dx = reach * mode.shape[2 * Eigen::Index(i)], dy = -reach * mode.shape[2 * Eigen::Index(i) + 1];
    const std::string circle =
        "<circle cx=\"" + number(x) + "\" cy=\"" + number(y) + "\" r=\"" + number(radius) + "\"";
    const std::string there = number(dx) + " " + number(dy), back = number(-dx) + " " + number(-dy);
    body += circle + " class=\"ring\"/>";
    body += "<g>" + circle +
            " class=\"pen dark\"/><animateTransform attributeName=\"transform\" type=\"translate\" values=\"" +
            there + ";" + back + ";" + there +
            "\" dur=\"1.6s\" calcMode=\"spline\" keyTimes=\"0;0.5;1\" keySplines=\"0.36 0 0.64 1;0.36 0 0.64 1\" "
            "repeatCount=\"indefinite\"/></g>";
    if (std::hypot(dx, dy) > 1)
      body += "<line x1=\"" + number(x) + "\" y1=\"" + number(y) + "\" x2=\"" + number(x + dx) + "\" y2=\"" +
              number(y + dy) + "\" class=\"pen warm\"/>";
  }
  const double foot       = 34;
  const std::string title = (mode.frequency < 0 ? "grows, " : "") + fixed(std::abs(mode.frequency), 1) + " Hz",
                    name  = mode.identity.empty() ? mode.label : mode.identity;
  const double width      = std::max(v.width, 200.);
  return "<svg class=\"drawing\" width=\"" + number(width) + "\" height=\"" + number(v.height + foot) +
         "\" viewBox=\"0 0 " + number(width) + " " + number(v.height + foot) +
         "\" role=\"img\" aria-label=\"mode at " + escaped(title + ", " + name) + "\"><g transform=\"translate(" +
         number(0.5 * (width - v.width)) + " 0)\">" + body + "</g><text class=\"title\" x=\"4\" y=\"" +
         number(v.height + 12) + "\">" + escaped(title) + "</text><text class=\"small\" x=\"4\" y=\"" +
         number(v.height + 27) + "\">" + escaped(shortened(name, width - 8, 11)) + "</text></svg>\n";
}
}  // namespace

std::string stack_drawing(const ClusterRecord &record, const ClusterPassRecord &pass)
{
  if (!complete(record, pass))
    return "";
  const double aside = 190;
  const StackView v  = view_of(record, 560, 30);
  Svg svg(v.width + 2 * aside, v.height + 30, "stack of rolls to scale with the forces of " + pass.name);
  const auto x = [&](const double metres) { return aside + v.x(metres); };
  for (const ClusterRollRecord &r : record.rolls) {
    svg.circle(x(r.x), v.y(r.y), v.scale * r.radius, "steel");
    if (v.scale * r.radius > 9)
      svg.text(x(r.x), v.y(r.y) + 4, r.name, "strong", Anchor::middle);
  }
  double largest = 1;
  for (const ClusterLoadRecord &load : pass.contacts)
    largest = std::max(largest, load.force);
  std::vector<PointLabel> labels;
  for (std::size_t i = 0; i < record.contacts.size(); ++i) {
    const Eigen::Vector2d point = touching_point(record, record.contacts[i]);
    const double force          = pass.contacts[i].force;
    svg.circle(x(point.x()), v.y(point.y()), 2 + 5 * std::sqrt(std::max(0., force) / largest),
               force > 0 ? "dot warm" : "point");
    labels.push_back({x(point.x()), v.y(point.y()),
                      record.contacts[i].name + "  " + (force > 0 ? in_kilonewton(force) : "open"), "t",
                      point.x() < record.rolls[0].x - 1e-9});
  }
  for (std::size_t i = 0; i < record.supports.size() && i < pass.supports.size(); ++i) {
    const ClusterRollRecord &r = record.rolls[std::size_t(record.supports[i].roll)];
    labels.push_back({x(r.x), v.y(r.y),
                      record.supports[i].type + " " + record.supports[i].name + "  " +
                          in_kilonewton(pass.supports[i].force) + (record.supports[i].fitted ? ", fitted" : ""),
                      "small", r.x < record.rolls[0].x + 1e-9});
  }
  write_labels(svg, std::move(labels), aside - 8, aside + v.width + 8);
  const std::string strip = record.strip.substr(0, record.strip.find('-'));
  for (const ClusterRollRecord &r : record.rolls)
    if (r.name == strip) {
      const double y = v.y(r.y - r.radius);
      svg.rect(x(r.x) - 60, y, 120, 3, "strip");
      svg.text(x(r.x), y + 18, in_kilonewton(pass.force) + " from the strip", "t", Anchor::middle);
    }
  return svg.str();
}

std::string moving_modes(const ClusterRecord &record, const ClusterPassRecord &pass)
{
  std::string all;
  for (const ClusterModeRecord &mode : pass.modes)
    if (mode.shape.size() == 2 * Eigen::Index(record.rolls.size()))
      all += moving_mode(record, mode);
  return all;
}
}  // namespace mill::report
