#pragma once
#include <algorithm>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

// The cells of one line of CSV, for every reader of such a file.
namespace mill::csv {
/// Without blanks, tabs and carriage returns at both ends.
inline std::string_view without_blanks(std::string_view text)
{
  const auto is_blank = [](const char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && is_blank(text.front()))
    text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back()))
    text.remove_suffix(1);
  return text;
}

/// Characters, not bytes.
inline int characters_in(const std::string_view text)
{
  return int(std::count_if(text.begin(), text.end(), [](const char c) { return (c & 0xC0) != 0x80; }));
}

/// What is wrong with the quotes of a line, and at which byte.
struct QuoteFault {
  std::size_t at;
  const char *message;
};

/// The text between the quote at line[at] and the one that closes it, without the doubling of those inside; `at`
/// moves behind the closing one.  A view into the line or into `unquoted`.
inline std::string_view quoted_text(const std::string_view line, std::size_t &at,
                                    std::deque<std::string> &unquoted, std::optional<QuoteFault> &fault)
{
  const std::size_t open = at++;
  std::string whole;  // only where quotes are doubled
  for (std::size_t from = at;; from = at) {
    const std::size_t quote = std::min(line.find('"', at), line.size());
    const auto piece        = line.substr(from, quote - from);
    at                      = std::min(quote + 1, line.size());
    if (quote == line.size() && !fault)
      fault = QuoteFault{open, "this quote is not closed on its line"};
    if (at < line.size() && line[at] == '"') {
      whole.append(piece) += '"';
      ++at;
    } else if (whole.empty())
      return piece;
    else
      return unquoted.emplace_back(whole.append(piece));
  }
}

/// Hands each cell, without blanks around it, and the byte at which it begins to take(text, begin).
/// @param separator  ' ': any number of blanks separates two cells
/// @param unquoted   keeps the texts that are not in the line as they are, those with doubled quotes (RFC 4180)
/// @returns the first fault of the quotes; an open one then reaches to the end of the line, and what follows a
/// closing one belongs to no cell
template <class Take>
std::optional<QuoteFault> each_cell(std::string_view line, const char separator, std::deque<std::string> &unquoted,
                                    const Take &take)
{
  std::optional<QuoteFault> fault;
  const std::size_t size = separator == ' ' ? std::size_t(without_blanks(line).end() - line.begin()) : line.size();
  line                   = line.substr(0, size);
  for (std::size_t at = 0;; ++at) {
    while (at < line.size() && (line[at] == ' ' || (line[at] == '\t' && separator != '\t')))
      ++at;
    const std::size_t begin = at;
    std::string_view text;
    if (at < line.size() && line[at] == '"') {
      text            = without_blanks(quoted_text(line, at, unquoted, fault));
      const auto next = std::min(line.find_first_not_of(" \t\r", at), line.size());
      at              = std::min(line.find(separator, at), line.size());
      if (next < at && !fault)
        fault = QuoteFault{next, "something follows a closing quote; a quote inside quotes is doubled"};
    } else {
      at   = std::min(line.find(separator, at), line.size());
      text = without_blanks(line.substr(begin, at - begin));
    }
    take(text, begin);
    if (at == line.size())
      return fault;
  }
}
}  // namespace mill::csv
