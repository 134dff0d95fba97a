// Parts of one stand against each other, word for word: what cannot be is refused, what hardly is is a warning.
#include "core/model/case.h"
#include "tests/support/refusal.h"
#include <gtest/gtest.h>

using namespace mill;

namespace {
using Sets = std::vector<std::string>;

std::string refused(const Sets &sets, const char *file = "cases/four-high-1400.toml")
{
  return refusals([&] { read_case(file, sets); });
}

std::string warned(const Sets &sets, const char *file = "cases/four-high-1400.toml")
{
  std::string text;
  for (const Warning &warning : read_case(file, sets).warnings)
    text += (text.empty() ? "" : "\n") + text_of(warning);
  return text;
}

const Sets backup_drawn{"bearing.crb.bore=950 mm", "bearing.crb.outside_diameter=1150 mm",
                        "bearing.crb.width=520 mm"};

Sets with(Sets sets, const Sets &more)
{
  sets.insert(sets.end(), more.begin(), more.end());
  return sets;
}
}  // namespace

TEST(StandConsistency, TheCasesOfTheTreeAreConsistent)
{
  EXPECT_EQ(warned({}), "");
  EXPECT_EQ(warned({}, "cases/four-high-drawn.toml"), "");
}

TEST(StandConsistency, ANeckMustFitIntoItsBearing)
{
  EXPECT_EQ(refused({"work_roll.neck_diameter=280 mm"}),
            "work_roll.neck_diameter = \"280 mm\" does not fit into bearing.trb, whose bore is 266.7 mm; for a "
            "stepped neck give the seat of the bearing");
  EXPECT_EQ(warned({"work_roll.neck_diameter=200 mm"}),
            "work_roll.neck_diameter = \"200 mm\" is loose in bearing.trb, whose bore is 266.7 mm");
  EXPECT_EQ(warned({"work_roll.neck_diameter=260 mm"}), "");
}

TEST(StandConsistency, ABearingMustBeOnTheNeck)
{
  EXPECT_EQ(
      refused({"work_roll.bearing_span=1500 mm"}),
      "work_roll.bearing_span = \"1500 mm\" puts bearing.trb, 230.19 mm wide, into the barrel: its centre is 50 "
      "mm from the barrel end");
  EXPECT_EQ(
      warned({"work_roll.bearing_span=2200 mm"}),
      "work_roll.bearing_span = \"2200 mm\" lets bearing.trb, 230.19 mm wide, stand out beyond the end of the "
      "roll: its centre is 400 mm from the barrel end, and the neck 460 mm long");
}

// Of a bearing without a width: four rows of 110 mm, half of which is 220 mm; a film of 700 mm, half of it 350 mm.
TEST(StandConsistency, RowsOrFilmInTheBarrelAreAWarning)
{
  EXPECT_EQ(warned({"backup_roll.bearing_span=1500 mm"}),
            "backup_roll.bearing_span = \"1500 mm\" puts bearing.crb into the barrel: its 4 rows of rollers are "
            "together 440 mm long, its centre is 50 mm from the barrel end; give a larger span");
  EXPECT_EQ(warned({"backup_roll.bearing_span=1840 mm"}), "") << "they end at the barrel";
  const Sets film{"bearing.film.type=oil-film",
                  "bearing.film.diameter=950 mm",
                  "bearing.film.length=700 mm",
                  "bearing.film.clearance=0.45 mm",
                  "bearing.film.viscosity=[['40 degC', '0.4 Pa s'], ['100 degC', '0.027 Pa s']]",
                  "backup_roll.bearing=film",
                  "pass.0.speed=5 m/s",
                  "pass.1.speed=5 m/s"};
  const auto warnings = [&](const char *span) { return warned(with(film, {span})); };
  EXPECT_EQ(warnings("backup_roll.bearing_span=2000 mm")
                .find("backup_roll.bearing_span = \"2000 mm\" puts bearing.film into the barrel: its oil film is "
                      "700 mm long, its centre is 300 mm from the barrel end; give a larger span"),
            0u)
      << warnings("backup_roll.bearing_span=2000 mm");
  EXPECT_EQ(warnings("backup_roll.bearing_span=2100 mm").find("into the barrel"), std::string::npos);
}

TEST(StandConsistency, ChocksAndRollsMustFitIntoTheWindow)
{
  const char *drawn = "cases/four-high-drawn.toml";
  EXPECT_EQ(
      refused({"bearing.trb.chock_width=1700 mm"}, drawn),
      "bearing.trb.chock_width = \"1700 mm\" does not go into the window of the housing, which is 1650 mm wide");
  EXPECT_EQ(
      refused({"backup_roll.barrel_diameter=1700 mm"}, drawn),
      "backup_roll.barrel_diameter = \"1700 mm\" does not pass through the window of the housing, which is 1650 "
      "mm wide");
  EXPECT_EQ(
      warned(with(backup_drawn, {"bearing.crb.rings=elastic"}), drawn),
      "housing.window_width = \"1650 mm\" is narrower than the 1955 mm assumed for the chock of bearing.crb; "
      "give its chock_width");
  EXPECT_EQ(
      refused({"housing.window_height=3000 mm"}, drawn),
      "housing.window_height = \"3000 mm\" is too low: the axes of the backup rolls are 2290 mm apart, and half a "
      "neck of 950 mm lies beyond each; 3240 mm at least");
}

// Half of (560 + 1500) mm against (420 + 1450)/2 mm between the axes.
TEST(StandConsistency, OverlappingChocksAreAWarning)
{
  EXPECT_EQ(
      warned(with(backup_drawn, {"bearing.crb.chock_height=1500 mm", "bearing.crb.chock_width=1600 mm",
                                 "bearing.crb.chock_length=600 mm"})),
      "bearing.trb.chock_height = \"560 mm\" and the chock of the backup roll overlap by 95 mm: half of both "
      "heights is 1030 mm, the axes are 935 mm apart; this is possible only where one chock lies between the legs "
      "of the other");
  EXPECT_EQ(warned(with(backup_drawn, {"bearing.crb.chock_height=1305 mm", "bearing.crb.chock_width=1600 mm",
                                       "bearing.crb.chock_length=600 mm"})),
            "");
}

TEST(StandConsistency, ALoadOfAnotherOrderIsAWarning)
{
  EXPECT_EQ(
      warned({"pass.0.load=976 kN", "backup_roll.bearing_load=20 MN"})
          .find(
              "backup_roll.bearing_load = \"20 MN\" is 40.98 times half the rolling force of pass.0.load = \"976 "
              "kN\"; is one of the two in another unit?"),
      0u);
  EXPECT_EQ(warned({"pass.0.load=976 kN", "backup_roll.bearing_load=488 kN", "work_roll.bearing_load=49 kN"}), "");
}
