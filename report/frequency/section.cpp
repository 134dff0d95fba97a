#include "core/records/result_names.h"
#include "core/records/stand_place.h"
#include "report/frequency/figures.h"
#include "report/page/curves.h"
#include "report/page/page.h"
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/results/tables.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
constexpr std::size_t most_crossings = 24, most_keys = 5;

// "upper work roll" -> its results; nullptr when absent.
const Result *peak_of(const Run &run, const std::string &force, const std::string &place, const char *what)
{
  const auto word = [](std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](const char c) { return c == ' ' || c == '-'; }, '_');
    return name;
  };
  return run.find(result_name({family::frf, word(force), word(place), what}));
}

std::string peak_rows(const Run &run, const std::vector<std::string> &places)
{
  std::string rows;
  for (const bool at_itself : {false, true})
    for (const std::string &place : places) {
      const std::string force = at_itself ? place : "bite";
      const Result *peak      = peak_of(run, force, place, "peak"),
                   *frequency = peak_of(run, force, place, "frequency");
      if (!peak || !frequency)
        continue;
      rows += "<tr><th scope=\"row\">" + escaped(at_itself ? "at the place itself" : "in the bite") + "</th><td>" +
              escaped(place) + "</td><td class=\"num\"><b>" +
              known_digits(1e3 * peak->value, peak->error_estimate) + "</b></td><td>" + accuracy_cell(*peak) +
              "</td><td class=\"num\"><b>" + frequency_text(frequency->value, frequency->error_estimate) +
              "</b></td><td>" + accuracy_cell(*frequency) + "</td></tr>\n";
    }
  return rows;
}

std::string band_sentence(const Run &run, const std::string &model)
{
  const bool drawn       = bool(stored_curve(run, curve::frf_band, model + "-bite"));
  const std::string name = drawn
                               ? " Between the pale lines lie 95 of 100 stands drawn at random from the errors of "
                                 "springs, masses and mesh, each taken as 1.96 standard deviations."
                               : "";
  const Result *peak     = peak_of(run, "bite", "upper work roll", "peak");
  if (!peak || peak->error_lacks.empty())
    return name;
  std::string list;
  const auto &lacks     = peak->error_lacks;
  const std::size_t few = lacks.size() > most_keys + 1 ? most_keys : lacks.size();
  for (std::size_t i = 0; i < few; ++i)
    list += (i == 0 ? "<code>" : ", <code>") + escaped(lacks[i]) + "</code>";
  if (few < lacks.size())
    list += " and " + std::to_string(lacks.size() - few) + " more, listed with the peaks among all results";
  return name + (drawn ? " <b>Not in the band</b>" : " <b>Without a band</b>") +
         ", since nothing says how far they may be off: " + list + ".";
}

void responses(Page &page, const Run &run)
{
  const std::string model = responding_model(run);
  const auto places       = responding_places(run, model);
  if (places.empty())
    return;
  for (const char *roll : {"upper work roll", "lower work roll"})
    if (std::find(places.begin(), places.end(), roll) != places.end())
      page.figure({magnitude_drawing(run, model, roll), phase_drawing(run, model, roll)},
                  "Acceleration of the " + std::string(roll) +
                      " per harmonic force in the bite, at its mid-length: magnitude by every model, and phase of "
                      "the best one." +
                      band_sentence(run, model));
  std::vector<std::string> chocks, rolls;
  for (const std::string &place : places)
    (stand_place(place).chock ? chocks : rolls).push_back(place);
  const std::string at_chocks = places_drawing(run, model, "Chocks, force in the bite", chocks, false),
                    tapped    = places_drawing(run, model, "Chocks, force at the chock", chocks, true);
  if (!at_chocks.empty())
    page.figure({at_chocks, tapped},
                "The same at the chocks, where sensors sit: response to a force in the bite, and to a hammer blow "
                "on the chock itself. A mode of the rolls that is missing on the "
                "left cannot be watched from the chocks.");
  page.figure({places_drawing(run, model, "Rolls, force in the bite", rolls, false),
               places_drawing(run, model, "Rolls, force at the roll", rolls, true)},
              "Rolls at mid-length. All pairs with real and imaginary part: <code>curves/frf-*.csv</code>.");
  if (const std::string rows = peak_rows(run, places); !rows.empty())
    page.table(
        "<table><thead><tr><th>force</th><th>response</th><th>largest [(m/s\u00b2)/kN]</th><th>accuracy</th>"
        "<th>at [Hz]</th><th>accuracy</th></tr></thead>\n<tbody>\n" +
            rows + "</tbody></table>\n",
        "Largest resonance of every pair. Heights go as one over the modal damping, which is an input.");
}

void campbell(Page &page, const Run &run)
{
  const CampbellData data = read_campbell(run.directory);
  if (!data.stored && data.problem.empty()) {
    page.paragraph("No Campbell diagram: this run has no rolling speed. Give <code>pass.speed</code> or "
                   "<code>campbell.speeds</code>, and the diameters of the rolls where none are drawn.");
    return;
  }
  page.heading("Campbell diagram");
  if (!data.problem.empty()) {
    page.html("<p class=\"absent\">" + escaped(data.problem) + "</p>");
    return;
  }
  std::string notes;
  for (const std::string &note : data.notes)
    notes += " Left out: " + escaped(note) + ".";
  if (const std::string drawing = campbell_drawing(data); !drawing.empty())
    page.figure({drawing},
                "Natural frequencies do not depend on the speed here; what turns excites along lines "
                "through the origin. <b>A dot inside the working range is a speed to pass quickly or to "
                "avoid</b>, if what turns there is out of round or damaged." +
                    notes);
  if (const std::string table = crossing_table(data, most_crossings); !table.empty())
    page.table(table,
               std::string("Crossings ") +
                   (std::isfinite(data.working[0]) ? "nearest to the working range" : "by their speed") +
                   ", at most " + std::to_string(most_crossings) + " of " + std::to_string(data.crossings.size()) +
                   "; all of them: <code>campbell.csv</code>. The accuracy of a speed is that of its frequency.");
}
}  // namespace

void frequency_section(Page &page, const Run &run)
{
  if (!has_chain(run) || responding_model(run).empty())
    return;
  page.section("frequency-response", "Frequency response and speeds");
  responses(page, run);
  campbell(page, run);
}
}  // namespace mill::report
