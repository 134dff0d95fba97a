// The level of a stand that rolls a pass, against the equations of motion of stand, bite and strip solved
// frequency by frequency, and its limits.
#include "core/base/errors.h"
#include "dynamics/chatter/chatter.h"
#include "tests/support/film_pass.h"
#include "tests/support/near.h"
#include "tests/support/rated_action.h"
#include "twin/advice/advice.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>

using namespace mill;
using namespace mill::twin;

namespace {
using Complex = std::complex<double>;

constexpr double modal_damping = 0.03, spans = 4.95, modulus = 2.1e11;

// Stand D as a chain; K3 follows the rolling force as force^0.1, so that the way over the contacts is seen.
LumpedModel lumped(const double force = 1, const double K3 = 1)
{
  LumpedModel chain;
  const double M[]{119e3, 75e3, 9.2e3, 9.2e3, 75e3, 36.5e3},
      K[]{6.9e10, 3.0e10, 6.06e10 * K3 * std::pow(force, 0.1), 8e9, 6.06e10, 4.4e10, 10.1e10};
  for (std::size_t i = 0; i < 6; ++i)
    chain.M[i].value = M[i];
  for (std::size_t i = 0; i < 7; ++i)
    chain.K[i].value = K[i];
  chain.C.value = 3e5;
  return chain;
}

dynamics::MillModel model_of(const LumpedModel &chain, const ForceMeaning force_meaning)
{
  DynamicsSettings settings;
  settings.modal_damping = modal_damping;
  settings.force_meaning = force_meaning;
  return dynamics::mill_model(chain, settings);
}

const Eigen::VectorXd damping = Eigen::VectorXd::Constant(6, modal_damping);

std::optional<VibratingStand> open_chain(const StandChange &change)
{
  return open_stand(model_of(lumped(change.force), ForceMeaning::disturbance), damping, change);
}

dynamics::ChatterStandModel around(const dynamics::StandStructure &structure)
{
  return {structure, spans, spans, modulus};
}

RolledPass pass_at(const double speed)
{
  RolledPass pass;
  pass.model.bite    = film_pass();
  pass.model.stand   = around({});
  pass.working_speed = speed;
  return pass;
}

ForceBand band()
{
  return white_force(20, 600, 1.5, 1e4);
}

// One disturbance of the rolling force of 1 N at w: acceleration of a place, and the whole force on the rolls.
struct Driven {
  Complex acceleration, force;
};

Driven driven(const dynamics::ChatterStandModel &stand, const dynamics::WorkingPoint &point, const int place,
              const double w)
{
  const Eigen::MatrixXd A = dynamics::chatter_matrix(stand, point.by);
  const Eigen::Index n    = stand.structure.n();
  Eigen::VectorXcd push   = Eigen::VectorXcd::Zero(2 * n + 2);
  push.segment(n, n)      = Eigen::VectorXd(stand.structure.M.lu().solve(stand.structure.b)).cast<Complex>();
  Eigen::MatrixXcd system = -A.cast<Complex>();
  system.diagonal().array() += Complex(0, w);
  // In units of like size: the tensions are large, the displacements small.
  const Eigen::VectorXd unit  = dynamics::balance(A);
  const Eigen::VectorXd back  = unit.cwiseInverse();
  const Eigen::MatrixXcd even = back.cast<Complex>().asDiagonal() * system * unit.cast<Complex>().asDiagonal();
  const Eigen::VectorXcd z    = unit.cast<Complex>().asDiagonal() *
                             even.partialPivLu().solve(Eigen::VectorXcd(back.cast<Complex>().asDiagonal() * push));
  const auto &F        = point.by.force;
  const Complex gap    = stand.structure.b.cast<Complex>().dot(z.head(n)),
                rate   = stand.structure.b.cast<Complex>().dot(z.segment(n, n));
  const Complex motion = stand.structure.point.row(place).cast<Complex>() * z.head(n);
  return {-w * w * motion, 1.0 + F[0] * gap + F[1] * rate + F[2] * z[2 * n] + F[3] * z[2 * n + 1]};
}

double level_by_equations(const bite::RollBite &bite, const double speed, const LumpedModel &after,
                          const double c_upper, const RolledPass &before, const ForceBand &force)
{
  const auto structure = [](const LumpedModel &chain) {
    return dynamics::structure_of(model_of(chain, ForceMeaning::measured));
  };
  dynamics::StandStructure changed = structure(after);
  changed.C(1, 1) += c_upper, changed.C(2, 2) += c_upper;
  changed.C(1, 2) -= c_upper, changed.C(2, 1) -= c_upper;
  const auto scheme = before.model.scheme;
  const auto now    = dynamics::working_point(before.model.bite, before.working_speed, scheme),
             then   = dynamics::working_point(bite, speed, scheme);
  double square     = 0;
  for (Eigen::Index k = 0; k < force.frequency.size(); ++k) {
    const double w = 2 * M_PI * force.frequency[k];
    const Driven a = driven(around(structure(lumped())), now, 2, w), b = driven(around(changed), then, 2, w);
    square += force.square[k] * std::norm(b.acceleration / a.force);
  }
  return std::sqrt(square);
}

ProcessAction process(const bite::PassNumber number, const double factor)
{
  ProcessAction one;
  one.number = int(number), one.factor = factor;
  return one;
}

AdvisedStand advised()
{
  const auto chain = model_of(lumped(), ForceMeaning::measured);
  return {vibrating_stand(chain, damping), chain, open_chain};
}

LevelQuestion question(const double speed)
{
  LevelQuestion q;
  q.force               = band();
  q.springs             = {{"K3", 0.8, 1.2, "diameters"}};
  q.pass                = pass_at(speed);
  q.pass->process.speed = {0.95, 1};
  q.softening           = 1;
  q.rise_elsewhere      = 10;
  return q;
}
}  // namespace

TEST(RolledLevel, ProcessActionsAreTheCoupledEquations)
{
  const ForceBand force = band();
  const RolledPass pass = pass_at(8);
  const RolledLevel level(pass, open_chain, force);
  ASSERT_TRUE(level.settled()) << level.now().growth;
  const double before = dynamics::working_point(pass.model.bite, 8, pass.model.scheme).state.force;
  const auto changed  = [&](const bite::PassNumber number, const double factor) {
    return with_number_scaled(pass.model.bite, number, factor);
  };
  const Tolerance same = within(1e-8, "one set of equations solved in two ways");
  for (const auto &[number, factor] : {std::pair(bite::PassNumber::entry_thickness, 0.95),
                                       {bite::PassNumber::entry_tension, 1.2},
                                       {bite::PassNumber::viscosity, 0.8}}) {
    const auto bite  = changed(number, factor);
    const double now = dynamics::working_point(bite, 8, pass.model.scheme).state.force / before;
    const auto after = level.after({}, {}, {process(number, factor)});
    ASSERT_TRUE(after && after->level.size() == 6);
    EXPECT_TRUE(near(after->level[2], level_by_equations(bite, 8, lumped(now), 0, pass, force), same));
    EXPECT_TRUE(near(after->critical.force / before, now, within(1e-12, "one bite")));
  }
  // Slower, a softer contact and a damper at once.
  ProcessAction slower;
  slower.factor = 0.9;
  StandChange softer;
  softer.springs.emplace_back("K3", 0.8);
  Attachment damper;
  damper.from = 1, damper.to = 2, damper.damper = 2e5;
  const double now = dynamics::working_point(pass.model.bite, 7.2, pass.model.scheme).state.force / before;
  const auto after = level.after(softer, {damper}, {slower});
  ASSERT_TRUE(after && after->level.size() == 6);
  EXPECT_TRUE(
      near(after->level[2], level_by_equations(pass.model.bite, 7.2, lumped(now, 0.8), 2e5, pass, force), same));
}

// A factor of one changes nothing.  Where the force is that of the whole bite, the loop leaves the stand without
// it.
TEST(RolledLevel, WithoutActionsTheLevelIsUnchanged)
{
  const ForceBand force = band();
  const RolledLevel level(pass_at(8), open_chain, force);
  ASSERT_EQ(level.level().size(), 6);
  const auto after = level.after({}, {}, {ProcessAction()});  // speed x 1
  ASSERT_TRUE(after && after->level.size() == 6);
  const Eigen::VectorXd of_stand = levels(*open_chain({}), {}, force);
  for (const Eigen::Index place : {0, 2, 3, 5}) {
    EXPECT_TRUE(near(level.level()[place], of_stand[place], within(1e-9, "nothing was done")));
    EXPECT_TRUE(near(after->level[place], of_stand[place], within(1e-9, "nothing was done")));
  }
  EXPECT_EQ(after->nearer, 0);
}

// A force that is the disturbance itself drives the coupled equations before and after.
TEST(RolledLevel, ADisturbanceDrivesTheCoupledEquations)
{
  const ForceBand force = band();
  RolledPass pass       = pass_at(8);
  pass.disturbance      = true;
  const RolledLevel level(pass, open_chain, force);
  const auto bite   = with_number_scaled(pass.model.bite, bite::PassNumber::exit_tension, 0.8);
  const auto scheme = pass.model.scheme;
  const auto now    = dynamics::working_point(pass.model.bite, 8, scheme),
             then   = dynamics::working_point(bite, 8, scheme);
  const auto stand  = [](const double ratio) {
    return around(dynamics::structure_of(model_of(lumped(ratio), ForceMeaning::measured)));
  };
  const auto before = stand(1), behind = stand(then.state.force / now.state.force);
  double square = 0, square_after = 0;
  for (Eigen::Index k = 0; k < force.frequency.size(); ++k) {
    const double w = 2 * M_PI * force.frequency[k];
    square += force.square[k] * std::norm(driven(before, now, 2, w).acceleration);
    square_after += force.square[k] * std::norm(driven(behind, then, 2, w).acceleration);
  }
  const auto after = level.after({}, {}, {process(bite::PassNumber::exit_tension, 0.8)});
  ASSERT_TRUE(after && after->level.size() == 6 && level.level().size() == 6);
  const Tolerance same = within(1e-8, "one set of equations solved in two ways");
  EXPECT_TRUE(near(level.level()[2], std::sqrt(square), same));
  EXPECT_TRUE(near(after->level[2], std::sqrt(square_after), same));
}

TEST(RolledLevel, SlopesAreTheTangents)
{
  const ForceBand force = band();
  const RolledLevel level(pass_at(8), open_chain, force);
  const auto tension          = process(bite::PassNumber::entry_tension, 1);
  const Eigen::VectorXd slope = level.slope(tension);
  ASSERT_EQ(slope.size(), 6);
  const double base = level.after({}, {}, {tension})->level[2];
  const auto off    = [&](const double factor) {
    const double really =
        level.after({}, {}, {process(bite::PassNumber::entry_tension, factor)})->level[2] / base - 1;
    return really - std::expm1(slope[2] * std::log(factor));
  };
  EXPECT_TRUE(near(off(1.04) / off(1.02), 4,
                   within_absolute(0.3, "what is left is of second order; third order is some percent")));
}

TEST(RolledLevel, ActionsOfTheStandKeepTheCriticalSpeed)
{
  LevelQuestion q          = question(8);
  q.dampers                = {{"damper", {{1, 2, 2e6}}}};
  const LevelAdvice advice = level_advice(advised(), q);
  const auto scheme        = q.pass->model.scheme;
  const auto critical      = [&](const LumpedModel &chain, const double c) {
    auto structure = dynamics::structure_of(model_of(chain, ForceMeaning::measured));
    structure.C(1, 1) += c, structure.C(2, 2) += c, structure.C(1, 2) -= c, structure.C(2, 1) -= c;
    return dynamics::critical_speed(around(structure), film_pass(), scheme).speed;
  };
  const double now = critical(lumped(), 0);
  ASSERT_TRUE(advice.pass);
  EXPECT_TRUE(near(advice.pass->speed, now, within(1e-6, "the same search")));
  for (const auto &[name, speed] : {std::pair("K3 x 0.8", critical(lumped(1, 0.8), 0)),
                                    {"K3 x 1.2", critical(lumped(1, 1.2), 0)},
                                    {"damper", critical(lumped(), 2e6)}}) {
    const RatedAction &one = action(advice, name);
    EXPECT_TRUE(near(one.nearer, speed / now - 1, within_absolute(1e-6, "two searches, each to 1e-6"))) << name;
    EXPECT_EQ(effect(one, "critical over working speed"), one.nearer);
    const bool too_near = std::any_of(one.against.begin(), one.against.end(), [](const std::string &reason) {
      return reason.find("brings the critical speed nearer by ") == 0 &&
             reason.find("at most 1 % are allowed") != std::string::npos;
    });
    EXPECT_EQ(too_near, speed < 0.99 * now) << name << " " << speed / now;
  }
  // What may be lost decides: with room for all of it nothing is refused for it.
  q.pass->nearer_chatter = 1;
  for (const RatedAction &one : level_advice(advised(), q).actions)
    for (const std::string &reason : one.against)
      EXPECT_EQ(reason.find("critical speed nearer"), std::string::npos) << one.name << ": " << reason;
}

TEST(RolledLevel, ProcessActionsKeepForceTorqueAndSpeed)
{
  LevelQuestion q             = question(8);
  q.pass->process.torque_rise = 0.01;
  q.pass->nearer_chatter      = 1;
  const LevelAdvice advice    = level_advice(advised(), q);
  EXPECT_EQ(action(advice, "speed x 0.95").against.front(), "rolls at 7.6 m/s, at least 8 m/s are wanted");
  const auto scheme   = q.pass->model.scheme;
  const auto now      = dynamics::working_point(film_pass(), 8, scheme).state;
  int refused         = 0;
  const auto has_word = [](const RatedAction &one, const char *word) {
    return std::any_of(one.against.begin(), one.against.end(),
                       [&](const std::string &reason) { return reason.find(word) == 0; });
  };
  for (const auto &[name, number, factor] :
       {std::tuple("entry thickness x 1.05", bite::PassNumber::entry_thickness, 1.05),
        {"entry thickness x 0.95", bite::PassNumber::entry_thickness, 0.95},
        {"oil viscosity x 0.8", bite::PassNumber::viscosity, 0.8},
        {"exit tension x 1.2", bite::PassNumber::exit_tension, 1.2}}) {
    const auto then = dynamics::working_point(with_number_scaled(film_pass(), number, factor), 8, scheme).state;
    const RatedAction &one = action(advice, name);
    EXPECT_TRUE(near(effect(one, "force"), then.force / now.force - 1,
                     within_absolute(1e-10, "the same working point twice, rounding")));
    EXPECT_TRUE(near(effect(one, "torque"), then.torque / now.torque - 1,
                     within_absolute(1e-10, "the same working point twice, rounding")));
    EXPECT_EQ(has_word(one, "the force rises by"), then.force > 1.05 * now.force) << name;
    EXPECT_EQ(has_word(one, "the torque rises by"), then.torque > 1.01 * now.torque) << name;
    refused += then.force > 1.05 * now.force;
  }
  EXPECT_GE(refused, 1) << "the limit of the force is seen at work";
  for (const RatedAction &one : advice.actions)
    EXPECT_TRUE(!one.pair || one.name.find("speed x") == std::string::npos) << "no partner mends a lower speed";
}

TEST(RolledLevel, AboveItsCriticalSpeedAStandHasNoLevelOfTheProcess)
{
  LevelQuestion q          = question(8);
  const double critical    = level_advice(advised(), q).pass->speed;
  q.pass->working_speed    = 1.05 * critical;
  const LevelAdvice advice = level_advice(advised(), q);
  EXPECT_GT(advice.pass->growth, 0);
  for (const RatedAction &one : advice.actions)
    EXPECT_TRUE(one.process.empty()) << one.name;
  // An action that brings the stand there says so and has no change.
  q.pass->working_speed         = 0.99 * critical;
  q.pass->process.entry_tension = {1, 1.5};
  q.pass->nearer_chatter        = 1;
  const LevelAdvice near_it     = level_advice(advised(), q);
  const RatedAction &worse      = action(near_it, "entry tension x 1.5");
  EXPECT_TRUE(std::isnan(worse.change));
  EXPECT_EQ(worse.against.front(), "vibration grows at the working speed");
}

TEST(RolledLevel, AdvisesTheStandAloneWithoutABite)
{
  const LevelAdvice advice = level_advice(advised(), question(1));  // the flattening diverges
  ASSERT_TRUE(advice.pass && advice.pass->no_bite);
  for (const RatedAction &one : advice.actions)
    EXPECT_TRUE(one.process.empty() && std::isnan(one.nearer)) << one.name;
}
