#include "core/base/require.h"
#include "core/base/valid_text.h"
#include "core/case/case_template.h"
#include "core/case/kinds.h"
#include "core/case/mend_names.h"
#include "core/case/old_keys.h"
#include "core/case/stand_reader.h"
#include "core/case/user_names.h"
#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <utility>

namespace mill {
namespace {
// Without a known schema and kind nothing else in the file can be judged, so these throw at once.
CaseHead read_head(const Section &top, Reading &reading)
{
  CaseHead head;
  const std::size_t n_before = reading.problems.size();
  for (const Field<CaseHead> &field : head_rows())
    if (const auto value = read_row(row_of(field), top, reading))
      set_member(field, *value, head);
  if (reading.usable({"schema"}) && head.schema != 1)
    reading.add(
        reading.place("schema"),
        fmt::format("{} belongs to another version of the file format; this version reads schema = 1, whose "
                    "keys millstand schema prints",
                    reading.as_written("schema")));
  const auto &kinds = case_kinds();
  if (reading.usable({"kind"}) && std::find(kinds.begin(), kinds.end(), head.kind) == kinds.end())
    reading.add(reading.place("kind"),
                fmt::format("{} is unknown{}", reading.as_written("kind"), suggestion(head.kind, kinds)));
  if (reading.problems.size() > n_before)
    throw InputError(std::move(reading.problems));
  return head;
}

// First parts of the section names: what may stand at the top level of this kind.
std::vector<std::string> top_names(const std::string &kind)
{
  std::vector<std::string> names;
  for (const SectionRows &section : sections_of(kind)) {
    const std::string first = section.name.substr(0, section.name.find('.'));
    if (!first.empty() && std::find(names.begin(), names.end(), first) == names.end())
      names.push_back(first);
  }
  return names;
}
}  // namespace

Section section_at(const Node &root, const std::string &name, Reading &reading)
{
  const Node *node = &root;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end    = std::min(name.find('.', begin), name.size());
    const Node::Entry *entry = node->find(name.substr(begin, end - begin));
    if (!entry)
      return {nullptr, name};
    if (entry->value.kind != Node::Kind::table) {
      reading.add(entry->value.place,
                  fmt::format("{} = {} is a value; a section [{}] is needed", name, shown(entry->value), name));
      return {nullptr, name, true};
    }
    node  = &entry->value;
    begin = end + 1;
  }
  return {node, name};
}

const RollerBearing &bearing_of(const std::vector<RollerBearing> &bearings, const std::string &name)
{
  const auto match = std::find_if(bearings.begin(), bearings.end(),
                                  [&](const RollerBearing &bearing) { return bearing.name == name; });
  require(match != bearings.end(), "unknown bearing " + name);  // the reader has checked every name
  return *match;
}

const OilFilmBearing *oil_film_of(const std::vector<OilFilmBearing> &bearings, const std::string &name)
{
  const auto match = std::find_if(bearings.begin(), bearings.end(),
                                  [&](const OilFilmBearing &bearing) { return bearing.name == name; });
  return match == bearings.end() ? nullptr : &*match;
}

namespace {
// One equal number is chance, several are a template that was not filled in.
void add_template_warning(const std::vector<std::string> &left, Reading &reading)
{
  constexpr std::size_t no_chance = 3, most_named = 12;
  if (left.size() < no_chance)
    return;
  std::string keys;
  for (std::size_t i = 0; i < std::min(left.size(), most_named); ++i)
    keys += (i ? ", " : "") + left[i];
  if (left.size() > most_named)
    keys += fmt::format(" and {} more", left.size() - most_named);
  Warning warning{WarningId::template_values, "",
                  fmt::format("{} values are still those of the template", left.size()), keys,
                  "replace them, or name those that are meant in confirmed = \"...\""};
  warning.place = Place{reading.file};
  reading.warnings.push_back(std::move(warning));
}
}  // namespace

namespace {
Case case_of(Node root, const std::string &path)
{
  const std::filesystem::path file   = path;
  const std::filesystem::path folder = file.parent_path();
  Reading reading;
  reading.file   = path;
  reading.folder = folder.empty() ? "." : folder.string();

  Case result;
  const Section top{&root, ""};
  mend_head(root, reading);
  const CaseHead head = read_head(top, reading);
  result.path         = path;
  result.name         = valid_text(file.stem().string());
  result.kind         = head.kind;
  result.title        = head.title;
  accept_old_keys(root, reading);
  make_names_parts(root);
  mend_names(root, head.kind, reading);
  refuse_unknown_keys(top, rows_of(head_rows()), top_names(head.kind), reading);
  reading.echo = resolved_lines("", head_rows(), head, reading);

  if (const std::string wrong = unknown_in_confirmed(kind_named(head.kind), head.confirmed); !wrong.empty())
    reading.add(reading.place("confirmed"), reading.as_written("confirmed") + " " + wrong);
  result.spec = kind_named(head.kind).read(root, reading);
  if (!reading.problems.empty())
    throw InputError(std::move(reading.problems));
  result.left_at_template = left_at_template(kind_named(head.kind), reading.written, head.confirmed);
  add_template_warning(result.left_at_template, reading);
  result.warnings = std::move(reading.warnings);
  result.resolved = std::move(reading.echo);
  result.places   = std::move(reading.places);
  return result;
}
}  // namespace

Case read_case(const std::string &path, const std::vector<std::string> &sets)
{
  return case_of(read_case_file(path, sets), path);
}

Case read_case_of(const std::string &path, const std::string &text, const std::vector<std::string> &sets)
{
  return case_of(read_case_text(path, text, sets), path);
}
}  // namespace mill
