// What the verification cases do not ask of component modes: errors word for word, scaling, parts held by the
// ground.
#include "fem/body/component_modes.h"
#include "fem/roll/roll_component.h"
#include "meshes/roll/roll.h"
#include "tests/manual/solvers/whole_stand.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <Eigen/Eigenvalues>
#include <cstdint>
#include <filesystem>
#include <gtest/gtest.h>
#include <malloc.h>
#include <memory>
#include <set>
#include <unistd.h>
#include <vector>

using namespace mill;

namespace {
const Material steel{210e9, 0.28, 7700};
const RollGeometry work{0.21, 0.7, 0.13335, 0.46, 1.0, 0};

fem::ElasticBody body_of(const RollGeometry &geometry, const Material &material = steel)
{
  const std::string path =
      (std::filesystem::temp_directory_path() / ("millstand-component-" + std::to_string(getpid()) + ".msh"))
          .string();
  const MeshFile mesh = meshes::mesh_roll("work roll", geometry, meshes::vibration_mesh_size(geometry, 2), path);
  fem::ElasticBody body(mesh, material, 2);
  std::filesystem::remove(path);
  return body;
}

struct MeshedRoll {
  fem::ElasticBody body        = body_of(work);
  fem::PartModel part          = fem::PartModel("work roll", body, fem::roll_support(body));
  fem::PartInterface interface = fem::roll_interface(body, work, 6);
};
const MeshedRoll &roll()
{
  static const MeshedRoll made;
  return made;
}
}  // namespace

TEST(ComponentModes, ABodyWithoutSupportIsNamedWithItsDirection)
{
  fem::PartSupport support = fem::roll_support(roll().body);
  for (int n = 0; n < roll().body.nodes().rows(); ++n)  // without the pin
    support.held[std::size_t(3 * n + 1)] = 0;
  EXPECT_EQ(
      refusal([&] { fem::PartModel("work roll", roll().body, support); }),
      "the work roll can move freely along y: no support, symmetry or pin holds it in that direction; give it a "
      "support");
}

TEST(ComponentModes, AnInterfaceThatLeavesARigidMotionIsNamedWithIt)
{
  fem::PartInterface bending = roll().interface;  // P2 alone does not follow the translation
  bending.names              = {"barrel P2"};
  bending.weights            = roll().interface.weights.col(1).eval();
  EXPECT_EQ(
      refusal([&] { fem::component_modes(roll().part, bending, {4}); }),
      "the interface of the work roll does not hold it along y: a rigid motion is left over; add an interface "
      "displacement that follows this motion");
}

TEST(ComponentModes, TheSameInterfaceTwiceIsRefused)
{
  fem::PartInterface twice = roll().interface;
  twice.weights.col(3)     = twice.weights.col(2);
  EXPECT_NE(refusal([&] { fem::component_modes(roll().part, twice, {4}); }).find("depend on each other"),
            std::string::npos);
}

TEST(ComponentModes, ALimitAboveTheReachOfTheMeshIsRefused)
{
  fem::ModeChoice choice;
  choice.frequency_limit = 9000;
  choice.reach           = 4321.7;
  EXPECT_EQ(
      refusal([&] { fem::component_modes(roll().part, roll().interface, choice); }),
      "the frequency limit of 9000 Hz is above what the mesh of the work roll can follow, 4321 Hz (four elements "
      "per wave): lower the limit or use a finer mesh");
}

TEST(ComponentModes, MoreModesThanTheMeshHasAreRefused)
{
  EXPECT_NE(refusal([&] {
              fem::component_modes(roll().part, roll().interface, {1000000});
            }).find("1000000 fixed-interface modes of the work roll are asked for"),
            std::string::npos);
}

TEST(ComponentModes, ByTheLimitEveryModeBelowTwiceTheLimitIsKept)
{
  fem::ModeChoice choice;
  choice.frequency_limit = 2600;
  const Component c      = fem::component_modes(roll().part, roll().interface, choice);
  const Component more = fem::component_modes(roll().part, roll().interface, {int(c.fixed_frequency.size()) + 1});
  EXPECT_GE(more.fixed_frequency.tail(1)[0], 5200);
  EXPECT_LE(fem::residual_share(c, 2600), choice.residual_share);
  EXPECT_GT(fem::residual_share(fem::component_modes(roll().part, roll().interface, {0}), 2600),
            choice.residual_share);
}

// Lengths x s, modulus x e: frequencies x sqrt(e) / s, stiffness x e s, mass x s^3.
TEST(ComponentModes, ScaleAsTheyMust)
{
  const double s = 1e-3, e = 4;
  const RollGeometry small{work.radius * s,      work.half_length * s, work.neck_radius * s,
                           work.neck_length * s, work.seat_centre * s, 0};
  const fem::ElasticBody body = body_of(small, {e * 210e9, 0.28, 7700});
  const fem::PartModel part("work roll", body, fem::roll_support(body));
  const Component c      = fem::component_modes(part, fem::roll_interface(body, small, 6), {5});
  const Component r      = fem::component_modes(roll().part, roll().interface, {5});
  const double tolerance = 1e-8;  // rounding of the eigenvalue solver
  EXPECT_LT((c.fixed_frequency * s / std::sqrt(e) - r.fixed_frequency).norm(),
            tolerance * r.fixed_frequency.norm());
  EXPECT_LT((c.K.topLeftCorner(7, 7) / (e * s) - r.K.topLeftCorner(7, 7)).norm(), tolerance * r.K.norm());
  EXPECT_LT((c.M.topLeftCorner(7, 7) / (s * s * s) - r.M.topLeftCorner(7, 7)).norm(), tolerance * r.M.norm());
  EXPECT_LT((c.residual * e / std::pow(s, 5) - r.residual).norm(), tolerance * r.residual.norm() * 10);
}

// The end of the neck held by the ground: no rigid motion, no pin; the assembly needs no spring.
TEST(ComponentModes, APartHeldByTheGroundHasNoRigidMotion)
{
  fem::PartSupport ground = fem::roll_support(roll().body);
  for (const int node : roll().body.group("end"))
    ground.held[std::size_t(3 * node + 1)] = 1;
  ground.rigid.resize(ground.rigid.rows(), 0);
  ground.rigid_names.clear();
  fem::PartInterface interface = roll().interface;  // the pinned node of roll_support stays: leave it free
  ground.held[std::size_t(3 * roll().body.axis().front() + 1)] = 0;
  const fem::PartModel part("work roll", roll().body, ground);
  const Component held = fem::component_modes(part, interface, {8});
  fem::WholeStand stand;
  stand.bodies               = {{&part, &interface}};
  stand.mass                 = Eigen::MatrixXd::Zero(7, 7);
  const Eigen::VectorXd full = fem::whole_modes(stand, 2).frequency;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(held.K, held.M);
  for (int k = 0; k < 2; ++k) {  // Rayleigh: not below; the residual says by how much it may lie above
    const double reduced = std::sqrt(modes.eigenvalues()[k]) / (2 * M_PI);
    EXPECT_GT(reduced, full[k] * (1 - 1e-9));
    EXPECT_LT(reduced, full[k] * (1 + 2 * fem::residual_share(held, full[k])));
  }
}

TEST(WholeStand, AnAssemblyThatFloatsIsNamed)
{
  fem::WholeStand stand;
  stand.bodies = {{&roll().part, &roll().interface}};
  stand.mass   = Eigen::MatrixXd::Zero(7, 7);
  EXPECT_EQ(
      refusal([&] { fem::whole_modes(stand, 2); }),
      "the springs leave the work roll free to move along y: join it to the ground or to a part that is held");
}

// A rigid lump on a spring, on a body held by a spring: two springs in series under a static force.
// With two threads a matrix lies at another place of memory than with one, at any multiple of 16 bytes.
TEST(ComponentModes, AreTheSameToTheBitWhereverTheMatricesLie)
{
  mallopt(M_MMAP_THRESHOLD, 1 << 30);  // large arrays from the heap too, where gaps move them
  std::vector<std::unique_ptr<char[]>> gaps;
  std::vector<std::unique_ptr<MeshedRoll>> rolls;  // all are kept, so that each lies elsewhere
  std::set<std::uintptr_t> places;
  Eigen::VectorXd frequency;
  for (std::size_t gap = 0; gap < 6; ++gap) {
    for (const std::size_t size : {0, 300, 1000, 5000, 20000, 70000})
      gaps.push_back(std::make_unique<char[]>(16 * gap + 24 + size));
    rolls.push_back(std::make_unique<MeshedRoll>());
    const MeshedRoll &last = *rolls.back();
    places.insert(reinterpret_cast<std::uintptr_t>(last.body.mass().valuePtr()) % 64);
    const Eigen::VectorXd now = fem::component_modes(last.part, last.interface, {3}).fixed_frequency;
    if (gap == 0)
      frequency = now;
    EXPECT_EQ(last.part.mass(), rolls.front()->part.mass()) << "gap " << gap;
    EXPECT_EQ(now, frequency) << "gap " << gap;
  }
#ifdef __has_feature
#if __has_feature(address_sanitizer)
  return;  // its allocator ignores the gaps
#endif
#endif
  EXPECT_GE(places.size(), 2u) << "the gaps are to move the matrices";
}

TEST(WholeStand, StaticSpringsAddUp)
{
  fem::WholeStand stand;
  stand.bodies  = {{&roll().part, &roll().interface}};
  stand.n_lumps = 1;
  stand.mass    = Eigen::MatrixXd::Identity(8, 8);
  Connection ground{"ground", Eigen::MatrixXd::Zero(1, 8), Eigen::VectorXd::Constant(1, 2e9)};
  ground.rows(0, 6) = 1;
  Connection lump{"lump", Eigen::MatrixXd::Zero(1, 8), Eigen::VectorXd::Constant(1, 3e9)};
  lump.rows(0, 6)         = 1;
  lump.rows(0, 7)         = -1;
  stand.connections       = {ground, lump};
  Eigen::MatrixXd force   = Eigen::MatrixXd::Zero(8, 1);
  force(7, 0)             = 1e6;
  const Eigen::MatrixXd y = fem::whole_static(stand, force);
  EXPECT_TRUE(near(y(6, 0), 1e6 / 2e9, within_absolute(1e-12, "rounding of a displacement of 5e-4 m")));
  EXPECT_TRUE(
      near(y(7, 0), 1e6 / 2e9 + 1e6 / 3e9, within_absolute(1e-12, "rounding of a displacement of 5e-4 m")));
  EXPECT_TRUE(near(y(0, 0), y(6, 0),
                   within_absolute(1e-12, "nothing loads the roll between: it moves as one; rounding of 5e-4 m")));
}
