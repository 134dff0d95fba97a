#include "report/marks/figures.h"
#include "report/page/cells.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
std::string strong(const std::string &text)
{
  return "<td class=\"num\"><b>" + text + "</b></td>";
}

std::string deviation(const double share)
{
  return std::isnan(share) ? "\u2013" : percent(share);
}

std::string whole_cells(const double turns, const double number, const double whole, const double off,
                        const double chance, const std::string &verdict)
{
  return cell(significant(turns, 5)) + strong(significant(number, 5)) + cell(fixed(whole, 0)) +
         cell(deviation(off)) + cell(fixed(100 * chance, 0) + " %") + "<td>" + escaped(verdict) + "</td>";
}

// "80 of the control roll", those that are identified as whole.
std::string whole_ones(const MarksData &data)
{
  std::string list;
  const auto add = [&](const std::string &name, const double whole) {
    list += (list.empty() ? "" : ", ") + significant(whole, 6) + " per turn of the " + name;
  };
  for (const RollMarks &r : data.rolls)
    if (r.verdict == word_of(Wholeness::whole))
      add(r.roll, r.whole);
  for (const EventMarks &e : data.events)
    if (e.verdict == word_of(Wholeness::whole))
      list += (list.empty() ? "" : ", ") + fixed(e.whole, 0) + " times " + e.name;
  return list;
}
}  // namespace

std::string marks_sentence(const MarksData &data)
{
  const MarksQuestion &q = data.question;
  std::string text       = "Marks every " + significant(1e3 * q.spacing, 4) + " mm on a strip of " +
                     significant(q.speed, 4) + " m/s are made " + significant(data.frequency, 4) +
                     " times a second";
  const std::string whole = whole_ones(data);
  text += whole.empty() ? "; no roll and no bearing is identified by a whole number" : "; whole: " + whole;
  const auto nearest =
      std::min_element(data.modes.begin(), data.modes.end(),
                       [](const ModeMarks &a, const ModeMarks &b) { return std::abs(a.off) < std::abs(b.off); });
  if (nearest != data.modes.end())
    text += "; nearest mode " + nearest->name + ", " + significant(nearest->frequency, 4) + " Hz (" +
            deviation(nearest->off) + ")";
  return text;
}

std::string marks_table(const MarksData &data)
{
  std::string rows;
  for (const RollMarks &r : data.rolls)
    rows += named_row(r.roll + ", " + significant(1e3 * r.diameter, 5) + " mm",
                      whole_cells(r.rotation, r.per_turn, r.whole, r.off, r.chance, r.verdict));
  for (const EventMarks &e : data.events)
    rows += named_row(e.name, whole_cells(e.frequency, e.multiple, e.whole, e.off, e.chance, e.verdict));
  return table_of("<th>what turns</th><th>[1/s]</th><th>marks to one</th><th>nearest whole</th><th>off</th>"
                  "<th>by chance</th><th></th>",
                  rows);
}

std::string marks_mode_table(const MarksData &data)
{
  std::string head = "<th>mode</th><th>[Hz]</th><th>off the marks</th><th>this spacing at [m/s]</th>", rows;
  for (const RollMarks &r : data.rolls)
    head += "<th>" + escaped(r.roll) + ": waves at [m/s]</th>";
  for (std::size_t m = 0; m < data.modes.size(); ++m) {
    const ModeMarks &mode = data.modes[m];
    std::string cells     = strong(known_digits(mode.frequency, mode.error_estimate, 5)) +
                        cell(deviation(mode.off) + (mode.near ? ", near" : "")) + cell(significant(mode.speed, 4));
    for (std::size_t r = 0; r < data.rolls.size(); ++r) {
      std::string pairs;
      for (const MarkMeeting &meeting : data.meetings)
        if (meeting.mode == int(m) && meeting.roll == int(r))
          pairs +=
              (pairs.empty() ? "" : "; ") + std::to_string(meeting.waves) + " at " + significant(meeting.speed, 4);
      cells += cell(pairs.empty() ? "\u2013" : pairs);
    }
    rows += named_row(mode.name, cells);
  }
  return table_of(head, rows);
}

std::string side_band_table(const MarksData &data)
{
  const bool measured = !std::isnan(data.question.side_band);
  std::string rows;
  for (std::size_t i = 0; i < std::min(data.rolls.size(), data.side_bands.size()); ++i) {
    const SideBands &s = data.side_bands[i];
    rows += named_row(s.roll, cell(significant(data.rolls[i].rotation, 5)) + cell(significant(s.below, 6)) +
                                  cell(significant(s.above, 6)) +
                                  (measured ? strong(deviation(s.off)) + cell(significant(s.exact_speed, 4)) +
                                                  cell(significant(1e3 * s.exact_diameter, 4))
                                            : ""));
  }
  return table_of(
      std::string("<th>once per turn of</th><th>turns [1/s]</th><th>first lines below [Hz]</th>"
                  "<th>above [Hz]</th>") +
          (measured ? "<th>measured distance off</th><th>exact at [m/s]</th><th>or for a roll of [mm]</th>" : ""),
      rows);
}
}  // namespace mill::report
