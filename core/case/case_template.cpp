#include "core/case/case_template.h"
#include "core/base/units.h"
#include "core/case/embedded.h"
#include "core/case/input_reference.h"
#include "core/case/provenance.h"
#include <algorithm>
#include <fmt/format.h>

namespace mill {
namespace {
using Repeat = SectionRows::Repeat;

std::string header_of_template(const FilledSection &filled)
{
  if (!filled.note.header.empty())
    return filled.note.header;
  const SectionRows &section = *filled.section;
  return section.repeat == Repeat::list ? "[[" + section.name + "]]"
                                        : "[" + section.name + (section.repeat == Repeat::named ? ".NAME]" : "]");
}

bool is_drawing_value(const CaseKind &kind, const SectionRows &section, const Row &row)
{
  return std::any_of(kind.drawing.begin(), kind.drawing.end(),
                     [&](const DrawingValue &v) { return v.section == section.id() && v.key == row.key; });
}

std::string row_comment(const Row &row)
{
  const std::string limits = range_text(row);
  return (row.kind == Kind::choice ? row.form + "; " : "") + row.meaning + (limits.empty() ? "" : "; " + limits);
}

// The value a comment shows, set or not.
std::string shown_value(const FilledSection &filled, const Row &row)
{
  const auto entry    = filled.note.values.find(row.key);
  const auto &shown   = filled.note.shown;
  const bool is_shown = std::find(shown.begin(), shown.end(), row.key) != shown.end();
  if (entry != filled.note.values.end())
    return entry->second;
  if (row.fallback.kind != Fallback::Kind::required && !default_toml(row).empty() && !is_shown)
    return default_toml(row);
  return example_toml(row);
}

std::string commented(const std::string &text)
{
  std::string out;
  for (const std::string &line : split(text, "\n"))
    out += line.empty() ? "\n" : (line.rfind("# ", 0) == 0 ? "" : "# ") + line + "\n";
  out.pop_back();
  return out;
}

// "key = value  # meaning", a comment where the template sets nothing.
std::string plain_section(const CaseKind &kind, const FilledSection &filled)
{
  const SectionRows &section = *filled.section;
  std::string text =
      section.name.empty() ? "" : fmt::format("\n{}  # {}\n", header_of_template(filled), section.meaning);
  for (const Row &row : section.rows)
    if (!is_tolerance(row.key))  // optional, and as many as there are values
      text += fmt::format("{}{} = {}  # {}\n", template_value(kind, filled, row) ? "" : "# ", row.key,
                          shown_value(filled, row), row_comment(row));
  return filled.note.off ? commented(text) : text;
}

// Part one: what a drawing says, in the order in which one reads it.
std::string drawing_part(const CaseKind &kind, const std::vector<FilledSection> &sections)
{
  std::string text;
  std::vector<std::string> done;
  for (const DrawingValue &first : kind.drawing) {
    if (std::find(done.begin(), done.end(), first.section) != done.end())
      continue;
    done.push_back(first.section);
    for (const FilledSection &filled : sections) {
      if (filled.section->id() != first.section || filled.note.off)
        continue;
      text += fmt::format("\n{}  # {}\n", header_of_template(filled), filled.section->meaning);
      const auto line = [&](const Row &row, const std::string &comment, const bool always) {
        const auto value = template_value(kind, filled, row);
        if (value || always)
          text += fmt::format("{}{} = {}  # {}\n", value ? "" : "# ", row.key,
                              value ? *value : shown_value(filled, row), comment);
      };
      for (const DrawingValue &value : kind.drawing)
        if (value.section == first.section)
          for (const Row &row : filled.section->rows)
            if (row.key == value.key)
              line(row, value.where, true);
      for (const Row &row : filled.section->rows)  // set by the note, in addition to the drawing
        if (!is_drawing_value(kind, *filled.section, row))
          line(row, row_comment(row), false);
    }
  }
  return text;
}

// Part two: every other key as a comment, under the header of its section.
std::string expert_part(const CaseKind &kind, const std::vector<FilledSection> &sections)
{
  std::string text;
  std::vector<std::string> done;
  for (const FilledSection &filled : sections) {
    const SectionRows &section = *filled.section;
    if (section.name.empty() || std::find(done.begin(), done.end(), section.id()) != done.end())
      continue;
    done.push_back(section.id());
    const bool above  = std::any_of(kind.drawing.begin(), kind.drawing.end(),
                                    [&](const DrawingValue &v) { return v.section == section.id(); });
    FilledSection any = filled;
    any.note          = {};
    std::string keys;
    for (const Row &row : section.rows)
      if (!is_tolerance(row.key) && !is_drawing_value(kind, section, row))
        keys += fmt::format("# {} = {}  # {}\n", row.key, shown_value(any, row), row_comment(row));
    if (!keys.empty())
      text += fmt::format("\n# {}  # {}{}\n{}", header_of_template(above ? any : filled),
                          above ? "more keys of the section above: " : "", section.meaning, keys);
  }
  return text;
}

std::string canonical(const std::string &toml)
{
  const bool in_quotes        = toml.size() > 1 && toml.front() == '"';
  const std::string text      = in_quotes ? toml.substr(1, toml.size() - 2) : toml;
  const ParsedQuantity parsed = parse_quantity(text);
  if (parsed.fault == ParsedQuantity::Fault::none)
    return number_text(parsed.value()) + " " + parsed.unit->quantity;
  double number = 0;
  return parse_number(text, number) ? number_text(number) : toml;
}

bool is_number(const Row &row)
{
  return row.kind == Kind::quantity || row.kind == Kind::number || row.kind == Kind::count ||
         row.kind == Kind::pair || row.kind == Kind::table;
}

// "bearing.trb.bore" -> "bearing", "bore"; a section of one name keeps it.
bool belongs_to(const std::string &full, const SectionRows &section, const std::string &key)
{
  if (section.repeat == Repeat::once)
    return full == section.name + "." + key;
  const std::string begin = section.name + ".", end = "." + key;
  return full.size() > begin.size() + end.size() && full.rfind(begin, 0) == 0 &&
         full.compare(full.size() - end.size(), end.size(), end) == 0;
}

bool is_confirmed(const std::string &key, const KeyList &confirmed)
{
  return std::any_of(confirmed.begin(), confirmed.end(), [&](const std::string &word) {
    return word == "all" || key == word || key.rfind(word + ".", 0) == 0;
  });
}

// A key, a section or the beginning of one: "strip", "bearing.trb", "pass.0.force".
bool names_a_key(const std::string &word, const CaseKind &kind)
{
  if (word == "all")
    return true;
  const auto below = [](const std::string &path, const std::string &head) {
    return path.compare(0, head.size() + 1, head + ".") == 0;
  };
  return std::any_of(kind.sections.begin(), kind.sections.end(), [&](const SectionRows &section) {
    const auto &all = kind.sections;  // [[roll]] has sections of its own: the number stands in their names
    if (section.repeat == Repeat::list && below(word, section.name) &&
        std::any_of(all.begin(), all.end(), [&](const SectionRows &s) { return below(s.name, section.name); }))
      return true;
    const bool one_of_several = section.repeat != Repeat::once && below(word, section.name) &&
                                word.find('.', section.name.size() + 1) == std::string::npos;
    return word == section.name || one_of_several || below(section.name, word) ||
           std::any_of(section.rows.begin(), section.rows.end(),
                       [&](const Row &row) { return belongs_to(word, section, row.key); });
  });
}
}  // namespace

std::vector<FilledSection> filled_sections(const CaseKind &kind)
{
  std::vector<FilledSection> all;
  for (const SectionRows &section : kind.sections) {
    const std::size_t before = all.size();
    for (const TemplateNote &note : kind.notes)
      if (note.section == section.id())
        all.push_back({&section, note});
    if (all.size() == before)
      all.push_back({&section, {}});
    if (section.name.empty())
      all.back().note.values = {{"kind", quoted(kind.name)}, {"title", quoted(kind.title)}};
  }
  return all;
}

std::optional<std::string> template_value(const CaseKind &kind, const FilledSection &filled, const Row &row)
{
  const TemplateNote &note = filled.note;
  const bool has_value     = note.values.count(row.key) > 0 ||
                         std::find(note.shown.begin(), note.shown.end(), row.key) != note.shown.end();
  const bool stands_below = !kind.drawing.empty() && !filled.section->name.empty() &&
                            !is_drawing_value(kind, *filled.section, row);  // among the experts' keys
  if (!has_value && note.values.count("designation") > 0)
    return {};  // which says it
  if (!has_value && (stands_below || row.fallback.kind == Fallback::Kind::absent))
    return {};
  if (!has_value && !kind.drawing.empty() && row.fallback.kind != Fallback::Kind::required)
    return {};
  return shown_value(filled, row);
}

std::string template_text(const CaseKind &kind, const std::vector<FilledSection> &sections)
{
  std::string text = fmt::format(
      "#:schema ./millstand.schema.json\n# A case of kind \"{}\" that runs as it is.  Quantities are "
      "texts with a unit.  Editors that know the line above\n# check keys while you type: millstand schema > "
      "millstand.schema.json\n",
      kind.name);
  if (kind.drawing.empty()) {
    text += "\n";
    for (const FilledSection &filled : sections)
      text += plain_section(kind, filled);
    return text;
  }
  text += "#\n# Part 1: replace the values below by those of your drawings; they are of the demo stand.  The run "
          "lists "
          "what is\n# still a value of this template; name in confirmed what is meant to be.\n\n";
  for (const FilledSection &filled : sections)
    if (filled.section->name.empty())
      text += plain_section(kind, filled);
  return text + drawing_part(kind, sections) +
         "\n# Part 2: keys for experts, all with a default or optional.  Take a line without its # up into its "
         "section;\n# a section that does not stand above may be opened here.\n" +
         expert_part(kind, sections);
}

std::string where_to_find(const std::string &section, const std::string &key)
{
  for (const CaseKind *kind : all_kinds())
    for (const DrawingValue &value : kind->drawing)
      if (value.section == section && value.key == key)
        return value.where;
  return "";
}

std::vector<std::string> left_at_template(const CaseKind &kind, const std::map<std::string, std::string> &written,
                                          const std::string &confirmed)
{
  std::vector<std::string> left;
  if (kind.drawing.empty())
    return left;
  const KeyList known = words_of(confirmed);
  for (const FilledSection &filled : filled_sections(kind))
    for (const Row &row : filled.section->rows) {
      const auto value =
          filled.note.off || filled.section->name.empty() ? std::nullopt : template_value(kind, filled, row);
      if (!value || !is_number(row) || canonical(*value) == canonical(default_toml(row)))
        continue;
      for (const auto &[key, own] : written)
        if (belongs_to(key, *filled.section, row.key) && canonical(own) == canonical(*value) &&
            !is_confirmed(key, known) && !holds(left, key))
          left.push_back(key);
    }
  return left;
}

std::string unknown_in_confirmed(const CaseKind &kind, const std::string &confirmed)
{
  std::vector<std::string> names;
  for (const SectionRows &section : kind.sections) {
    names.push_back(section.name);
    if (section.repeat == Repeat::once)
      for (const Row &row : section.rows)
        names.push_back(section.name + "." + row.key);
  }
  for (const std::string &word : words_of(confirmed))
    if (!names_a_key(word, kind))
      return fmt::format("names '{}', which is neither a key nor a section{}", word, meant_word(word, names));
  return "";
}

namespace {
// Templates of a kind that has several: written out, since their sections differ.
constexpr std::pair<const char *, const char *const *> stack_templates[] = {
    {"stack-2", &embedded::stack_two_high},
    {"stack-4", &embedded::stack_four_high},
    {"stack-6", &embedded::stack_six_high},
    {"stack-20", &embedded::stack_twenty_high}};
}  // namespace

std::vector<std::string> template_names()
{
  std::vector<std::string> names = case_kinds();
  for (const auto &[name, text] : stack_templates)
    names.push_back(name);
  return names;
}

std::string template_of(const std::string &kind)
{
  for (const auto &[name, text] : stack_templates)
    if (kind == name)
      return *text;
  const auto &kinds = case_kinds();
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
    throw InputError(
        fmt::format("no template is available for the kind '{}'{}", kind, suggestion(kind, template_names())));
  return template_text(kind_named(kind), filled_sections(kind_named(kind)));
}
}  // namespace mill
