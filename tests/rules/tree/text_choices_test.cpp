#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <string>
#include <vector>

// Facts that travel as text: choices of the case, and comparisons with a literal.
namespace fs = std::filesystem;

namespace {
const fs::path tree = MILLSTAND_SOURCE_DIR;

struct CodeLine {
  std::string where;  // "core/model/roll.h:12"
  std::string code;   // without a comment
  std::string comment;
};

CodeLine parted(const std::string &where, const std::string &line)
{
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quoted && line[i] == '\\')
      ++i;
    else if (line[i] == '"')
      quoted = !quoted;
    else if (!quoted && line.compare(i, 2, "//") == 0)
      return {where, line.substr(0, i), line.substr(i)};
  }
  return {where, line, ""};
}

// Every line of the C++ files of a folder, or of one file.
std::vector<CodeLine> lines_of(const fs::path &folder)
{
  std::vector<CodeLine> lines;
  for (const auto &entry : fs::recursive_directory_iterator(tree / folder)) {
    const auto ending = entry.path().extension();
    if (ending != ".h" && ending != ".cpp")
      continue;
    std::ifstream in(entry.path());
    const std::string name = fs::relative(entry.path(), tree).string();
    int n                  = 0;
    for (std::string line; std::getline(in, line);)
      lines.push_back(parted(name + ":" + std::to_string(++n), line));
  }
  return lines;
}

std::vector<CodeLine> code_of_product()
{
  std::vector<CodeLine> all;
  for (const char *room : {"app", "core", "dynamics", "fem", "meshes", "reduce", "report", "twin"})
    for (CodeLine &line : lines_of(room))
      if (line.where.rfind("core/case/", 0) != 0 && line.where.rfind("core/laws/", 0) != 0)
        all.push_back(std::move(line));
  return all;
}

// Asked before an expression of the library, which takes seconds for all lines.
bool compares(const std::string &code)
{
  return (code.find("==") != std::string::npos || code.find("!=") != std::string::npos ||
          code.find(".compare(") != std::string::npos) &&
         code.find('"') != std::string::npos;
}

std::size_t matches(const std::string &text, const std::regex &pattern)
{
  return std::size_t(
      std::distance(std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()));
}

// Members of core/model that are text, each on its line or in a list: "  std::string from, to;".
std::set<std::string> text_members()
{
  static const std::regex declared(R"(^  std::string ((\w+)(, \w+)*)( *= *[^;]*)?;)"), one(R"(\w+)");
  std::set<std::string> names;
  for (const CodeLine &line : lines_of("core/model"))
    if (std::smatch found; std::regex_search(line.code, found, declared)) {
      const std::string list = found[1];
      for (std::sregex_iterator it(list.begin(), list.end(), one), end; it != end; ++it)
        names.insert((*it)[0]);
    }
  return names;
}

// Names that structs of other folders have too, and that name a thing: what they hold is not one of a list.
const std::set<std::string> open_names{"name", "title", "path", "file", "unit", "source",
                                       "from", "to",    "at",   "key",  "mass", "kind"};
}  // namespace

// A word list at a text says that the text is a choice: it has to be an enumeration with words_of().
TEST(Choices, OfTheModelAreEnumerations)
{
  const std::regex text(R"(^ +(std::vector<)?std::string\b)"), list(R"([a-z][\w-]* \| [a-z][\w-]*)");
  std::string found;
  for (const CodeLine &line : lines_of("core/model"))
    if (std::regex_search(line.code, text) && std::regex_search(line.comment, list))
      found += line.where + ": " + line.code + line.comment + "\n";
  // Names of numbers of the friction law, which has its own table; the kinds of case, each a struct of Case::spec.
  const std::size_t known = 2;
  EXPECT_LE(matches(found, std::regex("\n")), known) << found;
}

// The rows of a case take the words of a choice from its enumeration.
TEST(Choices, OfTheRowsHaveTheirWordsInOnePlace)
{
  // arrangement: a pattern of signs, one for each row of a bearing, with two names for usual ones; fit_for and
  // springs: names of numbers; model, force_meaning, type: some words of a choice.
  const std::set<std::string> known{"arrangement", "fit_for", "springs", "model", "force_meaning", "type"};
  const std::regex list(R"("[\w+-]+( \| [\w+-]+)+)"), key(R"re("(\w+)"(, &|\) \{))re");
  std::string last, found;
  for (const CodeLine &line : lines_of("core/case")) {
    if (std::smatch row; std::regex_search(line.code, row, key))
      last = row[1];
    if (std::regex_search(line.code, list) && !known.count(last))
      found += line.where + ": " + line.code + "\n";
  }
  EXPECT_EQ(found, "");
}

TEST(Choices, NoTextOfTheModelIsComparedWithALiteral)
{
  const std::regex compared(R"re((?:\.|->)(\w+)\s*(?:==|!=)\s*")re");
  const std::set<std::string> texts = text_members();
  std::string found;
  for (const CodeLine &line : code_of_product())
    if (std::smatch member; compares(line.code) && std::regex_search(line.code, member, compared))
      if (texts.count(member[1]) && !open_names.count(member[1]))
        found += line.where + ": " + line.code + "\n";
  EXPECT_EQ(found, "");
}

// Each == and != with a literal, and each compare() that has one, outside of core/case and core/laws.  The number
// may only fall: a fact of the model or the name of a result is an enumeration, a struct or an id.
TEST(Literals, AreComparedLessOften)
{
  const std::regex comparison(
      R"re((==|!=)\s*(std::string(_view)?\(|json\()?"|"\)?\s*(==|!=)|\.compare\([^;"]*")re");
  std::size_t found = 0;
  for (const CodeLine &line : code_of_product())
    if (compares(line.code))
      found += matches(line.code, comparison);
  EXPECT_LE(found, 57u);
}

namespace {
// Asked before an expression of the library, which takes seconds for all lines.
bool cuts(const std::string &code)
{
  for (const char *call :
       {"find", "substr(", ".compare(", "s_of(", "ends_", "begin", "starts_", "between(", "holds(", "contains("})
    if (code.find(call) != std::string::npos)
      return true;
  return false;
}
}  // namespace

// Lines that look into a name, a label, a title, a source or a method as text, outside of core/case and core/laws.
// The number may only fall: of a result its row and its places are asked (core/records/result_row.h).  What is
// left are names of files, channels, rolls, columns and keys, and the texts that other programs wrote.
TEST(Names, AreTakenApartLessOften)
{
  const std::string word = R"((name|names\[[^\]]*\]|label|title|source|method|motion))";
  const std::regex apart(
      R"((^|[^.>\w])(is_of|parts_of)\(|\b)" + word +
      R"((\(\))?\.(r?find|substr|compare|find_(first|last)(_not)?_of)\(|)" +
      R"(\b(text_ends_with|ends_with|begins|begins_with|starts_with|ends_in|between|holds|contains))" +
      R"(\((\w+(\.|->))*)" + word + R"(\b)");
  std::size_t lines = 0;
  for (const CodeLine &line : code_of_product())
    if (line.where.rfind("core/records/result_row.", 0) != 0 && cuts(line.code))
      lines += std::regex_search(line.code, apart);
  EXPECT_LE(lines, 56u);
}
