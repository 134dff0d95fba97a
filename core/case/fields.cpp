#include "core/case/fields.h"
#include "core/base/error_list.h"
#include "core/base/units.h"
#include "core/case/quantity_slips.h"
#include "core/case/removed_keys.h"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace mill {
namespace {
// The value under the reader's eye: its row, its node, its full key, and where to complain.
struct Item {
  const Row &row;
  const Node &node;
  std::string key;
  Reading &reading;
  std::nullopt_t refuse(const std::string &why) const
  {
    reading.add(node.place, fmt::format("{} = {} {}", key, shown(node), why));
    return std::nullopt;
  }
};

// One number with the unit `form` ("1": bare).
std::optional<double> scalar(const Item &item, const std::string &form, const Range &range)
{
  using Fault       = ParsedQuantity::Fault;
  const Node &node  = item.node;
  const bool bare   = node.kind == Node::Kind::integer || node.kind == Node::Kind::real;
  const auto want   = needed(item.row);
  double number     = node.number;
  double value      = number;
  const auto remedy = [&] { return node.kind == Node::Kind::text ? quantity_remedy(node.text, form, range) : ""; };
  if (form == "1") {
    if (!bare || !std::isfinite(number)) {
      if (const std::string slip = remedy(); !slip.empty())
        return item.refuse(slip);
      return item.refuse(fmt::format("is not a number; {}", want));
    }
  } else {
    if (bare)
      return item.refuse(fmt::format("has no unit; {}", want));
    if (node.kind != Node::Kind::text)
      return item.refuse(fmt::format("is not a quantity; {}", want));
    const ParsedQuantity parsed = parse_quantity(node.text);
    const bool fits             = parsed.fault == Fault::none && parsed.unit->dimension == unit(form).dimension;
    if (const std::string slip = fits ? "" : remedy(); !slip.empty())
      return item.refuse(slip);
    if (parsed.fault == Fault::no_number)
      return item.refuse(fmt::format("does not begin with a number; {}", want));
    if (parsed.fault == Fault::no_unit)
      return item.refuse(fmt::format("has no unit; {}", want));
    if (parsed.fault == Fault::unknown_unit)
      return item.refuse(fmt::format("has the unknown unit '{}'; {} (known units: {})", parsed.unit_text, want,
                                     units_like(unit(form))));
    if (!fits)
      return item.refuse(fmt::format("is {}; {}", parsed.unit->quantity, want));
    value  = parsed.value();
    number = from_si(value, unit(form));
  }
  if (!inside(number, range))
    return item.refuse(fmt::format("is outside {}", range_in(range, form)));
  return value;
}

std::optional<Value> count(const Item &item)
{
  constexpr double largest = 1e9;  // of a real number that is taken, as 4.0; it fits into an int
  const bool whole         = item.node.kind == Node::Kind::integer ||
                     (item.node.kind == Node::Kind::real && std::abs(item.node.number) <= largest &&
                      item.node.number == std::floor(item.node.number));
  if (!whole)
    return item.refuse(fmt::format("is not a whole number; {}", needed(item.row)));
  if (!inside(item.node.number, item.row.range))
    return item.refuse(fmt::format("is outside {}", range_in(item.row.range, "count")));
  return int(item.node.number);
}

std::optional<Value> words(const Item &item)
{
  const std::string &text = item.node.text;
  if (item.node.kind != Node::Kind::text)
    return item.refuse(fmt::format("is not a text; {}", needed(item.row)));
  if (item.row.kind == Kind::choice) {
    const auto choices = split(item.row.form, " | ");
    if (std::find(choices.begin(), choices.end(), text) == choices.end())
      return item.refuse(fmt::format("is unknown; {}{}", needed(item.row), meant_word(text, choices)));
  } else if (item.row.kind == Kind::path) {
    if (text.empty() || text.find('\0') != std::string::npos)
      return item.refuse("is not the name of a file");
    return (std::filesystem::path(item.reading.folder) / text).lexically_normal().string();
  }
  return text;
}

// As many numbers as there are forms, each with its unit and range; `what` they are called together.
template <std::size_t n>
std::optional<std::array<double, n>> several(const Item &item, const char *what,
                                             const std::array<std::string, n> &forms,
                                             const std::array<Range, n> &ranges)
{
  if (item.node.kind != Node::Kind::array || item.node.items.size() != n)
    return item.refuse(fmt::format("is not {}; {}", what, needed(item.row)));
  std::array<double, n> values{};
  bool good = true;
  for (std::size_t i = 0; i < n; ++i) {
    const Item one{item.row, item.node.items[i], fmt::format("{}[{}]", item.key, i), item.reading};
    const auto value = scalar(one, forms[i], ranges[i]);
    good             = good && value;
    values[i]        = value.value_or(0);
  }
  return good ? std::optional(values) : std::nullopt;
}

// All of one form.
template <std::size_t n> std::optional<Value> alike(const Item &item, const char *what)
{
  std::array<std::string, n> forms;
  std::array<Range, n> ranges;
  forms.fill(item.row.form);
  ranges.fill(item.row.range);
  if (const auto values = several<n>(item, what, forms, ranges))
    return *values;
  return std::nullopt;
}

std::optional<Value> table(const Item &item)
{
  const bool terms =
      item.row.key == "crown_polynomial";  // one term makes a polynomial, one point does not make a table
  if (item.node.kind != Node::Kind::array || item.node.items.size() < (terms ? 1 : 2))
    return item.refuse(
        fmt::format("is not a list of {} or more; {}", terms ? "one pair" : "two pairs", needed(item.row)));
  std::vector<std::array<double, 2>> pairs;
  for (std::size_t i = 0; i < item.node.items.size(); ++i) {
    const Item one{item.row, item.node.items[i], fmt::format("{}[{}]", item.key, i), item.reading};
    const auto pair =
        several<2>(one, "a pair", {column_form(item.row, 0), column_form(item.row, 1)}, {Range{}, item.row.range});
    if (!pair)
      return std::nullopt;
    if (!pairs.empty() && !((*pair)[0] > pairs.back()[0])) {
      one.refuse("does not increase in its first column; sort the pairs");
      return std::nullopt;
    }
    pairs.push_back(*pair);
  }
  return pairs;
}

std::optional<Value> list(const Item &item)
{
  std::vector<double> values;
  if (item.node.kind != Node::Kind::array) {
    if (const auto value = scalar(item, item.row.form, item.row.range))
      return std::vector<double>{*value};
    return std::nullopt;
  }
  if (item.node.items.empty())
    return item.refuse(fmt::format("is empty; {}", needed(item.row)));
  for (std::size_t i = 0; i < item.node.items.size(); ++i) {
    const Item one{item.row, item.node.items[i], fmt::format("{}[{}]", item.key, i), item.reading};
    if (const auto value = scalar(one, item.row.form, item.row.range))
      values.push_back(*value);
  }
  return values.size() == item.node.items.size() ? std::optional<Value>(values) : std::nullopt;
}

std::optional<Value> triples(const Item &item)
{
  if (item.node.kind != Node::Kind::array || item.node.items.empty())
    return item.refuse(fmt::format("is not a list of threes; {}", needed(item.row)));
  std::vector<std::array<double, 3>> all;
  const std::string &form = item.row.form;
  for (std::size_t i = 0; i < item.node.items.size(); ++i) {
    const Item one{item.row, item.node.items[i], fmt::format("{}[{}]", item.key, i), item.reading};
    const auto three = several<3>(one, "a list of three", {form, form, form}, {Range{}, Range{}, item.row.range});
    if (!three)
      return std::nullopt;
    all.push_back(*three);
  }
  return all;
}

// { "AI_07" = "upper_work_roll" } as a list of "AI_07=upper_work_roll"; no text goes by two names.
std::optional<Value> name_list(const Item &item)
{
  if (item.node.kind != Node::Kind::table || item.node.entries.empty())
    return item.refuse(fmt::format("is not a list of names; {}", needed(item.row)));
  std::vector<std::string> list, meant;
  for (const Node::Entry &entry : item.node.entries) {
    const Item one{item.row, entry.value, item.key + "." + key_text(entry.key), item.reading};
    if (entry.value.kind != Node::Kind::text || entry.value.text.empty() ||
        entry.value.text.find('=') != std::string::npos)
      return one.refuse(fmt::format("is not a name; {}", needed(item.row)));
    if (std::find(meant.begin(), meant.end(), entry.value.text) != meant.end())
      return one.refuse("appears twice");
    meant.push_back(entry.value.text);
    list.push_back(entry.key + "=" + entry.value.text);
  }
  return list;
}

// Words out of those of the row, or any texts, each once.
std::optional<Value> word_list(const Item &item)
{
  if (item.row.form == "names")
    return name_list(item);
  if (item.node.kind != Node::Kind::array || item.node.items.empty())
    return item.refuse(fmt::format("is not a list of words; {}", needed(item.row)));
  const auto known = split(item.row.form, " | ");
  std::vector<std::string> list;
  for (std::size_t i = 0; i < item.node.items.size(); ++i) {
    const Node &node = item.node.items[i];
    const Item one{item.row, node, fmt::format("{}[{}]", item.key, i), item.reading};
    if (node.kind != Node::Kind::text)
      return one.refuse(fmt::format("is not a text; {}", needed(item.row)));
    const bool free = item.row.form == "text";
    if (!free && std::find(known.begin(), known.end(), node.text) == known.end())
      return one.refuse("is unknown" + suggestion(node.text, known));
    if (std::find(list.begin(), list.end(), node.text) != list.end())
      return one.refuse("appears twice");
    list.push_back(node.text);
  }
  return list;
}

std::optional<Value> value_of(const Item &item)
{
  switch (item.row.kind) {
  case Kind::quantity:
  case Kind::number:
    if (const auto value = scalar(item, item.row.form, item.row.range))
      return *value;
    return std::nullopt;
  case Kind::count:
    return count(item);
  case Kind::flag:
    if (item.node.kind != Node::Kind::flag)
      return item.refuse("is neither true nor false");
    return item.node.flag;
  case Kind::choice:
  case Kind::text:
  case Kind::path:
    return words(item);
  case Kind::pair:
    return alike<2>(item, "a pair");
  case Kind::table:
    return table(item);
  case Kind::six:
    return alike<6>(item, "a list of six");
  case Kind::words:
    return word_list(item);
  case Kind::list:
    return list(item);
  case Kind::triples:
    return triples(item);
  }
  return std::nullopt;
}

}  // namespace

void Reading::add(Place place, std::string message, std::vector<Place> related)
{
  problems.push_back({std::move(place), std::move(message), std::move(related)});
}

bool Reading::usable(const std::vector<std::string> &keys) const
{
  return std::none_of(keys.begin(), keys.end(), [&](const std::string &key) { return bad.count(key) > 0; });
}

Place Reading::place(const std::string &key) const
{
  const auto entry = places.find(key);
  return entry == places.end() ? Place{file} : entry->second;
}

std::string Reading::as_written(const std::string &key) const
{
  const auto entry = written.find(key);
  return entry == written.end() ? key : key + " = " + entry->second;
}

std::string Section::header() const
{
  return name.empty() ? "the top level" : "[" + name + "]";
}

std::string Section::key(const std::string &key) const
{
  return name.empty() ? key : name + "." + key;
}

Kind kind_of(const std::size_t member_index, const std::string &form)
{
  switch (member_index) {
  case 0:
    return form == "1" ? Kind::number : Kind::quantity;
  case 1:
    return Kind::count;
  case 2:
    return Kind::flag;
  case 3:
    return form == "text" ? Kind::text : form == "path" ? Kind::path : Kind::choice;
  case 4:
    return Kind::pair;
  case 5:
    return Kind::table;
  case 6:
    return Kind::six;
  case 7:
    return Kind::words;
  case 8:
    return Kind::list;
  default:
    return Kind::triples;
  }
}

void report_missing_section(const Section &section, const std::vector<Row> &rows, Reading &reading)
{
  if (section.node || section.refused)
    return;
  std::string keys;
  std::vector<std::string> instead;  // of all of them, each once
  for (const Row &row : rows)
    if (row.fallback.kind == Fallback::Kind::required) {
      keys += (keys.empty() ? "" : ", ") + row.key;
      if (std::find(instead.begin(), instead.end(), row.instead) == instead.end())
        instead.push_back(row.instead);
    }
  if (keys.empty())
    return;
  std::string others, estimate = ", or estimate = true";
  if (std::find(instead.begin(), instead.end(), "") == instead.end())
    for (const std::string &one : instead) {
      others += (others.empty() ? "; or " : ", ") + one.substr(0, one.find(" in [given]"));
      if (one.find("estimate = true") == std::string::npos)
        estimate = "";
    }
  reading.add(Place{reading.file}, fmt::format("the section {} is missing; it needs {}{}", section.header(), keys,
                                               others.empty() ? "" : others + " in [given]" + estimate));
}

std::optional<Value> default_of(const Row &row)
{
  const Fallback &fallback = row.fallback;
  if (fallback.kind == Fallback::Kind::text)
    return std::string(fallback.text);
  if (fallback.kind != Fallback::Kind::number)
    return std::nullopt;
  if (row.kind == Kind::count)
    return int(fallback.number);
  if (row.kind == Kind::flag)
    return fallback.number != 0;
  return row.kind == Kind::quantity ? to_si(fallback.number, unit(row.form)) : fallback.number;
}

std::optional<Value> read_row(const Row &row, const Section &section, Reading &reading)
{
  const std::string key    = section.key(row.key);
  const Node::Entry *entry = section.node ? section.node->find(row.key) : nullptr;
  if (!entry) {
    if (row.fallback.kind == Fallback::Kind::required) {
      reading.bad.insert(key);
      if (section.node)
        reading.add(section.node->place,
                    fmt::format("{} has no '{}'; add for example {} = {}{}", section.header(), row.key, row.key,
                                example_toml(row), row.instead.empty() ? "" : ", or " + row.instead));
    }
    return default_of(row);
  }
  const auto value = value_of({row, entry->value, key, reading});
  if (value) {
    reading.places[key]  = entry->value.place;
    reading.written[key] = shown(entry->value);
  } else {
    reading.bad.insert(key);
  }
  return value;
}

void refuse_unknown_keys(const Section &section, const std::vector<Row> &rows,
                         const std::vector<std::string> &others, Reading &reading)
{
  if (!section.node)
    return;
  std::vector<std::string> known;
  for (const Row &row : rows)
    known.push_back(row.key);
  known.insert(known.end(), others.begin(), others.end());
  for (const Node::Entry &entry : section.node->entries)
    if (std::find(known.begin(), known.end(), entry.key) == known.end())
      report_unknown(entry, section, known, reading);
}

void report_unknown(const Node::Entry &entry, const Section &section, const std::vector<std::string> &known,
                    Reading &reading)
{
  const std::string what    = entry.value.section && section.name.empty()
                                  ? fmt::format("unknown section [{}]", shortened(entry.key))
                                  : fmt::format("unknown key '{}' in {}", shortened(entry.key), section.header());
  const std::string removal = removal_note(entry.key);
  // Beyond what is shown of a list no suggestion is computed: a damaged file may have a hundred thousand names.
  const bool is_shown = reading.problems.size() < 2 * most_problems_shown;
  reading.add(entry.key_place, what + (!removal.empty() ? removal : is_shown ? suggestion(entry.key, known) : ""));
}

}  // namespace mill
