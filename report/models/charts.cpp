#include "report/models/figures.h"
#include "report/page/curves.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/svg_plot.h"
#include "report/plot/ticks.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
// Columns of the chart of the masses, px.
constexpr double number_end = 46, added_start = 62, chart_start = 300, chart_end = 690, right_start = 714,
                 missing_start = 800, chart_width = 1040, row_height = 26, head_height = 44;

// As many frequencies as fit, and how many more there are.
std::string missing_list(const std::vector<double> &missing, const double width)
{
  std::string text;
  for (std::size_t i = 0; i < missing.size(); ++i) {
    const std::string next = (text.empty() ? "" : text + ", ") + fixed(missing[i], 0);
    const std::string rest =
        i + 1 < missing.size() ? ", +" + std::to_string(missing.size() - i - 1) + " more" : std::string();
    if (text_width(next + rest, 12) > width)
      return text + ", +" + std::to_string(missing.size() - i) + " more";
    text = next;
  }
  return text.empty() ? "none" : text;
}
}  // namespace

std::string masses_chart(const ModelData &data)
{
  const auto &rows = data.masses_needed;
  double low = 1, high = 10;  // %
  for (const MassesRow &row : rows)
    if (row.worst_error > 0) {
      low  = std::min(low, 100 * row.worst_error);
      high = std::max(high, 100 * row.worst_error);
    }
  if (rows.empty())
    return "";
  low                 = std::pow(10, std::floor(std::log10(low)));
  high                = 1.15 * high;
  const double bottom = head_height + double(rows.size()) * row_height;
  Svg svg(chart_width, bottom + 46, "worst frequency error in percent over the number of masses");
  const auto to_x = [&](const double percent) {
    return chart_start + std::log(percent / low) / std::log(high / low) * (chart_end - chart_start);
  };
  svg.text(number_end, 32, "masses", "axis", Anchor::end);
  svg.text(added_start, 32, "the last one added", "axis");
  svg.text(right_start, 32, "right", "axis");
  svg.text(missing_start, 32, "missing modes [Hz]", "axis");
  const Ticks ticks = log_ticks(low, high, 6);
  for (const double position : ticks.minor)
    svg.line(to_x(position), head_height, to_x(position), bottom, "grid minor");
  for (std::size_t i = 0; i < ticks.at.size(); ++i) {
    svg.line(to_x(ticks.at[i]), head_height, to_x(ticks.at[i]), bottom, "grid");
    svg.text(to_x(ticks.at[i]), bottom + 16, ticks.labels[i], "t tx", Anchor::middle);
  }
  svg.rect(chart_start, head_height, chart_end - chart_start, bottom - head_height, "frame");
  svg.text((chart_start + chart_end) / 2, bottom + 36, "worst frequency error of the modes that are shown [%]",
           "axis", Anchor::middle);
  std::vector<Eigen::Vector2d> curve;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double y = head_height + (double(i) + 0.5) * row_height;
    svg.line(added_start, y + row_height / 2, chart_width, y + row_height / 2, "grid");
    svg.text(number_end, y + 4, std::to_string(rows[i].masses), "t strong", Anchor::end);
    svg.text(added_start, y + 4, shortened(rows[i].added, chart_start - added_start - 20, 12), "t");
    svg.text(right_start, y + 4,
             std::to_string(rows[i].right) + " of " + std::to_string(rows[i].modes_below_limit), "t");
    svg.text(missing_start, y + 4, missing_list(rows[i].missing, chart_width - missing_start), "t");
    if (rows[i].worst_error > 0)
      curve.emplace_back(to_x(std::max(low, 100 * rows[i].worst_error)), y);
  }
  svg.polyline(curve, "pen dark");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!(rows[i].worst_error > 0))
      continue;
    const double x = to_x(100 * rows[i].worst_error), y = head_height + (double(i) + 0.5) * row_height;
    svg.circle(x, y, 4, rows[i].missing.empty() ? "dot dark" : "dot warm");
    // Below the curve where it falls to the left, above it where it comes back.
    const bool last = i + 1 == rows.size(), falls = !last && rows[i + 1].worst_error < rows[i].worst_error;
    const bool left = x + 60 > chart_end || (last && x > chart_start + 60);
    svg.text(x + (left ? -9 : 9), y + (left || !falls ? 0 : 10), significant(100 * rows[i].worst_error, 2) + " %",
             "flag halo", left ? Anchor::end : Anchor::start);
  }
  svg.circle(chart_start + 6, 16, 4, "dot warm");
  svg.text(chart_start + 16, 20, "modes are missing", "t");
  svg.circle(chart_start + 146, 16, 4, "dot dark");
  svg.text(chart_start + 156, 20, "every mode is shown", "t");
  return svg.str();
}

std::string mac_map(const ModelData &data)
{
  const MacTable &mac  = data.mac;
  const Eigen::Index n = mac.values.rows(), m = mac.values.cols();
  if (n == 0 || m == 0)
    return "";
  const double cell = std::clamp(760.0 / double(std::max(n, m)), 20.0, 44.0), left = 96, top = 34;
  const double right = left + double(m) * cell, bottom = top + double(n) * cell;
  const std::string rows = data.title(mac.rows), columns = data.title(mac.columns);
  Svg svg(right + 120, bottom + 76, "modal assurance between " + rows + " and " + columns);
  svg.text(34, 18, "Modal assurance, 0 .. 1", "title");
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < m; ++j) {
      const double v = mac.values(i, j), x = left + double(j) * cell, y = top + double(i) * cell;
      if (!(v >= 0.05))
        continue;
      const int step = std::clamp(int(8 * v), 0, 7);
      svg.rect(x, y, cell, cell, "heat h" + std::to_string(step));
      if (cell >= 30 && v >= 0.1)
        svg.text(x + cell / 2, y + cell / 2 + 4, fixed(v, 2), step >= 4 ? "t on-dark" : "t", Anchor::middle);
    }
  for (Eigen::Index i = 0; i <= n; ++i)
    svg.line(left, top + double(i) * cell, right, top + double(i) * cell, "grid");
  for (Eigen::Index j = 0; j <= m; ++j)
    svg.line(left + double(j) * cell, top, left + double(j) * cell, bottom, "grid");
  svg.rect(left, top, right - left, bottom - top, "frame");
  for (Eigen::Index i = 0; i < n; ++i)
    svg.text(left - 6, top + (double(i) + 0.5) * cell + 4, fixed(mac.row_frequency[i], 1), "t ty", Anchor::end);
  for (Eigen::Index j = 0; j < m; ++j)
    svg.upright_text(left + (double(j) + 0.5) * cell + 4, bottom + 24, fixed(mac.column_frequency[j], 1), "t tx");
  svg.text((left + right) / 2, bottom + 66, columns + ", frequency [Hz]", "axis", Anchor::middle);
  svg.upright_text(20, (top + bottom) / 2, rows + ", frequency [Hz]", "axis");
  const double scale = std::min(22.0, (bottom - top) / 8);
  for (int s = 0; s < 8; ++s) {
    svg.rect(right + 24, top + (7 - s) * scale, 16, scale, "heat h" + std::to_string(s));
    svg.text(right + 46, top + (7.5 - s) * scale + 4, fixed(s / 8.0, 2) + " \u2013 " + fixed((s + 1) / 8.0, 2),
             "t small");
  }
  return svg.str();
}

std::string kept_chart(const KeptModes &kept, const double limit)
{
  const Eigen::Index n = Eigen::Index(kept.kept.size()), m = kept.frequency.size();
  if (n < 2 || m < 1 || !(kept.error.cwiseAbs().array() > 0).any())
    return "";
  Plot plot;
  plot.width  = 720;
  plot.height = 400;
  plot.title  = "Convergence of the frequencies" +
               (std::isfinite(limit) ? " below " + significant(limit, 4) + " Hz" : std::string());
  plot.x = {"modes kept of each part", "-"};
  plot.y = {"frequency error", "%", Scale::logarithmic};
  const Eigen::VectorXd x =
      Eigen::VectorXd::NullaryExpr(n, [&](const Eigen::Index i) { return double(kept.kept[std::size_t(i)]); });
  const Eigen::MatrixXd error = 100 * kept.error.cwiseAbs();
  const auto add = [&](const std::string &label, const Eigen::VectorXd &y, const Pen pen, const bool markers) {
    plot.lines.push_back({label, x, y, pen, markers});
  };
  for (Eigen::Index mode = 1; mode + 1 < m; ++mode)
    add(mode == 1 ? "modes between" : "", error.col(mode), Pen::pale, false);
  if (m > 1)
    add("highest mode, " + fixed(kept.frequency[m - 1], 1) + " Hz", error.col(m - 1), Pen::dashed, false);
  add("lowest mode, " + fixed(kept.frequency[0], 1) + " Hz", error.col(0), Pen::warm, true);
  Eigen::VectorXd worst = Eigen::VectorXd::Constant(n, std::nan(""));
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index mode = 0; mode < m; ++mode)
      if (error(i, mode) >= 0 && !(worst[i] >= error(i, mode)))
        worst[i] = error(i, mode);
  if (m > 1)
    add("worst of all", worst, Pen::dark, true);
  return svg_plot(plot);
}

std::vector<ForceReach> force_reach(const Run &run)
{
  std::vector<ForceReach> all;
  for (const PassInfo &pass : run.manifest.passes) {
    const Table *table = run.table("response/" + pass.slug + "-spectrum");
    if (!table)
      continue;
    const Eigen::VectorXd f        = values_of(*table, {"frequency", "Hz"});
    const Eigen::VectorXd *density = table->column("force");
    if (!density || f.size() < 3 || density->size() != f.size())
      continue;
    Eigen::VectorXd power = Eigen::VectorXd::Zero(f.size());  // cumulated, by trapezoids
    for (Eigen::Index i = 1; i < f.size(); ++i) {
      const double step = 0.5 * (std::pow((*density)[i], 2) + std::pow((*density)[i - 1], 2)) * (f[i] - f[i - 1]);
      power[i]          = power[i - 1] + (std::isfinite(step) ? step : 0);
    }
    const double whole = power[f.size() - 1];
    if (!(whole > 0))
      continue;
    Eigen::Index i = 0;
    while (power[i] < 0.99 * whole)
      ++i;
    all.push_back({pass.name, f[i]});
  }
  return all;
}
}  // namespace mill::report
