// The only file that includes toml++.
#include "core/case_file.h"
#include "core/files.h"
#include "core/units.h"
#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <sstream>
#define TOML_HEADER_ONLY 1
#include <toml++/toml.h>

namespace mill
{
namespace
{
Place place_of(const toml::source_region &region, const std::string &file)
{
  return {file, int(region.begin.line), int(region.begin.column)};
}

Node node_of(const toml::node &toml, const std::string &file)
{
  Node node;
  node.place = place_of(toml.source(), file);
  if (const auto *table = toml.as_table()) {
    node.section = !table->is_inline();
    for (auto &&[key, value] : *table)
      node.entries.push_back({std::string(key.str()), place_of(key.source(), file), node_of(value, file)});
    // toml++ iterates in alphabetical order; the reader of an error or of an echo expects the order of the file
    std::stable_sort(node.entries.begin(), node.entries.end(),
                     [](const auto &a, const auto &b) { return a.key_place < b.key_place; });
  } else if (const auto *array = toml.as_array()) {
    node.kind = Node::Kind::array;
    for (const toml::node &item : *array)
      node.items.push_back(node_of(item, file));
    node.section = !node.items.empty() && node.items.front().section;
  } else if (const auto *text = toml.as_string()) {
    node.kind = Node::Kind::text;
    node.text = text->get();
  } else if (const auto *integer = toml.as_integer()) {
    node.kind   = Node::Kind::integer;
    node.number = double(integer->get());
  } else if (const auto *real = toml.as_floating_point()) {
    node.kind   = Node::Kind::real;
    node.number = real->get();
  } else if (const auto *flag = toml.as_boolean()) {
    node.kind = Node::Kind::flag;
    node.flag = flag->get();
  } else {
    node.kind = Node::Kind::other;  // dates and times, which no key wants
  }
  return node;
}

std::string line_of(const std::string &text, const int number)
{
  std::istringstream lines(text);
  std::string line;
  for (int i = 0; i < number && std::getline(lines, line); ++i)
    ;
  return line;
}

// "key = 1450 mm": the commonest slip.  Column of the value and the repaired line, or nothing.
struct Unquoted {
  int column = 0;
  std::string key, value;
};
Unquoted unquoted_quantity(const std::string &line)
{
  const auto equals = line.find('=');
  if (equals == std::string::npos || line.find('"') < equals)
    return {};
  const auto begin   = std::min(line.find_first_not_of(" \t", equals + 1), line.size());
  const auto comment = std::min(line.find('#', begin), line.size());
  std::string value  = line.substr(begin, comment - begin);
  value.erase(value.find_last_not_of(" \t\r") + 1);
  const ParsedQuantity parsed = parse_quantity(value);
  if (parsed.fault != ParsedQuantity::Fault::none)
    return {};
  std::string key = line.substr(0, equals);
  key.erase(key.find_last_not_of(" \t") + 1);
  key.erase(0, std::min(key.find_first_not_of(" \t"), key.size()));
  return {int(begin) + 1, key, value};  // a key and a number are ASCII: bytes are characters up to here
}

// Line above `line` in the same section where a bare key stands first; 0 when not found.
int first_line_of(const std::string &text, const std::string &key, const int line)
{
  std::istringstream lines(text);
  std::string current;
  int found = 0;
  for (int number = 1; number < line && std::getline(lines, current); ++number) {
    const auto begin = std::min(current.find_first_not_of(" \t"), current.size());
    if (begin < current.size() && current[begin] == '[')
      found = 0;
    const auto end = current.find_first_of(" \t=", begin);
    if (end != std::string::npos && current.compare(begin, end - begin, key) == 0)
      found = number;
  }
  return found;
}

Problem problem_of(const toml::parse_error &error, const std::string &file, const std::string &text)
{
  Place place                   = place_of(error.source(), file);
  const std::string description = std::string(error.description());
  if (const Unquoted slip = unquoted_quantity(line_of(text, place.line)); slip.column > 0)
    return {{file, place.line, slip.column},
            fmt::format("a value with a unit is written in quotes: {} = \"{}\"", slip.key, slip.value),
            {}};
  const std::string redefined = "cannot redefine existing ";
  if (const auto at = description.find(redefined); at != std::string::npos) {
    const auto open       = description.find('\'', at);
    const auto close      = description.rfind('\'');
    const std::string key = open < close ? description.substr(open + 1, close - open - 1) : "";
    if (const auto begin = line_of(text, place.line).find(key); begin != std::string::npos)
      place.column = int(begin) + 1;
    Problem problem{place, fmt::format("'{}' stands twice; remove one of the two", key), {}};
    if (const int first = first_line_of(text, key, place.line))
      problem.related.push_back({file, first, 1});
    return problem;
  }
  return {place, fmt::format("this is not TOML: {}", description), {}};
}

toml::table parsed(const std::string &path, const std::string &text)
{
  try {
    return toml::parse(text, path);
  } catch (const toml::parse_error &error) {
    throw InputError(std::vector<Problem>{problem_of(error, path, text)});
  }
}

// TOML where it is TOML, text where it is not: 'modal_damping=2 %' needs no quotes on a command line.
Node override_value(const std::string &text, const Place &place)
{
  try {
    const toml::table table = toml::parse("v = " + text);
    if (table.size() == 1)
      return node_of(*table.get("v"), place.file);
  } catch (const toml::parse_error &) {
    // not TOML, hence text
  }
  Node node;
  node.kind = Node::Kind::text;
  node.text = text;
  return node;
}

void set_place(Node &node, const Place &place)
{
  node.place   = place;
  node.section = false;
  for (Node::Entry &entry : node.entries) {
    entry.key_place = place;
    set_place(entry.value, place);
  }
  for (Node &item : node.items)
    set_place(item, place);
}

std::vector<std::string> split_at_dots(const std::string &path)
{
  std::vector<std::string> parts{""};
  for (const char c : path)
    if (c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

// Entry of a table or item of an array below `node`, made when a table lacks it.
Node &child(Node &node, const std::string &key, const Place &place, const std::string &whole)
{
  if (node.kind == Node::Kind::array) {
    const bool digits = !key.empty() && key.size() < 6 && std::all_of(key.begin(), key.end(), [](unsigned char c) {
      return std::isdigit(c);
    });
    if (!digits || std::size_t(std::stoi(key)) >= node.items.size())
      throw InputError(place, fmt::format("'{}' in '{}' is no index; there are {} entries, counted from 0", key,
                                          whole, node.items.size()));
    return node.items[std::size_t(std::stoi(key))];
  }
  if (node.kind != Node::Kind::table)
    throw InputError(place, fmt::format("'{}' leads through a value that is not a section", whole));
  for (Node::Entry &entry : node.entries)
    if (entry.key == key)
      return entry.value;
  Node made;
  made.place   = place;
  made.section = true;
  node.entries.push_back({key, place, std::move(made)});
  return node.entries.back().value;
}

void lay_over(Node &root, const std::string &set)
{
  const Place place{"--set " + set};
  const auto equals = set.find('=');
  if (equals == std::string::npos || equals == 0)
    throw InputError(place, "an override has the form section.key=value");
  std::string path = set.substr(0, equals);
  path.erase(path.find_last_not_of(" \t") + 1);
  std::string value = set.substr(equals + 1);
  value.erase(0, std::min(value.find_first_not_of(" \t"), value.size()));
  Node *node = &root;
  for (const std::string &key : split_at_dots(path)) {
    if (key.empty())
      throw InputError(place, "an override has the form section.key=value");
    node = &child(*node, key, place, path);
  }
  *node = override_value(value, place);
  set_place(*node, place);
}
} // namespace

const Node::Entry *Node::find(const std::string &key) const
{
  for (const Entry &entry : entries)
    if (entry.key == key)
      return &entry;
  return nullptr;
}

std::string shown(const Node &node)
{
  switch (node.kind) {
  case Node::Kind::text:
    return '"' + node.text + '"';
  case Node::Kind::integer:
  case Node::Kind::real:
    return number_text(node.number);
  case Node::Kind::flag:
    return node.flag ? "true" : "false";
  case Node::Kind::array:
    return node.section ? "[[...]]" : "[...]";
  case Node::Kind::table:
    return "{...}";
  case Node::Kind::other:
    return "(date or time)";
  }
  return "";
}

Node read_case_file(const std::string &path, const std::vector<std::string> &sets)
{
  const std::string text = read_text(path);
  Node root              = node_of(parsed(path, text), path);
  std::vector<Problem> problems;
  for (const std::string &set : sets)
    try {
      lay_over(root, set);
    } catch (const InputError &error) {
      problems.insert(problems.end(), error.problems.begin(), error.problems.end());
    }
  if (!problems.empty())
    throw InputError(std::move(problems));
  return root;
}
} // namespace mill
