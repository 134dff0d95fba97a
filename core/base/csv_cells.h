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
  std::size_t position;
  const char *message;
};

/// The text between the quote at line[position] and the one that closes it, without the doubling of those inside;
/// `position` moves behind the closing one.  A view into the line or into `unquoted`.
inline std::string_view quoted_text(const std::string_view line, std::size_t &position,
                                    std::deque<std::string> &unquoted, std::optional<QuoteFault> &fault)
{
  const std::size_t open = position++;
  std::string whole;  // only where quotes are doubled
  for (std::size_t from = position;; from = position) {
    const std::size_t quote = std::min(line.find('"', position), line.size());
    const auto piece        = line.substr(from, quote - from);
    position                = std::min(quote + 1, line.size());
    if (quote == line.size() && !fault)
      fault = QuoteFault{open, "this quote is not closed on its line"};
    if (position < line.size() && line[position] == '"') {
      whole.append(piece) += '"';
      ++position;
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
  for (std::size_t position = 0;; ++position) {
    while (position < line.size() && (line[position] == ' ' || (line[position] == '\t' && separator != '\t')))
      ++position;
    const std::size_t begin = position;
    std::string_view text;
    if (position < line.size() && line[position] == '"') {
      text            = without_blanks(quoted_text(line, position, unquoted, fault));
      const auto next = std::min(line.find_first_not_of(" \t\r", position), line.size());
      position        = std::min(line.find(separator, position), line.size());
      if (next < position && !fault)
        fault = QuoteFault{next, "something follows a closing quote; a quote inside quotes is doubled"};
    } else {
      position = std::min(line.find(separator, position), line.size());
      text     = without_blanks(line.substr(begin, position - begin));
    }
    take(text, begin);
    if (position == line.size())
      return fault;
  }
}
}  // namespace mill::csv
