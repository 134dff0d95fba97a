// Text that a user reads is plain English: string literals of the sources, comments of the cases, pages.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {
const fs::path plain_root = MILLSTAND_SOURCE_DIR;

// What must not appear, and a way to say it; names (`told`, chatter-three-counts) may.  Each begins with a word
// that is cheap to look for.
struct OddPhrase {
  const char *word;
  const char *pattern;
  const char *instead;
};
const OddPhrase odd_phrases[]{
    {"is no ", R"(\bis no (?!longer\b|more\b))", "\"is not a ..\", \"must be one of ..\", \"no .. is given\""},
    {"none of", R"(\bnone of\b)", "\"not one of\", \"no ..\""},
    {"obody", R"(\b[Nn]obody\b)", "\"no one\", \"not known\", \"not given\""},
    {"told", R"((^|[^.\w`])told\b)", "\"identified\", \"distinguishable\", \"reported\""},
    {"beside", R"(\bstands? beside\b)", "\"compared with\", \"given together with\""},
    {"there", R"(\bstands? there\b)", "\"appears\", \"is given\""},
    {"anew", R"(\banew\b)", "\"again\", \"recomputed\""},
    {"by slope", R"(\bby slope\b)", "\"linear estimate\""},
    {"counts", R"((^|[^-:\w])counts\b)", "\"is included\", \"decides\", \"is measured from\""},
};

// Rooms and pages with text for users.
const std::vector<std::string> plain_rooms{"core", "meshes", "reduce", "fem",  "dynamics",  "report",
                                           "twin", "app",    "cases",  "docs", "README.md", "CHANGELOG.md"};

std::string read(const fs::path &file)
{
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

// The text of every string literal of a C++ source; neighbours that the compiler joins are joined.  Comments,
// character literals and #include lines are left out.
std::vector<std::string> string_literals(const std::string &source)
{
  std::vector<std::string> literals;
  bool joins     = false;  // only white space since the last literal
  const auto add = [&](const std::string &text) {
    if (joins)
      literals.back() += text;
    else
      literals.push_back(text);
    joins = true;
  };
  const auto line_end = [&](const std::size_t i) { return std::min(source.find('\n', i), source.size()); };
  for (std::size_t i = 0; i < source.size();) {
    const char c = source[i];
    if (source.compare(i, 2, "//") == 0 || source.compare(i, 8, "#include") == 0) {
      i = line_end(i);
    } else if (source.compare(i, 3, "R\"(") == 0) {
      const std::size_t end = std::min(source.find(")\"", i), source.size());
      add(source.substr(i + 3, end - i - 3));
      i = end + 2;
    } else if (c == '"') {
      std::string text;
      for (++i; i < source.size() && source[i] != '"'; ++i) {
        if (source[i] == '\\')
          ++i;
        text += source[i];
      }
      add(text);
      ++i;
    } else if (c == '\'' && i > 0 && !std::isalnum(static_cast<unsigned char>(source[i - 1]))) {
      i     = source.find('\'', source[i + 1] == '\\' ? i + 3 : i + 2) + 1;
      joins = false;
    } else {
      joins = joins && std::isspace(static_cast<unsigned char>(c));
      ++i;
    }
  }
  return literals;
}

std::vector<std::string> lines_of(const std::string &text)
{
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    lines.push_back(line);
  return lines;
}

// The phrases in a text, each with the text around it.
std::vector<std::string> odd_english(std::string text)
{
  const std::string usual = "here is no ";  // with "there" or "There" before it, it is plain
  for (auto position = text.find(usual); position != std::string::npos; position = text.find(usual))
    text.replace(position, usual.size(), "no ");
  std::vector<std::string> found;
  for (const OddPhrase &phrase : odd_phrases) {
    std::smatch match;
    if (text.find(phrase.word) != std::string::npos &&
        std::regex_search(text, match, std::regex(phrase.pattern))) {
      const std::size_t begin = std::size_t(std::max<long>(0, match.position() - 40));
      found.push_back("\"" + text.substr(begin, 100) + "\": write " + phrase.instead);
    }
  }
  return found;
}

std::vector<fs::path> files_of(const std::string &room)
{
  if (fs::is_regular_file(plain_root / room))
    return {plain_root / room};
  std::vector<fs::path> files;
  for (const auto &entry : fs::recursive_directory_iterator(plain_root / room))
    if (entry.is_regular_file())
      files.push_back(entry.path());
  return files;
}

bool is_read_by_users(const fs::path &file)
{
  const std::string ending = file.extension().string();
  return ending == ".cpp" || ending == ".h" || ending == ".toml" || ending == ".md" || ending == ".js" ||
         ending == ".html";
}
}  // namespace

TEST(PlainEnglish, TextForUsersHasNoOddPhrases)
{
  std::size_t n_texts = 0;
  for (const std::string &room : plain_rooms)
    for (const fs::path &file : files_of(room)) {
      if (!is_read_by_users(file))
        continue;
      const std::string ending = file.extension().string(), content = read(file);
      const bool source = ending == ".cpp" || ending == ".h";
      for (const std::string &text : source ? string_literals(content) : lines_of(content)) {
        if (source && text.find(' ') == std::string::npos)
          continue;  // one word is a key of a file
        ++n_texts;
        for (const std::string &phrase : odd_english(text))
          ADD_FAILURE() << fs::relative(file, plain_root).string() << ": " << phrase;
      }
    }
  EXPECT_GT(n_texts, 5000u) << "the texts are no longer found";
}

TEST(PlainEnglish, LiteralsAreReadAsTheCompilerReadsThem)
{
  const std::string source =
      "#include \"a b\"\n// \"comment\"\nconst char *a = \"is \"\n  \"no pass\"; char c = '\"';\n"
      "f(R\"(raw \"text\")\", \"es\\\"cape\");";
  EXPECT_EQ(string_literals(source), (std::vector<std::string>{"is no pass", "raw \"text\"", "es\"cape"}));
  EXPECT_EQ(odd_english("a roll that is no pass").size(), 1u) << "also across two literals";
  EXPECT_TRUE(odd_english("the value is no longer used").empty());
  EXPECT_TRUE(odd_english("there is no file x.csv").empty());
  EXPECT_EQ(odd_english("nobody was told anew").size(), 3u);
}
