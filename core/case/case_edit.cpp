#include "core/case/case_edit.h"
#include "core/case/case_file.h"
#include "core/case/fields.h"
#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace mill {
namespace {
std::vector<std::string> lines_of(const std::string &text)
{
  std::vector<std::string> lines;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
    lines.push_back(text.substr(begin, end - begin));
    begin = end;
  }
  return lines;
}

std::string joined_lines(const std::vector<std::string> &lines)
{
  std::string text;
  for (const std::string &line : lines)
    text += line;
  return text;
}

std::string end_of_line(const std::string &text)
{
  return text.find("\r\n") == std::string::npos ? "\n" : "\r\n";
}

// Byte of a column, which counts characters from 1.
std::size_t byte_of(const std::string &line, const int column)
{
  std::size_t byte = 0;
  for (int c = 1; c < column && byte < line.size(); ++c)
    do
      ++byte;
    while (byte < line.size() && (static_cast<unsigned char>(line[byte]) & 0xc0) == 0x80);
  return byte;
}

// Where a value that begins at `begin` ends.  The text is TOML, so that brackets and quotes close.
std::size_t end_of_value(const std::string &text, const std::size_t begin)
{
  int depth = 0;
  for (std::size_t i = begin; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      const std::string three(3, c);
      const bool long_text = text.compare(i, 3, three) == 0;
      std::size_t close    = i + (long_text ? 3 : 1);
      while (close < text.size() && (long_text ? text.compare(close, 3, three) != 0 : text[close] != c))
        close += c == '"' && text[close] == '\\' ? 2 : 1;
      i = close + (long_text ? 2 : 0);
      if (depth == 0)
        return i + 1;
    } else if (c == '#' && depth > 0) {
      i = std::min(text.find('\n', i), text.size() - 1);
    } else if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      if (depth == 0)
        return i;  // of an inline table around it
      if (--depth == 0)
        return i + 1;
    } else if (depth == 0 && (c == '#' || c == '\n' || c == '\r' || c == ',')) {
      std::size_t end = i;
      while (end > begin && std::isspace(static_cast<unsigned char>(text[end - 1])))
        --end;
      return end;
    }
  }
  return text.size();
}

// "bearing.\"crb 1.5\".bore" -> its parts.
std::vector<std::string> parts_of_key(const std::string &key)
{
  std::vector<std::string> parts{""};
  bool in_quotes = false;
  for (const char c : key)
    if (c == '"')
      in_quotes = !in_quotes;
    else if (c == '.' && !in_quotes)
      parts.emplace_back();
    else
      parts.back() += c;
  return parts;
}

struct Location {
  const Node::Entry *entry = nullptr;  ///< of the key; nullptr: it is not in the file
  const Node *section      = nullptr;  ///< around it; nullptr: missing
  std::string header;                  ///< of that section, "[bearing.trb]"; empty: the top level
  std::size_t items = 0;               ///< of a list of sections: how many there are
  bool is_item      = false;
};

bool is_index(const std::string &part)
{
  return !part.empty() && part.size() < 4 &&
         std::all_of(part.begin(), part.end(), [](const unsigned char c) { return std::isdigit(c) != 0; });
}

Location locate(const Node &root, const std::vector<std::string> &parts)
{
  Location where;
  const Node *node = &root;
  std::string name;
  for (std::size_t i = 0; i + 1 < parts.size(); ++i) {
    if (is_index(parts[i]) && i > 0) {  // of a list that has been found, or is to begin
      where.is_item = true;
      where.items   = node ? node->items.size() : 0;
      const auto n  = std::size_t(std::stoi(parts[i]));
      node          = node && n < node->items.size() ? &node->items[n] : nullptr;
      continue;
    }
    const Node::Entry *next = node ? node->find(parts[i]) : nullptr;
    node                    = next ? &next->value : nullptr;
    name += (name.empty() ? "" : ".") + key_text(parts[i]);
  }
  where.header  = name.empty() ? "" : where.is_item ? "[[" + name + "]]" : "[" + name + "]";
  where.section = node;
  where.entry   = node && node->kind == Node::Kind::table ? node->find(parts.back()) : nullptr;
  return where;
}

std::string stripped_line(const std::string &line)
{
  const auto begin = line.find_first_not_of(" \t\r\n");
  return begin == std::string::npos ? "" : line.substr(begin, line.find_last_not_of(" \t\r\n") + 1 - begin);
}

// "# key = .." or "#key = .."; where the text behind the sign begins, or npos.
std::size_t commented_key(const std::string &line, const std::string &key)
{
  const auto sign = line.find_first_not_of(" \t");
  if (sign == std::string::npos || line[sign] != '#')
    return std::string::npos;
  const auto word = line.find_first_not_of(" \t", sign + 1);
  if (word == std::string::npos || line.compare(word, key.size(), key) != 0)
    return std::string::npos;
  const auto equals = line.find_first_not_of(" \t", word + key.size());
  return equals != std::string::npos && line[equals] == '=' ? word : std::string::npos;
}

// Lines of a section from behind its header to before the next one.
struct SectionLines {
  std::size_t begin, end;
};

bool is_header(const std::string &line)
{
  const std::string bare = stripped_line(line);
  return !bare.empty() && bare[0] == '[';
}

SectionLines lines_of_section(const std::vector<std::string> &lines, const Location &where)
{
  const std::size_t begin = where.header.empty() ? 0 : std::size_t(where.section->place.line);
  // A header begins a line; a line of a value in several lines may do so too and belongs to an entry.
  std::size_t from = begin;
  for (const Node::Entry &entry : where.section->entries)
    if (!entry.value.section && entry.value.place.line > 0)
      from = std::max(from, std::size_t(entry.value.place.line));
  std::size_t end = from;
  while (end < lines.size() && !is_header(lines[end]) &&
         // the commented header of a section that is switched off, or the heading of a part
         stripped_line(lines[end]).rfind("# [", 0) != 0)
    ++end;
  return {begin, end};
}

std::string line_with(const std::string &key, const std::string &toml, const std::string &comment,
                      const std::string &end)
{
  return key + " = " + toml + (comment.empty() ? "" : "  " + comment) + end;
}

std::string with_new_key(const std::string &text, const Location &where, const std::string &key,
                         const std::string &toml)
{
  auto lines            = lines_of(text);
  const std::string end = end_of_line(text), name = key_text(key);
  if (!lines.empty() && lines.back().back() != '\n')
    lines.back() += end;
  if (!where.section) {
    std::string added = (lines.empty() ? "" : end) + where.header + end;
    if (where.is_item && key != "name")
      added += line_with("name", mill::quoted(fmt::format("pass {}", where.items + 1)), "", end);
    return joined_lines(lines) + added + line_with(name, toml, "", end);
  }
  if (!where.header.empty() && !where.section->section)
    throw InputError(where.section->place,
                     fmt::format("{} is written in one line; write the key {} into it", where.header, key));
  const SectionLines of_section = lines_of_section(lines, where);
  for (std::size_t i = of_section.begin; i < of_section.end; ++i)
    if (const auto word = commented_key(lines[i], name); word != std::string::npos) {
      const auto equals = lines[i].find('=', word);
      const auto begin  = std::min(lines[i].find_first_not_of(" \t", equals + 1), lines[i].size());
      const auto old    = end_of_value(lines[i], begin);
      const auto sign   = lines[i].find('#', old);
      lines[i] = line_with(name, toml, sign == std::string::npos ? "" : stripped_line(lines[i].substr(sign)), end);
      return joined_lines(lines);
    }
  std::size_t last = of_section.begin;
  for (const Node::Entry &entry : where.section->entries)
    if (!entry.value.section && entry.key_place.line > 0) {
      const std::string before = joined_lines({lines.begin(), lines.begin() + entry.value.place.line - 1});
      const std::size_t begin =
          before.size() + byte_of(lines[std::size_t(entry.value.place.line) - 1], entry.value.place.column);
      const std::size_t close = end_of_value(text, begin);
      last = std::max(last, std::size_t(std::count(text.begin(), text.begin() + std::ptrdiff_t(close), '\n')) + 1);
    }
  lines.insert(lines.begin() + std::ptrdiff_t(std::min(last, lines.size())), line_with(name, toml, "", end));
  return joined_lines(lines);
}

bool reads_back(const std::string &text, const std::vector<std::string> &parts)
{
  try {
    return locate(read_case_text("the case", text), parts).entry != nullptr;
  } catch (const InputError &) {  // the key is there twice, or its section is
    return false;
  }
}

// Everything before the last part of a dotted key: "steel." of "steel.density = ..".
std::string dotted_prefix(const std::string &line)
{
  char quote       = 0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != 0)
      quote = c == quote ? '\0' : quote;
    else if (c == '"' || c == '\'')
      quote = c;
    else if (c == '=')
      break;
    else if (c == '.')
      last = i + 1;
  }
  return line.substr(0, last);
}

// A key of a section without a header line: behind a dotted key of the same section.
std::string with_dotted_key(const std::string &text, const Location &where, const std::string &key,
                            const std::string &toml)
{
  auto lines = lines_of(text);
  for (const Node::Entry &entry : where.section->entries)
    if (const auto line = std::size_t(entry.key_place.line); !entry.value.section && line > 0) {
      const std::string added =
          line_with(dotted_prefix(lines[line - 1]) + key_text(key), toml, "", end_of_line(text));
      lines.insert(lines.begin() + std::ptrdiff_t(line - 1),
                   added);  // before it: its value may have several lines
      break;
    }
  return joined_lines(lines);
}

// The first of the ways to write it with which the key is read where it belongs.
std::string with_added_key(const std::string &text, const Location &where, const std::vector<std::string> &parts,
                           const std::string &toml)
{
  std::string next = with_new_key(text, where, parts.back(), toml);
  if (!where.section || reads_back(next, parts))
    return next;
  next = with_dotted_key(text, where, parts.back(), toml);
  if (reads_back(next, parts))
    return next;
  Location with_header = where;  // a section that only sections below it name
  with_header.section  = nullptr;
  next                 = with_new_key(text, with_header, parts.back(), toml);
  if (!where.is_item && reads_back(next, parts))
    return next;
  throw InputError(where.section->place,
                   fmt::format("{} is written in a way that {} cannot be added to; write it into the file",
                               where.header, key_text(parts.back())));
}

std::string as_comment(const std::string &text, const Node::Entry &entry, const std::size_t value_end)
{
  auto lines       = lines_of(text);
  const auto first = std::size_t(entry.key_place.line) - 1;
  const auto last  = std::size_t(std::count(text.begin(), text.begin() + std::ptrdiff_t(value_end), '\n'));
  for (std::size_t i = first; i <= last && i < lines.size(); ++i)
    lines[i] = "# " + lines[i];
  return joined_lines(lines);
}
}  // namespace

namespace {
std::size_t byte_of_value(const std::vector<std::size_t> &begins, const std::string &text, const Place &place)
{
  const std::size_t begin = begins[std::size_t(place.line) - 1];
  return begin + byte_of(text.substr(begin, text.find('\n', begin) - begin), place.column);
}

void add_values(const Node &node, const std::string &name, const std::string &text,
                const std::vector<std::size_t> &begins, std::vector<WrittenValue> &all)
{
  for (const Node::Entry &entry : node.entries) {
    const std::string full = (name.empty() ? "" : name + ".") + key_text(entry.key);
    if (entry.value.kind == Node::Kind::table && entry.value.section) {
      add_values(entry.value, full, text, begins, all);
    } else if (entry.value.kind == Node::Kind::array && entry.value.section) {
      for (std::size_t i = 0; i < entry.value.items.size(); ++i)
        add_values(entry.value.items[i], full + "." + std::to_string(i), text, begins, all);
    } else if (entry.value.kind == Node::Kind::text) {
      all.push_back({full, entry.value.text, entry.key_place.line});
    } else {
      const std::size_t begin = byte_of_value(begins, text, entry.value.place);
      all.push_back({full, text.substr(begin, end_of_value(text, begin) - begin), entry.key_place.line});
    }
  }
}
}  // namespace

std::vector<WrittenValue> written_values(const std::string &text)
{
  std::vector<std::size_t> begins{0};
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n')
      begins.push_back(i + 1);
  std::vector<WrittenValue> all;
  add_values(read_case_text("the case", text), "", text, begins, all);
  return all;
}

std::string with_value(const std::string &text, const std::string &key, const std::string &toml)
{
  const auto parts = parts_of_key(key);
  if (std::any_of(parts.begin(), parts.end(), [](const std::string &part) { return part.empty(); }) ||
      toml.find('\n') != std::string::npos)
    throw InputError(fmt::format("'{}' is not a key of a case", key));
  const Node root      = read_case_text("the case", text);
  const Location where = locate(root, parts);
  if (!where.entry)
    return toml.empty() ? text : with_added_key(text, where, parts, toml);
  const Node &value = where.entry->value;
  if (value.section)
    throw InputError(value.place, fmt::format("'{}' is a section and not a value", key));
  const auto lines        = lines_of(text);
  const auto line         = std::size_t(value.place.line) - 1;
  const std::size_t begin = joined_lines({lines.begin(), lines.begin() + std::ptrdiff_t(line)}).size() +
                            byte_of(lines[line], value.place.column);
  const std::size_t end = end_of_value(text, begin);
  if (toml.empty())
    return as_comment(text, *where.entry, end);
  return text.substr(0, begin) + toml + text.substr(end);
}

std::string toml_as_typed(const std::string &typed, const bool of_text)
{
  const std::string bare = stripped_line(typed);
  const bool in_quotes   = bare.size() > 1 && (bare[0] == '"' || bare[0] == '\'') && bare.back() == bare[0];
  const bool bracket     = !bare.empty() && (bare[0] == '[' || bare[0] == '{');
  if (!of_text || in_quotes || bracket)
    try {
      const Node value = read_case_text("the value", "v = " + bare);
      if (value.entries.size() == 1 && bare.find('\n') == std::string::npos)
        return bare;
    } catch (const InputError &) {  // not TOML, hence text
    }
  std::string one_line = bare;
  std::replace_if(
      one_line.begin(), one_line.end(), [](const unsigned char c) { return c < 0x20; }, ' ');
  return mill::quoted(one_line);
}
}  // namespace mill
