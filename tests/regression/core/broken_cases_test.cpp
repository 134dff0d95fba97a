// Broken cases, word for word: tests/broken/NAME.toml must be refused with exactly the text of NAME.txt, every
// problem of the file in one go and sorted by place.  The texts were read and accepted line by line when they were
// written; whoever changes one says in the change note why the new one helps the user more.
#include "core/base/files.h"
#include "core/model/case.h"
#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>

using namespace mill;
namespace fs = std::filesystem;

namespace {
std::vector<std::string> broken_cases()
{
  std::vector<std::string> names;
  for (const auto &entry : fs::directory_iterator(MILLSTAND_SOURCE_DIR "/tests/broken"))
    if (entry.path().extension() == ".toml")
      names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class BrokenCases : public testing::TestWithParam<std::string> {};

std::string test_name(const testing::TestParamInfo<std::string> &info)
{
  std::string name = info.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}
}  // namespace

TEST_P(BrokenCases, AreRefusedWordForWord)
{
  const std::string stem = "tests/broken/" + GetParam();
  try {
    read_case(stem + ".toml");
    FAIL() << stem << ".toml was accepted";
  } catch (const InputError &error) {
    std::string text;
    for (const Problem &problem : error.problems)
      text += render(problem) + "\n";
    EXPECT_EQ(text, read_text(stem + ".txt"));
    EXPECT_TRUE(std::is_sorted(error.problems.begin(), error.problems.end(),
                               [](const Problem &a, const Problem &b) { return a.place < b.place; }));
  }
}

INSTANTIATE_TEST_SUITE_P(All, BrokenCases, testing::ValuesIn(broken_cases()), test_name);

TEST(BrokenCases, ThereAreEnoughBrokenCases)
{
  EXPECT_GE(broken_cases().size(), 20u) << "is the folder of the broken cases complete?";
}
