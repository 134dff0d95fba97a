#include "app/trace/trace_key.h"
#include "app/run/run_kind.h"
#include "app/trace/closed_form_chain.h"
#include "core/base/name_part.h"
#include "core/base/units.h"
#include "core/case/kinds.h"
#include "core/case/old_keys.h"
#include "core/case/resolved_sections.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <sstream>

namespace mill {
namespace {
const Node *at_path(const Node &root, const std::vector<std::string> &parts)
{
  const Node *node = &root;
  for (const std::string &part : parts) {
    if (node->kind == Node::Kind::array) {
      const std::size_t index = std::size_t(std::stoi(part));
      if (index >= node->items.size())
        return nullptr;
      node = &node->items[index];
    } else {
      const Node::Entry *entry = node->find(part);
      if (!entry)
        return nullptr;
      node = &entry->value;
    }
  }
  return node;
}

// Parts of a path whose quoted names may hold dots.
std::vector<std::string> path_parts(const std::string &path)
{
  std::vector<std::string> parts(1);
  bool inside = false;
  for (const char c : path)
    if (c == '"')
      inside = !inside;
    else if (c == '.' && !inside)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

std::optional<StandIn> stand_in(const Case &the_case, const TraceKey &key,
                                const std::vector<ClosedFormResult> &closed)
{
  const auto of_kind = run_kind(the_case).stand_in;
  return of_kind ? of_kind(the_case, key, closed) : std::nullopt;
}

// The case file with the present names of its keys.
Node present_tree(const std::string &path, const std::vector<std::string> &sets)
{
  Node root = read_case_file(path, sets);
  Reading warnings_not_needed;
  accept_old_keys(root, warnings_not_needed);
  return root;
}
}  // namespace

std::optional<std::size_t> pass_of(const TraceKey &key)
{
  const auto parts = path_parts(key.path);
  return parts[0] == "pass" ? std::optional<std::size_t>(std::stoi(parts[1])) : std::nullopt;
}

std::optional<StandIn> computed_instead(const std::vector<ClosedFormResult> &closed, const std::string &name)
{
  const ClosedFormResult *result = find(closed, name);
  if (!result || std::isnan(result->parameter.value))
    return {};
  return StandIn{result->parameter.value, "not given: computed"};
}

std::optional<StandIn> strip_instead(const Strip &strip, const TraceKey &key)
{
  const std::pair<const char *, double Strip::*> members[] = {{"entry_thickness", &Strip::entry_thickness},
                                                              {"exit_thickness", &Strip::exit_thickness},
                                                              {"entry_tension", &Strip::entry_tension},
                                                              {"exit_tension", &Strip::exit_tension}};
  for (const auto &[name, member] : members)
    if (key.row.key == name)
      return StandIn{strip.*member, "not given: that of [strip]"};
  return {};
}

std::map<std::string, std::string> resolved_values(const std::string &text)
{
  std::map<std::string, std::string> values;
  std::istringstream lines(text);
  std::string section, line;
  ResolvedSections sections;
  while (std::getline(lines, line)) {
    if (!line.empty() && line[0] == '[') {
      section = sections.prefix(line);
    } else if (const auto equals = line.find(" = "); equals != std::string::npos && line[0] != '#') {
      std::string value = line.substr(equals + 3);
      if (const auto mark = value.rfind("  # default"); mark != std::string::npos)
        value.erase(mark);
      values[section + line.substr(0, equals)] = value;
    }
  }
  return values;
}

namespace {
// "roll" for "roll.saddles", where there are several [[roll]], each with its own; "" for a section of the case.
std::string list_around(const std::string &kind, const std::string &name)
{
  const std::string head = name.substr(0, name.find('.'));
  for (const SectionRows &section : sections_of(kind))
    if (section.repeat == SectionRows::Repeat::list && section.name == head && head != name)
      return head;
  return "";
}
}  // namespace

std::vector<TraceKey> keys_of(const Case &the_case)
{
  std::vector<TraceKey> keys;
  const auto add = [&](const std::string &section, const std::string &path, const std::vector<Row> &rows) {
    for (const Row &row : rows) {
      TraceKey key;
      key.name = section.empty() ? row.key : section + "." + row.key;
      key.path = path.empty() ? row.key : path + "." + row.key;
      key.row  = row;
      keys.push_back(key);
    }
  };
  for (const SectionRows &section : sections_of(the_case.kind)) {
    if (section.repeat == SectionRows::Repeat::named) {
      for (const std::string &name : repeated_sections(the_case, section.id()))
        add(section.name + "." + name, section.name + "." + key_text(with_plain_names(name)), section.rows);
    } else if (section.repeat == SectionRows::Repeat::list) {
      for (const std::string &number : repeated_sections(the_case, section.name))
        add(section.name + "." + number, section.name + "." + number, section.rows);
    } else if (const std::string list = list_around(the_case.kind, section.name); !list.empty()) {
      for (const std::string &number : repeated_sections(the_case, section.name)) {
        const std::string one = list + "." + number + section.name.substr(list.size());
        add(one, one, section.rows);
      }
    } else {
      add(section.name, section.name, section.rows);
    }
  }
  return keys;
}

TraceKey find_key(const Case &the_case, const std::vector<std::string> &sets, const std::string &name,
                  const std::vector<ClosedFormResult> &closed)
{
  const auto keys  = keys_of(the_case);
  const auto match = std::find_if(keys.begin(), keys.end(), [&](const TraceKey &key) {
    return key.name == name || with_plain_names(key.name) == name || with_plain_names(key.path) == name;
  });
  if (match == keys.end()) {
    // Within a section its keys are compared; a list of some two hundred would not help.
    const auto dot            = name.rfind('.');
    const std::string section = dot == std::string::npos ? "" : name.substr(0, dot + 1);
    std::vector<std::string> all, leaves;
    for (const TraceKey &known : keys) {
      all.push_back(known.name);
      if (known.name.rfind(section, 0) == 0 && known.name.find('.', section.size()) == std::string::npos)
        leaves.push_back(known.name.substr(section.size()));
    }
    const bool inside      = dot != std::string::npos && !leaves.empty();
    const std::string leaf = inside ? name.substr(section.size()) : name;
    const std::string near = likely_word(leaf, inside ? leaves : all);
    const std::string hint = !near.empty() ? fmt::format("; did you mean '{}{}'?", inside ? section : "", near)
                             : inside      ? suggestion(leaf, leaves)
                                           : "; docs/input.md lists the keys of kind \"" + the_case.kind + "\"";
    throw InputError("unknown key '" + name + "' in " + the_case.path + hint);
  }
  TraceKey key     = *match;
  const auto parts = path_parts(key.path);
  const Node root  = present_tree(the_case.path, sets);
  if (const auto place = the_case.places.find(key.name); place != the_case.places.end()) {
    const Node *node = at_path(root, parts);
    if (node && node->kind == Node::Kind::table && node->find("value"))
      node = &node->find("value")->value;
    if (node)
      key.value = *node;
    key.origin =
        place->second.line > 0 ? fmt::format("{}:{}", place->second.file, place->second.line) : place->second.file;
  } else {
    const auto resolved = resolved_values(the_case.resolved);
    const auto standard = resolved.find(key.name);
    std::string toml    = standard == resolved.end() ? "" : standard->second;
    double instead_of   = not_given;
    key.origin          = "default";
    if (toml.empty())
      if (const auto instead = stand_in(the_case, key, closed)) {
        toml       = key.row.kind == Kind::number ? number_text(instead->value)
                                                  : quoted(quantity_text(instead->value, unit(key.row.form)));
        key.origin = instead->origin;
        instead_of = key.row.kind == Kind::number ? instead->value : from_si(instead->value, unit(key.row.form));
      }
    if (!toml.empty()) {
      auto with = sets;
      with.push_back(key.path + "=" + toml);
      const Node other = present_tree(the_case.path, with);
      if (const Node *node = at_path(other, parts))
        key.value = *node;
    }
    key.stands_in = !std::isnan(instead_of);
    if (key.value && key.stands_in) {
      key.shown = fmt::format("{:.6g} {}", instead_of, unit_written(*key.value));
      return key;
    }
  }
  if (!key.value) {
    key.shown  = "not given";
    key.origin = key.row.meaning;
    return key;
  }
  key.shown = key.value->kind == Node::Kind::text && key.row.kind != Kind::text && key.row.kind != Kind::path
                  ? key.value->text
                  : mill::shown(*key.value);
  return key;
}

std::string changed_toml(const Node &value, const std::function<double(double)> &change)
{
  if (value.kind == Node::Kind::array) {
    std::string list;
    for (const Node &item : value.items)
      list += (list.empty() ? "" : ", ") + changed_toml(item, change);
    return "[" + list + "]";
  }
  if (value.kind != Node::Kind::text)
    return number_text(change(value.number));
  const ParsedQuantity quantity = parse_quantity(value.text);
  return quoted(number_text(change(quantity.number)) + " " + quantity.unit->symbol);
}

double first_number(const Node &value)
{
  if (value.kind == Node::Kind::array)
    return value.items.empty() ? 0 : first_number(value.items.front());
  return value.kind == Node::Kind::text ? parse_quantity(value.text).number : value.number;
}

std::string unit_written(const Node &value)
{
  if (value.kind == Node::Kind::array)
    return value.items.empty() ? "" : unit_written(value.items.front());
  if (value.kind != Node::Kind::text)
    return "";
  const ParsedQuantity quantity = parse_quantity(value.text);
  return quantity.unit ? quantity.unit->symbol : "";
}
}  // namespace mill
