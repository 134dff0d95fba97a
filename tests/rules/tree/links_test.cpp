#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

// Links and paths of every document of the tree, and the size of the README.
namespace fs = std::filesystem;

namespace {
const fs::path root = MILLSTAND_SOURCE_DIR;

// Rooms of earlier layouts: a document that still names one sends its reader to a folder that is gone.
const std::set<std::string> former_rooms{"bearing", "bench", "bite", "cluster", "contact",
                                         "data",    "fmu",   "live", "verify"};

std::string text_of(const fs::path &file)
{
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::set<std::string> rooms()
{
  std::set<std::string> names;
  for (const auto &entry : fs::directory_iterator(root)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && !fs::is_empty(entry) && name[0] != '.' && name != "build" && name != "out")
      names.insert(name);
  }
  return names;
}

// Every page of the tree, generated ones too.
std::vector<fs::path> documents()
{
  std::vector<fs::path> pages;
  for (const auto &entry : fs::directory_iterator(root))
    if (entry.path().extension() == ".md")
      pages.push_back(entry.path());
  for (const std::string &room : rooms())
    for (const auto &entry : fs::recursive_directory_iterator(root / room))
      if (entry.path().extension() == ".md")
        pages.push_back(entry.path());
  std::sort(pages.begin(), pages.end());
  return pages;
}

struct Mention {
  std::string where;  // "docs/live.md:12"
  std::string path;   // as the document writes it
};

std::string where(const fs::path &page, const std::size_t line)
{
  return fs::relative(page, root).string() + ":" + std::to_string(line);
}

// Calls visit(line number from 1, line) for each line of a page.
template <class Visit> void each_line(const fs::path &page, const Visit &visit)
{
  std::istringstream in(text_of(page));
  std::size_t n = 0;
  for (std::string line; std::getline(in, line);)
    visit(++n, line);
}

std::vector<Mention> links_of(const fs::path &page)
{
  static const std::regex link(R"(\]\(([^)\s]+)\))");
  std::vector<Mention> links;
  each_line(page, [&](const std::size_t n, const std::string &line) {
    if (line.find("](") == std::string::npos)
      return;
    for (std::sregex_iterator it(line.begin(), line.end(), link), end; it != end; ++it)
      links.push_back({where(page, n), (*it)[1]});
  });
  return links;
}

// What stands between backticks and begins with a room of this tree or of an earlier one: `core/base/units.cpp`.
std::vector<Mention> paths_of(const fs::path &page)
{
  static const std::regex quoted(R"(`([A-Za-z_.]+)/([^`\s]*)`)");
  static const std::set<std::string> known = rooms();
  std::vector<Mention> paths;
  each_line(page, [&](const std::size_t n, const std::string &line) {
    if (line.find('`') == std::string::npos)
      return;
    for (std::sregex_iterator it(line.begin(), line.end(), quoted), end; it != end; ++it)
      if (const std::string room = (*it)[1]; known.count(room) || former_rooms.count(room))
        paths.push_back({where(page, n), room + "/" + (*it)[2].str()});
  });
  return paths;
}

// The words of commands in blocks of a page that name a file of the tree.
std::vector<Mention> paths_in_blocks(const fs::path &page)
{
  static const std::regex word(R"((^|\s)((cases|docs|scripts)/[A-Za-z0-9_./-]+))");
  std::vector<Mention> paths;
  bool inside = false;
  each_line(page, [&](const std::size_t n, const std::string &line) {
    if (line.compare(0, 3, "```") == 0)
      inside = !inside;
    if (!inside)
      return;
    for (std::sregex_iterator it(line.begin(), line.end(), word), end; it != end; ++it)
      paths.push_back({where(page, n), (*it)[2]});
  });
  return paths;
}

// One name for "{a,b}" in a path, the first one, and everything before a "*".
std::vector<std::string> spelled_out(const std::string &path)
{
  const auto open = path.find('{'), close = path.find('}');
  if (open == std::string::npos || close == std::string::npos || close < open)
    return {path};
  std::vector<std::string> names;
  std::istringstream choices(path.substr(open + 1, close - open - 1));
  for (std::string choice; std::getline(choices, choice, ',');)
    names.push_back(path.substr(0, open) + choice + path.substr(close + 1));
  return names;
}

bool begins_a_name(const fs::path &start)
{
  if (!fs::is_directory(start.parent_path()))
    return false;
  const std::string first = start.filename().string();
  for (const auto &entry : fs::directory_iterator(start.parent_path()))
    if (entry.path().filename().string().compare(0, first.size(), first) == 0)
      return true;
  return false;
}

// A file or folder of the tree; a source may be named without its ending, several by a star.
bool is_there(const std::string &path)
{
  for (std::string name : spelled_out(path)) {
    if (const auto star = name.find('*'); star != std::string::npos) {
      if (!begins_a_name(root / name.substr(0, star)))
        return false;
      continue;
    }
    const fs::path file = root / name;
    if (!fs::exists(file) && !fs::exists(file.string() + ".cpp") && !fs::exists(file.string() + ".h"))
      return false;
  }
  return true;
}

// "## 22.9 Names of modes" -> "229-names-of-modes", as pages of repositories make the anchor of a heading.
std::string anchor_of(const std::string &heading)
{
  std::string anchor;
  for (const char c : heading.substr(heading.find_first_not_of("# ")))
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-')
      anchor += char(std::tolower(static_cast<unsigned char>(c)));
    else if (c == ' ')
      anchor += '-';
  return anchor;
}

bool has_anchor(const fs::path &page, const std::string &anchor)
{
  bool exists = false;
  each_line(page, [&](std::size_t, const std::string &line) {
    exists = exists || (line.compare(0, 1, "#") == 0 && anchor_of(line) == anchor);
  });
  return exists;
}
}  // namespace

TEST(Links, LeadToAFileAndAHeadingThatExist)
{
  std::size_t seen = 0;
  for (const fs::path &page : documents())
    for (const Mention &link : links_of(page)) {
      if (link.path.find("://") != std::string::npos || link.path.compare(0, 7, "mailto:") == 0)
        continue;
      ++seen;
      const auto hash        = link.path.find('#');
      const std::string name = link.path.substr(0, hash);
      const fs::path target  = name.empty() ? page : page.parent_path() / name;
      EXPECT_TRUE(fs::exists(target)) << link.where << ": dead link " << link.path;
      if (hash != std::string::npos && fs::exists(target))
        EXPECT_TRUE(has_anchor(target, link.path.substr(hash + 1)))
            << link.where << ": no heading for " << link.path;
    }
  EXPECT_GT(seen, 100u) << "links are no longer found";
}

TEST(Links, PathsThatADocumentNamesExist)
{
  std::size_t seen = 0;
  for (const fs::path &page : documents()) {
    auto paths = paths_of(page);
    for (const Mention &path : paths_in_blocks(page))
      paths.push_back(path);
    for (const Mention &path : paths) {
      ++seen;
      EXPECT_TRUE(is_there(path.path)) << path.where << ": " << path.path << " is not in the tree";
    }
  }
  EXPECT_GT(seen, 500u) << "paths are no longer found";
}

TEST(Readme, NamesEveryRoomAndFitsOnAScreenAndAHalf)
{
  const std::string readme = text_of(root / "README.md");
  EXPECT_LE(std::count(readme.begin(), readme.end(), '\n'), 70);
  std::istringstream in(readme);
  std::size_t words = 0;
  for (std::string word; in >> word;)
    ++words;
  EXPECT_LE(words, 700u);
  for (const std::string &room : rooms())
    EXPECT_NE(readme.find("`" + room + "/`"), std::string::npos) << "README.md has no line for " << room << "/";
}
