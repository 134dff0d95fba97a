#include "dynamics/cluster/response.h"
#include "dynamics/cluster/stability.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include "tests/support/z_mill.h"
#include <gtest/gtest.h>

// The compact cluster mill against numbers computed outside this program (tests/reference/cluster.json).
using namespace mill::cluster;

namespace {
// Modes that the printed list names, "identity_order" of the reference.
const std::vector<const char *> identities{"E y, I y, W y", "L y, R y",           "L y, R y -1",
                                           "E x",           "W y, I y 0.79",      "W y, I y -0.31",
                                           "L x, R x -1",   "W x, L x -1, R x -1"};

Eigen::VectorXd by_identity(const Stack &stack, const std::vector<Mode> &all)
{
  std::vector<NamedShape> named;
  for (const char *shape : identities)
    named.push_back({shape, parsed_shape(stack, shape)});
  const auto which = identified(stack, named, all);
  Eigen::VectorXd f(8);
  for (std::size_t i = 0; i < 8; ++i)
    f[Eigen::Index(i)] = all[std::size_t(which[i])].frequency;
  return f;
}

Eigen::VectorXd list(const Reference &values)
{
  const auto numbers = values.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), Eigen::Index(numbers.size()));
}

void expect_state(const ZMill &z, const std::string &entry, const double tolerance)
{
  Stack stack         = stack_of(z);
  const Equilibrium e = settle(stack);
  const Reference ref = reference(entry, "cluster");
  EXPECT_TRUE(near(frequencies_of(modes(stack, e.u)), list(ref["frequencies"]),
                   within(tolerance, "eigenvalues of one model")))
      << entry;
  EXPECT_TRUE(near(Eigen::Map<const Eigen::VectorXd>(e.contact_loads.data(), 4), list(ref["contact_loads"]),
                   within(tolerance, "one equilibrium")))
      << entry;
  Eigen::VectorXd rollers(4);
  for (int i = 0; i < 2; ++i) {
    const auto f = roller_forces(stack.supports[std::size_t(2 + i)], e.u.segment<2>(6 + 2 * i));
    // The reference has left upper, left lower, right lower, right upper.
    const Eigen::Vector2d t = roller_directions(stack.supports[std::size_t(2 + i)])[0];
    const bool first_upper  = t.y() > 0;
    rollers[i == 0 ? 0 : 2] = first_upper ? f[0] : f[1];
    rollers[i == 0 ? 1 : 3] = first_upper ? f[1] : f[0];
  }
  EXPECT_TRUE(near(Eigen::VectorXd(Eigen::Vector4d(rollers[0], rollers[1], rollers[3], rollers[2])),
                   list(ref["roller_loads"]), within(tolerance, "one equilibrium")))
      << entry;
  EXPECT_TRUE(near(e.u[1], double(ref["lift_W"]), within(tolerance, "one equilibrium"))) << entry;
  EXPECT_LT(e.residual, 1e-5) << entry;
}

Stack of_column(const std::string &what, const int column, const double loss_support, double &frequency,
                double &force, Motion &rest)
{
  const auto input = reference_vector("response.input.column_" + std::to_string(column), "cluster");
  ZMill z          = variant_C(what == "own_load" && input[0] == 5 ? 1302e3 : 1148e3);
  if (what == "beta8.linear") {
    z           = ZMill();
    z.beta      = 8 * M_PI / 180;
    z.k_b       = 1.08e10;
    z.k_r       = 1.93e8;
    z.k_WI      = 1.75e10;
    z.k_IE      = 1.75e10;
    z.k_WC      = 1.5e10;
    z.isotropic = true;
  }
  Stack stack = stack_of(z);
  rest        = settle(stack).u;
  for (Contact &c : stack.contacts)
    c.loss_factor = input[2];
  for (Support &s : stack.supports)
    s.loss_factor = loss_support * input[2];
  frequency = input[1];
  force     = input[3];
  return stack;
}
}  // namespace

TEST(ZMillStack, VariantsHaveTheFrequenciesAndLoadsOfTheReference)
{
  expect_state(variant_N(), "stack.N", 1e-6);
  expect_state(variant_C(), "stack.C", 1e-6);
  expect_state(ZMill(), "stack.N", 1e-4);  // supports rounded to four digits
}

TEST(ZMillStack, InclinedControlRollsHaveTheLoadsOfTheReference)
{
  ZMill z;
  z.beta = 8 * M_PI / 180;
  z.k_b  = 1.08e10;
  z.k_r  = 1.93e8;
  expect_state(z, "stack.beta8.power", 1e-6);
  z.horizontal = 5e3;
  expect_state(z, "stack.beta8.power.H", 1e-6);
  z.horizontal = 0;
  z.k_WI = z.k_IE = 1.75e10;
  z.k_WC          = 1.5e10;
  z.isotropic     = true;
  expect_state(z, "stack.beta8.linear", 1e-6);
}

TEST(ZMillStack, FrequenciesOfEveryPassAreThoseOfTheReference)
{
  const double printed[] = {1148e3, 1878e3, 1507e3, 1459e3, 1302e3};
  for (const bool c : {false, true}) {
    const auto ref = reference(c ? "stack.C.per_pass" : "stack.N.per_pass", "cluster");
    for (std::size_t p = 0; p < 5; ++p) {
      Stack stack         = stack_of(c ? variant_C(printed[p]) : variant_N(printed[p]));
      const Equilibrium e = settle(stack);
      const auto row      = list(ref[p]);
      EXPECT_TRUE(near(by_identity(stack, modes(stack, e.u)), row.head(8), within(1e-5, "one model"))) << p;
      EXPECT_TRUE(near(e.u[1], row[8], within(1e-5, "one model"))) << p;
      EXPECT_TRUE(near(e.u[5], row[9], within(1e-5, "one model"))) << p;
    }
  }
}

TEST(ZMillStack, VerticalChainPredictsModesFiveAndSix)
{
  ZMill z       = variant_N();
  z.kap_b       = 0;
  z.k_b         = 1.079e10;
  Stack stack   = stack_of(z);
  stack.gravity = false;
  stack.rolls.resize(3);
  stack.contacts.resize(2);
  stack.supports.resize(2);
  const auto all     = modes(stack, settle(stack).u);
  const auto fixed   = reference_vector("chain.fixed", "cluster");
  const auto printed = reference_vector("published.frequencies", "cluster");
  for (int i = 0; i < 3; ++i) {
    double nearest = 1e9;
    for (const Mode &m : all)
      if (std::abs(m.frequency - fixed[i]) < std::abs(nearest - fixed[i]))
        nearest = m.frequency;
    EXPECT_TRUE(near(nearest, fixed[i], within(1e-6, "3 x 3 eigenvalues")));
    EXPECT_TRUE(near(nearest, printed[i == 0 ? 0 : 3 + i],
                     within(1e-3 + 0.5 / printed[i == 0 ? 0 : 3 + i],
                            "0.1 % and half a digit of print; no tuning but the bearing of mode 1")));
  }
}

TEST(ZMillStack, WithoutAGuideTheIntermediateRollBuckles)
{
  for (const auto &row : reference("stack.N.guide", "cluster")) {
    ZMill z             = variant_N();
    z.guide             = row[0];
    Stack stack         = stack_of(z);
    const Equilibrium e = settle(stack);
    double lateral      = 0;
    for (const Mode &m : modes(stack, e.u))
      for (const Share &s : m.kinetic)
        if (s.name == "I x" && s.value > 0.5)
          lateral = m.frequency;
    EXPECT_TRUE(near(lateral, row[1], within(1e-4, "one model"))) << z.guide;
    EXPECT_EQ(e.stable(), z.guide > 1.5e7) << z.guide;
  }
}

TEST(ZMillStack, LoadsUnderALateralForceAreThoseOfTheReferenceUntilAContactOpens)
{
  for (const auto &row : reference("stack.N.lateral_force", "cluster")) {
    ZMill z             = variant_N();
    z.horizontal        = row[0];
    Stack stack         = stack_of(z);
    const Equilibrium e = settle(stack);
    EXPECT_TRUE(near(e.contact_loads[2], row[1], within(1e-5, "one model", 1e3))) << z.horizontal;
    EXPECT_TRUE(near(e.contact_loads[3], row[2], within(1e-5, "one model"))) << z.horizontal;
    EXPECT_TRUE(near(e.u[0], row[3], within(1e-5, "one model", 1e-6))) << z.horizontal;
  }
  // Its upper roller free, the left control roll lies between W and the lower one: what is left carries its
  // weight.
  for (const double beyond : {21e3, 30e3, 60e3}) {
    ZMill z             = variant_N();
    z.horizontal        = beyond;
    Stack stack         = stack_of(z);
    const Equilibrium e = settle(stack);
    const double weight = stack.rolls[3].mass * free_fall;
    EXPECT_TRUE(near(e.contact_loads[2], weight / std::tan(z.theta), within(0.05, "W has moved by 0.1 mm")))
        << beyond;
    stack.gravity = false;
    EXPECT_EQ(settle(stack).contact_loads[2], 0) << beyond;
  }
}

TEST(ZMillStack, HarmonicResponseIsThatOfTheReference)
{
  for (const int column : {1, 3, 4})
    for (const std::string what : {"C.contacts_only", "C.contacts_and_supports", "C.own_load", "beta8.linear"}) {
      double f = 0, P = 0;
      Motion rest;
      const std::string name = what == "C.own_load" ? "own_load" : what;
      const Stack stack      = of_column(name, column, what == "C.contacts_and_supports" ? 1 : 0, f, P, rest);
      Eigen::VectorXd force  = Eigen::VectorXd::Zero(10);
      force[1]               = P;
      const auto a           = harmonic_response(stack, rest, force, f);
      const auto ref     = reference_vector("response." + what + ".column_" + std::to_string(column), "cluster");
      const double omega = 2 * M_PI * f;
      const auto tolerance =
          column == 3 ? within(1e-3, "undamped: distance from resonance") : within(1e-5, "one model");
      EXPECT_TRUE(near(omega * std::abs(a[1]), ref[0], tolerance)) << what << column;
      EXPECT_TRUE(near(omega * std::abs(a[3]), ref[1], tolerance)) << what << column;
      if (what == "beta8.linear")
        EXPECT_TRUE(near(omega * a.segment<2>(8).norm(), ref[2], tolerance)) << column;
      else
        EXPECT_TRUE(near(omega * omega * std::abs(a[1]), ref[3], tolerance)) << what << column;
    }
  EXPECT_TRUE(near(detuned_ratio(2475, 2500, 0.08), reference("response.detuning", "cluster"),
                   within(1e-9, "closed form")));
}
