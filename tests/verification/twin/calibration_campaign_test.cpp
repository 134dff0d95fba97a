// Stands drawn from their priors, calibrated by what their records show: the 95 % intervals hold the truth as
// often as they say (TW-21), and the whole calibration of the reference's entries (TW-17 to TW-20).
//
// The same without the force: no stand that is right is refused, and one with another frame is.
//
// The suite runs two stands of 5 s with three unknowns, and one without the force.  MILLSTAND_STANDS=20 runs the
// long form, 20 s each, and the entries.
#include "tests/support/calibration_record.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include "tests/support/synthetic_record.h"
#include "twin/calibration/calibration.h"
#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace mill;
using namespace mill::twin;

namespace {
CalibrationInput input_of(const calibration::Recipe &recipe, const bool force_recorded = true)
{
  static const std::vector<std::string> names{"upper_frame",     "upper_backup_roll", "upper_work_roll",
                                              "lower_work_roll", "lower_backup_roll", "lower_frame"};
  CalibrationInput input;
  input.stand    = calibration::stand_r();
  input.unknowns = calibration::unknowns_r();
  input.places   = recipe.places;
  for (const Eigen::Index place : recipe.places)
    input.sensors.push_back(names[std::size_t(place)]);
  input.rate    = recipe.rate;
  input.threads = 2;

  input.force_recorded = force_recorded;
  for (const auto &[from, into] : {std::pair{recipe, &input.fit}, std::pair{recipe.check(), &input.check}}) {
    const auto made = calibration::record(from);
    into->push_back({force_recorded ? made.force : Eigen::VectorXd(), made.acceleration});
  }
  return input;
}

/// The whole calibration of every entry; half a minute.
void expect_entries()
{
  for (const char *name : {"two", "six", "noisy", "low", "closed"}) {
    const auto recipe      = calibration::recipe(name);
    const auto known       = reference(std::string("calibrate.") + name + ".result", "twin");
    const Calibration done = calibrate(input_of(recipe), {});
    std::printf("%s: misfit %.4f -> %.4f, worst band %.4f and %.4f, %zu refusals\n", name, done.check.before,
                done.check.after, done.fit.worst, done.check.worst, done.refusals.size());
    if (recipe.frame == mill::FrameForm::closed) {
      EXPECT_GT(done.fit.worst, 1.05);
      EXPECT_GT(done.check.worst, 1.05);
      EXPECT_EQ(done.refusals.size(), 4u);  // both records, K1 and K7
      continue;
    }
    EXPECT_TRUE(done.refusals.empty()) << done.refusals.front();
    EXPECT_TRUE(near(done.check.after, 1, within_absolute(0.03, "noise of the residuals in the check")));
    for (std::size_t i = 0; i < done.unknowns.size(); ++i) {
      const Calibrated &u  = done.unknowns[i];
      const double ref     = known["estimates"][i]["shrink"];
      const double missing = u.estimate - recipe.truth.at(u.name);
      EXPECT_EQ(u.identified, ref <= 0.5) << name << " " << u.name;
      EXPECT_LT(std::abs(u.shrink - ref), 0.25 * ref) << name << " " << u.name;
      EXPECT_LT(std::abs(missing), 3.5 * u.sd) << name << " " << u.name;
    }
  }
}
}  // namespace

namespace {
/// Five seconds, of which the curved valley and the damping are fitted; the case knows the rest.
void make_short(CalibrationInput &input, const calibration::Recipe &recipe)
{
  LumpedModel stand = calibration::set_r();
  std::vector<Unknown> few;
  for (const Unknown &unknown : input.unknowns)
    if (unknown.name == "K1" || unknown.name == "K2" || unknown.name == "zeta")
      few.push_back(unknown);
    else
      stand.K[std::size_t(unknown.name[1] - '1')].value *= std::exp(recipe.truth.at(unknown.name));
  input.stand.chain = calibration::chain_of(stand);
  input.unknowns    = few;
  for (auto *pieces : {&input.fit, &input.check}) {
    ForcedSamples &piece = pieces->front();
    const ForcedSamples head{piece.force.head(std::min<Eigen::Index>(100001, piece.force.size())),
                             piece.acceleration.topRows(100001)};
    piece = head;
  }
}

struct Outcome {
  int stands = 0, held = 0, identified = 0, refused = 0;
};

/// Stands drawn from their priors: number of intervals of identified unknowns that hold the truth.
Outcome drawn_stands(const bool force_recorded)
{
  const char *asked = std::getenv("MILLSTAND_STANDS");
  Outcome sum;
  sum.stands = asked ? std::atoi(asked) : force_recorded ? 2 : 1;
  for (int i = 0; i < sum.stands; ++i) {
    calibration::Recipe recipe = calibration::recipe("two");
    recipe.seed                = 4000 + 10 * std::uint64_t(i);
    const Eigen::VectorXd draw = synthetic::normals(900 + std::uint64_t(i), 8);
    const auto unknowns        = calibration::unknowns_r();
    for (std::size_t q = 0; q < unknowns.size(); ++q)
      recipe.truth[unknowns[q].name] = unknowns[q].prior_sd * draw[Eigen::Index(q)];
    CalibrationInput input = input_of(recipe, force_recorded);
    if (!asked)
      make_short(input, recipe);
    const Calibration done = calibrate(input, {});
    sum.refused += !done.refusals.empty();
    for (const Calibrated &u : done.unknowns) {
      const double truth = recipe.truth[u.name];
      const bool in      = u.low <= truth && truth <= u.high;
      sum.identified += u.identified;
      sum.held += u.identified && in;
      if (asked && u.identified && !in)
        std::printf("stand %d: %s %.5f outside of %.5f .. %.5f\n", i, u.name.c_str(), truth, u.low, u.high);
      if (asked && !u.identified)
        std::printf("stand %d: %s %s\n", i, u.name.c_str(), u.why_not.c_str());
    }
    for (const std::string &reason : done.refusals)
      std::printf("stand %d: %s\n", i, reason.c_str());
  }
  if (asked)
    std::printf("%d of %d intervals hold the truth, %d of %d stands refused\n", sum.held, sum.identified,
                sum.refused, sum.stands);
  return sum;
}
}  // namespace

TEST(CalibrationCampaign, IntervalsContainTheTruthAtTheirStatedRate)
{
  const bool long_form = std::getenv("MILLSTAND_STANDS");
  const Outcome sum    = drawn_stands(true);
  if (long_form)
    expect_entries();
  EXPECT_GE(sum.identified, (long_form ? 5 : 2) * sum.stands);
  EXPECT_GE(sum.held, 0.85 * sum.identified) << sum.held << " of " << sum.identified;
}

TEST(CalibrationCampaign, IntervalsContainTheTruthWithoutForceAndRightStandsAreAccepted)
{
  const bool long_form = std::getenv("MILLSTAND_STANDS");
  const Outcome sum    = drawn_stands(false);
  EXPECT_GE(sum.identified,
            (long_form ? 5 : 1) * sum.stands);  // TW-15: zeta and the springs that few sensors part
  EXPECT_GE(sum.held, 0.85 * sum.identified) << sum.held << " of " << sum.identified;
  EXPECT_EQ(sum.refused, 0);
  if (!long_form)
    return;
  const Calibration closed = calibrate(input_of(calibration::recipe("closed"), false), {});
  for (const std::string &reason : closed.refusals)
    std::printf("closed: %s\n", reason.c_str());
  EXPECT_FALSE(closed.refusals.empty());
}
