#include "core/records/rows_of_bearing.h"
#include "report/bearing/figures.h"
#include "report/page/curves.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include <cmath>

namespace mill::report {
namespace {
struct Compared {
  Eigen::VectorXd published, roller_load, secant, tangent, fit_secant, fit_tangent;  // kN/mm, kN
  double total = 0, assembled_secant = 0, assembled_tangent = 0;                     // kN/mm; 0: not stored
};

std::string stiffness_cell(const double computed, const double published)
{
  if (!(computed > 0))
    return "<td class=\"num\">\u2013</td>";
  return "<td class=\"num\">" + significant(computed, computed >= 1e4 ? 5 : 4) +
         (published > 0 ? " <span class=\"deviation\">(" + percent(computed / published - 1) + ")</span>" : "") +
         "</td>";
}

std::string load_cell(const Eigen::VectorXd &loads, const Eigen::Index row)
{
  return "<td class=\"num\">" + (loads.size() > row ? significant(loads[row], 4) : "\u2013") + "</td>";
}

std::string line(const std::string &head, const double published, const double secant, const double tangent,
                 const bool total = false)
{
  return std::string(total ? "<tr class=\"total\">" : "<tr>") + "<th scope=\"row\">" + head +
         "</th><td class=\"num\">" +
         (published > 0 ? significant(published, published >= 1e4 ? 5 : 4) : "\u2013") + "</td><td></td>" +
         stiffness_cell(secant, published) + stiffness_cell(tangent, published) + "<td></td><td></td></tr>\n";
}

// 4.0847 for 39 rollers: heaviest roller over mean roller of a row whose one half is loaded, Q ~ approach^(10/9).
double stribeck_number(const double rollers)
{
  double sum = 0;
  for (int j = 0; j < int(rollers); ++j)
    sum += std::pow(std::max(0.0, std::cos(double(2 * EIGEN_PI) * j / rollers)), 19.0 / 9);
  return rollers / sum;
}

double value_in(const Run &run, const std::string &name)
{
  const Result *result = run.find(name);
  return result && std::isfinite(result->value) ? 1e-6 * result->value : 0;
}

Compared compared(const Run &run, const Table &table, const std::string &result)
{
  Compared c{values_of(table, {"published", "kN/mm"}),
             values_of(table, {"roller_load", "kN"}),
             values_of(table, {"secant", "kN/mm"}),
             values_of(table, {"tangent", "kN/mm"}),
             values_of(table, {"load_that_fits_secant", "kN"}),
             values_of(table, {"load_that_fits_tangent", "kN"})};
  c.assembled_secant  = value_in(run, row::bearing::secant.of(result));
  c.assembled_tangent = value_in(run, row::bearing::tangent.of(result));
  for (const RowOf<1> *one : {&row::bearing::rollers_times_Z5, &row::bearing::tangent})
    if (const Result *stored = run.find(one->of(result)); stored && c.total == 0)
      for (const CheckId id : {CheckId::published_total, CheckId::published})
        if (const Check *check = find_check(stored->checks, id))
          c.total = 1e-6 * check->value;
  return c;
}

std::string row_lines(const Compared &c)
{
  std::string lines;
  for (Eigen::Index row = 0; row < c.published.size(); ++row)
    lines += "<tr><th scope=\"row\">one roller of row " + std::to_string(row + 1) + "</th><td class=\"num\">" +
             significant(c.published[row], 4) + "</td>" + load_cell(c.roller_load, row) +
             stiffness_cell(c.secant[row], c.published[row]) + stiffness_cell(c.tangent[row], c.published[row]) +
             load_cell(c.fit_secant, row) + load_cell(c.fit_tangent, row) + "</tr>\n";
  return lines;
}

std::string caption(const Compared &c, const double rollers, const double sum, const std::string &where)
{
  std::string text =
      "Published stiffnesses compared with this run" + (where.empty() ? "" : " at " + escaped(where)) +
      ", each with how far the computed one is from it; on the right the roller load at which the law of this run "
      "takes the published value.";
  if (rollers > 0 && sum > 0) {
    text += " <b>The factor Z/5.</b> The four published row values have the size of one roller's stiffness. Their "
            "sum, " +
            significant(sum, 5) + "\u00a0kN/mm, times Z/5 = " + fixed(rollers, 0) +
            "/5 = " + fixed(rollers / 5, 1) + " is " + significant(sum * rollers / 5, 5) + "\u00a0kN/mm";
    if (c.total > 0)
      text += ", which is " + percent(sum * rollers / 5 / c.total - 1) + " from the published total of " +
              significant(c.total, 4) + "\u00a0kN/mm";
    text += ". Five is the usual number for the heaviest roller of a bearing with clearance, "
            "Q<sub>max</sub> = 5F/(iZ); it includes neither the contact angle nor the clearance of this bearing.";
  }
  return text;
}
}  // namespace

void published_comparison(Page &page, const Run &run, const std::string &bearing)
{
  const Table *table = stored_curve(run, curve::bearing_published, bearing);
  if (!table)
    return;
  std::string result;
  for (const std::string &name : results_of_bearing(run, bearing))
    if (result.empty() || (!run.find(result + ".rollers_times_Z5") && run.find(name + ".rollers_times_Z5")))
      result = name;
  const Compared c     = compared(run, *table, result);
  const Eigen::Index n = c.published.size();
  if (n == 0 || c.secant.size() != n || c.tangent.size() != n)
    return;
  const Table *ring    = stored_curve(run, curve::bearing_rollers, bearing);
  const double rollers = ring ? double(values_of(*ring, {"angle", "rad"}).size()) : 0, sum = c.published.sum();
  std::string body = row_lines(c);
  body += line("sum of these rollers", sum, c.secant.sum(), c.tangent.sum());
  if (rollers > 0)
    body += line("sum \u00d7 Z/5 = sum \u00d7 " + fixed(rollers / 5, 1), sum * rollers / 5,
                 c.secant.sum() * rollers / 5, c.tangent.sum() * rollers / 5);
  if (const double cosine = std::cos(run.bearing(bearing)("cup_angle")); rollers > 0 && std::isfinite(cosine)) {
    const double number = stribeck_number(rollers);
    const double factor = rollers * cosine * cosine / number;
    body += line("sum \u00d7 Z cos\u00b2\u03b1/" + fixed(number, 4) + " = sum \u00d7 " + fixed(factor, 2) +
                     "<small>rigid rings, no clearance</small>",
                 sum * factor, c.secant.sum() * factor, c.tangent.sum() * factor);
  }
  body +=
      line("the bearing: published total, assembled here", c.total, c.assembled_secant, c.assembled_tangent, true);
  const Result *working_point = run.find(result + ".tangent");
  page.table("<table><thead><tr><th></th><th>published [kN/mm]</th><th>heaviest roller [kN]</th><th>secant "
             "[kN/mm]</th><th>tangent [kN/mm]</th><th>secant fits at [kN]</th><th>tangent fits at "
             "[kN]</th></tr></thead>\n<tbody>\n" +
                 body + "</tbody></table>\n",
             caption(c, rollers, sum, working_point ? working_point->at : ""));
}
}  // namespace mill::report
