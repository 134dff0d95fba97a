#include "report/plot/svg.h"
#include "report/plot/svg_plot.h"
#include <cmath>
#include <gtest/gtest.h>
#include <regex>
#include <sstream>

using namespace mill::report;

namespace {
struct Tick {
  double pixel, value;
};

std::vector<Tick> ticks_in(const std::string &svg, const std::string &which, const std::string &coordinate)
{
  const std::regex tick("<text class=\"t " + which + "\" x=\"([-0-9.]+)\" y=\"([-0-9.]+)\"[^>]*>([^<]*)</text>");
  std::vector<Tick> ticks;
  for (std::sregex_iterator match(svg.begin(), svg.end(), tick), end; match != end; ++match)
    ticks.push_back({std::stod((*match)[coordinate == "x" ? 1 : 2]), std::stod((*match)[3])});
  return ticks;
}

// Points of the first polyline.
std::vector<Eigen::Vector2d> points_in(const std::string &svg)
{
  std::vector<Eigen::Vector2d> points;
  const std::size_t begin = svg.find("points=\"", svg.find("<polyline")) + 8, end = svg.find('"', begin);
  std::istringstream list(svg.substr(begin, end - begin));
  for (Eigen::Vector2d point; list >> point[0] && list.get() == ',' && list >> point[1];)
    points.push_back(point);
  return points;
}

double linear(const std::vector<Tick> &ticks, const double value)
{
  const Tick a = ticks.front(), b = ticks.back();
  return a.pixel + (value - a.value) / (b.value - a.value) * (b.pixel - a.pixel);
}

double logarithmic(const std::vector<Tick> &ticks, const double value)
{
  const Tick a = ticks.front(), b = ticks.back();
  return a.pixel + std::log(value / a.value) / std::log(b.value / a.value) * (b.pixel - a.pixel);
}
}  // namespace

// A curve is read back with the ticks as the only ruler, as a reader does.
TEST(SvgPlot, PointsAgreeWithTheTicks)
{
  Plot plot;
  plot.x                  = {"approach", "mm"};
  plot.y                  = {"load", "kN"};
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(9, 0, 4), y = 3 + 2 * x.array().square();
  plot.lines.push_back({"curve", x, y});
  const std::string svg = svg_plot(plot);
  const auto xs = ticks_in(svg, "tx", "x"), ys = ticks_in(svg, "ty", "y");
  ASSERT_GE(xs.size(), 3u);
  ASSERT_GE(ys.size(), 3u);
  const auto points = points_in(svg);
  ASSERT_EQ(points.size(), 9u);
  for (int i = 0; i < 9; ++i) {
    EXPECT_LT(std::abs(points[std::size_t(i)][0] - linear(xs, x[i])), 0.03) << "rounding of three coordinates";
    // Tick labels stand 4 px below their grid line, so that they are centred on it.
    EXPECT_LT(std::abs(points[std::size_t(i)][1] - (linear(ys, y[i]) - 4)), 0.03)
        << "rounding of three coordinates";
  }
}

TEST(SvgPlot, PointsAgreeWithTheTicksOfLogarithmicAxes)
{
  Plot plot;
  plot.x = {"frequency", "Hz", Scale::logarithmic};
  plot.y = {"level", "g", Scale::logarithmic};
  Eigen::VectorXd x(5), y(5);
  x << 1, 10, 50, 200, 1000;
  y << 0.1, 3, 0.7, 40, 100;
  plot.lines.push_back({"", x, y});
  const std::string svg = svg_plot(plot);
  const auto xs = ticks_in(svg, "tx", "x"), ys = ticks_in(svg, "ty", "y");
  const auto points = points_in(svg);
  ASSERT_EQ(points.size(), 5u);
  for (int i = 0; i < 5; ++i) {
    EXPECT_LT(std::abs(points[std::size_t(i)][0] - logarithmic(xs, x[i])), 0.03)
        << "rounding of three coordinates";
    EXPECT_LT(std::abs(points[std::size_t(i)][1] - (logarithmic(ys, y[i]) - 4)), 0.03);
  }
}

TEST(SvgPlot, EscapesTextsOfUsers)
{
  Plot plot;
  plot.title = "<script> & \"quotes\"";
  plot.x     = {"a<b", "mm"};
  plot.y     = {"c", "-"};
  plot.lines.push_back({"d & e", Eigen::VectorXd::LinSpaced(3, 0, 1), Eigen::VectorXd::LinSpaced(3, 0, 1)});
  const std::string svg = svg_plot(plot);
  EXPECT_EQ(svg.find("<script>"), std::string::npos);
  EXPECT_NE(svg.find("&lt;script&gt; &amp; &quot;quotes&quot;"), std::string::npos);
  EXPECT_NE(svg.find("d &amp; e"), std::string::npos);
  EXPECT_EQ(escaped("it's"), "it&#39;s");
}

TEST(SvgPlot, PeakOfALongRecordIsDrawn)
{
  Plot plot;
  plot.x            = {"time", "s"};
  plot.y            = {"acceleration", "g"};
  Eigen::VectorXd y = Eigen::VectorXd::Zero(200001);
  y[99991]          = 10;
  plot.y.low        = 0;
  plot.y.high       = 10;
  plot.lines.push_back({"", Eigen::VectorXd::LinSpaced(200001, 0, 10), y});
  const std::string svg = svg_plot(plot);
  const auto ys         = ticks_in(svg, "ty", "y");
  double highest        = 1e9;
  for (const auto &point : points_in(svg))
    highest = std::min(highest, point[1]);
  EXPECT_LT(std::abs(highest - (linear(ys, 10) - 4)), 0.03) << "rounding of coordinates";
  EXPECT_LT(svg.size(), 60000u) << "at most four points in each of 500 columns, 20 bytes each";
}

TEST(SvgPlot, HandlesGapsAndEmptyData)
{
  Plot plot;
  plot.x            = {"x", "m"};
  plot.y            = {"y", "m"};
  Eigen::VectorXd y = Eigen::VectorXd::LinSpaced(9, 0, 1);
  y[4]              = NAN;
  plot.lines.push_back({"", Eigen::VectorXd::LinSpaced(9, 0, 1), y});
  const std::string svg = svg_plot(plot);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  std::size_t strokes = 0;
  for (std::size_t position = svg.find("<polyline"); position != std::string::npos;
       position             = svg.find("<polyline", position + 1))
    ++strokes;
  EXPECT_EQ(strokes, 2u) << "one on each side of the gap";
  plot.lines[0].y.setConstant(NAN);
  EXPECT_NE(svg_plot(plot).find("no finite value in the stored data"), std::string::npos);
}

// Natural frequencies can lie close together: their names must not.
TEST(SvgPlot, MarkNamesDoNotOverlap)
{
  Plot plot;
  plot.x = {"frequency", "Hz"};
  plot.y = {"level", "g"};
  plot.lines.push_back({"", Eigen::VectorXd::LinSpaced(3, 0, 1000), Eigen::VectorXd::LinSpaced(3, 0, 1)});
  for (const double f : {38.9, 54.0, 60.0, 64.0, 998.0, 999.0})
    plot.marks.push_back({f, "f at " + std::to_string(int(f)) + " Hz"});
  const std::string svg = svg_plot(plot);
  struct Box {
    double left, right, y;
  };
  std::vector<Box> boxes;
  const std::regex flag("<text class=\"flag\" x=\"([-0-9.]+)\" y=\"([-0-9.]+)\"[^>]*>([^<]*)</text>");
  for (std::sregex_iterator match(svg.begin(), svg.end(), flag), end; match != end; ++match) {
    const double half = text_width((*match)[3], 11) / 2, x = std::stod((*match)[1]);
    boxes.push_back({x - half, x + half, std::stod((*match)[2])});
    EXPECT_GE(boxes.back().left, 0);
    EXPECT_LE(boxes.back().right, plot.width);
  }
  ASSERT_EQ(boxes.size(), 6u);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_TRUE(boxes[i].y != boxes[j].y || boxes[i].left > boxes[j].right || boxes[j].left > boxes[i].right);
}
