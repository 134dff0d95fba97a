// Stability maps: cells, boundary, empty cells with their reasons, threads.
#include "core/base/errors.h"
#include "dynamics/chatter/map.h"
#include "tests/support/film_pass.h"
#include "tests/support/near.h"
#include <cstring>

using namespace mill;
using namespace mill::dynamics;
using bite::RollBite;
using mill::Linearisation;

namespace {
ChatterStandModel stand()
{
  return {six_mass_structure({119e3, 75e3, 9.2e3, 9.2e3, 75e3, 36.5e3},
                             {6.9e10, 3.0e10, 6.06e10, 6.06e10, 4.4e10, 10.1e10},
                             {6.05e5, 4.25e5, 6.05e5, 6.05e5, 4.25e5, 6.05e5}),
          4.95, 4.95, 210e9};
}

Eigen::VectorXd values(std::initializer_list<double> list)
{
  return Eigen::Map<const Eigen::VectorXd>(list.begin(), Eigen::Index(list.size()));
}

StabilityMap mapped(const RollBite &pass, const Eigen::VectorXd &speed, const MapQuantity quantity,
                    const Eigen::VectorXd &value, const int threads = 2)
{
  return stability_map(stand(), pass, Linearisation::sequential, speed, quantity, value, threads);
}

std::string refusal(const RollBite &pass, const Eigen::VectorXd &speed, const MapQuantity quantity,
                    const Eigen::VectorXd &value)
{
  try {
    mapped(pass, speed, quantity, value);
  } catch (const InputError &error) {
    return error.problems.front().message;
  }
  return "accepted";
}

NoBite reason(const StabilityMap &map, const Eigen::Index i, const Eigen::Index j)
{
  return NoBite(map.reason(i, j));
}
}  // namespace

TEST(StabilityMap, CellsAndBoundaryAreSingleEvaluations)
{
  const RollBite pass = film_pass();
  const auto speed    = Eigen::VectorXd::LinSpaced(8, 10, 24);
  for (const auto quantity : {MapQuantity::reduction, MapQuantity::tension, MapQuantity::viscosity}) {
    const Eigen::VectorXd value = quantity_of(pass, quantity) * values({0.8, 1, 1.1});
    const auto map              = mapped(pass, speed, quantity, value);
    SpeedRange range;
    range.from = 10;
    range.to   = 24;
    for (Eigen::Index j = 0; j < 3; ++j) {
      const RollBite column = with_quantity(pass, quantity, value[j]);
      const auto critical   = critical_speed(stand(), column, Linearisation::sequential, range);
      EXPECT_EQ(map.critical_speed[j], critical.speed);
      EXPECT_EQ(map.critical_frequency[j], critical.frequency);
      for (Eigen::Index i = 0; i < 8; ++i) {
        const auto A = chatter_matrix(stand(), working_point(column, speed[i], Linearisation::sequential).by);
        EXPECT_EQ(map.growth(i, j), growth_rate(A));
        EXPECT_EQ(reason(map, i, j), NoBite::none);
        EXPECT_EQ(map.growth(i, j) > 0, speed[i] > map.critical_speed[j]);
        EXPECT_GT(map.frequency(i, j), 50);
      }
    }
    EXPECT_EQ(map.cells[0], 24);
  }
}

TEST(StabilityMap, EmptyCellsHaveAReason)
{
  const RollBite pass = film_pass();
  const auto map      = mapped(pass, values({1, 18}), MapQuantity::tension, values({1, 2.3, 4.15, 4.5}));
  EXPECT_EQ(reason(map, 0, 0), NoBite::flattening);
  EXPECT_TRUE(std::isnan(map.growth(0, 0)) && std::isnan(map.frequency(0, 0)));
  EXPECT_EQ(reason(map, 1, 0), NoBite::none);
  EXPECT_EQ(reason(map, 0, 2), NoBite::exit_tension);
  EXPECT_EQ(reason(map, 1, 3), NoBite::entry_tension);
  const int exit = int(NoBite::exit_tension);
  EXPECT_EQ(map.cells[exit], 2);
  EXPECT_EQ(
      map.examples[exit],
      "strip.exit_tension = 784.4 MPa reaches the flow stress 780.5 MPa at the exit: the strip yields behind "
      "the bite");
  EXPECT_TRUE(std::isnan(map.critical_speed[3]));

  RollBite dry                   = pass;  // little friction: the rolls skid, which way the tensions say
  dry.strip.friction             = Friction{};
  dry.strip.friction.coefficient = 0.01;
  dry.strip.entry_tension        = 20e6;
  dry.strip.exit_tension         = 400e6;
  EXPECT_EQ(reason(mapped(dry, values({15}), MapQuantity::tension, values({1})), 0, 0), NoBite::torn_through);
  dry.strip.entry_tension = 400e6;
  dry.strip.exit_tension  = 20e6;
  EXPECT_EQ(reason(mapped(dry, values({15}), MapQuantity::tension, values({1})), 0, 0), NoBite::not_drawn_in);
  for (int r = 0; r < n_no_bite; ++r)
    EXPECT_FALSE(reason_of(NoBite(r)).empty());
}

TEST(StabilityMap, ResultIsTheSameForAnyNumberOfThreads)
{
  const auto speed = Eigen::VectorXd::LinSpaced(6, 1, 26);
  const auto value = Eigen::VectorXd::LinSpaced(7, 0.05, 0.45);
  const auto one   = mapped(film_pass(), speed, MapQuantity::reduction, value, 1);
  for (const int threads : {2, 5, 16}) {
    const auto other = mapped(film_pass(), speed, MapQuantity::reduction, value, threads);
    const auto same  = [](const auto &a, const auto &b) {
      return std::memcmp(a.data(), b.data(), sizeof(double) * std::size_t(a.size())) == 0;
    };
    EXPECT_TRUE(same(one.growth, other.growth) && same(one.frequency, other.frequency));
    EXPECT_TRUE(same(one.critical_speed, other.critical_speed));
    EXPECT_EQ(one.reason, other.reason);
    EXPECT_EQ(one.cells, other.cells);
    EXPECT_EQ(one.examples, other.examples);
  }
}

TEST(StabilityMap, RefusesWrongAxesWithTheReason)
{
  const RollBite pass = film_pass();
  EXPECT_EQ(refusal(pass, values({}), MapQuantity::tension, values({1})),
            "a stability map needs at least one speed and one value of its quantity");
  EXPECT_EQ(refusal(pass, values({5, 5}), MapQuantity::tension, values({1})),
            "the speeds of a stability map have to be positive and rising");
  EXPECT_EQ(refusal(pass, values({5}), MapQuantity::reduction, values({1})),
            "a reduction of 1 has to lie between 0 and 1");
  EXPECT_EQ(refusal(pass, values({5}), MapQuantity::tension, values({-1})),
            "a factor of -1 on the tensions must not be negative");
  EXPECT_EQ(refusal(pass, values({5}), MapQuantity::viscosity, values({0})),
            "a viscosity of 0 Pa s must be positive");
  RollBite dry       = pass;
  dry.strip.friction = Friction{};
  EXPECT_EQ(refusal(dry, values({5}), MapQuantity::viscosity, values({0.01})),
            "a map over the viscosity needs the film law of an oil, but strip.friction.law = \"coulomb\"");
}
