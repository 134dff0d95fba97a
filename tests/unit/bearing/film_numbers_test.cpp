// Errors of one oil film and the simpler films that it is compared with, by closed forms.
#include "core/base/errors.h"
#include "reduce/bearing/oil_film/closed_forms.h"
#include "reduce/bearing/oil_film/film_numbers.h"
#include "tests/support/near.h"
#include <Eigen/LU>
#include <cmath>

using namespace mill;
using namespace mill::bearing;

namespace {
OilFilmBearing film_of_length(const double length)
{
  OilFilmBearing b;
  b.name      = "film";
  b.diameter  = 0.95;
  b.length    = length;
  b.clearance = 0.4e-3;
  b.viscosity = {{313.15, 0.25}};
  return b;
}

OilFilmState of_viscosity(const double viscosity, const double eccentricity = 0.5)
{
  OilFilmState s;
  s.viscosity    = viscosity;
  s.eccentricity = eccentricity;
  return s;
}

// N, that a short film of 0.25 Pa s carries at 6.9 rad/s with this eccentricity.
double short_load(const OilFilmBearing &b, const double e)
{
  const double R = b.diameter / 2;
  return ocvirk_force(b.length / b.diameter, e) * 0.25 * 6.9 * std::pow(R / b.clearance, 2) * R * b.length / 2;
}
}  // namespace

// A value whose error falls with the square of the mesh: 1 + h^2 and 1 + 4 h^2 err by h^2 and by 4 h^2.
TEST(FilmNumbers, ErrorIsThatOfTheFinerGridWithItsSafety)
{
  OilFilmSolution s;
  s.fine.eccentricity = 1.01, s.coarse.eccentricity = 1.04;
  s.fine.stiffness << 1.01, 2, 3, 4;
  s.coarse.stiffness << 1.04, 2, 3, 4;
  s.fine.power_loss = s.coarse.power_loss = s.at.power_loss = 2;
  s.at.power_streamers                                      = 1.5;
  const OilFilmState error                                  = relative_errors(s);
  EXPECT_TRUE(near(error.eccentricity, 1.25 * 0.01 / 1.01, within(1e-12, "theory 1.3")));
  EXPECT_TRUE(near(error.stiffness(0, 0), 1.25 * 0.01 / 1.01, within(1e-12, "theory 1.3")));
  EXPECT_EQ(error.stiffness(1, 0), 0);
  EXPECT_TRUE(near(error.power_loss, 0.25, within(1e-12, "streamers take a quarter of the loss away")));
}

TEST(FilmNumbers, ShortFilmsAgreeAndFollowOcvirk)
{
  const OilFilmBearing b = film_of_length(0.95 / 20);
  for (const double e : {0.2, 0.5, 0.8}) {
    const OilFilmLoad load{short_load(b, e), 6.9, {0, 0}};
    const SimplerFilms s = simpler_films(b, load, of_viscosity(0.25, e));
    EXPECT_TRUE(near(s.short_eccentricity, e, within(1e-9, "bisection")));
    EXPECT_TRUE(near(s.eccentricity, e, within(2e-3, "L/D 1/20 is not zero")));
    EXPECT_TRUE(near(s.attitude, std::atan2(M_PI * std::sqrt(1 - e * e), 4 * e), within(5e-3, "720 angles")));
    EXPECT_TRUE(near(s.sommerfeld, sommerfeld_number(ocvirk_force(1. / 20, e)), within(0.01, "L/D 1/20")));
    EXPECT_TRUE(near(s.least_film, 0.4e-3 * (1 - s.eccentricity), within(1e-12, "round surfaces")));
    // The pressure is highest where its derivative vanishes: cos t = (1 - sqrt(1 + 24 e^2))/(4 e).
    const double cosine = (1 - std::sqrt(1 + 24 * e * e)) / (4 * e);
    const double p      = 3. / 400 * e * std::sqrt(1 - cosine * cosine) / std::pow(1 + e * cosine, 3);
    EXPECT_TRUE(
        near(s.short_peak, p * 0.25 * 6.9 * std::pow(0.475 / 0.4e-3, 2), within(1e-3, "steps of the angle")));
    EXPECT_TRUE(near(s.stiffness(0, 0), ocvirk_coefficients(e).stiffness(0, 0) * load.load / 0.4e-3,
                     within(0.02, "720 angles")));
  }
}

// Exact for any film: turned with the line of centres, the force turns.  K (-sin a, cos a) e c = (0, W).
TEST(FilmNumbers, ParabolasStiffnessTurnsWithTheLineOfCentres)
{
  const OilFilmBearing b = film_of_length(0.7);
  const SimplerFilms s   = simpler_films(b, {5e6, 6.9, {0, 0}}, of_viscosity(0.25));
  const Eigen::Vector2d turn =
      s.stiffness * Eigen::Vector2d(-std::sin(s.attitude), std::cos(s.attitude)) * s.eccentricity * 0.4e-3;
  EXPECT_TRUE(near(turn[0] / 5e6, 0, within_absolute(1e-5, "bisection of the eccentricity")));
  EXPECT_TRUE(near(turn[1] / 5e6, 1, within(1e-5, "bisection of the eccentricity")));
}

// Without load: Petroff's torque 2 pi mu w R^3 L / c.  The oil that leaves takes the loss along.
TEST(FilmNumbers, FrictionWithoutLoadIsPetroffs)
{
  const OilFilmBearing b = film_of_length(0.7);
  const SimplerFilms s   = simpler_films(b, {1e2, 6.9, {0, 0}}, of_viscosity(0.25));
  EXPECT_TRUE(near(s.full_friction, 2 * M_PI * 0.25 * 6.9 * std::pow(0.475, 3) * 0.7 / 0.4e-3,
                   within(1e-4, "the load is not zero")));
  EXPECT_TRUE(near(s.full_loss, 6.9 * s.full_friction, within(1e-12, "torque times speed")));
  EXPECT_TRUE(near(s.warming * b.oil_density * b.oil_heat * s.short_flow, b.heat_share * s.full_loss,
                   within(1e-12, "heat balance")));
  EXPECT_TRUE(near(s.short_flow, s.eccentricity * 0.475 * 0.4e-3 * 6.9 * 0.7, within(1e-12, "2 e R c w L/2")));
}

TEST(FilmNumbers, FreeAcrossIsThatBetweenTwoLoads)
{
  const OilFilmBearing b = film_of_length(0.7);
  const OilFilmLoad load{5e6, 6.9, {0, 0}};
  const FilmNumbers n      = film_numbers(b, load, solve_oil_film(b, load));
  const Eigen::Matrix2d &k = n.solution.at.stiffness;
  EXPECT_TRUE(near(n.free.value, k(0, 0) - k(0, 1) * k(1, 0) / k(1, 1), within(1e-12, "elimination")));
  EXPECT_TRUE(near(n.free.by_loads, n.free.value, within(0.01, "difference of two loads 1 % apart")));
  EXPECT_LT(n.free.error, 0.05);
  EXPECT_LT(n.least_speed, 6.9);
}

TEST(FilmNumbers, LayersAreAddedAsASpring)
{
  OilFilmBearing b = film_of_length(0.7);
  const OilFilmLoad load{5e6, 6.9, {0, 0}};
  const OilFilmState rigid = solve_oil_film(b, load).at;
  b.bush_thickness         = 2e-3;
  OilFilmState state       = rigid;
  state.layer_stiffness    = rigid.stiffness(0, 0);
  EXPECT_TRUE(near(series_stiffness(b, load, state).value_or(0), rigid.stiffness(0, 0) / 2,
                   within(1e-3, "two equal springs; the film is solved at the mean temperature of two grids")));
  EXPECT_TRUE(carrying_state(b, load).has_value());
  EXPECT_FALSE(carrying_state(b, {5e6, 1e-3, {0, 0}}).has_value());
}
