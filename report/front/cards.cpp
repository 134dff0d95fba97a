// The numbers that a mill is judged by, one card each.
#include "report/front/cards.h"
#include "core/base/short_number.h"
#include "core/records/marks_record.h"
#include "core/records/result_names.h"
#include "core/records/result_words.h"
#include "core/records/rows_of_bite.h"
#include "core/records/rows_of_cluster.h"
#include "core/records/rows_of_response.h"
#include "core/records/rows_of_stand.h"
#include "report/front/stability.h"
#include "report/marks/figures.h"
#include "report/page/curves.h"
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/results/named_mode.h"
#include "report/results/names.h"
#include "report/results/tables.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
// Levels -------------------------------------------------------------------------------------------------------

// The largest level of the work rolls under a force that was measured; nullptr: every record is made.
const Result *largest_level(const Run &run, std::string &label)
{
  const Result *largest = nullptr;
  for (const PassInfo &pass : run.manifest.passes)
    for (const char *roll : {"upper", "lower"}) {
      const Result *peak = pass_value(run, pass, std::string("peak_g.") + roll + "_work_roll");
      if (pass.synthetic || !has_value(peak) || (largest && largest->value >= peak->value))
        continue;
      largest = peak;
      label   = "largest level, " + std::string(roll) + " work roll, " + pass.name;
    }
  return largest;
}

// Cards --------------------------------------------------------------------------------------------------------

const ResultRow *const in_units_of_g[]{&row::response::peak, &row::response::rms};

std::string card(const Result *result, const std::string &label, const std::string &below = "",
                 const std::string &state = "")
{
  if (!has_value(result))
    return "";
  const bool acceleration = is_made_by(in_units_of_g, result->name);
  const Shown shown =
      acceleration ? Shown{in_g(result->value, result->unit), "g"} : engineering(result->value, result->unit);
  const std::string number =
      acceleration ? g_text(shown.value) : known_digits(shown.value, result->error_estimate);
  std::string small = std::isfinite(result->error_estimate) ? accuracy(result->error_estimate) : "";
  for (const std::string &more : {below, result->at.empty() ? "" : "at " + short_source(result->at)})
    small += (small.empty() || more.empty() ? "" : "; ") + escaped(more);
  return "<div class=\"card" + state + "\" title=\"" + escaped(result->source) + "\"><span>" + escaped(label) +
         "</span><b>" + number + "</b> " + escaped(shown.unit) + "<small>" + small + "</small></div>\n";
}

// Critical speed -----------------------------------------------------------------------------------------------

constexpr double small_margin     = 0.1;
constexpr std::size_t most_speeds = 3, most_modes = 4;

std::string tile(const std::string &label, const std::string &number, const std::string &unit,
                 const std::string &below, const std::string &title = "", const std::string &state = "")
{
  return "<div class=\"card" + state + "\" title=\"" + escaped(title) + "\"><span>" + escaped(label) +
         "</span><b>" + number + "</b> " + escaped(unit) + "<small>" + escaped(below) + "</small></div>\n";
}

std::string speed_state(const SpeedVerdict &v)
{
  if (v.finding == SpeedFinding::unstable)
    return " bad";
  return v.is_doubtful() || (v.finding == SpeedFinding::below && v.margin() < small_margin) ? " fair" : "";
}

std::string speed_card(const SpeedVerdict &v, const std::string &of_pass)
{
  if (v.finding == SpeedFinding::not_searched)
    return "";
  if (std::isfinite(v.gap[0]))
    return tile("critical speed" + of_pass, fixed(v.gap[0], 3) + " to " + fixed(v.gap[1], 3), "m/s",
                "the search has no answer there", "", speed_state(v));
  if (std::isnan(v.critical)) {
    if (!(v.range[1] > 0))  // of kind chatter: its table has the range
      return std::isnan(v.growth)
                 ? ""
                 : tile("growth rate at " + fixed(v.speed, 1) + " m/s" + of_pass, significant(v.growth, 3), "1/s",
                        "no critical speed in the range", "", speed_state(v));
    return tile("critical speed" + of_pass, v.finding == SpeedFinding::unstable ? "unstable" : "none", "",
                "from " + short_number(v.range[0], 3) + " to " + short_number(v.range[1], 3) + " m/s", "",
                speed_state(v));
  }
  std::string below          = interval_text(v);
  const std::string relation = v.speed > v.critical ? "margin \u2212" : "margin ";
  if (std::isfinite(v.speed))
    below += (below.empty() ? "" : "; ") + relation + margin_text(v) + " at " + fixed(v.speed, 1) + " m/s";
  return tile("critical speed" + of_pass, speed_digits(v), "m/s", below, "95 % interval", speed_state(v));
}

// The worst ones; a pass that was not searched has no card.
std::string speed_cards(const Run &run)
{
  const auto verdicts = speed_verdicts(run);
  std::string all;
  for (std::size_t i = 0; i < std::min(most_speeds, verdicts.size()); ++i)
    all += speed_card(verdicts[i], verdicts.size() == 1 ? "" : ", " + title_of_pass(run, verdicts[i].pass));
  return all;
}

// Gap modes ----------------------------------------------------------------------------------------------------

// "damping 2.0 % at 15.0 m/s": where the mode that chatter found in the gap is this one, moved by the bite.
std::string damping_of(const Run &run, const Result &frequency)
{
  constexpr double same_mode = 0.3;
  for (const SpeedVerdict &v : speed_verdicts(run)) {
    const Result *with_bite = run.find(result_name({family::chatter, v.pass, "gap_mode_frequency"}));
    if (has_value(with_bite) && std::isfinite(v.damping) &&
        std::abs(with_bite->value / frequency.value - 1) < same_mode)
      return "damping " + significant(100 * v.damping, 2) + " % at " + fixed(v.speed, 1) + " m/s";
  }
  return "";
}

std::string gap_mode_card(const Run &run, const std::string &key)
{
  const Result *frequency = run.find(result_name({family::mode, key, "frequency"}));
  if (!has_value(frequency))
    return "";
  const Result *open        = run.find(result_name({family::open, family::mode, key, "frequency"}));
  const std::string damping = is_word(key, ResultWord::gap_first_kind) ? damping_of(run, *frequency) : "";
  const NamedMode named     = named_mode(*frequency);
  std::string below         = named.model;
  if (has_value(open))
    below = "rolling" + (damping.empty() ? "" : ", " + damping) + "; open stand " + shown(*open);
  else if (!damping.empty())
    below = damping;
  return card(frequency, named.name, below);
}

// Without gap modes (a case of kind lumped that names none) the first modes by name.
std::string mode_cards(const Run &run)
{
  std::string all = gap_mode_card(run, "gap_first_kind") + gap_mode_card(run, "gap_second_kind");
  if (!all.empty())
    return all;
  std::size_t n = 0;
  for (const Result &result : run.results)
    if (const auto id = result_id(result.name); id && id->is_of(row::modes::frequency) &&
                                                id->place("open").empty() && has_value(&result) &&
                                                n++ < most_modes)
      all += card(&result, named_mode(result).name, named_mode(result).model);
  return n > 0 ? all : card(run.find("f1"), "lowest mode, f1") + card(run.find("f6"), "highest mode, f6");
}

// Forces -------------------------------------------------------------------------------------------------------

// The pass whose bite is furthest from the force that was given or measured; the stage marks it by its remedy.
std::string force_card(const Run &run)
{
  std::string worst;
  double largest = 0;
  for (const Result &result : run.results) {
    const auto id = result_id(result.name);
    if (!id || !id->is_of(row::bite::force) || !has_value(&result))
      continue;
    for (const Check &check : result.checks)
      if (const double apart = result.value / check.value - 1;
          check.note == force_remedy && std::abs(apart) > largest) {
        largest            = std::abs(apart);
        const auto in_unit = [&](const double force) {
          const Shown value = engineering(force, result.unit);
          return significant(value.value, 3) + " " + value.unit;
        };
        worst = tile("force of the bite against " + check.name + ", " + id->place("pass"), percent(apart), "",
                     in_unit(result.value) + " against " + in_unit(check.value) + "; " + force_remedy,
                     result.source, " fair");
      }
  }
  return worst;
}

std::string modulus_card(const Run &run)
{
  const Result *touching = run.find(result_name({family::stand, "modulus.kiss"}));
  const Result *strip    = run.find(result_name({family::stand, "modulus.tangent"}));
  if (!has_value(strip))
    return card(touching, "mill modulus, rolls touching");
  return card(strip, "mill modulus with strip", has_value(touching) ? "rolls touching " + shown(*touching) : "");
}

std::string chain_cards(const Run &run)
{
  std::string label;
  std::string all = speed_cards(run) + mode_cards(run) + modulus_card(run) + force_card(run);
  if (const Result *level = largest_level(run, label))
    all += card(level, label);
  return all;
}

std::string bearing_cards(const Run &run)
{
  std::string all;
  for (const auto &[name, label] : {std::pair("Kzc.tangent", "Kzc, tangent"),
                                    {"Kzc.secant", "Kzc, secant"},
                                    {"Kzc.tangent_across", "Kzc, tangent across the load"},
                                    {"Kzc.roller_max", "heaviest roller"},
                                    {"Kzc.heaviest_angle", "its angle from the load line"},
                                    {"Kzc.motion.peak_force", "peak force, driven mass"}})
    all += card(run.find(name), label);
  return all;
}

std::string bite_cards(const Run &run)
{
  std::string all;
  for (const Result &result : run.results)
    if (const auto id = result_id(result.name))
      for (const auto &[row, label] : {std::pair(&row::bite::force, ", roll force"),
                                       {&row::bite::torque, ", torque of one roll"},
                                       {&row::bite::forward_slip, ", forward slip"}})
        if (id->is_of(*row))
          all += card(&result, id->place("pass") + label);
  all += card(run.find("bite.fit.friction"), "friction, fitted") +
         card(run.find("bite.fit.flow_stress_factor"), "flow stress, factor fitted");
  return all + card(run.find("K4.combined"), "K4, strip and both arcs") +
         card(run.find("K4.plastic_slope"), "K4, plastic slope");
}

std::string contact_cards(const Run &run)
{
  std::string all;
  for (const char *contact : pair_contacts)
    for (const auto &[aspect, label] : {std::pair("tangent", "stiffness, tangent"),
                                        {"secant", "stiffness, secant"},
                                        {"approach", "approach"},
                                        {"half_width", "half width"},
                                        {"peak_pressure", "peak pressure"}})
      all += card(run.find(result_name({family::contact, contact, aspect})), label);
  return all;
}

// Critical speed and gap modes as of any stand, then force and limits of the first pass; its modes by their shape
// where it has no gap modes.
std::string cluster_cards(const Run &run)
{
  const std::string gap = gap_mode_card(run, "gap_first_kind") + gap_mode_card(run, "gap_second_kind");
  std::string all       = speed_cards(run) + gap;
  const auto groups     = short_groups(run);
  if (groups.empty())
    return all;
  std::size_t n = 0;
  for (const Result *result : groups.front().results) {
    const auto id = result_id(result->name);
    if (id->is_of(row::cluster::mode)) {
      std::string label = id->place("mode");
      std::replace(label.begin(), label.end(), '-', ' ');
      if (gap.empty() && n++ < most_modes)
        all += card(result, label);
    } else
      for (const auto &[row, label] : {std::pair<const ResultRow *, const char *>(&row::cluster::force, "force"),
                                       {&row::cluster::buckling_factor, "buckling factor"},
                                       {&row::cluster::leaving_force, "leaving force"}})
        if (id->is_of(*row))
          all += card(result, label + (", " + id->place("pass")));
  }
  return all;
}

// What one asks of the strip.
std::string stack_cards(const Run &run)
{
  std::string all;
  for (const auto &[name, label] : {std::pair("crown", "crown of the strip"),
                                    {"edge_drop", "edge drop"},
                                    {"wedge", "wedge"},
                                    {"opening", "opening of the gap"},
                                    {"modulus.mid", "modulus of the stack"},
                                    {"flatness.max", "flatness, longest fibre, I-units"}})
    all += card(run.find(result_name({"stack", name})), label);
  return all;
}

std::string marks_cards(const Run &run)
{
  std::string all = card(run.find(result_name({marks_family, "frequency"})), "frequency of the marks");
  for (const Result &result : run.results)
    if (is_made_by(row::marks::per_turn, result.name))
      all += card(&result, meaning_of(result.name));
  return all;
}

}  // namespace

std::string cards(const Run &run)
{
  if (holds_marks(run))
    return marks_cards(run);
  if (run.manifest.kind == KindOfCase::cluster)
    return cluster_cards(run);
  if (run.manifest.kind == KindOfCase::stack)
    return stack_cards(run);
  if (has_chain(run))
    return chain_cards(run);
  if (run.manifest.kind == KindOfCase::bearing)
    return bearing_cards(run);
  if (run.manifest.kind == KindOfCase::chatter)
    return speed_cards(run);
  if (run.manifest.kind == KindOfCase::bite)
    return bite_cards(run);
  return contact_cards(run);
}

bool has_value(const Result *result)
{
  return result && std::isfinite(result->value);
}

std::string shown(const Result &result, const int digits)
{
  const Shown value = engineering(result.value, result.unit);
  return known_digits(value.value, result.error_estimate, digits) +
         (value.unit.empty() ? "" : "\u00a0" + value.unit);
}
}  // namespace mill::report
