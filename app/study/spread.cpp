#include "app/study/spread.h"
#include "app/trace/trace_key.h"
#include "core/base/short_number.h"
#include "core/base/units.h"
#include "core/model/case.h"
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double most_outside = 1e-6;

struct Shape {
  const char *name;
  Spread::Kind kind;
  std::size_t numbers;  // with the mean
  const char *takes;
};
const Shape shapes[] = {
    {"uniform", Spread::Kind::uniform, 2, "uniform(low, high)"},
    {"normal", Spread::Kind::normal, 2, "normal(mean, sd)"},
    {"truncated", Spread::Kind::truncated, 4, "truncated(mean, sd, low, high)"},
    {"triangular", Spread::Kind::triangular, 3, "triangular(low, most likely, high)"},
    {"tolerance", Spread::Kind::tolerance, 2, "tolerance(mean, half width)"},
};

[[noreturn]] void refuse_spread(const std::string &written, const std::string &message)
{
  throw InputError("--vary \"" + written + "\": " + message);
}

std::string known_shapes()
{
  std::string text;
  for (const Shape &shape : shapes)
    text += (text.empty() ? "" : ", ") + std::string(shape.takes);
  return text;
}

const Shape &shape_of(const std::string &written, const std::string &name)
{
  std::vector<std::string> names;
  for (const Shape &shape : shapes) {
    if (name == shape.name)
      return shape;
    names.push_back(shape.name);
  }
  const std::string nearest = nearest_word(name, names);
  refuse_spread(written,
                "'" + name + "' is not a distribution; " +
                    (nearest.empty() ? "known are " + known_shapes() : "did you mean '" + nearest + "'?"));
}

struct WrittenNumber {
  double number;
  std::string unit;
};

// The numbers between the brackets; the unit behind them belongs to those that have none.
std::vector<WrittenNumber> numbers_of(const std::string &written, const std::string &inside,
                                      const std::string &behind)
{
  std::vector<WrittenNumber> numbers;
  for (std::string item : split(inside, ",")) {
    item.erase(0, item.find_first_not_of(' '));
    const ParsedQuantity q = parse_quantity(item);
    if (q.fault == ParsedQuantity::Fault::no_number)
      refuse_spread(written, "'" + item + "' is not a number");
    if (q.fault == ParsedQuantity::Fault::unknown_unit)
      refuse_spread(written, "unknown unit '" + q.unit_text + "'");
    numbers.push_back({q.number, q.unit ? q.unit->symbol : behind});
  }
  return numbers;
}

// Value of the case for this key, in a unit; NaN: it is not given.
double value_of_case(const Case &the_case, const std::vector<std::string> &sets, const KnownKey &key,
                     const std::string &in_unit)
{
  const TraceKey traced = find_key(the_case, sets, key.name, {});
  if (!traced.value || traced.stands_in)
    return not_given;
  const double number         = first_number(*traced.value);
  const std::string unit_text = unit_written(*traced.value);
  const Unit *from = find_unit(unit_text), *to = find_unit(in_unit);
  return !unit_text.empty() && from && to ? from_si(to_si(number, *from), *to) : number;
}

bool has_dimension(const KnownKey &key)
{
  return key.row.kind == Kind::quantity || key.row.kind == Kind::pair;
}

constexpr const char *percent_sign = "%";

// A percentage of the mean; those of a key that is a percentage itself are its own.
bool is_of_mean(const std::string &unit, const std::string &common)
{
  return unit == percent_sign && common != percent_sign;
}

// All numbers in one unit; a percentage is of the mean unless the key is a percentage itself.
std::vector<double> in_one_unit(const std::string &written, const KnownKey &key, const std::string &common,
                                const std::vector<WrittenNumber> &numbers, const double mean)
{
  std::vector<double> values;
  for (const WrittenNumber &one : numbers) {
    const Unit *from = find_unit(one.unit);
    if (is_of_mean(one.unit, common)) {
      values.push_back(0.01 * one.number * mean);
      continue;
    }
    if (has_dimension(key) && one.unit.empty())
      refuse_spread(written, number_text(one.number) + " has no unit; " + needed(key.row));
    if (has_dimension(key) && !(from->dimension == unit(key.row.form).dimension))
      refuse_spread(written,
                    number_text(one.number) + " " + one.unit + " is " + from->quantity + "; " + needed(key.row));
    values.push_back(one.unit == common || one.unit.empty()
                         ? one.number
                         : from_si(to_si(one.number, *from), *find_unit(common)));
  }
  return values;
}

// A percentage is of the mean: the mean itself is a value, and so is each end of a law without a mean.
void require_no_share(const std::string &written, const Shape &shape, const std::vector<WrittenNumber> &numbers,
                      const std::size_t mean, const std::string &common)
{
  const bool uniform = shape.kind == Spread::Kind::uniform;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (!is_of_mean(numbers[i].unit, common) || !(uniform || i == mean))
      continue;
    refuse_spread(written, uniform
                               ? "uniform has no mean that a percentage would be of; write both ends as values"
                               : number_text(numbers[i].number) +
                                     " % would be of the mean, which it stands for; write the mean as a value, "
                                     "or leave it out to take that of the case");
  }
}

Spread spread_of(const std::string &written, const Shape &shape, const std::vector<double> &v)
{
  Spread s;
  s.kind = shape.kind;
  switch (shape.kind) {
  case Spread::Kind::uniform:
    s.low = v[0], s.high = v[1];
    break;
  case Spread::Kind::normal:
    s.mean = v[0], s.sd = v[1];
    break;
  case Spread::Kind::truncated:
    s.mean = v[0], s.sd = v[1], s.low = v[2], s.high = v[3];
    break;
  case Spread::Kind::triangular:
    s.low = v[0], s.mean = v[1], s.high = v[2];
    break;
  case Spread::Kind::tolerance:
    s.mean = v[0], s.sd = v[1] / 3, s.low = v[0] - v[1], s.high = v[0] + v[1];
    break;
  case Spread::Kind::none:
    break;
  }
  if (!std::isnan(s.low) && !(s.low < s.high))
    refuse_spread(written, s.low > s.high ? "the interval is reversed; write the lower end first"
                                          : "the interval is empty");
  if (!std::isnan(s.sd) && !(s.sd > 0))
    refuse_spread(written, "the spread must be above zero");
  if (shape.kind == Spread::Kind::triangular && !(s.low <= s.mean && s.mean <= s.high))
    refuse_spread(written, "the most likely value is outside of the interval");
  return s;
}

void require_inside(const std::string &written, const KnownKey &key, const std::string &common,
                    const Spread &spread)
{
  const bool quantity  = has_dimension(key);
  const auto in_common = [&](const double end) {
    return quantity && std::isfinite(end) ? from_si(to_si(end, unit(key.row.form)), *find_unit(common)) : end;
  };
  const bool normal    = spread.kind == Spread::Kind::normal;
  const double outside = share_outside(spread, in_common(key.row.range.min), in_common(key.row.range.max));
  if (outside <= (normal ? most_outside : 0))
    return;
  const std::string allows = range_text(key.row) + ", which " + key.name + " allows";
  if (normal)
    refuse_spread(written, fmt::format("{} of this distribution is outside of {}; truncate it: "
                                       "truncated(mean, sd, low, high)",
                                       percent_text(outside), allows));
  refuse_spread(written, (std::isnan(outside) ? "this distribution reaches outside of "
                                              : percent_text(outside) + " of this distribution is outside of ") +
                             allows + "; move its ends inside");
}
}  // namespace

bool is_distribution(const std::string &written)
{
  const auto equals = written.find('='), tilde = written.find('~');
  return tilde != std::string::npos && tilde < equals;
}

double share_outside(const Spread &spread, const double low, const double high)
{
  if (spread.kind == Spread::Kind::uniform)
    return 1 - std::max(0.0, std::min(high, spread.high) - std::max(low, spread.low)) / (spread.high - spread.low);
  if (spread.kind != Spread::Kind::normal)
    return spread.low < low || spread.high > high ? not_given : 0;
  const boost::math::normal law(spread.mean, spread.sd);
  return (std::isfinite(low) ? cdf(law, low) : 0) + (std::isfinite(high) ? cdf(complement(law, high)) : 0);
}

UncertainKey uncertain_key(const Case &the_case, const std::vector<std::string> &sets, const std::string &written)
{
  const WrittenVariation parts = split_variation(written, '~');
  const KnownKey key           = known_key(the_case, sets, parts.key);
  const auto open = parts.values.find('('), close = parts.values.rfind(')');
  if (open == std::string::npos || close == std::string::npos || close < open)
    refuse_spread(written, "a distribution is written " + known_shapes());
  if (!has_dimension(key) && key.row.kind != Kind::number)
    refuse_spread(written,
                  key.name + ": " + needed(key.row) + ", which has no distribution; vary it with KEY=a,b");
  const Shape &shape = shape_of(written, parts.values.substr(0, open));
  std::string behind = parts.values.substr(close + 1);
  behind.erase(0, std::min(behind.size(), behind.find_first_not_of(' ')));
  if (!behind.empty() && !find_unit(behind))
    refuse_spread(written, "unknown unit '" + behind + "'");
  auto numbers       = numbers_of(written, parts.values.substr(open + 1, close - open - 1),
                            behind.empty() ? behind : find_unit(behind)->symbol);
  const bool of_case = numbers.size() + 1 == shape.numbers && shape.kind != Spread::Kind::uniform;
  if (numbers.size() != shape.numbers && !of_case)
    refuse_spread(written, fmt::format("{} numbers; it takes {}", numbers.size(), shape.takes));
  std::string common = has_dimension(key) ? key.row.form : "";
  for (const WrittenNumber &one : numbers)
    if (!one.unit.empty() && !is_of_mean(one.unit, common)) {
      common = one.unit;
      break;
    }
  const std::size_t place = shape.kind == Spread::Kind::triangular ? 1 : 0;
  if (of_case) {
    const double mean = value_of_case(the_case, sets, key, common);
    if (std::isnan(mean))
      refuse_spread(written, "the case has no value of " + key.name + " as the mean; write it: " + shape.takes);
    numbers.insert(numbers.begin() + std::ptrdiff_t(place), {mean, common});
  }
  require_no_share(written, shape, numbers, place, common);
  const auto middle = in_one_unit(written, key, common, {numbers[place]}, not_given);
  UncertainKey uncertain{{key.name, key.path, key.row.meaning, common, {}, {}, key.row.kind == Kind::pair},
                         spread_of(written, shape, in_one_unit(written, key, common, numbers, middle[0])),
                         parts.values};
  require_inside(written, key, common, uncertain.spread);
  return uncertain;
}

std::string set_value(const UncertainKey &uncertain, const double number)
{
  const VariedKey &key = uncertain.key;
  for (std::size_t i = 0; i < key.values.size(); ++i)
    if (std::isnan(key.numbers[i]))  // words: the number is their place
      return key.values.at(std::size_t(number));
  return number_value(number, key.unit, key.pair);
}
}  // namespace mill
