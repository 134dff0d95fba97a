#include "core/case/bearing_inputs.h"
#include "core/case/chain_inputs.h"
#include "core/case/chatter_inputs.h"
#include "core/case/contact_inputs.h"
#include "core/case/moving_keys.h"
#include "core/case/provenance.h"
#include "core/case/stand_rows.h"
#include "core/records/record_text.h"
#include "core/records/rows_of_bite.h"
#include <cmath>
#include <gtest/gtest.h>

// Rows that are changed one by one, and which of them move a text.
namespace {
using namespace mill;

std::vector<double> other_numbers(const double now)
{
  std::vector<double> numbers;
  for (const Value &value : other_values(Kind::quantity, "mm", now))
    numbers.push_back(std::get<double>(value));
  return numbers;
}

Case changed_demo(const std::vector<std::string> &sets = {})
{
  return read_case("cases/four-high-1400.toml", sets);
}
}  // namespace

TEST(MovingKeys, OtherValuesDifferFromThePresentOne)
{
  EXPECT_EQ(other_numbers(2).size(), 3u);
  for (const double now : {2., -2., 0., 1e-9})
    for (const double other : other_numbers(now))
      EXPECT_NE(other, now);
  EXPECT_EQ(other_numbers(not_given), std::vector<double>{1});
  EXPECT_EQ(other_values(Kind::flag, "1", true), std::vector<Value>{false});
  const std::vector<Value> words{std::string("a"), std::string("c")};
  EXPECT_EQ(other_values(Kind::choice, "a | b | c", std::string("b")), words);
  EXPECT_NE(other_values(Kind::text, "text", std::string("trb")).at(0), Value(std::string("trb")));
  EXPECT_TRUE(other_values(Kind::text, "text", std::string()).empty()) << "a name that is not given names nothing";
  EXPECT_EQ(other_values(Kind::table, "mm, um", std::vector<std::array<double, 2>>()).size(), 1u);
}

TEST(MovingKeys, OneRowThatEntersATextMovesIt)
{
  MovingKeys keys(changed_demo().spec);
  const auto width = [](const CaseSpec &spec) { return record_text(std::get<FourHigh>(spec).strip.width); };
  EXPECT_EQ(keys.of("width", width), KeyList{"strip.width"});
  EXPECT_EQ(keys.of("once more", width), KeyList{"strip.width"}) << "every row is put back";
  EXPECT_EQ(width(keys.spec()), width(changed_demo().spec));
}

TEST(MovingKeys, NecksFollowTheLengthsOfTheWorkRollAlone)
{
  MovingKeys keys(changed_demo().spec);
  const auto neck = [](const CaseSpec &spec) {
    return record_text(std::get<FourHigh>(spec).work_roll.neck_length);
  };
  EXPECT_EQ(keys.of("neck", neck), (KeyList{"work_roll.barrel_length", "work_roll.total_length"}));
}

TEST(MovingKeys, AProfileThatIsRefusedBesideAnotherOneMovesNothing)
{
  MovingKeys keys(
      changed_demo({R"(backup_roll.crown_table=[["-700 mm", "0 um"], ["0 mm", "30 um"], ["700 mm", "0 um"]])"})
          .spec);
  const KeyList list = contact_keys(keys, "upper", 0);
  EXPECT_TRUE(holds(list, "backup_roll.crown_table"));
  EXPECT_FALSE(holds(list, "backup_roll.crown_polynomial"));
  EXPECT_FALSE(holds(list, "backup_roll.crown"));
  EXPECT_TRUE(holds(list, "work_roll.crown_table")) << "where none is given, either may be";
}

TEST(MovingKeys, AValueOfThePassReplacesThatOfTheStrip)
{
  MovingKeys keys(changed_demo({"pass.0.entry_thickness=7 mm"}).spec);
  EXPECT_FALSE(holds(bite_keys(keys, 0), "strip.entry_thickness"));
  EXPECT_TRUE(holds(bite_keys(keys, 0), "pass.0.entry_thickness"));
  EXPECT_TRUE(holds(bite_keys(keys, 1), "strip.entry_thickness"));
}

TEST(MovingKeys, SteelDoesNotMoveABodyWithItsOwn)
{
  const auto list = [](const std::vector<std::string> &sets) {
    MovingKeys keys(read_case("cases/two-cylinders.toml", sets).spec);
    return cylinder_keys(keys, BodyReading::pressed);
  };
  EXPECT_TRUE(holds(list({"upper.youngs_modulus=200 GPa"}), "steel.youngs_modulus"));
  const std::vector<std::string> both{"upper.youngs_modulus=200 GPa", "lower.youngs_modulus=200 GPa"};
  EXPECT_FALSE(holds(list(both), "steel.youngs_modulus"));
  EXPECT_TRUE(holds(list(both), "steel.poisson_ratio"));
}

TEST(MovingKeys, AVariantStatesItsNumbersAndThoseThatItLeavesToTheStand)
{
  MovingKeys keys(read_case("cases/chatter-two-stands.toml",
                            {R"(variant.stiff.stiffnesses=["9e10 N/m", "4e10 N/m", "6e10 N/m", "6e10 N/m", )"
                             R"("4e10 N/m", "9e10 N/m"])"})
                      .spec);
  const KeyList variant = variant_keys(keys, 0, 0), stand = chatter_keys(keys, 0, ChatterReading::search);
  EXPECT_TRUE(holds(variant, "variant.stiff.stiffnesses"));
  EXPECT_FALSE(holds(variant, "stand.stiffnesses"));
  EXPECT_FALSE(holds(variant, "variant.stiff.masses")) << "it is not given";
  EXPECT_TRUE(holds(variant, "stand.masses"));
  EXPECT_TRUE(holds(stand, "stand.stiffnesses"));
  EXPECT_FALSE(holds(stand, "variant.stiff.stiffnesses"));
}

TEST(MovingKeys, AFilmIsThatOfTheSectionThatGivesIt)
{
  MovingKeys keys(read_case("cases/chatter-two-stands.toml").spec);
  const KeyList bite = chatter_keys(keys, 1, ChatterReading::bite);
  EXPECT_TRUE(holds(bite, "oil.viscosity") && holds(bite, "oil.friction.mu0") && holds(bite, "condition.1.speed"));
  EXPECT_FALSE(holds(bite, "strip.friction.viscosity"));
  EXPECT_FALSE(holds(bite, "oil.film_range")) << "it is compared with the film alone";
  EXPECT_FALSE(holds(bite, "analysis.linearisation"));
  EXPECT_TRUE(holds(chatter_keys(keys, 1, ChatterReading::slopes), "analysis.linearisation"));
  EXPECT_FALSE(holds(chatter_keys(keys, 1, ChatterReading::search), "condition.1.speed"));
  EXPECT_FALSE(holds(chatter_keys(keys, 1, ChatterReading::growth), "analysis.speeds"));
}

TEST(MovingKeys, ADrawnPartOfTheFrameHasTheKeysOfItsDrawing)
{
  const auto list = [](const char *file, double Frame::*part) {
    MovingKeys keys(read_case(std::string("cases/") + file + ".toml").spec);
    return frame_keys(keys, {part}, ChainReading::run);
  };
  EXPECT_EQ(list("four-high-1400", &Frame::upper_post_stiffness), KeyList{"frame.upper_post_stiffness"});
  const KeyList post = list("four-high-drawn", &Frame::upper_post_stiffness),
                mass = list("four-high-drawn", &Frame::upper_post_mass);
  EXPECT_TRUE(holds(post, "housing.fillet_radius") && holds(post, "housing.post_width"));
  EXPECT_FALSE(holds(post, "frame.upper_post_stiffness") || holds(post, "housing.density"));
  EXPECT_TRUE(holds(mass, "housing.density"));
  EXPECT_EQ(list("four-high-drawn", &Frame::oil_column_stiffness),
            (KeyList{"screwdown.piston_diameter", "screwdown.stroke", "screwdown.oil_modulus"}));
}

// A measured modulus is a key of its own, where there is one.
TEST(MovingKeys, AFrameOnAMeasuredModulusHasItsKey)
{
  auto stand = std::get<FourHigh>(changed_demo().spec);
  EXPECT_FALSE(holds(MovingKeys(stand).all(), "frame.modulus"));
  stand.frame.modulus = 5e9;
  MovingKeys keys(stand);
  EXPECT_EQ(closure_keys(keys).front(), "frame.modulus");
}

// Force and torque grow with the width, speeds of the strip with that of the rolls; a derivative is that of the
// disturbed bite.
TEST(MovingKeys, AResultOfTheBiteReadsWidthAndSpeedByItsUnit)
{
  MovingKeys keys(changed_demo().spec);
  struct {
    const ResultRow &row;
    ChatterReading reading;
    bool width, speed;
  } const expected[] = {
      {row::bite::force, ChatterReading::bite, true, false},
      {row::bite::torque, ChatterReading::bite, true, false},
      {row::bite::friction, ChatterReading::bite, false, false},
      {row::bite::exit_speed, ChatterReading::bite, false, true},
      {row::bite_slope::force_by_gap, ChatterReading::slopes, true, false},
      {row::bite_slope::force_by_exit_tension, ChatterReading::slopes, true, false},
      {row::bite_slope::force_by_gap_rate, ChatterReading::slopes, true, true},
      {row::bite_slope::speed_by_gap, ChatterReading::slopes, false, true},
      {row::bite_slope::speed_by_gap_rate, ChatterReading::slopes, false, false},
  };
  for (const auto &[row, reading, width, speed] : expected) {
    const KeyList list = pass_bite_keys(keys, 0, reading, row);
    EXPECT_EQ(holds(list, "strip.width"), width) << row.name;
    EXPECT_EQ(holds(list, "pass.0.speed"), speed) << row.name;
    EXPECT_EQ(holds(list, "analysis.linearisation"), reading == ChatterReading::slopes) << row.name;
    EXPECT_TRUE(holds(list, "strip.entry_thickness")) << row.name;
    // The range of the search gives the speed where the case does not.
    EXPECT_EQ(holds(list, "analysis.speeds"), speed) << row.name;
    for (const char *idle : {"bite.theory", "bite.arc", "bite.method", "strip.youngs_modulus"})
      EXPECT_FALSE(holds(list, idle)) << row.name << " is by the slab theory of the search";
  }
}

TEST(MovingKeys, TheSpeedOfAPassMovesItsGrowthAndNotTheSearch)
{
  MovingKeys keys(changed_demo({"pass.0.speed=2 m/s"}).spec);
  const KeyList growth = stand_search_keys(keys, 0, ChatterReading::growth);
  const KeyList search = stand_search_keys(keys, 0, ChatterReading::search);
  EXPECT_TRUE(holds(growth, "pass.0.speed"));
  EXPECT_FALSE(holds(growth, "analysis.speeds"));
  EXPECT_FALSE(holds(search, "pass.0.speed"));
  EXPECT_TRUE(holds(search, "analysis.speeds"));
}

// sin(alpha) = D_pw / D_we tan(beta), (5.1), whatever the model of the bearing reads of it.
TEST(MovingKeys, TheClosingAngleFollowsRollerAndPitchDiameterAlone)
{
  for (const char *law : {"fe", "iso"}) {
    MovingKeys keys(
        read_case("cases/bearing-266.toml", {std::string("model.roller_law=") + law, "model.rings=rigid"}).spec);
    EXPECT_EQ(bearing_case_closing_angle_keys(keys),
              (KeyList{"bearing.trb.bore", "bearing.trb.outside_diameter", "bearing.trb.pitch_diameter",
                       "bearing.trb.roller_diameter", "bearing.trb.roller_cone_angle", "load.bearing"}))
        << law;
  }
}
