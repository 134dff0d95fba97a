#include "core/base/si_unit.h"
#include "core/records/cluster_names.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_stand.h"
#include "report/cluster/figures.h"
#include "report/page/cells.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/results/named_mode.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
std::string number_cell(const double value, const int digits = 4)
{
  return cell(std::isnan(value) ? "-" : significant(value, digits));
}

std::string off_by(const double computed, const double wanted)
{
  return std::isnan(wanted) ? "-" : percent(computed / wanted - 1);
}

// The largest shares, "E y 92 %, I y 6 %".
std::string largest_shares(std::vector<ClusterShare> shares)
{
  std::stable_sort(shares.begin(), shares.end(),
                   [](const ClusterShare &a, const ClusterShare &b) { return a.value > b.value; });
  std::string text;
  for (std::size_t i = 0; i < shares.size() && i < 4 && shares[i].value > 0.02; ++i)
    text += (text.empty() ? "" : ", ") + escaped(shares[i].name) + " " + fixed(100 * shares[i].value, 0) + " %";
  return text;
}

const ClusterModeRecord *mode_called(const ClusterPassRecord &pass, const std::string &name)
{
  for (const ClusterModeRecord &mode : pass.modes)
    if (mode.identity == name)
      return &mode;
  return nullptr;
}

std::string unit_of_key(const std::string &key, double &value)
{
  const std::string unit = unit_of_cluster_key(key);
  if (!is_in(unit, SiUnit::radian))
    return after_number(unit);
  value *= 180 / M_PI;
  return " deg";
}

std::string fitted_numbers(const ClusterFitRecord &fit)
{
  std::string text;
  for (const ClusterFitNumber &n : fit.numbers) {
    double value = n.value, interval = n.interval;
    const std::string unit = unit_of_key(n.key, value);
    unit_of_key(n.key, interval);
    text += "<code>" + escaped(n.key) + "</code> = " + significant(value, 5) + unit +
            (std::isnan(interval) ? " (no interval: as many numbers as frequencies)"
                                  : " \u00b1 " + significant(interval, 2) + unit) +
            "<br>";
  }
  return text.empty() ? "none" : text;
}
}  // namespace

std::string contact_table(const ClusterRecord &record)
{
  std::string rows;
  for (const ClusterPassRecord &pass : record.passes)
    for (const ClusterLoadRecord &c : pass.contacts)
      rows += row_head(pass.name) + "<td>" + escaped(c.name) + "</td>" + number_cell(1e-3 * c.force, 5) +
              number_cell(1e6 * c.approach) + number_cell(1e-6 * c.tangent) + number_cell(1e-6 * c.secant) +
              "</tr>\n";
  return table_of(
      "<th>pass</th><th>contact</th><th>force, kN</th><th>approach, \u00b5m</th><th>tangent, kN/mm</th>"
      "<th>secant, kN/mm</th>",
      rows);
}

std::string frequency_table(const ClusterRecord &record)
{
  std::string head = "<th>motion</th><th>published, Hz</th>", rows;
  for (const ClusterPassRecord &pass : record.passes)
    head += "<th>" + escaped(pass.name) + ", Hz</th>";
  head += "<th>first pass relative to the published value</th>";
  for (const ClusterPublished &p : record.published) {
    rows += row_head(p.name) + number_cell(p.frequency, 5);
    for (const ClusterPassRecord &pass : record.passes) {
      const ClusterModeRecord *mode = mode_called(pass, p.name);
      rows += cell(mode ? fixed(mode->frequency, 1) : "-");
    }
    const ClusterModeRecord *first = record.passes.empty() ? nullptr : mode_called(record.passes[0], p.name);
    rows += cell(first ? off_by(first->frequency, p.frequency) : "-") + "</tr>\n";
  }
  return table_of(head, rows);
}

std::string share_table(const ClusterPassRecord &pass)
{
  std::string rows;
  for (std::size_t k = 0; k < pass.modes.size(); ++k) {
    const ClusterModeRecord &mode = pass.modes[k];
    rows += row_head("f" + std::to_string(k + 1)) + cell(fixed(mode.frequency, 1)) + "<td>" +
            escaped(mode.identity.empty() ? "-" : mode.identity) + "</td><td>" + largest_shares(mode.kinetic) +
            "</td><td>" + largest_shares(mode.elastic) + "</td></tr>\n";
  }
  return table_of("<th>mode</th><th>Hz</th><th>named</th><th>kinetic energy</th><th>elastic energy</th>", rows);
}

namespace {
// The first place of the name of a mode in a state of the gap.
std::string state_of(const bool open)
{
  return open ? family::open : "";
}

std::string share_cell(const Run &run, const bool open, const std::string &key)
{
  const Result *share = run.find(row::modes::gap_share.of(state_of(open), key));
  return cell(share ? fixed(100 * share->value, 1) : "-");
}
}  // namespace

std::string gap_table(const Run &run)
{
  std::string rows;
  for (const bool open : {false, true})
    for (const Result &result : run.results) {
      const auto id = result_id(result.name);
      if (!id || !id->is_of(row::modes::frequency) || state_of(open) != id->place("open"))
        continue;
      const std::string key = id->place("mode");
      if (open && run.find(row::modes::frequency.of("", key)))
        continue;
      const Result *other = run.find(row::modes::frequency.of(family::open, key));
      rows += row_head(named_mode(result).name) + cell(open ? "-" : fixed(result.value, 1)) +
              (open ? cell("-") : share_cell(run, false, key)) + cell(other ? fixed(other->value, 1) : "-") +
              share_cell(run, true, key) + "</tr>\n";
    }
  return rows.empty() ? ""
                      : table_of("<th>mode</th><th>rolling, Hz</th><th>of the gap, %</th><th>open, Hz</th>"
                                 "<th>of the gap, %</th>",
                                 rows);
}

std::string stability_table(const ClusterRecord &record)
{
  std::string rows;
  for (const ClusterPassRecord &pass : record.passes) {
    std::string guides;
    for (const ClusterShare &g : pass.least_guides)
      guides += (guides.empty() ? "" : ", ") + escaped(g.name) + " " +
                (std::isnan(g.value) ? "none helps" : significant(1e-6 * g.value, 3) + " kN/mm");
    rows += row_head(pass.name) + number_cell(1e-3 * pass.force, 5) +
            cell(std::isnan(pass.buckling_factor) ? "beyond 100" : significant(pass.buckling_factor, 4)) + "<td>" +
            escaped(pass.buckling_motion.empty() ? "-" : pass.buckling_motion) + "</td><td>" +
            (guides.empty() ? "-" : guides) + "</td>" + number_cell(1e-3 * pass.leaving_force) + "<td>" +
            escaped(pass.leaving_contact.empty() ? "-" : pass.leaving_contact) + "</td></tr>\n";
  }
  return table_of("<th>pass</th><th>force, kN</th><th>buckles at, times the force</th><th>motion</th>"
                  "<th>guides needed</th><th>a contact opens under a horizontal force of, kN</th><th>where</th>",
                  rows);
}

std::string cluster_history_table(const ClusterRecord &record)
{
  std::string rows;
  for (const ClusterPassRecord &pass : record.passes)
    for (const ClusterHistoryRecord &h : pass.histories)
      for (std::size_t i = 0; i < h.linear.size() && i < h.nonlinear.size(); ++i)
        if (h.linear[i].value > 1e-6 || h.nonlinear[i].value > 1e-6)
          rows += row_head(pass.name) + number_cell(h.force) + number_cell(h.frequency, 5) + "<td>" +
                  escaped(h.linear[i].name) + "</td>" + number_cell(1e3 * h.linear[i].value) +
                  number_cell(1e3 * h.nonlinear[i].value) + cell(off_by(h.nonlinear[i].value, h.linear[i].value)) +
                  number_cell(2 * M_PI * h.frequency * h.linear[i].value) + "</tr>\n";
  return table_of("<th>pass</th><th>force, N</th><th>Hz</th><th>roll</th><th>linear, mm/s</th>"
                  "<th>history, mm/s</th><th>difference</th><th>linear, m/s\u00b2</th>",
                  rows);
}

std::string cluster_fit_table(const ClusterRecord &record)
{
  std::string head = "<th>variant</th><th>differs by</th><th>fitted numbers, 95 %</th><th>numbers / frequencies "
                     "fitted</th>",
              rows;
  std::vector<std::string> names;
  for (const ClusterFitRecord &fit : record.fits)
    for (const ClusterFitFrequency &f : fit.frequencies)
      if (std::find(names.begin(), names.end(), f.mode) == names.end()) {
        names.push_back(f.mode);
        head += "<th>" + escaped(f.mode) + ", " + significant(f.wanted, 5) + " Hz</th>";
      }
  head += "<th>rms of the fitted</th><th>rms of the predicted</th>";
  for (const ClusterFitRecord &fit : record.fits) {
    const auto fitted = std::count_if(fit.frequencies.begin(), fit.frequencies.end(),
                                      [](const ClusterFitFrequency &f) { return f.fitted; });
    rows +=
        row_head(fit.variant) + "<td>" + (fit.set.empty() ? "nothing" : escaped(fit.set)) + "</td><td>" +
        fitted_numbers(fit) + (fit.undetermined.empty() ? "" : "not identified: " + escaped(fit.undetermined)) +
        escaped(fit.refused) + "</td>" + cell(std::to_string(fit.numbers.size()) + " / " + std::to_string(fitted));
    for (const std::string &name : names) {
      const auto f = std::find_if(fit.frequencies.begin(), fit.frequencies.end(),
                                  [&](const ClusterFitFrequency &one) { return one.mode == name; });
      rows += f == fit.frequencies.end() ? cell("-")
                                         : cell(fixed(f->computed, 1) + " (" + off_by(f->computed, f->wanted) +
                                                (f->fitted ? ", fitted)" : ")"));
    }
    rows += cell(std::isnan(fit.rms_fitted) ? "-" : percent(fit.rms_fitted)) +
            cell(std::isnan(fit.rms_predicted) ? "-" : percent(fit.rms_predicted)) + "</tr>\n";
  }
  return table_of(head, rows);
}
}  // namespace mill::report
