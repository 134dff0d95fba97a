// millstand report A B: how sure the difference of two runs is.
#include "core/base/files.h"
#include "tests/support/program.h"
#include <gtest/gtest.h>
#include <string>

namespace {
// The row of a result in the table of differences.
std::string row_of(const std::string &page, const std::string &result)
{
  const auto name = page.find("<code>" + result + "</code>");
  if (name == std::string::npos)
    return "";
  return page.substr(name, page.find("</tr>", name) - name);
}
}  // namespace

TEST(ComparisonOfRuns, TwoRunsThatDifferByK4OnlyHaveCertainDifferences)
{
  const std::string folder = scratch("k4-only");
  const std::string stand =
      "modes " + std::string(MILLSTAND_SOURCE_DIR) +
      "/cases/published-1400.toml -q --set dynamics.force_meaning=disturbance --set given.C='0 "
      "N s/m' --set 'given.K3_tolerance=\"5 %\"' ";
  for (const std::string K4 : {"17", "18"})
    ASSERT_EQ(millstand(stand + "--set 'given.K4=\"" + K4 + "000 kN/mm\"' -o " + K4, folder).exit_code, 0);
  ASSERT_EQ(millstand("report 17 18 -o page.html", folder).exit_code, 0);
  const std::string page = mill::read_text(folder + "/page.html");
  int differ             = 0;
  for (int i = 1; i <= 6; ++i) {
    const std::string row = row_of(page, "f" + std::to_string(i));
    if (row.empty())
      continue;
    ++differ;
    EXPECT_NE(row.find("certain: follows from <code>given.K4</code>"), std::string::npos) << row;
  }
  EXPECT_GE(differ, 2) << "a spring in the gap moves modes of both work rolls";
  EXPECT_EQ(page.find("within the accuracy"), std::string::npos);
  EXPECT_NE(page.find("1 input differs; "), std::string::npos);
  EXPECT_NE(page.find(" with certainty"), std::string::npos);
}
