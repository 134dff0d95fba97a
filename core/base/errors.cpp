#include "core/base/error_list.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/base/visible_text.h"
#include "core/laws/refuse_input.h"
#include <algorithm>
#include <array>
#include <cerrno>
#include <fmt/format.h>
#include <map>
#include <mutex>
#include <optional>
#include <sstream>
#include <tuple>

namespace mill {
namespace {
constexpr std::size_t longest_line =
    160;  // characters shown of a line, so that a data file does not fill the screen
constexpr std::size_t longest_message = 4000;  // characters; a sentence of this program has some 300

// The lines of the files that one list of problems is about; each is read once.
class Sources {
public:
  const std::vector<std::string> &lines(const std::string &path)
  {
    const auto [known, is_new] = files.try_emplace(path);
    if (is_new && !path.empty())
      known->second = lines_of(path);
    return known->second;
  }

private:
  static std::vector<std::string> lines_of(const std::string &path);
  std::map<std::string, std::vector<std::string>> files;
};

// Texts that were read in the place of those of files.
struct GivenTexts {
  std::mutex access;
  std::map<std::string, std::string> texts;  // by path
};
GivenTexts &given_texts()
{
  static GivenTexts all;
  return all;
}

std::optional<std::string> text_that_was_read(const std::string &path)
{
  GivenTexts &given = given_texts();
  {
    const std::lock_guard lock(given.access);
    if (const auto text = given.texts.find(path); text != given.texts.end())
      return text->second;
  }
  return text_if_readable(path);
}

std::vector<std::string> Sources::lines_of(const std::string &path)
{
  std::vector<std::string> lines;
  std::istringstream file(text_that_was_read(path).value_or(""));  // what cannot be read has no lines
  for (std::string line; std::getline(file, line);) {
    if (!line.empty() && line.back() == '\r')
      line.pop_back();
    lines.push_back(line);
  }
  return lines;
}

std::size_t n_characters(const std::string &utf8)
{
  return std::size_t(std::count_if(utf8.begin(), utf8.end(), [](const char c) { return (c & 0xC0) != 0x80; }));
}

// First characters of a text, never half of a UTF-8 character.
std::string cut_to(const std::string &text, const std::size_t n)
{
  if (text.size() <= n || n_characters(text) <= n)
    return text;
  std::size_t bytes = 0, characters = 0;
  for (; bytes < text.size(); ++bytes)
    if ((text[bytes] & 0xC0) != 0x80 && characters++ == n)
      break;
  return text.substr(0, bytes) + " ...";
}

// White space as wide as what stands before the column; a tab stays a tab.
std::string indent_to(const std::string &line, const int column)
{
  std::string indent;
  int place = 1;
  for (const char c : line) {
    if ((c & 0xC0) == 0x80)
      continue;
    if (place++ >= column)
      return indent;
    indent += c == '\t' ? '\t' : ' ';
  }
  return indent;
}

// "[work_roll]", the last section header above a line of a case file; empty for other files.
std::string section_above(const std::vector<std::string> &lines, const int line)
{
  for (int i = std::min(line, int(lines.size())); i >= 1; --i) {
    const std::string &text = lines[std::size_t(i - 1)];
    if (const auto first = text.find_first_not_of(" \t"); first != std::string::npos && text[first] == '[')
      return text.substr(first, text.find_last_of(']') - first + 1);
  }
  return "";
}

std::string head(const Place &place)
{
  if (place.file.empty())
    return "";
  if (place.line == 0)
    return shortened(place.file) + ": ";
  return fmt::format("{}:{}:{}: ", place.file, place.line, place.column);
}

std::string excerpt(const Place &place, Sources &sources)
{
  const auto &lines = sources.lines(place.file);
  if (place.line < 1 || place.line > int(lines.size()))
    return "";
  const std::string &line = lines[std::size_t(place.line - 1)];
  const int width         = std::max(4, int(std::to_string(place.line).size()));
  std::string text;
  if (place.line > 1)
    text += fmt::format("\n {:>{}} | {}", place.line - 1, width, shortened(lines[std::size_t(place.line - 2)]));
  text += fmt::format("\n>{:>{}} | {}", place.line, width, shortened(line));
  if (place.column <= int(longest_line))
    text += fmt::format("\n {:>{}} | {}^", "", width, indent_to(line, place.column));
  return text;
}

// The places of a contradiction, one line each, in the order of the file.
std::string excerpts(std::vector<Place> places, Sources &sources)
{
  struct Shown {
    int line_number;
    std::string number, line, section;
  };
  std::sort(places.begin(), places.end());
  std::vector<Shown> shown;
  std::size_t widest = 0;
  for (const Place &place : places) {
    const auto &lines = sources.lines(place.file);
    if (place.line < 1 || place.line > int(lines.size())) {
      shown.push_back({0, "    ", place.file, ""});
      continue;
    }
    const bool is_case = place.file.size() > 5 && text_ends_with(place.file, ".toml");
    shown.push_back({place.line, fmt::format("{:>4}", place.line), shortened(lines[std::size_t(place.line - 1)]),
                     is_case ? section_above(lines, place.line) : ""});
    widest = std::max(widest, n_characters(shown.back().line));
  }
  std::string text;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const auto &[line_number, number, line, section] = shown[i];
    if (i > 0 && line_number != shown[i - 1].line_number + 1)
      text += "\n...";
    text += fmt::format("\n>{} | {}", number, line);
    if (!section.empty() && section != line)
      text += std::string(widest - n_characters(line), ' ') + "      # " + section;
  }
  return text;
}

std::string rendered(const Problem &problem, const std::string &severity, Sources &sources)
{
  const std::string first = head(problem.place) + severity + ": " + cut_to(problem.message, longest_message);
  if (problem.related.empty())
    return first + excerpt(problem.place, sources);
  std::vector<Place> places = problem.related;
  places.push_back(problem.place);
  return first + excerpts(std::move(places), sources);
}

// What stands below the problems that are shown of a list; nothing when all are.
std::string rest_of(const std::vector<Problem> &problems)
{
  if (problems.size() <= most_problems_shown)
    return "";
  const auto n = problems.size() - most_problems_shown;
  return fmt::format("and {} more error{}; mend these and check again", n, n == 1 ? "" : "s");
}

std::string one_below_the_other(const std::vector<Problem> &problems)
{
  std::string text;
  for (std::size_t i = 0; i < std::min(problems.size(), most_problems_shown); ++i)
    text += (i ? "\n" : "") + head(problems[i].place) + "error: " + problems[i].message;
  const std::string rest = rest_of(problems);
  return rest.empty() ? text : text + "\n" + rest;
}

// In the order of the file; what a message quotes from a file stays one line of plain text.
std::vector<Problem> sorted(std::vector<Problem> problems)
{
  for (Problem &problem : problems)
    problem.message = visible(problem.message, true);
  std::stable_sort(problems.begin(), problems.end(),
                   [](const Problem &a, const Problem &b) { return a.place < b.place; });
  return problems;
}
}  // namespace

void show_lines_of(const std::string &path, const std::string &text)
{
  GivenTexts &given = given_texts();
  const std::lock_guard lock(given.access);
  given.texts[path] = text;
}

std::string shortened(const std::string &text)
{
  return cut_to(text, longest_line);
}

bool operator<(const Place &a, const Place &b)
{
  return std::tie(a.file, a.line, a.column) < std::tie(b.file, b.line, b.column);
}

InputError::InputError(std::vector<Problem> all)
    : std::runtime_error(one_below_the_other(sorted(all))), problems(sorted(all))
{
}

InputError::InputError(Place place, std::string message)
    : InputError(std::vector<Problem>{{std::move(place), std::move(message), {}}})
{
}

InputError::InputError(std::string message) : InputError(Place{}, std::move(message)) {}

bool is_refused_by_system(const int error)
{
  constexpr std::array of_the_name{ENOENT, ENOTDIR, EISDIR, EEXIST, ENAMETOOLONG, ELOOP, EINVAL, EXDEV};
  return std::find(of_the_name.begin(), of_the_name.end(), error) == of_the_name.end();
}

void refuse_file(const int error, const Place &place, const std::string &message)
{
  if (is_refused_by_system(error))
    throw SystemError(place, message);
  throw InputError(place, message);
}

void refuse_file(const int error, const std::string &message)
{
  refuse_file(error, Place{}, message);
}

SolverError::SolverError(Report r) : std::runtime_error(r.what), report(std::move(r)) {}

std::string render(const Problem &problem, const std::string &severity)
{
  Sources sources;
  return rendered(problem, severity, sources);
}

std::string render_list(const std::vector<Problem> &problems)
{
  Sources sources;
  std::string text;
  const std::size_t n_shown = std::min(problems.size(), most_problems_shown);
  for (std::size_t i = 0; i < n_shown; ++i)
    text += rendered(problems[i], "error", sources) + "\n";
  const std::string rest = rest_of(problems);
  return rest.empty() ? text : text + rest + "\n";
}

void refuse_input(const std::string &message)
{
  throw InputError(message);
}

void require_input(const bool holds, const char *what)
{
  if (!holds)
    throw InputError(what);
}
}  // namespace mill
