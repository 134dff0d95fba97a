#include "app/study/study_table.h"
#include <gtest/gtest.h>

// Heads of columns of results.csv: names of passes and bearings come from the case.
using namespace mill;

TEST(StudyTable, HeadsAreQuotedWhereTheyHoldASeparator)
{
  EXPECT_EQ(column_head("K3", "N/m"), "K3 [N/m]");
  EXPECT_EQ(column_head("bite.pass 1.friction", "1"), "bite.pass 1.friction");
  EXPECT_EQ(column_head("a,b", "kN"), "\"a,b [kN]\"");
  EXPECT_EQ(column_head("a;b", ""), "\"a;b\"");
}

TEST(StudyTable, HiddenCharactersOfAHeadAreWrittenOut)
{
  EXPECT_EQ(column_head("pass\x1b[2J 1.force", "N"), "\"pass\\x1b[2J 1.force [N]\"");
  EXPECT_EQ(column_head("pass\u202e 1.force", "N"), "\"pass\\u202e 1.force [N]\"");
}
