#include "app/verbs/marks_command.h"
#include "app/process/console.h"
#include "app/run/run_kind.h"
#include "app/run/run_setup.h"
#include "app/stages/response/marks_stage.h"
#include "app/verbs/known_modes.h"
#include "core/base/units.h"
#include "core/base/visible_text.h"
#include "core/case/quantity_slips.h"
#include "core/model/case.h"
#include "dynamics/marks/marks.h"
#include "report/front/html.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace mill {
namespace {
constexpr double largest = 1e6;  // of any option, SI

// "--spacing 2 mm" in SI; `like` is a unit of its dimension.
double quantity_of(const std::string &flag, const std::string &text, const char *like)
{
  const ParsedQuantity q    = parse_quantity(text);
  const std::string written = "--" + flag + " \"" + text + "\"";
  constexpr double infinity = std::numeric_limits<double>::infinity();
  if (const std::string remedy = quantity_remedy(text, like, {-infinity, infinity}); !remedy.empty())
    throw InputError(written + " " + remedy);
  const std::string needs = fmt::format("; it takes a number with one of {}", units_like(unit(like)));
  if (q.fault == ParsedQuantity::Fault::no_number)
    throw InputError(written + " does not begin with a number" + needs);
  if (q.fault == ParsedQuantity::Fault::no_unit)
    throw InputError(written + " has no unit" + needs);
  if (q.fault == ParsedQuantity::Fault::unknown_unit)
    throw InputError(written + ": unknown unit '" + q.unit_text + "'" + needs);
  if (!(q.unit->dimension == unit(like).dimension))
    throw InputError(written + " is " + q.unit->quantity + needs);
  if (std::abs(q.value()) > largest)
    throw InputError(
        fmt::format("{} is outside of what a mill has; it takes at most {:g} in SI units", written, largest));
  return q.value();
}

MarksQuestion question_of(const MarksOptions &flags)
{
  MarksQuestion q;
  if (flags.spacing.empty() == flags.frequency.empty())
    throw InputError("millstand marks takes either --spacing \"2 mm\" or --frequency \"315 Hz\"");
  q.speed = quantity_of("speed", flags.speed, "m/s");
  if (flags.frequency.empty())
    q.spacing = quantity_of("spacing", flags.spacing, "mm");
  else if (const double frequency = quantity_of("frequency", flags.frequency, "Hz"); frequency > 0)
    q.spacing = q.speed / frequency;  // (40.1)
  else
    throw InputError("--frequency \"" + flags.frequency + "\" is not above zero");
  const auto take = [](double &value, const char *flag, const std::string &text, const char *like) {
    if (!text.empty())
      value = quantity_of(flag, text, like);
  };
  take(q.forward_slip, "forward-slip", flags.forward_slip, "%");
  take(q.accuracy, "accuracy", flags.accuracy, "%");
  take(q.side_band, "side-bands", flags.side_bands, "Hz");
  return q;
}

std::string percent_text(const double share)
{
  return std::isnan(share) ? "-" : fmt::format("{:+.2f} %", 100 * share);
}

std::string table_text(const MarksRecord &record)
{
  const MarksQuestion &q = record.question;
  std::string text = fmt::format("marks every {:.6g} mm on a strip of {:.6g} m/s: {:.6g} Hz\n\n{:<36} {:>10} "
                                 "{:>14} {:>8} {:>10} {:>8}  {}\n",
                                 1e3 * q.spacing, q.speed, record.frequency, "what turns", "Hz", "marks per turn",
                                 "whole", "off", "chance", "");
  const auto row   = [&](const std::string &name, const double turns, const double number, const double whole,
                       const double off, const double chance, const std::string &verdict) {
    text += fmt::format("{:<36} {:>10.5g} {:>14.6g} {:>8.0f} {:>10} {:>8}  {}\n", visible(name, true), turns,
                          number, whole, percent_text(off), fmt::format("{:.0f} %", 100 * chance), verdict);
  };
  for (const RollMarks &r : record.rolls)
    row(r.roll, r.rotation, r.per_turn, r.whole, r.off, r.chance, r.verdict);
  for (const EventMarks &e : record.events)
    row(e.name, e.frequency, e.multiple, e.whole, e.off, e.chance, e.verdict);
  if (!record.modes.empty())
    text += fmt::format("\n{:<36} {:>10} {:>14} {:>19}\n", "modes " + visible(record.model, true), "Hz",
                        "off the marks", "this spacing at");
  for (const ModeMarks &m : record.modes)
    text += fmt::format("{:<36} {:>10.5g} {:>14} {:>15.4g} m/s{}\n", visible(m.name, true), m.frequency,
                        percent_text(m.off), m.speed, m.near ? "  near" : "");
  if (!std::isnan(q.side_band)) {
    text += fmt::format("\n{:<36} {:>10} {:>14} {:>19} {:>14}\n",
                        fmt::format("side bands {:.4g} Hz apart", q.side_band), "turns Hz", "off", "exact at",
                        "or for");
    for (std::size_t i = 0; i < record.side_bands.size(); ++i) {
      const SideBands &s = record.side_bands[i];
      text += fmt::format("{:<36} {:>10.5g} {:>14} {:>15.4g} m/s {:>11.4g} mm\n", visible(s.roll, true),
                          record.rolls[i].rotation, percent_text(s.off), s.exact_speed, 1e3 * s.exact_diameter);
    }
  }
  for (const std::string &note : record.notes)
    text += "note: " + visible(note, true) + "\n";
  return text;
}

// Results, record and page in the folder, as a run leaves them.
void write_folder(const CommandLine &command, const Case &the_case, const MarksRecord &record,
                  const dynamics::MarkSources &sources, const KnownModes &known, const std::string &path)
{
  const std::string asked = command.marks.spacing + command.marks.frequency + command.marks.speed +
                            command.marks.forward_slip + command.marks.accuracy + command.marks.side_bands;
  const OutputDir out(path, the_case, command.force_overwrite, run_id_of(the_case, "marks " + asked, ""));
  RunContext run{the_case, out, "", false};
  run.started = local_time();
  add_marks(run, record, sources, known.inputs);
  out.write("resolved.toml", the_case.resolved);
  out.write("results.json", results_json(run.results, the_case.name,
                                         run.results.warnings.empty() ? "ok" : "warnings", out.run_id()));
  out.write("run.json", manifest_json(run));
  out.write("report.html", report::html_page(report::read_own_run(out.staging(), out.take_tables())));
  out.publish();
}
}  // namespace

int marks_command(const CommandLine &command, const Case &the_case)
{
  const RunKind &kind = run_kind(the_case);
  if (!kind.mark_sources)
    throw InputError("millstand marks: nothing turns in kind = \"" + the_case.kind + "\" (" + the_case.path +
                     "); it takes cases with work rolls");
  const MarksQuestion question  = question_of(command.marks);
  dynamics::MarkSources sources = kind.mark_sources(the_case);
  const KnownModes known        = known_modes(the_case, command.marks.run);
  sources.modes                 = known.modes;
  sources.model                 = known.model;
  MarksRecord record            = dynamics::marks_of(question, sources);
  if (!known.note.empty())
    record.notes.push_back(known.note);
  if (!sources.modes.empty())
    for (const dynamics::MarkRoll &roll : sources.rolls)
      if (roll.diameter > 0)
        record.maps.push_back(dynamics::mark_map(question, roll, sources,
                                                 dynamics::map_axes(question, roll.diameter, sources.modes)));
  const std::string path = command.output.empty() ? "out/" + the_case.name + "-marks" : command.output;
  write_folder(command, the_case, record, sources, known, path);
  if (!command.quiet)
    console::print(table_text(record) + "report: " + path + "/report.html\n");
  return 0;
}
}  // namespace mill
