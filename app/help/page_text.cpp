#include "app/help/page_text.h"
#include "core/base/text.h"
#include <sstream>

namespace mill::help {
namespace {
constexpr std::size_t columns = 88;

bool begins_with(const std::string &text, const std::string &start)
{
  return text.compare(0, start.size(), start) == 0;
}

// "[text](target)" is its text, "![picture](file)" nothing, "**strong**" the word.
std::string without_marks(const std::string &markdown)
{
  std::string text;
  for (std::size_t i = 0; i < markdown.size(); ++i) {
    if (markdown[i] == '[') {
      const auto end   = markdown.find("](", i);
      const auto close = end == std::string::npos ? end : markdown.find(')', end);
      if (close != std::string::npos && markdown.find('[', i + 1) > end) {
        const bool picture = !text.empty() && text.back() == '!';
        if (picture)
          text.pop_back();
        else
          text += markdown.substr(i + 1, end - i - 1);
        i = close;
        continue;
      }
    }
    if (markdown.substr(i, 2) == "**") {
      ++i;
      continue;
    }
    text += markdown[i];
  }
  return text;
}

std::string trimmed(const std::string &text)
{
  const auto first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// Characters, not bytes, of UTF-8.
std::size_t width_of(const std::string &word)
{
  std::size_t width = 0;
  for (const char c : word)
    width += (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  return width;
}

std::string table_row(const std::vector<std::string> &cells)
{
  std::string row;
  for (std::size_t i = 1; i < cells.size(); ++i)
    if (!cells[i].empty())
      row += (row.empty() ? "" : "; ") + cells[i];
  return "    " + without_marks(cells[0]) + "\n" + paragraph(row, 8);
}
}  // namespace

std::string paragraph(const std::string &markdown, const int indent)
{
  const std::string margin(std::size_t(indent), ' ');
  std::string text;
  std::size_t column = columns + 1;
  std::istringstream words(without_marks(markdown));
  for (std::string word; words >> word;) {
    const std::size_t width = width_of(word);
    if (column + 1 + width > columns) {
      text += (text.empty() ? "" : "\n") + margin + word;
      column = margin.size() + width;
    } else {
      text += " " + word;
      column += 1 + width;
    }
  }
  return text.empty() ? "" : text + "\n";
}

std::vector<std::string> cells_of(const std::string &line)
{
  if (!begins_with(line, "|") || begins_with(line, "|-") || begins_with(line, "| -"))
    return {};
  std::vector<std::string> cells;
  std::string cell;
  for (std::size_t i = 1; i < line.size(); ++i) {
    if (line[i] == '\\' && i + 1 < line.size() && line[i + 1] == '|')
      cell += line[++i];
    else if (line[i] == '|') {
      cells.push_back(trimmed(cell));
      cell.clear();
    } else
      cell += line[i];
  }
  return cells;
}

std::string page_text(const std::string &markdown)
{
  std::string text, collected;  // lines of the paragraph that is not yet complete
  bool inside    = false;
  bool head      = true;  // the next row of a table names its columns
  const auto end = [&] {
    text += paragraph(collected, 0);
    collected.clear();
  };
  std::istringstream lines(markdown);
  for (std::string line; std::getline(lines, line);) {
    if (begins_with(line, "```")) {
      end();
      inside = !inside;
    } else if (inside)
      text += "    " + line + "\n";
    else if (begins_with(line, "<!--"))
      end();
    else if (begins_with(line, "|")) {
      end();
      if (const auto cells = cells_of(line); !cells.empty() && !head)
        text += table_row(cells);
      head = false;
    } else if (line.empty()) {
      end();
      text += text.empty() || text_ends_with(text, "\n\n") ? "" : "\n";
      head = true;
    } else if (begins_with(line, "#")) {
      end();
      text += trimmed(line.substr(line.find_first_not_of('#'))) + "\n";
    } else {
      if (begins_with(line, "- "))
        end();
      collected += (collected.empty() ? "" : " ") + line;
    }
  }
  end();
  return text;
}
}  // namespace mill::help
