#include "app/study/varied_key.h"
#include "app/trace/trace_key.h"
#include "core/base/units.h"
#include "core/model/case.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace mill {
namespace {
constexpr int most_steps = 100000;  // of one interval

std::string trimmed(const std::string &text)
{
  const auto first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// A number with or without its unit, or a word.
struct Item {
  double number = not_a_number();
  std::string unit, word;
  static double not_a_number()
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
};

[[noreturn]] void refuse(const std::string &written, const std::string &message)
{
  throw InputError("--vary " + written + ": " + message);
}

Item item_of(const std::string &written, const std::string &text)
{
  if (text.empty())
    refuse(written, "a value is missing");
  const ParsedQuantity quantity = parse_quantity(text);
  Item item;
  if (quantity.fault == ParsedQuantity::Fault::no_number)
    item.word = text;
  else if (quantity.fault == ParsedQuantity::Fault::unknown_unit)
    refuse(written, "unknown unit '" + quantity.unit_text + "' in " + text);
  else {
    item.number = quantity.number;
    item.unit   = quantity.unit ? quantity.unit->symbol : "";
  }
  return item;
}

// "lo..hi:n unit" with the unit behind lo, hi or n.
std::vector<Item> interval(const std::string &written, const std::string &values)
{
  const auto dots = values.find(".."), colon = values.rfind(':');
  if (colon == std::string::npos || colon < dots)
    refuse(written, "an interval needs its number of values, for example " + trimmed(values) + ":11");
  Item low   = item_of(written, trimmed(values.substr(0, dots))),
       high  = item_of(written, trimmed(values.substr(dots + 2, colon - dots - 2))),
       steps = item_of(written, trimmed(values.substr(colon + 1)));
  for (const Item *item : {&low, &high, &steps})
    if (!item->word.empty())
      refuse(written, "'" + item->word + "' is not a number; an interval is written lo..hi:n");
  if (steps.number < 2 || steps.number > most_steps || steps.number != std::floor(steps.number))
    refuse(written,
           fmt::format("{} is not a number of values between 2 and {}", number_text(steps.number), most_steps));
  const std::string unit = !steps.unit.empty() ? steps.unit : !high.unit.empty() ? high.unit : low.unit;
  for (Item *item : {&low, &high})
    if (item->unit.empty())
      item->unit = unit;
  if (low.unit != unit && find_unit(low.unit)->dimension == find_unit(unit)->dimension) {
    low.number = from_si(to_si(low.number, *find_unit(low.unit)), *find_unit(unit));
    low.unit   = unit;
  }
  if (high.unit != unit || low.unit != unit)
    refuse(written, "the ends of the interval have different units");
  if (!(low.number < high.number))
    refuse(written, low.number > high.number ? "the interval is reversed; write the lower end first"
                                             : "the interval is empty: both ends are the same");
  std::vector<Item> items;
  for (int i = 0; i < int(steps.number); ++i)
    items.push_back({low.number + (high.number - low.number) * i / (steps.number - 1), unit, ""});
  return items;
}

// A unit behind the last number belongs to all numbers that have none.
void share_unit(std::vector<Item> &items)
{
  for (Item &item : items)
    if (item.word.empty() && item.unit.empty())
      item.unit = items.back().unit;
}

void require_dimension(const std::string &written, const KnownKey &key, const Item &item)
{
  if (key.row.kind != Kind::quantity && key.row.kind != Kind::pair)
    return;
  const std::string takes = "; " + needed(key.row);
  if (!item.word.empty() && key.row.kind == Kind::pair)
    return;  // written as two, which the reader judges
  if (!item.word.empty())
    refuse(written, "'" + item.word + "' is not a quantity" + takes);
  if (item.unit.empty())
    refuse(written, number_text(item.number) + " has no unit" + takes);
  if (!(find_unit(item.unit)->dimension == unit(key.row.form).dimension))
    refuse(written, number_text(item.number) + " " + item.unit + " is " + find_unit(item.unit)->quantity + takes);
}
}  // namespace

std::string number_value(const double number, const std::string &unit, const bool pair)
{
  const std::string one = number_text(number) + (unit.empty() ? "" : " " + unit);
  return pair ? "[\"" + one + "\", \"" + one + "\"]" : one;
}

std::vector<std::string> list_items(const std::string &text)
{
  std::vector<std::string> items(1);
  int depth   = 0;
  bool inside = false;
  for (const char c : text) {
    inside = c == '"' ? !inside : inside;
    depth += inside ? 0 : (c == '[' || c == '{') - (c == ']' || c == '}');
    if (c == ',' && depth == 0 && !inside)
      items.emplace_back();
    else
      items.back() += c;
  }
  for (std::string &item : items)
    item = trimmed(item);
  return items;
}

WrittenVariation split_variation(const std::string &written, const char sign)
{
  const auto place = written.find(sign);
  if (place == std::string::npos || place == 0 || place + 1 == written.size())
    throw InputError("--vary \"" + written + "\" is not of the form " +
                     (sign == '=' ? "KEY=a,b,c or KEY=lo..hi:n" : "KEY~normal(mean, sd) UNIT"));
  return {trimmed(written.substr(0, place)), trimmed(written.substr(place + 1))};
}

KnownKey known_key(const Case &the_case, const std::vector<std::string> &sets, const std::string &name)
{
  const TraceKey key = find_key(the_case, sets, name, {});
  return {key.name, key.path, key.row};
}

VariedKey varied_key(const Case &the_case, const std::vector<std::string> &sets, const std::string &written)
{
  const WrittenVariation parts = split_variation(written, '=');
  const KnownKey key           = known_key(the_case, sets, parts.key);
  std::vector<Item> items;
  if (parts.values.find("..") != std::string::npos)
    items = interval(written, parts.values);
  else
    for (const std::string &text : list_items(parts.values))
      items.push_back(item_of(written, text));
  share_unit(items);
  VariedKey varied{key.name, key.path, key.row.meaning, items.back().unit, {}, {}, key.row.kind == Kind::pair};
  std::set<std::string> seen;
  for (const Item &item : items) {
    require_dimension(written, key, item);
    const std::string value = item.word.empty() ? number_value(item.number, item.unit, varied.pair) : item.word;
    if (!seen.insert(value).second)
      refuse(written, "the value " + value + " is there twice");
    varied.values.push_back(value);
    const bool converted =
        item.word.empty() && item.unit != varied.unit && find_unit(item.unit) && find_unit(varied.unit);
    varied.numbers.push_back(
        converted ? from_si(to_si(item.number, *find_unit(item.unit)), *find_unit(varied.unit)) : item.number);
  }
  return varied;
}

void require_different_keys(const std::vector<std::string> &names)
{
  std::set<std::string> seen;
  for (const std::string &name : names)
    if (!seen.insert(name).second)
      throw InputError("--vary names the key " + name + " twice; give all its values in one --vary");
}

std::vector<VariedKey> varied_keys(const Case &the_case, const std::vector<std::string> &sets,
                                   const std::vector<std::string> &written)
{
  std::vector<VariedKey> keys;
  std::vector<std::string> names;
  for (const std::string &one : written) {
    keys.push_back(varied_key(the_case, sets, one));
    names.push_back(keys.back().name);
  }
  require_different_keys(names);
  return keys;
}
}  // namespace mill
