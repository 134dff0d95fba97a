// Derivatives of the vibrating bite by every input: differences, similarity, under every law.
#include "core/base/errors.h"
#include "dynamics/chatter/sensitivity.h"
#include "reduce/bite/slab/bland_ford.h"
#include "tests/support/difference.h"
#include "tests/support/film_pass.h"
#include "tests/support/near.h"
#include <algorithm>
#include <random>
#include <utility>

using namespace mill;
using namespace mill::dynamics;
using bite::Dual;
using bite::PassNumber;
using bite::RollBite;
using mill::Linearisation;

namespace {
constexpr Linearisation schemes[]{Linearisation::sequential, Linearisation::implicit,
                                  Linearisation::frozen_friction};

struct Solved {
  bite::BiteState state;
  bite::LinearCoefficients by;
};

Solved solved(const RollBite &pass, const Linearisation scheme)
{
  Solved s;
  s.state = solve_bland_ford(pass, bite::Arc::hitchcock, 0);
  s.by    = linear_coefficients(pass, s.state, scheme);
  return s;
}

/// Passes under every law of hardening and friction.
std::vector<RollBite> passes()
{
  std::vector<RollBite> all{film_pass()};
  const auto add = [&](const auto &change) {
    RollBite b = film_pass();
    change(b.strip);
    all.push_back(b);
  };
  add([](Strip &s) {
    s.flow_stress       = {FlowStressLaw::constant, 760e6};
    s.initial_thickness = not_given;
  });
  add([](Strip &s) {
    s.flow_stress          = {FlowStressLaw::swift, 700e6, 0.01, 0.2};
    s.friction             = Friction{};
    s.friction.coefficient = 0.04;
  });
  add([](Strip &s) {
    s.flow_stress            = {FlowStressLaw::ludwik, 300e6, 0, 0.4, 450e6};
    s.friction               = Friction{};
    s.friction.law           = FrictionLaw::speed;
    s.friction.at_unit_speed = 0.066723;
    s.friction.per_log_speed = -0.00662;
  });
  add([](Strip &s) { s.flow_stress = {FlowStressLaw::voce, 350e6, 0, 2.5, 500e6}; });
  add([](Strip &s) { s.flow_stress = {FlowStressLaw::power, 730e6, 0, 0.15}; });
  add([](Strip &s) {
    s.flow_stress.law   = FlowStressLaw::table;
    s.flow_stress.table = {{0, 500e6}, {1, 700e6}, {1.5, 760e6}, {2, 800e6}};
  });
  // Strain from the entry, hardening with an infinite slope there.
  add([](Strip &s) {
    s.flow_stress       = {FlowStressLaw::ludwik, 300e6, 0, 0.4, 650e6};
    s.initial_thickness = not_given;
  });
  return all;
}
}  // namespace

TEST(SecondDerivatives, AreSymmetricAndEqualDifferencesOfTheFirst)
{
  const auto f = [](const auto &x, const auto &y) {
    using std::atan;
    using std::log;
    return pow(x, y) * exp(-1.0 * x * y) + atan(x / y) * log(x + y) + bite::expm1(x) / sqrt(y) - tan(x) * cos(y);
  };
  using Inner         = Dual<2>;
  const auto value_at = [&](const double x, const double y) {
    return f(Inner::variable(x, 0), Inner::variable(y, 1));
  };
  const double x = 0.7, y = 1.3;
  const auto second =
      f(Dual<2, Inner>::variable(Inner::variable(x, 0), 0), Dual<2, Inner>::variable(Inner::variable(y, 1), 1));
  EXPECT_TRUE(near(second.by[0].by[1], second.by[1].by[0], within(1e-14, "Schwarz")));
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(
        near(second.by[i].value, value_at(x, y).by[std::size_t(i)], within(1e-14, "the same first derivative")));
    const auto along_x = [&](const double c) { return value_at(x * c, y).by[std::size_t(i)]; };
    const auto along_y = [&](const double c) { return value_at(x, y * c).by[std::size_t(i)]; };
    const auto fourth  = within(1e-9, "differences without the error of second order, step 1e-3");
    EXPECT_TRUE(near(x * second.by[i].by[0], difference(along_x, 1e-3), fourth));
    EXPECT_TRUE(near(y * second.by[i].by[1], difference(along_y, 1e-3), fourth));
  }
  static_assert(bite::orders_of<double> == 1 && bite::orders_of<Inner> == 1 &&
                bite::orders_of<Dual<5, Inner>> == 2);
}

// Steady state and coefficients by every number, for every law of hardening and friction.
TEST(LinearSensitivity, EqualsDifferencesUnderEveryLaw)
{
  for (const RollBite &pass : passes())
    for (const Linearisation scheme : schemes) {
      const Solved base = solved(pass, scheme);
      const auto d      = linear_sensitivity(pass, base.state, scheme);
      for (const PassNumber number : numbers_of(pass)) {
        const auto value_at = [&](const double f) { return solved(with_number_scaled(pass, number, f), scheme); };
        const double e      = 2e-4;
        const Solved a[4]{value_at(1 + e), value_at(1 - e), value_at(1 + 2 * e), value_at(1 - 2 * e)};
        const auto expect = [&](const double exact, const auto &function, const char *what) {
          const double one        = (function(a[0]) - function(a[1])) / (2 * e),
                       two        = (function(a[2]) - function(a[3])) / (4 * e);
          const double size       = std::abs(function(base));
          const double difference = (4 * one - two) / 3;
          // 2e-4 to the fourth power times a curvature below 1e6; rounding of states 1e-14 over the step.
          EXPECT_LE(std::abs(exact - difference), 1e-7 * size)
              << what << " by " << name_of(number).key << ", " << name_of(pass.strip.flow_stress.law) << ", "
              << name_of(pass.strip.friction.law);
        };
        const int p = int(number);
        expect(
            d.flattened_radius[p], [](const Solved &s) { return s.state.flattened_radius; }, "R'");
        expect(
            d.friction[p], [](const Solved &s) { return s.state.friction; }, "mu");
        expect(
            d.force[p], [](const Solved &s) { return s.state.force; }, "F");
        expect(
            d.entry_speed[p], [](const Solved &s) { return s.state.entry_speed; }, "v_e");
        expect(
            d.exit_speed[p], [](const Solved &s) { return s.state.exit_speed; }, "v_d");
        expect(
            d.neutral_position[p], [](const Solved &s) { return s.state.neutral_position; }, "x_n");
        for (const std::size_t i : {0, 1, 2, 3, 4}) {
          if (i != 2 || scheme != Linearisation::sequential)  // mu by sigma_e is rounding there
            expect(
                d.by[p].friction[i], [=](const Solved &s) { return s.by.friction[i]; }, "dmu");
          expect(
              d.by[p].entry_speed[i], [=](const Solved &s) { return s.by.entry_speed[i]; }, "P");
          expect(
              d.by[p].exit_speed[i], [=](const Solved &s) { return s.by.exit_speed[i]; }, "Q");
          expect(
              d.by[p].force[i], [=](const Solved &s) { return s.by.force[i]; }, "F_i");
          expect(
              d.by[p].neutral_position[i], [=](const Solved &s) { return s.by.neutral_position[i]; }, "n");
        }
      }
    }
}

// What the units of the inputs alone say, at random passes: all stresses, all lengths and times, the width.
TEST(LinearSensitivity, RandomPassesSatisfySimilarity)
{
  std::mt19937 random(20170515);
  const auto between = [&](const double a, const double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  int tried = 0;
  while (tried < 60) {
    RollBite b                 = film_pass();
    b.roll_radius              = between(0.2, 0.4);
    b.roll_speed               = between(8, 25);
    b.strip.width              = between(0.6, 1.8);
    b.strip.entry_thickness    = between(0.5e-3, 2e-3);
    b.strip.exit_thickness     = b.strip.entry_thickness * between(0.65, 0.9);
    b.strip.entry_tension      = between(50e6, 200e6);
    b.strip.exit_tension       = between(50e6, 200e6);
    b.strip.friction.viscosity = between(0.003, 0.01);
    const Linearisation scheme = schemes[tried % 3];
    Solved s;
    try {
      s = solved(b, scheme);
    } catch (const std::runtime_error &) {
      continue;  // no bite
    }
    ++tried;
    const auto d   = linear_sensitivity(b, s.state, scheme);
    const auto sum = [](const auto &by, std::initializer_list<std::pair<PassNumber, int>> list) {
      double total = 0;
      for (const auto &[number, power] : list)
        total += power * by[int(number)];
      return total;
    };
    using N            = PassNumber;
    const auto stress  = {std::pair{N::stress, 1},       std::pair{N::entry_tension, 1},
                          std::pair{N::exit_tension, 1}, std::pair{N::youngs_modulus, 1},
                          std::pair{N::viscosity, 1},    std::pair{N::pressure_viscosity, -1}};
    const auto lengths = {
        std::pair{N::entry_thickness, 1}, std::pair{N::exit_thickness, 1}, std::pair{N::initial_thickness, 1},
        std::pair{N::roll_radius, 1},     std::pair{N::width, 1},          std::pair{N::roll_speed, 1},
        std::pair{N::decay, -1}};
    const auto exact = within(1e-9, "similarity is exact; sums of slopes some ten times their result", 1);
    EXPECT_TRUE(near(sum(d.friction, stress) / s.state.friction, 0, exact));
    EXPECT_TRUE(near(sum(d.force, stress) / s.state.force, 1, exact));
    EXPECT_TRUE(near(sum(d.friction, lengths) / s.state.friction, 0, exact));
    EXPECT_TRUE(near(sum(d.force, lengths) / s.state.force, 2, exact));
    EXPECT_TRUE(near(sum(d.entry_speed, lengths) / s.state.entry_speed, 1, exact));
    EXPECT_TRUE(near(d.force[int(N::width)] / s.state.force, 1, exact));
    EXPECT_TRUE(near(d.friction[int(N::width)] / s.state.friction, 0, exact));
    EXPECT_TRUE(
        near(d.force[int(N::stress)] / s.state.force, d.force[int(N::stress_factor)] / s.state.force, exact));
    EXPECT_TRUE(near(d.by[int(N::width)].force[0] / s.by.force[0], 1, exact));
    EXPECT_TRUE(near(d.by[int(N::stress)].force[1] / s.by.force[1],
                     d.by[int(N::stress_factor)].force[1] / s.by.force[1], exact));
  }
}

TEST(LinearSensitivity, ListsTheNumbersThatActInAPass)
{
  RollBite b     = film_pass();
  const auto has = [&](const PassNumber number) {
    const auto all = numbers_of(b);
    return std::find(all.begin(), all.end(), number) != all.end();
  };
  EXPECT_TRUE(has(PassNumber::viscosity) && has(PassNumber::initial_thickness) && has(PassNumber::pre_strain));
  EXPECT_FALSE(has(PassNumber::friction) || has(PassNumber::initial_stress));
  b.strip.initial_thickness = not_given;
  b.strip.exit_tension      = 0;
  EXPECT_FALSE(has(PassNumber::initial_thickness) || has(PassNumber::exit_tension));
  b.strip.flow_stress = {FlowStressLaw::table, 0, 0, 0, 0, {{0, 5e8}, {1, 6e8}}};
  EXPECT_FALSE(has(PassNumber::stress));
  EXPECT_EQ(value_of(b, PassNumber::stress_factor), 1);
  EXPECT_EQ(with_number_scaled(b, PassNumber::stress_factor, 2).strip.flow_stress.table[1][1], 12e8);
  b.roll_speed = not_given;
  EXPECT_THROW(linear_sensitivity(b, {}, Linearisation::sequential), InputError);
}
