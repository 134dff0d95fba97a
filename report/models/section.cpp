#include "report/models/figures.h"
#include "report/modes/animation.h"
#include "report/modes/model_data.h"
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include <cmath>

namespace mill::report {
namespace {
std::string hertz(const double frequency)
{
  return significant(frequency, 4) + "\u00a0Hz";
}

std::string below_the_limit(const ModelData &data)
{
  return std::isfinite(data.frequency_limit) ? "below " + hertz(data.frequency_limit) : "that were computed";
}

// The first sentence is the answer, the others say why.
std::string answer_box(const ModelData &data)
{
  if (data.answer.empty())
    return "";
  std::string box = "<div class=\"answer\">\n<p class=\"answer-lead\">" + escaped(data.answer.front()) + "</p>\n";
  for (std::size_t i = 1; i < data.answer.size(); ++i)
    box += "<p>" + escaped(data.answer[i]) + "</p>\n";
  return box + "</div>\n";
}

std::string warning_box(const ModelData &data)
{
  if (data.warnings.empty())
    return "";
  std::string box = "<div class=\"banner warnings\"><b>Beyond the six masses.</b><ul>\n";
  for (const std::string &warning : data.warnings)
    box += "<li>" + escaped(warning) + "</li>\n";
  return box + "</ul></div>\n";
}

void answer(Page &page, const ModelData &data)
{
  page.html(answer_box(data));
  if (const std::string chart = masses_chart(data); !chart.empty())
    page.figure({chart},
                "How few masses are enough. The detailed model is reduced to the masses named on the left, "
                "best choice first; a dot is the worst frequency error among the modes " +
                    below_the_limit(data) +
                    " that are still shown. A mode is accepted as right when its frequency is within "
                    "5&nbsp;%, and as missing when no shape of the reduced model is like it. Read "
                    "downwards until nothing is missing and the dot is as far left as you need.");
  page.html(warning_box(data));
}

void models(Page &page, const ModelData &data)
{
  if (const std::string table = model_table(data); !table.empty())
    page.table(table, "The models of this stand" +
                          (data.at.empty() ? "" : ", contacts and bearings as stiff as at " + escaped(data.at)) +
                          (data.driven.empty() ? "."
                                               : ". The responses of this run come from: <b>" +
                                                     escaped(data.title(data.driven)) + "</b>."));
}

void frequencies(Page &page, const Run &run, const ModelData &data)
{
  const auto reach         = force_reach(run);
  const std::string ladder = frequency_ladder(data, reach), table = verdict_table(data);
  if (ladder.empty() && table.empty())
    return;
  page.heading("Frequencies side by side");
  models(page, data);
  if (!ladder.empty())
    page.figure(
        {ladder},
        "Every step is a mode. A line joins a mode of the six masses with the mode of a detailed model that "
        "looks like it; its number is how far the six masses are off. <b>Steps drawn hollow have no "
        "counterpart</b>: what a force excites there, the six masses cannot show." +
            std::string(reach.empty() ? ""
                                      : " The bars at the right reach to the frequency below which a pass's "
                                        "force has 99&nbsp;% of its mean square; an arrow goes beyond the "
                                        "picture."));
  if (!table.empty())
    page.table(table,
               "Accuracy of the six masses for each mode of the most detailed model. \u201cLikeness\u201d "
               "is the modal assurance of the two shapes, 1 for equal ones; below " +
                   fixed(alike, 1) +
                   " they are not called the same mode. \u201cWithin reach\u201d is the share of the mode's "
                   "kinetic energy in shapes that six masses can take at all.");
  if (const std::string strays = stray_sentence(data); !strays.empty())
    page.paragraph(strays);
}

void likeness(Page &page, const ModelData &data)
{
  if (const std::string map = mac_map(data); !map.empty())
    page.figure(
        {map},
        "Modal assurance between two detailed models. One dark cell in every row and column: both have the same "
        "modes. Two dark cells in one column are a motion that one model has twice, as a chock with "
        "its neck and on its bearing. Two half-dark cells side by side are two modes that lie so close that "
        "each model mixes them in its own way.");
}

void shapes(Page &page, const Run &run, const ModelData &data)
{
  const std::string player = mode_player(data, run.manifest.geometry), sheet = mode_sheet(data);
  if (player.empty() && sheet.empty())
    return;
  page.heading("Mode shapes of the stand");
  if (!player.empty())
    page.figure(
        {player},
        "The stand seen along the rolling direction, rolls to scale, motion enlarged and slowed down. Shown "
        "are the extremes of the swing; on the screen it moves. <b>Look at which springs open and "
        "close</b>: masses that move together act as one, a roll that bends or a chock that leaves its "
        "neck is what six masses leave out." +
            std::string(has_roll_sizes(run.manifest.geometry)
                            ? ""
                            : " This run stored no geometry: the rolls are drawn with assumed "
                              "proportions."));
  if (!sheet.empty())
    page.figure({sheet},
                "All modes of the most detailed model at a glance: axes of the four rolls, frame (long bars) "
                "and chocks (short bars) at one extreme of the swing (blue) and at the other (orange), at "
                "rest (grey). The percentage is the share of the motion within reach of six masses.");
}

void convergence(Page &page, const ModelData &data)
{
  if (const std::string chart = kept_chart(data.kept_modes, data.frequency_limit); !chart.empty()) {
    page.heading("How many modes of each part are enough");
    page.figure({chart},
                "Error of the assembled stand's frequencies when every part keeps only so many of its own modes, "
                "against the same stand with many. It falls with every mode kept, and fastest for low "
                "frequencies; where the thick line is below the accuracy you need, more modes do not help.");
  }
}
}  // namespace

void model_section(Page &page, const Run &run, const ModelData &data)
{
  if (!data.stored && data.problem.empty())
    return;
  page.section("models", "How few masses are enough?", Depth::expert);
  if (!data.problem.empty()) {
    page.html("<p class=\"absent\">" + escaped(data.problem) + "</p>");
    return;
  }
  answer(page, data);
  frequencies(page, run, data);
  likeness(page, data);
  shapes(page, run, data);
  convergence(page, data);
}
}  // namespace mill::report
