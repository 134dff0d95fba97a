// Advice on a level of set R against numbers computed apart from the program (entries advice.*), and against the
// equations of motion with dampers and added masses solved frequency by frequency.
#include "core/base/errors.h"
#include "tests/support/near.h"
#include "tests/support/rated_action.h"
#include "tests/support/reference.h"
#include "twin/advice/advice.h"
#include <Eigen/LU>
#include <algorithm>
#include <complex>

using namespace mill;
using namespace mill::twin;
using dynamics::MillModel;

namespace {
using Complex = std::complex<double>;

const Tolerance same_sum = within(1e-6, "sums over the same frequencies");

struct SetR {
  MillModel model;
  Eigen::VectorXd damping = Eigen::VectorXd::Constant(6, 0.01);
  AdvisedStand advised;
  ForceBand force;  // as the reference: midpoints of 0.02 Hz
  SetR()
  {
    const auto in = reference("advice.inputs", "twin");
    LumpedModel lumped;
    for (std::size_t i = 0; i < 6; ++i)
      lumped.M[i].value = in["M"][i];
    for (std::size_t i = 0; i < 7; ++i)
      lumped.K[i].value = in["K"][i];
    DynamicsSettings settings;
    settings.modal_damping = in["zeta"];
    model                  = dynamics::mill_model(lumped, settings);
    advised                = {vibrating_stand(model, damping), model};
    force                  = white_force(0, 1000, in["df"], in["force_rms"]);
  }
};

const SetR &set_r()
{
  static const SetR set;
  return set;
}

// The equations of motion themselves: masses, springs and dampers in physical unknowns, one more for a tuned
// damper.
double level_by_equations(const MillModel &model, const std::vector<Attachment> &joined, const int place,
                          const ForceBand &force)
{
  Eigen::Index n = model.M.size();
  for (const Attachment &a : joined)
    n += a.mass > 0;
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n), C = M, K = M;
  M.topLeftCorner(6, 6) = model.M.asDiagonal();
  C.topLeftCorner(6, 6) = model.C;
  K.topLeftCorner(6, 6) = model.K;
  Eigen::Index next     = 6;
  for (const Attachment &a : joined) {
    Eigen::VectorXd ends = Eigen::VectorXd::Zero(n);
    if (a.to >= 0)
      ends[a.to] = 1;
    if (a.mass > 0) {
      const double w = 2 * M_PI * a.frequency;
      ends[next]     = -1;
      M(next, next)  = a.mass;
      K += a.mass * w * w * ends * ends.transpose();
      C += 2 * a.ratio * w * a.mass * ends * ends.transpose();
      ++next;
    } else {
      if (a.from >= 0)
        ends[a.from] = -1;
      C += a.damper * ends * ends.transpose();
    }
  }
  Eigen::VectorXcd b = Eigen::VectorXcd::Zero(n);
  b.head(6)          = model.b.cast<Complex>();
  double square      = 0;
  for (Eigen::Index k = 0; k < force.frequency.size(); ++k) {
    const double w           = 2 * M_PI * force.frequency[k];
    const Eigen::MatrixXcd A = (K - w * w * M).cast<Complex>() + Complex(0, w) * C.cast<Complex>();
    const Eigen::VectorXcd y = A.partialPivLu().solve(b);
    square += force.square[k] * std::norm(w * w * y[place]);
  }
  return std::sqrt(square);
}

Attachment damper(const int from, const int to, const double c)
{
  Attachment a;
  a.from = from, a.to = to, a.damper = c;
  return a;
}

// Nested golden sections: another road to the tuning than a simplex.
double golden(const std::function<double(double)> &f, double low, double high)
{
  constexpr double part = 0.6180339887498949;
  double left = high - part * (high - low), right = low + part * (high - low);
  double at_left = f(left), at_right = f(right);
  for (int i = 0; i < 24; ++i)
    if (at_left < at_right) {
      high = right, right = left, at_right = at_left;
      left = high - part * (high - low), at_left = f(left);
    } else {
      low = left, left = right, at_left = at_right;
      right = low + part * (high - low), at_right = f(right);
    }
  return 0.5 * (low + high);
}
}  // namespace

TEST(LevelAdvice, LevelsAndSlopesAreTheReference)
{
  const Eigen::VectorXd level = levels(set_r().advised.stand, {}, set_r().force);
  const auto rms              = reference("advice.rms", "twin");
  EXPECT_TRUE(near(level[2], rms[0].get<double>(), same_sum));
  EXPECT_TRUE(near(level[3], rms[1].get<double>(), same_sum));
  const LevelSlopes slopes = level_slopes(set_r().model, set_r().damping, 0, set_r().force);
  const auto wanted        = reference("advice.slopes", "twin");
  for (std::size_t p = 0; p < slopes.names.size(); ++p)
    for (const int roll : {0, 1})
      EXPECT_TRUE(near(slopes.slope(2 + roll, Eigen::Index(p)),
                       wanted[slopes.names[p]][std::size_t(roll)].get<double>(),
                       within(1e-6, "sums over the same frequencies; the reference takes differences", 1)))
          << slopes.names[p];
}

TEST(LevelAdvice, ActionsAreTheReference)
{
  LevelQuestion q = usual_question(set_r().advised);  // steps that resolve the modes give the same sums to 1e-9
  q.damping       = {1.5, 2};
  q.tuned.clear();
  const LevelAdvice advice = level_advice(set_r().advised, q);
  for (const auto &one : reference("advice.actions", "twin")) {
    std::string name = one["action"];
    if (name == "force x 0.8")
      continue;  // every level is in proportion to the force
    if (const auto position = name.find("zeta x "); position == 0)
      name = name == "zeta x 2.0" ? "modal damping x 2" : "modal damping x 1.5";
    if (name.find("damper") == 0)
      name = name.find("both") != std::string::npos ? "dampers 100 kN s/m, both work rolls to their backup rolls"
             : name.find("lower work roll") != std::string::npos
                 ? "damper 100 kN s/m, upper work roll to lower work roll"
                 : "damper 100 kN s/m, upper work roll to upper backup roll";
    const RatedAction &here = action(advice, name);
    EXPECT_TRUE(near(here.change, one["change"][0].get<double>(), within(1e-6, "of the level", 1))) << name;
    EXPECT_TRUE(near(effect(here, "lower work roll, level"), one["change"][1].get<double>(),
                     within(1e-6, "of the level", 1)))
        << name;
    // The reference takes the slope by a damper from a thousandth of it, which is off by so much of its curvature.
    const double off = name.find("damper") == 0 ? 1e-4 : 1e-6;
    EXPECT_TRUE(near(here.first_order, one["first_order"][0].get<double>(), within(off, "of the level", 1)))
        << name;
  }
}

TEST(LevelAdvice, SlopeOfADamperIsTheLimitOfDifferences)
{
  const VibratingStand &stand = set_r().advised.stand;
  const ForceBand force       = white_force(0, 1000, 0.1);
  const Attachment full       = damper(1, 2, 1e5);
  const double level          = levels(stand, {}, force)[2];
  const auto quotient         = [&](const double part) {
    return std::log(levels(stand, {damper(1, 2, part * 1e5)}, force)[2] / level) / part;
  };
  const double limit = 2 * quotient(5e-5) - quotient(1e-4);  // the error of first order taken off
  EXPECT_TRUE(near(first_order(stand, {}, {full}, force)[2], limit,
                   within_absolute(1e-7, "extrapolated difference quotient: error of second order in 1e-4")));
  // From a thousandth, as in the reference: -0.25546.
  EXPECT_TRUE(near(std::expm1(quotient(1e-3)), -0.25546057693484003,
                   within_absolute(1e-7, "the value of the reference; grid of 0.1 Hz in place of 0.02 Hz")));
}

TEST(LevelAdvice, JoinedDampersAreTheEquationsOfMotion)
{
  const ForceBand force = white_force(20, 980, 2.3);
  Attachment tuned;
  tuned.to = 2, tuned.mass = 80, tuned.frequency = 700, tuned.ratio = 0.08;
  Attachment held = damper(-1, 0, 3e5);
  std::vector<std::vector<Attachment>> cases(4);
  cases[0].push_back(damper(1, 2, 1e5));
  cases[1].push_back(tuned);
  cases[2].push_back(held);
  cases[3].push_back(damper(2, 3, 4e5));
  cases[3].push_back(tuned);
  cases[3].push_back(held);
  cases[3].push_back(damper(3, 4, 2e4));
  for (const auto &joined : cases)
    for (const int place : {0, 2, 3}) {
      EXPECT_TRUE(near(levels(set_r().advised.stand, joined, force)[place],
                       level_by_equations(set_r().model, joined, place, force),
                       within(1e-10, "one set of equations solved in two ways")));
    }
  // The damper of the bite is one between the work rolls.
  VibratingStand bitten = set_r().advised.stand;
  bitten.gap_damper     = 2e5;
  EXPECT_TRUE(near(levels(bitten, {tuned}, force)[2],
                   level_by_equations(set_r().model, {damper(3, 2, 2e5), tuned}, 2, force),
                   within(1e-10, "one set of equations solved in two ways")));
}

TEST(LevelAdvice, SlopesWithADamperOfTheBite)
{
  const ForceBand force = white_force(20, 980, 0.5);
  const auto at         = [&](const double factor) {
    MillModel model = set_r().model;
    model.K(1, 1) += (factor - 1) * model.springs[2].stiffness;
    model.K(2, 2) += (factor - 1) * model.springs[2].stiffness;
    model.K(1, 2) -= (factor - 1) * model.springs[2].stiffness;
    model.K(2, 1) = model.K(1, 2);
    return std::log(levels(vibrating_stand(model, set_r().damping, 2e5), {}, force)[2]);
  };
  const double step   = 1e-5;
  const double wanted = (at(1 + step) - at(1 - step)) / (2 * step);
  EXPECT_TRUE(near(level_slopes(set_r().model, set_r().damping, 2e5, force).of(2, "K3"), wanted,
                   within_absolute(1e-6, "central difference with a step of 1e-5: rounding of the level")));
}

TEST(LevelAdvice, TunedDamperIsTheReference)
{
  const auto wanted           = reference("advice.tmd", "twin");
  const VibratingStand &stand = set_r().advised.stand;
  const ForceBand &force      = set_r().force;
  const int mode              = leading_mode(stand, 2, 2, force);
  EXPECT_EQ(mode + 1, wanted["mode"].get<int>());
  EXPECT_TRUE(near(effective_mass(stand, mode, 2), wanted["effective_mass"].get<double>(),
                   within(1e-9, "one eigenvector")));
  const Attachment start = closed_tuning(stand, mode, 2, 0.05);
  EXPECT_TRUE(near(start.mass, wanted["mass"].get<double>(), within(1e-9, "closed form")));
  EXPECT_TRUE(near(start.frequency, wanted["start"][0].get<double>(), within(1e-9, "closed form")));
  EXPECT_TRUE(near(start.ratio, wanted["start"][1].get<double>(), within(1e-9, "closed form")));
  const Eigen::VectorXd level = levels(stand, {}, force);
  const TunedDamper tuned     = tune(stand, {}, 2, start, force, level[2]);
  const Tolerance of_level    = within(1e-4, "of the level", 1);
  EXPECT_TRUE(near(tuned.start_change, wanted["start_change"][0].get<double>(), of_level));
  EXPECT_TRUE(near(tuned.change, wanted["change"][0].get<double>(), of_level));
  EXPECT_TRUE(near(tuned.best.frequency, wanted["frequency"].get<double>(), within(1e-2, "a flat minimum")));
  EXPECT_TRUE(near(tuned.best.ratio, wanted["damping"].get<double>(), within(1e-2, "a flat minimum")));
  EXPECT_TRUE(near(tuned.detuned_by(-0.05), wanted["detuned"][0][0].get<double>(), of_level));
  EXPECT_TRUE(near(tuned.detuned_by(0.05), wanted["detuned"][1][0].get<double>(), of_level));
  const Eigen::VectorXd after = levels(stand, {tuned.best}, force);
  EXPECT_TRUE(near(after[2] / level[2] - 1, tuned.change,
                   within_absolute(1e-10, "the same equations with the same damper, rounding")));
  EXPECT_TRUE(
      near(after[3] / level[3] - 1, 0, within_absolute(1e-10, "the lower half does not feel it, rounding")));
}

// Nested golden sections over the equations of motion: another level and another search.
TEST(LevelAdvice, TuningIsTheMinimumOfAnIndependentSearch)
{
  const ForceBand force       = white_force(20, 990, 6);
  const VibratingStand &stand = set_r().advised.stand;
  const int mode              = leading_mode(stand, 2, 2, force);
  const Attachment start      = closed_tuning(stand, mode, 2, 0.08);
  const double level          = levels(stand, {}, force)[2];
  const TunedDamper tuned     = tune(stand, {}, 2, start, force, level);
  const auto at               = [&](const double f, const double ratio) {
    Attachment a = start;
    a.frequency = f, a.ratio = ratio;
    return level_by_equations(set_r().model, {a}, 2, force);
  };
  double best_ratio     = 0;
  const auto over_ratio = [&](const double f) {
    best_ratio = golden([&](const double ratio) { return at(f, ratio); }, 0.02, 0.5);
    return at(f, best_ratio);
  };
  const double best = golden(over_ratio, 0.8 * start.frequency, 1.2 * start.frequency);
  EXPECT_TRUE(near(tuned.best.frequency, best, within(1e-3, "a flat minimum, 24 sections")));
  over_ratio(best);
  EXPECT_TRUE(near(tuned.best.ratio, best_ratio, within(1e-2, "a flat minimum, 24 sections")));
  EXPECT_TRUE(
      near((1 + tuned.change) * level, at(best, best_ratio), within(1e-7, "at a minimum the level is flat")));
  EXPECT_TRUE(tuned.inside);
}

TEST(LevelAdvice, PairsAreRecomputed)
{
  LevelQuestion q          = usual_question(set_r().advised);
  const LevelAdvice advice = level_advice(set_r().advised, q);
  std::size_t n            = 0;
  for (const RatedAction &pair : advice.actions) {
    if (!pair.pair)
      continue;
    ++n;
    EXPECT_GT(std::abs(pair.change - pair.apart), 1e-3) << pair.name << " is not its parts one after the other";
    const bool tuned = pair.name.find("tuned") != std::string::npos;
    // A second damper on the same mode finds less to take than alone, and a retuned mass is at least as good as
    // either.
    EXPECT_GT(pair.change, pair.apart) << pair.name;
    if (tuned)
      EXPECT_LT(pair.change, advice.tuned.front().change) << pair.name;
  }
  EXPECT_EQ(n, 3u);
  EXPECT_EQ(advice.actions.front().name.find("tuned damper 97.47 kg, upper work roll and damper"), 0u)
      << advice.actions.front().name;
  // K3 softer and a damper, solved from the equations of the changed stand.
  q.dampers = {{"damper", {damper(1, 2, 1e5)}}};
  q.tuned.clear();
  q.springs               = {{"K3", 0.8, 1, ""}};
  q.force                 = white_force(0, 1000, 2.3);
  const LevelAdvice two   = level_advice(set_r().advised, q);
  const RatedAction &both = action(two, "damper and K3 x 0.8");
  LumpedModel softer;
  const auto in = reference("advice.inputs", "twin");
  for (std::size_t i = 0; i < 6; ++i)
    softer.M[i].value = in["M"][i];
  for (std::size_t i = 0; i < 7; ++i)
    softer.K[i].value = in["K"][i].get<double>() * (i == 2 ? 0.8 : 1);
  const MillModel changed = dynamics::mill_model(softer, DynamicsSettings{});
  EXPECT_TRUE(near(both.change,
                   level_by_equations(changed, {damper(1, 2, 1e5)}, 2, q.force) /
                           level_by_equations(set_r().model, {}, 2, q.force) -
                       1,
                   within_absolute(1e-9, "one set of equations solved in two ways")));
}

TEST(LevelAdvice, RejectsActionsThatViolateALimit)
{
  LevelQuestion q = usual_question(set_r().advised);
  q.springs       = {{"K1", 0.3, 1, ""}, {"K3", 0.8, 1.2, ""}};
  q.dampers.clear();
  q.tuned.clear();
  q.softening              = 0.10;
  const LevelAdvice advice = level_advice(set_r().advised, q);
  const double flexibility = 1 / 6.3086e9 + 1 / 10.233e9 + 2 / 40.191831577696884e9 + 1 / 29.301e9 + 1 / 6.8789e9;
  const double stiffness   = flexibility / (flexibility + (1 / 0.3 - 1) / 6.3086e9) - 1;
  const RatedAction &soft  = action(advice, "K1 x 0.3");
  EXPECT_TRUE(near(effect(soft, "stiffness of the stand"), stiffness,
                   within_absolute(1e-9, "springs in series, closed form")));
  EXPECT_EQ(soft.against.front(), "the stand gets softer by 43.2 %, at most 10 % are allowed");
  EXPECT_EQ(action(advice, "K3 x 1.2").against, std::vector<std::string>{"raises the level"});
  ASSERT_EQ(above_the_line(advice.actions), 1u);
  EXPECT_EQ(advice.actions.front().name, "K3 x 0.8");
}

TEST(LevelAdvice, AnotherRollThatVibratesMoreIsALimit)
{
  // A place that both rolls share: between the work rolls a damper helps both, a softer K3 only the upper one.
  LevelQuestion q = usual_question(set_r().advised);
  q.place         = dynamics::upper_backup_roll;
  q.springs       = {{"K3", 0.5, 1, ""}, {"K2", 0.5, 2, ""}};
  q.dampers.clear();
  q.tuned.clear();
  q.rise_elsewhere         = 0;
  const LevelAdvice advice = level_advice(set_r().advised, q);
  bool refused             = false;
  for (const RatedAction &one : advice.actions)
    for (const SideEffect &e : one.effects)
      if (e.name.find("roll, level") != std::string::npos && e.value > 0) {
        refused = true;
        EXPECT_FALSE(one.against.empty()) << one.name << ": " << e.name;
      }
  EXPECT_TRUE(refused);
}

TEST(LevelAdvice, StatesTheParametersItRestsOn)
{
  LevelQuestion q          = usual_question(set_r().advised);
  q.unidentified           = {{"K2", "which the records do not tell"}, {"K3", "which the records do not tell"}};
  const LevelAdvice advice = level_advice(set_r().advised, q);
  const std::string chain  = "chain only: a damper sits on chocks, which the six masses do not have";
  for (const RatedAction &one : advice.actions) {
    const auto &remarks = one.remarks;
    EXPECT_EQ(std::count(remarks.begin(), remarks.end(), chain), one.joined.empty() ? 0 : 1) << one.name;
    EXPECT_EQ(std::count(remarks.begin(), remarks.end(), "rests on K3, which the records do not tell"), 1)
        << one.name << ": the level follows K3";
    EXPECT_EQ(std::count(remarks.begin(), remarks.end(), "rests on K2, which the records do not tell"),
              one.name.find("K2") == std::string::npos ? 0 : 1)
        << one.name;
  }
}

TEST(LevelAdvice, ASparserBandThatResolvesTheModesGivesTheSame)
{
  const double fine   = levels(set_r().advised.stand, {}, set_r().force)[2];
  const double step   = resolving_step(set_r().advised.stand, 1000);
  const double sparse = levels(set_r().advised.stand, {}, white_force(0, 1000, step, 1000))[2];
  EXPECT_GT(step, 0.05);
  EXPECT_TRUE(near(sparse, fine, within(1e-9, "a quarter of the least half width")));
}

TEST(LevelAdvice, ScaleOfTheForceAndUnitsOfThePlaceDoNotMatter)
{
  LevelQuestion q = usual_question(set_r().advised);
  q.tuned.clear();
  const LevelAdvice one = level_advice(set_r().advised, q);
  q.force.square *= 1e12;
  const LevelAdvice other = level_advice(set_r().advised, q);
  ASSERT_EQ(one.actions.size(), other.actions.size());
  for (std::size_t i = 0; i < one.actions.size(); ++i)
    EXPECT_TRUE(near(one.actions[i].change, other.actions[i].change,
                     within_absolute(1e-6, "ratios of levels do not depend on the scale of the force")))
        << one.actions[i].name;
  EXPECT_EQ(set_r().advised.stand.place("upper_work_roll"), 2);
  EXPECT_EQ(set_r().advised.stand.place("upper work roll"), 2);
  EXPECT_EQ(set_r().advised.stand.place("upper chock"), -1);
}

TEST(LevelAdvice, AStandWithoutDampingHasNoLevel)
{
  AdvisedStand still  = set_r().advised;
  still.stand.damping = Eigen::VectorXd::Zero(6);
  EXPECT_THROW(level_advice(still, usual_question(set_r().advised)), InputError);
}

// The spread of a change by the errors of the stand: one error alone is the difference that it makes.
TEST(LevelAdvice, SpreadIsWhatErrorsMove)
{
  LevelQuestion q = usual_question(set_r().advised);
  q.springs.clear();
  q.dampers.clear();
  q.damping_error = 0;
  for (const char *spring : {"K1", "K2", "K5", "K6", "K7"})
    q.spring_error[spring] = 0;
  q.spring_error["K3"]     = 0.05;
  const LevelAdvice advice = level_advice(set_r().advised, q);
  const RatedAction &tuned = advice.actions.front();
  LumpedModel stiffer;
  const auto in = reference("advice.inputs", "twin");
  for (std::size_t i = 0; i < 6; ++i)
    stiffer.M[i].value = in["M"][i];
  for (std::size_t i = 0; i < 7; ++i)
    stiffer.K[i].value = in["K"][i].get<double>() * (i == 2 ? 1.05 : 1);
  const MillModel moved = dynamics::mill_model(stiffer, DynamicsSettings{});
  const ForceBand force = white_force(0, 1000, 0.5);
  const double moved_change =
      level_by_equations(moved, tuned.joined, 2, force) / level_by_equations(moved, {}, 2, force) - 1;
  EXPECT_TRUE(near(tuned.spread, std::abs(moved_change - tuned.change), within(1e-3, "sums of coarser steps")));
}

// A tuned damper on the half of the stand that the place does not belong to: nothing to tune for, and no nonsense.
TEST(LevelAdvice, ATunedDamperThatThePlaceDoesNotFeelDoesNothing)
{
  LevelQuestion q = usual_question(set_r().advised);
  q.springs.clear();
  q.dampers.clear();
  q.tuned                  = {TunedChoice{dynamics::lower_work_roll}};
  const LevelAdvice advice = level_advice(set_r().advised, q);
  ASSERT_EQ(advice.actions.size(), 1u);
  EXPECT_TRUE(
      near(advice.actions.front().change, 0, within_absolute(1e-10, "the place does not feel it, rounding")));
  EXPECT_TRUE(std::isfinite(advice.tuned.front().best.mass));
  EXPECT_EQ(advice.actions.front().against, std::vector<std::string>{"changes this level by less than 0.1 %"});
}
