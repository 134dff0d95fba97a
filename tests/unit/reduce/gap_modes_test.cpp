// The share of a mode in the compliance of the gap, and the names that follow from it.
#include "reduce/stand/gap_modes.h"
#include "reduce/stand/six_masses.h"
#include "reduce/stand/stand_errors.h"
#include "reduce/stand/stand_modes.h"
#include "tests/support/beam_demo.h"
#include "tests/support/near.h"
#include <Eigen/Dense>
#include <cmath>

using namespace mill;
using namespace mill::reduce;

namespace {
StandModel six_masses_with(const double K4)
{
  return chain_stand(demo_chain(demo_drawing(), K4).model);
}

Eigen::VectorXd shares_of(const StandModel &stand)
{
  const StandModes modes = stand_modes(stand);
  return gap_shares(modes.frequency, modes.shape, stand.b);
}

GapMotion motion(const double frequency, const double share, const double work, const double backup,
                 const std::string &part = "upper frame")
{
  return {frequency, share, {{"upper", 0.6, work, backup}, {"lower", 0.2, 1, 1}}, {{part, part, "part", 0.9}}};
}
}  // namespace

// Two masses on springs k1 = 1, k2 = 3 N/m, the gap between them: the compliance is 1/k1 + 1/k2.
TEST(GapShares, OfTwoMassesAreTheirCompliances)
{
  const Eigen::Vector2d frequency = Eigen::Vector2d(1, std::sqrt(3.)) / (2 * M_PI), row(1, -1);
  const Eigen::VectorXd share     = gap_shares(frequency, Eigen::Matrix2d::Identity(), row);
  EXPECT_TRUE(near(share[0], 0.75, within(1e-14, "1/k1 of 1/k1 + 1/k2")));
  EXPECT_TRUE(near(share[1], 0.25, within(1e-14, "1/k2 of 1/k1 + 1/k2")));
}

TEST(GapShares, SumToOneInEveryModelAndAreThoseOfTheStaticCompliance)
{
  for (const StandModel &stand : {six_masses_with(0), six_masses_with(1e9), demo_beams(demo_drawing())}) {
    const StandModes modes      = stand_modes(stand);
    const Eigen::VectorXd share = gap_shares(modes.frequency, modes.shape, stand.b);
    EXPECT_TRUE(near(share.sum(), 1, within(1e-12, "definition")));
    EXPECT_GE(share.minCoeff(), 0);
    const double compliance   = stand.b.dot(static_displacement(stand));
    const Eigen::VectorXd few = gap_shares(modes.frequency.head(3), modes.shape.leftCols(3), stand.b, compliance);
    EXPECT_TRUE(near(few, share.head(3), within(1e-6, "modes and statics of one stand", 1)));
  }
}

TEST(GapShares, DoNotDependOnSignScaleOrOrder)
{
  const StandModel stand      = six_masses_with(1e9);
  const StandModes modes      = stand_modes(stand);
  const Eigen::VectorXd share = gap_shares(modes.frequency, modes.shape, stand.b);
  Eigen::MatrixXd other       = -2.5 * modes.shape;
  other.col(2) *= -1;
  EXPECT_TRUE(near(gap_shares(modes.frequency, other, stand.b), share, within(1e-13, "rounding", 1)));
  EXPECT_TRUE(near(gap_shares(modes.frequency, modes.shape, -7 * stand.b), share, within(1e-13, "rounding", 1)));
  EXPECT_TRUE(near(gap_shares(modes.frequency.reverse(), modes.shape.rowwise().reverse(), stand.b).reverse(),
                   share, within(1e-13, "rounding", 1)));
}

// The lower half stands still: the upper half has the modes, and the whole compliance.
TEST(GapShares, OfAFrozenHalfAreZero)
{
  StandModel stand = six_masses_with(0);
  StandModes half;
  {
    StandModel upper        = stand;
    upper.M                 = stand.M.topLeftCorner(3, 3);
    const Eigen::MatrixXd K = stiffness_of(stand).topLeftCorner(3, 3);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K, upper.M);
    half.frequency = solver.eigenvalues().cwiseSqrt() / (2 * M_PI);
    half.shape     = solver.eigenvectors();
  }
  Eigen::MatrixXd K = stiffness_of(stand);
  for (int i = 3; i < 6; ++i)
    K(i, i) += 1e10 * K(i, i);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(K, stand.M);
  const Eigen::VectorXd frequency = solver.eigenvalues().cwiseSqrt() / (2 * M_PI);
  const Eigen::VectorXd share     = gap_shares(frequency, solver.eigenvectors(), stand.b);
  EXPECT_TRUE(
      near(frequency.head(3), half.frequency, within(1e-5, "1e10 times stiffer, rounding of such a matrix")));
  EXPECT_TRUE(near(share.head(3), gap_shares(half.frequency, half.shape, stand.b.head(3)),
                   within(1e-5, "1e10 times stiffer, rounding of such a matrix", 1)));
  EXPECT_LT(share.tail(3).maxCoeff(), 1e-9);
}

TEST(GapShares, TendToThoseOfTheOpenStandWhereTheStripGivesWay)
{
  const StandModel open = six_masses_with(0), soft = six_masses_with(1);  // of some 1e10 N/m
  EXPECT_TRUE(near(stand_modes(soft).frequency, stand_modes(open).frequency, within(1e-9, "K4 -> 0")));
  EXPECT_TRUE(near(shares_of(soft), shares_of(open), within(1e-8, "K4 -> 0", 1)));
}

// A stack that floats has its compliance in the free motion; one that floats as a whole has nothing of it.
TEST(GapShares, OfAMotionThatNoSpringHolds)
{
  const Eigen::Vector2d frequency(0, 10);
  const double r = std::sqrt(0.5);
  Eigen::Matrix2d shape;
  shape << r, r, r, -r;
  EXPECT_TRUE(near(gap_shares(frequency, shape, Eigen::Vector2d(1, 0)), Eigen::Vector2d(1, 0),
                   within(1e-14, "the free motion opens the gap")));
  EXPECT_TRUE(near(gap_shares(frequency, shape, Eigen::Vector2d(1, -1)), Eigen::Vector2d(0, 1),
                   within(1e-14, "the free motion leaves the gap")));
  EXPECT_TRUE(gap_shares(Eigen::Vector2d::Zero(), shape, Eigen::Vector2d::Zero()).isZero(0));
}

// The slope of every share by every spring and mass, against the chain with that number moved.
TEST(GapShares, ErrorsFollowTheMovedChain)
{
  const LumpedModel chain = demo_chain(demo_drawing(), 3e9).model;
  StandWithModes stand{chain_stand(chain), {}};
  stand.modes                = stand_modes(stand.model);
  constexpr double step      = 1e-5;
  const auto log_shares_with = [&](const std::string &name, const double factor) {
    LumpedModel moved = chain;
    (name[0] == 'K' ? moved.K[std::size_t(name[1] - '1')] : moved.M[std::size_t(name[1] - '1')]).value *= factor;
    return Eigen::VectorXd(shares_of(chain_stand(moved)).array().log());
  };
  auto inputs = modal_sensitivities(stand, chain);
  EXPECT_EQ(inputs.size(), 13u) << "K1..K7 and M1..M6";
  for (ModalSensitivity &input : inputs) {
    input.error                 = 1;
    const FrequencyErrors slope = gap_share_errors(stand, {input});
    const Eigen::VectorXd moved =
        (log_shares_with(input.name, 1 + step) - log_shares_with(input.name, 1 - step)).cwiseAbs() / (2 * step);
    EXPECT_TRUE(near(slope.error, moved, within(1e-5, "central differences of second order", 1))) << input.name;
  }
}

TEST(GapShares, AnInputWithoutErrorLeavesThemWithoutOne)
{
  const LumpedModel chain = demo_chain(demo_drawing(), 3e9).model;
  StandWithModes stand{chain_stand(chain), {}};
  stand.modes = stand_modes(stand.model);
  auto inputs = modal_sensitivities(stand, chain);
  for (ModalSensitivity &input : inputs)
    input.error = input.name == "K3" ? std::nan("") : 0.01, input.lacks = {"given.K3_tolerance"};
  const FrequencyErrors errors = gap_share_errors(stand, inputs);
  EXPECT_TRUE(std::isnan(errors.error[0]));
  EXPECT_EQ(errors.lacks[0], Keys{"given.K3_tolerance"});
}

TEST(GapModeNames, FollowTheStackThatMovesMore)
{
  EXPECT_EQ(gap_kind(motion(100, 0.1, 1, 0.4)), GapKind::first);
  EXPECT_EQ(gap_kind(motion(100, 0.1, -1, -0.4)), GapKind::first);
  EXPECT_EQ(gap_kind(motion(100, 0.1, 1, -0.4)), GapKind::second);
  EXPECT_EQ(gap_kind(motion(100, 0.0099, 1, 0.4)), GapKind::none);
  GapMotion lower         = motion(100, 0.1, 1, -0.4);
  lower.stacks[1].kinetic = 0.7;  // there the rolls move together
  EXPECT_EQ(gap_kind(lower), GapKind::first);
  lower.stacks.clear();
  EXPECT_EQ(gap_kind(lower), GapKind::none) << "a stack that is not known";
}

TEST(GapModeNames, TheLargestShareIsTheGapModeAndTheOctaveIsAnAddition)
{
  const std::vector<GapMotion> modes{motion(70, 0.2, 1, 1), motion(150, 0.3, 1, 1, "lower frame"),
                                     motion(290, 0.05, 1, 1), motion(500, 0.1, 1, -1), motion(910, 0.2, 1, -1)};
  EXPECT_EQ(gap_mode(modes), 1);
  EXPECT_EQ(gap_mode(modes, GapKind::second), 4);
  const auto names = gap_mode_names(modes);
  EXPECT_EQ(names[0].name, "gap mode, first kind, upper frame");
  EXPECT_EQ(names[1].name, "gap mode, first kind (third octave)");
  EXPECT_EQ(names[1].key, "gap_first_kind");
  EXPECT_EQ(names[1].decided,
            "work roll with its backup roll in the upper stack (60 % of the kinetic energy); 30 % of "
            "the static compliance of the gap");
  EXPECT_EQ(names[2].name, "gap mode, first kind, upper frame, order 2");
  EXPECT_EQ(names[3].name, "gap mode, second kind, upper frame (fifth octave)");
  EXPECT_EQ(names[4].name, "gap mode, second kind");
}

TEST(GapModeNames, EndAtTheThirdOrderWhereTheGapSeesNothing)
{
  std::vector<GapMotion> modes;
  for (int k = 0; k < 5; ++k)
    modes.push_back(motion(100 + 10 * k, 0.001, 1, 1, "lower frame"));
  const auto names = gap_mode_names(modes);
  EXPECT_EQ(names[2].name, "lower frame, order 3");
  for (const std::size_t k : {3, 4}) {
    EXPECT_EQ(names[k].name, "lower frame, higher");
    EXPECT_EQ(names[k].key, "");
    EXPECT_EQ(names[k].decided,
              "lower frame 90 % of the kinetic energy; 0.1 % of the static compliance of the gap");
  }
  EXPECT_EQ(gap_mode(modes), -1);
}

TEST(GapModeNames, NameTheSecondPartOfAGapModeBeyondTheThirdOrder)
{
  std::vector<GapMotion> modes{motion(50, 0.3, 1, 1)};
  for (int k = 1; k < 6; ++k) {
    modes.push_back(motion(50 + 10 * k, 0.05, 1, 1, "housing"));
    modes.back().parts.push_back({"cylinder", "cylinder", "cylinder", 0.1});
  }
  const auto names = gap_mode_names(modes);
  EXPECT_EQ(names[3].name, "gap mode, first kind, housing, order 3");
  EXPECT_EQ(names[4].name, "gap mode, first kind, housing and cylinder");
  EXPECT_EQ(names[4].key, "gap_first_kind_part_cylinder");
  EXPECT_EQ(names[5].name, "gap mode, first kind, housing and cylinder, order 2");
}

// A name that came from another model is kept, and no other mode bears it.
TEST(GapModeNames, KeepThoseThatAreGiven)
{
  const std::vector<GapMotion> modes{motion(70, 0.1, 1, 1), motion(150, 0.3, 1, 1)};
  std::vector<ModeName> given(2);
  given[0].name = "gap mode, first kind", given[0].key = "gap_first_kind";
  const auto names = gap_mode_names(modes, given);
  EXPECT_EQ(names[0].key, "gap_first_kind");
  EXPECT_EQ(names[1].name, "gap mode, first kind, upper frame (third octave)");
}
