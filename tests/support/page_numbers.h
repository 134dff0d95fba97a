#pragma once
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

// Numbers of a report page read back as numbers.
namespace mill {
/// Cells of the first table row that names a result, without tags.
inline std::vector<std::string> cells_of_result(const std::string &html, const std::string &name)
{
  std::vector<std::string> cells;
  const std::size_t head = html.find("<code>" + name + "</code>");
  if (head == std::string::npos)
    return cells;
  const std::string row = html.substr(head, html.find("</tr>", head) - head);
  for (std::size_t cell = row.find("<td"); cell != std::string::npos; cell = row.find("<td", cell + 1)) {
    std::string text;
    bool inside = false;
    for (std::size_t i = cell; i < row.find("</td>", cell); ++i) {
      if (row[i] == '<')
        inside = true;
      if (!inside)
        text += row[i];
      if (row[i] == '>')
        inside = false;
    }
    cells.push_back(text);
  }
  return cells;
}

/// The number that follows `before` in a text of the page: "39 404", "-2.0", "3.94 x 10^10" in the page's
/// typography. NaN: no such place, or no number there.
inline double number_after(const std::string &text, const std::string &before = "")
{
  const std::size_t begin = text.find(before);
  if (begin == std::string::npos)
    return std::numeric_limits<double>::quiet_NaN();
  std::string digits;
  std::size_t i       = begin + before.size();
  const auto followed = [&](const std::string &sign) {
    if (text.compare(i, sign.size(), sign) != 0)
      return false;
    i += sign.size();
    return true;
  };
  while (i < text.size()) {
    if (followed("\u202f") || followed("+"))
      continue;
    if (followed("\u2212"))
      digits += '-';
    else if (std::string("0123456789.").find(text[i]) != std::string::npos)
      digits += text[i++];
    else
      break;
  }
  if (digits.empty())
    return std::numeric_limits<double>::quiet_NaN();
  if (followed(" \u00d7 10")) {
    static const char *const raised[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                         "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    std::string exponent              = followed("\u207b") ? "-" : "";
    for (bool more = true; more;) {
      more = false;
      for (int digit = 0; digit < 10 && !more; ++digit)
        if (followed(raised[digit])) {
          exponent += char('0' + digit);
          more = true;
        }
    }
    digits += "e" + exponent;
  }
  return std::strtod(digits.c_str(), nullptr);
}
}  // namespace mill
