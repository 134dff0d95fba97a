#include "report/plot/svg.h"
#include "core/base/name_part.h"
#include "core/records/xml_text.h"
#include "report/plot/number.h"
#include <cstring>

namespace mill::report {
namespace {
std::string attribute(const char *name, const double value)
{
  return std::string(" ") + name + "=\"" + pixel(value) + '"';
}

std::string class_of(const std::string &classes)
{
  return " class=\"" + classes + '"';
}

const char *name_of(const Anchor anchor)
{
  return anchor == Anchor::middle ? "middle" : "end";
}
}  // namespace

std::string escaped(const std::string &text)
{
  return xml_text(with_plain_names(text));
}

double text_width(const std::string &utf8, const double font_size)
{
  double em = 0;
  for (const unsigned char c : utf8) {
    if ((c & 0xC0) == 0x80)
      continue;  // continuation byte: the character has been counted
    if (std::strchr("ijl.,:;'|!", c))
      em += 0.25;
    else if (std::strchr("ftr()[]/- ", c))
      em += 0.32;
    else if (std::strchr("mwMW%", c))
      em += 0.86;
    else
      em += c >= 'A' && c <= 'Z' ? 0.69 : 0.556;
  }
  return em * font_size;
}

std::string shortened(std::string utf8, const double width, const double font_size)
{
  if (text_width(utf8, font_size) <= width)
    return utf8;
  while (!utf8.empty() && text_width(utf8 + "\u2026", font_size) > width) {
    while (utf8.size() > 1 && (static_cast<unsigned char>(utf8.back()) & 0xC0) == 0x80)
      utf8.pop_back();
    utf8.pop_back();
  }
  return utf8 + "\u2026";
}

Svg::Svg(const double width, const double height, const std::string &description)
    : head_("<svg role=\"img\" aria-label=\"" + escaped(description) + "\" width=\"" + pixel(width) +
            "\" height=\"" + pixel(height) + "\" viewBox=\"0 0 " + pixel(width) + ' ' + pixel(height) + "\"")
{
}

void Svg::note(const std::string &name, const std::string &value)
{
  notes_ += " data-" + name + "=\"" + escaped(value) + '"';
}

void Svg::line(const double x1, const double y1, const double x2, const double y2, const std::string &classes)
{
  body_ += "<line" + class_of(classes) + attribute("x1", x1) + attribute("y1", y1) + attribute("x2", x2) +
           attribute("y2", y2) + "/>\n";
}

void Svg::rect(const double x, const double y, const double width, const double height, const std::string &classes,
               const double corner)
{
  body_ += "<rect" + class_of(classes) + attribute("x", x) + attribute("y", y) + attribute("width", width) +
           attribute("height", height) + (corner > 0 ? attribute("rx", corner) : "") + "/>\n";
}

void Svg::circle(const double x, const double y, const double radius, const std::string &classes)
{
  body_ +=
      "<circle" + class_of(classes) + attribute("cx", x) + attribute("cy", y) + attribute("r", radius) + "/>\n";
}

void Svg::polyline(const std::vector<Eigen::Vector2d> &points, const std::string &classes, const bool closed)
{
  body_ += (closed ? "<polygon" : "<polyline") + class_of(classes) + " points=\"";
  for (const auto &point : points)
    body_ += pixel(point[0]) + ',' + pixel(point[1]) + ' ';
  if (!points.empty())
    body_.pop_back();
  body_ += "\"/>\n";
}

void Svg::text(const double x, const double y, const std::string &content, const std::string &classes,
               const Anchor anchor)
{
  body_ += "<text" + class_of(classes) + attribute("x", x) + attribute("y", y) +
           (anchor == Anchor::start ? "" : std::string(" text-anchor=\"") + name_of(anchor) + '"') + '>' +
           escaped(content) + "</text>\n";
}

void Svg::upright_text(const double x, const double y, const std::string &content, const std::string &classes)
{
  const std::string where = pixel(x) + ' ' + pixel(y);
  body_ += "<text" + class_of(classes) + attribute("x", x) + attribute("y", y) +
           " text-anchor=\"middle\" transform=\"rotate(-90 " + where + ")\">" + escaped(content) + "</text>\n";
}

void Svg::begin_clip(const double x, const double y, const double width, const double height)
{
  // An inner <svg> cuts at its border and needs no identifier that would have to be unique on the page.
  body_ += "<svg class=\"clip\"" + attribute("x", x) + attribute("y", y) + attribute("width", width) +
           attribute("height", height) + " viewBox=\"" + pixel(x) + ' ' + pixel(y) + ' ' + pixel(width) + ' ' +
           pixel(height) + "\">\n";
}

void Svg::end_clip()
{
  body_ += "</svg>\n";
}

std::string Svg::str() const
{
  return head_ + notes_ + ">\n" + body_ + "</svg>\n";
}
}  // namespace mill::report
