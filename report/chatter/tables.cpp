#include "core/base/si_unit.h"
#include "core/records/published_quantity.h"
#include "core/records/stability_finding.h"
#include "report/chatter/figures.h"
#include "report/page/cells.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
std::string in_plain_words(const std::string &text)
{
  return "<td>" + (text.empty() ? "\u2013" : escaped(text)) + "</td>";
}

std::string speed_text(const double speed)
{
  return fixed(speed, 2);
}

const ChatterPublished *published_of(const ChatterCondition &condition, const PublishedQuantity quantity)
{
  for (const ChatterPublished &entry : condition.published)
    if (entry.quantity == word_of(quantity))
      return &entry;
  return nullptr;
}

// Another value of the critical speed and how far this run is from it.
std::string compared_cell(const double here, const double other)
{
  return cell(std::isfinite(other) ? speed_text(other) + deviation_note(here, other) : "\u2013");
}
}  // namespace

std::string verdict_in_words(const std::string &verdict, const double speed)
{
  const auto finding = choice_named<StabilityFinding>(verdict);
  if (!finding)
    return verdict.empty() ? "\u2013" : verdict;
  switch (*finding) {
  case StabilityFinding::crossing:
    return std::isfinite(speed) ? "chatters from " + speed_text(speed) + " m/s" : "chatters within the range";
  case StabilityFinding::stable:
  case StabilityFinding::unstable:
    return verdict + " throughout";
  case StabilityFinding::unstable_below:
    return "unstable at low speed, stable above";
  case StabilityFinding::unstable_beyond_gap:
    return "stable at low speed, unstable above speeds without an answer";
  case StabilityFinding::no_bite:
    break;
  }
  return "no steady bite in the range";
}

std::string chatter_summary_table(const std::vector<ChatterCondition> &conditions)
{
  std::string body;
  for (const ChatterCondition &c : conditions) {
    const ChatterPublished *other = published_of(c, PublishedQuantity::critical_speed);
    const double growth           = c.critical.growth_at_working;
    const std::string at_work     = !std::isfinite(growth) ? "\u2013"
                                    : growth > 0           ? "<span class=\"poor-word\">chatters</span>"
                                                           : "<span class=\"good-word\">stable</span>";
    const std::string speed       = std::isfinite(c.critical.speed) ? speed_text(c.critical.speed)
                                                                    : verdict_in_words(c.critical.verdict, not_given);
    body += named_row(c.name, "<td>" + at_work + "</td>" + cell("<b>" + escaped(speed) + "</b>") +
                                  compared_cell(c.critical.speed, other ? other->published : not_given) +
                                  compared_cell(c.critical.speed, other ? other->measured : not_given) +
                                  cell(fixed(c.critical.frequency, 1)) + cell(speed_text(c.speed)) +
                                  cell(percent(c.speed / c.critical.speed - 1)) + cell(significant(growth, 3)));
  }
  return table_of("<th>condition</th><th>at work</th><th>critical speed [m/s]</th><th>published model [m/s]</th>"
                  "<th>measured [m/s]</th><th>frequency [Hz]</th><th>working speed [m/s]</th>"
                  "<th>working over critical</th><th>growth rate at work [1/s]</th>",
                  body);
}

std::string chatter_published_table(const std::vector<ChatterCondition> &conditions)
{
  std::string body;
  for (const ChatterCondition &c : conditions)
    for (const ChatterPublished &entry : c.published) {
      const auto other = [&](const double value) {
        return cell(significant(value, 4) + deviation_note(entry.here, value));
      };
      body += named_row(c.name, in_plain_words(entry.quantity + after_name(unit_sign(entry.unit))) +
                                    cell("<b>" + significant(entry.here, 5) + "</b>") + other(entry.published) +
                                    other(entry.measured) + "<td>" + escaped(entry.note) + "</td>");
    }
  return table_of("<th>condition</th><th>quantity</th><th>this run</th><th>published model</th><th>measured</th>"
                  "<th>note</th>",
                  body);
}

namespace {
std::string outcome_cells(const ChatterVariantInfo &variant, const double reference)
{
  const std::string speed = std::isfinite(variant.critical_speed)
                                ? speed_text(variant.critical_speed)
                                : escaped(verdict_in_words(variant.verdict, not_given));
  return cell(speed +
              (variant.critical_speed != reference ? deviation_note(variant.critical_speed, reference) : "")) +
         cell(fixed(variant.frequency, 1));
}

constexpr const char *outcome_head = "<th>critical speed [m/s]</th><th>frequency [Hz]</th>";
}  // namespace

std::string chatter_scheme_table(const ChatterCondition &condition)
{
  struct Meaning {
    const char *name, *what;
  };
  const Meaning meanings[] = {
      {"sequential", "film and exit point keep the strip speeds of the steady state"},
      {"consistent", "everything follows"},
      {"frozen-friction", "friction keeps its steady value"},
  };
  std::string body;
  for (const ChatterVariantInfo &scheme : condition.schemes) {
    std::string what;
    for (const Meaning &meaning : meanings)
      if (scheme.name == meaning.name)
        what = meaning.what;
    body += named_row(scheme.name, in_plain_words(what) + outcome_cells(scheme, condition.critical.speed));
  }
  return table_of(std::string("<th>linearisation</th><th>what follows the vibration</th>") + outcome_head, body);
}

std::string chatter_variant_table(const ChatterCondition &condition)
{
  std::string body;
  for (const ChatterVariantInfo &v : condition.variants)
    body += named_row(v.name, outcome_cells(v, condition.critical.speed) + cell(significant(v.ratio, 3)) +
                                  cell(fixed(v.force_phase, 1)) + cell(fixed(v.entry_tension_phase, 1)) + "<td>" +
                                  (!std::isfinite(v.ratio) ? "\u2013"
                                   : v.upper_moves_more    ? "upper"
                                                           : "lower") +
                                  "</td>");
  return table_of(std::string("<th>variant</th>") + outcome_head +
                      "<th>upper over lower work roll</th><th>force against gap [\u00b0]</th>"
                      "<th>back tension against gap [\u00b0]</th><th>moves more</th>",
                  body);
}

std::string chatter_conclusion_table(const ChatterCondition &condition)
{
  std::string body;
  for (const ChatterConclusion &c : condition.conclusions)
    body += named_row(c.text, std::string("<td>") +
                                  (c.holds ? "<span class=\"good-word\">holds in all</span>"
                                           : "<span class=\"poor-word\">depends on the variant</span>") +
                                  "</td>" + in_plain_words(c.detail));
  return table_of("<th>conclusion</th><th></th><th>found</th>", body);
}

std::string chatter_structure_table(const ChatterCondition &condition)
{
  std::string body;
  for (const ChatterVariantInfo &s : condition.structures)
    body += named_row(s.name, outcome_cells(s, condition.critical.speed) + cell(significant(s.growth, 3)));
  return table_of(std::string("<th>model of the stand</th>") + outcome_head +
                      "<th>growth rate at the working speed [1/s]</th>",
                  body);
}

std::string chatter_event_table(const LimitCycleInfo &cycle)
{
  struct Kind {
    std::string what;
    double first, last;
    int count;
  };
  std::vector<Kind> kinds;
  for (const ChatterEventInfo &event : cycle.events) {
    const auto known =
        std::find_if(kinds.begin(), kinds.end(), [&](const Kind &kind) { return kind.what == event.what; });
    if (known == kinds.end())
      kinds.push_back({event.what, event.time, event.time, 1});
    else {
      known->last = event.time;
      ++known->count;
    }
  }
  std::string body;
  for (const Kind &kind : kinds)
    body += named_row(kind.what,
                      cell(fixed(kind.first, 4)) + cell(fixed(kind.last, 4)) + cell(std::to_string(kind.count)));
  return table_of("<th>event</th><th>first [s]</th><th>last [s]</th><th>how often</th>", body);
}

std::string chatter_tandem_table(const ChatterTandem &tandem)
{
  const double all = tandem.critical_speed;
  const auto other = [&](const std::string &what, const double speed, const std::string &note) {
    return std::isfinite(speed) ? named_row(what, cell(speed_text(speed) + deviation_note(speed, all)) +
                                                      cell("\u2013") + in_plain_words(note))
                                : "";
  };
  std::string body =
      named_row("all stands, strip in between",
                cell("<b>" + speed_text(all) + "</b>") + cell(fixed(tandem.frequency, 1)) +
                    in_plain_words(tandem.verdict.empty() ? "" : verdict_in_words(tandem.verdict, all)));
  body += other("tension shared alone", tandem.without_delay,
                "without the thickness that travels from stand to stand");
  for (const ChatterVariantInfo &stand : tandem.single)
    body += named_row("stand " + stand.name + " alone",
                      cell(std::isfinite(stand.critical_speed)
                               ? speed_text(stand.critical_speed) + deviation_note(stand.critical_speed, all)
                               : "\u2013") +
                          cell(fixed(stand.frequency, 1)) + in_plain_words("its strip ends at constant speed"));
  return table_of("<th>system</th><th>critical speed [m/s]</th><th>frequency [Hz]</th><th>meaning</th>", body);
}
}  // namespace mill::report
