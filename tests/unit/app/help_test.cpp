// What `millstand help` says, and the manual page: from the pages of docs/ and the command line's own description.
#include "app/help/embedded.h"
#include "app/help/page_text.h"
#include "app/help/topics.h"
#include "tests/support/refusal.h"
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <sstream>

using namespace mill;
namespace fs = std::filesystem;

namespace {
const std::vector<DescribedVerb> verbs{{"run",
                                        "the whole chain and the report",
                                        {{{"CASE"}, false, true, true, "case file", {}},
                                         {{"-o", "--output"}, true, true, false, "folder of the results", {}}}},
                                       {"sweep", "one table", {}}};

std::string help_of(const std::string &topic)
{
  return help::topic_text(topic, verbs);
}

std::string text_of(const fs::path &file)
{
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::size_t longest_line(const std::string &text)
{
  std::size_t longest = 0;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    longest = std::max(longest, line.size());
  return longest;
}
}  // namespace

TEST(Help, EveryHowtoPageIsATopicAndTheListNamesIt)
{
  const std::string list = help_of("");
  int pages              = 0;
  for (const auto &entry : fs::directory_iterator(fs::path(MILLSTAND_SOURCE_DIR) / "docs/howto")) {
    const std::string name = entry.path().stem().string(), page = text_of(entry.path());
    const std::string title = page.substr(2, page.find('\n') - 2);
    EXPECT_EQ(help_of(name).find(title), 0u) << name;
    EXPECT_NE(list.find("    " + name), std::string::npos) << name;
    EXPECT_NE(list.find(title), std::string::npos) << name;
    ++pages;
  }
  EXPECT_GE(pages, 9);
  EXPECT_NE(list.find("run                      the whole chain and the report"), std::string::npos) << list;
}

TEST(Help, PagesInTheProgramAreThoseOfTheTree)
{
  for (const help::EmbeddedFile &file : help::named_files()) {
    const fs::path docs = fs::path(MILLSTAND_SOURCE_DIR) / "docs";
    const fs::path page = docs / (std::string(file.name) + ".md"), howto = docs / "howto" / page.filename();
    EXPECT_EQ(file.text(), text_of(fs::exists(howto) ? howto : page)) << file.name;
  }
}

TEST(Help, AVerbIsFoundWithItsActionToo)
{
  EXPECT_EQ(help_of("sweep all"), help_of("sweep"));
}

TEST(Help, AKeyThatKindsShareIsShownOnce)
{
  const std::string keys = help_of("stiffness");
  std::set<std::string> entries;
  for (std::size_t begin = keys.find("key "); begin != std::string::npos;) {
    const std::size_t next = keys.find("\nkey ", begin + 1);
    EXPECT_TRUE(entries.insert(keys.substr(begin, next - begin)).second) << keys.substr(begin, next - begin);
    begin = next == std::string::npos ? next : next + 1;
  }
  EXPECT_GT(entries.size(), 3u);
}

TEST(Help, ATermAResultAndAKeyAreExplained)
{
  EXPECT_EQ(help_of("Crown").rfind("crown\n    diameter at mid-length minus diameter at the barrel end\n", 0), 0u)
      << help_of("Crown");
  const std::string result = help_of("K3.tangent");
  EXPECT_EQ(result.rfind("result K3.tangent [N/m]\n    Contact of the rolls: ", 0), 0u) << result;
  EXPECT_NE(help_of("K3").find("result K3 [N/m]"), std::string::npos);
  EXPECT_NE(help_of("K3").find("result K3.secant [N/m]"), std::string::npos);
  EXPECT_EQ(help_of("K3").find("result KN"), std::string::npos) << "its name is there as such";
  EXPECT_NE(help_of("Kzc2.tilting").find("result Kzc2.tilting [N m/rad]\n"), std::string::npos)
      << help_of("Kzc2.tilting");
  EXPECT_EQ(
      help_of("contact.upper.half_width"),
      "result contact.upper.half_width [m]\n    Contact of the rolls in detail: upper contact (K3), half width "
      "of the contact at\n    mid-length; theory 1.4\n");
  EXPECT_NE(help_of("contact.lower").find("result contact.lower.joint.yy [N/m]"), std::string::npos);
  EXPECT_EQ(help_of("finish.K3.tangent").rfind("result finish.K3.tangent [N/m]\n", 0), 0u);
  const std::string key = help_of("work_roll.barrel_diameter");
  EXPECT_EQ(key.rfind("key work_roll.barrel_diameter = ", 0), 0u) << key;
  EXPECT_EQ(key.find("\nkey "), std::string::npos) << key;
  EXPECT_NE(help_of("bearing.trb.bore").find("key bearing.NAME.bore = "), std::string::npos)
      << help_of("bearing.trb.bore");
  EXPECT_NE(help_of("barrel_diameter").find("key backup_roll.barrel_diameter = "), std::string::npos);
}

TEST(Help, AnUnknownTopicNamesTheNearestOne)
{
  EXPECT_EQ(refusal([] { help_of("crown-studi"); }),
            "no help is available for 'crown-studi'; did you mean 'crown-study'?; a list: millstand help");
}

TEST(Help, APageIsPlainTextForATerminal)
{
  const std::string page = help::page_text("# Title\n\nA [link](other.md) and **strong** words.\n\n"
                                           "<!-- not run: no -->\n```sh\nmillstand run a.toml\n```\n\n"
                                           "| a | b |\n|---|---|\n| `x \\| y` | z |\n");
  EXPECT_EQ(page, "Title\n\nA link and strong words.\n\n    millstand run a.toml\n\n    `x | y`\n        z\n");
  std::string words;
  for (int i = 0; i < 60; ++i)
    words += "word ";
  EXPECT_LE(longest_line(help::paragraph(words, 4)), 88u);
  EXPECT_GT(longest_line(help::paragraph(words, 4)), 80u);
}

TEST(ManualPage, HasEveryVerbAndOptionInTheWordsOfTheCommandLine)
{
  const std::string page = manual_page(verbs, "From a drawing.", "0.1.0");
  EXPECT_EQ(page.rfind(".TH MILLSTAND 1 \"\" \"millstand 0.1.0\"", 0), 0u) << page;
  EXPECT_NE(page.find(".SS run CASE [options]\nthe whole chain and the report.\n"), std::string::npos) << page;
  EXPECT_NE(page.find(".TP\n.B \\-o, \\-\\-output VALUE\nfolder of the results\n"), std::string::npos) << page;
}
