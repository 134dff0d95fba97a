// What the user sees of a mistake: place, line, caret.
#include "core/base/error_list.h"
#include "core/base/files.h"
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

using namespace mill;

namespace {
class Rendered : public testing::Test {
protected:
  std::string file = (std::filesystem::path(testing::TempDir()) / "errors_test.toml").string();
  void SetUp() override
  {
    write_atomically(file, "[work_roll]\n"
                           "barrel_diameter = \"420 mm\"\n"
                           "\n"
                           "[backup_roll]\n"
                           "\tbarrel_diameter = \"380 mm\"\n"
                           "# \u00b5\u00b5\u00b5 wrong\n");
  }
  void TearDown() override
  {
    std::filesystem::remove(file);
  }
};
}  // namespace

TEST_F(Rendered, AProblemShowsItsLineTheLineAboveAndACaret)
{
  EXPECT_EQ(render({{file, 2, 19}, "too large", {}}), file + ":2:19: error: too large\n"
                                                             "    1 | [work_roll]\n"
                                                             ">   2 | barrel_diameter = \"420 mm\"\n"
                                                             "      |                   ^");
}

// A text that was checked in the place of the file's is the one that is quoted.
TEST_F(Rendered, ATextInThePlaceOfAFileIsQuoted)
{
  const std::string path = file + "-shown";
  std::ofstream(path) << "# the file\n";
  mill::show_lines_of(path, "a = 1\nb = 2\n");
  EXPECT_EQ(render({{path, 1, 1}, "what", {}}), path + ":1:1: error: what\n"
                                                       ">   1 | a = 1\n"
                                                       "      | ^");
  std::filesystem::remove(path);
}

TEST_F(Rendered, AProblemInTheFirstLineShowsThatLine)
{
  EXPECT_EQ(render({{file, 1, 1}, "what", {}}, "warning"), file + ":1:1: warning: what\n"
                                                                  ">   1 | [work_roll]\n"
                                                                  "      | ^");
}

TEST_F(Rendered, ATabStaysATabAndColumnsCountCharacters)
{
  const std::string tab = render({{file, 5, 20}, "x", {}});
  EXPECT_NE(tab.find("      | \t                  ^"), std::string::npos) << tab;
  const std::string utf8 = render({{file, 6, 7}, "x", {}});
  EXPECT_NE(utf8.find("      |       ^"), std::string::npos) << utf8;
}

TEST_F(Rendered, AContradictionShowsBothPlacesWithTheirSections)
{
  Problem problem;
  problem.place   = {file, 5, 20};
  problem.message = "is smaller";
  problem.related.push_back({file, 2, 19});
  EXPECT_EQ(render(problem), file + ":5:20: error: is smaller\n"
                                    ">   2 | barrel_diameter = \"420 mm\"       # [work_roll]\n"
                                    "...\n"
                                    ">   5 | \tbarrel_diameter = \"380 mm\"      # [backup_roll]");
}

TEST_F(Rendered, WithoutAReadableFileOnlyTheMessageIsShown)
{
  EXPECT_EQ(render({{"no-such-file.toml", 3, 4}, "what", {}}), "no-such-file.toml:3:4: error: what");
  EXPECT_EQ(render({{"--set a.b=c"}, "what", {}}), "--set a.b=c: error: what");
  EXPECT_EQ(render({{}, "what", {}}), "error: what");
  EXPECT_EQ(render({{file, 99, 1}, "what", {}}), file + ":99:1: error: what");
}

TEST_F(Rendered, ALongLineIsCut)
{
  write_atomically(file, std::string(5000, 'x'));
  const std::string text = render({{file, 1, 4000}, "what", {}});
  EXPECT_LT(text.size(), 500u);
  EXPECT_NE(text.find(" ..."), std::string::npos);
}

TEST_F(Rendered, ALongListIsCutAndStatesTheRemainingNumber)
{
  std::vector<Problem> problems(200, Problem{{file, 2, 1}, "wrong", {{file, 1, 1}}});
  const std::string text = render_list(problems);
  EXPECT_EQ(text.substr(0, text.find('\n')), file + ":2:1: error: wrong");
  EXPECT_NE(text.find("\nand 150 more errors; mend these and check again\n"), std::string::npos);
  problems.resize(51);
  EXPECT_NE(render_list(problems).find("\nand 1 more error; mend"), std::string::npos);
  EXPECT_NE(std::string(InputError(problems).what()).find("\nand 1 more error; mend"), std::string::npos);
  EXPECT_EQ(InputError(problems).problems.size(), 51u);
  problems.resize(2);
  EXPECT_EQ(render_list(problems), render(problems[0]) + "\n" + render(problems[1]) + "\n");
}

TEST_F(Rendered, AMessageOfAMillionLettersIsCut)
{
  EXPECT_LT(render({{"--set " + std::string(1000000, 'k')}, std::string(1000000, 'm'), {}}).size(), 5000u);
}

TEST(Errors, ProblemsAreSortedByPlace)
{
  const InputError error(std::vector<Problem>{{{"b", 1, 1}, "fourth", {}},
                                              {{"a", 9, 1}, "third", {}},
                                              {{"a", 2, 5}, "second", {}},
                                              {{"a", 2, 1}, "first", {}}});
  ASSERT_EQ(error.problems.size(), 4u);
  EXPECT_EQ(error.problems[0].message, "first");
  EXPECT_EQ(error.problems[1].message, "second");
  EXPECT_EQ(error.problems[2].message, "third");
  EXPECT_EQ(error.problems[3].message, "fourth");
  EXPECT_STREQ(error.what(),
               "a:2:1: error: first\na:2:5: error: second\na:9:1: error: third\nb:1:1: error: fourth");
}

TEST(Errors, ASolverErrorKeepsItsReport)
{
  const SolverError error(
      {"contact upper: no convergence", "residual 3e-07", "coarse", "elements = 8", "6 steps"});
  EXPECT_STREQ(error.what(), "contact upper: no convergence");
  EXPECT_EQ(error.report.remedy, "elements = 8");
}
