// The live twin of a drawing: rolls as beams, stepped in their modes, with springs that may be changed on the run.
#include "app/twin/live/live_advice.h"
#include "app/twin/live/live_detail.h"
#include "app/twin/live/live_stand.h"
#include "core/base/files.h"
#include "core/model/case.h"
#include "dynamics/response/modal_model.h"
#include "dynamics/response/time_integration.h"
#include "reduce/stand/stand_modes.h"
#include "tests/support/live_samples.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include <cmath>
#include <filesystem>

using namespace mill;

namespace {
const Case &drawn_case()
{
  static const Case the_case = read_case("cases/four-high-1400.toml");
  return the_case;
}

const live::TwinModel &beams()
{
  static const live::TwinModel model = live_model(drawn_case(), false);
  return model;
}

live::TwinModel with_factor(live::TwinModel model, const std::size_t spring, const double factor)
{
  model.chain.K[spring].value *= factor;
  return model;
}

// Of all unknowns of the stand, without the twin's reduction.
Eigen::VectorXd whole_frequencies(const live::TwinModel &model)
{
  return reduce::stand_modes(live::with_springs(model.detailed->whole, *model.detailed, model.chain),
                             model.detailed->watched)
      .frequency;
}
}  // namespace

TEST(LiveDetail, TheTwinOfADrawingIsItsStandOfBeams)
{
  ASSERT_TRUE(beams().detailed);
  EXPECT_EQ(live::name_of_model(beams()), "beam");
  EXPECT_EQ(beams().source.rfind("rolls as beams, springs by closed forms at ", 0), 0u) << beams().source;
  EXPECT_FALSE(live_model(drawn_case(), true).detailed);
  const Eigen::VectorXd expected = whole_frequencies(beams()), twin = live::watched_modes(beams(), {}).frequency;
  ASSERT_EQ(twin.size(), expected.size());
  EXPECT_GT(twin.size(), 6) << "more modes than six masses have";
  EXPECT_LT((twin - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_EQ(beams().detailed->mode_names.size(), std::size_t(twin.size()));
}

TEST(LiveDetail, StepsItsModesAsTheExactHoldDoes)
{
  const live::DetailedTwin &detail = *beams().detailed;
  const ForceRecord record         = twelve_tones();
  const double rate                = 1 / (record.time[1] - record.time[0]);
  const auto modes                 = reduce::stand_modes(detail.whole);
  const auto expected =
      dynamics::first_order_hold(dynamics::state_space(dynamics::modal_model(
                                     detail.whole, modes.frequency, modes.shape, beams().dynamics.modal_damping,
                                     detail.highest, detail.gap_damper)),
                                 record, rate);
  const auto places = Eigen::Index(detail.whole.points.size());
  LiveSamples run(beams(), rate);
  run.send(record.force, 512);
  const Eigen::MatrixXd stepped = run.simulated();
  ASSERT_EQ(stepped.cols(), places);
  ASSERT_EQ(stepped.rows(), expected.output.cols());
  const Eigen::MatrixXd wanted = expected.output.topRows(places).transpose();
  EXPECT_LT((stepped - wanted).cwiseAbs().maxCoeff() / wanted.cwiseAbs().maxCoeff(), 1e-8);
}

TEST(LiveDetail, ASpringOnTheRunMovesTheModesAsInTheWholeStand)
{
  const char *const slider[] = {"K1", "K2", "K3"};
  for (const std::size_t spring : {0, 1, 2}) {
    live::Tuning tuning;
    live::set_factor(tuning, slider[spring], 1.2);
    const Eigen::VectorXd twin     = live::watched_modes(beams(), tuning).frequency,
                          expected = whole_frequencies(with_factor(beams(), spring, 1.2)),
                          before   = live::watched_modes(beams(), {}).frequency;
    const Eigen::Index n           = std::min(twin.size(), expected.size());
    EXPECT_LT((twin.head(n) - expected.head(n)).cwiseQuotient(expected.head(n)).cwiseAbs().maxCoeff(), 2e-4)
        << slider[spring] << ": shapes change within 64 modes";
    EXPECT_GT((twin.head(n) - before.head(n)).cwiseQuotient(before.head(n)).maxCoeff(), 5e-3) << slider[spring];
  }
}

// Half the strain share is the elasticity of a frequency, by the difference quotient.
TEST(LiveDetail, StrainSharesAreTheElasticitiesOfTheFrequencies)
{
  const auto modes = live::watched_modes(beams(), {});
  live::Tuning more, less;
  live::set_factor(more, "K3", 1 + 1e-4);
  live::set_factor(less, "K3", 1 - 1e-4);
  const Eigen::VectorXd high = live::watched_modes(beams(), more).frequency,
                        low  = live::watched_modes(beams(), less).frequency;
  for (Eigen::Index i = 0; i < 6; ++i)
    EXPECT_TRUE(near(std::log(high[i] / low[i]) / 2e-4, modes.strain_share(i, 2) / 2,
                     within_absolute(1e-6, "difference quotient")))
        << i;
}

TEST(LiveDetail, ContactsStiffenWithTheLoadInEveryWatchedMode)
{
  const auto at        = modes_at_load(drawn_case(), beams(), {});
  const auto frequency = live::watched_modes(beams(), {}).frequency;
  ASSERT_EQ(at.frequency.cols(), frequency.size());
  ASSERT_EQ(at.load.size(), 7);
  EXPECT_TRUE(near(at.frequency(3, 0), frequency[0], within(1e-9, "the middle load is that of the case")));
  for (Eigen::Index i = 0; i < frequency.size(); ++i)
    EXPECT_GE(at.frequency(6, i), at.frequency(0, i) * (1 - 1e-9)) << i;
  EXPECT_GT(at.frequency.row(6).sum(), 1.001 * at.frequency.row(0).sum());
}

TEST(LiveDetail, AStateOfAnotherModelIsRefusedInASentence)
{
  const ForceRecord record = twelve_tones();
  LiveSamples chain(live_model(drawn_case(), true), 4000), own(beams(), 4000);
  chain.send(record.force.head(2000), 500);
  own.send(record.force.head(2000), 500);
  const auto of_chain = chain.engine().state(), of_beams = own.engine().state();
  live::Engine fresh(beams(), {});
  EXPECT_EQ(fresh.resume(of_chain), "the stored state is of the model six-mass, the twin is of the model beam; it "
                                    "starts without the state");
  EXPECT_EQ(fresh.resume(of_beams).rfind("goes on at s = 2000", 0), 0u);
  LiveSamples whole(beams(), 4000);
  whole.send(record.force.head(4000), 500);
  LiveSamples second(beams(), 4000, &of_beams);
  second.send(record.force.segment(2000, 2000), 500, 2000);
  EXPECT_LT((second.simulated() - whole.simulated().bottomRows(2000)).cwiseAbs().maxCoeff() /
                whole.simulated().cwiseAbs().maxCoeff(),
            1e-9);
}

TEST(LiveDetail, AnAdoptedProposalIsACaseOfMatricesThatLiveReadsAgain)
{
  const std::string folder = testing::TempDir() + "millstand-live-detail";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  live::Proposal proposal;
  proposal.utc                   = 1.7e9;
  proposal.reason                = "Mode 3 has fallen by 2.50 %.";
  proposal.recalibration.seconds = 60;
  proposal.recalibration.values  = {{"K2", 0.06, std::log(0.8), 0.001, true}};
  proposal.before                = beams().chain;
  proposal.chain                 = live::recalibrated(beams().chain, proposal.recalibration, 1e6);
  proposal.damping               = 0.02;
  proposal.file                  = folder + "/calibrated-20260101T000000Z.toml";
  write_atomically(proposal.file, adopted_detail(beams(), proposal, drawn_case(), folder));
  const Case written             = read_case(proposal.file);
  const auto again               = live_model(written, false);
  live::TwinModel wanted         = beams();
  wanted.chain                   = proposal.chain;
  const Eigen::VectorXd expected = whole_frequencies(wanted), read = live::watched_modes(again, {}).frequency;
  ASSERT_EQ(read.size(), expected.size());
  EXPECT_LT((read - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_GT(beams().chain.K[1].value, 0);
  EXPECT_TRUE(near(again.dynamics.modal_damping, 0.02, within(1e-9, "as written")));
  EXPECT_TRUE(
      near(again.chain.K[1].value, 0.8 * beams().chain.K[1].value, within(1e-9, "the bearings, as written")));
  EXPECT_EQ(page_stand(written, again).sliders.size(), page_stand(drawn_case(), beams()).sliders.size());
}

TEST(LiveDetail, ThePageDrawsSixPlacesAndListsTheChocks)
{
  const auto page   = page_stand(drawn_case(), beams());
  std::size_t drawn = 0;
  for (const auto &place : page.places)
    drawn += place.drawn;
  EXPECT_EQ(drawn, 6u);
  EXPECT_GT(page.places.size(), 6u);
  EXPECT_EQ(page.sliders[1].label, "bearings of the upper backup roll");
  const auto advice = live_advice(beams(), {}, "upper_work_roll", 1.7e9);
  EXPECT_FALSE(advice.rows.empty()) << advice.text;
}

TEST(LiveDetail, ARecalibrationMovesItsSpringsByTheirNames)
{
  const twin::FittedStand stand = fitted_detail(beams(), beams().chain, 0.013);
  ASSERT_TRUE(stand.detailed);
  EXPECT_EQ(stand.damping.minCoeff(), 0.013);
  EXPECT_EQ(stand.damping.maxCoeff(), 0.013);
  for (const char *key : {"K1", "K2", "K3", "K5", "K6", "K7"})
    EXPECT_TRUE(twin::is_spring(stand, key)) << key;
  Eigen::VectorXd theta(1);
  theta << std::log(1.1);
  const auto at                  = twin::stand_at(stand, {{"K6", 0.1}}, theta);
  const Eigen::VectorXd expected = whole_frequencies(with_factor(beams(), 5, 1.1));
  for (Eigen::Index i = 0; i < 6; ++i)
    EXPECT_TRUE(near(at.frequency[i] / (2 * M_PI), expected[i], within(1e-4, "shapes change within 64 modes")));
}
