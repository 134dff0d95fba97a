#include "core/base/hidden_characters.h"
#include "core/base/units.h"
#include "core/case/fields.h"
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

// What rows look like in words and in TOML.
namespace mill {
namespace {
bool has_range(const Range &range)
{
  return std::isfinite(range.min) || std::isfinite(range.max);
}

std::string with_unit(const double number, const std::string &form)
{
  const bool whole       = std::abs(number) < 1e10 && number == std::floor(number);  // 1000000 rather than 1e+06
  const std::string text = whole ? fmt::format("{:.0f}", number) : number_text(number);
  return form == "1" || form == "count" ? text : text + " " + form;
}

std::string scalar_toml(const double value, const std::string &form)
{
  return form == "1" ? number_text(value) : quoted(quantity_text(value, unit(form)));
}

// How often each letter is in a word; other characters share the places of letters.
using Letters = std::array<int, 32>;

Letters letters_of(const std::string &word)
{
  Letters letters{};
  for (const char c : word)
    ++letters[static_cast<unsigned char>(c) % letters.size()];
  return letters;
}

// A lower bound of slips_between(): each letter that one of the words has more often costs a slip, which a
// replacement pays for one letter of both.
std::size_t least_slips(const Letters &a, const Letters &b)
{
  int only_a = 0, only_b = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    only_a += std::max(0, a[i] - b[i]);
    only_b += std::max(0, b[i] - a[i]);
  }
  return std::size_t(std::max(only_a, only_b));
}
}  // namespace

std::size_t slips_between(const std::string &a, const std::string &b, const std::size_t limit)
{
  const std::size_t width = b.size() + 1;
  std::vector<std::size_t> rows(3 * width);  // of the table of distances the last three
  std::size_t least_before = 0;
  for (std::size_t i = 0; i <= a.size(); ++i) {
    std::size_t *row = &rows[i % 3 * width], *above = &rows[(i + 2) % 3 * width],
                *two_above = &rows[(i + 1) % 3 * width];
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        row[j] = i + j;
        continue;
      }
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, above[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], two_above[j - 2] + 1);
    }
    const std::size_t least = *std::min_element(row, row + width);
    if (std::min(least, least_before) >= limit)  // every way to the end passes through one of two rows
      return limit;
    least_before = least;
  }
  return rows[a.size() % 3 * width + b.size()];
}

std::string column_form(const Row &row, const int column)
{
  return row.kind == Kind::table ? split(row.form, ", ")[std::size_t(column)] : row.form;
}

std::string range_in(const Range &range, const std::string &form)
{
  if (!std::isfinite(range.max))
    return "at least " + with_unit(range.min, form);
  if (!std::isfinite(range.min))
    return "at most " + with_unit(range.max, form);
  return with_unit(range.min, form) + " .. " + with_unit(range.max, form);
}

std::string quoted(const std::string &text)
{
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += '\\';
    out += c;
  }
  return escaped(out, [](const char32_t code) { return fmt::format("\\u{:04X}", unsigned(code)); }) + '"';
}

std::vector<std::string> split(const std::string &list, const std::string &separator)
{
  std::vector<std::string> parts;
  std::size_t begin = 0;
  for (std::size_t end; (end = list.find(separator, begin)) != std::string::npos; begin = end + separator.size())
    parts.push_back(list.substr(begin, end - begin));
  parts.push_back(list.substr(begin));
  return parts;
}

std::string key_text(const std::string &key)
{
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](const unsigned char c) {
    return (c < 0x80 && std::isalnum(c)) || c == '_' || c == '-';
  });
  return bare ? key : quoted(key);
}

std::string toml_of(const Row &row, const Value &value)
{
  switch (row.kind) {
  case Kind::quantity:
  case Kind::number: {
    const double number = std::get<double>(value);
    return std::isnan(number) ? "" : scalar_toml(number, row.form);
  }
  case Kind::count:
    return std::to_string(std::get<int>(value));
  case Kind::flag:
    return std::get<bool>(value) ? "true" : "false";
  case Kind::choice:
  case Kind::text: {
    const auto &text = std::get<std::string>(value);
    return text.empty() && row.fallback.kind == Fallback::Kind::absent ? "" : quoted(text);
  }
  case Kind::path: {
    // absolute, because the folder of the text is not known yet
    const auto &path = std::get<std::string>(value);
    return path.empty() ? "" : quoted(std::filesystem::absolute(path).lexically_normal().string());
  }
  case Kind::pair: {
    const auto &pair = std::get<std::array<double, 2>>(value);
    if (std::isnan(pair[0]))
      return "";
    return "[" + scalar_toml(pair[0], row.form) + ", " + scalar_toml(pair[1], row.form) + "]";
  }
  case Kind::six: {
    const auto &six = std::get<std::array<double, 6>>(value);
    if (std::isnan(six[0]))
      return "";
    std::string text;
    for (const double number : six)
      text += (text.empty() ? "[" : ", ") + scalar_toml(number, row.form);
    return text + "]";
  }
  case Kind::words: {
    std::string text;
    if (row.form == "names") {
      for (const std::string &pair : std::get<std::vector<std::string>>(value))
        text += (text.empty() ? "{ " : ", ") + quoted(pair.substr(0, pair.rfind('='))) + " = " +
                quoted(pair.substr(pair.rfind('=') + 1));
      return text.empty() ? "" : text + " }";
    }
    for (const std::string &word : std::get<std::vector<std::string>>(value))
      text += (text.empty() ? "" : ", ") + quoted(word);
    return text.empty() ? "" : "[" + text + "]";
  }
  case Kind::list: {
    std::string text;
    for (const double number : std::get<std::vector<double>>(value))
      text += (text.empty() ? "" : ", ") + scalar_toml(number, row.form);
    return text.empty() ? "" : "[" + text + "]";
  }
  case Kind::triples: {
    std::string text;
    for (const auto &[a, b, c] : std::get<std::vector<std::array<double, 3>>>(value))
      text += fmt::format("{}[{}, {}, {}]", text.empty() ? "" : ", ", scalar_toml(a, row.form),
                          scalar_toml(b, row.form), scalar_toml(c, row.form));
    return text.empty() ? "" : "[" + text + "]";
  }
  case Kind::table: {
    std::string text;
    for (const auto &pair : std::get<std::vector<std::array<double, 2>>>(value))
      text += fmt::format("{}[{}, {}]", text.empty() ? "" : ", ", scalar_toml(pair[0], column_form(row, 0)),
                          scalar_toml(pair[1], column_form(row, 1)));
    return text.empty() ? "" : "[" + text + "]";
  }
  }
  return "";
}

std::string example_toml(const Row &row)
{
  const bool in_quotes =
      row.kind == Kind::quantity || row.kind == Kind::choice || row.kind == Kind::text || row.kind == Kind::path;
  return in_quotes ? quoted(row.example) : row.example;
}

std::string default_toml(const Row &row)
{
  const auto value = default_of(row);
  return value ? toml_of(row, *value) : "";
}

namespace {
std::string in_small_letters(std::string word)
{
  for (char &c : word)
    c = char(std::tolower(static_cast<unsigned char>(c)));
  return word;
}
// "barrel_dia" of "barrel_diameter"; nothing where several words go on like this.
std::string only_one_that_continues(const std::string &word, const std::vector<std::string> &known)
{
  constexpr std::size_t too_short = 3;
  std::string found;
  for (const std::string &candidate : known)
    if (word.size() > too_short && candidate.rfind(word, 0) == 0 && candidate != found) {
      if (!found.empty())
        return "";
      found = candidate;
    }
  return found;
}
}  // namespace

std::string nearest_word(const std::string &word, const std::vector<std::string> &known)
{
  std::string best;
  // More than a third of the letters wrong is another word; of two letters one may be.
  std::size_t fewest    = word.size() == 2 ? 2 : word.size() / 3 + 1;
  const Letters letters = letters_of(word);
  for (const std::string &candidate : known)
    if (in_small_letters(candidate) == in_small_letters(word))
      return candidate;
  for (const std::string &candidate : known) {
    if (std::max(word.size(), candidate.size()) - std::min(word.size(), candidate.size()) >= fewest)
      continue;  // each letter too many is a slip; a very long word would make the table of distances large
    if (least_slips(letters, letters_of(candidate)) >= fewest)
      continue;
    if (const auto slips = slips_between(word, candidate, fewest); slips < fewest) {
      fewest = slips;
      best   = candidate;
    }
  }
  return best;
}

std::string likely_word(const std::string &word, const std::vector<std::string> &known)
{
  const std::string nearest = nearest_word(word, known);
  return nearest.empty() ? only_one_that_continues(word, known) : nearest;
}

std::string meant_word(const std::string &word, const std::vector<std::string> &known)
{
  const std::string best = likely_word(word, known);
  return best.empty() ? "" : "; did you mean '" + best + "'?";
}

std::string suggestion(const std::string &word, const std::vector<std::string> &known)
{
  if (const std::string meant = meant_word(word, known); !meant.empty())
    return meant;
  std::string list;
  for (const std::string &candidate : known)
    list += (list.empty() ? "" : ", ") + candidate;
  return list.empty() ? "" : "; known: " + list;
}

std::string needed(const Row &row)
{
  const std::string example = example_toml(row);
  switch (row.kind) {
  case Kind::quantity:
    return fmt::format("{} is needed, for example {}", unit(row.form).quantity, example);
  case Kind::number:
    return fmt::format("a pure number is needed, for example {}", example);
  case Kind::count:
    return fmt::format("a whole number is needed, for example {}", example);
  case Kind::flag:
    return "true or false is needed";
  case Kind::choice:
    return fmt::format("one of {} is needed", row.form);
  case Kind::text:
  case Kind::path:
    return fmt::format("a text in quotes is needed, for example {}", example);
  case Kind::pair:
    return fmt::format("a pair such as {} is needed", example);
  case Kind::table:
    return fmt::format("a list of pairs such as {} is needed", example);
  case Kind::six:
    return fmt::format("a list of six such as {} is needed", example);
  case Kind::list:
    return fmt::format("a list such as {} is needed", example);
  case Kind::triples:
    return fmt::format("a list of threes such as {} is needed", example);
  case Kind::words:
    if (row.form == "names")
      return fmt::format("a table of names such as {} is needed", example);
    return row.form == "text" ? fmt::format("a list of texts such as {} is needed", example)
                              : fmt::format("a list such as {} of {} is needed", example, row.form);
  }
  return "";
}

std::string range_text(const Row &row)
{
  return has_range(row.range) ? range_in(row.range, row.kind == Kind::count ? "count" : column_form(row, 1)) : "";
}
}  // namespace mill
