#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/base/si_unit.h"
#include "core/records/cluster_names.h"
#include "core/records/json_archive.h"
#include "report/cluster/figures.h"
#include "report/page/curves.h"
#include "report/page/page.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/plot/svg_plot.h"
#include <algorithm>
#include <cmath>
#include <filesystem>

namespace mill::report {
namespace {
const Pen pens[] = {Pen::dark, Pen::warm, Pen::dashed, Pen::dotted, Pen::chained, Pen::pale, Pen::dark_dashed};

// The largest columns of a table as lines, in the unit of the plot.
void add_largest(Plot &plot, const Table &table, const std::string &unit, const double factor,
                 const std::size_t most)
{
  std::vector<std::size_t> order;
  for (std::size_t i = 1; i < table.columns.size(); ++i)
    if (table.units[i] == unit && table.columns[i].size() > 0)
      order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](const std::size_t a, const std::size_t b) {
    return table.columns[a].cwiseAbs().maxCoeff() > table.columns[b].cwiseAbs().maxCoeff();
  });
  if (order.size() > most)
    order.resize(most);
  for (std::size_t k = 0; k < order.size(); ++k)
    plot.lines.push_back(
        {table.names[order[k]], table.columns[0], factor * table.columns[order[k]], pens[k % std::size(pens)]});
}

std::string response_drawing(const Table &table, const ClusterPassRecord &pass)
{
  Plot plot;
  plot.title  = "Response, " + pass.name;
  plot.x      = {"frequency", "Hz"};
  plot.y      = {"velocity", "mm/s", Scale::logarithmic};
  plot.width  = 760;
  plot.height = 360;
  add_largest(plot, table, "m/s", 1e3, 5);
  double largest = 0;
  for (const Line &line : plot.lines)
    largest = std::max(largest, line.y.maxCoeff());
  plot.y.low = 1e-5 * largest;
  for (const ClusterHistoryRecord &h : pass.histories)
    plot.marks.push_back({h.frequency, "dynamic force"});
  return svg_plot(plot);
}

std::string history_drawing(const Table &table, const ClusterPassRecord &pass)
{
  Plot plot;
  plot.title      = "Contact forces, " + pass.name;
  plot.x          = {"time", "ms"};
  plot.y          = {"force over its mean", "%"};
  plot.width      = 760;
  plot.height     = 300;
  std::size_t pen = 0;
  for (std::size_t i = 1; i < table.columns.size(); ++i)
    if (is_in(table.units[i], SiUnit::newton) && table.columns[i].size() > 0)
      plot.lines.push_back({table.names[i], 1e3 * table.columns[0],
                            100 * table.columns[i] / std::max(table.columns[i].mean(), 1e-9),
                            pens[pen++ % std::size(pens)]});
  return svg_plot(plot);
}

std::string load_drawing(const Table &table)
{
  Plot plot;
  plot.title  = "Frequencies over the rolling force";
  plot.x      = {"rolling force", "kN"};
  plot.y      = {"frequency", "Hz", Scale::logarithmic};
  plot.width  = 560;
  plot.height = 380;
  for (std::size_t i = 1; i < table.columns.size(); ++i)
    plot.lines.push_back({table.names[i], 1e-3 * table.columns[0], table.columns[i], pens[i % std::size(pens)]});
  return svg_plot(plot);
}

std::string backbone_drawing(const Table &table, const std::string &title)
{
  Plot plot;
  plot.title               = title;
  plot.x                   = {"amplitude", "\u00b5m", Scale::logarithmic};
  plot.y                   = {"frequency", "Hz"};
  plot.width               = 360;
  plot.height              = 260;
  const Eigen::VectorXd *a = table.column("amplitude"), *f = table.column("frequency");
  if (a && f)
    plot.lines.push_back({"", 1e6 * *a, *f, Pen::dark, true});
  return svg_plot(plot);
}

void modes_part(Page &page, const Run &run, const ClusterRecord &record)
{
  page.heading("Natural frequencies");
  if (const std::string table = frequency_table(record); !table.empty())
    page.table(
        table,
        "Published and computed frequencies. A motion is recognised by its shape, not by its number; the "
        "publication has one list for all passes. What follows from a fitted support agrees by construction.");
  if (const std::string table = gap_table(run); !table.empty())
    page.table(table,
               "Modes by what they do to the gap, " + escaped(record.passes[0].name) +
                   ": rolling with the spring of the strip between the work rolls, open without. The share is "
                   "that of the mode in the static compliance of the gap.");
  if (const std::string modes = moving_modes(record, record.passes[0]); !modes.empty())
    page.figure({modes},
                "Modes under " + escaped(record.passes[0].name) +
                    ", moving in the plane. Outlines are the rolls at rest; each mode is scaled to its largest "
                    "roll, and a red stroke is the way to one extreme.");
  page.table(share_table(record.passes[0]), "Where the energy of every mode is, " +
                                                escaped(record.passes[0].name) +
                                                ". The geometric term of a contact reduces its share.");
  if (const Table *table = stored_curve(run, curve::cluster_load))
    page.figure({load_drawing(*table)},
                "Frequencies over the rolling force, modes by number. Contacts stiffen with the "
                "force, guides do not.");
}

void vibration_part(Page &page, const Run &run, const ClusterRecord &record)
{
  std::vector<std::string> backbones;
  for (std::size_t k = 1; k <= record.passes[0].modes.size(); ++k)
    if (const Table *table =
            stored_curve(run, curve::cluster_backbone, slug(record.passes[0].name) + "-f" + std::to_string(k)))
      backbones.push_back(backbone_drawing(*table, "f" + std::to_string(k)));
  bool headed = false;
  for (const ClusterPassRecord &pass : record.passes) {
    const Table *response = stored_curve(run, curve::cluster_response, slug(pass.name)),
                *history  = stored_curve(run, curve::cluster_history, slug(pass.name));
    if (!response && !history)
      continue;
    if (!headed)
      page.heading("Under the dynamic force");
    headed = true;
    if (response)
      page.figure({response_drawing(*response, pass)},
                  "Velocity of the rolls under the dynamic force at every frequency, linear, " +
                      escaped(pass.name) + ".");
    if (history)
      page.figure({history_drawing(*history, pass)},
                  "Contact forces in time, one-sided contacts, from rest, " + escaped(pass.name) + ".");
    for (const ClusterHistoryRecord &h : pass.histories)
      page.paragraph("<b>" + escaped(pass.name) + "</b>: " + escaped(h.verdict) +
                     ". The contact that comes nearest to "
                     "opening is " +
                     escaped(h.least_contact) + ", which keeps " + percent(h.least_force) +
                     " of its force at rest.");
  }
  if (const std::string table = cluster_history_table(record); !table.empty())
    page.table(
        table,
        "Velocity amplitudes at the frequency of the dynamic force, linear response compared with the history.");
  if (!backbones.empty())
    page.figure(backbones, "Frequency over amplitude of the modes that bend, free and undamped, " +
                               escaped(record.passes[0].name) +
                               ". The frequency falls from the amplitude at which a contact opens.");
}
}  // namespace

ClusterData read_cluster_record(const std::string &run_directory, const std::string &file)
{
  ClusterData data;
  const std::filesystem::path path = std::filesystem::path(run_directory) / file;
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    return data;
  try {
    data.record = record_of_json<ClusterRecord>(read_text(path.string()));
  } catch (const InputError &) {
  }
  if (!data.record || data.record->passes.empty()) {
    data.record.reset();
    data.problem = file + " is not what this program writes, so the stack is not shown; run the "
                          "case again";
  }
  return data;
}

void cluster_section(Page &page, const Run &run)
{
  const ClusterData data = read_cluster_record(run.directory, cluster_file);
  if (!data.record) {
    if (!data.problem.empty()) {
      page.section("stack", "Stack of rolls");
      page.paragraph(escaped(data.problem) + ".");
    }
    return;
  }
  const ClusterRecord &record = *data.record;
  page.section("stack", "Stack of rolls", Depth::manager);
  if (const std::string drawing = stack_drawing(record, record.passes[0]); !drawing.empty())
    page.figure({drawing}, "The stack to scale with the force in every contact and support, " +
                               escaped(record.passes[0].name) + ". The size of a dot follows its force.");
  page.table(contact_table(record), "Contacts under every pass. The tangent is the stiffness for vibration.");
  if (!record.passes[0].modes.empty() && !std::isnan(record.passes[0].least_root)) {
    modes_part(page, run, record);
    page.table(stability_table(record), "How far the stack is from buckling and from an open contact. The "
                                        "horizontal force acts on the roll at the strip.");
    vibration_part(page, run, record);
  }
  if (const std::string fits = cluster_fit_table(record); !fits.empty()) {
    page.heading("Explanations of the frequencies");
    page.table(fits, "Variants of the stack fitted to the published frequencies. Each row states how many numbers "
                     "were fitted to how many frequencies; only the other frequencies test the variant.");
  }
}
}  // namespace mill::report
