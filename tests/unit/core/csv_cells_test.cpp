// Cells of one line as RFC 4180 has them, and what recorders and spreadsheets make of it.
#include "core/base/csv_cells.h"
#include <gtest/gtest.h>
#include <vector>

using namespace mill;

namespace {
struct CellList {
  std::vector<std::string> texts;
  std::vector<std::size_t> begins;
  std::optional<csv::QuoteFault> fault;
};

CellList cut(const std::string &line, const char separator)
{
  CellList list;
  std::deque<std::string> unquoted;
  list.fault =
      csv::each_cell(line, separator, unquoted, [&](const std::string_view text, const std::size_t begin) {
        list.texts.emplace_back(text);
        list.begins.push_back(begin);
      });
  return list;
}
using Texts  = std::vector<std::string>;
using Begins = std::vector<std::size_t>;
}  // namespace

TEST(CsvCells, AreParsedAsRfc4180HasThem)
{
  const CellList list = cut("1 , \"a \"\"b\"\", c\" ,\"\",\"\"\"\", d\"e\",", ',');
  EXPECT_EQ(list.texts, (Texts{"1", "a \"b\", c", "", "\"", "d\"e\"", ""}));
  EXPECT_EQ(list.begins, (Begins{0, 4, 18, 21, 27, 32}));
  EXPECT_FALSE(list.fault);
  EXPECT_EQ(cut("", ',').texts, Texts{""});
  EXPECT_EQ(cut("a\t\"b\"\t\tc\r", '\t').texts, (Texts{"a", "b", "", "c"}));
  EXPECT_EQ(cut("  1   \"2 3\" 4  ", ' ').texts, (Texts{"1", "2 3", "4"}));
}

TEST(CsvCells, SayWhichQuoteIsWrong)
{
  const CellList open = cut("a,\"b,c", ',');
  EXPECT_EQ(open.texts, (Texts{"a", "b,c"}));
  ASSERT_TRUE(open.fault);
  EXPECT_EQ(open.fault->position, 2u);
  const CellList followed = cut("a,\"b\" x,c", ',');
  EXPECT_EQ(followed.texts, (Texts{"a", "b", "c"}));
  ASSERT_TRUE(followed.fault);
  EXPECT_EQ(followed.fault->position, 6u);
}
