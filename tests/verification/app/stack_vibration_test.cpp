#include "app/stack/four_high_stack.h"
#include "app/stack/stack_bite.h"
#include "app/stack/stack_motion.h"
#include "app/trace/closed_form_parts.h"
#include "core/base/files.h"
#include "core/model/case.h"
#include "reduce/stack/beam_stack.h"
#include "reduce/stand/stand_modes.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include <cmath>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

// A solved stack as it vibrates, and a four-high case as a stack.
namespace {
using namespace mill;

Case case_of_tree(const std::string &name, const std::vector<std::string> &sets = {})
{
  return read_case(std::string(MILLSTAND_SOURCE_DIR) + "/cases/" + name, sets);
}

Case as_stack(const std::string &name)
{
  const Case drawn = case_of_tree(name);
  return read_case_of(drawn.path, four_high_as_stack(drawn));
}
}  // namespace

// ST-10: the contact of both kinds, under an even load.
TEST(FourHighAsStack, HasTheContactAndTheBearingsOfTheStand)
{
  const Case drawn = case_of_tree("four-high-1400.toml"), made = as_stack("four-high-1400.toml");
  const StackCase &spec = std::get<StackCase>(made.spec);
  reduce::BeamStack engine(*spec.stack, {});
  const auto state = engine.solve();
  const ClosedFormResult K3 =
      closed_form_contact(std::get<FourHigh>(drawn.spec), "upper", spec.stack->strip.force, 0);
  EXPECT_TRUE(near(state.pairs[0].uniform_tangent, K3.parameter.value, within(0.005, "the load is not even")));
  EXPECT_TRUE(near(state.pairs[0].uniform_tangent, 4.012e10, within(0.005, "976.0 for 976.2 kN")));
  EXPECT_TRUE(near(K3.parameter.value, 4.019e10, within(1e-3, "closed form of the specification")));
  // Springs of the chain without the bending of the roll, a side.
  EXPECT_TRUE(
      near(spec.input->rolls[1].bearing_stiffness[0], 2070e6, within(2e-3, "rounded in the specification")));
  EXPECT_TRUE(
      near(spec.input->rolls[1].bearing_stiffness[1], 3030e6, within(2e-3, "rounded in the specification")));
}

TEST(FourHighAsStack, KeepsItsPassesAndTheirRecords)
{
  const Case drawn = case_of_tree("four-high-1400.toml"), made = as_stack("four-high-1400.toml");
  const auto &of_stand = std::get<FourHigh>(drawn.spec).passes;
  const auto &of_stack = std::get<StackCase>(made.spec).input->passes;
  ASSERT_EQ(of_stack.size(), of_stand.size());
  for (std::size_t p = 0; p < of_stand.size(); ++p) {
    EXPECT_EQ(of_stack[p].name, of_stand[p].name);
    EXPECT_TRUE(near(of_stack[p].measured_peak_g[0], of_stand[p].measured_peak_g[0], within(1e-12, "units")));
  }
}

TEST(FourHighAsStack, RefusesOtherKinds)
{
  const Outcome outcome = millstand("check cases/z-mill.toml --as stack");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(
      outcome.err.find("--as stack takes a case of kind \"four-high\"; cases/z-mill.toml is of kind \"cluster\""),
      std::string::npos)
      << outcome.err;
}

// What a force in the gap does to the stand that is driven, is what it does to all modes of the model.
TEST(StackMotionOfACase, DrivesTheOpenStackWithItsWholeCompliance)
{
  const Case made          = case_of_tree("stack-four-high.toml");
  const StackCase &spec    = std::get<StackCase>(made.spec);
  const DrivenStand driven = driven_stack(*spec.input, *spec.stack, "");
  ASSERT_TRUE(driven.modes && driven.detailed);
  const StandModel &model = driven.detailed->model;
  const auto all          = reduce::stand_modes(model);
  const Eigen::ArrayXd w  = 2 * M_PI * all.frequency.array();
  const double by_modes   = ((all.shape.transpose() * model.b).array() / w).square().sum();
  EXPECT_TRUE(near(by_modes, model.b.dot(reduce::static_displacement(model)), within(1e-7, "rounding")));
  EXPECT_EQ(driven.modes->labels[2], "upper work roll");
  EXPECT_GT(driven.modes->frequency.size(), 8);
}

TEST(StackMotionOfACase, HasAStripAsStiffAsItsLawAllows)
{
  const Case made         = case_of_tree("stack-four-high.toml");
  const StackCase &spec   = std::get<StackCase>(made.spec);
  const MovingPass moving = moving_pass(*spec.input, *spec.stack, Pass{}, 30);
  // 300 MPa over 1 m, a little less by the flattening of both rolls.
  EXPECT_LT(moving.moving.strip_stiffness, 300e6);
  EXPECT_GT(moving.moving.strip_stiffness, 0.98 * 300e6);
  const Case uniform     = case_of_tree("stack-four-high.toml", {"strip.law=uniform"});
  const StackCase &other = std::get<StackCase>(uniform.spec);
  EXPECT_FALSE(moving_pass(*other.input, *other.stack, Pass{}, 30).rolling);
}

// law = "bite": slopes by the theory of Bland and Ford; a harder strip pushes back more.
TEST(StackMotionOfACase, TakesTheSlopesOfItsBite)
{
  const auto slopes = [](const char *k) {
    const Case made       = case_of_tree("stack-six-high.toml",
                                         {"strip.law=bite", "strip.friction=0.05", "strip.flow_stress.law=constant",
                                          std::string("strip.flow_stress.k=") + k});
    const StackCase &spec = std::get<StackCase>(made.spec);
    return with_slopes_of_bite(*spec.input, *spec.stack).strip;
  };
  const StackStrip soft = slopes("600 MPa"), hard = slopes("700 MPa");
  EXPECT_GT(soft.modulus, 0);
  EXPECT_GT(hard.modulus, soft.modulus);
  EXPECT_GT(soft.entry_modulus, 0);
  EXPECT_GT(soft.tension_modulus, 0);
}

// law = "bite": a pass is the stack of a case whose strip has the values of the pass.
TEST(StackMotionOfACase, TakesTheSlopesOfTheBiteOfItsPass)
{
  const auto six = [](const std::vector<std::string> &more) {
    std::vector<std::string> sets{"strip.law=bite", "strip.friction=0.05", "strip.flow_stress.law=constant",
                                  "strip.flow_stress.k=600 MPa"};
    sets.insert(sets.end(), more.begin(), more.end());
    return case_of_tree("stack-six-high.toml", sets);
  };
  const auto strip_of = [](const Case &made, const Pass &pass) {
    const StackCase &spec = std::get<StackCase>(made.spec);
    return moving_pass(*spec.input, with_slopes_of_bite(*spec.input, *spec.stack), pass, 30).stack.strip;
  };
  Pass thinner;
  thinner.entry_thickness   = 1e-3;
  thinner.exit_tension      = 100e6;
  const StackStrip of_strip = strip_of(six({}), Pass{}), of_pass = strip_of(six({}), thinner),
                   of_case = strip_of(six({"strip.entry_thickness=1 mm", "strip.exit_tension=100 MPa"}), Pass{});
  EXPECT_GT(std::abs(of_pass.modulus / of_strip.modulus - 1), 0.01);
  for (const auto member : {&StackStrip::modulus, &StackStrip::entry_modulus, &StackStrip::tension_modulus,
                            &StackStrip::entry_thickness, &StackStrip::exit_thickness})
    EXPECT_TRUE(near(of_pass.*member, of_case.*member, within(1e-12, "the same numbers")));
}

TEST(StackMotionOfACase, NamesItsModesFromTheCommandLine)
{
  const std::string folder = scratch("stack-modes");
  const Outcome outcome    = millstand("modes cases/stack-four-high.toml -o " + folder);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto values = nlohmann::json::parse(read_text(folder + "/results.json")).at("values");
  EXPECT_TRUE(near(values.at("stack.f1").at("value").get<double>(), 42.71, within(3e-3, "mesh of both models")));
  EXPECT_TRUE(values.contains("mode.gap_first_kind.frequency"));
  EXPECT_TRUE(values.contains("open.mode.gap_first_kind.frequency"));
  EXPECT_FALSE(values.at("stack.f1").at("checks").empty()) << "one mass for each roll stands next to it";
  const auto &share = values.at("mode.gap_first_kind.gap_share");
  ASSERT_EQ(share.at("checks").size(), 1u);
  // Both meshes of the beams resolve the lowest frequencies to 1e-4, and a share by squares of the shapes.
  EXPECT_TRUE(near(share.at("checks")[0].at("value").get<double>(), share.at("value").get<double>(),
                   within(1e-2, "elements twice as long")));
}

// Bending that makes the approach of the contacts fall with the force: the run has all its other results.
TEST(StackMotionOfACase, RunsUnderBendingOfItsWorkRolls)
{
  const std::string folder = scratch("stack-bent");
  const Outcome outcome    = millstand(
         "modes cases/stack-four-high.toml --set 'roll.0.bending_force=[\"800 kN\", \"800 kN\"]' -o " + folder);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(nlohmann::json::parse(read_text(folder + "/results.json")).at("values").contains("stack.f1"));
}
