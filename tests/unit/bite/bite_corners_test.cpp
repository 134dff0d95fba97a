// Legal but extreme passes: every slab theory ends with a force or a sentence, within a bound on its steps.
#include "core/base/errors.h"
#include "reduce/bite/slab/karman_arc.h"
#include "reduce/bite/slab/slab_bite.h"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace mill;
using namespace mill::bite;

namespace {
constexpr double mm = 1e-3, MPa = 1e6;

RollBite pass(const double entry, const double exit, const double radius, const FlowStress &law, const double mu,
              const double limit, const double entry_tension = 0, const double exit_tension = 0)
{
  RollBite b;
  b.roll_radius                = radius * mm;
  b.strip.width                = 1;
  b.strip.entry_thickness      = entry * mm;
  b.strip.exit_thickness       = exit * mm;
  b.strip.flow_stress          = law;
  b.strip.friction.coefficient = mu;
  b.strip.friction.shear_limit = limit;
  b.strip.entry_tension        = entry_tension * MPa;
  b.strip.exit_tension         = exit_tension * MPa;
  return b;
}

/// The force, or what was said.
std::string outcome(const RollBite &bite, const SlabModel &model)
{
  try {
    const BiteState s = solve_slab(bite, model);
    EXPECT_LE(s.iterations, 2000);
    return std::isfinite(s.force) && s.force > 0 && std::isfinite(s.torque) ? "force" : "no number";
  } catch (const InputError &e) {
    return e.problems.front().message.empty() ? "nothing said" : "sentence";
  } catch (const SolverError &e) {
    return std::string(e.what()).empty() ? "nothing said" : "sentence";
  }
}

void expect_end(const RollBite &bite, const SlabModel &model, const std::string &where)
{
  const std::string end = outcome(bite, model);
  EXPECT_TRUE(end == "force" || end == "sentence") << where << ": " << end;
  if (model.theory != Theory::karman && model.theory != Theory::orowan)
    return;
  KarmanOptions options;
  options.derivatives = false;
  options.points      = 0;
  try {
    check_slices(bite);
    EXPECT_LE(
        solve_on_circle(bite, model.theory, bite.roll_radius, bite.strip.friction.coefficient, options).steps,
        1000)
        << where;
  } catch (const InputError &) {
  } catch (const SolverError &) {  // says that it would take more
  }
}
}  // namespace

// What hung: a branch whose pressure fell below zero, in steps of a millionth of the arc.
TEST(BiteCorners, CasesThatOnceRanForeverEnd)
{
  const FlowStress constant{FlowStressLaw::constant, 28 * MPa, 0, 0, 0, {}};
  const RollBite corners[] = {
      pass(8, 0.005, 210, constant, 0.2, 1),
      pass(8, 0.008, 5, constant, 1, 0.01, 27.999972),
      pass(0.02, 0.005, 725, constant, 0.2, 0.01, 27.999972),
      pass(1000, 100, 210, {FlowStressLaw::swift, 1e4 * MPa, 10, 0.2, 0, {}}, 0.2, 1, 9900, 9999),
      pass(0.1, 0.005, 1500, constant, 1, 1),
      pass(0.26, 0.005, 34.8, {FlowStressLaw::constant, 1180 * MPa, 0, 0, 0, {}}, 0.059523, 1, 289.41, 385.04),
  };
  for (const RollBite &bite : corners)
    for (const Theory theory : {Theory::karman, Theory::orowan, Theory::bland_ford})
      for (const Arc arc : {Arc::rigid, Arc::hitchcock})
        expect_end(bite, {theory, arc}, "corner " + std::to_string(&bite - corners));
}

TEST(BiteCorners, OfEveryRow)
{
  constexpr unsigned seed = 20240;
  std::mt19937 random(seed);
  const auto one_of       = [&](const std::vector<double> &values) { return values[random() % values.size()]; };
  const auto &laws        = flow_stress_laws();
  const Theory theories[] = {Theory::karman, Theory::orowan, Theory::bland_ford, Theory::hu_ehmann, Theory::sims};
  for (int i = 0; i < 300; ++i) {
    const double k = one_of({1e-6, 1, 28, 700, 10000}), entry = one_of({0.01, 0.1, 1, 8, 100, 1000});
    FlowStress law{laws[random() % 7],
                   k * MPa,
                   one_of({0, 1e-6, 0.01, 10}),
                   one_of({0, 1e-3, 0.2, 1, 3, 100}),
                   one_of({0, 1e-6, 1}) * k * MPa,
                   {}};
    if (law.law == FlowStressLaw::table)
      law.table = {{0, law.k}, {1e-6, law.k}, {0.3, 3 * law.k}, {20, 3 * law.k}};
    const double exit = std::max(0.005, entry * one_of({0.5, 0.9, 0.999999, 0.1, 0.01, 1e-3}));
    RollBite b =
        pass(entry, exit, one_of({5, 50, 210, 725, 1500}), law, one_of({0, 1e-9, 1e-3, 0.05, 0.2, 0.5, 1}),
             one_of({0.01, 1, 1}), k * one_of({0, 0, 0.5, 0.999999}), k * one_of({0, 0, 0.5, 0.999999}));
    b.strip.friction.law          = random() % 4 ? FrictionLaw::coulomb : FrictionLaw::factor;
    b.strip.friction.entry_factor = one_of({0, 1e-6, 0.3, 1});
    b.strip.friction.exit_factor  = one_of({0, 1e-6, 0.3, 1});
    expect_end(b, {theories[random() % 5], random() % 3 ? Arc::rigid : Arc::hitchcock},
               "seed " + std::to_string(seed) + ", pass " + std::to_string(i));
  }
}

TEST(BiteCorners, MoreThanTheRollsCanTakeOffIsRefused)
{
  const FlowStress law{FlowStressLaw::constant, 28 * MPa, 0, 0, 0, {}};
  try {
    solve_slab(pass(1000, 100, 210, law, 0.2, 1), {Theory::karman, Arc::rigid});
    FAIL() << "accepted";
  } catch (const InputError &e) {
    EXPECT_EQ(
        e.problems.front().message,
        "strip.entry_thickness = 1000 mm less strip.exit_thickness = 100 mm is more than rolls of a diameter of "
        "420 mm can take off: the entry lies beyond their axes");
  }
}
