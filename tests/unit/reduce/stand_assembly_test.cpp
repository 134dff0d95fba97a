// The stand put together: loads in balance, masses that are zero, unlike barrels, frames, housings.
#include "reduce/stand/component_stand.h"
#include "reduce/stand/six_masses.h"
#include "tests/support/beam_demo.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <Eigen/Dense>

using namespace mill;
using namespace mill::reduce;

namespace {
const auto rounding = within(1e-9, "one linear solve, conditioning of beams 1e6");

double stiffness_sum(const StandModel &stand, const std::string &name)
{
  for (const Connection &c : stand.connections)
    if (c.name == name)
      return c.stiffness.sum();
  return 0;
}

/// Two bodies that move on springs of their own, like a frame without coupling of its halves.
Component simple_housing(const double upper, const double lower, const double mass)
{
  Component c;
  c.name      = "housing";
  c.interface = {"screw", "seat"};
  c.M         = mass * Eigen::MatrixXd::Identity(2, 2);
  c.K         = Eigen::Vector2d(upper, lower).asDiagonal();
  return c;
}

/// Stand of beam rolls on a housing.
StandModel on_housing(const FourHigh &stand, const Component &housing)
{
  std::array<RollBody, 4> rolls;
  const char *names[4] = {"upper backup roll", "upper work roll", "lower work roll", "lower backup roll"};
  for (std::size_t i = 0; i < 4; ++i)
    rolls[i] = beam_roll(names[i], i % 3 == 0 ? stand.backup_roll : stand.work_roll, stand.steel, 8, 0.7);
  return assemble_stand("beam", stand, demo_springs(stand), rolls, &housing);
}
}  // namespace

TEST(StandAssembly, PlacesAndLoads)
{
  const StandModel stand = demo_beams(demo_drawing());
  const std::vector<std::string> places{"upper frame",     "upper backup roll", "upper work roll",
                                        "lower work roll", "lower backup roll", "lower frame"};
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(stand.points[i].name, places[i]);
  EXPECT_TRUE(near(stand.b.cwiseMax(0).sum(), 1, within(1e-13, "the whole force on the upper work roll")));
  EXPECT_TRUE(near(stand.b.cwiseMin(0).sum(), -1, within(1e-13, "and on the lower one")));
  for (const Connection &c : stand.connections)
    if (c.name != "K1" && c.name != "K7") {
      EXPECT_LT(c.rows.rowwise().sum().cwiseAbs().maxCoeff(), 1e-14)
          << c.name << " joins parts, a common motion is free";
    }
  EXPECT_TRUE(near(stiffness_sum(stand, "K3"), 4.02e10, within(1e-13, "shares of the whole line")));
}

TEST(StandAssembly, MassIsThatOfThePartsAndRealMassesAreAllThere)
{
  const FourHigh drawing = demo_drawing();
  const StandModel stand = demo_beams(drawing);
  const auto roll        = [&](const Roll &r) {
    return 7700 * M_PI / 4 *
           (r.barrel_diameter * r.barrel_diameter * r.barrel_length +
            2 * r.neck_diameter * r.neck_diameter * r.neck_length);
  };
  const double whole = 2 * roll(drawing.work_roll) + 2 * roll(drawing.backup_roll) + 4 * 90 + 2 * 880 + 4 * 1500 +
                       2 * (10900 + 9800 + 7400) + 8000 + 9320 + 4660;
  EXPECT_TRUE(near(stand.M.sum(), whole, within(1e-12, "sum of all parts")));
}

// Every spring of the path carries the whole force, so frame and chocks move as springs in series say.
TEST(StandAssembly, StaticPathAndLoadCell)
{
  FourHigh drawing = demo_drawing();
  for (const FrameForm frame : every<FrameForm>()) {
    drawing.dynamics.frame  = frame;
    const StandModel stand  = demo_beams(drawing);
    const Eigen::VectorXd y = static_displacement(stand);
    const LumpedStand chain = demo_chain(drawing);
    const double zero = frame == FrameForm::closed ? 1 / chain.model.K[6].value : 0;  // no force in the foundation
    const Flexibilities &u = chain.flexibility;
    EXPECT_TRUE(near(point_of(stand, "upper frame").row.dot(y), u.frame_upper, rounding));
    EXPECT_TRUE(near(point_of(stand, "cylinder").row.dot(y), u.cylinder, rounding));
    EXPECT_TRUE(near(point_of(stand, "upper backup roll seat").row.dot(y), u.bearing_upper, rounding));
    EXPECT_TRUE(near(point_of(stand, "lower backup roll seat").row.dot(y), -u.bearing_lower + zero, rounding));
    EXPECT_TRUE(near(stand.load_cell.dot(y), 1, rounding));
  }
}

TEST(StandAssembly, MassesThatAreZeroGetNoUnknown)
{
  FourHigh drawing                     = demo_drawing();
  const Eigen::Index n                 = demo_beams(drawing).M.rows();
  drawing.frame.cylinder_mass          = 0;
  drawing.backup_roll.chock_mass_upper = 0;
  const StandModel none                = demo_beams(drawing);
  EXPECT_EQ(none.M.rows(), n - 2);
  EXPECT_GT(none.M.diagonal().minCoeff(), 0);
  drawing.frame.cylinder_mass = drawing.backup_roll.chock_mass_upper = 1e-3;
  const StandModel little                                            = demo_beams(drawing);
  EXPECT_EQ(little.M.rows(), n);
  EXPECT_TRUE(near(stand_modes(none).frequency.head(12).eval(), stand_modes(little).frequency.head(12).eval(),
                   within(1e-6, "a gram next to tons")));
  const Eigen::VectorXd y = static_displacement(none);
  EXPECT_TRUE(near(point_of(none, "cylinder").row.dot(y), demo_chain(drawing).flexibility.cylinder, rounding));
  EXPECT_TRUE(near(point_of(none, "upper backup chock").row.dot(y), demo_chain(drawing).flexibility.chock_upper,
                   rounding));
}

TEST(StandAssembly, WorkRollChocksOnTheirBearings)
{
  const FourHigh drawing = demo_drawing();
  StandSprings springs   = stand_springs(drawing, demo_chain(drawing), true);
  EXPECT_EQ(springs.Kzc_lower, 1.9e10);
  const StandModel moving = beam_stand(drawing, springs, 8);
  EXPECT_EQ(moving.M.rows(), demo_beams(drawing).M.rows() + 1);  // the upper chock weighs nothing
  EXPECT_EQ(point_of(moving, "upper work-roll chock").row, point_of(moving, "upper work roll seat").row);
  EXPECT_TRUE(near(stiffness_sum(moving, "Kzc lower work roll"), 3.8e10, within(1e-15, "two bearings")));
  springs.Kzc_upper = springs.Kzc_lower = 1e16;
  EXPECT_TRUE(near(stand_modes(beam_stand(drawing, springs, 8)).frequency.head(12).eval(),
                   stand_modes(demo_beams(drawing)).frequency.head(12).eval(),
                   within(1e-5, "nearly rigid bearings")));
}

TEST(StandAssembly, BarrelsOfUnlikeLength)
{
  FourHigh drawing                = demo_drawing();
  drawing.work_roll.barrel_length = 1.6;
  drawing.work_roll.neck_length   = 0.4;
  const StandModel stand          = demo_beams(drawing);
  EXPECT_TRUE(near(stiffness_sum(stand, "K3"), 4.02e10, within(1e-13, "over the common length")));
  for (const Connection &c : stand.connections)
    if (c.name == "K3") {
      EXPECT_EQ(c.rows.rows(), 9);  // nodes face to face over the shorter barrel
      EXPECT_TRUE(c.rows.cwiseAbs().rowwise().sum().isConstant(2, 1e-14));
    }
  EXPECT_GT(stand_modes(stand).frequency[0], 30);
}

TEST(StandAssembly, StripSpring)
{
  FourHigh drawing               = demo_drawing();
  drawing.dynamics.force_meaning = ForceMeaning::disturbance;
  const StandSprings springs     = stand_springs(drawing, demo_chain(drawing, 3e8));
  EXPECT_EQ(springs.K4, 3e8);
  const StandModel stand = beam_stand(drawing, springs, 8);
  EXPECT_TRUE(near(stiffness_sum(stand, "K4"), 3e8, within(1e-13, "shares of the strip")));
  drawing.dynamics.force_meaning = ForceMeaning::measured;
  EXPECT_EQ(stand_springs(drawing, demo_chain(drawing, 3e8)).K4, 0)
      << "a measured force contains the reaction of the gap";
}

TEST(StandAssembly, HousingInPlaceOfTheFrame)
{
  const FourHigh drawing  = demo_drawing();
  const Frame &f          = drawing.frame;
  const double upper      = 1 / (1 / f.upper_post_stiffness + 1 / f.upper_beam_stiffness),
               lower      = 1 / (1 / f.lower_post_stiffness + 1 / f.lower_beam_stiffness);
  const StandModel stand  = on_housing(drawing, simple_housing(upper, lower, 5000));
  const SixMasses six     = six_masses(stand, riders_of(drawing));
  const LumpedModel chain = demo_chain(drawing).model;
  EXPECT_TRUE(near(six.K[0], chain.K[0].value, rounding)) << "posts, beam, piston and packing in series";
  EXPECT_TRUE(near(six.K[6], chain.K[6].value, rounding));
  const double share_upper = six.K[0] / upper, share_lower = six.K[6] / lower;  // displacement of screw and seat
  EXPECT_TRUE(near(six.M[0], 420 + 1000 + 5000 * share_upper * share_upper, rounding));
  EXPECT_TRUE(near(six.M[5], 420 + 240 + 5000 * share_lower * share_lower, rounding));
  EXPECT_TRUE(near(stand.load_cell.dot(static_displacement(stand)), 1, rounding));
  Component deaf = simple_housing(1e10, 1e10, 1);
  deaf.interface = {"screw", "pad"};
  EXPECT_EQ(refusal([&] { on_housing(drawing, deaf); }),
            "component \"housing\" cannot be the housing: it has no interface displacement \"seat\"");
}

TEST(StandAssembly, RefusesMissingSpringsAndMasses)
{
  const FourHigh drawing = demo_drawing();
  StandSprings springs   = demo_springs(drawing);
  springs.K3             = 0;
  EXPECT_EQ(refusal([&] { beam_stand(drawing, springs); }), "K3 = 0 N/m: must be positive");
  springs    = demo_springs(drawing);
  springs.M1 = -1;
  EXPECT_EQ(refusal([&] { beam_stand(drawing, springs); }), "M1 = -1 kg: must be positive");
  springs    = demo_springs(drawing);
  springs.K4 = -1;
  EXPECT_EQ(refusal([&] { beam_stand(drawing, springs); }), "K4 = -1 N/m: must not be negative");
  EXPECT_EQ(refusal([] { place_of_part("roof"); }), "part \"roof\" has no place in the chain of six masses");
}

TEST(ComponentRoll, RefusesWhatIsNoRoll)
{
  Component c = simple_housing(1, 1, 1);
  EXPECT_EQ(refusal([&] { component_roll("upper work roll", c); }),
            "component \"housing\" cannot be the upper work roll: it needs barrel functions and an interface "
            "displacement "
            "\"seat\"");
  c.n_barrel    = 1;
  c.half_barrel = 0.7;
  EXPECT_EQ(refusal([&] { component_roll("upper work roll", c); }),
            "component \"housing\": matrices of unlike size (2 interface displacements, M 2 x 2, K 2 x 2, axis 0 "
            "x 0 at 0 "
            "stations)");
}
