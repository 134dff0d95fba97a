#include "report/chatter/data.h"
#include "report/chatter/figures.h"
#include "report/page/curves.h"
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include <cmath>

namespace mill::report {
namespace {
bool has_film(const Run &run, const ChatterCondition &condition)
{
  const Table *speeds = stored_curve(run, curve::chatter_speed, condition.slug);
  return speeds && speeds->column("film_thickness");
}

// The first sentence is the answer, the others say why.
void answer_box(Page &page, const std::vector<std::string> &sentences)
{
  if (sentences.empty())
    return;
  std::string box = "<div class=\"answer\">\n<p class=\"answer-lead\">" + escaped(sentences.front()) + "</p>\n";
  for (std::size_t i = 1; i < sentences.size(); ++i)
    box += "<p>" + escaped(sentences[i]) + "</p>\n";
  page.html(box + "</div>");
}

void over_the_speed(Page &page, const Run &run, const ChatterCondition &condition)
{
  page.figure(
      {chatter_growth(run, condition, 510), chatter_frequency(run, condition)},
      "Left: how fast a disturbance grows; <b>above zero the stand chatters</b>. At every speed friction, film, "
      "flattening and the derivatives of the bite are solved again. Right: frequency of the mode that is least "
      "stable; where it jumps, another mode takes over.");
  page.figure(
      {chatter_locus(run, condition), chatter_process_damping(run, condition)},
      "Left: every mode of stand, bite and strip as a trace over the roll speed, dots darker the faster the "
      "rolls turn; right of the dashed line a mode grows. Modes damped far more than these lie outside to the "
      "left. Right: what the process adds to the damping of the stand at the chatter frequency. <b>Positive "
      "values take damping away.</b> The strip squeezed by the moving gap damps less the faster the rolls turn, "
      "and the tension of the strip feeds the vibration the more; at low speed the curve is cut.");
  page.figure(chatter_bite(run, condition),
              has_film(run, condition) ? "The steady bite along the speed: a faster roll drags in a thicker film, "
                                         "which lowers friction and with "
                                         "it the rolling force."
                                       : "The steady bite along the speed.");
}

void maps(Page &page, const Run &run, const ChatterCondition &condition,
          const std::vector<const char *> &quantities)
{
  std::string drawings;
  for (const char *quantity : quantities)
    drawings += chatter_map(run, condition, quantity);
  if (drawings.empty())
    return;
  page.figure(
      {"<div class=\"panels\">\n" + drawings + "</div>\n"},
      "Where condition " + escaped(condition.name) +
          " is stable (blue, lighter the better damped) and where it chatters (orange to brown, darker the "
          "faster it grows). The black line is the critical speed, the ring the working point: its distance to "
          "the line along each axis is the margin. Reduction is changed by the exit thickness, tension is a "
          "factor on both tensions.");
}

void histories(Page &page, const Run &run, const ChatterCondition &condition)
{
  const std::string hint = "<span class=\"zoom-hint\"> Drag to zoom, shift and drag to move, double click to see "
                           "all.</span>";
  if (const std::string drawings = chatter_histories(run, condition); !drawings.empty())
    page.figure({drawings}, "The gap after a small push of both work rolls, linear motion. The first periods, in "
                            "which the other modes decay, are not shown. " +
                                std::string(std::isfinite(condition.critical.speed)
                                                ? "Below the critical speed the vibration decays, at the critical "
                                                  "speed it persists, above it grows. "
                                                : "") +
                                "The orange line is the amplitude by the eigenvalue." + hint);
  page.figure(
      {chatter_phasors(condition.phases), chatter_shape(condition.phases.shape, "Critical mode at the stand")},
      "The critical mode. Left: which quantity leads and which follows; angles run counterclockwise, a positive "
      "one is ahead "
      "of "
      "the gap. The force is largest where the gap is smallest. <b>Back tension that lags behind the gap</b> is "
      "low while the gap opens; low tension means a high force, which pushes the rolls in the direction in which "
      "they already move and so feeds the vibration. Right: which part of the stand vibrates; blue bodies move "
      "away from the strip "
      "while the gap opens, orange ones towards it." +
          (std::isfinite(condition.phases.ratio)
               ? " The upper work roll moves " + significant(condition.phases.ratio, 3) +
                     " times as much as the lower one."
               : std::string()));
  page.figure({chatter_periods(run, condition)}, "The same phases in time, at the end of that record.");
}

void limit_cycle(Page &page, const Run &run, const ChatterCondition &condition)
{
  const LimitCycleInfo &cycle = condition.limit_cycle;
  const std::string drawings  = chatter_limit_cycle(run, condition);
  if (drawings.empty())
    return;
  std::string says = std::isfinite(cycle.speed) ? " Roll speed " + fixed(cycle.speed, 2) + " m/s." : "";
  if (std::isfinite(cycle.amplitude))
    says += (cycle.settled ? " The gap settles at \u00b1" : " The gap has reached \u00b1") +
            significant(cycle.amplitude, 3) + " \u00b5m" + (cycle.settled ? "" : " and is not settled") +
            (std::isfinite(cycle.frequency) ? ", " + fixed(cycle.frequency, 1) + " Hz." : ".");
  if (!cycle.stopped.empty())
    says += " The run ended early: " + escaped(cycle.stopped) + ".";
  if (!cycle.limited_by.empty())
    says += " What limits it: " + escaped(cycle.limited_by) + ".";
  page.figure(
      {drawings},
      "Fully developed chatter: nonlinear bite, strip that can go slack, rolls that can separate. Force and "
      "tensions are totals." +
          says + "<span class=\"zoom-hint\"> Drag to zoom.</span>");
  page.figure(
      chatter_cycle_periods(run, condition),
      "The end of that record. A tension of zero means that the strip is slack during a part of every period.");
  page.table(chatter_event_table(cycle), cycle.events.size() < 200
                                             ? "Events of the nonlinear motion."
                                             : "Events of the nonlinear motion, the first " +
                                                   std::to_string(cycle.events.size()) + " of them.");
}

void what_moves_it(Page &page, const ChatterCondition &condition)
{
  page.figure(
      {tornado_of_speed(condition)},
      "Inputs that move the critical speed, the strongest first: each input alone is taken 10&nbsp;% lower and "
      "10&nbsp;% higher, and everything is recomputed. A bar to the right means a higher critical speed. The "
      "slope "
      "is exact and holds for small changes; a row marked as bent or curved has unequal bars, or two that point "
      "to one side, and its slope "
      "says nothing about larger changes.");
  page.figure({tornado_of_friction(condition)},
              "Inputs that move the friction in the bite at the working speed, in the same way.");
}

void trust(Page &page, const ChatterCondition &condition)
{
  page.table(chatter_scheme_table(condition), "The linearisation of the bite decides how the film follows the "
                                              "vibration. Stand and steady state are the same.");
  page.table(chatter_variant_table(condition), "Variants of the data of the stand. Phases are against the gap.");
  page.table(chatter_conclusion_table(condition), "Conclusions that these variants share.");
  page.table(chatter_structure_table(condition),
             "The stand by models of growing detail, through the same coupling to the bite.");
}

void whole_condition(Page &page, const Run &run, const ChatterCondition &condition)
{
  page.heading("Condition " + condition.name);
  answer_box(page, chatter_answer(condition));
  over_the_speed(page, run, condition);
  maps(page, run, condition, {"reduction", "tension", "viscosity"});
  histories(page, run, condition);
  limit_cycle(page, run, condition);
  what_moves_it(page, condition);
  trust(page, condition);
}

// What differs from the first condition, in two figures.
void short_condition(Page &page, const Run &run, const ChatterCondition &condition)
{
  page.heading("Condition " + condition.name);
  answer_box(page, chatter_answer(condition));
  page.figure({chatter_growth(run, condition, 510), chatter_map(run, condition, "reduction")},
              "Growth rate over the speed, and over speed and reduction. Its other tables and records are stored "
              "with those of the first condition as <code>curves/chatter-" +
                  escaped(condition.slug) + "-*</code> and <code>response/chatter-" + escaped(condition.slug) +
                  "-*</code>.");
}

void tandem(Page &page, const Run &run, const std::optional<ChatterTandem> &stored)
{
  const ChatterTandem tandem = stored.value_or(ChatterTandem());
  const std::string growth   = chatter_tandem_growth(run, tandem);
  if (!stored && growth.empty())
    return;
  std::string names;
  for (const std::string &stand : tandem.stands)
    names += (names.empty() ? "" : ", ") + escaped(stand);
  page.heading("Stands in tandem" + (names.empty() ? "" : ": " + names));
  std::vector<std::string> sentences = tandem.sentences;
  if (!tandem.sentence.empty())
    sentences.insert(sentences.begin(), tandem.sentence);
  answer_box(page, sentences);
  page.figure(
      {growth, chatter_tandem_lobes(run, tandem)},
      "The strip carries the thickness that one stand leaves to the next, which meets it after the delay of the "
      "way between them. At some speeds the wave arrives in step with the vibration and feeds it, at others "
      "against it: hence waves in the curve with the delay, the closer the slower the strip.");
  page.table(stored ? chatter_tandem_table(tandem) : "",
             "Critical speed of the whole and of its parts; in brackets how far each is from the whole.");
  page.figure({chatter_shape(tandem.shape, "Critical mode of all stands")},
              "Which stand vibrates in the critical mode of the whole, by its gap.");
}
}  // namespace

void chatter_section(Page &page, const Run &run, const ChatterData &data)
{
  if (data.empty() && run.manifest.kind != KindOfCase::chatter)
    return;
  page.section("chatter", "Chatter");
  for (const std::string &problem : data.problems)
    page.html("<p class=\"absent\">" + escaped(problem) + "</p>");
  if (data.conditions.empty() && data.problems.empty() && !data.tandem)
    page.absent("Figures on chatter are", "curves/chatter-*");
  page.table(chatter_summary_table(data.conditions),
             "All conditions. Working over critical: negative is below the critical speed. In brackets: the "
             "deviation of this run from that value.");
  for (std::size_t i = 0; i < data.conditions.size(); ++i)
    if (i == 0)
      whole_condition(page, run, data.conditions[i]);
    else
      short_condition(page, run, data.conditions[i]);
  tandem(page, run, data.tandem);
  if (const std::string table = chatter_published_table(data.conditions); !table.empty()) {
    page.heading("Compared with published and measured values");
    page.table(
        table,
        "In brackets: the deviation of this run from each value. A note says where an input was chosen so that a "
        "value agrees: such agreement is not evidence for the model.");
  }
}
}  // namespace mill::report
