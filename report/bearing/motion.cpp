#include "report/bearing/figures.h"
#include "report/page/curves.h"
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/ticks.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
constexpr double close_up = 0.025;  // s

struct MotionChannel {
  const char *column, *title, *quantity, *unit;
};
const MotionChannel motion_channels[] = {
    {"force", "Force of the bearing", "force", "kN"},
    {"x", "Along the load", "displacement", "\u00b5m"},
    {"y", "Across the load", "displacement", "\u00b5m"},
};

std::string history(const Table &table, const MotionChannel &channel, const std::string &group)
{
  const Eigen::VectorXd time  = values_of(table, {"time", "s"}),
                        value = values_of(table, {channel.column, channel.unit});
  if (value.size() == 0 || value.size() != time.size())
    return "";
  Plot plot;
  plot.title  = channel.title;
  plot.width  = page_width;
  plot.height = 190;
  plot.x      = {"time", "s"};
  plot.y      = {channel.quantity, channel.unit};
  plot.lines.push_back({"", time, value, Pen::dark});
  return "<div class=\"history\"><div class=\"static\">" + svg_plot(plot) + "</div>" +
         zoom_chart(group, std::string(channel.quantity) + " [" + channel.unit + "]", 0, time,
                    {{channel.title, value}}) +
         "</div>\n";
}

// Samples of the last moments, where a start has died away as far as it will.
Eigen::Index first_of_the_end(const Eigen::VectorXd &time)
{
  return std::lower_bound(time.begin(), time.end(), time[time.size() - 1] - close_up) - time.begin();
}

std::string last_moments(const Table &table)
{
  const Eigen::VectorXd time = values_of(table, {"time", "s"}), x = values_of(table, {"x", "\u00b5m"}),
                        y  = values_of(table, {"y", "\u00b5m"});
  const Eigen::Index first = first_of_the_end(time), n = time.size() - first;
  Plot plot;
  plot.title  = "The last moments";
  plot.width  = 680;
  plot.height = 340;
  plot.x      = {"time", "s"};
  plot.y      = {"displacement", "\u00b5m"};
  plot.lines.push_back({"along the load", time.tail(n), x.tail(n), Pen::dark});
  plot.lines.push_back({"across the load", time.tail(n), y.tail(n), Pen::warm});
  return svg_plot(plot);
}

// The path of the inner ring's middle over the same moments, both directions on one scale.
std::string orbit(const Table &table)
{
  const Eigen::VectorXd time = values_of(table, {"time", "s"});
  const Eigen::Index n       = time.size() - first_of_the_end(time);
  const Eigen::VectorXd x    = values_of(table, {"x", "\u00b5m"}).tail(n),
                        y    = values_of(table, {"y", "\u00b5m"}).tail(n);
  const double left = 64, top = 30, size = 252;  // px
  const double half = std::max({x.maxCoeff() - x.minCoeff(), y.maxCoeff() - y.minCoeff(), 1e-3}) * 0.55;
  const double x0 = 0.5 * (x.maxCoeff() + x.minCoeff()), y0 = 0.5 * (y.maxCoeff() + y.minCoeff());
  const auto right_of = [&](const double v) { return left + size * (v - y0 + half) / (2 * half); };
  const auto below    = [&](const double v) { return top + size * (v - x0 + half) / (2 * half); };
  Svg svg(340, 340, "path of the inner ring, displacement in \u00b5m");
  svg.text(34, 15, "Path of the inner ring", "title");
  const Ticks across = linear_ticks(y0 - half, y0 + half, 4), along = linear_ticks(x0 - half, x0 + half, 4);
  for (std::size_t i = 0; i < across.at.size(); ++i) {
    svg.line(right_of(across.at[i]), top, right_of(across.at[i]), top + size, "grid");
    svg.text(right_of(across.at[i]), top + size + 16, across.labels[i], "t tx", Anchor::middle);
  }
  for (std::size_t i = 0; i < along.at.size(); ++i) {
    svg.line(left, below(along.at[i]), left + size, below(along.at[i]), "grid");
    svg.text(left - 6, below(along.at[i]) + 4, along.labels[i], "t ty", Anchor::end);
  }
  svg.rect(left, top, size, size, "frame");
  std::vector<Eigen::Vector2d> path;
  for (Eigen::Index i = 0; i < n; ++i)
    path.emplace_back(right_of(y[i]), below(x[i]));
  svg.polyline(path, "pen dark");
  svg.text(left + size / 2, top + size + 34, "across the load [\u00b5m]", "axis", Anchor::middle);
  svg.upright_text(14, top + size / 2, "along the load, downwards [\u00b5m]", "axis");
  return svg.str();
}

std::string spectrum(const Run &run, const Table &table, const std::string &bearing, const char *column,
                     const char *title, const char *unit)
{
  Plot plot;
  plot.title  = title;
  plot.width  = 510;
  plot.height = 340;
  plot.x      = {"frequency", "Hz", Scale::logarithmic};
  plot.y      = {"amplitude density", unit, Scale::logarithmic};
  add_line(plot, table, {"frequency", "Hz"}, {column, unit}, "", Pen::dark);
  for (const Line &line : plot.lines) {
    const double largest = line.y.maxCoeff();
    if (!(largest > 0))
      continue;
    plot.y.low  = 1e-5 * largest;  // five decades below is rounding of a computed motion
    plot.y.high = 2 * largest;
  }
  for (const std::string &name : results_of_bearing(run, bearing))
    for (const auto &[result, label] :
         {std::pair(".motion.frequency", "natural, along"), std::pair(".motion.frequency_across", "across")})
      if (const Result *f = run.find(name + result))
        plot.marks.push_back({f->value, label});
  return svg_plot(plot);
}

std::string contact_sentence(const Run &run, const std::string &bearing)
{
  for (const std::string &name : results_of_bearing(run, bearing))
    if (const Result *share = run.find(name + ".motion.without_contact"))
      return share->value > 0 ? " The rollers carry nothing during " + significant(100 * share->value, 3) +
                                    "\u00a0% of the time: the bearing hammers."
                              : " The rollers carry at every instant.";
  return "";
}

bool complete(const Table &table)
{
  const Eigen::Index n = values_of(table, {"time", "s"}).size();
  return n > 1 && values_of(table, {"x", "\u00b5m"}).size() == n && values_of(table, {"y", "\u00b5m"}).size() == n;
}
}  // namespace

void bearing_motion(Page &page, const Run &run, const std::string &bearing)
{
  const Table *table = run.table("response/bearing-" + bearing);
  const Table *lines = stored_curve(run, curve::bearing_spectrum, bearing);
  if (!lines)
    lines = run.table("response/bearing-" + bearing + "-spectrum");
  if (!table && !lines)
    return;
  page.heading("A mass on bearing " + bearing);
  if (table && complete(*table)) {
    std::string drawings;
    for (const MotionChannel &channel : motion_channels)
      drawings += history(*table, channel, "bearing-" + bearing);
    page.figure(
        {"<div class=\"histories\">\n" + drawings + "</div>\n"},
        "Force of the bearing and place of its inner ring, counted from the concentric position, under the "
        "load with a harmonic force on top." +
            contact_sentence(run, bearing) +
            "<span class=\"zoom-hint\"> Drag to zoom all charts, shift and drag to move, double click to "
            "see all.</span>");
    page.figure(
        {last_moments(*table), orbit(*table)},
        "The last " + fixed(1e3 * close_up, 0) +
            " ms. The force of the bearing points to its middle, so that across the load it is softer than "
            "along it, and a motion in one direction stays in it; where the path is not a line, both are driven.");
  } else
    page.absent("Histories of the mass on the bearing are", "response/bearing-" + bearing + ".csv");
  if (lines)
    page.figure(
        {spectrum(run, *lines, bearing, "acceleration", "Acceleration along the driving force", "g/\u221aHz"),
         spectrum(run, *lines, bearing, "force", "Force of the bearing", "N/\u221aHz")},
        "Spectra, with the natural frequency of small motions. The driving force has one line; its multiples come "
        "from the curve of the bearing, which is not straight.");
  else
    page.absent("Spectra of the mass on the bearing are", curve_path(curve::bearing_spectrum, bearing) + ".csv");
}
}  // namespace mill::report
