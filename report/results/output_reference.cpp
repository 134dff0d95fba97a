#include "report/results/output_reference.h"
#include "core/base/digits.h"
#include "core/base/note.h"
#include "core/base/si_unit.h"
#include "core/records/chain_number.h"
#include "core/records/cluster_names.h"
#include "core/records/contact_name.h"
#include "core/records/result_names.h"
#include "core/records/result_words.h"
#include "core/records/stack_names.h"
#include "report/results/names.h"
#include <algorithm>
#include <array>
#include <cctype>
#include <map>

namespace mill::report {
namespace {
struct OutputGroup {
  const char *family;  // first part of the row
  const char *title;
  const char *chapter;  // of docs/theory
  bool begins = false;  // the first part only begins so
};

constexpr std::array<OutputGroup, 31> output_groups{{
    {"K3", "Contact of the upper rolls", "12-contact-of-meshed-bodies"},
    {"K5", "Contact of the lower rolls", "12-contact-of-meshed-bodies"},
    {"K4", "Roll bite as a spring", "08-roll-bite-slab-theories"},
    {"contact", "Roll contact in detail", "12-contact-of-meshed-bodies"},
    {"Kzc", "A bearing alone", "05-roller-bearings"},
    {"KzcN", "Bearings of the stand", "05-roller-bearings", true},
    {"bearing", "Rating and life of bearings, oil films", "05-roller-bearings"},
    {"bite", "Roll bite", "08-roll-bite-slab-theories"},
    {"KN", "Springs of the six-mass chain", "04-springs-and-masses"},
    {"K_ZW", "Seat of a work roll", "04-springs-and-masses"},
    {"K_Zy", "Seat of the upper backup roll", "04-springs-and-masses"},
    {"K_Zy_lower", "Seat of the lower backup roll", "04-springs-and-masses"},
    {"MN", "Equivalent masses", "04-springs-and-masses"},
    {"C", "Damper of the gap", "06-lumped-model"},
    {"fN", "Natural frequencies of the six masses", "06-lumped-model"},
    {"fhN", "Natural frequencies across the rolling line", "06-lumped-model"},
    {"mode", "Modes by name", "22-stand-models"},
    {"open", "Open stand, K4 = 0", "22-stand-models"},
    {"beam", "Stand of Timoshenko beams", "22-stand-models"},
    {"craig-bampton", "Stand of reduced finite elements", "22-stand-models"},
    {"housing", "Mill housing", "23-housing-and-screw-down"},
    {"frame", "Frame and screw-down", "23-housing-and-screw-down"},
    {"stand", "Mill modulus and thickness of the strip", "30-mill-modulus"},
    {"frf", "Frequency response", "32-frequency-response"},
    {"campbell", "Speeds at which something in the mill excites a mode", "32-frequency-response"},
    {"chatter", "Chatter", "25-chatter-single-stand"},
    {"cluster", "Planar stacks of rolls", "38-planar-roll-stacks"},
    {"stack", "Roll stacks: strip and stack", "51-roll-stacks"},
    {"pair", "Roll stacks: contacts", "51-roll-stacks"},
    {"roll", "Roll stacks: rolls", "51-roll-stacks"},
    {"influence", "Roll stacks: what moves the profile", "51-roll-stacks"},
}};

// "f12" -> "fN", "Kzc3_across" -> "KzcN_across", "row2_axial" -> "rowN_axial"; K3, K4 and K5 have rows of their
// own.
std::string numbers_replaced(const std::string &part)
{
  if (is_digits(part))
    return "N";
  if (part == word_of(ChainNumber::K3) || part == word_of(ChainNumber::K4) || part == word_of(ChainNumber::K5) ||
      part.rfind("L10", 0) == 0)
    return part;
  std::string out;
  for (std::size_t i = 0; i < part.size(); ++i) {
    if (!std::isdigit((unsigned char)part[i])) {
      out += part[i];
      continue;
    }
    if (i == 0 || !std::isdigit((unsigned char)part[i - 1]))
      out += 'N';
  }
  return out;
}

const OutputGroup *group_of(const std::string &row)
{
  const std::string family = parts_of(row)[0];
  for (const OutputGroup &group : output_groups)
    if (family == group.family || (group.begins && family.rfind(group.family, 0) == 0))
      return &group;
  return nullptr;
}

struct OutputRow {
  std::string name, meaning, unit, method, equation;
};

// "computed: contact FEM, plane strain (12.3)" -> "contact FEM" and "12.3".
void read_source(const std::string &source, OutputRow &row)
{
  const auto colon = source.find(": ");
  row.method       = source.substr(colon == std::string::npos ? 0 : colon + 2);
  for (std::size_t open = source.find('('); open != std::string::npos; open = source.find('(', open + 1)) {
    const std::string inside = source.substr(open + 1, source.find(')', open) - open - 1);
    const auto dot           = inside.find('.');
    if (dot == std::string::npos || !is_digits(inside.substr(0, dot)) || inside.size() > dot + 4)
      continue;
    std::string after = inside.substr(dot + 1);
    if (!after.empty() && std::islower((unsigned char)after.back()))
      after.pop_back();
    if (is_digits(after))
      row.equation = inside;
  }
  row.method = row.method.substr(0, row.method.find_first_of(",;("));
  while (!row.method.empty() && row.method.back() == ' ')
    row.method.pop_back();
}

std::string replaced(std::string text, const std::string &part, const std::string &by)
{
  if (part.empty())
    return text;
  for (std::size_t i = text.find(part); i != std::string::npos; i = text.find(part, i + by.size()))
    text.replace(i, part.size(), by);
  return text;
}

std::string cell(std::string text)
{
  return replaced(std::move(text), "|", "\\|");
}

// cluster.PASS.WORD.ROLL
bool is_of_roll(const std::string &part)
{
  const auto word = choice_named<ResultWord>(part);
  return word == ResultWord::velocity || word == ResultWord::acceleration || word == ResultWord::least_guide;
}

// "cluster.PASS.W-I.force", "cluster.PASS.W.x", "cluster.PASS.velocity.W.y",
// "cluster.fit.VARIANT.contact.W-I.stiffness": rolls and contacts have the names that the case gives them.
void name_cluster_parts(std::vector<std::string> &parts)
{
  if (parts[1] == cluster_fit && parts.size() > 4) {
    parts[2] = "VARIANT";
    parts[4] = is_word(parts[3], ResultWord::contact) ? "CONTACT" : "ROLL";
  } else if (parts.size() > 3 && parts[2] == family::mode) {
    parts = {parts[0], parts[1], parts[2], "MODE"};
  } else if (parts.size() > 3 && is_of_roll(parts[2])) {
    parts[3] = "ROLL";
  } else if (parts.size() == 4) {
    parts[2] = is_word(parts[3], ResultWord::x) || is_word(parts[3], ResultWord::y) ? "ROLL" : "CONTACT";
  }
}

// The meaning with the same words in capitals as the row.
std::string without_names_of_case(std::string meaning, const std::vector<std::string> &from,
                                  const std::vector<std::string> &to)
{
  for (std::size_t i = 1; i < std::min(from.size(), to.size()); ++i)
    if (std::isupper((unsigned char)to[i][0]) && to[i].size() > 1 && from[i] != to[i])
      for (const auto &[before, after] :
           {std::pair{std::string(", "), std::string(", ")}, std::pair{std::string(" "), std::string(" ")}})
        meaning = replaced((before + meaning + after), before + from[i] + after, before + to[i] + after)
                      .substr(before.size()),
        meaning.resize(meaning.size() - after.size());
  return meaning;
}
}  // namespace

std::string row_of_output(const Run &run, const std::string &result)
{
  std::string name = result;
  for (const PassInfo &pass : run.manifest.passes)
    for (const std::string &word : {pass.name, pass.slug})
      if (!word.empty())
        name = replaced("." + name + ".", "." + word + ".", ".PASS.").substr(1), name.pop_back();
  std::vector<std::string> parts = parts_of(name);
  for (std::size_t i = 0; i < parts.size(); ++i)
    parts[i] = numbers_replaced(parts[i]);
  const std::string family = parts[0];
  if (family == family::mode || family == family::campbell)
    parts[1] = "MODE";
  if (family == family::open && parts.size() > 2 && parts[1] == family::mode)
    parts[2] = "MODE";
  if (family == curve::bearing.family && parts.size() > 2)
    parts[1] = "BEARING";
  if (family == family::frf && parts.size() > 3)
    parts[1] = "EXCITED", parts[2] = "PLACE";
  if (family == family::contact && parts.size() > 2 && is_of_stand(parts[1]))
    parts[1] = "upper/lower";
  if ((family == family::bite || family == family::chatter || family == family::cluster) && parts.size() > 2 &&
      parts[1] != bite_fit)
    parts[1] = "PASS";
  // bite.PASS.karman.force, bite.fit.residual.PASS.force; P, Q and F are quantities whose derivatives follow.
  if (family == family::bite && parts.size() > 3 && parts[1] == bite_fit)
    parts[3] = "PASS";
  else if (family == family::bite && parts.size() == 4 && parts[2].size() > 1)
    parts[2] = "MODEL";
  if (family == family::cluster)
    name_cluster_parts(parts);
  if ((family == family::pair || family == family::roll) && parts.size() > 2)
    parts[1] = family == family::pair ? "PAIR" : "ROLL";
  if (family == family::influence && parts.size() > 3)
    parts[2] = "ROLL";
  return result_name(parts);
}

std::string warning_reference()
{
  std::string text =
      "\n## Warnings\n\nA run warns of what its reader needs to know. `warning_records` of `results.json` has a "
      "record for each: `id`, `subject` (what it is about), `fact`, `detail` (what follows from it), `remedy`, "
      "`concerns` (names of results, or their first part), `key` and `place` (file, line, column) of the case. "
      "`warnings` has the same as one text each.\n\n| id | meaning |\n| --- | --- |\n";
  for (const WarningRow &row : warning_rows())
    text += std::string("| `") + row.word + "` | " + row.meaning + " |\n";
  return text;
}

std::string note_reference()
{
  std::string text =
      "\n## Notes\n\n`note_records` of `advice.json`, `calibration.json`, `plan.json` and `analysis.json` has the "
      "notes "
      "that decide something, in the form of a warning; `notes` has all of them as one text each. An id is one of "
      "these, or that of a warning.\n\n| id | meaning |\n| --- | --- |\n";
  for (const NoteRow &row : note_rows())
    if (row.id != NoteId::remark)
      text += std::string("| `") + row.word + "` | " + row.meaning + " |\n";
  return text;
}

std::string output_reference(const std::vector<Run> &runs)
{
  std::vector<OutputRow> rows;
  std::map<std::string, std::size_t> known;
  for (const Run &run : runs)
    for (const Result &result : run.results) {
      OutputRow row;
      row.name = row_of_output(run, result.name);
      if (!known.emplace(row.name, rows.size()).second)
        continue;
      row.meaning = meaning_of(result.name);
      row.meaning = without_names_of_case(row.meaning, parts_of(result.name), parts_of(row.name));
      row.unit    = is_in(result.unit, SiUnit::one) ? "-" : result.unit;
      read_source(result.source, row);
      rows.push_back(row);
    }
  std::string text =
      "# Results\n\nEvery name in `results.json`, printed by `tests/bench/output-reference` from the runs "
      "of `cases/`. Words in capitals and N stand for the names and numbers of a case: PASS, BEARING, "
      "MODE, MODEL, ROLL, PAIR, CONTACT, VARIANT, EXCITED, PLACE. A name that holds `.` or `/` has `%2E` or `%2F` "
      "in "
      "its "
      "place. Each result carries its value in SI units, source, "
      "load, error estimate, "
      "checks and the keys of the case that it depends on. The method is that of the first case that "
      "has the result; the equation is the one that its source cites.\n";
  const auto table = [&](const OutputGroup *group) {
    std::string body;
    for (const OutputRow &row : rows)
      if (group_of(row.name) == group)
        body += "| `" + cell(row.name) + "` | " + cell(row.meaning) + " | " + row.unit + " | " + cell(row.method) +
                " | " + row.equation + " |\n";
    if (body.empty())
      return;
    text += group ? std::string("\n## ") + group->title + "\n\nTheory: [" + group->chapter + "](theory/" +
                        group->chapter + ".md)\n"
                  : std::string("\n## Of each pass\n");
    text += "\n| name | meaning | unit | method | equation |\n| --- | --- | --- | --- | --- |\n" + body;
  };
  for (const OutputGroup &group : output_groups)
    table(&group);
  table(nullptr);
  return text + warning_reference() + note_reference();
}
}  // namespace mill::report
