// The first screen of the page: a verdict, the numbers that a mill is judged by, the stand to scale, and the
// warnings.
#include "core/records/marks_record.h"
#include "core/records/result_names.h"
#include "report/front/chain_table.h"
#include "report/marks/figures.h"
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
constexpr std::size_t most_facts = 5, most_modes = 4;

bool has_failed(const Run &run)
{
  return run.status != "ok" && run.status != "warnings";
}

bool has_value(const Result *result)
{
  return result && std::isfinite(result->value);
}

std::string upper_first(std::string text)
{
  if (!text.empty() && text[0] >= 'a' && text[0] <= 'z')
    text[0] = char(text[0] - 'a' + 'A');
  return text;
}

std::string shown(const Result &result, const int digits = 4)
{
  const Shown value = engineering(result.value, result.unit);
  return known_digits(value.value, result.error_estimate, digits) +
         (value.unit.empty() ? "" : "\u00a0" + escaped(value.unit));
}

// Chatter ------------------------------------------------------------------------------------------------------

// One working condition as far as the results say it.
struct Condition {
  std::string name;
  const Result *critical = nullptr;    // m/s
  const Result *growth   = nullptr;    // 1/s at the working speed
  double working         = not_given;  // m/s
  bool chatters() const
  {
    return has_value(growth) && growth->value > 0;
  }
  double margin() const  // of the working speed; infinite where no speed of the range is critical
  {
    return has_value(critical) ? critical->value / working - 1 : std::numeric_limits<double>::infinity();
  }
};

// The worst first.
std::vector<Condition> conditions(const Run &run)
{
  std::vector<Condition> all;
  for (const Result &result : run.results) {
    const auto parts = parts_of(result.name);
    if (parts.size() != 3 || parts[0] != family::chatter || parts[2] != "growth_rate")
      continue;
    Condition one{parts[1], run.find(result_name({family::chatter, parts[1], "critical_speed"})), &result,
                  quantity_at(result, "m/s")};
    all.push_back(one);
  }
  std::stable_sort(all.begin(), all.end(), [](const Condition &a, const Condition &b) {
    return a.chatters() != b.chatters() ? a.chatters() : a.margin() < b.margin();
  });
  return all;
}

std::string chatter_sentence(const Condition &worst)
{
  const std::string work = std::isfinite(worst.working) ? significant(worst.working, 3) + "\u00a0m/s" : "work";
  const std::string name = "condition " + escaped(worst.name);
  if (worst.chatters())
    return "The stand chatters at its working speed of " + work + " (" + name + ")" +
           (has_value(worst.critical) ? "; the limit is " + shown(*worst.critical) : "");
  if (!has_value(worst.critical))
    return "No speed of the range searched is critical (" + name + ", working at " + work + ")";
  return "Quiet at the working speed of " + work + "; chatter begins at " + shown(*worst.critical) + ", " +
         percent(worst.margin()).substr(1) + " above it (" + name + ")";
}

// Modes --------------------------------------------------------------------------------------------------------

struct OctaveMode {
  NamedMode named;
  const Result *frequency;
};

bool is_gap_mode(const OctaveMode &mode, const char *key)
{
  return mode.frequency->name == result_name({family::mode, key, "frequency"});
}

// The gap modes first: they are what a mill asks for.
std::vector<OctaveMode> modes_by_name(const Run &run)
{
  std::vector<OctaveMode> all;
  for (const Result &result : run.results)
    if (is_of(result.name, family::mode) && ends_with(result.name, ".frequency") && has_value(&result))
      all.push_back({named_mode(result), &result});
  const auto rank = [](const OctaveMode &mode) {
    return is_gap_mode(mode, "gap_first_kind") ? 0 : is_gap_mode(mode, "gap_second_kind") ? 1 : 2;
  };
  std::stable_sort(all.begin(), all.end(),
                   [&](const OctaveMode &a, const OctaveMode &b) { return rank(a) < rank(b); });
  return all;
}

std::string mode_sentence(const Run &run)
{
  std::string text;
  for (const OctaveMode &mode : modes_by_name(run))
    if (is_gap_mode(mode, "gap_first_kind") || is_gap_mode(mode, "gap_second_kind"))
      text += (text.empty() ? "" : "; ") + mode.named.name + " " + shown(*mode.frequency, 3);
  return text;
}

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

std::string card(const Result *result, const std::string &label, const std::string &below = "",
                 const std::string &state = "")
{
  if (!has_value(result))
    return "";
  const bool acceleration = result->name.find("_g.") != std::string::npos;
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

std::string condition_in_words(const std::string &name)
{
  return name == "tandem" ? name : "condition " + name;
}

// The limit of the worst condition, with its margin.
std::string chatter_card(const Condition &c)
{
  const std::string label = condition_in_words(c.name) + ", critical speed";
  if (has_value(c.critical))
    return card(c.critical, label,
                c.chatters() ? "working speed above it" : "margin " + percent(c.margin()).substr(1),
                c.chatters()       ? " bad"
                : c.margin() < 0.1 ? " fair"
                                   : "");
  return card(c.growth, condition_in_words(c.name) + ", growth rate at work", "no critical speed in the range",
              c.chatters() ? " bad" : "");
}

std::string chain_cards(const Run &run)
{
  std::string label;
  const Result *touching = run.find(result_name({family::stand, "modulus.kiss"}));
  std::string all        = card(run.find(result_name({family::stand, "modulus.tangent"})), "mill modulus",
                         has_value(touching) ? "rolls touching " + shown(*touching) : "");
  const auto limits      = conditions(run);
  if (!limits.empty())
    all += chatter_card(limits.front());
  const auto modes = modes_by_name(run);
  for (std::size_t i = 0; i < std::min(most_modes, modes.size()); ++i)
    all += card(modes[i].frequency, modes[i].named.name, modes[i].named.model);
  if (modes.empty())
    all += card(run.find("f1"), "lowest mode, f1") + card(run.find("f6"), "highest mode, f6");
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
    if (is_of(result.name, family::bite) && !is_of_one_model(result.name))
      for (const auto &[quantity, label] : {std::pair("force", ", roll force"),
                                            {"torque", ", torque of one roll"},
                                            {"forward_slip", ", forward slip"}})
        if (const auto dot = result.name.find('.', 5); result.name.substr(dot + 1) == quantity)
          all += card(&result, result.name.substr(5, dot - 5) + label);
  all += card(run.find("bite.fit.friction"), "friction, fitted") +
         card(run.find("bite.fit.flow_stress_factor"), "flow stress, factor fitted");
  return all + card(run.find("K4.combined"), "K4, strip and both arcs") +
         card(run.find("K4.plastic_slope"), "K4, plastic slope");
}

std::string chatter_cards(const Run &run)
{
  std::string all;
  for (const Condition &one : conditions(run))
    all += chatter_card(one) + card(run.find(result_name({family::chatter, one.name, "frequency"})),
                                    condition_in_words(one.name) + ", chatter frequency");
  return all;
}

// The two contacts that a pair of bodies is asked for.
const char *const pair_contacts[] = {"line", "space"};

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

// Force, named modes and limits of the first pass.
std::string cluster_cards(const Run &run)
{
  std::string all;
  const auto groups = short_groups(run);
  if (groups.empty())
    return all;
  const auto &first = groups.front().results;
  for (std::size_t i = 0; i < first.size() && i < 8; ++i) {
    const auto parts        = parts_of(first[i]->name);
    const std::string &what = parts.back();
    const bool mode         = parts.size() == 4;
    std::string label       = what;
    std::replace(label.begin(), label.end(), mode ? '-' : '_', ' ');
    all += card(first[i], mode ? label : label + ", " + parts[1]);
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
    if (const auto parts = parts_of(result.name);
        parts.size() == 3 && parts[0] == marks_family && parts[2] == "per_turn")
      all += card(&result, meaning_of(result.name));
  return all;
}

std::string cards(const Run &run)
{
  if (holds_marks(run))
    return marks_cards(run);
  if (run.manifest.kind == "cluster")
    return cluster_cards(run);
  if (run.manifest.kind == "stack")
    return stack_cards(run);
  if (has_chain(run))
    return chain_cards(run);
  if (run.manifest.kind == "bearing")
    return bearing_cards(run);
  if (run.manifest.kind == "chatter")
    return chatter_cards(run);
  if (run.manifest.kind == "bite")
    return bite_cards(run);
  return contact_cards(run);
}

// Verdict ------------------------------------------------------------------------------------------------------

// What a stand comes down to.
std::string chain_sentence(const Run &run)
{
  std::string text;
  if (const auto limits = conditions(run); !limits.empty())
    text = chatter_sentence(limits.front());
  if (const Result *m = run.find(result_name({family::stand, "modulus.tangent"})); has_value(m))
    text += (text.empty() ? "Mill modulus " : "; mill modulus ") + shown(*m);
  if (const std::string modes = mode_sentence(run); !modes.empty())
    text += (text.empty() ? upper_first(modes) : "; " + modes);
  if (text.empty() && has_value(run.find("f1")))
    text = "Lowest mode " + shown(*run.find("f1")) + ", highest " +
           (has_value(run.find("f6")) ? shown(*run.find("f6")) : "unknown");
  return text;
}

std::string sentence(const Run &run)
{
  if (holds_marks(run))
    return marks_sentence(read_marks(run.directory));
  if (has_chain(run))
    return chain_sentence(run);
  if (run.manifest.kind == "chatter")
    return conditions(run).empty() ? "" : chatter_sentence(conditions(run).front());
  if (run.manifest.kind == "cluster")
    return "";
  if (run.manifest.kind == "stack" && has_value(run.find("stack.crown")) && has_value(run.find("stack.edge_drop")))
    return "The strip has a crown of " + shown(*run.find("stack.crown")) + " and an edge drop of " +
           shown(*run.find("stack.edge_drop"));
  if (run.manifest.kind == "bearing" && has_value(run.find("Kzc.tangent")))
    return "The bearing is a spring of " + shown(*run.find("Kzc.tangent")) +
           (run.find("Kzc.tangent")->at.empty() ? "" : " at " + escaped(run.find("Kzc.tangent")->at));
  if (const Result *k4 = run.find("K4.combined"); run.manifest.kind == "bite" && has_value(k4))
    return "The bite is a spring of " + shown(*k4) + (k4->at.empty() ? "" : " at " + escaped(k4->at));
  for (const char *contact : pair_contacts)
    if (const Result *k = run.find(result_name({family::contact, contact, "tangent"})); has_value(k))
      return "The contact is a spring of " + shown(*k) + (k->at.empty() ? "" : " at " + escaped(k->at));
  return "";
}

std::string count_of_warnings(const Run &run)
{
  const std::size_t n = run.warnings.size();
  return n == 0 ? "warnings" : n == 1 ? "1 warning" : std::to_string(n) + " warnings";
}

// The first word repeats what the colour shows, for readers who do not see colours.
std::string verdict(const Run &run)
{
  if (has_failed(run))
    return "<div class=\"verdict failed\"><p><b>Failed.</b> The run ended with status \u201c" +
           escaped(run.status) + "\u201d; what is shown below was finished before.</p></div>\n";
  const auto limits         = conditions(run);
  const bool poor           = !limits.empty() && limits.front().chatters();
  const bool doubt          = run.status == "warnings" || !run.warnings.empty();
  const std::string outcome = sentence(run);
  const std::string word    = poor    ? "Chatter."
                              : doubt ? "Finished with " + count_of_warnings(run) + "."
                                      : "Finished.";
  return std::string("<div class=\"verdict ") +
         (poor    ? "failed"
          : doubt ? "warnings"
                  : "ok") +
         "\"><p><b>" + word + "</b> " + (outcome.empty() ? "Every stage finished." : outcome + ".") +
         "</p></div>\n";
}

// Warnings -----------------------------------------------------------------------------------------------------

// A warning up to where its explanation begins.
std::size_t end_of_fact(const std::string &warning)
{
  for (const char *mark : {"; ", ". "})
    if (const auto position = warning.find(mark); position != std::string::npos && position > 30)
      return position;
  return warning.size();
}

std::string fact_item(const std::string &warning)
{
  const std::size_t end = end_of_fact(warning);
  if (end + 2 >= warning.size())
    return "<li>" + escaped(warning) + "</li>\n";
  return "<li><details><summary>" + escaped(upper_first(warning.substr(0, end))) + "</summary>" +
         escaped(upper_first(warning.substr(end + 2))) + "</details></li>\n";
}

std::string known(const Run &run)
{
  if (run.warnings.empty())
    return "";
  std::string first, rest;
  for (std::size_t i = 0; i < run.warnings.size(); ++i)
    (i < most_facts ? first : rest) += fact_item(run.warnings[i]);
  const std::size_t more = run.warnings.size() - std::min(most_facts, run.warnings.size());
  return "<div class=\"known\"><ul>\n" + first + "</ul>" +
         (more == 0
              ? ""
              : "<details><summary>" + std::to_string(more) + " more</summary><ul>\n" + rest + "</ul></details>") +
         "</div>\n";
}

// The result that an estimate moves most.
std::string costs_most(const EstimateInfo &e)
{
  const auto most = std::max_element(e.moves.begin(), e.moves.end(), [](const auto &a, const auto &b) {
    return std::abs(a.second) < std::abs(b.second);
  });
  return most == e.moves.end() ? "\u2013" : escaped(most->first) + " " + accuracy(most->second);
}

// Folded: what no drawing gave, by what it costs in accuracy.
std::string estimates(const Run &run)
{
  if (run.estimates.empty())
    return "";
  std::string rows;
  for (const EstimateInfo &e : run.estimates) {
    const Shown value = engineering(e.value, e.unit), low = engineering(e.low, e.unit),
                high        = engineering(e.high, e.unit);
    const std::string range = low.unit == value.unit && high.unit == value.unit
                                  ? significant(low.value, 3) + " .. " + significant(high.value, 3)
                                  : "";
    rows += "<tr><th scope=\"row\"><code>" + escaped(e.key) + "</code></th><td class=\"num\"><b>" +
            significant(value.value, 3) + "</b> " + escaped(value.unit) + "</td><td>" + range + "</td><td>" +
            costs_most(e) + "</td><td>" + escaped(e.rule) + "</td></tr>\n";
  }
  return "<details class=\"known estimates\"><summary>" + std::to_string(run.estimates.size()) +
         (run.estimates.size() == 1 ? " value is estimated; " : " values are estimated; ") +
         escaped(run.estimates.front().key) +
         " costs most "
         "accuracy</summary>\n<table><thead><tr><th>key</th><th>estimate</th><th>interval</th><th>moves "
         "most</th><th>rule</th></tr></thead>\n<tbody>\n" +
         rows + "</tbody></table></details>\n";
}

std::string screen_head(const Run &run)
{
  const Manifest &m = run.manifest;
  std::string facts;
  for (const auto &[name, value] : {std::pair<const char *, const std::string &>("case", run.case_name),
                                    {"kind", m.kind},
                                    {"run", m.run_id},
                                    {"date", m.date}})
    if (!value.empty())
      facts += std::string("<div><dt>") + name + "</dt><dd>" + escaped(value) + "</dd></div>";
  return "<header><h1>" + escaped(m.title.empty() ? run.case_name : m.title) + "</h1><dl class=\"facts\">" +
         facts + "</dl></header>\n";
}
}  // namespace

std::string first_screen(const Run &run)
{
  const std::string drawing = stand_to_scale(run);
  const std::string numbers = cards(run);
  std::string both          = numbers.empty() ? "" : "<div class=\"cards\">\n" + numbers + "</div>\n";
  if (!drawing.empty())
    both += "<figure>" + drawing + "<figcaption>The stand to scale.</figcaption></figure>\n";
  if (!both.empty())
    both = std::string("<div class=\"first") + (drawing.empty() ? " alone" : "") + "\">\n" + both + "</div>\n";
  return screen_head(run) + verdict(run) + both + chain_table(run) + known(run) + estimates(run);
}
}  // namespace mill::report
