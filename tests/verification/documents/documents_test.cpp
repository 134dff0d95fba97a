#include "tests/support/program.h"
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <sstream>
#include <string>
#include <vector>

// The commands of the README and of the pages for users, run as a reader types them.  A block ```sh of commands
// runs in a folder that has the cases of the tree; blocks of one page run in their order.  A block with the line
// "<!-- not run: reason -->" before it is read only: its verbs and options must exist.  "<!-- exit code: 3 -->"
// before a block says how its last command ends; others end with 0.
namespace fs = std::filesystem;

namespace {
const fs::path root = MILLSTAND_SOURCE_DIR;

struct Block {
  std::size_t line     = 0;    ///< of its first command, from 1
  std::string not_run  = {};   ///< the reason; empty when it runs
  std::string exit     = "0";  ///< exit code of its last command
  std::string commands = {};
};

// "<!-- key: text -->" gives the text, other lines nothing.
std::string note(const std::string &line, const std::string &key)
{
  const std::string start = "<!-- " + key + ": ", end = " -->";
  if (line.compare(0, start.size(), start) != 0 || line.size() < start.size() + end.size())
    return "";
  return line.substr(start.size(), line.size() - start.size() - end.size());
}

std::vector<Block> blocks_of(const fs::path &page)
{
  std::ifstream in(page);
  std::vector<Block> blocks;
  Block next;  // what the notes before a block say of it
  bool inside   = false;
  std::size_t n = 0;
  for (std::string line; std::getline(in, line);) {
    ++n;
    if (inside && line.compare(0, 3, "```") == 0)
      inside = false;
    else if (inside)
      blocks.back().commands += line + "\n";
    else if (line == "```sh") {
      inside    = true;
      next.line = n + 1;
      blocks.push_back(next);
      next = {};
    } else if (const std::string reason = note(line, "not run"); !reason.empty())
      next.not_run = reason;
    else if (const std::string code = note(line, "exit code"); !code.empty())
      next.exit = code;
    else if (!line.empty())
      next = {};
  }
  return blocks;
}

// Pages for users that have a block for which `wanted` holds; paths from the root of the tree.
template <class Wanted> std::vector<std::string> pages_with(const Wanted &wanted)
{
  std::vector<std::string> pages;
  const auto look_at = [&](const fs::path &page) {
    const auto blocks = blocks_of(page);
    if (page.extension() == ".md" && std::any_of(blocks.begin(), blocks.end(), wanted))
      pages.push_back(fs::relative(page, root).string());
  };
  for (const auto &folder : {root, root / "docs", root / "docs/howto"})
    for (const auto &entry : fs::directory_iterator(folder))
      if (entry.is_regular_file())
        look_at(entry.path());
  std::sort(pages.begin(), pages.end());
  return pages;
}

std::vector<std::string> all_pages()
{
  return pages_with([](const Block &) { return true; });
}

// The words of a command, as far as documents use the shell: blanks part them, quotes join them, "#" ends them.
std::vector<std::string> words_of(const std::string &command)
{
  std::vector<std::string> words;
  std::string word;
  char quote   = 0;
  bool started = false;
  for (const char c : command) {
    if (quote ? c == quote : c == '"' || c == '\'') {
      quote   = quote ? 0 : c;
      started = true;
    } else if (!quote && c == '#' && !started)
      break;
    else if (!quote && (c == ' ' || c == '\t')) {
      if (started)
        words.push_back(word);
      word.clear();
      started = false;
    } else {
      word += c;
      started = true;
    }
  }
  if (started)
    words.push_back(word);
  return words;
}

// Commands of millstand in a block, also inside a loop.
std::vector<std::vector<std::string>> commands_of(const std::string &block)
{
  std::string joined = block;
  for (auto position = joined.find("\\\n"); position != std::string::npos;
       position      = joined.find("\\\n", position))
    joined.replace(position, 2, " ");
  std::vector<std::vector<std::string>> commands;
  std::istringstream lines(joined);
  for (std::string line; std::getline(lines, line);) {
    auto words       = words_of(line);
    const auto start = std::find(words.begin(), words.end(), "millstand");
    if (start != words.end() && start + 1 != words.end())
      commands.push_back({start + 1, words.end()});
  }
  return commands;
}

// Stands on coarse meshes with one cache for all pages, so that a page takes seconds; other kinds as they are.
void make_short_program(const fs::path &folder)
{
  const fs::path program = folder / "bin/millstand";
  fs::create_directories(program.parent_path());
  std::ofstream(program)
      << "#!/bin/sh\n"
         "stand=no\n"
         "for word in \"$@\"; do\n"
         "  case \"$word\" in\n"
         "  *.toml) grep -qs '^kind *= *\"four-high\"' \"$word\" && stand=yes ;;\n"
         "  esac\n"
         "done\n"
         "case \"$1 $stand\" in\n"
         "'run yes'|'stiffness yes'|'masses yes'|'modes yes'|'simulate yes'|'export yes'|'chatter yes'|'sweep "
         "yes')\n"
         "  set -- \"$@\" --cache '"
      << shared_cache()
      << "' --set contact.upper.elements_per_half_width=2 --set contact.lower.elements_per_half_width=2 "
         "--set contact.upper.samples=7 --set contact.lower.samples=7 --set bite.method=slab "
         "--set dynamics.output_rate='5 kHz' --set bearing.trb.roller_law=iso "
         "--set bearing.trb.rings=rigid ;;\n"
         "esac\n"
         "exec '" MILLSTAND_PROGRAM "' \"$@\"\n";
  fs::permissions(program, fs::perms::owner_all);
}

std::string slug(const std::string &page)
{
  std::string name = page;
  std::replace_if(
      name.begin(), name.end(), [](const char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
}

class DocumentCommands : public testing::TestWithParam<std::string> {};
}  // namespace

TEST_P(DocumentCommands, Run)
{
  const fs::path folder = scratch(slug(GetParam()));
  make_short_program(folder);
  fs::copy(root / "cases", folder / "cases", fs::copy_options::recursive);
  std::ostringstream script;
  script << "export PATH='" << (folder / "bin").string() << "':\"$PATH\"\n";
  for (const Block &block : blocks_of(root / GetParam()))
    if (block.not_run.empty())
      script << "(set -e\n"
             << block.commands << ")\ncode=$?\nif [ $code != " << block.exit << " ]; then echo \"" << GetParam()
             << ":" << block.line << ": exit code $code\" >&2; exit 1; fi\n";
  std::ofstream(folder / "commands.sh") << script.str();
  const Outcome outcome = shell("sh commands.sh", folder.string());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
}

INSTANTIATE_TEST_SUITE_P(Pages, DocumentCommands,
                         testing::ValuesIn(pages_with([](const Block &b) { return b.not_run.empty(); })),
                         [](const auto &page) { return slug(page.param); });

TEST(DocumentVerbs, AndOptionsOfEveryCommandExist)
{
  std::size_t seen = 0;
  std::map<std::string, std::string> help;
  for (const std::string &page : all_pages())
    for (const Block &block : blocks_of(root / page))
      for (const auto &words : commands_of(block.commands)) {
        const std::string &verb = words[0];
        if (verb[0] == '-')
          continue;
        ++seen;
        if (!help.count(verb)) {
          const Outcome outcome = millstand(verb + " --help");
          EXPECT_EQ(outcome.exit_code, 0) << page << ":" << block.line << ": millstand " << verb;
          help[verb] = outcome.out;
        }
        for (const std::string &word : words)
          if (word.compare(0, 2, "--") == 0 && word.size() > 2)
            EXPECT_NE(help[verb].find(word.substr(0, word.find('='))), std::string::npos)
                << page << ":" << block.line << ": millstand " << verb << " has no option " << word;
      }
  EXPECT_GT(seen, 20u) << "commands are no longer found";
}

TEST(DocumentBlocks, ThatDoNotRunSayWhy)
{
  std::size_t runs = 0;
  for (const std::string &page : all_pages())
    for (const Block &block : blocks_of(root / page)) {
      runs += block.not_run.empty();
      EXPECT_TRUE(block.not_run.empty() || block.not_run.size() > 10) << page << ":" << block.line;
    }
  EXPECT_GT(runs, 8u) << "most blocks are meant to run";
}
