// What check says of cases that can be read, word for word: tests/broken/check/NAME.toml against NAME.txt, the
// text on the console and its exit code.
#include "core/base/files.h"
#include "tests/support/program.h"
#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>

namespace fs = std::filesystem;

namespace {
std::vector<std::string> checked_case_names()
{
  std::vector<std::string> found;
  for (const auto &entry : fs::directory_iterator(MILLSTAND_SOURCE_DIR "/tests/broken/check"))
    if (entry.path().extension() == ".toml")
      found.push_back(entry.path().stem().string());
  std::sort(found.begin(), found.end());
  return found;
}

class CheckedCases : public testing::TestWithParam<std::string> {};
}  // namespace

TEST_P(CheckedCases, AreReportedWordForWord)
{
  const std::string stem = "tests/broken/check/" + GetParam();
  const Outcome check    = millstand("check " + stem + ".toml");
  EXPECT_EQ("exit code " + std::to_string(check.exit_code) + "\n" + check.out + check.err,
            mill::read_text(std::string(MILLSTAND_SOURCE_DIR) + "/" + stem + ".txt"));
}

INSTANTIATE_TEST_SUITE_P(Files, CheckedCases, testing::ValuesIn(checked_case_names()),
                         [](const testing::TestParamInfo<std::string> &info) {
                           std::string name = info.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });
