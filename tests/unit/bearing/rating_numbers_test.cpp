// Ratings and lives of a solved bearing with their errors, compared with closed forms.
#include "reduce/bearing/rating_numbers.h"
#include "tests/support/demo_bearing.h"
#include "tests/support/near.h"
#include <cmath>

using namespace mill;
using namespace mill::bearing;

namespace {
constexpr double rated_by = 1e6;  // N

RollerBearing cylindrical_rated()
{
  RollerBearing b     = demo_bearing(0);
  b.roller_cone_angle = 0;
  return b;
}

ComparedStates rated_states(const RollerBearing &b, const RingLoading &loading = radial_drive(rated_by))
{
  ComparedStates s;
  s.loading = loading;
  s.at = s.standard = s.palmgren = s.rigid = BearingAssembly(rigid_model(b)).solve(loading);
  s.companions                             = {{"the same", s.at}};
  return s;
}

// Error of a life that goes with the 10/3 of C.
double by_C(const double error)
{
  return std::pow(1 + error, 10. / 3) - 1;
}
}  // namespace

TEST(RatingNumbers, AreThoseOfTheStandards)
{
  const RollerBearing b = cylindrical_rated();
  const RatingNumbers n = rating_numbers(b, rated_states(b));
  EXPECT_EQ(n.C, ratings(b).dynamic);
  EXPECT_EQ(n.C0, ratings(b).static_rating);
  ASSERT_TRUE(n.load);
  EXPECT_TRUE(near(n.load->P, rated_by, within(1e-9, "equilibrium")));
  EXPECT_TRUE(near(n.load->L10, 1e6 * std::pow(n.C / rated_by, 10. / 3), within(1e-8, "(5.34)")));
  EXPECT_TRUE(near(n.load->S0, n.C0 / rated_by, within(1e-9, "(5.33)")));
  // The pressure of a line contact goes with the root of its load; Stribeck's heaviest roller carries 4.0847 times
  // the mean, that of ISO 76 five times.
  EXPECT_TRUE(
      near(n.load->S0_by_pressure, n.C0_by_pressure * 5 / (4.0847 * rated_by), within(2e-3, "39 rollers")));
  EXPECT_TRUE(near(n.load->S0_by_yield / n.load->S0_by_pressure, std::pow(b.yield_pressure / 4e9, 2),
                   within(1e-12, "one pressure")));
  EXPECT_TRUE(near(n.L10r_without_edge, 0.9854e6 * std::pow(n.C / (0.83 * rated_by), 4),
                   within(1e-4, "even slices without clearance; printed digits of the ratio")));
  EXPECT_EQ(n.L10r_standard, n.slices.life);
  EXPECT_TRUE(near(1e6 * std::pow(n.load->C_by_slices / rated_by, 10. / 3), n.slices.life,
                   within(1e-8, "the C that gives this life by (5.34)")));
  EXPECT_TRUE(std::isnan(n.C_error)) << "C comes from the rollers alone";
  EXPECT_TRUE(std::isnan(n.L10r_error)) << "a life goes with C";
  EXPECT_TRUE(near(n.C0_error, std::abs(n.C0_by_pressure / n.C0 - 1), within(1e-12, "Hertz against ISO 76")));
}

TEST(RatingNumbers, AMakersRatingJudgesTheFormulaAndTheLives)
{
  RollerBearing b       = cylindrical_rated();
  b.dynamic_rating      = 1.1 * ratings(b).dynamic;
  const RatingNumbers n = rating_numbers(b, rated_states(b));
  EXPECT_EQ(n.C, b.dynamic_rating);
  EXPECT_TRUE(near(n.C_error, 0.1 / 1.1, within(1e-12, "formula against maker")));
  EXPECT_TRUE(near(n.load->L10_error, std::hypot(n.slices.life / n.load->L10 - 1, by_C(0.1 / 1.1)),
                   within(1e-12, "two causes")));
  const double thin = n.L10r_thin_slices / n.slices.life - 1, by_load = std::abs(n.load->L10 / n.slices.life - 1);
  EXPECT_TRUE(near(n.L10r_error, std::hypot(std::max(thin, by_load), by_C(0.1 / 1.1)),
                   within(1e-12, "slices and C; the companion changes nothing")));
  b.estimated = {"roller_length"};
  EXPECT_TRUE(std::isnan(rating_numbers(b, rated_states(b)).C_error)) << "the rollers follow from the rating";
}

TEST(RatingNumbers, OilAndDirtThatAreNotGivenWidenTheModifiedLife)
{
  RollerBearing b           = cylindrical_rated();
  b.dynamic_rating          = ratings(b).dynamic;
  const RatingNumbers open  = rating_numbers(b, rated_states(b));
  b.viscosity_ratio         = 1;
  b.contamination           = 0.3;
  const RatingNumbers given = rating_numbers(b, rated_states(b));
  const double ratio        = fatigue_load_limit(given.C0, 0.31115) / rated_by;
  EXPECT_TRUE(near(given.load->L10mr, life_factor(1, 0.3, ratio) * given.load->L10, within(1e-8, "(5.39)")));
  EXPECT_EQ(open.L10mr, given.L10mr);
  EXPECT_EQ(given.L10mr_error, given.L10r_error);
  // C has no error here, so that what is not given is added as it is.
  const double part = fatigue_load_limit(given.C0, 0.31115) / given.slices.equivalent_load;
  const auto change = [&](const double kappa, const double dirt) {
    return std::abs(life_factor(kappa, dirt, part) / life_factor(1, 0.3, part) - 1);
  };
  EXPECT_TRUE(near(open.L10mr_error - given.L10mr_error,
                   std::max(change(0.5, 0.3), change(2, 0.3)) + std::max(change(1, 0.2), change(1, 0.4)),
                   within(1e-9, "a factor of two, and 0.2 .. 0.4")));
}

// The factor of the ends belongs to the last slice however wide that is.  Even slices carry the same load for each
// length, so that many of them are the limit of few.
TEST(RatingNumbers, TheErrorOfALifeCoversTheNumberOfSlices)
{
  RollerBearing b    = cylindrical_rated();
  b.profile          = RollerProfile::none;
  b.dynamic_rating   = ratings(b).dynamic;
  b.slices           = 1001;
  const double limit = rating_numbers(b, rated_states(b)).slices.life;
  for (const int slices : {11, 41}) {
    b.slices              = slices;
    const RatingNumbers n = rating_numbers(b, rated_states(b));
    EXPECT_TRUE(near(n.L10r_thin_slices, limit, within(0.05, "1001 slices against 704 and more")));
    EXPECT_GT(limit / n.slices.life, 1.5) << "what " << slices << " slices lack";
    EXPECT_GE(n.L10r_error * (1 + 0.05), limit / n.slices.life - 1) << slices;
    EXPECT_GE(n.L10mr_error * (1 + 0.05), limit / n.slices.life - 1) << slices;
  }
}

TEST(RatingNumbers, AnUnknownErrorIsUnknownOfBothLives)
{
  RollerBearing b   = cylindrical_rated();
  b.dynamic_rating  = ratings(b).dynamic;
  b.viscosity_ratio = 1;
  b.contamination   = 0.3;
  RingLoading moment;
  moment.value[4]      = 2e4;
  moment.prescribed[4] = false;
  ComparedStates s     = rated_states(b, moment);
  s.companions.clear();
  const RatingNumbers n = rating_numbers(b, s);
  EXPECT_FALSE(n.load) << "so that ISO 281 judges nothing";
  EXPECT_TRUE(std::isnan(n.L10r_error));
  EXPECT_TRUE(std::isnan(n.L10mr_error));
}

TEST(RatingNumbers, AMomentAloneHasNoEquivalentLoad)
{
  const RollerBearing b = cylindrical_rated();
  RingLoading moment;
  moment.value[4]       = 2e4;
  moment.prescribed[4]  = false;
  const RatingNumbers n = rating_numbers(b, rated_states(b, moment));
  EXPECT_FALSE(n.load);
  EXPECT_TRUE(std::isfinite(n.slices.life));
}

TEST(RatingNumbers, CandidatesSpanARange)
{
  const std::vector<RollerCandidate> three{{39, 0.02}, {40, 0.019}, {38, 0.022}};
  const CandidateRange r =
      candidate_range(three, 0.02, [](const RollerCandidate &c) { return c.roller_diameter; });
  EXPECT_EQ(r.low, 0.019);
  EXPECT_EQ(r.high, 0.022);
  EXPECT_TRUE(near(r.error, 0.1, within(1e-12, "the farther end")));
}
