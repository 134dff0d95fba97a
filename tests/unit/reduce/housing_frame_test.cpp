// The housing as a closed frame of beams: known limits and identities.
#include "reduce/chain/housing_frame.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <cmath>

using namespace mill;
using namespace mill::reduce;

namespace {
// Same beams above and below, feet half way up, a pad that is nearly a point.
MillHousing symmetric(const double post, const double beam)
{
  MillHousing h;
  h.thickness         = 0.3;
  h.post_width        = post;
  h.window_width      = 4;
  h.window_height     = 6;
  h.upper_beam_height = h.lower_beam_height = beam;
  h.foot_height                             = 3;
  h.fillet_radius                           = 0.1;
  h.screw_pad = h.seat_pad = 1e-3;
  return h;
}
const FrameChoice axes{0};
}  // namespace

TEST(HousingFrame, CornerMomentOfASymmetricFrame)
{
  // Opening by two opposite forces: M = (P L / 8) / (1 + H I_beam / (L I_post)), independent of the shear.
  for (const double post : {0.1, 0.3, 0.8}) {
    const MillHousing h = symmetric(post, 0.4);
    const double L = h.window_width + post, H = h.window_height + 0.4, I = std::pow(0.4 / post, 3);
    EXPECT_TRUE(
        near(housing_frame(h, axes).fixity, 1 / (1 + H / L * I),
             within(1e-6, "pad of 1 mm on 4 m: its length enters both squared; the posts are axially soft")));
  }
}

TEST(HousingFrame, OpeningOfASymmetricFrame)
{
  // Beam under half of the force of one housing per post, end moments M; half of a post's stretch and, on the
  // outside of the post, without its bending: the feet are in its middle, where it does not turn.
  const MillHousing h = symmetric(0.3, 0.4);
  const auto f        = housing_frame(h, axes);
  const double E = h.steel.youngs_modulus, nu = h.steel.poisson_ratio, G = E / (2 * (1 + nu));
  const double kappa = 10 * (1 + nu) / (12 + 11 * nu), P = 0.5;
  const double L = 4.3, H = 6.4, A = 0.3 * 0.4, I = A * 0.16 / 12, A_post = 0.3 * 0.3;
  const double M          = f.fixity * P * L / 8;
  const double deflection = P * L * L * L / (48 * E * I) - M * L * L / (8 * E * I) + P * L / (4 * kappa * G * A);
  const double stretch    = 0.5 * P * 0.5 * H / (E * A_post);
  EXPECT_TRUE(near(f.u_screw, deflection + stretch, within(1e-5, "pad of 1 mm; a mean over it")));
  EXPECT_TRUE(near(f.u_seat, -f.u_screw, within(1e-12, "the lower half mirrors the upper")));
  EXPECT_TRUE(near(
      f.exchanged, 0,
      within(1e-9, "no work crosses a plane of symmetry; elements of 0.5 mm next to 2 m cost digits", f.u_screw)));
}

TEST(HousingFrame, EnergyIsWork)
{
  MillHousing h       = symmetric(0.5, 0.9);
  h.lower_beam_height = 0.6;
  h.foot_height       = 1;
  h.screw_pad         = 0.5;
  h.seat_pad          = 0.8;
  for (const double rigid : {0., 0.5, 1.}) {
    const auto f = housing_frame(h, {rigid});
    double sum   = 0;
    for (const double part : f.energy)
      sum += part;
    EXPECT_TRUE(near(sum, f.u_screw - f.u_seat, within(1e-11, "rounding of a system of 16 unknowns")));
    EXPECT_TRUE(near(f.flexibility[upper_post] + f.flexibility[upper_beam], f.u_screw,
                     within(1e-14, "shares of one number")));
    double mass = 0;
    for (const double part : f.mass)
      mass += part;
    const double window = h.window_width * h.window_height;
    const double area   = (h.window_width + 2 * h.post_width) * (h.window_height + 0.9 + 0.6) - window;
    EXPECT_TRUE(near(mass, 2 * h.thickness * h.steel.density * area,
                     within(1e-13, "axes to the joints hold each corner once")));
  }
}

TEST(HousingFrame, LimitsOfTheRules)
{
  // Stiff posts that do not hold the ends of a slender beam: 17/35; short rigid beams far apart: a third.
  MillHousing h         = symmetric(0.02, 0.2);
  h.thickness           = 10;
  h.window_width        = 40;
  h.steel.poisson_ratio = 0;
  const auto beam       = housing_frame(h, axes);
  EXPECT_TRUE(
      near(beam.reduced_mass[upper_beam] / beam.mass[upper_beam], 17. / 35,
           within(1e-3, "posts of a tenth of the beam's height hold its ends to 1e-3 and stretch as little")));
  MillHousing tall   = symmetric(0.3, 3);
  tall.window_width  = 0.1;
  tall.window_height = 600;
  tall.foot_height   = 300;
  const auto post    = housing_frame(tall, axes);
  EXPECT_TRUE(near(post.vertical_mass[upper_post] / post.mass[upper_post], 1. / 3,
                   within(1e-2, "half a beam's height on 300 m of post, and what the short beam gives")));
}

TEST(HousingFrame, RigidCornersStiffen)
{
  const MillHousing h = symmetric(0.6, 1);
  double before       = 1;
  for (const double rigid : {0., 0.25, 0.5, 0.75, 1.}) {
    const auto f = housing_frame(h, {rigid});
    EXPECT_LT(f.u_screw, before);
    before = f.u_screw;
  }
}

TEST(HousingFrame, RefusesWhatIsNoFrame)
{
  MillHousing h = symmetric(0.3, 0.4);
  h.post_width  = 0;
  EXPECT_EQ(refusal([&] { housing_frame(h); }),
            "housing.post_width = \"0 mm\" must be positive: give the length of the drawing");
  h             = symmetric(0.3, 0.4);
  h.foot_height = 7;
  EXPECT_EQ(refusal([&] { housing_frame(h); }),
            "housing.foot_height = \"7000 mm\" is outside the posts: give more "
            "than 0 mm and less than housing.window_height = \"6000 mm\"");
  EXPECT_EQ(refusal([&] { housing_frame(symmetric(0.3, 0.4), {2}); }),
            "frame of the housing: 2 of a corner cannot be rigid; 0 to 1 can");
}

TEST(HousingFrame, RuleTakesAThirdAndSeventeenThirtyFifths)
{
  const MillHousing h = symmetric(0.3, 0.4);
  const auto parts    = housing_frame(h).mass;
  const auto rule     = masses_by_rule(h);
  EXPECT_EQ(rule[upper_post], parts[upper_post] / 3);
  EXPECT_EQ(rule[lower_beam], parts[lower_beam] * 17 / 35);
}
