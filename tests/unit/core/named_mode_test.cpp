// What the method of a result mode.* says of its mode, written and read back.
#include "core/records/named_mode.h"
#include <gtest/gtest.h>

using namespace mill;

TEST(NamedModes, AreReadAsTheyWereWritten)
{
  const NamedMode written{"gap mode, first kind (third octave)",
                          "work roll with its backup roll in the lower stack (64 % of the kinetic energy); 3 % of "
                          "the static compliance of the gap",
                          "rolls as beams"};
  const std::string method = mode_method(written);
  EXPECT_EQ(method, "gap mode, first kind (third octave): work roll with its backup roll in the lower stack (64 % "
                    "of the kinetic energy); 3 % of the static compliance of the gap; rolls as beams");
  const NamedMode read = named_mode_of(method);
  EXPECT_EQ(read.name, written.name);
  EXPECT_EQ(read.why, written.why) << "a semicolon may be in the numbers that decided";
  EXPECT_EQ(read.model, written.model);
}

TEST(NamedModes, ATextWithoutPartsIsAllName)
{
  const NamedMode read = named_mode_of("six-mass chain");
  EXPECT_EQ(read.name, "six-mass chain");
  EXPECT_EQ(read.why, "");
  EXPECT_EQ(read.model, "");
}

TEST(NamedModes, TheKindOfAGapModeIsThatOfItsKey)
{
  EXPECT_EQ(gap_kind_of("gap_first_kind"), ResultWord::gap_first_kind);
  EXPECT_EQ(gap_kind_of("gap_second_kind_roll_lower_work_roll"), ResultWord::gap_second_kind);
  EXPECT_FALSE(gap_kind_of("frame_lower"));
  EXPECT_FALSE(gap_kind_of("gap_first_kindred")) << "the word ends there, or at a part";
}
