#include "app/study/varied_key.h"
#include "core/model/case.h"
#include "tests/support/near.h"
#include <gtest/gtest.h>

namespace {
using namespace mill;

const Case &demo()
{
  static const Case the_case = read_case(MILLSTAND_SOURCE_DIR "/cases/four-high-1400.toml");
  return the_case;
}

VariedKey read(const std::string &written)
{
  return varied_key(demo(), {}, written);
}

std::string refusal(const std::string &written)
{
  try {
    read(written);
  } catch (const InputError &e) {
    return e.problems.empty() ? e.what() : e.problems.front().message;
  }
  return "accepted";
}

TEST(VariedKey, UnitBehindTheLastValueBelongsToAll)
{
  const VariedKey key = read("backup_roll.crown=0, 50,100 um");
  EXPECT_EQ(key.values, (std::vector<std::string>{"0 um", "50 um", "100 um"}));
  EXPECT_EQ(key.numbers, (std::vector<double>{0, 50, 100}));
  EXPECT_EQ(key.unit, "um");
}

TEST(VariedKey, UnitsMayDifferAndTheAxisHasTheLast)
{
  const VariedKey key = read("backup_roll.crown=50 um,0.1 mm");
  EXPECT_EQ(key.values, (std::vector<std::string>{"50 um", "0.1 mm"}));
  EXPECT_EQ(key.unit, "mm");
  EXPECT_TRUE(near(key.numbers[0], 0.05, within(1e-14, "50 um in mm, one division in double precision")));
}

TEST(VariedKey, IntervalHoldsBothEndsInEqualSteps)
{
  for (const char *written :
       {"backup_roll.crown=0..200 um:21", "backup_roll.crown=0 um..0.2 mm:21", "backup_roll.crown=0..200:21 um"}) {
    const VariedKey key = read(written);
    ASSERT_EQ(key.values.size(), 21u) << written;
    EXPECT_EQ(key.numbers.front(), 0) << written;
    EXPECT_TRUE(near(key.numbers[7] / key.numbers[20], 0.35,
                     within(1e-14, "step 7 of 20 equal steps, one division in double precision")))
        << written;
  }
}

TEST(VariedKey, WordsAndPureNumbersNeedNoUnit)
{
  const VariedKey model = read("backup_roll.bending_model=solid,beam");
  EXPECT_EQ(model.values, (std::vector<std::string>{"solid", "beam"}));
  EXPECT_TRUE(std::isnan(model.numbers[0]));
  EXPECT_EQ(read("steel.poisson_ratio=0.28,0.3").unit, "");
}

TEST(VariedKey, RefusalsNameTheFaultAndTheRemedy)
{
  EXPECT_EQ(refusal("backup_roll.crwn=0,50 um"), "unknown key 'backup_roll.crwn' in " MILLSTAND_SOURCE_DIR
                                                 "/cases/four-high-1400.toml; did you mean 'backup_roll.crown'?");
  EXPECT_EQ(refusal("backup_roll.crown=0,50"),
            "--vary backup_roll.crown=0,50: 0 has no unit; a length is needed, for example \"0 um\"");
  EXPECT_EQ(refusal("backup_roll.crown=0,50 kN"),
            "--vary backup_roll.crown=0,50 kN: 0 kN is a force; a length is needed, for example \"0 um\"");
  EXPECT_EQ(refusal("backup_roll.crown=200..0 um:5"),
            "--vary backup_roll.crown=200..0 um:5: the interval is reversed; write the lower end first");
  EXPECT_EQ(refusal("backup_roll.crown=50..50 um:5"),
            "--vary backup_roll.crown=50..50 um:5: the interval is empty: both ends are the same");
  EXPECT_EQ(refusal("backup_roll.crown=0..200 um"),
            "--vary backup_roll.crown=0..200 um: an interval needs its number "
            "of values, for example 0..200 um:11");
  EXPECT_EQ(refusal("backup_roll.crown=0..200 um:1"),
            "--vary backup_roll.crown=0..200 um:1: 1 is not a number of values between 2 and 100000");
  EXPECT_EQ(refusal("backup_roll.crown=0 um,0 um"),
            "--vary backup_roll.crown=0 um,0 um: the value 0 um is there twice");
  EXPECT_EQ(refusal("backup_roll.crown"),
            "--vary \"backup_roll.crown\" is not of the form KEY=a,b,c or KEY=lo..hi:n");
}

TEST(VariedKey, OneKeyIsVariedOnce)
{
  EXPECT_THROW(varied_keys(demo(), {}, {"backup_roll.crown=0,50 um", "backup_roll.crown=60,70 um"}), InputError);
}
}  // namespace
