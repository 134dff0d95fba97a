#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/svg_plot.h"
#include "report/schedule/figures.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
std::string numeric(const double value, const int digits = 4)
{
  return "<td class=\"num\">" + significant(value, digits) + "</td>";
}

std::string numeric_strong(const double value, const int digits = 4)
{
  return "<td class=\"num\"><b>" + significant(value, digits) + "</b></td>";
}

std::string share_cell(const double value, const double reference)
{
  return "<td class=\"num\">" + (value > 0 && reference > 0 ? percent(value / reference - 1) : "\u2013") + "</td>";
}

std::string row_of(const std::string &name, const std::string &cells)
{
  return "<tr><th scope=\"row\">" + escaped(name) + "</th>" + cells + "</tr>\n";
}

std::string whole_table(const std::vector<std::string> &head, const std::string &rows)
{
  if (rows.empty())
    return "";
  std::string text = "<table><thead><tr>";
  for (const std::string &column : head)
    text += "<th>" + column + "</th>";
  return text + "</tr></thead>\n<tbody>\n" + rows + "</tbody></table>\n";
}

std::string range_cell(const std::array<double, 2> &range)
{
  return "<td class=\"num\">" +
         (range[1] > 0 ? significant(range[0] / 1e3, 4) + " \u2026 " + significant(range[1] / 1e3, 4) : "\u2013") +
         "</td>";
}

bool is_fitted(const PassForce &pass)
{
  return !std::isnan(pass.fitted_to);
}

const TheoryForce *theory_named(const PassForce &pass, const std::string &key)
{
  for (const TheoryForce &theory : pass.theories)
    if (theory.key == key && theory.refused.empty())
      return &theory;
  return nullptr;
}

// Theories of all passes in the order of the first that has them: key and name.
std::vector<std::pair<std::string, std::string>> all_theories(const ScheduleData &data)
{
  std::vector<std::pair<std::string, std::string>> all;
  for (const PassForce &pass : data.passes)
    for (const TheoryForce &theory : pass.theories)
      if (theory.refused.empty() &&
          std::none_of(all.begin(), all.end(), [&](const auto &known) { return known.first == theory.key; }))
        all.emplace_back(theory.key, theory.name);
  return all;
}
}  // namespace

std::string fit_table(const ScheduleData &data)
{
  std::string rows;
  for (const PassForce &p : data.passes) {
    const double R = p.rigid.radius;
    rows += row_of(p.name, "<td class=\"num\">" + significant(1e3 * p.entry_thickness, 4) + " \u2192 " +
                               significant(1e3 * p.exit_thickness, 4) + "</td>" +
                               numeric(p.entry_tension / 1e6, 3) + numeric(p.exit_tension / 1e6, 3) +
                               numeric(p.speed, 4) + numeric(p.friction, 3) + range_cell(p.measured) +
                               numeric(p.published / 1e3) + numeric_strong(p.fitted_to / 1e3) +
                               numeric(p.rigid.mean_pressure / 1e6) + numeric(p.rigid.flow_stress / 1e6) +
                               numeric(p.flat.radius / R, 3) + numeric(p.radius_beyond / R, 3) +
                               numeric(p.flat.mean_pressure / 1e6) + numeric_strong(p.flat.flow_stress / 1e6));
  }
  return whole_table({"pass", "thickness [mm]", "back tension [MPa]", "front [MPa]", "speed [m/s]", "friction",
                      "measured [kN]", "published [kN]", "fitted to [kN]", "mean pressure, rigid [MPa]",
                      "<i>k</i>, rigid [MPa]", "<i>R\u2032/R</i>", "beyond 5.235", "mean pressure [MPa]",
                      "<i>k</i>, flattened [MPa]"},
                     rows);
}

std::string factor_table(const ScheduleData &data)
{
  std::string rows;
  for (const PassForce &p : data.passes)
    rows += row_of(p.name, numeric(p.flat.neutral_point, 3) + numeric(p.flat.peak_pressure / 1e6) +
                               numeric(p.factor_exact) + numeric(p.factor_published) + numeric(p.factor_of_mean) +
                               numeric(p.power / 1e3) + numeric(p.roll_force / 1e3) + numeric(p.torque));
  return whole_table({"pass", "neutral point over arc", "peak pressure [MPa]", "friction factor, exact",
                      "as published", "2\u03bcp/<i>k</i>", "power [kW]", "force at one roll [kN]", "torque [N m]"},
                     rows);
}

std::string hardening_table(const ScheduleData &data)
{
  std::string rows;
  for (const ScheduleLaw &law : data.laws)
    for (std::size_t i = 0; i < std::min(law.passes.size(), data.passes.size()); ++i) {
      const PassForce &pass = data.passes[i];
      const LawPass &result = law.passes[i];
      rows += row_of(pass.name, std::string("<td>") + (law.flattened ? "flattened" : "rigid") +
                                    (pass.in_common_fit ? "" : ", blind") + "</td>" +
                                    numeric(result.flow_stress / 1e6) + numeric_strong(result.force / 1e3) +
                                    share_cell(result.force, pass.fitted_to) + numeric(result.friction, 3) +
                                    numeric(result.blind_force / 1e3) +
                                    share_cell(result.blind_force, pass.fitted_to));
    }
  return whole_table({"pass", "rolls", "<i>k</i> by the law [MPa]", "force [kN]", "off", "friction needed",
                      "force by a law of the others [kN]", "off"},
                     rows);
}

std::string dynamic_table(const ScheduleData &data)
{
  std::string rows;
  for (const DynamicForces &all : data.dynamics)
    for (const DynamicForce &f : all.passes)
      rows += row_of(f.name, std::string("<td>") + (all.flattened ? "flattened" : "rigid") +
                                 (f.in_fit ? "" : ", blind") + "</td>" + numeric(f.printed / 1e3, 3) +
                                 numeric(f.per_displacement / 1e9) + numeric(1e9 * f.displacement, 3) +
                                 numeric(1e6 * f.constant, 3) + numeric_strong(f.with_common / 1e3, 3) +
                                 share_cell(f.with_common, f.printed));
  return whole_table({"pass", "rolls", "published [kN]", "per displacement [kN/\u00b5m]", "displacement [nm]",
                      "own constant [mm\u00b2/s]", "by the common one [kN]", "off"},
                     rows);
}

std::string theory_table(const ScheduleData &data)
{
  const auto theories = all_theories(data);
  std::vector<std::string> head{"theory"};
  for (const PassForce &pass : data.passes)
    head.push_back(escaped(pass.name) + " [kN]");
  std::string rows;
  for (const auto &[key, name] : theories) {
    std::string cells;
    for (const PassForce &pass : data.passes) {
      const TheoryForce *theory = theory_named(pass, key);
      cells += "<td class=\"num\">" +
               (theory ? significant(theory->force / 1e3, 4) +
                             (is_fitted(pass) ? " (" + percent(theory->force / pass.fitted_to - 1) + ")" : "")
                       : "\u2013") +
               "</td>";
    }
    rows += row_of(name, cells);
  }
  return whole_table(head, rows);
}

std::string force_drawing(const ScheduleData &data)
{
  Plot plot;
  plot.title  = "Rolling force of the passes";
  plot.width  = 1000;
  plot.height = 360;
  plot.x      = {"pass", "-"};
  plot.y      = {"force", "kN", Scale::linear, 0};
  for (const PassForce &pass : data.passes)
    plot.x.categories.push_back(pass.name);
  const auto bars = [&](const std::string &label, const Pen pen, const auto &value) {
    Bars b{label, Eigen::VectorXd(Eigen::Index(data.passes.size())), pen};
    for (std::size_t i = 0; i < data.passes.size(); ++i)
      b.height[Eigen::Index(i)] = value(i) / 1e3;
    if (b.height.array().isFinite().any())
      plot.bars.push_back(b);
  };
  bars("fitted to", Pen::dark, [&](const std::size_t i) { return data.passes[i].fitted_to; });
  const auto by_theory = [&](const std::string &label, const Pen pen, const std::string &key) {
    bars(label, pen, [&](const std::size_t i) {
      const TheoryForce *theory = theory_named(data.passes[i], key);
      return theory ? theory->force : not_given;
    });
  };
  by_theory("same k, rigid roll", Pen::pale, "closed-rigid");
  by_theory("same k, free arc", Pen::warm, "karman-elastic-arc");
  by_theory("same k, finite elements", Pen::dashed, "fe");
  for (const ScheduleLaw &law : data.laws)
    if (law.flattened)
      bars("one hardening law", Pen::dotted,
           [&](const std::size_t i) { return i < law.passes.size() ? law.passes[i].force : not_given; });
  return plot.bars.empty() ? "" : svg_plot(plot);
}
}  // namespace mill::report
