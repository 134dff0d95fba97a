// A stand of bodies and connections in the modes of its case against the eigenvalues of its whole matrices.
#include "tests/support/near.h"
#include "twin/calibration/fitted_stand.h"
#include "twin/calibration/plan.h"
#include "twin/calibration/words.h"
#include <Eigen/Eigenvalues>
#include <cmath>

using namespace mill;
using namespace mill::twin;

namespace {
constexpr int nodes = 40;  // of each of two bars

/// Two bars that bend on a row of springs between them; the upper one hangs at both ends, the lower one stands on
/// one.
StandModel two_bars()
{
  StandModel s;
  s.name    = "bars";
  s.parts   = {"upper bar", "lower bar"};
  s.M       = Eigen::MatrixXd::Identity(2 * nodes, 2 * nodes) * 300;
  s.K_parts = Eigen::MatrixXd::Zero(2 * nodes, 2 * nodes);
  for (int bar = 0; bar < 2; ++bar)
    for (int i = 0; i < nodes; ++i) {
      s.part_of.push_back(bar);
      s.unknowns.emplace_back();
      if (i == 0 || i + 1 == nodes)
        continue;
      Eigen::VectorXd bent = Eigen::VectorXd::Zero(2 * nodes);
      bent.segment<3>(bar * nodes + i - 1) << 1, -2, 1;
      s.K_parts += 2e11 * bent * bent.transpose();
    }
  const auto unit = [](const int i) { return Eigen::VectorXd(Eigen::VectorXd::Unit(2 * nodes, i)); };
  Connection hung{"K1", Eigen::MatrixXd::Zero(2, 2 * nodes), Eigen::Vector2d(4e9, 4e9)},
      bed{"K3", Eigen::MatrixXd::Zero(nodes, 2 * nodes), Eigen::VectorXd::Constant(nodes, 1e9)},
      foot{"K7", unit(2 * nodes - 1).transpose(), Eigen::VectorXd::Constant(1, 2e9)};
  hung.rows(0, 0) = hung.rows(1, nodes - 1) = 1;
  for (int i = 0; i < nodes; ++i) {
    bed.rows(i, i)         = 1;
    bed.rows(i, nodes + i) = -1;
  }
  Connection held{"K6", unit(nodes).transpose(), Eigen::VectorXd::Constant(1, 5e9)};
  s.connections = {hung, bed, held, foot};
  s.b           = unit(nodes / 2) - unit(nodes + nodes / 3);
  for (const int i : {0, nodes / 2, nodes, nodes + nodes / 3})
    s.points.push_back({"place " + std::to_string(i), unit(i)});
  s.load_cell = Eigen::VectorXd::Zero(2 * nodes);
  return s;
}

struct Whole {
  Eigen::VectorXd frequency;  // Hz
  Eigen::MatrixXd shape;
};

Whole whole_modes(StandModel s, const std::vector<Unknown> &unknowns = {}, const Eigen::VectorXd &theta = {})
{
  for (std::size_t p = 0; p < unknowns.size(); ++p)
    for (Connection &c : s.connections)
      if (c.name == unknowns[p].name)
        c.stiffness *= std::exp(theta[Eigen::Index(p)]);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(stiffness_of(s), s.M);
  return {solver.eigenvalues().cwiseSqrt() / (2 * M_PI), solver.eigenvectors()};
}

FittedStand fitted_bars()
{
  const StandModel bars = two_bars();
  const Whole whole     = whole_modes(bars);
  FittedStand stand;
  stand.detailed = reduced_stand(bars, whole.frequency, whole.shape, 1000);
  stand.damping  = Eigen::VectorXd::Constant(stand.detailed->kept, 0.01);
  return stand;
}

const std::vector<Unknown> moved{{"K1", 0.1}, {"K3", 0.1}, {"K6", 0.1}, {"K7", 0.1}};
}  // namespace

TEST(ReducedStand, FollowsItsConnectionsAsTheWholeMatricesDo)
{
  const FittedStand stand = fitted_bars();
  ASSERT_GT(stand.detailed->kept, 6);
  ASSERT_LT(stand.detailed->frequency.size(), 2 * nodes) << "fewer modes than unknowns, else nothing is left out";
  const Eigen::Vector4d theta(0.2, -0.25, 0.15, -0.2);
  const StandAt reduced = stand_at(stand, moved, theta);
  const Whole whole     = whole_modes(two_bars(), moved, theta);
  const auto bars       = two_bars();
  for (Eigen::Index i = 0; i < stand.detailed->kept; ++i) {
    EXPECT_TRUE(near(reduced.frequency[i] / (2 * M_PI), whole.frequency[i],
                     within(1e-5, "64 of 80 modes of the case carry the change of shape")));
    const double sign = reduced.force[i] * bars.b.dot(whole.shape.col(i)) < 0 ? -1 : 1;
    for (std::size_t p = 0; p < bars.points.size(); ++p)
      EXPECT_TRUE(near(reduced.shape(Eigen::Index(p), i), sign * bars.points[p].row.dot(whole.shape.col(i)),
                       within_absolute(2e-5, "64 of 80 modes of the case carry the change of shape")))
          << "mode " << i + 1 << " at " << bars.points[p].name;
  }
}

TEST(ReducedStand, SlopesAreThoseOfDifferences)
{
  const FittedStand stand = fitted_bars();
  const Eigen::Vector4d theta(0.1, -0.1, 0.05, 0.2);
  const StandAt reduced = stand_at(stand, moved, theta);
  const double step     = 1e-4;
  for (Eigen::Index p = 0; p < 4; ++p) {
    const Eigen::Vector4d aside = step * Eigen::Vector4d::Unit(p);
    const StandAt up = stand_at(stand, moved, theta + aside), down = stand_at(stand, moved, theta - aside);
    for (Eigen::Index i = 0; i < stand.detailed->kept; ++i)  // dw^2/dtheta = v' K_p v
      EXPECT_TRUE(near(reduced.stiffness[std::size_t(p)](i, i),
                       (std::pow(up.frequency[i], 2) - std::pow(down.frequency[i], 2)) / (2 * step),
                       within_absolute(1e-6 * std::pow(reduced.frequency[i], 2),
                                       "difference quotient of the squared frequency, relative to it")))
          << "mode " << i + 1;
  }
}

TEST(ReducedStand, PlansConnectionsAndTheDampingOfEachMode)
{
  const FittedStand stand = fitted_bars();
  EXPECT_EQ(number_of_places(stand), 4);
  EXPECT_TRUE(share_a_part(stand, "K1", "K3"));
  EXPECT_FALSE(share_a_part(stand, "K1", "K7"));
  PlannedRecord record;
  record.places        = {1, 3};
  record.force_density = 20;
  record.force_highest = 900;
  record.duration      = 5;
  const std::vector<Unknown> common{{"K3", 0.1}, {"zeta", 0.7}};
  std::vector<Unknown> each{common[0]};
  for (Eigen::Index i = 0; i < stand.detailed->kept; ++i)
    each.push_back({"zeta" + std::to_string(i + 1), 0.7});
  const Identification one = planned(stand, common, record), all = planned(stand, each, record);
  // All together are the common one: its information is the sum of theirs.
  double sum = 0;
  for (std::size_t i = 1; i < each.size(); ++i)
    sum += 1 / std::pow(all.shrink[Eigen::Index(i)] * 0.7, 2) - 1 / (0.7 * 0.7);
  EXPECT_TRUE(near(1 / std::pow(one.shrink[1] * 0.7, 2) - 1 / (0.7 * 0.7), sum,
                   within(0.2, "modes that overlap share some of it")));
}
