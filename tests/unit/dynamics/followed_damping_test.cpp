// Interval of the critical speed where damping is not one ratio of all modes: loss factors, dampers of oil films.
#include "dynamics/chatter/excess_growth.h"
#include "dynamics/chatter/speed_interval.h"
#include "tests/support/film_pass.h"
#include "tests/support/near.h"
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <random>

using namespace mill;
using namespace mill::dynamics;

namespace {
using Six = std::array<double, 6>;
constexpr Six mass{119e3, 75e3, 9.2e3, 9.2e3, 75e3, 36.5e3};
constexpr Six stiffness{6.9e10, 3.0e10, 6.06e10, 6.06e10, 4.4e10, 10.1e10};

/// Six masses whose springs have a loss factor each, whose modes have a ratio, and that stand on dampers.
struct DampedStand {
  Six loss_factor{};
  double ratio = 0;
  Six dampers{};

  Eigen::MatrixXd spring(const std::size_t i, const Six &springs) const
  {
    Six only{};
    only[i] = springs[i];
    return six_mass_structure(mass, only, {}).K;
  }
  Eigen::MatrixXd loss(const Six &springs) const
  {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(6, 6);
    for (std::size_t i = 0; i < 6; ++i)
      sum += loss_factor[i] * spring(i, springs);
    return sum;
  }
  /// Built from its springs, in the motions of the masses.
  StandStructure built(const Six &springs, const double on_damping) const
  {
    StandStructure s = six_mass_structure(mass, springs, dampers);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(s.K, s.M);
    const Eigen::MatrixXd MV = s.M * modes.eigenvectors(), L = loss(springs);
    for (Eigen::Index k = 0; k < 6; ++k) {
      const double w          = std::sqrt(modes.eigenvalues()[k]);
      const Eigen::VectorXd v = modes.eigenvectors().col(k);
      s.C += on_damping * (2 * ratio * w + v.dot(L * v) / w) * MV.col(k) * MV.col(k).transpose();
    }
    return s;
  }
  SpeedQuestion question() const
  {
    StandStructure s = built(stiffness, 1);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(s.K, s.M);
    const Eigen::MatrixXd V = modes.eigenvectors();
    SpeedQuestion q;
    s.M             = Eigen::MatrixXd::Identity(6, 6);
    s.K             = modes.eigenvalues().asDiagonal();
    s.C             = V.transpose() * s.C * V;
    s.b             = V.transpose() * s.b;
    s.point         = s.point * V;
    q.stand         = {s, 4.95, 4.95, 210e9};
    q.modal_damping = ratio;
    q.bite          = film_pass();
    q.range         = {1, 60};
    if (loss_factor != Six{})
      q.loss = V.transpose() * loss(stiffness) * V;
    return q;
  }
  /// Every spring, then the damping of the modes.
  std::vector<UncertainNumber> numbers() const
  {
    const StandStructure s = six_mass_structure(mass, stiffness, {});
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(s.K, s.M);
    const Eigen::MatrixXd V = modes.eigenvectors();
    std::vector<UncertainNumber> all;
    for (std::size_t i = 0; i < 6; ++i) {
      UncertainNumber one{"k" + std::to_string(i), 0.1};
      one.structure.dK = V.transpose() * spring(i, stiffness) * V;
      if (loss_factor != Six{})
        one.structure.dL = loss_factor[i] * one.structure.dK;
      all.push_back(one);
    }
    UncertainNumber damping{"damping", 0.3};
    damping.damping = true;
    all.push_back(damping);
    return all;
  }
  /// The program at numbers times exp(s error).
  double speed_at(const Eigen::VectorXd &s) const
  {
    Six springs = stiffness;
    for (std::size_t i = 0; i < 6; ++i)
      springs[i] *= std::exp(0.1 * s[Eigen::Index(i)]);
    const SpeedQuestion q = question();
    return critical_speed({built(springs, std::exp(0.3 * s[6])), 4.95, 4.95, 210e9}, q.bite, q.scheme, q.range)
        .speed;
  }
};

double searched(const SpeedQuestion &q)
{
  return critical_speed(q.stand, q.bite, q.scheme, q.range).speed;
}

const DampedStand stands[]{{{0.02, 0.05, 0.01, 0.03, 0.08, 0}, 0, {}},
                           {{}, 0.01, {4e5, 0, 0, 0, 0, 3e5}},
                           {{0.02, 0.05, 0.01, 0.03, 0.08, 0}, 0.004, {4e5, 0, 0, 0, 0, 3e5}}};
}  // namespace

TEST(FollowedDamping, StandWithEveryNumberAtItsValueHasTheSearchedSpeed)
{
  for (const DampedStand &stand : stands) {
    const SpeedQuestion q    = stand.question();
    const SpeedQuestion same = moved(q, stand.numbers(), Eigen::VectorXd::Zero(7));
    ASSERT_FALSE(std::isnan(searched(q)));
    EXPECT_TRUE(near(searched(same), searched(q), within(1e-9, "the same stand, root to 1e-10 m/s")));
    EXPECT_LT((same.stand.structure.C - q.stand.structure.C).norm(), 1e-10 * q.stand.structure.C.norm());
  }
}

TEST(FollowedDamping, AMovedStandIsTheOneThatIsBuiltOfTheMovedNumbers)
{
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  for (const DampedStand &stand : stands)
    for (int draw = 0; draw < 3; ++draw) {
      const Eigen::VectorXd s = Eigen::VectorXd::NullaryExpr(7, [&](auto) { return normal(random); });
      EXPECT_TRUE(near(searched(moved(stand.question(), stand.numbers(), s)), stand.speed_at(s),
                       within(1e-8, "the same stand in other unknowns")));
    }
}

TEST(FollowedDamping, SlopesAreThoseOfBuiltStandsAndTheIntervalHoldsTheSpeed)
{
  for (const DampedStand &stand : stands) {
    const SpeedQuestion q = stand.question();
    const auto critical   = critical_speed(q.stand, q.bite, q.scheme, q.range);
    const auto numbers    = stand.numbers();
    const auto interval   = speed_interval(q, critical, numbers);
    EXPECT_LT(interval.low, critical.speed);
    EXPECT_GT(interval.high, critical.speed);
    for (const SpeedShare &share : interval.shares) {
      const auto i          = std::find_if(numbers.begin(), numbers.end(),
                                           [&](const UncertainNumber &n) { return n.name == share.name; });
      const auto speed_with = [&](const double change) {
        Eigen::VectorXd s      = Eigen::VectorXd::Zero(7);
        s[i - numbers.begin()] = change / share.error;
        return std::log(stand.speed_at(s));
      };
      constexpr double step = 1e-3;
      const double d1       = (speed_with(step) - speed_with(-step)) / (2 * step),
                   d2       = (speed_with(2 * step) - speed_with(-2 * step)) / (4 * step);
      EXPECT_TRUE(
          near(share.slope, (4 * d1 - d2) / 3, within(1e-5, "difference of fourth order, root to 1e-10", 1e-2)))
          << share.name;
    }
  }
}

// A mode without damping that the bite does not reach stands on the axis: it neither grows nor hides the crossing.
TEST(FollowedDamping, AModeOnTheAxisDoesNotDecideTheCrossing)
{
  SpeedQuestion q      = stands[1].question();
  const double without = searched(q);
  StandStructure &s    = q.stand.structure;
  for (Eigen::MatrixXd *matrix : {&s.M, &s.C, &s.K}) {
    matrix->conservativeResizeLike(Eigen::MatrixXd::Zero(7, 7));
  }
  s.M(6, 6) = 1;
  s.K(6, 6) = std::pow(2 * M_PI * 300, 2);
  s.b.conservativeResizeLike(Eigen::VectorXd::Zero(7));
  s.point.conservativeResizeLike(Eigen::MatrixXd::Zero(s.point.rows(), 7));
  for (const double start : {0.8, 1.2})
    EXPECT_TRUE(near(crossing_near(q, start * without), without, within(1e-6, "root to 1e-7")));
  const std::complex<double> i(0, 1);
  EXPECT_LT(excess_growth(Eigen::VectorXcd{{1000. * i + 1e-9, -2. + 300. * i}}), 0);
  EXPECT_GT(excess_growth(Eigen::VectorXcd{{1000. * i + 1e-3, -2. + 300. * i}}), 0);
}
