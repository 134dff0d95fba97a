// Derivatives of the critical speed by every input: differences, similarity.
#include "core/base/errors.h"
#include "dynamics/chatter/sensitivity.h"
#include "reduce/bite/slab/bland_ford.h"
#include "tests/support/difference.h"
#include "tests/support/film_pass.h"
#include "tests/support/near.h"
#include <algorithm>

using namespace mill;
using namespace mill::dynamics;
using bite::PassNumber;
using bite::RollBite;
using mill::Linearisation;

namespace {
constexpr Linearisation schemes[]{Linearisation::sequential, Linearisation::implicit,
                                  Linearisation::frozen_friction};

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
  const auto result =
      std::find_if(table.inputs.begin(), table.inputs.end(), [&](const auto &s) { return s.key == key; });
  if (result == table.inputs.end())
    throw std::logic_error("no input " + key);
  return *result;
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
  settings.force_meaning = ForceMeaning::measured;
  settings.frame         = FrameForm::open;
  settings.modal_damping = 0.01;
  return settings;
}

/// Matrices of the numbers against differences of the changed structures.
void expect_derivatives(const StandStructure &base, const std::vector<StructureNumber> &numbers)
{
  for (const StructureNumber &number : numbers) {
    const auto check = [&](const char *name, const Eigen::MatrixXd &by, const auto &function) {
      const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(base.n(), base.n());
      const Eigen::MatrixXd d1   = (function(number.scaled(1.01)) - function(number.scaled(0.99))) / 0.02;
      const Eigen::MatrixXd d2   = (function(number.scaled(1.02)) - function(number.scaled(0.98))) / 0.04;
      const Eigen::MatrixXd d    = (4 * d1 - d2) / 3;
      const double size          = function(base).cwiseAbs().maxCoeff();
      EXPECT_LT(((by.size() ? by : zero) - d).cwiseAbs().maxCoeff(), 1e-7 * size) << number.key << " " << name;
    };
    check("M", number.M_by, [](const StandStructure &s) { return s.M; });
    check("C", number.C_by, [](const StandStructure &s) { return s.C; });
    check("K", number.K_by, [](const StandStructure &s) { return s.K; });
  }
}
}  // namespace

TEST(StructureNumbers, ReproduceTheMatricesOfSixMassesChainAndModes)
{
  const Six six;
  expect_derivatives(six.stand().structure, six.numbers());
  for (const FrameForm frame : every<FrameForm>()) {
    DynamicsSettings settings = damped();
    settings.frame            = frame;
    expect_derivatives(structure_of(mill_model(chain(), settings)), chain_numbers(chain(), settings));
  }
  LumpedModel on_films    = chain();
  on_films.film           = {ChainFilm{6e10, 2e8}, ChainFilm{9e10, 1e8}};
  on_films.film_frequency = 120;
  on_films.moving_mass    = {118e3, 74e3, 9.3e3, 9.1e3, 76e3, 37e3};
  expect_derivatives(structure_of(mill_model(on_films, damped())), chain_numbers(on_films, damped()));
  ModalModel modes;
  modes.frequency    = (Eigen::VectorXd(3) << 40, 120, 310).finished();
  modes.damping      = 0.02;
  modes.point        = Eigen::MatrixXd::Random(6, 3) * 0.01;
  modes.force        = (Eigen::VectorXd(3) << 0.01, -0.006, 0.003).finished();
  modes.labels       = {"1", "2", "3", "4", "5", "6"};
  const auto numbers = modal_numbers(modes);
  EXPECT_EQ(numbers.size(), 4u);
  expect_derivatives(structure_of(modes), numbers);
  EXPECT_EQ(six_mass_numbers(six.mass, six.stiffness, {}).size(), 12u);  // dampers of zero are not inputs
}

// All masses, springs, dampers and the width of the strip by one factor: every force by it, the motion the same.
TEST(ChatterSensitivity, SlopesSatisfyTheSimilarityOfTheStand)
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
TEST(ChatterSensitivity, SlopeOfTheGrowthRateIsThatOfDifferences)
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
TEST(ChatterSensitivity, WorksForAChainWithModalDamping)
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

TEST(ChatterSensitivity, WithoutACriticalSpeedOnlyTheGrowthRateHasSlopes)
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

TEST(ChatterSensitivity, ResultIsTheSameForAnyNumberOfThreads)
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

TEST(ChatterSensitivity, FiniteChangesWithoutABiteStateTheReason)
{
  const Six six;
  RollBite pass                   = film_pass();
  pass.strip.exit_thickness       = 0.72e-3;  // 9 %: a tenth less at the entry leaves no reduction
  SensitivityRequest request      = at_work(0.1);
  request.range.from              = 16;
  request.range.to                = 20;
  const auto table                = chatter_sensitivities(six.stand(), {}, pass, request);
  const ChatterSensitivity &entry = row(table, "condition.entry_thickness");
  EXPECT_TRUE(std::isnan(entry.lowered.friction));
  EXPECT_EQ(entry.lowered.outcome,
            "strip.exit_thickness = 0.72 mm must be positive and below strip.entry_thickness = 0.7101 mm");
}

TEST(ChatterSensitivity, RefusesWrongRequestsWithTheReason)
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
