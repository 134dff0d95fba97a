// The stand as the bite feels it, the coupled matrix, and its modes.
#include "core/base/errors.h"
#include "dynamics/chatter/chatter.h"
#include "dynamics/chatter/loop.h"
#include "dynamics/chatter/modes.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <Eigen/Eigenvalues>
#include <cmath>

using namespace mill;
using namespace mill::dynamics;

namespace {
const std::array<double, 6> masses{119e3, 75e3, 9.2e3, 9.5e3, 70e3, 36.5e3};
const std::array<double, 6> springs{6.9e10, 3.0e10, 6.06e10, 5.9e10, 4.4e10, 10.1e10};
const std::array<double, 6> dampers{6e5, 4.25e5, 6.05e5, 5e5, 4e5, 5.5e5};

ChatterStandModel stand()
{
  return {six_mass_structure(masses, springs, dampers), 4.9, 5.3, 210e9};
}

// Any derivatives: nothing here depends on a bite being possible.
bite::LinearCoefficients coefficients()
{
  bite::LinearCoefficients by{};
  by.entry_speed = {2.1e4, 11, -2.6e-9, 2.5e-9, 0};
  by.exit_speed  = {-3.7e3, -2.8, -3.5e-9, 3.4e-9, 0};
  by.force       = {-3.1e10, -1.4e7, -1.0e-2, -4.6e-3, 0};
  by.friction    = {-83, 0, -6.5e-15, 0, 0};
  return by;
}

// Right-hand side of the equations of motion as one reads them in a textbook, term by term.
Eigen::VectorXd motion(const Eigen::VectorXd &z)
{
  const auto &m = masses, &k = springs, &c = dampers;
  const double *x = z.data(), *v = z.data() + 6, se = z[12], sd = z[13];
  const auto by  = coefficients();
  const auto sum = [&](const bite::StripRow &r) {
    return r[0] * (x[2] + x[3]) + r[1] * (v[2] + v[3]) + r[2] * se + r[3] * sd;
  };
  const double dF = sum(by.force);
  Eigen::VectorXd d(14);
  d.head(6) = z.segment(6, 6);
  d[6]      = (-c[0] * (v[0] - v[1]) - c[1] * (v[0] - v[2]) - (k[0] + k[1]) * x[0] + k[1] * x[1]) / m[0];
  d[7]  = (-c[0] * (v[1] - v[0]) - c[2] * (v[1] - v[2]) - (k[1] + k[2]) * x[1] + k[1] * x[0] + k[2] * x[2]) / m[1];
  d[8]  = (-c[1] * (v[2] - v[0]) - c[2] * (v[2] - v[1]) - k[2] * (x[2] - x[1]) + dF) / m[2];
  d[9]  = (-c[3] * (v[3] - v[4]) - c[4] * (v[3] - v[5]) - k[3] * (x[3] - x[4]) + dF) / m[3];
  d[10] = (-c[3] * (v[4] - v[3]) - c[5] * (v[4] - v[5]) - (k[3] + k[4]) * x[4] + k[3] * x[3] + k[4] * x[5]) / m[4];
  d[11] = (-c[4] * (v[5] - v[3]) - c[5] * (v[5] - v[4]) - (k[4] + k[5]) * x[5] + k[4] * x[4]) / m[5];
  d[12] = 210e9 / 4.9 * sum(by.entry_speed);
  d[13] = -210e9 / 5.3 * sum(by.exit_speed);
  return d;
}

// The same six masses with all displacements upwards, as the vertical chain has them.
MillModel chain()
{
  const StandStructure six = six_mass_structure(masses, springs, dampers);
  Eigen::VectorXd up(6);
  up << 1, 1, 1, -1, -1, -1;
  MillModel model;
  model.labels = six.labels;
  model.M      = six.M.diagonal();
  model.K      = up.asDiagonal() * six.K * up.asDiagonal();
  model.C      = up.asDiagonal() * six.C * up.asDiagonal();
  model.b      = up.asDiagonal() * six.b;
  return model;
}
}  // namespace

TEST(ChatterMatrix, AgreesWithTheEquationsOfMotionWrittenOut)
{
  const Eigen::MatrixXd A = chatter_matrix(stand(), coefficients());
  ASSERT_EQ(A.rows(), 14);
  for (int i = 0; i < 14; ++i) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(14, i), expected = motion(unit);
    const double scale = expected.cwiseAbs().maxCoeff();
    EXPECT_TRUE(near(A * unit, expected, within(1e-14, "sums of at most five terms", scale))) << "state " << i;
  }
}

TEST(ChatterMatrix, DirectionsOfTheBodiesDoNotMatter)
{
  const ChatterStandModel mirrored = stand();
  ChatterStandModel common         = mirrored;
  common.structure                 = structure_of(chain());
  const Eigen::VectorXcd a         = eigenvalues(chatter_matrix(mirrored, coefficients())),
                         b         = eigenvalues(chatter_matrix(common, coefficients()));
  for (int i = 0; i < 14; ++i)
    EXPECT_LT(std::abs(a[i] - b[i]), 1e-12 * a.cwiseAbs().maxCoeff());  // rounding of an eigenvalue
  const ChatterMode one = chatter_mode(mirrored, coefficients(), a[0]),
                    two = chatter_mode(common, coefficients(), b[0]);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(one.body[i].label, two.body[i].label);
    EXPECT_TRUE(near(two.body[i].amplitude, one.body[i].amplitude, within(1e-8, "an eigenvector")));
    EXPECT_LT(std::abs(two.body[i].phase - one.body[i].phase), 1e-6) << "degrees, an eigenvector to 1e-8";
  }
}

// A stand in all its modes is the stand, if its damping is that of the modes.
TEST(ChatterMatrix, AllModesOfAStandGiveTheStand)
{
  const StandStructure six = six_mass_structure(masses, springs, {});
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(six.K, six.M);
  const Eigen::MatrixXd shape = solver.eigenvectors();
  const Eigen::VectorXd w     = solver.eigenvalues().cwiseSqrt();
  ModalModel modal;
  modal.labels    = six.labels;
  modal.frequency = w / (2 * M_PI);
  modal.damping   = 0.01;
  modal.force     = shape.transpose() * six.b;
  modal.point     = shape;
  modal.point.bottomRows(3) *= -1;  // upwards
  StandStructure damped = six;
  damped.C              = six.M * shape * Eigen::MatrixXd((0.02 * w).asDiagonal()) * shape.transpose() * six.M;
  const StandStructure modes = structure_of(modal);
  EXPECT_TRUE((modes.point - shape).cwiseAbs().maxCoeff() == 0);
  const Eigen::VectorXcd a = eigenvalues(chatter_matrix({damped, 4.9, 5.3, 210e9}, coefficients())),
                         b = eigenvalues(chatter_matrix({modes, 4.9, 5.3, 210e9}, coefficients()));
  for (int i = 0; i < 14; ++i)
    EXPECT_LT(std::abs(a[i] - b[i]), 1e-11 * a.cwiseAbs().maxCoeff());  // two eigenproblems in a row
}

// What the force does to the structure is what the gap takes: G(s) is symmetric in the two, and its static value
// is the sum of the springs' compliances.
TEST(Receptance, StaticValueIsTheSumOfCompliances)
{
  double compliance = 0;
  for (const double k : springs)
    compliance += 1 / k;
  EXPECT_TRUE(near(receptance(stand().structure, 0).real(), compliance, within(1e-12, "a 6 x 6 solve")));
}

TEST(Balance, ScalesByPowersOfTwoAndLeavesTheRoots)
{
  const Eigen::MatrixXd A = chatter_matrix(stand(), coefficients());
  const Eigen::VectorXd d = balance(A);
  for (const double x : d)
    EXPECT_EQ(std::exp2(std::round(std::log2(x))), x);
  const Eigen::MatrixXd B = d.cwiseInverse().asDiagonal() * A * d.asDiagonal();
  EXPECT_LT(B.norm(), 1e-3 * A.norm());
  for (int i = 0; i < 14; ++i) {
    const double row = B.row(i).norm(), column = B.col(i).norm();
    EXPECT_LT(std::max(row, column), 3 * std::min(row, column)) << i;  // a power of two apart at most
  }
  EXPECT_TRUE(near(B.trace(), A.trace(), within(1e-14, "exact scaling")));
}

TEST(Eigenvector, SatisfiesTheEigenvalueEquation)
{
  const Eigen::MatrixXd A = chatter_matrix(stand(), coefficients());
  const Eigen::VectorXd d = balance(A);
  for (const auto root : eigenvalues(A)) {
    const Eigen::VectorXcd x = eigenvector(A, root), defect = d.cwiseInverse().asDiagonal() * (A * x - root * x);
    EXPECT_LT(defect.norm(), 1e-9 * std::abs(root) * (d.cwiseInverse().asDiagonal() * x).norm()) << root;
  }
}

// The force of a mode moves the gap of the structure as far as the mode says.
TEST(ChatterMode, ForceSatisfiesTheStructure)
{
  const auto roots = eigenvalues(chatter_matrix(stand(), coefficients()));
  for (const auto root : roots) {
    const ChatterMode mode = chatter_mode(stand(), coefficients(), root);
    const auto gap         = receptance(stand().structure, root) * mode.force;
    EXPECT_LT(std::abs(gap - mode.gap), 1e-7) << root;  // of 1; poles of the structure lie close to some roots
    EXPECT_TRUE(near(std::abs(mode.gap), 1, within(1e-12, "the mode is scaled to a gap of one: rounding")));
  }
}

// The upper and the lower half alike: their motion in opposite sense never moves the gap.
TEST(ChatterMode, WithoutGapHasNoPhase)
{
  const StandStructure alike = six_mass_structure(
      {1e5, 7e4, 9e3, 9e3, 7e4, 1e5}, {7e10, 3e10, 6e10, 6e10, 3e10, 7e10}, {6e5, 4e5, 6e5, 6e5, 4e5, 6e5});
  const ChatterStandModel model{alike, 5, 5, 210e9};
  const FreeModes free = free_modes(alike);
  int still            = 0;
  for (const auto root : eigenvalues(chatter_matrix(model, coefficients()))) {
    const ChatterMode mode = chatter_mode(model, coefficients(), root);
    if (!std::isnan(mode.force_phase))
      continue;
    ++still;
    EXPECT_LT(std::abs(mode.gap), 1e-9);  // of 1 m of the largest point
    EXPECT_TRUE(near(mode.work_roll_ratio, 1, within(1e-9, "symmetry")));
    double nearest = 1e9;
    for (const double f : free.frequency)
      nearest = std::min(nearest, std::abs(f - std::abs(root) / (2 * M_PI)));
    EXPECT_LT(nearest, 1e-8) << "a mode of the structure alone, Hz";
  }
  EXPECT_EQ(still, 6);
}

TEST(FreeModes, ModesWithLockingDampersAreOverdamped)
{
  std::array<double, 6> strong = dampers;
  for (double &c : strong)
    c *= 1e3;
  const FreeModes weak   = free_modes(stand().structure),
                  locked = free_modes(six_mass_structure(masses, springs, strong));
  EXPECT_EQ(weak.overdamped, 0);
  EXPECT_EQ(weak.frequency.size(), 6);
  EXPECT_GT(locked.overdamped, 2);
  EXPECT_EQ(locked.frequency.size() + locked.overdamped, 6);
  EXPECT_TRUE(near(locked.undamped, weak.undamped, within(1e-14, "dampers do not enter")));
}

TEST(SixMassStructure, RefusesMatricesThatCannotVibrate)
{
  const auto with = [](auto change) {
    auto m = masses, k = springs, c = dampers;
    change(m, k, c);
    return refusal([&] { six_mass_structure(m, k, c); });
  };
  EXPECT_EQ(with([](auto &m, auto &, auto &) { m[2] = 0; }), "mass m2 of the stand = 0 kg has to be above zero");
  EXPECT_EQ(with([](auto &, auto &k, auto &) { k[3] = -1e10; }),
            "stiffness k4 of the stand = -1e+10 N/m has to be zero or above");
  EXPECT_EQ(with([](auto &, auto &, auto &c) { c[5] = not_given; }),
            "damping c5 of the stand = nan N s/m has to be zero or above");
}
