// Derivatives of the vibrating bite and of the critical speed by every input: differences, similarity, other laws.
#include "bite/slab/bland_ford.h"
#include "core/case/errors.h"
#include "dynamics/chatter/sensitivity.h"
#include "tests/support/film_pass.h"
#include "tests/support/near.h"
#include <algorithm>
#include <random>
#include <utility>

using namespace mill;
using namespace mill::dynamics;
using bite::Dual;
using bite::Linearisation;
using bite::PassNumber;
using bite::RollBite;

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
    s.flow_stress.table = {
        {0,   500e6},
        {1,   700e6},
        {1.5, 760e6},
        {2,   800e6}
    };
  });
  // Strain from the entry, hardening with an infinite slope there.
  add([](Strip &s) {
    s.flow_stress       = {FlowStressLaw::ludwik, 300e6, 0, 0.4, 650e6};
    s.initial_thickness = not_given;
  });
  return all;
}

/// (f(1 + e) - f(1 - e))/(2 e) from two steps, without its error of second order.
template <class F> double difference(const F &f, const double e)
{
  const double one = (f(1 + e) - f(1 - e)) / (2 * e), two = (f(1 + 2 * e) - f(1 - 2 * e)) / (4 * e);
  return (4 * one - two) / 3;
}

struct Six {
  std::array<double, 6> mass{119e3, 75e3, 9.2e3, 9.2e3, 75e3, 36.5e3};
  std::array<double, 6> stiffness{6.9e10, 3.0e10, 6.06e10, 6.06e10, 4.4e10, 10.1e10};
  std::array<double, 6> damping{6.05e5, 4.25e5, 6.05e5, 6.05e5, 4.25e5, 6.05e5};
  ChatterStandModel stand() const
  {
    return {six_mass_structure(mass, stiffness, damping), 4.95, 4.95, 210e9};
  }
  std::vector<StructureNumber> numbers() const
  {
    return six_mass_numbers(mass, stiffness, damping);
  }
};

const ChatterSensitivity &row(const SensitivityTable &table, const std::string &key)
{
  const auto found =
      std::find_if(table.inputs.begin(), table.inputs.end(), [&](const auto &s) { return s.key == key; });
  if (found == table.inputs.end())
    throw std::logic_error("no input " + key);
  return *found;
}

SensitivityRequest at_work(const double change = 0)
{
  SensitivityRequest request;
  request.working_speed = 18.2;
  request.change        = change;
  return request;
}

LumpedModel chain()
{
  LumpedModel model;
  const double M[6]{119e3, 75e3, 9.2e3, 9.2e3, 75e3, 36.5e3};
  const double K[7]{6.9e10, 3.0e10, 6.06e10, 2e10, 6.06e10, 4.4e10, 10.1e10};
  for (std::size_t i = 0; i < 6; ++i)
    model.M[i].value = M[i];
  for (std::size_t i = 0; i < 7; ++i)
    model.K[i].value = K[i];
  model.C.value = not_given;
  return model;
}

DynamicsSettings damped()
{
  DynamicsSettings settings;
  settings.force_meaning = "measured";
  settings.frame         = "open";
  settings.modal_damping = 0.01;
  return settings;
}

/// Matrices of the numbers against differences of the changed structures.
void expect_derivatives(const StandStructure &base, const std::vector<StructureNumber> &numbers)
{
  for (const StructureNumber &number : numbers) {
    const auto check = [&](const char *name, const Eigen::MatrixXd &by, const auto &of) {
      const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(base.n(), base.n());
      const Eigen::MatrixXd d1   = (of(number.scaled(1.01)) - of(number.scaled(0.99))) / 0.02;
      const Eigen::MatrixXd d2   = (of(number.scaled(1.02)) - of(number.scaled(0.98))) / 0.04;
      const Eigen::MatrixXd d    = (4 * d1 - d2) / 3;
      const double size          = of(base).cwiseAbs().maxCoeff();
      EXPECT_LT(((by.size() ? by : zero) - d).cwiseAbs().maxCoeff(), 1e-7 * size) << number.key << " " << name;
    };
    check("M", number.M_by, [](const StandStructure &s) { return s.M; });
    check("C", number.C_by, [](const StandStructure &s) { return s.C; });
    check("K", number.K_by, [](const StandStructure &s) { return s.K; });
  }
}
}  // namespace

TEST(SecondDerivatives, AreSymmetricAndThoseOfTheFirst)
{
  const auto f = [](const auto &x, const auto &y) {
    using std::atan;
    using std::log;
    return pow(x, y) * exp(-1.0 * x * y) + atan(x / y) * log(x + y) + bite::expm1(x) / sqrt(y) - tan(x) * cos(y);
  };
  using Inner    = Dual<2>;
  const auto at  = [&](const double x, const double y) { return f(Inner::variable(x, 0), Inner::variable(y, 1)); };
  const double x = 0.7, y = 1.3;
  const auto second =
      f(Dual<2, Inner>::variable(Inner::variable(x, 0), 0), Dual<2, Inner>::variable(Inner::variable(y, 1), 1));
  EXPECT_TRUE(near(second.by[0].by[1], second.by[1].by[0], within(1e-14, "Schwarz")));
  for (int i = 0; i < 2; ++i) {
    EXPECT_TRUE(near(second.by[i].value, at(x, y).by[std::size_t(i)], within(1e-14, "the same first derivative")));
    const auto along_x = [&](const double c) { return at(x * c, y).by[std::size_t(i)]; };
    const auto along_y = [&](const double c) { return at(x, y * c).by[std::size_t(i)]; };
    const auto fourth  = within(1e-9, "differences without the error of second order, step 1e-3");
    EXPECT_TRUE(near(x * second.by[i].by[0], difference(along_x, 1e-3), fourth));
    EXPECT_TRUE(near(y * second.by[i].by[1], difference(along_y, 1e-3), fourth));
  }
  static_assert(bite::orders_of<double> == 1 && bite::orders_of<Inner> == 1 &&
                bite::orders_of<Dual<5, Inner>> == 2);
}

// Steady state and coefficients by every number, for every law of hardening and friction.
TEST(LinearSensitivity, DifferencesUnderEveryLaw)
{
  for (const RollBite &pass : passes())
    for (const Linearisation scheme : schemes) {
      const Solved base = solved(pass, scheme);
      const auto d      = linear_sensitivity(pass, base.state, scheme);
      for (const PassNumber number : numbers_of(pass)) {
        const auto at  = [&](const double f) { return solved(with_number_scaled(pass, number, f), scheme); };
        const double e = 2e-4;
        const Solved a[4]{at(1 + e), at(1 - e), at(1 + 2 * e), at(1 - 2 * e)};
        const auto expect = [&](const double exact, const auto &of, const char *what) {
          const double one = (of(a[0]) - of(a[1])) / (2 * e), two = (of(a[2]) - of(a[3])) / (4 * e);
          const double size = std::abs(of(base));
          // 2e-4 to the fourth power times a curvature below 1e6; rounding of states 1e-14 over the step.
          EXPECT_NEAR(exact, (4 * one - two) / 3, 1e-7 * size)
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
TEST(LinearSensitivity, SimilarityOfRandomPasses)
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
    const auto sum = [](const auto &by, std::initializer_list<std::pair<PassNumber, int>> of) {
      double total = 0;
      for (const auto &[number, power] : of)
        total += power * by[int(number)];
      return total;
    };
    using N           = PassNumber;
    const auto stress = {
        std::pair{N::stress,             1 },
        std::pair{N::entry_tension,      1 },
        std::pair{N::exit_tension,       1 },
        std::pair{N::youngs_modulus,     1 },
        std::pair{N::viscosity,          1 },
        std::pair{N::pressure_viscosity, -1}
    };
    const auto lengths = {
        std::pair{N::entry_thickness,   1 },
        std::pair{N::exit_thickness,    1 },
        std::pair{N::initial_thickness, 1 },
        std::pair{N::roll_radius,       1 },
        std::pair{N::width,             1 },
        std::pair{N::roll_speed,        1 },
        std::pair{N::decay,             -1}
    };
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

TEST(LinearSensitivity, NumbersOfAPass)
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
  b.strip.flow_stress = {
      FlowStressLaw::table, 0, 0, 0, 0, {{0, 5e8}, {1, 6e8}}
  };
  EXPECT_FALSE(has(PassNumber::stress));
  EXPECT_EQ(value_of(b, PassNumber::stress_factor), 1);
  EXPECT_EQ(with_number_scaled(b, PassNumber::stress_factor, 2).strip.flow_stress.table[1][1], 12e8);
  b.roll_speed = not_given;
  EXPECT_THROW(linear_sensitivity(b, {}, Linearisation::sequential), InputError);
}

TEST(StructureNumbers, MatricesOfSixMassesChainAndModes)
{
  const Six six;
  expect_derivatives(six.stand().structure, six.numbers());
  for (const char *frame : {"open", "closed"}) {
    DynamicsSettings settings = damped();
    settings.frame            = frame;
    expect_derivatives(structure_of(mill_model(chain(), settings)), chain_numbers(chain(), settings));
  }
  ModalModel modes;
  modes.frequency    = (Eigen::VectorXd(3) << 40, 120, 310).finished();
  modes.damping      = 0.02;
  modes.point        = Eigen::MatrixXd::Random(6, 3) * 0.01;
  modes.force        = (Eigen::VectorXd(3) << 0.01, -0.006, 0.003).finished();
  modes.labels       = {"1", "2", "3", "4", "5", "6"};
  const auto numbers = modal_numbers(modes);
  EXPECT_EQ(numbers.size(), 4u);
  expect_derivatives(structure_of(modes), numbers);
  EXPECT_EQ(six_mass_numbers(six.mass, six.stiffness, {}).size(), 12u);  // dampers of zero are no inputs
}

// All masses, springs, dampers and the width of the strip by one factor: every force by it, the motion the same.
TEST(ChatterSensitivity, SimilarityOfTheStand)
{
  const Six six;
  for (const Linearisation scheme : schemes) {
    SensitivityRequest request = at_work();
    request.scheme             = scheme;
    const auto table           = chatter_sensitivities(six.stand(), six.numbers(), film_pass(), request);
    double speed = 0, growth = 0;
    for (const ChatterSensitivity &s : table.inputs)
      if ((s.key.rfind("stand.", 0) == 0 && s.key.back() == ']') || s.key == "condition.width") {
        speed += s.critical_speed;
        growth += s.growth;
      }
    const auto exact = within(1e-8, "exact; slopes to 1e-10", 1);
    EXPECT_TRUE(near(speed, 0, exact));
    EXPECT_TRUE(near(growth, 0, within(1e-7, "1/s, of slopes up to 50", 1)));
    double dampings = 0;
    for (const ChatterSensitivity &s : table.inputs)
      if (s.key.rfind("stand.dampings[", 0) == 0)
        dampings += s.critical_speed;
    EXPECT_TRUE(near(row(table, "stand.dampings").critical_speed, dampings, exact));
    EXPECT_TRUE(near(row(table, "condition.tensions").critical_speed,
                     row(table, "condition.entry_tension").critical_speed +
                         row(table, "condition.exit_tension").critical_speed,
                     exact));
    EXPECT_TRUE(near(row(table, "strip.youngs_modulus").growth, -row(table, "stand.distances").growth, exact));
  }
}

// Growth rate at the working speed against differences of eigenvalues.
TEST(ChatterSensitivity, GrowthRateByDifferences)
{
  const Six six;
  const RollBite pass = film_pass();
  const auto table    = chatter_sensitivities(six.stand(), six.numbers(), pass, at_work());
  const auto growth   = [](const ChatterStandModel &stand, const RollBite &b) {
    return growth_rate(chatter_matrix(stand, working_point(b, b.roll_speed, Linearisation::sequential).by));
  };
  EXPECT_EQ(table.growth, growth(six.stand(), pass));
  const auto fourth = within(1e-6, "differences without the error of second order", 1);
  for (const PassNumber number : numbers_of(pass)) {
    const auto f = [&](const double c) { return growth(six.stand(), with_number_scaled(pass, number, c)); };
    EXPECT_TRUE(near(row(table, name_of(number).key).growth, difference(f, 1e-3), fourth)) << name_of(number).key;
  }
  for (const StructureNumber &number : six.numbers()) {
    const auto f = [&](const double c) {
      ChatterStandModel stand = six.stand();
      stand.structure         = number.scaled(c);
      return growth(stand, pass);
    };
    EXPECT_TRUE(near(row(table, number.key).growth, difference(f, 1e-3), fourth)) << number.key;
  }
  EXPECT_EQ(row(table, "work_roll.diameter").value, 0.6);
}

// A stand taken from a lumped model with modal damping.
TEST(ChatterSensitivity, ChainWithModalDamping)
{
  const ChatterStandModel stand{structure_of(mill_model(chain(), damped())), 5, 5, 210e9};
  const auto numbers = chain_numbers(chain(), damped());
  const auto table   = chatter_sensitivities(stand, numbers, film_pass(), at_work());
  ASSERT_FALSE(std::isnan(table.critical_speed)) << table.verdict;
  SpeedRange close;
  close.from = table.critical_speed - 0.5;
  close.to   = table.critical_speed + 0.5;
  close.step = 0.5;
  for (const StructureNumber &number : numbers) {
    const auto f = [&](const double c) {
      ChatterStandModel other = stand;
      other.structure         = number.scaled(c);
      return std::log(critical_speed(other, film_pass(), Linearisation::sequential, close).speed);
    };
    EXPECT_TRUE(near(row(table, number.key).critical_speed, difference(f, 1e-3),
                     within(1e-7, "searches to 1e-10 m/s over steps of 1e-3", 1)))
        << number.key;
  }
}

TEST(ChatterSensitivity, WithoutCriticalSpeed)
{
  const Six six;
  SensitivityRequest request = at_work(0.1);
  request.range.from         = 12;
  request.range.to           = 17.5;
  request.range.step         = 1;
  request.working_speed      = 15;
  const auto table           = chatter_sensitivities(six.stand(), {}, film_pass(), request);
  EXPECT_TRUE(std::isnan(table.critical_speed));
  EXPECT_EQ(table.verdict.rfind("stable from 12 to 17.5 m/s", 0), 0u) << table.verdict;
  EXPECT_TRUE(std::isnan(table.inputs.front().critical_speed));
  EXPECT_GE(std::abs(table.inputs.front().growth), std::abs(table.inputs.back().growth));
  // A softer strip is below the range's end; the unchanged one is not.
  const ChatterSensitivity &k = row(table, "strip.flow_stress.k");
  EXPECT_TRUE(std::isnan(k.lowered.critical_speed));
  EXPECT_EQ(k.lowered.outcome.rfind("critical speed 16.", 0), 0u) << k.lowered.outcome;
  EXPECT_EQ(k.raised.outcome.rfind("stable from 12 to 17.5 m/s", 0), 0u) << k.raised.outcome;
  EXPECT_FALSE(std::isnan(k.raised.friction));
}

TEST(ChatterSensitivity, ThreadsChangeNothing)
{
  const Six six;
  SensitivityRequest request = at_work(0.1);
  request.range.from         = 16;
  request.range.to           = 21;
  request.threads            = 1;
  const auto one             = chatter_sensitivities(six.stand(), six.numbers(), film_pass(), request);
  request.threads            = 3;
  const auto three           = chatter_sensitivities(six.stand(), six.numbers(), film_pass(), request);
  ASSERT_EQ(one.inputs.size(), three.inputs.size());
  const auto same = [](const double a, const double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  for (std::size_t i = 0; i < one.inputs.size(); ++i) {
    const ChatterSensitivity &a = one.inputs[i], &b = three.inputs[i];
    EXPECT_EQ(a.key, b.key);
    EXPECT_TRUE(same(a.lowered.critical_speed, b.lowered.critical_speed)) << a.key;
    EXPECT_TRUE(same(a.raised.critical_speed, b.raised.critical_speed)) << a.key;
    EXPECT_TRUE(same(a.raised.friction, b.raised.friction)) << a.key;
    EXPECT_EQ(a.raised.outcome, b.raised.outcome);
  }
}

TEST(ChatterSensitivity, FiniteChangesWithoutBite)
{
  const Six six;
  RollBite pass                   = film_pass();
  pass.strip.exit_thickness       = 0.72e-3;  // 9 %: a tenth less at the entry is no reduction
  SensitivityRequest request      = at_work(0.1);
  request.range.from              = 16;
  request.range.to                = 20;
  const auto table                = chatter_sensitivities(six.stand(), {}, pass, request);
  const ChatterSensitivity &entry = row(table, "condition.entry_thickness");
  EXPECT_TRUE(std::isnan(entry.lowered.friction));
  EXPECT_EQ(entry.lowered.outcome,
            "strip.exit_thickness = 0.72 mm must be positive and below strip.entry_thickness = 0.7101 mm");
}

TEST(ChatterSensitivity, RefusesInWords)
{
  const Six six;
  SensitivityRequest request = at_work();
  request.working_speed      = 0;
  const auto message         = [&] {
    try {
      chatter_sensitivities(six.stand(), {}, film_pass(), request);
    } catch (const InputError &error) {
      return error.problems.front().message;
    }
    return std::string("accepted");
  };
  EXPECT_EQ(message(), "sensitivities need a working speed above zero, not 0 m/s");
  request        = at_work();
  request.change = 1;
  EXPECT_EQ(message(), "a finite change of 1 has to lie between 0 and 1");
}

// Two modes that become one: no derivative.
TEST(EigenvalueSlope, RefusesADoubleEigenvalue)
{
  Eigen::Matrix2d jordan;
  jordan << -1, 1, 0, -1;
  EXPECT_THROW(slope_of_eigenvalue(jordan, -1), SolverError);
  Eigen::Matrix2d turn, by = Eigen::Matrix2d::Zero();
  turn << -1, 3, -3, -1;
  by(0, 0)         = 1;
  const auto slope = slope_of_eigenvalue(turn, {-1, 3});
  EXPECT_TRUE(near(slope.by(by).real(), 0.5, within(1e-14, "closed form: half the trace")));
  EXPECT_TRUE(near(slope.value.imag(), 3, within(1e-14, "closed form")));
}
