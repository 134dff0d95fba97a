#pragma once
#include "app/trace/trace_key.h"
#include "core/case/stand_rows.h"
#include "core/model/case.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <vector>

// Cases that differ from another one in a single row, whatever the row is.
struct BaseCase {
  std::string file;
  std::vector<std::string> sets;
};

inline mill::Case read(const BaseCase &base)
{
  return mill::read_case(base.file, base.sets);
}

// Whether a result has moved: eigenvalues of an unchanged block round differently.
inline bool differs(const double a, const double b)
{
  return std::isnan(a) != std::isnan(b) || std::abs(a - b) > 1e-11 * std::max(std::abs(a), std::abs(b));
}

// Values to put in the place of the present one, as TOML; a case need not accept all of them.
inline std::vector<std::string> other_values(const mill::TraceKey &key)
{
  using mill::Kind;
  const mill::Row &row = key.row;
  if (row.kind == Kind::flag)
    return {key.value && key.value->flag ? "false" : "true"};
  if (row.kind == Kind::choice)
    return [&] {
      std::vector<std::string> words;
      for (const std::string &word : mill::split(row.form, " | "))
        if (!key.value || key.value->text != word)
          words.push_back(mill::quoted(word));
      return words;
    }();
  if (row.kind == Kind::words)
    return {mill::example_toml(row)};
  if (row.kind == Kind::text)
    return {"\"trb\"", "\"crb\"", "\"another\""};
  if (row.kind == Kind::path)
    return {"\"data/pass-1.csv\"", "\"data/pass-2.csv\""};
  std::vector<std::string> values;
  if (key.value)
    for (const double step : {1e-2, -1e-2, 1e-3, -1e-3})
      values.push_back(mill::changed_toml(*key.value, [&](const double x) {
        return row.kind == Kind::count ? x + (step > 0 ? 1 : -1) : x == 0 ? step : x * (1 + step);
      }));
  if (row.kind == Kind::table)  // examples of tables are straight lines
    values.push_back(row.form == "mm, um"  ? R"([["-10 mm", "0 um"], ["0 mm", "4 um"], ["10 mm", "0 um"]])"
                     : row.form == "1, um" ? R"([[2, "40 um"]])"
                                           : mill::example_toml(row));
  else
    values.push_back(mill::example_toml(row));
  return values;
}

// Values far from the present one, for what a few per cent move by less than its rounding.
inline std::vector<std::string> far_values(const mill::TraceKey &key)
{
  using mill::Kind;
  const Kind kind = key.row.kind;
  if (!key.value || (kind != Kind::quantity && kind != Kind::number && kind != Kind::pair && kind != Kind::six))
    return {};
  std::vector<std::string> values;
  for (const double factor : {2., 0.5, 10., 0.1})
    values.push_back(mill::changed_toml(*key.value, [&](const double x) { return x == 0 ? factor : factor * x; }));
  return values;
}

// The case that another value of a key makes of a base; nothing where it is not accepted, out of its range or
// beside a key that it contradicts.
inline std::optional<mill::Case> with_value(BaseCase base, const mill::TraceKey &key, const std::string &value)
{
  base.sets.push_back(key.path + "=" + value);
  try {
    return read(base);
  } catch (const mill::InputError &) {
    return {};
  }
}

// All that are accepted.
inline std::vector<mill::Case> changed(const BaseCase &base, const mill::Case &the_case, const std::string &name)
{
  const mill::TraceKey key = mill::find_key(the_case, base.sets, name, {});
  std::vector<mill::Case> cases;
  for (const std::string &value : other_values(key))
    if (auto other = with_value(base, key, value))
      cases.push_back(std::move(*other));
  return cases;
}

// "frame.*" fits every key that begins so, "pass.#.load" that of every pass, "bearing.trb.bore" one.
inline bool fits(const std::string &pattern, const std::string &key)
{
  if (!pattern.empty() && pattern.back() == '*')
    return key.rfind(pattern.substr(0, pattern.size() - 1), 0) == 0;
  const auto number = pattern.find('#');
  if (number == std::string::npos)
    return pattern == key;
  for (const char digit : {'0', '1'}) {
    std::string with = pattern;
    with[number]     = digit;
    if (with == key)
      return true;
  }
  return false;
}

inline bool fits_any(const std::vector<std::string> &patterns, const std::string &key)
{
  for (const std::string &pattern : patterns)
    if (fits(pattern, key))
      return true;
  return false;
}
