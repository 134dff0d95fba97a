// A re-calibration of a case of kind chatter: what it writes, and the stand that the critical speed is then sought
// with.
#include "app/twin/live/live_chatter.h"
#include "app/twin/live/live_stand.h"
#include "core/base/files.h"
#include "core/case/lumped_model_toml.h"
#include "core/model/case.h"
#include "dynamics/chatter/stand_structure.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include "twin/live/compare/comparison.h"
#include "twin/live/compare/proposals.h"
#include <cmath>

using namespace mill;

namespace {
const char *const tandem = "cases/chatter-tandem.toml";

live::Proposal softer_contact(const live::TwinModel &model)
{
  live::Proposal proposal;
  proposal.utc                   = 1.7e9;
  proposal.reason                = "Mode 6 has fallen by 2.50 %.";
  proposal.recalibration.seconds = 60;
  proposal.recalibration.values  = {{"K3", 0.06, std::log(0.9), 0.001, true},
                                    {"K1", 0.06, 0, 0.02, false},
                                    {"zeta", 2, std::log(1.5), 0.01, true}};
  proposal.before                = model.chain;
  proposal.chain                 = live::recalibrated(model.chain, proposal.recalibration, 1e6);
  proposal.damping_before        = model.dynamics.modal_damping;
  proposal.damping               = live::recalibrated(model.dynamics.modal_damping, proposal.recalibration);
  return proposal;
}
}  // namespace

TEST(LiveChatter, AnAdoptedChainIsACaseAndMovesTheCriticalSpeed)
{
  const Case the_case           = read_case(tandem);
  const ChatterStand &given     = std::get<ChatterCase>(the_case.spec).stand;
  live::TwinModel model         = live_model(the_case, true);
  const live::Proposal proposal = softer_contact(model);
  EXPECT_FALSE(live::unknowns_of(model.chain).empty()) << "a chatter case has springs that may be proposed";

  const std::string folder = scratch("live-chatter"), file = folder + "/calibrated.toml";
  const std::string text = live::calibrated_case(proposal, the_case, folder);
  EXPECT_NE(text.find("# For a chatter case: [stand] from = \"this file\" in place of masses, stiffnesses and "
                      "dampings.\n"),
            std::string::npos)
      << text;
  write_atomically(file, text);
  const Case written      = read_case(file);
  const LumpedModel chain = lumped_model_of(written);
  EXPECT_TRUE(near(chain.K[2].value, 0.9 * given.stiffnesses[2], within(1e-9, "as written")));
  EXPECT_TRUE(near(chain.K[0].value, given.stiffnesses[0], within(1e-9, "not identified: unchanged")));
  EXPECT_TRUE(near(std::get<Lumped>(written.spec).dynamics.modal_damping, 1.5 * model.dynamics.modal_damping,
                   within(1e-6, "as written")));

  model.chain                  = proposal.chain;
  model.dynamics.modal_damping = proposal.damping;
  model.adopted                = "calibrated.toml";
  const auto watched           = live_chatter(the_case, model);
  ASSERT_TRUE(watched);
  auto softer = given.stiffnesses;
  softer[2] *= 0.9;
  const auto by_hand = dynamics::six_mass_structure(given.masses, softer, given.dampings);
  const auto &stand  = watched->setup.model.stand.structure;
  ASSERT_EQ(stand.n(), 6);
  for (Eigen::Index i = 0; i < 6; ++i) {
    EXPECT_TRUE(near(stand.K(i, i), by_hand.K(i, i), within(1e-12, "the same springs, signs left aside")));
    EXPECT_TRUE(near(stand.M(i, i), by_hand.M(i, i), within(1e-12, "the same masses")));
  }
}
