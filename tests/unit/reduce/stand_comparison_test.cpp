// Two models of one stand compared, and how few masses are enough.
#include "reduce/stand/masses_needed.h"
#include "reduce/stand/six_masses.h"
#include "reduce/stand/stand_comparison.h"
#include "tests/support/beam_demo.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <Eigen/Dense>

using namespace mill;
using namespace mill::reduce;

namespace {
StandWithModes chain()
{
  const StandModel model = chain_stand(demo_chain(demo_drawing()).model);
  return {model, stand_modes(model)};
}

StandWithModes beams(const double limit = 1500)
{
  const StandModel model = demo_beams(demo_drawing());
  return {model, stand_modes(model, limit)};
}
}  // namespace

TEST(StandComparison, ShapesOfTheChain)
{
  const StandWithModes stand = beams();
  const Eigen::MatrixXd T    = chain_shapes(stand.model);
  EXPECT_TRUE((point_rows(stand.model, 6) * T).isIdentity(1e-9)) << "one place by 1, the others held";
  // Any other motion with the same six displacements costs more: K T is a force on the six points only.
  const Eigen::MatrixXd force = stiffness_of(stand.model) * T;
  const Eigen::MatrixXd P     = point_rows(stand.model, 6);
  EXPECT_LT((force - P.transpose() * (P * force)).norm(), 1e-6 * force.norm());
}

TEST(StandComparison, AChainIsAllOfItself)
{
  const StandWithModes six = chain();
  EXPECT_TRUE(in_chain(six).isConstant(1, 1e-9));
  EXPECT_TRUE(mac_with_chain(six, six).isIdentity(1e-9));
  const ChainVerdict verdict = chain_verdict(six, six, 600, "the chain itself");
  EXPECT_TRUE(verdict.missing.empty());
  ASSERT_EQ(verdict.sentences.size(), 1u);
  EXPECT_EQ(verdict.sentences[0],
            "Six masses are right to 0 % for 5 of the 5 modes of the chain itself below 600 Hz: "
            "38.92, 53.93, 218.3, 456.7 and 598.7 Hz.");
  EXPECT_EQ(chain_verdict(six, six, 10, "the chain itself").sentences[0],
            "the chain itself has no mode below 10 Hz.");
}

TEST(StandComparison, BeamStandIsAllOfItselfAtItsNodes)
{
  const StandWithModes stand = beams();
  EXPECT_TRUE(mac_between(stand, stand).isIdentity(1e-9));
  const StandWithModes coarse = stand;
  const StandModel fine       = demo_beams(demo_drawing(), 16);
  const Eigen::MatrixXd mac   = mac_between({fine, stand_modes(fine, 1500)}, coarse);
  for (Eigen::Index k = 0; k < 12; ++k)
    EXPECT_GT(mac(k, k), 0.999) << k;
  StandWithModes blind = stand;
  blind.model.lines.clear();
  EXPECT_EQ(refusal([&] { mac_between(blind, stand); }),
            "stand model \"beam\" has no \"upper backup roll\" to compare with");
}

TEST(StandComparison, ShareInTheChainIsBetweenTheBestAssuranceAndOne)
{
  const StandWithModes stand = beams(), six = chain();
  const Eigen::VectorXd share = in_chain(stand);
  const Eigen::MatrixXd mac   = mac_with_chain(stand, six);
  for (Eigen::Index k = 0; k < share.size(); ++k) {
    EXPECT_GE(share[k], mac.row(k).maxCoeff() - 1e-12);
    EXPECT_LE(share[k], 1 + 1e-12);
  }
}

TEST(StandComparison, PairsTakeTheBestFirstAndNoRowTwice)
{
  Eigen::MatrixXd mac(3, 3);
  mac << 0.9, 0.95, 0.1,  //
      0.6, 0.7, 0.0,      //
      0.0, 0.0, 0.4;
  const auto pairs = pair_modes(mac, Eigen::Vector3d(10, 14, 30), Eigen::Vector3d(11, 12, 33));
  EXPECT_EQ(pairs[1].other, 0);
  EXPECT_TRUE(near(pairs[1].difference, 0.2, within(1e-14, "one division of two short numbers")));
  EXPECT_EQ(pairs[0].other, 1);
  EXPECT_EQ(pairs[0].mac, 0.6);
  EXPECT_EQ(pairs[2].other, -1);
  EXPECT_EQ(pair_modes(mac, Eigen::Vector3d(10, 14, 30), Eigen::Vector3d(11, 12, 33), 0.3)[2].other, 2);
  EXPECT_EQ(pair_modes(mac, Eigen::Vector3d(10, 20, 30), Eigen::Vector3d(11, 12, 33))[0].other, -1)
      << "20 Hz is not a counterpart of 11 Hz, even with equal shapes";
}

TEST(StandComparison, SentencesOfTheDemoStand)
{
  const ChainVerdict verdict = chain_verdict(beams(), chain(), 300, "the beam model");
  ASSERT_EQ(verdict.sentences.size(), 3u);
  EXPECT_EQ(verdict.sentences[0],
            "Six masses are right to 3 % for 2 of the 6 modes of the beam model below 300 Hz: 37.8 and 52.47 Hz.");
  EXPECT_EQ(verdict.sentences[1], "They are wrong for 176.1 Hz (six masses: 218.3 Hz, +24 %).");
  EXPECT_EQ(verdict.sentences[2].substr(0, 21), "They cannot show 177.");
  EXPECT_EQ(verdict.missing.size(), 3u);
}

TEST(MassesNeeded, AChainNeedsItsMasses)
{
  const StandWithModes six = chain();
  const auto rows          = masses_needed(six, 1000, 16, &six);
  ASSERT_EQ(rows.size(), 7u);  // 1..5, the chain, the six places; there are no other points
  for (std::size_t i = 5; i < 7; ++i) {
    EXPECT_EQ(rows[i].masses, 6);
    EXPECT_EQ(rows[i].right, 6);
    EXPECT_LT(rows[i].worst_error, 1e-9);
    EXPECT_TRUE(rows[i].missing.empty());
  }
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_FALSE(rows[i].missing.empty()) << "a mass less is a mode less";
  EXPECT_EQ(masses_enough(rows, 0.05), 6);
  EXPECT_EQ(masses_enough({rows[0]}, 0.05), 0);
}

TEST(MassesNeeded, MoreAreBetterOnTheBeamStand)
{
  const StandWithModes stand = beams();
  const auto rows            = masses_needed(stand, 600, 14);
  ASSERT_EQ(rows.size(), 14u);
  const std::size_t n = stand.model.points.size();
  ASSERT_GT(n, 6u);
  EXPECT_EQ(rows[0].at.size(), 1u);
  EXPECT_EQ(rows[5].added, "the six places");
  EXPECT_EQ(rows[5].at[0], "upper frame");
  EXPECT_EQ(rows[13].at.size(), 14u);
  EXPECT_LT(rows[13].missing.size(), rows[5].missing.size());
  EXPECT_GT(rows[13].right, rows[5].right);
  for (const MassesRow &row : rows)
    EXPECT_EQ(row.modes_below_limit, 9);
}
