#include "core/base/errors.h"
#include "reduce/bearing/chock_supports.h"
#include "reduce/bearing/geometry.h"
#include "reduce/bearing/ring_sections.h"
#include "tests/support/demo_bearing.h"
#include "tests/support/near.h"
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

using namespace mill;
using bearing::ring_sections;

namespace {
constexpr double mm = 1e-3, degree = M_PI / 180;

RollerBearing mill_bearing()
{
  RollerBearing b       = demo_bearing();
  b.chock_width         = 600 * mm;
  b.chock_height        = 560 * mm;
  b.chock_length        = 260 * mm;
  b.chock_support_width = 300 * mm;
  return b;
}

// The message of the error that a changed bearing gives.
std::string message(const std::function<void(RollerBearing &)> &change, const bearing::RacewayDatum &datum = {})
{
  RollerBearing b = mill_bearing();
  change(b);
  try {
    ring_sections(b, datum);
  } catch (const InputError &e) {
    return e.what();
  }
  return "no error";
}

void expect_says(const std::string &text, const std::vector<std::string> &parts)
{
  for (const std::string &part : parts)
    EXPECT_NE(text.find(part), std::string::npos) << "\"" << part << "\" in: " << text;
}

// Where the contact line meets the axis.
double apex(const RacewayLine &line)
{
  return line.middle[1] - line.middle[0] * line.along[1] / line.along[0];
}
}  // namespace

TEST(RingSections, RacewaysOfARowMeetInOneApexWithTheRollers)
{
  RollerBearing b = mill_bearing();
  const auto closed =
      bearing::apex_closure(bearing::pitch_diameter(b), b.roller_diameter, b.roller_cone_angle, 39);
  b.cup_angle  = closed.cup_angle;
  const auto s = ring_sections(b);
  const auto z = bearing::row_positions(b);
  for (std::size_t r = 0; r < 4; ++r) {
    const double hand   = r % 2 == 0 ? 1 : -1;
    const double roller = z[Eigen::Index(r)] + hand * bearing::pitch_diameter(b) / 2 / std::tan(closed.axis_angle);
    EXPECT_TRUE(
        near(apex(s.cup.raceways[r]), roller, within_absolute(1e-12, "m, rounding of lengths of a metre")));
    EXPECT_TRUE(
        near(apex(s.cone.raceways[r]), roller, within_absolute(1e-12, "m, rounding of lengths of a metre")));
  }
}

TEST(RingSections, RacewaysAreARollerDiameterApart)
{
  const auto s = ring_sections(mill_bearing());
  for (std::size_t r = 0; r < 4; ++r) {
    EXPECT_TRUE(near((s.cup.raceways[r].middle - s.cone.raceways[r].middle).norm(), 21.5 * mm,
                     within_absolute(1e-12, "m, rounding of lengths of a metre")));
    EXPECT_TRUE(near(s.cup.raceways[r].normal.dot(s.cup.raceways[r].along), 0,
                     within_absolute(1e-15, "unit vectors at a right angle, rounding")));
    EXPECT_GT(s.cup.raceways[r].along[1], 0);
  }
  // (355.6 - 311.15 - 21.5 cos 18.41 deg) / 2 / cos 19.66 deg
  EXPECT_TRUE(near(bearing::ring_wall(s.cup),
                   (177.8 - 155.575 - 10.75 * std::cos(18.41 * degree)) * mm / std::cos(19.66 * degree),
                   within_absolute(1e-12, "m, rounding of lengths of a metre")));
  EXPECT_EQ(s.cup.depth, bearing::ring_wall(s.cup));
  EXPECT_EQ(s.cone.land, s.cup.land);
}

TEST(RingSections, CylindricalRacewaysRunAlongTheAxis)
{
  RollerBearing b     = mill_bearing();
  b.roller_cone_angle = b.cup_angle = 0;
  const auto s                      = ring_sections(b);
  EXPECT_EQ(s.cup.raceways[1].along, Eigen::Vector2d(0, 1));
  EXPECT_TRUE(near(s.cup.raceways[1].middle[0], (311.15 + 21.5) / 2 * mm,
                   within_absolute(1e-15, "m, rounding of lengths of a metre")));
  EXPECT_TRUE(near(s.cone.raceways[1].middle[0], (311.15 - 21.5) / 2 * mm,
                   within_absolute(1e-15, "m, rounding of lengths of a metre")));
}

TEST(RingSections, RefusesRowsThatOverlapWithTheNumbers)
{
  expect_says(message([](auto &b) { b.roller_length = 70 * mm; }), {"rows", "overlap", "mm apart"});
  expect_says(message([](auto &b) { b.width = 100 * mm; }), {"rows", "overlap", "the raceways are"});
}

TEST(RingSections, RefusesARacewayOutsideItsRing)
{
  expect_says(message([](auto &b) {
                b.outside_diameter = 340 * mm;
                b.pitch_diameter   = 311.15 * mm;
              }),
              {"cup", "outside the outside diameter of 340 mm"});
  expect_says(message([](auto &b) {
                b.bore           = 285 * mm;
                b.pitch_diameter = 311.15 * mm;
              }),
              {"cone", "inside the bore of 285 mm"});
}

TEST(RingSections, RefusesAChockThatDoesNotHoldTheBearing)
{
  expect_says(message([](auto &b) { b.chock_height = 350 * mm; }), {"600 x 350 mm", "355.6 mm"});
  expect_says(message([](auto &b) { b.chock_support_width = 700 * mm; }),
              {"chock_support_width = 700 mm", "600 mm"});
  expect_says(message([](auto &b) { b.chock_support_gap = 300 * mm; }),
              {"chock_support_gap = 300 mm", "leaves nothing"});
  expect_says(message([](auto &b) { b.chock_length = not_given; }), {"elastic rings need chock_length"});
}

TEST(RingSections, ARigidChockNeedsNoDimensions)
{
  RollerBearing b = mill_bearing();
  b.chock         = ChockForm::rigid;
  b.chock_width = b.chock_height = b.chock_length = not_given;
  const auto s                                    = ring_sections(b);
  EXPECT_EQ(s.housing.kind, ChockForm::rigid);
  EXPECT_EQ(s.housing.radius, 0.5 * b.outside_diameter);
}

TEST(RingSections, RefusesALandForWhichThereIsNoRoom)
{
  bearing::RacewayDatum datum;
  datum.land = 20 * mm;
  expect_says(message([](auto &) {}, datum), {"land of 20 mm", "there is room for"});
  datum.land        = not_given;
  datum.depth_outer = -1;
  expect_says(message([](auto &) {}, datum), {"depth", "positive"});
}

TEST(ChockSupports, AreAllThatTheCaseAllows)
{
  const auto names = [](const RollerBearing &b) {
    std::string all;
    for (const bearing::ChockSupport &other : bearing::open_supports(b)) {
      EXPECT_EQ(bearing::support_name(other.bearing), other.name);
      EXPECT_NO_THROW(ring_sections(other.bearing));
      all += other.name + "; ";
    }
    return all;
  };
  RollerBearing b = mill_bearing();
  b.rings         = RingBodies::elastic;
  EXPECT_EQ(names(b), "") << "its support was given";
  b.support_assumed     = true;
  b.chock_support_width = b.chock_width;
  EXPECT_EQ(names(b), "chock on two feet; chock on the middle of its face; ");
  b.chock_support_gap = b.chock_width * 2 / 3;
  b.chock_assumed     = true;
  EXPECT_EQ(names(b), "chock on its whole face; chock on the middle of its face; cup held; ");
  b.chock = ChockForm::rigid;
  EXPECT_EQ(names(b), "");
  b       = mill_bearing();
  b.rings = RingBodies::rigid;
  EXPECT_EQ(names(b), "");
}

// The roller fills the gap between its raceways, and meets the rings at their depth and land.
TEST(RingSections, OneRollerHasTheRacewaysOfTheRings)
{
  const RollerBearing b    = mill_bearing();
  const RollerSetup s      = bearing::roller_setup(b, 1e5);
  const RingSections rings = ring_sections(b, bearing::law_datum(b));
  EXPECT_TRUE(near(s.outer_radius - s.inner_radius, b.roller_diameter, within(1e-12, "geometry")));
  EXPECT_TRUE(near(s.outer_radius + s.inner_radius, pitch_diameter(b), within(1e-12, "geometry")));
  EXPECT_EQ(s.inner_depth, rings.cone.depth);
  EXPECT_EQ(s.outer_depth, rings.cup.depth);
  EXPECT_EQ(s.land, rings.cup.land);
}
