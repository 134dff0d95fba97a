#include "core/records/open_rows.h"
#include "core/records/rows_of_chatter.h"
#include "report/modes/model_data.h"
#include "report/modes/named_modes.h"
#include "report/page/curves.h"
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/results/names.h"
#include "report/results/tables.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
std::string list_of(const std::vector<std::string> &sentences)
{
  std::string list = "<ul>\n";
  for (const std::string &sentence : sentences)
    list += "<li>" + escaped(sentence) + "</li>\n";
  return list + "</ul>\n";
}

std::string fact(const std::string &name, const std::string &value)
{
  return value.empty() ? "" : "<div><dt>" + name + "</dt><dd>" + escaped(value) + "</dd></div>";
}

std::string what_is_in_short(const Run &run)
{
  if (has_chain(run))
    return "What the model runs on. Stiffnesses belong to the whole stand, Kzc to one bearing; for a contact the "
           "tangent is used.";
  if (run.manifest.kind == KindOfCase::bearing)
    return "One bearing at its working load; tangents belong to small motions about that state.";
  if (run.manifest.kind == KindOfCase::bite)
    return "The strip between the work rolls, by the model that gives K4; derivatives are exact and hold the arc.";
  if (run.manifest.kind == KindOfCase::chatter)
    return "Every condition at its working speed; a positive growth rate means that the stand chatters.";
  if (run.manifest.kind == KindOfCase::cluster)
    return "Every pass: its force, the named natural frequencies about the state at rest, how far it is from "
           "buckling and from an open contact; then the numbers that variants of the stack are fitted with.";
  if (run.manifest.kind == KindOfCase::stack)
    return "The strip that the loaded stack makes, the contacts of its rolls, and how the crown follows force, "
           "bending, "
           "crowns and eccentrics; derivatives are exact at this state.";
  return run.find("contact.space.approach") ? "The contact at its working load."
                                            : "The contact at its working load, stiffnesses per metre of length.";
}

bool has_chatter(const Run &run)
{
  return std::any_of(run.results.begin(), run.results.end(), [](const Result &result) {
    const auto id = result_id_or_open(result.name);
    return id && (id->is_of(row::chatter::all) || id->is_of(row::open::chatter));
  });
}

std::string what_chatter_leaves_out()
{
  return "The flattened radius, the flow stress and the temperature of the oil do not follow the vibration, "
         "friction "
         "is one number along the arc, and the strip between two stands is a massless spring. The stand vibrates "
         "vertically: chocks that tilt, drives that twist and marks on the rolls are not in it. Linear stability "
         "says "
         "when vibration begins to grow, the nonlinear run how far.";
}

std::string what_is_left_out(const Run &run)
{
  if (run.manifest.kind == KindOfCase::chatter)
    return what_chatter_leaves_out();
  if (stored_curve(run, curve::modes_of_model, "craig-bampton"))
    return "Vertical motion, the same on both sides of mid-length; rocking and the motion along the pass line are "
           "not in it. What six masses leave out is listed under \"How few masses are enough?\". Rolls joined by "
           "springs of one working load are linear and have no feedback from the strip: they ring, but they "
           "cannot "
           "become unstable.";
  if (has_chain(run))
    return "Six masses show the modes of the stack and the contact modes of the work rolls. They cannot show the "
           "rolls "
           "rocking on their necks, chocks that move against their roll, or frame modes with several moving "
           "points. "
           "The chain is linear and has no feedback from the strip: it rings, but it cannot become unstable.";
  if (run.manifest.kind == KindOfCase::bearing)
    return "Raceways and rollers are elastic, smooth and dry: no friction, no oil film, no cage forces, no heat. "
           "A "
           "stiffness of rings and chock is that of the bodies described in the case; the housing that holds the "
           "chock is rigid.";
  if (run.manifest.kind == KindOfCase::bite)
    return "Plane strain: the strip does not spread, and its edges are not seen. The flow stress is the same at "
           "any "
           "rate and temperature, friction one law along the whole arc; lubricant and heat are not followed. "
           "These numbers are not compared with a published experiment.";
  if (run.manifest.kind == KindOfCase::cluster)
    return "Rolls are rigid discs in one plane, their contacts and supports springs of one length: no bending, no "
           "tilt "
           "across the strip, no saddle or housing that moves, no chatter feedback from the strip. The law of a "
           "support is taken from the case.";
  if (run.manifest.kind == KindOfCase::stack)
    return "Rolls are Timoshenko beams, their contacts springs per length: contacts of one roll do not feel each "
           "other, "
           "shoulders do not soften it. The strip does not flow across its width, and its slopes are those of the "
           "case. These numbers are not compared with a published experiment.";
  if (run.find("contact.space.approach"))
    return "The contact is elastic and smooth, and small against both bodies, each of which is a half space: its "
           "far side, its supports and, beyond the end of a face, its missing half are not seen. Friction acts "
           "only "
           "under the tangential load; no oil film, no roughness.";
  return "The contact is elastic and smooth; the bodies are long, in plane strain. Friction acts only under a "
         "tangential load.";
}
}  // namespace

void summary_section(Page &page, const Run &run, const ModelData &models)
{
  page.section("summary", "The numbers in short");
  if (const ComparedModel *best = models.detailed()) {
    std::string text = "The frequencies are those of the <b>" + escaped(best->title) +
                       "</b>; those of the six masses are listed for comparison.";
    for (std::size_t i = 0; i < std::min<std::size_t>(2, models.answer.size()); ++i)
      text += " " + escaped(models.answer[i]);
    page.paragraph(text);
  }
  if (const auto groups = short_groups(run); !groups.empty())
    page.table(short_table(groups),
               what_is_in_short(run) +
                   " The last column is an independent value and how far this run is from it.");
  page.paragraph("Every value with all its checks and inputs: <a href=\"#results\">All results</a>.");
}

void limits_section(Page &page, const Run &run)
{
  page.section("limits", "Assumptions and limits", Depth::manager);
  if (!run.assumptions.empty())
    page.html(list_of(run.assumptions));
  page.paragraph(what_is_left_out(run));
  if (has_chatter(run) && run.manifest.kind != KindOfCase::chatter)
    page.paragraph("In the section on chatter the strip does feed back. " + what_chatter_leaves_out());
  if (!run.remarks.empty())
    page.html("<p>Not in this report:</p>\n" + list_of(run.remarks));
}

void full_results_section(Page &page, const Run &run)
{
  page.section("results", "All results", Depth::expert);
  page.table(
      "<div class=\"tools\" hidden><input type=\"search\" placeholder=\"search names, words, sources\" "
      "aria-label=\"search in the table\"/><button type=\"button\" class=\"copy\">Copy</button><button "
      "type=\"button\" class=\"csv\">CSV</button><output></output></div>\n" +
          full_table(run),
      "Everything in <code>results.json</code>. A deviation is this run relative to that check; accuracy is the "
      "estimate of the run itself." +
          std::string(std::any_of(run.results.begin(), run.results.end(),
                                  [](const Result &result) { return is_slope_by_one_input(result.name); })
                          ? " Slopes by single inputs are in the charts of the section on chatter and in the file."
                          : ""));
}

void record_section(Page &page, const Run &run)
{
  const Manifest &m = run.manifest;
  page.section("record", "Record of the run", Depth::expert);
  std::string versions;
  for (const auto &[name, version] : m.versions)
    versions += (versions.empty() ? "" : ", ") + name + " " + version;
  page.html("<dl class=\"facts\">" + fact("program", m.program + " " + m.version) +
            fact("case file", m.case_path) + fact("run", m.run_id) + fact("date", m.date) +
            fact("host", m.hostname) + fact("BLAS", m.blas) +
            fact("threads", m.threads > 0 ? std::to_string(m.threads) : "") +
            fact("peak memory", m.peak_memory > 0 ? significant(m.peak_memory / 1e9, 3) + " GB" : "") +
            fact("libraries", versions) + "</dl>");
  if (m.timings.empty())
    return;
  std::string rows;
  double total = 0;
  for (const Timing &timing : m.timings) {
    total += std::isfinite(timing.seconds) ? timing.seconds : 0;
    rows += "<tr><th scope=\"row\">" + escaped(timing.stage) + "</th><td class=\"num\">" +
            fixed(timing.seconds, 2) + "</td><td>" + (timing.cached ? "taken over from an earlier run" : "") +
            "</td></tr>\n";
  }
  page.table("<table><thead><tr><th>stage</th><th>time [s]</th><th></th></tr></thead>\n<tbody>\n" + rows +
                 "<tr class=\"total\"><th scope=\"row\">total</th><td class=\"num\">" + fixed(total, 2) +
                 "</td><td></td></tr>\n</tbody></table>\n",
             "Wall-clock time of the stages.");
}
}  // namespace mill::report
