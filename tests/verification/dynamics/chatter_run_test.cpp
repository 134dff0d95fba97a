// The bite at one moment, the linear and the nonlinear motion, and what a record determines, over stands and
// strips that no publication has.
#include "core/base/errors.h"
#include "dynamics/chatter/equations.h"
#include "dynamics/chatter/run.h"
#include "reduce/bite/linear/unsteady_bite.h"
#include "reduce/bite/slab/bland_ford.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <cmath>
#include <random>

using namespace mill;
using namespace mill::dynamics;
using Eigen::VectorXd;
using mill::Linearisation;

namespace {
constexpr Linearisation schemes[] = {Linearisation::sequential, Linearisation::implicit,
                                     Linearisation::frozen_friction};

// 1.1 -> 0.85 mm, hardening by Swift, oil film; `oil` scales the viscosity.
bite::RollBite rolling(const double oil = 1)
{
  bite::RollBite b;
  b.roll_radius             = 0.26;
  b.roll                    = {2.1e11, 0.3, 7850};
  b.roll_speed              = 14;
  b.strip.width             = 1.1;
  b.strip.entry_thickness   = 1.1e-3;
  b.strip.exit_thickness    = 0.85e-3;
  b.strip.entry_tension     = 110e6;
  b.strip.exit_tension      = 150e6;
  b.strip.initial_thickness = 2.4e-3;
  b.strip.flow_stress.law   = FlowStressLaw::swift;
  b.strip.flow_stress.k     = 780e6;
  b.strip.flow_stress.eps0  = 0.01;
  b.strip.flow_stress.n     = 0.2;
  Friction &film            = b.strip.friction;
  film.law                  = FrictionLaw::film;
  film.mu0                  = 0.015;
  film.mu1                  = 0.12;
  film.decay                = 2e6;
  film.viscosity            = 0.006 * oil;
  film.pressure_viscosity   = 1.8e-8;
  return b;
}

bite::RollBite dry()
{
  bite::RollBite b             = rolling();
  b.strip.friction             = {};
  b.strip.friction.coefficient = 0.06;
  b.strip.flow_stress          = {};
  b.strip.flow_stress.k        = 620e6;
  return b;
}

ChatterStandModel stand(const double mass = 1)
{
  const auto m = [&](const double tons) { return 1e3 * tons * mass; };
  return {six_mass_structure({m(100), m(60), m(8), m(8.5), m(62), m(40)},
                             {6.5e10, 3.2e10, 5.5e10, 5.8e10, 4.0e10, 9e10}, {5e5, 4e5, 5e5, 6e5, 4e5, 5e5}),
          4.5, 5.2, 205e9};
}

ChatterStandModel random_stand(std::mt19937 &random)
{
  std::uniform_real_distribution<double> factor(0.5, 2);
  const auto some = [&](const std::array<double, 6> &middle) {
    auto values = middle;
    for (double &v : values)
      v *= factor(random);
    return values;
  };
  return {six_mass_structure(some({100e3, 60e3, 8e3, 8e3, 60e3, 40e3}),
                             some({6.5e10, 3.2e10, 5.5e10, 5.8e10, 4e10, 9e10}),
                             some({5e5, 4e5, 5e5, 6e5, 4e5, 5e5})),
          4.5 * factor(random), 5 * factor(random), 205e9};
}

WorkingPoint at(const bite::RollBite &b, const Linearisation scheme = Linearisation::sequential)
{
  return working_point(b, b.roll_speed, scheme);
}

double apart(const VectorXd &a, const VectorXd &b)
{
  return (a - b).norm() / b.norm();
}

bool happened(const ChatterRun &run, const ChatterChange change)
{
  for (const ChatterEvent &e : run.events)
    if (e.change == change)
      return true;
  return false;
}
}  // namespace

TEST(UnsteadyBite, AtTheSteadyStateItEqualsTheLinearBite)
{
  for (const bite::RollBite &b : {rolling(), rolling(0.5), dry()})
    for (const Linearisation scheme : schemes) {
      const WorkingPoint p = at(b, scheme);
      const auto u         = bite::unsteady_bite(p.bite, p.state, scheme);
      const auto now       = bite::bite_slopes_at(u, bite::steady_moment(u));
      EXPECT_TRUE(near(now.answer.force, p.state.force, within(1e-12, "one formula, one rounding")));
      EXPECT_TRUE(near(now.answer.entry_speed, p.state.entry_speed, within(1e-12, "settled to rounding")));
      const bite::StripRow *rows[][2] = {{&now.by.entry_speed, &p.by.entry_speed},
                                         {&now.by.exit_speed, &p.by.exit_speed},
                                         {&now.by.force, &p.by.force},
                                         {&now.by.friction, &p.by.friction},
                                         {&now.by.neutral_position, &p.by.neutral_position}};
      for (const auto &row : rows)
        for (int i = 0; i < 5; ++i)
          EXPECT_TRUE(near((*row[0])[i], (*row[1])[i], within(1e-10, "exact derivatives at one state", 1e-30)));
    }
}

TEST(UnsteadyBite, SlopesAreRightFarFromTheSteadyState)
{
  for (const Linearisation scheme : schemes) {
    const WorkingPoint p  = at(rolling(), scheme);
    const auto u          = bite::unsteady_bite(p.bite, p.state, scheme);
    const bite::Moment m  = {0.9e-3, -0.06, 60e6, 190e6, 1.12e-3};
    const double steps[5] = {1e-8, 1e-4, 1e4, 1e4, 1e-8};
    const auto exact      = bite::bite_slopes_at(u, m);
    for (int i = 0; i < 5; ++i) {
      bite::Moment up = m, down = m;
      up[i] += steps[i];
      down[i] -= steps[i];
      const auto a = bite::bite_at(u, up), b = bite::bite_at(u, down);
      const auto why = within(2e-6, "central difference: truncation and rounding", std::abs(exact.by.force[i]));
      EXPECT_TRUE(near((a.force - b.force) / (2 * steps[i]), exact.by.force[i], why));
      EXPECT_TRUE(near((a.entry_speed - b.entry_speed) / (2 * steps[i]), exact.by.entry_speed[i],
                       within(2e-6, "central difference", std::abs(exact.by.entry_speed[i]))));
    }
  }
}

TEST(UnsteadyBite, FadesOutWhereTheStripLeavesTheRolls)
{
  for (const Linearisation scheme : schemes)
    for (const double rate : {-0.2, -0.01, 0.0, 0.03}) {
      const WorkingPoint p = at(rolling(), scheme);
      const auto u         = bite::unsteady_bite(p.bite, p.state, scheme);
      bite::Moment m       = bite::steady_moment(u);
      m[1]                 = rate;
      m[0]                 = m[4];
      const double edge    = m[4] + bite::contact_reserve(u, m);  // gap at which nothing of the draft is left
      double last          = INFINITY;
      for (const double left : {1e-6, 1e-8, 1e-10}) {
        m[0]         = edge - left;
        const auto a = bite::bite_at(u, m);
        EXPECT_TRUE(a.contact);
        EXPECT_LT(a.force, last);
        last = a.force;
      }
      EXPECT_LT(last, 0.01 * p.state.force);
      m[0]            = edge + 1e-12;
      const auto free = bite::bite_at(u, m);
      EXPECT_FALSE(free.contact);
      EXPECT_EQ(free.force, 0);
      EXPECT_EQ(free.entry_speed, 14);
      EXPECT_EQ(free.exit_speed, 14);
    }
}

TEST(UnsteadyBite, KeepsTheNeutralPointOnTheArcWhereTheRollsSkid)
{
  const WorkingPoint p = at(rolling());
  const auto u         = bite::unsteady_bite(p.bite, p.state, Linearisation::sequential);
  bite::Moment m       = bite::steady_moment(u);
  m[3]                 = 0.8 * p.state.exit_flow_stress;
  const auto pulled    = bite::bite_at(u, m);
  EXPECT_LT(pulled.from_entry, 0);
  EXPECT_TRUE(near(pulled.entry_speed, 14, within(1e-12, "neutral point at the entry")));
  const auto reserve = bite::neutral_reserve(u, m);
  EXPECT_EQ(reserve[0], pulled.from_exit);
  EXPECT_EQ(reserve[1], pulled.from_entry);
  m               = bite::steady_moment(u);
  m[2]            = 0.8 * p.state.entry_flow_stress;
  const auto held = bite::bite_at(u, m);
  EXPECT_LT(held.from_exit, 0);
  EXPECT_TRUE(near(held.exit_speed, 14, within(1e-12, "neutral point at the exit")));
}

TEST(UnsteadyBite, TensionIsLimitedToTheFlowStress)
{
  const WorkingPoint p = at(rolling());
  const auto u         = bite::unsteady_bite(p.bite, p.state, Linearisation::sequential);
  bite::Moment m       = bite::steady_moment(u);
  m[2]                 = 1.5 * p.state.entry_flow_stress;
  EXPECT_LT(bite::yield_reserve(u, m)[0], 0);
  EXPECT_GT(bite::yield_reserve(u, m)[1], 0);
  EXPECT_TRUE(std::isfinite(bite::bite_at(u, m).force));
  EXPECT_EQ(bite::bite_slopes_at(u, m).by.force[2], 0);
}

TEST(UnsteadyBite, RefusesAMissingRollSpeed)
{
  bite::RollBite b = dry();
  const auto state = [&] { return bite::solve_bland_ford(b, bite::Arc::hitchcock, 0); }();
  b.roll_speed     = not_given;
  EXPECT_EQ(refusal([&] { bite::unsteady_bite(b, state, Linearisation::sequential); }),
            "the vibrating bite needs the speed of the rolls, which is not given");
}

TEST(ChatterHistory, StartMovesOnlyTheWorkRollsOfSixMasses)
{
  const VectorXd z = displaced_rolls(stand().structure, 3e-7);
  VectorXd wanted  = VectorXd::Zero(14);
  wanted[2] = wanted[3] = 3e-7;
  EXPECT_LT((z - wanted).norm(), 1e-20);
}

TEST(ChatterHistory, StartOfAModalStandOpensTheGapWithLeastMotion)
{
  StandStructure s;  // three modes whose points do not add up to the gap
  s.M              = Eigen::MatrixXd::Identity(3, 3);
  s.K              = Eigen::Vector3d(2e5, 4e5, 9e5).asDiagonal();
  s.C              = 1e-3 * s.K;
  s.b              = Eigen::Vector3d(0.006, -0.003, 0.001);
  s.labels         = {"upper work roll", "lower work roll"};
  s.point          = Eigen::MatrixXd::Constant(2, 3, 1e-3);
  const VectorXd x = displaced_rolls(s, 1e-6).head(3);
  EXPECT_TRUE(near(s.b.dot(x), 2e-6, within(1e-12, "a condition of the start")));
  EXPECT_LT((x - s.b * s.b.dot(x) / s.b.squaredNorm()).norm(), 1e-12 * x.norm());  // along M^-1 b
}

TEST(ChatterHistory, ContinuesFromItsLastState)
{
  const auto p       = at(rolling());
  const auto s       = stand();
  const auto whole   = linear_history(s, p.by, displaced_rolls(s.structure, 1e-7), 0.2);
  const auto half    = linear_history(s, p.by, displaced_rolls(s.structure, 1e-7), 0.1);
  const auto another = linear_history(s, p.by, half.last, 0.1);
  EXPECT_EQ(whole.time.size(), 2001);
  EXPECT_LT(apart(another.last, whole.last), 1e-11);  // 1000 products of a matrix near unity
  EXPECT_EQ(half.gap[1000], whole.gap[1000]);
}

TEST(ChatterHistory, TheCriticalModeIsOneExponential)
{
  const auto p        = at(rolling());
  const auto s        = stand();
  const auto value    = eigenvalues(chatter_matrix(s, p.by))[0];
  const VectorXd mode = critical_mode(s, p.by, 1e-6);
  const auto h        = linear_history(s, p.by, mode, 0.1);
  EXPECT_TRUE(near(h.gap[0], 1e-6, within(1e-12, "the scale of the start")));
  const VectorXd wanted = (h.time.array() * value.real()).exp() * (h.time.array() * value.imag()).cos() * 1e-6;
  EXPECT_LT(apart(h.gap, wanted), 1e-9);
  const auto modes = record_modes(h.gap, 1e-4);
  ASSERT_EQ(modes.size(), 1u);
  EXPECT_TRUE(near(modes[0].growth, value.real(), within(1e-7, "one clean exponential over 13 swings")));
  EXPECT_TRUE(near(modes[0].amplitude, 1e-6, within(1e-7, "as its growth")));
}

TEST(ChatterHistory, RefusesADurationOfZero)
{
  const auto p = at(rolling());
  const auto s = stand();
  EXPECT_EQ(refusal([&] { linear_history(s, p.by, displaced_rolls(s.structure, 1e-7), 0); }),
            "a history needs a duration and a rate above zero, not 0 s and 10000 Hz");
}

TEST(ChatterEquations, JacobianOnEverySideOfTheEdges)
{
  const auto p = at(rolling());
  const auto s = stand();
  ChatterRunOptions options;
  options.contacts = roll_contacts(s.structure, p.state.force);
  ChatterEquations e(s, p, Linearisation::sequential, options);
  const VectorXd unit = e.magnitude();
  const auto compare  = [&](const VectorXd &z) {
    Eigen::MatrixXd J(14, 14);
    e.jacobian(z.data(), J);
    for (int i = 0; i < 14; ++i) {
      VectorXd up = z, down = z, a(14), b(14);
      up[i] += 1e-9 * unit[i];
      down[i] -= 1e-9 * unit[i];
      e.slope(up.data(), a.data());
      e.slope(down.data(), b.data());
      const VectorXd difference = (a - b) / (2e-9 * unit[i]);
      EXPECT_LT((difference - J.col(i)).cwiseQuotient(unit).norm() * unit[i], 2e-5 * J.cwiseAbs().maxCoeff())
          << "column " << i;
    }
    return J;
  };
  VectorXd z    = displaced_rolls(s.structure, 2e-5);
  const auto J0 = compare(VectorXd::Zero(14));
  EXPECT_LT((J0 - chatter_matrix(s, p.by)).norm(), 1e-12 * J0.norm());  // the linear system, written elsewhere
  compare(z);
  z[12] = -2e8;  // slack before the bite
  compare(z);
  z[13] = -3e8;
  compare(z);
  z[1] = 4e-4;  // upper rolls apart
  compare(z);
  e.strip_held = false;
  compare(z);
}

TEST(NonlinearRun, TendsToTheLinearRunOnAnyStand)
{
  std::mt19937 random(1);
  for (int i = 0; i < 12; ++i) {
    const auto s      = random_stand(random);
    const auto scheme = schemes[i % 3];
    const auto p      = at(i % 4 == 3 ? dry() : rolling(0.6 + 0.1 * i), scheme);
    ChatterRunOptions options;
    options.duration = 0.05;
    double last      = 0;
    for (const double size : {1e-8, 1e-7}) {
      const VectorXd start = displaced_rolls(s.structure, size);
      const auto run       = nonlinear_run(s, p, scheme, start, options);
      const auto line      = linear_history(s, p.by, start, 0.05);
      ASSERT_EQ(run.stopped, "");
      const double off = (run.history.point - line.point).norm() / line.point.norm();
      EXPECT_LT(off, size == 1e-8 ? 2e-4 : 1e-3);
      EXPECT_LT(apart(run.history.friction + line.force * 1e-12, line.friction + line.force * 1e-12), 1e-3);
      EXPECT_GT(off, last);
      last = off;
    }
  }
}

TEST(NonlinearRun, AtRestNothingMoves)
{
  const auto p   = at(rolling());
  const auto run = nonlinear_run(stand(), p, Linearisation::implicit, VectorXd::Zero(14));
  EXPECT_EQ(run.stopped, "");
  EXPECT_EQ(run.history.gap.cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ(run.history.entry_tension.cwiseAbs().maxCoeff(), 0);
  EXPECT_TRUE(std::isnan(limit_cycle(run).frequency));
}

TEST(NonlinearRun, SlackStripPullsNothingAndComesBack)
{
  const auto p   = at(rolling());
  const auto s   = stand();
  VectorXd start = VectorXd::Zero(14);
  start[12]      = -150e6;  // 40 MPa too long: nearly 1 mm of slack
  const auto run = nonlinear_run(s, p, Linearisation::sequential, start, {0.02});
  ASSERT_GE(run.events.size(), 2u);
  EXPECT_EQ(run.events[0].time, 0);
  EXPECT_EQ(run.events[0].change, ChatterChange::entry_slack);
  EXPECT_EQ(run.events[1].change, ChatterChange::entry_taut);
  EXPECT_TRUE(near(run.history.entry_tension[0], -110e6, within(1e-12, "total tension is zero")));
  EXPECT_GE(run.history.entry_tension.minCoeff(), -110e6 * (1 + 1e-12));
}

TEST(NonlinearRun, WithoutTensionTheStripGoesSlack)
{
  bite::RollBite b      = rolling();
  b.strip.entry_tension = b.strip.exit_tension = 0;
  const auto run =
      nonlinear_run(stand(), at(b), Linearisation::sequential, displaced_rolls(stand().structure, 1e-6), {0.05});
  EXPECT_EQ(run.stopped, "");
  EXPECT_TRUE(happened(run, ChatterChange::entry_slack));
  EXPECT_GT(run.history.entry_tension.maxCoeff(), 0);  // the opening gap draws it in first
  EXPECT_EQ(run.history.entry_tension.minCoeff(), 0);
}

TEST(NonlinearRun, SeparatedRollsDoNotPullEachOther)
{
  const auto p = at(rolling());
  const auto s = stand();
  ChatterRunOptions with{0.002}, without{0.002};
  with.contacts  = roll_contacts(s.structure, p.state.force);
  VectorXd start = VectorXd::Zero(14);
  start[1]       = 3e-4;  // backup roll 0.3 mm off: 16 MN of pull that there is not
  const auto one = nonlinear_run(s, p, Linearisation::sequential, start, with),
             two = nonlinear_run(s, p, Linearisation::sequential, start, without);
  ASSERT_FALSE(one.events.empty());
  EXPECT_EQ(one.events[0].change, ChatterChange::rolls_part);
  EXPECT_EQ(one.events[0].contact, 0);
  EXPECT_TRUE(happened(one, ChatterChange::rolls_meet));
  EXPECT_LT(one.history.point(2, 1), two.history.point(2, 1));  // the work roll is pulled up less
}

TEST(NonlinearRun, StopsWhereTheStripTears)
{
  // Rolls so heavy that they stay open: nothing makes the strip longer any more, and the next stand pulls on.
  const auto s   = stand(1000);
  const auto p   = at(rolling());
  VectorXd start = VectorXd::Zero(14);
  start[8] = start[9] = 2;  // m/s
  const auto run      = nonlinear_run(s, p, Linearisation::sequential, start, {0.1});
  EXPECT_TRUE(happened(run, ChatterChange::strip_free));
  EXPECT_EQ(run.stopped.find("the exit tension of "), 0u) << run.stopped;
  EXPECT_NE(run.stopped.find(" MPa reaches the flow stress of the strip there: it tears"), std::string::npos);
  EXPECT_EQ(run.history.time.size(), run.history.gap.size());
  EXPECT_EQ(run.history.time.size(), std::floor(run.end * 1e4) + 1);
}

TEST(NonlinearRun, StopsWhereTheRollsWouldMeet)
{
  const auto s   = stand(1000);
  const auto p   = at(rolling());
  VectorXd start = VectorXd::Zero(14);
  start[8] = start[9] = -4;  // m/s towards each other
  const auto run      = nonlinear_run(s, p, Linearisation::sequential, start, {0.01});
  EXPECT_EQ(run.stopped, "the gap closes to 0.017 mm of 0.85 mm: the rolls would meet");
  EXPECT_GT(run.history.gap.size(), 0);
}

TEST(NonlinearRun, RefusesWrongOptionsAndStarts)
{
  const auto s     = stand();
  const auto p     = at(rolling());
  const auto start = displaced_rolls(s.structure, 1e-7);
  const auto with  = [&](const ChatterRunOptions &options, const VectorXd &from) {
    return refusal([&] { nonlinear_run(s, p, Linearisation::sequential, from, options); });
  };
  ChatterRunOptions none, loose, light, other;
  none.duration       = 0;
  loose.tolerance     = 0.5;
  light.strip_density = 0;
  other.contacts      = {{"a third roll", VectorXd::Ones(4), 1e9, 1e6}};
  EXPECT_EQ(with(none, start), "a run needs a duration and a rate above zero, not 0 s and 10000 Hz");
  EXPECT_EQ(with(loose, start), "a run needs a tolerance above zero and at most 0.01, not 0.5; 1e-8 is usual");
  EXPECT_EQ(with(light, start), "a strip of density 0 kg/m3 cannot move; steel has 7850");
  EXPECT_EQ(with(other, start), "contact \"a third roll\" is a row of 4 numbers, the stand has 6 unknowns");
  EXPECT_EQ(with({}, VectorXd::Zero(8)), "a run of this stand starts from 14 finite numbers, not from 8");
  EXPECT_EQ(with({}, displaced_rolls(s.structure, -0.5e-3)),
            "a run cannot start like this: the gap closes to -0.15 mm of 0.85 mm: the rolls would meet");
}

TEST(RollContacts, AreThoseOfTheChain)
{
  const auto contacts = roll_contacts(stand().structure, 7e6);
  ASSERT_EQ(contacts.size(), 2u);
  EXPECT_EQ(contacts[0].name, "upper backup roll on upper work roll");
  EXPECT_EQ(contacts[0].stiffness, 5.5e10);
  EXPECT_EQ(contacts[1].stiffness, 5.8e10);
  EXPECT_EQ(contacts[1].preload, 7e6);
  EXPECT_EQ(contacts[1].row.dot(VectorXd::LinSpaced(6, 0, 5)), -1);  // x3 - x4
  StandStructure modes = stand().structure;
  modes.point *= 0.5;
  EXPECT_EQ(refusal([&] { roll_contacts(modes, 7e6); }),
            "the stiffness between the rolls can be read off six masses only; the stand \"six masses\" has 6 "
            "unknowns: give both stiffnesses");
  modes.labels[2] = "roll";
  EXPECT_EQ(refusal([&] { roll_contacts(modes, 1e10, 1e10, 7e6); }),
            "the stand has no point \"upper work roll\" at which rolls could part");
}
