#include "core/model/cluster.h"
#include "dynamics/cluster/backbone.h"
#include "dynamics/cluster/gap_stand.h"
#include "dynamics/cluster/modes.h"
#include "dynamics/cluster/motion.h"
#include "dynamics/cluster/stack_of_case.h"
#include "tests/support/near.h"
#include <Eigen/Cholesky>
#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>

using namespace mill;

// The strip between two work rolls carries the rolling force and lets go where its whole force is zero.
namespace {
constexpr double rolling_force = 8e6;  // N
constexpr double K4            = 5e9;  // N/m

// Backup, intermediate and work roll above and below the strip, on one vertical line.
ClusterStand six_high()
{
  ClusterStand stand;
  stand.stack.strip           = "WU-WL";
  stand.stack.strip_stiffness = K4;
  stand.stack.gravity         = false;
  const struct {
    const char *name;
    double diameter, y;
  } rolls[] = {{"BU", 1.4, 1.601},  {"IU", 0.6, 0.601},  {"WU", 0.4, 0.101},
               {"WL", 0.4, -0.301}, {"IL", 0.6, -0.801}, {"BL", 1.4, -1.801}};
  for (const auto &[name, diameter, y] : rolls) {
    ClusterRoll roll;
    roll.name            = name;
    roll.barrel_diameter = diameter;
    roll.barrel_length   = 2;
    roll.position        = {0, y};
    stand.rolls.push_back(roll);
    ClusterSupport guide;
    guide.roll      = name;
    guide.name      = std::string(name) + "_guide";
    guide.type      = SupportType::guide;
    guide.stiffness = 1e10;
    stand.supports.push_back(guide);
  }
  for (const char *pair : {"WU-IU", "IU-BU", "IL-WL", "BL-IL"}) {
    ClusterContact contact;
    contact.pair = pair;
    stand.contacts.push_back(contact);
  }
  for (const char *roll : {"BU", "BL"}) {
    ClusterSupport housing;
    housing.roll      = roll;
    housing.type      = SupportType::guide;
    housing.direction = M_PI / 2;
    housing.stiffness = 5e9;
    stand.supports.push_back(housing);
  }
  return stand;
}

struct Settled {
  cluster::PassState state;
  std::size_t strip = 0;
  Settled() : state(cluster::pass_state(six_high(), {}, rolling_force))
  {
    while (!state.stack.contacts[strip].strip)
      ++strip;
  }
  const cluster::Contact &contact() const
  {
    return state.stack.contacts[strip];
  }
};
}  // namespace

TEST(StripContact, CarriesTheRollingForce)
{
  const Settled s;
  EXPECT_TRUE(near(s.state.rest.contact_loads[s.strip], rolling_force, within(1e-9, "balance of the work rolls")));
  for (std::size_t i = 0; i < s.strip; ++i)  // a column without weight
    EXPECT_TRUE(near(s.state.rest.contact_loads[i], rolling_force, within(1e-9, "the same force all along")));
}

TEST(StripContact, OpensWhereTheFluctuationHasTakenAllOfItsForceAndNotBefore)
{
  const Settled s;
  const auto force = [&](const double fluctuation) {
    return cluster::contact_force(s.contact(), -fluctuation / K4);
  };
  EXPECT_TRUE(near(force(4e6), 4e6, within(1e-9, "a straight spring about the force at rest")));
  EXPECT_GT(force(rolling_force * (1 - 1e-9)), 0);
  EXPECT_EQ(force(rolling_force * (1 + 1e-9)), 0);
  EXPECT_EQ(cluster::contact_tangent(s.contact(), -rolling_force * (1 + 1e-9) / K4), 0);
  EXPECT_EQ(cluster::contact_tangent(s.contact(), -rolling_force * (1 - 1e-9) / K4), K4);
  EXPECT_TRUE(near(cluster::added_force(s.contact(), -1), -rolling_force, within(1e-12, "never a tension")));
}

// Half the gap of the work rolls closed again and let go: the first opening is where the whole force is zero.
TEST(StripContact, InTimeItLetsGoAtTheTotalForceAndEnergyIsKept)
{
  const Settled s;
  const int upper = s.contact().b, lower = s.contact().a;
  const auto run = [&](const double share) {  // share of the rolling force that the start takes off the strip
    Eigen::VectorXd start = Eigen::VectorXd::Zero(s.state.stack.size());
    start[2 * upper + 1]  = 0.5 * share * rolling_force / K4;
    start[2 * lower + 1]  = -start[2 * upper + 1];
    cluster::MotionOptions options;
    options.duration = 0.004;
    return cluster::move(s.state.stack, s.state.rest.u, {}, options, start);
  };
  const auto below = run(0.3);  // its energy, contacts included, is a third of what opens the strip
  EXPECT_TRUE(near(below.contact_force(Eigen::Index(s.strip), 0), 0.7 * rolling_force,
                   within(1e-9, "the whole force, not its change")));
  const auto above = run(1.5);
  EXPECT_EQ(above.contact_force(Eigen::Index(s.strip), 0), 0);
  EXPECT_FALSE(above.events.empty()) << "it closes again";
  EXPECT_LT(above.energy_balance.cwiseAbs().maxCoeff(), 1e-7 * above.energy.cwiseAbs().maxCoeff())
      << "tolerance of the steps 1e-8 of the largest displacement";
  for (const auto &e : below.events)
    EXPECT_NE(e.contact, int(s.strip)) << "fluctuation below the rolling force at " << e.time;
}

// A slow harmonic part of the strip's force on stiff rolls: it opens where this part alone, with what the stand
// gives back, has taken the rolling force.
TEST(StripContact, ADynamicForceIsPartOfWhatItCarries)
{
  const Settled s;
  const auto opens = [&](const double amplitude) {
    cluster::Drive drive;
    drive.roll      = s.contact().b;
    drive.force     = {0, amplitude};
    drive.frequency = 2;
    drive.strip     = int(s.strip);
    cluster::MotionOptions options;
    options.duration = 0.5;
    options.interval = 1e-3;
    const auto h     = cluster::move(s.state.stack, s.state.rest.u, {drive}, options);
    return !h.events.empty();
  };
  // The spring of the strip gives back part of a slow force: total = P C_s / (C_s + C_stack) with both
  // compliances.
  const auto gap      = cluster::gap_stand(s.state.stack, s.state.rest.u, s.contact().b, s.contact().a);
  const double stand  = gap.b.dot(gap.K.ldlt().solve(gap.b));
  const double needed = rolling_force * (1 + K4 * stand);
  EXPECT_FALSE(opens(0.97 * needed));
  EXPECT_TRUE(opens(1.03 * needed));
}

TEST(GapStand, OfOneHalfIsTheWholeMill)
{
  const Settled s;
  const auto whole           = cluster::gap_stand(s.state.stack, s.state.rest.u, s.contact().b, s.contact().a);
  ClusterStand half          = six_high();
  half.stack.strip           = "WU";
  half.stack.strip_stiffness = not_given;
  half.rolls.resize(3);
  half.contacts.resize(2);
  half.supports.erase(half.supports.begin() + 3, half.supports.begin() + 6);
  half.supports.pop_back();
  const auto upper      = cluster::pass_state(half, {}, rolling_force);
  const auto gap        = cluster::gap_stand(upper.stack, upper.rest.u, 2, -1);
  const auto compliance = [](const cluster::GapStand &g) { return g.b.dot(g.K.ldlt().solve(g.b)); };
  EXPECT_TRUE(near(compliance(gap), compliance(whole), within(1e-9, "mirror images")));
  const auto a = cluster::modes_of(gap, K4), b = cluster::modes_of(whole, K4);
  for (Eigen::Index k = 0; k < a.frequency.size(); ++k) {
    const Eigen::Index nearest = [&] {
      Eigen::Index i = 0;
      (b.frequency.array() - a.frequency[k]).abs().minCoeff(&i);
      return i;
    }();
    EXPECT_TRUE(near(b.frequency[nearest], a.frequency[k], within(1e-9, "the modes that mirror images share")));
  }
}

// The weight of a force that leans with its contact gives back what it takes: it neither damps a mode nor drives
// it.
TEST(GapStand, LossFactorsOfLoadedContactsDampEveryMode)
{
  ClusterStand stand          = six_high();
  stand.stack.strip_stiffness = not_given;
  stand.stack.strip           = "WU";
  stand.response.loss_factor  = 0.08;
  stand.rolls.resize(3);
  stand.contacts.resize(2);
  stand.supports.erase(stand.supports.begin() + 3, stand.supports.begin() + 6);
  stand.supports.pop_back();
  const auto upper = cluster::pass_state(stand, {}, rolling_force);
  const auto gap   = cluster::gap_stand(upper.stack, upper.rest.u, 2, -1);
  const auto modes = cluster::modes_of(gap, 0);
  int across = 0, along = 0;
  for (Eigen::Index k = 0; k < modes.damping.size(); ++k) {
    const Eigen::VectorXd energy = modes.shape.col(k).cwiseAbs2().cwiseProduct(gap.M);
    double sideways              = 0;
    for (Eigen::Index i = 0; i < energy.size(); i += upper.stack.per_roll())
      sideways += energy[i];
    if (sideways > 0.999) {
      ++across;
      EXPECT_TRUE(
          near(modes.damping[k], 0, within_absolute(1e-9, "rolls on one line: contacts are not strained")));
    } else if (sideways < 0.001 && modes.frequency[k] > 1) {
      ++along;
      EXPECT_GT(modes.damping[k], 1e-4);
      EXPECT_LE(modes.damping[k], 0.04 * (1 + 1e-9)) << "half of the loss factor at most";
    }
  }
  EXPECT_EQ(across, 3);
  EXPECT_EQ(along, 3);
}

// All stiffnesses of a stand times one factor: frequencies times its root, the same shapes, and the same part of
// its energy is lost in a period.
TEST(GapStand, StifferContactsAndSupportsKeepTheirLossFactors)
{
  ClusterStand stand                 = six_high();
  stand.response.loss_factor         = 0.08;
  stand.response.support_loss_factor = 0.02;
  constexpr double factor            = 1.3;
  const auto gap_of                  = [](const ClusterStand &one) {
    const auto state = cluster::pass_state(one, {}, rolling_force);
    return cluster::gap_stand(state.stack, state.rest.u, 2, 3);
  };
  const cluster::GapStand gap = gap_of(stand);
  std::vector<std::size_t> contacts(gap.contacts.size()), supports(gap.supports.size());
  std::iota(contacts.begin(), contacts.end(), 0);
  std::iota(supports.begin(), supports.end(), 0);
  const auto before = cluster::modes_of(gap, 0),
             after  = cluster::modes_of(cluster::scaled(gap, contacts, supports, factor), 0);
  for (Eigen::Index k = 0; k < before.frequency.size(); ++k) {
    EXPECT_TRUE(near(after.frequency[k], std::sqrt(factor) * before.frequency[k],
                     within(1e-9, "rounding of the lowest mode", before.frequency.maxCoeff())));
    EXPECT_TRUE(
        near(after.damping[k], before.damping[k], within_absolute(1e-9, "rounding of a ratio below 0.04")));
  }
  // Stiffer housings lift the stacks as a whole, so that their contacts are as they were.
  const std::vector<std::size_t> housings{6, 7};
  for (const std::size_t i : housings)
    stand.supports[i].stiffness *= factor;
  const cluster::GapStand built = gap_of(stand), moved = cluster::scaled(gap, {}, housings, factor);
  EXPECT_LT((built.K - moved.K).norm(), 1e-9 * built.K.norm());
  EXPECT_LT((built.loss - moved.loss).norm(), 1e-9 * built.loss.norm());
}

// A strip under 8 MN with 5 MN/mm lets go 1.6 mm from its state at rest: a vibration of 1 um opens nothing.
TEST(StripContact, FreeVibrationOfAMicrometreDoesNotOpenIt)
{
  const Settled s;
  double least = rolling_force / K4;  // m, at rest
  for (const cluster::Contact &c : s.state.stack.contacts)
    if (!c.strip)
      least = std::min(least, cluster::contact_state(s.state.stack, c, s.state.rest.u).approach);
  constexpr double amplitude = 1e-6;
  const auto all             = cluster::modes(s.state.stack, s.state.rest.u);
  int solved                 = 0;
  for (std::size_t k = 0; k < all.size(); ++k)
    for (const auto &point : cluster::backbone(s.state.stack, s.state.rest.u, int(k), {amplitude}, {5, 32})) {
      ++solved;
      EXPECT_EQ(point.lets_go, "") << all[k].label;
      EXPECT_TRUE(near(point.least_approach, least,
                       within_absolute(3 * amplitude, "two rolls that move by the amplitude, and its mean shift")))
          << all[k].label;
    }
  EXPECT_GT(solved, 0);
}

// Rolls that drive each other without slip and turn together: one such motion for the train above the strip, one
// for that below.
TEST(StripContact, CommonRollingStrainsNothing)
{
  Settled s;
  cluster::Stack stack = s.state.stack;
  stack.coupled        = true;
  for (cluster::Contact &c : stack.contacts)
    c.tangential = c.strip ? 0 : 1;
  int rolling = 0;
  for (const cluster::Mode &mode : cluster::modes(stack, s.state.rest.u)) {
    double sum = 0;
    for (const cluster::Share &share : mode.elastic)
      sum += share.value;
    double turning = 0;
    for (std::size_t i = 2; i < mode.kinetic.size(); i += 3)
      turning += mode.kinetic[i].value;
    if (std::abs(mode.frequency) < 0.01) {
      ++rolling;
      EXPECT_TRUE(near(turning, 1, within(1e-9, "rounding"))) << mode.label;
      for (const cluster::Share &share : mode.elastic)
        EXPECT_EQ(share.value, 0) << mode.label << ", " << share.name;
    } else
      EXPECT_TRUE(near(sum, 1, within(1e-6, "shares of the whole, rounding of the lowest modes"))) << mode.label;
  }
  EXPECT_EQ(rolling, 2);
}
