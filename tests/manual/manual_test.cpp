#include "tests/manual/groups.h"
#include "tests/manual/manual.h"
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <sstream>

// Every case of the manual passes, and docs/verification.md shows it with the numbers of now.
using namespace mill::verify;

namespace {
// Cells of the table of checks in the section of a case, row by row.
std::vector<std::vector<std::string>> rows_on_the_page(const std::string &name)
{
  std::ifstream in(std::string(MILLSTAND_SOURCE_DIR) + "/docs/verification.md");
  std::vector<std::vector<std::string>> rows;
  bool here = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("## ", 0) == 0)
      here = line == "## " + name;
    const auto cells = cells_of_line(line);
    if (here && cells.size() == 7 && cells[0] != "quantity")
      rows.push_back(cells);
  }
  return rows;
}

// A result as the page writes it: a number, or "below 1e-12".
double number_in(const std::string &cell)
{
  const std::string below = "below ";
  return std::stod(cell.rfind(below, 0) == 0 ? cell.substr(below.size()) : cell);
}

void expect_same(const std::vector<std::string> &row, const Check &check, const std::string &where)
{
  const CheckText now = check_text(check);
  EXPECT_EQ(row[0], table_cell(now.quantity)) << where;
  EXPECT_EQ(row[2], table_cell(now.unit)) << where << now.quantity;
  EXPECT_EQ(row[3], now.reference) << where << now.quantity;
  EXPECT_EQ(row[5], now.tolerance) << where << now.quantity;
  EXPECT_EQ(row[6], now.verdict) << where << now.quantity;
  if (row[1] != now.result)
    EXPECT_LE(std::abs(number_in(row[1]) - check.result), allowed_change(check) * (1 + 1e-6))
        << where << now.quantity << ": " << row[1] << " on the page, " << now.result << " now";
}

void expect_on_the_page(const Outcome &outcome)
{
  const std::string where = "docs/verification.md is out of date, write it again with millstand verify --markdown "
                            "docs/verification.md: " +
                            outcome.page.name + ", ";
  const auto rows = rows_on_the_page(outcome.page.name);
  ASSERT_EQ(rows.size(), outcome.checks.size()) << where << "number of checks";
  for (std::size_t i = 0; i < rows.size(); ++i)
    expect_same(rows[i], outcome.checks[i], where);
}
}  // namespace

// A group in the usual form of the suite, or what "ctest -C long" adds to it.
struct PartOfGroup {
  Group group;
  bool long_form;
  std::vector<Case> cases() const
  {
    std::vector<Case> some;
    for (const Case &c : cases_of(group))
      if (c.long_form == long_form)
        some.push_back(c);
    return some;
  }
};

std::vector<PartOfGroup> parts(const bool long_form)
{
  std::vector<PartOfGroup> some;
  for (const Group &group : groups())
    if (const PartOfGroup part{group, long_form}; !part.cases().empty())
      some.push_back(part);
  return some;
}

class GroupOfCases : public testing::TestWithParam<PartOfGroup> {};

TEST_P(GroupOfCases, Passes)
{
  for (const Case &c : GetParam().cases()) {
    const Outcome outcome = run(c);
    if (!outcome.skipped.empty())
      GTEST_SKIP() << c.name << " " << outcome.skipped;
    EXPECT_TRUE(passes(outcome)) << outcome_text(outcome);
    expect_on_the_page(outcome);
  }
}

const auto name_of_group = [](const auto &part) { return part.param.group.name; };
INSTANTIATE_TEST_SUITE_P(Manual, GroupOfCases, testing::ValuesIn(parts(false)), name_of_group);
INSTANTIATE_TEST_SUITE_P(Long, GroupOfCases, testing::ValuesIn(parts(true)), name_of_group);
