// The first screen of the page: a verdict, the numbers that a mill is judged by, the stand to scale, and the
// warnings.
#include "core/base/name_part.h"
#include "core/base/text.h"
#include "core/records/marks_record.h"
#include "core/records/result_names.h"
#include "core/records/run_status.h"
#include "report/front/cards.h"
#include "report/front/chain_table.h"
#include "report/front/stability.h"
#include "report/marks/figures.h"
#include "report/page/sections.h"
#include "report/plot/number.h"
#include "report/plot/svg.h"
#include "report/results/names.h"
#include "report/results/tables.h"
#include <algorithm>
#include <cmath>

namespace mill::report {
namespace {
constexpr std::size_t most_facts = 5;

bool has_failed(const Run &run)
{
  return !choice_named<RunStatus>(run.status);
}

// A sentence begins with a capital; a key of the case ("output_rate", "strip.width") stays as it is written.
std::string upper_first(std::string text)
{
  const std::string word = text.substr(0, text.find_first_of(" :,"));
  if (!word.empty() && has_only(word, "abcdefghijklmnopqrstuvwxyz-"))
    text[0] = char(text[0] - 'a' + 'A');
  return text;
}

// Verdict ------------------------------------------------------------------------------------------------------

std::string sentence(const Run &run)
{
  if (holds_marks(run))
    return marks_sentence(read_marks(run.directory));
  if (run.manifest.kind == KindOfCase::stack && has_value(run.find("stack.crown")) &&
      has_value(run.find("stack.edge_drop")))
    return "The strip has a crown of " + shown(*run.find("stack.crown")) + " and an edge drop of " +
           shown(*run.find("stack.edge_drop"));
  if (run.manifest.kind == KindOfCase::bearing && has_value(run.find("Kzc.tangent")))
    return "The bearing is a spring of " + escaped(shown(*run.find("Kzc.tangent"))) +
           (run.find("Kzc.tangent")->at.empty() ? "" : " at " + escaped(run.find("Kzc.tangent")->at));
  if (const Result *k4 = run.find("K4.combined"); run.manifest.kind == KindOfCase::bite && has_value(k4))
    return "The bite is a spring of " + escaped(shown(*k4)) + (k4->at.empty() ? "" : " at " + escaped(k4->at));
  for (const char *contact : pair_contacts)
    if (const Result *k = run.find(result_name({family::contact, contact, "tangent"})); has_value(k))
      return "The contact is a spring of " + escaped(shown(*k)) + (k->at.empty() ? "" : " at " + escaped(k->at));
  return "";
}

std::string count_of_warnings(const Run &run)
{
  const std::size_t n = run.warnings.size();
  return n == 0 ? "warnings" : n == 1 ? "1 warning" : std::to_string(n) + " warnings";
}

// The words of the worst verdict, with its pass where the passes differ; empty: nothing was asked.
std::string stability_sentence(const Run &run, const std::vector<SpeedVerdict> &verdicts)
{
  if (verdicts.empty())
    return "";
  const std::string worst = sentence_of(verdicts.front());
  const bool differ       = std::any_of(verdicts.begin(), verdicts.end(),
                                        [&](const SpeedVerdict &v) { return sentence_of(v) != worst; });
  return escaped(differ ? title_of_pass(run, verdicts.front().pass) + ": " + worst : worst);
}

// The words repeat what the colour shows, for readers who do not see colours.
std::string verdict(const Run &run)
{
  if (has_failed(run))
    return "<div class=\"verdict failed\"><p><b>Failed.</b> The run ended with status \u201c" +
           escaped(run.status) + "\u201d; what is shown below was finished before.</p></div>\n";
  const auto verdicts         = speed_verdicts(run);
  const bool poor             = !verdicts.empty() && verdicts.front().finding == SpeedFinding::unstable;
  const bool unsure           = !verdicts.empty() && verdicts.front().is_doubtful();
  const bool doubt            = run.status == word_of(RunStatus::warnings) || !run.warnings.empty();
  const std::string finished  = doubt ? "Finished with " + count_of_warnings(run) + "." : "Finished.";
  const std::string stability = stability_sentence(run, verdicts), outcome = sentence(run);
  const std::string words =
      stability.empty()
          ? "<b>" + finished + "</b>" + (outcome.empty() ? "" : " " + outcome + ".")
          : "<b>" + stability + "</b> " + (unsure ? "The working speed lies in the interval. " : "") +
                (verdicts.front().remedy.empty() ? "" : escaped(verdicts.front().remedy) + " ") +
                (doubt ? finished : "");
  return std::string("<div class=\"verdict ") +
         (poor              ? "failed"
          : doubt || unsure ? "warnings"
                            : "ok") +
         "\"><p>" + words + "</p></div>\n";
}

// Warnings -----------------------------------------------------------------------------------------------------

// The name of a pass stays as it is written.
bool is_pass(const Run &run, const std::string &subject)
{
  return std::any_of(run.manifest.passes.begin(), run.manifest.passes.end(),
                     [&](const PassInfo &pass) { return with_plain_names(pass.name) == subject; });
}

std::string fact_of(const Run &run, const Warning &warning)
{
  if (warning.subject.empty())
    return upper_first(warning.fact);
  return (is_pass(run, warning.subject) ? warning.subject : upper_first(warning.subject)) + ": " + warning.fact;
}

std::string place_of(const Warning &warning)
{
  if (warning.key.empty())
    return "";
  return "<div class=\"place\"><code>" + escaped(warning.key) + "</code>" +
         (warning.place.line > 0 ? ", line " + std::to_string(warning.place.line) : "") + "</div>";
}

// The fact, and folded what follows from it, what to do and where.
std::string fact_item(const Run &run, const Warning &warning)
{
  const std::string fact  = escaped(fact_of(run, warning)),
                    begin = std::string("<li data-id=\"") + id_of(warning.id) + "\">";
  std::string more;
  for (const std::string &part : {warning.detail, warning.remedy})
    if (!part.empty())
      more += "<div>" + escaped(upper_first(part)) + "</div>";
  more += place_of(warning);
  return more.empty() ? begin + fact + "</li>\n"
                      : begin + "<details><summary>" + fact + "</summary>" + more + "</details></li>\n";
}

std::string known(const Run &run)
{
  if (run.warnings.empty())
    return "";
  std::string first, rest;
  for (std::size_t i = 0; i < run.warnings.size(); ++i)
    (i < most_facts ? first : rest) += fact_item(run, run.warnings[i]);
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
  const Manifest &m      = run.manifest;
  const std::string kind = m.kind ? word_of(*m.kind) : "";
  std::string facts;
  for (const auto &[name, value] : {std::pair<const char *, const std::string &>("case", run.case_name),
                                    {"kind", kind},
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
