#include "report/twin/analysis/mode_figures.h"
#include "report/front/html.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/svg_plot.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace mill::report {
namespace {
constexpr double width = 1000, height = 330;  // px
constexpr double lowest_shown = 5;            // Hz

std::string in_cell(const std::string &text, const bool number = true)
{
  return (number ? "<td class=\"num\">" : "<td>") + text + "</td>";
}

std::string head_row(const std::vector<std::string> &names)
{
  std::string text = "<table class=\"results\"><thead><tr>";
  for (const std::string &name : names)
    text += "<th>" + name + "</th>";
  return text + "</tr></thead>\n<tbody>\n";
}

bool ends_with(const std::string &name, const std::string &ending)
{
  return name.size() > ending.size() && name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

Pen pen_of(const std::size_t i)
{
  constexpr std::array<Pen, 6> pens{Pen::dark, Pen::warm, Pen::dashed, Pen::dotted, Pen::pale, Pen::chained};
  return pens[i % pens.size()];
}

// Poles of one class as dots.
Line dots(const Table &poles, const std::string &label, const Pen pen, const bool stable, const bool confirmed)
{
  const Eigen::VectorXd &order = *poles.column("order"), &frequency = *poles.column("frequency"),
                        &is_stable = *poles.column("stable"), *is_confirmed = poles.column("confirmed");
  std::vector<std::pair<double, double>> points;
  for (Eigen::Index i = 0; i < order.size(); ++i)
    if ((is_stable[i] > 0) == stable && (is_confirmed && (*is_confirmed)[i] > 0) == confirmed)
      points.emplace_back(frequency[i], order[i]);
  std::sort(points.begin(), points.end());
  const auto n = Eigen::Index(points.size());
  Line line{label, Eigen::VectorXd(n), Eigen::VectorXd(n), pen, true, false};
  for (Eigen::Index i = 0; i < n; ++i) {
    line.x[i] = points[std::size_t(i)].first;
    line.y[i] = points[std::size_t(i)].second;
  }
  return line;
}

// Rows from the lowest frequency that is shown on.
Eigen::Index first_shown(const Eigen::VectorXd &frequency)
{
  Eigen::Index first = 0;
  while (first + 2 < frequency.size() && frequency[first] < lowest_shown)
    ++first;
  return first;
}
}  // namespace

std::string mode_rows(const Table &modes)
{
  std::string rows;
  const auto value_in = [&](const char *name, const Eigen::Index i) { return (*modes.column(name))[i]; };
  for (Eigen::Index i = 0; i < modes.columns[0].size(); ++i)
    rows += "<tr>" + in_cell("<b>" + fixed(value_in("frequency", i), 2) + "</b>") +
            in_cell(significant(value_in("frequency_law", i), 2)) +
            in_cell(significant(100 * value_in("damping", i), 3) + " %") +
            in_cell(significant(100 * value_in("damping_law", i), 2) + " %") +
            in_cell(fixed(value_in("orders", i), 0)) +
            in_cell(value_in("confirmed", i) > 0 ? "both halves" : "not confirmed", false) + "</tr>\n";
  return head_row(
             {"frequency [Hz]", "sd by the law", "damping", "sd by the law", "orders of 15", "confirmed by"}) +
         rows + "</tbody></table>\n";
}

std::string forced_mode_rows(const Table &modes)
{
  std::string rows;
  const auto at    = [&](const char *name, const Eigen::Index i) { return (*modes.column(name))[i]; };
  const auto range = [](const double value, const double sd, const int digits) {
    return fixed(value - 1.96 * sd, digits) + " \u2026 " + fixed(value + 1.96 * sd, digits);
  };
  for (Eigen::Index i = 0; i < modes.columns[0].size(); ++i)
    rows += "<tr>" + in_cell("<b>" + fixed(at("frequency", i), 3) + "</b>") +
            in_cell(range(at("frequency", i), at("frequency_sd", i), 3)) +
            in_cell("<b>" + fixed(100 * at("damping", i), 3) + " %</b>") +
            in_cell(range(100 * at("damping", i), 100 * at("damping_sd", i), 3) + " %") +
            in_cell(fixed(at("coherence", i), 3)) +
            in_cell(at("confirmed", i) > 0 ? "both halves" : "not confirmed", false) + "</tr>\n";
  return head_row({"frequency [Hz]", "95 %", "damping", "95 %", "coherence", "confirmed by"}) + rows +
         "</tbody></table>\n";
}

std::string stability_drawing(const Table &poles, const Table *singular)
{
  if (!poles.column("order") || !poles.column("frequency") || !poles.column("stable") ||
      poles.columns[0].size() == 0)
    return "";
  Plot plot;
  plot.width  = width;
  plot.height = height;
  plot.x      = {"frequency", "Hz", Scale::logarithmic};
  plot.y      = {"model order", "-"};
  plot.y.low  = 8;
  plot.y.high = 42;
  if (singular) {
    const Eigen::VectorXd &x = singular->columns[0], &y = singular->columns[1];
    const Eigen::Index first = first_shown(x), n = x.size() - first;
    const Eigen::VectorXd level = y.tail(n).cwiseMax(1e-300).array().log().matrix();
    const double low = level.minCoeff(), high = level.maxCoeff();
    plot.x.low = x[first];
    plot.lines.push_back({"first singular value", x.tail(n),
                          (9 + 31 * (level.array() - low) / std::max(1e-9, high - low)).matrix(), Pen::warm});
  }
  plot.lines.push_back(dots(poles, "other", Pen::pale, false, false));
  plot.lines.push_back(dots(poles, "stable", Pen::shade3, true, false));
  plot.lines.push_back(dots(poles, "confirmed", Pen::dark, true, true));
  return svg_plot(plot);
}

std::string response_drawing(const Table &response, const Table *modes)
{
  const Eigen::VectorXd &x = response.columns[0];
  const Eigen::Index first = first_shown(x), n = x.size() - first;
  Plot plot;
  plot.width  = width;
  plot.height = height;
  plot.x      = {"frequency", "Hz", Scale::logarithmic};
  plot.y      = {"response per force", "-", Scale::logarithmic};
  for (std::size_t c = 0; c + 1 < response.columns.size(); ++c)
    if (ends_with(response.names[c], "_real") && ends_with(response.names[c + 1], "_imag")) {
      const auto size =
          (response.columns[c].tail(n).array().square() + response.columns[c + 1].tail(n).array().square())
              .sqrt()
              .matrix();
      plot.y.unit = unit_sign(response.units[c]);
      plot.lines.push_back(
          {response.names[c].substr(0, response.names[c].size() - 5), x.tail(n), size, pen_of(plot.lines.size())});
    }
  if (modes)
    for (Eigen::Index i = 0; i < modes->columns[0].size(); ++i)
      if ((*modes->column("confirmed"))[i] > 0)
        plot.marks.push_back({(*modes->column("frequency"))[i], fixed((*modes->column("frequency"))[i], 1)});
  return svg_plot(plot);
}

std::string coherence_drawing(const Table &response)
{
  const Eigen::VectorXd &x = response.columns[0];
  const Eigen::Index first = first_shown(x), n = x.size() - first;
  Plot plot;
  plot.width  = width;
  plot.height = 220;
  plot.x      = {"frequency", "Hz", Scale::logarithmic};
  plot.y      = {"coherence", "-"};
  plot.y.low  = 0;
  plot.y.high = 1;
  for (std::size_t c = 1; c < response.columns.size(); ++c)
    if (ends_with(response.names[c], "_coherence"))
      plot.lines.push_back({response.names[c].substr(0, response.names[c].size() - 10), x.tail(n),
                            response.columns[c].tail(n), pen_of(plot.lines.size())});
  return svg_plot(plot);
}
}  // namespace mill::report
