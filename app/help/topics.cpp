#include "app/help/topics.h"
#include "app/help/embedded.h"
#include "app/help/page_text.h"
#include "core/base/choice.h"
#include "core/base/errors.h"
#include "core/base/si_unit.h"
#include "core/case/fields.h"
#include "core/records/result_place.h"
#include "core/records/result_row.h"
#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <functional>
#include <sstream>

namespace mill::help {
namespace {
// Pages of docs/ that are looked through row by row; only the glossary is a topic itself.
enum class TablePage { glossary, input };
constexpr auto words_of(TablePage)
{
  return choice_words<TablePage>("glossary", "input");
}

bool is_table(const std::string &name)
{
  return choice_named<TablePage>(name).has_value();
}

std::string page(const std::string &name)
{
  for (const EmbeddedFile &file : named_files())
    if (name == file.name)
      return file.text();
  return "";
}

std::string title_of(const std::string &markdown)
{
  const auto first = markdown.find_first_not_of("# ");
  return markdown.substr(first, markdown.find('\n', first) - first);
}

std::string lower(std::string text)
{
  for (char &c : text)
    c = char(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::vector<std::string> split(const std::string &text, const char separator)
{
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, separator);)
    parts.push_back(part);
  return parts;
}

std::string without_backticks(std::string text)
{
  text.erase(std::remove(text.begin(), text.end(), '`'), text.end());
  return text;
}

// Whether `name` is `word`, a capital N standing for a number: "KzcN" of "Kzc2".
bool is_numbered(const std::string &name, const std::string &word)
{
  std::size_t position = 0;
  for (const char c : name) {
    const auto digit = [&] { return position < word.size() && word[position] >= '0' && word[position] <= '9'; };
    if (c == 'N' && digit())
      while (digit())
        ++position;
    else if (position >= word.size() || word[position++] != c)
      return false;
  }
  return position == word.size();
}

// A name of the reference is that of a word: "bearing.NAME.bore" of "bearing.trb.bore"; KEY takes all that
// follows. At least one part is a word and does not stand for any name.
constexpr const char *any_in_a_key = "NAME";
bool is_name_of(const std::string &pattern, const std::string &word)
{
  const auto names = split(pattern, '.'), words = split(word, '.');
  bool same            = false;
  const bool ends_open = !names.empty() && names.back() == any_key;
  if (ends_open ? words.size() < names.size() : names.size() != words.size())
    return false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (is_any_name(names[i]) || names[i] == any_in_a_key)
      continue;
    if (!is_numbered(names[i], words[i]))
      return false;
    same = true;
  }
  return same;
}

// Calls visit(section, cells) for the rows of a page of tables.
template <class Visit> void each_row(const TablePage name, const Visit &visit)
{
  std::istringstream lines(page(word_of(name)));
  std::string section;
  for (std::string line; std::getline(lines, line);)
    if (line.rfind('#', 0) == 0)
      section = without_backticks(line.substr(line.find_first_not_of("# ")));
    else if (const auto cells = cells_of(line); cells.size() > 1)
      visit(section, cells);
}

std::string terms(const std::string &topic)
{
  std::string text;
  each_row(TablePage::glossary, [&](const std::string &, const std::vector<std::string> &cells) {
    for (const std::string &term : split(cells[0], ','))
      if (lower(term.substr(term.find_first_not_of(' '))) == lower(topic))
        text += cells[0] + "\n" + paragraph(cells[1], 4);
  });
  return text;
}

// Whether a name of the reference, "contact.upper/lower.half_width", begins as the topic does: at least one part
// is a word of both and does not stand for any name.
std::string with_topic(const std::string &name, const std::string &topic)
{
  auto parts       = split(name, '.');
  const auto words = split(topic, '.');
  bool same        = false;
  if (words.size() > parts.size())
    return "";
  for (std::size_t i = 0; i < words.size(); ++i) {
    same     = same || (!is_any_name(parts[i]) && is_numbered(parts[i], words[i]));
    parts[i] = words[i];
  }
  return same ? fmt::format("{}", fmt::join(parts, ".")) : "";
}

std::string unit_text(const ResultRow &row)
{
  if (!*row.unit)
    return "of its key";
  return is_in(row.unit, SiUnit::one) ? "-" : row.unit;
}

// The result of this name and those whose names begin with it.
std::string results(const std::string &topic)
{
  std::string listed, completed;
  for (const RowGroup &group : row_groups())
    for (const ResultRow *row : group.rows) {
      const auto text_of = [&](const std::string &name) {
        return fmt::format("result {} [{}]\n", name, unit_text(*row)) +
               paragraph(fmt::format("{}: {}; theory {}", group.title, meaning_of_result(name), row->theory), 4);
      };
      for (const std::string &on_page : names_on_page(*row)) {
        if (on_page == topic || on_page.rfind(topic + ".", 0) == 0)
          listed += text_of(on_page);
        else if (const std::string name = with_topic(on_page, topic); is_made_by(*row, name))
          completed += text_of(name);
      }
    }
  return listed.empty() ? completed : listed;
}

// Of each row of docs/input.md: the key, the key with its section, all cells (key, form, range, default, example,
// meaning).
void each_key(
    const std::function<void(const std::string &, const std::string &, const std::vector<std::string> &)> &use)
{
  each_row(TablePage::input, [&](std::string section, const std::vector<std::string> &cells) {
    if (cells.size() < 6 || cells[0] == "key")
      return;
    section.erase(
        std::remove_if(section.begin(), section.end(), [](const char c) { return c == '[' || c == ']'; }),
        section.end());
    const std::string key = without_backticks(cells[0]);
    use(key, (section == "top of the file" ? "" : section + ".") + key, cells);
  });
}

std::string keys(const std::string &topic)
{
  std::string text;
  each_key([&](const std::string &key, const std::string &name, const std::vector<std::string> &cells) {
    if (!is_name_of(name, topic) && key != topic)  // "crown" alone
      return;
    const std::string entry =
        fmt::format("key {} = {}\n", name, without_backticks(cells[4])) +
        paragraph(fmt::format("{}; {}; range {}, default {}", cells[5], cells[1], cells[2], cells[3]), 4);
    if (text.find(entry) == std::string::npos)  // kinds of cases share sections
      text += entry;
  });
  return text;
}

// Of "stack optimise", a verb with its action, what the verb does.
std::string verb_text(const std::string &topic, const std::vector<DescribedVerb> &verbs)
{
  const auto verb = std::find_if(verbs.begin(), verbs.end(), [&](const DescribedVerb &v) {
    return topic == v.name || topic.rfind(v.name + " ", 0) == 0;
  });
  return verb == verbs.end() ? ""
                             : fmt::format("millstand {}: {}\n    its options: millstand {} --help\n", verb->name,
                                           verb->meaning, verb->name);
}

std::vector<std::string> known_topics(const std::vector<DescribedVerb> &verbs)
{
  std::vector<std::string> known;
  for (const EmbeddedFile &file : named_files())
    if (!is_table(file.name))
      known.push_back(file.name);
  for (const DescribedVerb &verb : verbs)
    known.push_back(verb.name);
  return known;
}

// A task or verb first, then a key; a list of all tasks and verbs where nothing is near.
std::string nearest_topic(const std::string &topic, const std::vector<DescribedVerb> &verbs)
{
  const auto topics = known_topics(verbs);
  std::vector<std::string> names;
  each_key([&](const std::string &, const std::string &name, const std::vector<std::string> &) {
    names.push_back(name);
  });
  const std::string key = likely_word(topic, topics).empty() ? meant_word(topic, names) : "";
  return key.empty() ? suggestion(topic, topics) : key;
}

std::string list_of_topics(const std::vector<DescribedVerb> &verbs)
{
  std::string text = "Tasks, shown by 'millstand help NAME':\n";
  for (const EmbeddedFile &file : named_files())
    if (!is_table(file.name))
      text += fmt::format("    {:<24} {}\n", file.name, title_of(file.text()));
  text += "\nVerbs:\n";
  for (const DescribedVerb &verb : verbs)
    text += fmt::format("    {:<24} {}\n", verb.name, verb.meaning);
  return text +
         "\nAlso a term (\"gap mode\"), a result (K3) or a key of a case (work_roll.crown, or crown alone).\n";
}
}  // namespace

std::string topic_text(const std::string &topic, const std::vector<DescribedVerb> &verbs)
{
  if (topic.empty())
    return list_of_topics(verbs);
  std::string text = verb_text(topic, verbs);
  if (!is_table(topic) || choice_named<TablePage>(topic) == TablePage::glossary)
    text += page_text(page(topic));
  text += terms(topic) + results(topic) + keys(topic);
  if (text.empty())
    throw InputError(fmt::format("no help is available for '{}'{}; a list: millstand help", topic,
                                 nearest_topic(topic, verbs)));
  return text;
}
}  // namespace mill::help
