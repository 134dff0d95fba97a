#include "core/base/source_text.h"
#include "core/model/bite_setup.h"
#include "core/records/rows_of_bite.h"
#include "report/bite/figures.h"
#include "report/page/curves.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/results/names.h"
#include <algorithm>
#include <cmath>

// What measured values say of friction and flow stress.
namespace mill::report {
namespace {
using Eigen::VectorXd;

double fit_value(const Run &run, const RowOf<1> &row, const std::string &number)
{
  const Result *result = run.find(row.of(number));
  return result ? result->value : std::nan("");
}

struct FittedNumber {
  const Result *result;
  std::string name;  // "friction"
};

// Numbers of the fit: those that have an interval, or were kept.
std::vector<FittedNumber> fitted_numbers(const Run &run)
{
  std::vector<FittedNumber> numbers;
  for (const Result &result : run.results)
    if (const auto id = result_id(result.name); id && id->is_of(row::bite_fit::number)) {
      const std::string name = id->place("number");
      if (run.find(row::bite_fit::number_low.of(name)) || source_in(result.source).source == Source::given)
        numbers.push_back({&result, name});
    }
  return numbers;
}

// The part of a line inside a window, the rest as gaps.
VectorXd inside(const VectorXd &x, const VectorXd &y, const Axis &ax, const Axis &ay)
{
  VectorXd out = y;
  for (Eigen::Index i = 0; i < y.size(); ++i)
    if (!(x[i] >= ax.low && x[i] <= ax.high && y[i] >= ay.low && y[i] <= ay.high))
      out[i] = std::nan("");
  return out;
}

Axis around(const std::string &quantity, const VectorXd &values)
{
  Axis axis{quantity, "-"};
  const double low = values.minCoeff(), high = values.maxCoeff(), room = 0.4 * (high - low);
  axis.low  = std::max(0., low - room);
  axis.high = high + room;
  return axis;
}
}  // namespace

bool has_fit(const Run &run)
{
  return !fitted_numbers(run).empty();
}

std::string fit_table(const Run &run)
{
  std::string body;
  for (const auto &[number, name] : fitted_numbers(run)) {
    const double low       = fit_value(run, row::bite_fit::number_low, name),
                 high      = fit_value(run, row::bite_fit::number_high, name);
    const Shown shown      = engineering(number->value, number->unit);
    const double unit      = shown.value / number->value;
    const auto cell        = [](const std::string &text) { return "<td class=\"num\">" + text + "</td>"; };
    const std::string sign = unit_sign(shown.unit);
    body += "<tr><th scope=\"row\">" + escaped(meaning_of(number->name)) + "<small>" + escaped(number->name) +
            "</small></th>" + cell(significant(shown.value) + (sign.empty() ? "" : "\u00a0" + sign)) +
            (std::isfinite(low) ? cell(significant(unit * low) + " \u2026 " + significant(unit * high))
                                : "<td>kept: the measured values do not identify it</td>") +
            cell(number->checks.empty() ? "\u2013" : significant(unit * number->checks.front().value)) + "</tr>\n";
  }
  return body.empty() ? ""
                      : "<table><thead><tr><th>number</th><th>value</th><th>95 % interval</th><th>by the slab "
                        "alone</th></tr></thead>\n<tbody>\n" +
                            body + "</tbody></table>\n";
}

std::string fit_residuals(const Run &run)
{
  std::string body;
  for (const Result &result : run.results) {
    const auto id = result_id(result.name);
    if (!id || !id->is_of(row::bite_fit::residual))
      continue;
    const auto measure = choice_named<PassMeasure>(id->place("measure"));
    body += "<tr><th scope=\"row\">" + escaped(id->place("pass")) + "</th><td>" +
            (measure == PassMeasure::force  ? "rolling force"
             : measure == PassMeasure::slip ? "forward slip"
                                            : "torque of a roll") +
            "</td><td class=\"num\">" + fixed(result.value, 2) + "</td></tr>\n";
  }
  return body.empty() ? ""
                      : "<table><thead><tr><th>pass</th><th>measured</th><th>model less measured, standard "
                        "deviations</th></tr></thead>\n<tbody>\n" +
                            body + "</tbody></table>\n";
}

std::string fit_region(const Run &run)
{
  const Table *region = stored_curve(run, curve::bite_fit);
  if (!region)
    return "";
  const VectorXd x = values_of(*region, {"friction", "-"}), y = values_of(*region, {"flow_stress_factor", "-"});
  if (x.size() < 3 || y.size() != x.size())
    return "";
  Plot plot;
  plot.title = "Friction and flow stress that the measured values allow";
  plot.width = 700;
  plot.x =
      around(run.find(row::bite_fit::number.of("friction")) ? "friction \u00b5" : "factor on the friction", x);
  plot.y = around("factor on the flow stress", y);
  plot.lines.push_back({"both with 95 %", x, y, Pen::dark});
  if (const Table *lines = stored_curve(run, curve::bite_fit_lines)) {
    const Pen pens[] = {Pen::warm, Pen::dashed, Pen::dotted, Pen::warm_dashed, Pen::chained, Pen::pale_dashed};
    std::size_t pen  = 0;
    for (std::size_t c = 0; c + 1 < lines->names.size() && pen < std::size(pens); c += 2) {
      const std::string name = lines->names[c].substr(lines->names[c].find(", ") + 2);
      const VectorXd &lx = lines->columns[c], ly = lines->columns[c + 1];
      plot.lines.push_back({name, lx, inside(lx, ly, plot.x, plot.y), pens[pen++]});
    }
  }
  const auto value      = [&](const char *number) { return fit_value(run, row::bite_fit::number, number); };
  const double friction = std::isfinite(value("friction")) ? value("friction") : value("friction_factor");
  plot.points.push_back({friction, value("flow_stress_factor"), "fit"});
  return svg_plot(plot);
}
}  // namespace mill::report
