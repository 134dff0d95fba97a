#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace mill::report {
/// Text inside HTML and SVG, in elements and in attributes: & < > " and ' become entities.
std::string escaped(const std::string &text);

/// Estimated width of a text set in Helvetica or Arial, px: one of five widths per character.  Good to about 5 %,
/// enough to keep labels apart and margins wide enough.
double text_width(const std::string &utf8, double font_size);

/// The text, or as much of it as fits into `width` px with an ellipsis behind it.
std::string shortened(std::string utf8, double width, double font_size);

enum class Anchor { start, middle, end };

/// One drawing, written element by element.  Lengths in px, y downwards.  Appearance comes from the classes of
/// page.css: a drawing is part of the page and shares its palette and its print style.
class Svg {
public:
  /// @param description description for a reader who cannot see the figure (aria-label)
  Svg(double width, double height, const std::string &description);
  /// An attribute of the whole drawing, data-NAME, for page.js.
  void note(const std::string &name, const std::string &value);
  void line(double x1, double y1, double x2, double y2, const std::string &classes);
  void rect(double x, double y, double width, double height, const std::string &classes, double corner = 0);
  void circle(double x, double y, double radius, const std::string &classes);
  void polyline(const std::vector<Eigen::Vector2d> &points, const std::string &classes, bool closed = false);
  void text(double x, double y, const std::string &content, const std::string &classes,
            Anchor anchor = Anchor::start);
  /// Text turned by 90 degrees, read from below; (x, y) is the middle of its base line.
  void upright_text(double x, double y, const std::string &content, const std::string &classes);
  /// Everything until end_clip() is cut at this rectangle.
  void begin_clip(double x, double y, double width, double height);
  void end_clip();
  std::string str() const;

private:
  std::string head_, notes_, body_;
};
}  // namespace mill::report
