#include "core/case/input_reference.h"
#include "core/base/errors.h"
#include "core/base/units.h"
#include "core/case/case_template.h"
#include "core/case/kinds.h"
#include "core/case/record_set_rows.h"
#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <utility>
#include <vector>

namespace mill {
namespace {
using Repeat = SectionRows::Repeat;

std::string form_text(const Row &row)
{
  switch (row.kind) {
  case Kind::quantity:
    return row.form;
  case Kind::number:
    return "number";
  case Kind::count:
    return "whole number";
  case Kind::flag:
    return "true, false";
  case Kind::choice:
    return row.form;
  case Kind::text:
    return "text";
  case Kind::path:
    return "path";
  case Kind::pair:
    return "pair, " + row.form;
  case Kind::table:
    return "pairs, " + row.form;
  case Kind::six:
    return "six, " + row.form;
  case Kind::list:
    return "one or a list, " + row.form;
  case Kind::triples:
    return "threes, " + row.form;
  case Kind::words:
    return row.form == "names" ? "table of texts" : "list, " + row.form;
  }
  return "";
}

std::string default_text(const Row &row)
{
  if (row.fallback.kind == Fallback::Kind::required)
    return "required";
  return row.fallback.kind == Fallback::Kind::absent ? "-" : default_toml(row);
}

// In a table of markdown a bar would end the cell.
std::string cell(std::string text)
{
  for (std::size_t bar = 0; (bar = text.find('|', bar)) != std::string::npos; bar += 2)
    text.insert(bar, "\\");
  return text;
}

std::string header_of(const SectionRows &section)
{
  if (section.name.empty())
    return "top of the file";
  if (section.repeat == Repeat::list)
    return "[[" + section.name + "]]";
  return "[" + section.name + (section.repeat == Repeat::named ? ".NAME]" : "]");
}

std::string rows_reference(const SectionRows &section)
{
  std::string text = "| key | form | range | default | example | meaning |\n|---|---|---|---|---|---|\n";
  for (const Row &row : section.rows) {
    const std::string limits = range_text(row);
    const std::string where  = where_to_find(section.id(), row.key);
    text += fmt::format("| `{}` | {} | {} | {} | `{}` | {}{} |\n", row.key, cell(form_text(row)),
                        limits.empty() ? "-" : limits, default_text(row), cell(example_toml(row)), row.meaning,
                        where.empty() ? "" : "; where to find it: " + where);
  }
  return text;
}

// The same rows under the same header, with the kinds that read them and what each says of them.
struct SectionEntry {
  std::string header, rows;
  std::vector<std::pair<std::string, std::string>> readers;  // ": the strip in the bite" and "`four-high`, `bite`"
};

void add_reader(SectionEntry &entry, const std::string &kind, const SectionRows &section)
{
  const std::string about = fmt::format("{}: {}.", section.needed ? "" : ", may be left out", section.meaning);
  const auto known        = std::find_if(entry.readers.begin(), entry.readers.end(),
                                         [&](const auto &reader) { return reader.first == about; });
  if (known == entry.readers.end())
    entry.readers.emplace_back(about, "`" + kind + "`");
  else
    known->second += ", `" + kind + "`";
}

// Every section once, in the order in which the kinds come to it; rows of one header stand together.
std::vector<SectionEntry> section_entries()
{
  std::vector<SectionEntry> all;
  for (const CaseKind *kind : all_kinds())
    for (const SectionRows &section : kind->sections) {
      const std::string header = header_of(section), rows = rows_reference(section);
      auto place = all.end();  // behind the last of this header
      for (auto entry = all.begin(); entry != all.end(); ++entry)
        if (entry->header == header) {
          place = entry + 1;
          if (entry->rows == rows)
            break;
        }
      const bool known =
          place != all.begin() && !all.empty() && (place - 1)->header == header && (place - 1)->rows == rows;
      if (!known)
        place = all.insert(place, SectionEntry{header, rows, {}}) + 1;
      add_reader(*(place - 1), kind->name, section);
    }
  return all;
}

std::string section_references()
{
  std::string text, last;
  for (const SectionEntry &entry : section_entries()) {
    if (entry.header != last)
      text += "\n### `" + entry.header + "`\n";
    last = entry.header;
    for (const auto &[about, kinds] : entry.readers)
      text += "\n" + kinds + about + "\n";
    text += "\n" + entry.rows;
  }
  return text;
}

std::string kind_references()
{
  std::string text =
      "\n## Kinds of case\n\nSections in parentheses may be left out.\n\n| kind | sections |\n|---|---|\n";
  for (const CaseKind *kind : all_kinds()) {
    std::string list;
    for (const SectionRows &section : kind->sections)
      if (!section.name.empty() && section.type.empty())
        list += (list.empty() ? "" : ", ") + fmt::format(section.needed ? "`{}`" : "(`{}`)", header_of(section));
    text += fmt::format("| `{}` | {} |\n", kind->name, list);
  }
  return text;
}

// Another file than a case: it lies in a folder of records.
std::string record_set_reference()
{
  std::string text =
      "\n## Records of a calibration\n\n`records.toml` in the folder of `millstand calibrate --measured "
      "DIR`. Without this file all records of the\nfolder are used.\n";
  for (const SectionRows &section : record_set_sections())
    text += "\n### `" + header_of(section) + "` of records.toml\n\n" + section.meaning + ".\n\n" +
            rows_reference(section);
  return text;
}
}  // namespace

std::string input_reference()
{
  std::string text =
      "# Input reference\n\n"
      "Printed by the program from the rows that also read the case file (`core/case/stand_rows.cpp`,\n"
      "`core/case/kinds`); a test compares this page with them.\n\n"
      "A case is a TOML file. Every value with a unit is a text, `\"1450 mm\"`; whole and pure numbers are\n"
      "bare. Any unit of the right dimension may be used; both ends of a range are allowed. Paths start at the\n"
      "folder of the case file. An unknown key is an error.\n\n"
      "## Units\n\n| quantity | units |\n|---|---|\n";
  std::map<std::string, bool> seen;
  for (const Unit &u : all_units()) {
    std::string symbols;
    if (seen[u.quantity])
      continue;
    seen[u.quantity] = true;
    for (const Unit &other : all_units())
      if (std::string(other.quantity) == u.quantity)
        symbols += (symbols.empty() ? "`" : ", `") + std::string(other.symbol) + "`";
    text += fmt::format("| {} | {} |\n", u.quantity, symbols);
  }
  text +=
      "\n`N.s/m`, `N*s/m` and `N s/m` are the same unit, the micro sign is read as `u`, and `g` is the standard\n"
      "acceleration of free fall, 9.80665 m/s2.\n";
  text += kind_references() + "\n## Sections\n" + section_references() + record_set_reference();
  return text +
         "\nA key `..._tolerance` of `[frame]` or `[given]` becomes the error estimate of its value and of what "
         "follows\n"
         "from it; without it such results state no error and say which key they lack.\n"
         "\nA value of `[given]` or `[published]` is a quantity or a table that keeps where it comes from:\n"
         "`K3 = { value = \"4.02e10 N/m\", source = \"computed: contact FEM\", at = \"976.2 kN\", "
         "error_estimate = 0.01,\n"
         "inputs = [\"work_roll.barrel_diameter\"] }`. `source` is `given`, `published`, `measured`, "
         "`assumed` or `computed`,\n"
         "the last two followed by a colon and the reason or method; `method` may be written separately. A value "
         "that\n"
         "`millstand calibrate` found has `source = \"calibrated: ..\"` and `interval = [\"..\", \"..\"]`, the 95 "
         "% "
         "interval.\n";
}
}  // namespace mill
