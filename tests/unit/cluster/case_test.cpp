#include "core/base/files.h"
#include "core/case/cluster_variants.h"
#include "core/model/case.h"
#include "dynamics/cluster/fit.h"
#include "dynamics/cluster/stack_of_case.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include <filesystem>
#include <gtest/gtest.h>

using namespace mill;

namespace {
ClusterStand z_mill(const std::vector<std::string> &sets = {})
{
  return *std::get<ClusterCase>(read_case("cases/z-mill.toml", sets).spec).stand;
}

std::string refusal_of_placement(const std::vector<std::string> &sets)
{
  try {
    cluster::placed_rolls(z_mill(sets));
  } catch (const InputError &e) {
    return e.problems.front().message;
  }
  return "";
}
}  // namespace

TEST(ClusterCaseFile, TheZMillCaseIsVariantNOfTheReference)
{
  const ClusterStand stand = z_mill();
  const auto state         = cluster::pass_state(stand, stand.schedule[0], stand.schedule[0].load);
  const auto wanted        = reference("stack.N", "cluster")["by_identity"].get<std::vector<double>>();
  for (std::size_t i = 0; i < wanted.size(); ++i)
    EXPECT_TRUE(near(state.modes[std::size_t(state.identity[i])].frequency, wanted[i],
                     within(1e-6, "supports of the reference")))
        << stand.modes[i].name;
  const auto stress = reference("tension_stress", "cluster");
  EXPECT_TRUE(
      near(stand.schedule[0].entry_tension, 38e3 / (0.505 * 0.26e-3), within(1e-12, "force over section")));
  EXPECT_FALSE(stress.empty());
}

TEST(ClusterCaseFile, FitsOfTheVariantsMeetTheReference)
{
  const ClusterStand stand = z_mill();
  for (const char *name : {"N", "C"}) {
    const auto variant = std::find_if(stand.variants.begin(), stand.variants.end(),
                                      [&](const ClusterVariant &v) { return v.name == name; });
    // The start is 20 % off, so that something is searched.
    ClusterStand moved = stand;
    *number_of(moved, "support.E.stiffness") *= 1.2;
    *number_of(moved, "support.R.stiffness") *= 0.8;
    const auto fit = cluster::fit_variant(moved, *variant, stand.schedule[0], 1148e3);
    const auto ref = reference(std::string("stack.") + name, "cluster");
    ASSERT_TRUE(fit.converged) << fit.refused;
    EXPECT_TRUE(near(fit.numbers[0].value, double(ref["k_b"]), within(1e-5, "least squares")));
    EXPECT_TRUE(
        near(fit.numbers[1].value, double(ref["k_r"]), within(1e-5, "least squares of 647 and 648 for 647.5")));
    const auto wanted = ref["by_identity"].get<std::vector<double>>();
    for (std::size_t i = 3; i < wanted.size(); ++i) {
      EXPECT_TRUE(near(fit.frequencies[i].computed, wanted[i], within(1e-5, "least squares")));
      EXPECT_FALSE(fit.frequencies[i].fitted);
    }
    EXPECT_GT(fit.numbers[0].interval, 0);
  }
}

TEST(ClusterCaseFile, AFitWithoutSpareFrequenciesStatesNoInterval)
{
  const ClusterStand stand = z_mill();
  const auto fit           = cluster::fit_variant(stand, stand.variants.back(), stand.schedule[0], 1148e3);
  ASSERT_TRUE(fit.converged) << fit.refused;
  for (const cluster::FittedNumber &n : fit.numbers)
    EXPECT_TRUE(std::isnan(n.interval)) << n.key;
  EXPECT_LT(fit.rms_fitted, 1e-9);
  EXPECT_GT(fit.rms_predicted, 1e-3);
}

TEST(ClusterCaseFile, ReportsContactsThatDoNotClose)
{
  EXPECT_EQ(
      refusal_of_placement({"roll.1.position=[\"0 mm\", \"139.6 mm\"]"}),
      "contact W-I does not close: the axes are 104.8000 mm apart, the radii make 104.7750 mm; the rolls stand "
      "apart by 0.0250 mm; move one of them, or leave its position to the contacts");
  // L at 60.3 mm and 80 deg from W, I at 104.775 mm above it: 46.583 mm apart, radii 95.475 mm.
  EXPECT_EQ(
      refusal_of_placement({"contact.3.direction=100 deg"}),
      "rolls I and L overlap by 48.8918 mm and have no [[contact]]; move one of them, or say that they touch");
}

TEST(ClusterCaseFile, NamesMotionsThatNothingHolds)
{
  ClusterStand stand = z_mill();
  stand.supports.erase(stand.supports.begin() + 1);
  const cluster::Stack stack = cluster::stack_of(stand, stand.schedule[0], 1e6);
  const auto motions         = cluster::free_motions(stack);
  ASSERT_EQ(motions.size(), 1u);
  EXPECT_EQ(stack.rolls[std::size_t(motions[0].roll)].name, "I");
  EXPECT_FALSE(motions[0].along_y);
}

TEST(ClusterCaseFile, RefusesVariantsWithUnknownOrMissingNumbers)
{
  const auto refusal = [](const std::string &set) -> std::string {
    try {
      read_case("cases/z-mill.toml", {set});
    } catch (const InputError &e) {
      return e.problems.front().message;
    }
    return "";
  };
  EXPECT_EQ(refusal("variant.0.unknowns=[\"contact.W-R.stiffness\"]"),
            "variant.0.unknowns = [\"contact.W-R.stiffness\"] names 'contact.W-R.stiffness', which is not a given "
            "number of the stack; for example support.E.stiffness, contact.W-I.stiffness of a spring");
  EXPECT_EQ(
      refusal("variant.0.modes=[\"E vertical\"]"),
      "variant.0.unknowns = [\"support.E.stiffness\", \"support.R.stiffness\"] are 2 numbers for 1 frequencies; a "
      "fit needs at least as many frequencies as unknowns");
  EXPECT_EQ(refusal("variant.0.set=[\"contact.W-Q.law = spring\"]"),
            "variant.0.set = [\"contact.W-Q.law = spring\"] cannot be set: 'contact.W-Q.law' names no part of the "
            "stack; "
            "contact.PAIR.KEY, support.NAME.KEY, roll.NAME.KEY and stack.KEY do");
  EXPECT_EQ(refusal("contact.0.law=spring"),
            "contact.0.law = \"spring\" needs a stiffness, for example stiffness = \"1.5e10 N/m\"");
  EXPECT_EQ(refusal("contact.0.pair=W-Q"), "contact.0.pair = \"W-Q\" names no roll 'Q'; known: W, I, E, L, R");
}
