#include "core/base/errors.h"
#include "meshes/common/block.h"
#include "tests/manual/solvers/large_contact.h"
#include "tests/manual/solvers/plastic_solid.h"
#include "tests/support/near.h"
#include <Eigen/Eigenvalues>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace mill;
using Eigen::Matrix2d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using fem::ElasticLaw;
using Vector6 = Eigen::Matrix<double, 6, 1>;

namespace {
const Material steel{210e9, 0.3, 7850};
const double mu = 210e9 / 2.6, lambda = 210e9 * 0.3 / (1.3 * 0.4);
const ElasticLaw laws[] = {ElasticLaw::hencky, ElasticLaw::biot, ElasticLaw::st_venant_kirchhoff,
                           ElasticLaw::neo_hooke};

std::string scratch(const std::string &name)
{
  return (std::filesystem::temp_directory_path() / ("millstand-nonlinear-" + std::to_string(getpid()) + name))
      .string();
}

// Deformation gradient of given Green's strains (xx, yy, 2 xy), without rotation.
Matrix2d gradient_of(const Vector3d &E)
{
  Matrix2d C;
  C << 1 + 2 * E[0], E[2], E[2], 1 + 2 * E[1];
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(C).operatorSqrt();
}

fem::SectionBody square(const int n)
{
  meshes::BlockGrid grid;
  grid.x                 = meshes::even_lines(0, 1, n);
  grid.y                 = meshes::even_lines(-1, 0, n);
  const std::string path = scratch("square.msh");
  fem::SectionBody body(meshes::mesh_block(grid, path), steel, 2, fem::Section::plane_strain);
  std::filesystem::remove(path);
  return body;
}

VectorXd field(const fem::SectionBody &body, const Matrix2d &F)
{
  VectorXd u(2 * body.nodes().rows());
  for (Eigen::Index i = 0; i < body.nodes().rows(); ++i)
    u.segment<2>(2 * i) = (F - Matrix2d::Identity()) * body.nodes().row(i).transpose();
  return u;
}
}  // namespace

TEST(LargeStress, TangentIsTheDerivativeOfStress)
{
  for (const ElasticLaw law : laws)
    for (const Vector3d &E :
         {Vector3d(-0.04, 0.02, 0.03), Vector3d(0.01, 0.01, 0), Vector3d(-0.05, -0.05, 1e-7)}) {
      const auto state = fem::large_stress(steel, law, gradient_of(E));
      for (int j = 0; j < 3; ++j) {
        const double h    = 1e-5;
        const Vector3d up = fem::large_stress(steel, law, gradient_of(E + h * Vector3d::Unit(j))).stress,
                       dn = fem::large_stress(steel, law, gradient_of(E - h * Vector3d::Unit(j))).stress;
        // A central difference errs by h^2 = 1e-10 times a third derivative of some hundred moduli.
        EXPECT_LT(((up - dn) / (2 * h) - state.tangent.col(j)).norm(), 1e-7 * state.tangent.norm());
      }
    }
}

TEST(LargeStress, AllLawsAreHookesForSmallStrain)
{
  const Vector3d E(2e-7, -3e-7, 1e-7),
      hooke(lambda * -1e-7 + 2 * mu * 2e-7, lambda * -1e-7 - 2 * mu * 3e-7, mu * 1e-7);
  for (const ElasticLaw law : laws)
    EXPECT_LT((fem::large_stress(steel, law, gradient_of(E)).stress - hooke).norm(), 1e-5 * hooke.norm());
}

// One direction stretched, the others held: closed forms of each law.
TEST(LargeStress, ConfinedCompression)
{
  const double l   = 0.9;
  const Matrix2d F = Eigen::Vector2d(1, l).asDiagonal();
  const double E   = 0.5 * (l * l - 1);
  const auto S     = [&](const ElasticLaw law) { return fem::large_stress(steel, law, F).stress[1]; };
  EXPECT_TRUE(near(S(ElasticLaw::st_venant_kirchhoff) / ((lambda + 2 * mu) * E), 1,
                   within(1e-12, "closed form of a uniaxial strain, rounding")));
  EXPECT_TRUE(near(S(ElasticLaw::hencky) * l * l / ((lambda + 2 * mu) * std::log(l)), 1,
                   within(1e-12, "closed form of a uniaxial strain, rounding")));
  EXPECT_TRUE(near(S(ElasticLaw::biot) * l / ((lambda + 2 * mu) * (l - 1)), 1,
                   within(1e-12, "closed form of a uniaxial strain, rounding")));
  EXPECT_TRUE(near(S(ElasticLaw::neo_hooke) * l * l / (mu * (l * l - 1) + lambda * std::log(l)), 1,
                   within(1e-12, "closed form of a uniaxial strain, rounding")));
}

TEST(LargeStress, TurnedInsideOutIsAnError)
{
  EXPECT_THROW(fem::large_stress(steel, ElasticLaw::hencky, Eigen::Vector2d(1, -0.1).asDiagonal()), SolverError);
}

TEST(LargeForces, AreZeroUnderARigidRotation)
{
  const auto body  = square(3);
  const double t   = 0.7;
  const Matrix2d R = (Matrix2d() << std::cos(t), -std::sin(t), std::sin(t), std::cos(t)).finished();
  for (const ElasticLaw law : laws)
    EXPECT_LT(fem::large_forces(body, steel, law, field(body, R)).force.norm(), 1e-12 * 210e9);
}

TEST(LargeForces, TangentIsTheDerivativeOfForce)
{
  const auto body  = square(2);
  const Matrix2d F = (Matrix2d() << 1.02, 0.03, -0.01, 0.95).finished();
  VectorXd u       = field(body, F), d(u.size());
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    u[i] += 0.01 * std::sin(3. * double(i));
    d[i] = std::cos(5. * double(i));
  }
  for (const ElasticLaw law : laws) {
    const double h        = 1e-6;
    const VectorXd change = (fem::large_forces(body, steel, law, u + h * d).force -
                             fem::large_forces(body, steel, law, u - h * d).force) /
                            (2 * h);
    const auto state     = fem::large_forces(body, steel, law, u);
    const VectorXd exact = state.tangent.selfadjointView<Eigen::Upper>() * d;
    EXPECT_LT((change - exact).norm(), 1e-7 * exact.norm());  // h^2 times third derivatives of elements of 1/2
  }
}

TEST(LargeForces, UndeformedTangentIsTheStiffness)
{
  const auto body = square(3);
  const auto position =
      fem::large_forces(body, steel, ElasticLaw::hencky, VectorXd::Zero(body.stiffness().rows()));
  EXPECT_LT((position.tangent - body.stiffness()).norm(), 1e-13 * body.stiffness().norm());
  EXPECT_THROW(fem::large_forces(body, steel, ElasticLaw::hencky, VectorXd::Zero(4)), InputError);
}

// Two equal blocks between planes of symmetry: each shortens alike, and the pressure is the confined one.
TEST(LargeContact, UniformCompressionOfTwoBlocks)
{
  const auto lower = square(3), upper = square(2);
  std::vector<char> held_lower(lower.stiffness().rows(), 0), held_upper(upper.stiffness().rows(), 0);
  const auto hold = [](const fem::SectionBody &body, std::vector<char> &held) {
    for (const auto &group : {"left", "right"})
      for (const int node : body.group(group))
        held[2 * node] = 1;
    for (const int node : body.group("bottom"))
      held[2 * node + 1] = 1;
  };
  hold(lower, held_lower);
  hold(upper, held_upper);
  const double l = 0.9, stress = -(lambda + 2 * mu) * std::log(l) / l;  // Cauchy: Kirchhoff over the volume
  const auto state = fem::press_together(
      {&lower, steel, held_lower, "patch"},
      {&upper, steel, held_upper, "patch", {}, Eigen::Vector2d(1, -1).asDiagonal(), Eigen::Vector2d(0, 0)},
      ElasticLaw::hencky, stress);
  for (Eigen::Index i = 0; i < state.pressure.size(); ++i)
    EXPECT_TRUE(near(state.pressure[i] / stress, 1, within(1e-9, "unbalanced forces are below 1e-9")));
  EXPECT_TRUE(near(state.descent, 2 * (1 - l), within_absolute(1e-9, "unbalanced forces are below 1e-9")));
  EXPECT_LT(state.unbalanced, 1e-9);
}

TEST(PlasticStress, TangentAndStressAreDerivativesOfTheEnergy)
{
  const fem::PlasticLaw law{200e9, 0.3, 400e6, 0.01};
  Vector6 strain;
  strain << -0.004, 0.001, 0.002, 0.003, -0.001, 0.002;
  for (const double scale : {0.1, 1.0, 5.0}) {
    const Vector6 e   = scale * strain;
    const auto result = fem::plastic_stress(law, e);
    for (int j = 0; j < 6; ++j) {
      const double h = 1e-7;
      const auto up  = fem::plastic_stress(law, e + h * Vector6::Unit(j)),
                 dn  = fem::plastic_stress(law, e - h * Vector6::Unit(j));
      EXPECT_TRUE(near((up.energy - dn.energy) / (2 * h), result.stress[j],
                       within_absolute(1e-6 * result.stress.norm(),
                                       "central difference of the energy: step squared, and its rounding")));
      EXPECT_LT(((up.stress - dn.stress) / (2 * h) - result.tangent.col(j)).norm(), 1e-6 * result.tangent.norm());
    }
  }
}

// Pure shear beyond yield: s = 2 mu |dev|, |dev stress| = yield + hardening (s - yield), volume elastic.
TEST(PlasticStress, HardensLinearly)
{
  const fem::PlasticLaw law{200e9, 0.3, 400e6, 0.01};
  const double shear = 200e9 / 2.6, gamma = 0.02, s = 2 * shear * gamma / std::sqrt(2.);
  Vector6 strain    = Vector6::Zero();
  strain[3]         = gamma;
  const auto result = fem::plastic_stress(law, strain);
  EXPECT_TRUE(near(result.stress[3] * std::sqrt(2.) / (400e6 + 0.01 * (s - 400e6)), 1,
                   within(1e-12, "closed form of pure shear, rounding")));
  strain.head<3>().setConstant(0.001);
  EXPECT_TRUE(near(fem::plastic_stress(law, strain).stress[0] / (200e9 / 1.2 * 0.003), 1,
                   within(1e-12, "closed form of a volume change, rounding")));
}

// A flat plate on a confined cube: one strain everywhere, known from the law.
TEST(PlasticSolid, ConfinedCompressionByAPlate)
{
  meshes::BlockGrid grid;
  grid.x = grid.z        = meshes::even_lines(0, 1, 2);
  grid.y                 = meshes::even_lines(-1, 0, 2);
  const std::string path = scratch("cube.msh");
  const fem::ElasticBody body(meshes::mesh_block(grid, path), {200e9, 0.3, 7850}, 1);
  std::filesystem::remove(path);
  std::vector<char> held(3 * body.nodes().rows(), 0);
  for (const auto &group : {"left", "right"})
    for (const int node : body.group(group))
      held[3 * node] = 1;
  for (const auto &group : {"front", "back"})
    for (const int node : body.group(group))
      held[3 * node + 2] = 1;
  for (const int node : body.group("bottom"))
    held[3 * node + 1] = 1;
  fem::PressedSolid solid{&body,   {200e9, 0.3, 400e6, 0.01}, held,
                          "patch", Vector3d(0, 1, 0),         [](const Vector3d &) { return -0.02; }};
  const auto state   = fem::press_plastic(solid);
  const double shear = 200e9 / 2.6, s = 2 * shear * 0.02 * std::sqrt(2. / 3),
               deviator = std::sqrt(2. / 3) * (400e6 + 0.01 * (s - 400e6));
  EXPECT_TRUE(near(state.force / (200e9 / 1.2 * 0.02 + deviator), 1,
                   within(1e-9, "a uniform state; unbalanced forces are below 1e-9")));
  EXPECT_EQ(state.plastic, 1);
  EXPECT_EQ(state.n_touching, 9);
  solid.law.hardening = 0;
  EXPECT_THROW(fem::press_plastic(solid), InputError);
}

TEST(PlasticSolid, HighYieldIsElastic)
{
  const fem::PlasticLaw law{200e9, 0.3, 1e15, 0.01};
  Vector6 strain;
  strain << 0.01, -0.02, 0.03, 0.01, 0.02, -0.01;
  const double kappa = 200e9 / 1.2, shear = 200e9 / 2.6;
  const auto result = fem::plastic_stress(law, strain);
  EXPECT_TRUE(near(result.stress[0] / (kappa * 0.02 + 2 * shear * (0.01 - 0.02 / 3)), 1,
                   within(1e-12, "closed form, rounding")));
  EXPECT_TRUE(near(result.stress[4] / (shear * 0.02), 1, within(1e-12, "closed form, rounding")));
}
