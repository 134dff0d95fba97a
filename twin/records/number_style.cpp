#include "twin/records/number_style.h"
#include "core/base/text.h"
#include <algorithm>
#include <charconv>
#include <cmath>

namespace mill::twin {
namespace {
constexpr std::size_t longest_number = 64;  // characters

// The text with ASCII signs alone: "\u2212" and no-break spaces are what spreadsheets write in some locales.
std::string_view plain_signs(std::string_view text, std::array<char, longest_number> &copy)
{
  static constexpr std::pair<std::string_view, char> signs[] = {
      {"\u2212", '-'}, {"\u00a0", ' '}, {"\u202f", ' '}, {"\u2009", ' '}, {"\u2019", '\''}};
  if (std::none_of(text.begin(), text.end(), [](const char c) { return static_cast<unsigned char>(c) >= 0x80; }))
    return text;
  std::size_t n = 0;
  while (!text.empty()) {
    if (n == copy.size())
      return {};
    const auto *sign_of_list = std::find_if(std::begin(signs), std::end(signs), [&](const auto &sign) {
      return text.substr(0, sign.first.size()) == sign.first;
    });
    copy[n++]                = sign_of_list == std::end(signs) ? text.front() : sign_of_list->second;
    text.remove_prefix(sign_of_list == std::end(signs) ? 1 : sign_of_list->first.size());
  }
  return {copy.data(), n};
}

bool is_digit(const char c)
{
  return c >= '0' && c <= '9';
}

// Takes the signs between thousands out; false where a group is not of three digits or the first one begins with
// 0.
bool without_groups(const std::string_view text, const NumberStyle &style, std::array<char, longest_number> &copy,
                    std::size_t &n)
{
  const std::size_t sign = !text.empty() && (text.front() == '-' || text.front() == '+');
  const auto whole_end   = std::min(
        text.find_first_not_of(std::string{'0', '1', '2', '3', '4', '5', '6', '7', '8', '9', style.group}, sign),
        text.size());
  const auto whole = text.substr(sign, whole_end - sign);
  if (whole.find(style.group) != std::string_view::npos) {
    std::size_t from = 0;
    for (std::size_t group = 0;; ++group) {
      const auto end    = std::min(whole.find(style.group, from), whole.size());
      const auto digits = end - from;
      if (group == 0 ? digits < 1 || digits > 3 || whole.front() == '0' : digits != 3)
        return false;
      if (end == whole.size())
        break;
      from = end + 1;
    }
  }
  n = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (i < whole_end && text[i] == style.group)
      continue;
    if (n == copy.size())
      return false;
    copy[n++] = text[i];
  }
  return true;
}

bool read_plain(std::string_view text, double &number)
{
  if (text.size() > 1 && text.front() == '+' && text[1] != '-')
    text.remove_prefix(1);
  if (text.empty() || !(is_digit(text.front()) || text.front() == '-' || text.front() == '.'))
    return false;  // not the words "inf" and "nan"
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(number);
}
}  // namespace

bool operator==(const NumberStyle &a, const NumberStyle &b)
{
  return a.decimal == b.decimal && a.group == b.group;
}

bool read_number(const std::string_view cell, const NumberStyle &style, double &number)
{
  if (style.decimal == '.' && style.group == 0 && read_plain(cell, number))
    return true;
  std::array<char, longest_number> signs, copy;
  std::string_view text = plain_signs(cell, signs);
  std::size_t n         = text.size();
  if (text.empty() || n > copy.size())
    return false;
  if (style.group == 0)
    std::copy(text.begin(), text.end(), copy.begin());
  else if (!without_groups(text, style, copy, n))
    return false;
  if (style.decimal != '.') {
    if (std::find(copy.begin(), copy.begin() + std::ptrdiff_t(n), '.') != copy.begin() + std::ptrdiff_t(n))
      return false;
    if (auto *comma = std::find(copy.begin(), copy.begin() + std::ptrdiff_t(n), style.decimal);
        comma != copy.begin() + std::ptrdiff_t(n))
      *comma = '.';
  }
  return read_plain({copy.data(), n}, number);
}

StyleMask styles_of(const std::string_view cell)
{
  double number = 0;
  if (!has_any(cell, ",.'\xE2\xC2 "))
    return read_plain(cell, number) ? every_style : 0;
  StyleMask mask = 0;
  for (std::size_t i = 0; i < number_styles.size(); ++i)
    mask |= unsigned(read_number(cell, number_styles[i], number)) << i;
  return mask;
}

StyleChoice style_of_column(const StyleMask column, const std::vector<StyleMask> &file, const char separator)
{
  const auto with_decimal = [](const char decimal) {
    StyleMask mask = 0;
    for (std::size_t i = 0; i < number_styles.size(); ++i)
      mask |= unsigned(number_styles[i].decimal == decimal) << i;
    return mask;
  };
  const auto first_of = [](const StyleMask mask) {
    for (std::size_t i = 0; i < number_styles.size(); ++i)
      if (mask >> i & 1)
        return number_styles[i];
    return NumberStyle{};
  };
  const StyleMask points = column & with_decimal('.'), commas = column & with_decimal(',');
  if (points == 0 || commas == 0 || column == every_style)
    return {first_of(column)};
  // "8.987" or "1,234" in every cell: the other columns say which sign the file has for decimals
  bool point_elsewhere = false, comma_elsewhere = false;
  for (const StyleMask other : file) {
    point_elsewhere = point_elsewhere || (other != 0 && (other & with_decimal(',')) == 0);
    comma_elsewhere = comma_elsewhere || (other != 0 && (other & with_decimal('.')) == 0);
  }
  const bool written_with_comma = !(column & 1u);  // no decimal point without groups is possible
  if (point_elsewhere != comma_elsewhere)
    return {first_of(point_elsewhere ? points : commas)};
  if (!written_with_comma)
    return {first_of(points)};
  return {first_of(separator == ',' ? points : commas), true};
}
}  // namespace mill::twin
