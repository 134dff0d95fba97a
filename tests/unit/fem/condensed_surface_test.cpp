// A body reduced to one of its surfaces, and two of them as one contact problem.
#include "core/base/errors.h"
#include "fem/body/body_pair.h"
#include "fem/body/condensed_surface.h"
#include "fem/body/elastic_body.h"
#include "fem/body/section_body.h"
#include "fem/contact/active_set.h"
#include "fem/contact/mortar.h"
#include "meshes/common/block.h"
#include "tests/manual/solvers/ring_mesh.h"
#include "tests/support/near.h"
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace mill;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {
const Material steel{210e9, 0.3, 7850};
const auto rounding = within(1e-9, "rounding times the condition of the body, about 1e5");

std::string scratch()
{
  return (std::filesystem::temp_directory_path() / ("millstand-condensed-" + std::to_string(getpid()) + ".msh"))
      .string();
}

// Block 0 .. 2 x -1 .. 0, four by three elements.
fem::SectionBody block(const int degree = 2)
{
  meshes::BlockGrid grid;
  grid.x          = meshes::even_lines(0, 2, 4);
  grid.y          = meshes::even_lines(-1, 0, 3);
  const auto mesh = meshes::mesh_block(grid, scratch());
  fem::SectionBody body(mesh, steel, degree, fem::Section::plane_strain);
  std::filesystem::remove(mesh.path);
  return body;
}

std::vector<char> clamped(const fem::SectionBody &body, const std::string &group)
{
  std::vector<char> held(body.stiffness().rows(), 0);
  for (const int node : body.group(group))
    held[2 * node] = held[2 * node + 1] = 1;
  return held;
}

fem::SectionBody quarter_ring(const double r1, const double r2, const int n_radial, const int n_angle)
{
  const auto mesh = meshes::mesh_ring(meshes::even_lines(r1, r2, n_radial), n_angle, scratch());
  fem::SectionBody body(mesh, steel, 2, fem::Section::plane_strain,
                        {{"inner", {0, 0}, r1}, {"outer", {0, 0}, r2}});
  std::filesystem::remove(mesh.path);
  return body;
}

std::vector<char> symmetric(const fem::SectionBody &body)
{
  std::vector<char> held(body.stiffness().rows(), 0);
  for (const int node : body.group("symmetry.x"))
    held[2 * node] = 1;
  for (const int node : body.group("symmetry.y"))
    held[2 * node + 1] = 1;
  return held;
}
}  // namespace

TEST(CondensedSurface, FlexibilityIsWhatTheWholeFieldSays)
{
  const auto body = block();
  const fem::CondensedSurface s(body.stiffness(), 2, clamped(body, "bottom"), body.surface("patch"));
  const auto n = s.flexibility().rows();
  ASSERT_EQ(n, 9);
  EXPECT_LT((s.flexibility() - s.flexibility().transpose()).norm(), 1e-15 * s.flexibility().norm());
  for (Eigen::Index j = 0; j < n; ++j) {
    const VectorXd field = s.displacement(VectorXd::Unit(n, j));
    for (Eigen::Index i = 0; i < n; ++i)
      EXPECT_TRUE(near(s.flexibility()(i, j), field[2 * s.surface().node[i] + 1], rounding));
    // Equilibrium: supports carry the force; nothing else is out of balance.
    const VectorXd reaction = s.reactions(field),
                   residual = body.stiffness().selfadjointView<Eigen::Upper>() * field;
    double sum              = 0;
    for (const int node : body.group("bottom"))
      sum += reaction[2 * node + 1];
    EXPECT_TRUE(near(sum, -1, rounding));
    EXPECT_TRUE(near(residual[2 * s.surface().node[j] + 1], 1, rounding));
  }
}

TEST(CondensedSurface, TangentsAreKeptWhenFrictionAsksForThem)
{
  const auto body = block();
  const auto held = clamped(body, "bottom");
  fem::SurfaceOptions options;
  options.tangential = true;
  const fem::CondensedSurface normals(body.stiffness(), 2, held, body.surface("patch")),
      both(body.stiffness(), 2, held, body.surface("patch"), options);
  const auto n = normals.flexibility().rows();
  ASSERT_EQ(both.flexibility().rows(), 2 * n);
  EXPECT_LT((both.flexibility().topLeftCorner(n, n) - normals.flexibility()).norm(),
            1e-12 * normals.flexibility().norm());
  for (Eigen::Index i = 0; i < n; ++i) {
    EXPECT_TRUE(near(both.directions().row(i).dot(Eigen::RowVector2d(0, 1)), 1, rounding));
    EXPECT_TRUE(near(std::abs(both.directions()(n + i, 0)), 1, rounding));
  }
  const VectorXd field = both.displacement(VectorXd::Unit(2 * n, n + 2));
  const double along   = both.directions()(n + 4, 0);
  EXPECT_TRUE(near(both.flexibility()(n + 4, n + 2), along * field[2 * both.surface().node[4]], rounding));
}

TEST(CondensedSurface, AHeldTangentHasNoDirectionAndNoFlexibility)
{
  const auto ring = quarter_ring(0.6, 1, 2, 4);
  fem::SurfaceOptions options;
  options.tangential = true;
  const fem::CondensedSurface s(ring.stiffness(), 2, symmetric(ring), ring.surface("inner"), options);
  const auto n = s.flexibility().rows() / 2;
  int held     = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    if (s.directions().row(n + i).norm() == 0) {
      ++held;
      EXPECT_EQ(s.flexibility().row(n + i).norm(), 0);
    }
  EXPECT_EQ(held, 2);  // the nodes on the two planes of symmetry
}

TEST(CondensedSurface, PressureInARingMovesItsInclinedNodesAsLameSays)
{
  const double a = 0.6, b = 1, p = 1e7, E = steel.youngs_modulus, nu = steel.poisson_ratio;
  const auto ring = quarter_ring(a, b, 6, 16);
  const fem::CondensedSurface s(ring.stiffness(), 2, symmetric(ring), ring.surface("inner"));
  const auto c           = contact::couple_to_rigid(s.surface());
  const VectorXd outward = -p * (c.slave.transpose() * c.weight);  // a pressure pushes against the normals
  const VectorXd u       = s.flexibility() * outward;
  // Plane strain: u_r = (1 + nu) p a^2 / (E (b^2 - a^2)) ((1 - 2 nu) r + b^2 / r); the outward normal is -r.
  const double u_r = (1 + nu) * p * a * a / (E * (b * b - a * a)) * ((1 - 2 * nu) * a + b * b / a);
  const auto lame = within(2e-4, "six quadratic elements over the wall, and edges of half an angle t = 0.05 whose "
                                 "normals turn by t^2/24 too little");
  for (Eigen::Index i = 0; i < u.size(); ++i)
    EXPECT_TRUE(near(-u[i], u_r, lame)) << "node " << i;
  // The same load as nodal forces of a load case, in coordinates.
  const auto load = fem::load_on(s.surface(), fem::pressure_load(s.surface(), [&](const VectorXd &) { return p; }),
                                 ring.stiffness().rows());
  const VectorXd response = s.response(load);
  for (Eigen::Index i = 0; i < u.size(); ++i)
    EXPECT_TRUE(near(-response[i], u_r, lame)) << "node " << i;
}

TEST(CondensedSurface, AnImposedRigidMotionOfTheSupportMovesTheSurfaceRigidly)
{
  const auto body = block();
  const fem::CondensedSurface s(body.stiffness(), 2, clamped(body, "bottom"), body.surface("patch"));
  fem::LoadCase motion;
  motion.displacement = VectorXd::Zero(body.stiffness().rows());
  for (const int node : body.group("bottom")) {
    motion.displacement[2 * node]     = 0.3;
    motion.displacement[2 * node + 1] = -0.2;
  }
  const VectorXd response = s.response(motion), field = s.displacement(VectorXd::Zero(9), motion);
  for (Eigen::Index i = 0; i < response.size(); ++i)
    EXPECT_TRUE(near(response[i], -0.2, rounding));
  for (int node = 0; node < body.nodes().rows(); ++node) {
    EXPECT_TRUE(near(field[2 * node], 0.3, rounding));
    EXPECT_TRUE(near(field[2 * node + 1], -0.2, rounding));
  }
  EXPECT_LT(s.reactions(field, motion).cwiseAbs().maxCoeff(), 1e-9 * steel.youngs_modulus);
}

TEST(CondensedSurface, PressureOnAFaceInSpaceHasItsResultantAndMoment)
{
  meshes::BlockGrid grid;
  grid.x = meshes::even_lines(0, 2, 2);
  grid.y = meshes::even_lines(-1, 0, 1);
  grid.z = meshes::even_lines(0, 3, 2);
  for (const int degree : {1, 2}) {
    const auto mesh = meshes::mesh_block(grid, scratch());
    const fem::ElasticBody body(mesh, steel, degree);
    std::filesystem::remove(mesh.path);
    const std::vector<std::pair<std::string, Vector3d>> faces{{"patch", {0, 1, 0}}, {"bottom", {0, -1, 0}},
                                                              {"left", {-1, 0, 0}}, {"right", {1, 0, 0}},
                                                              {"back", {0, 0, -1}}, {"front", {0, 0, 1}}};
    for (const auto &[name, normal] : faces) {
      const Surface s         = body.surface(name);
      const Eigen::MatrixXd n = contact::nodal_normals(s);
      for (Eigen::Index i = 0; i < n.rows(); ++i)
        EXPECT_TRUE(near(n.row(i).dot(normal), 1, rounding)) << name;
    }
    const Surface top       = body.surface("patch");
    const Eigen::MatrixXd f = fem::pressure_load(top, [](const VectorXd &x) { return 1 + x[0]; });
    EXPECT_TRUE(near(f.col(1).sum(), -12, rounding));
    EXPECT_TRUE(near(f.col(1).dot(top.points.col(0)), -14, rounding));  // 3 (2^2/2 + 2^3/3)
    EXPECT_LT(f.col(0).cwiseAbs().maxCoeff() + f.col(2).cwiseAbs().maxCoeff(), 1e-12);
  }
}

TEST(CondensedSurface, WhatCannotBeCondensedIsAnError)
{
  const auto body = block();
  auto held       = clamped(body, "bottom");
  EXPECT_THROW(fem::CondensedSurface(body.stiffness(), 3, held, body.surface("patch")), InputError);
  held[2 * body.group("patch")[3] + 1] = 1;
  EXPECT_THROW(fem::CondensedSurface(body.stiffness(), 2, held, body.surface("patch")), InputError);
}

TEST(BodyPair, AnEccentricForceTiltsARigidStampAndStaysInBalance)
{
  const auto body = block();
  const fem::CondensedSurface s(body.stiffness(), 2, clamped(body, "bottom"), body.surface("patch"));
  fem::DrivenMode down, tilt;  // positive tilt presses the side of larger x
  down.master.translation = Vector2d(0, -1);
  tilt.master.rotation    = VectorXd::Constant(1, -1);
  tilt.master.about       = Vector2d(1, 0);
  const auto pair         = fem::pair_with_rigid({&s}, {down, tilt});
  contact::ActiveSet solver(pair.problem);
  const double F = 1e6, e = 0.1;
  const auto state       = solver.solve({Vector2d(F, F * e), {}});
  const VectorXd forces  = pair.slave_forces(state.nodal);
  const Surface &surface = s.surface();
  EXPECT_TRUE(near(forces.sum(), -F, rounding));
  EXPECT_TRUE(near(forces.dot(surface.points.col(0)), -F * (1 + e), rounding));
  EXPECT_GT(state.motion[1], 0);
  // The mirrored eccentricity gives the mirrored state.
  const auto mirrored = solver.solve({Vector2d(F, -F * e), {}});
  EXPECT_TRUE(near(mirrored.motion[1], -state.motion[1], rounding));
  EXPECT_TRUE(near(mirrored.motion[0], state.motion[0], rounding));
}

TEST(BodyPair, ABodyOfHalfTheModulusIsTwiceAsFlexible)
{
  const auto body = block();
  const Material soft{105e9, 0.3, 7850};
  meshes::BlockGrid grid;
  grid.x          = meshes::even_lines(0, 2, 4);
  grid.y          = meshes::even_lines(-1, 0, 3);
  const auto mesh = meshes::mesh_block(grid, scratch());
  const fem::SectionBody soft_body(mesh, soft, 2, fem::Section::plane_strain);
  std::filesystem::remove(mesh.path);
  const fem::CondensedSurface s(body.stiffness(), 2, clamped(body, "bottom"), body.surface("patch")),
      t(soft_body.stiffness(), 2, clamped(soft_body, "bottom"), soft_body.surface("patch"));
  fem::DrivenMode down;
  down.master.translation = Vector2d(0, -1);
  const auto scaled = fem::pair_with_rigid({&s, {}, {}, 2}, {down}), own = fem::pair_with_rigid({&t}, {down});
  EXPECT_LT((scaled.problem.C - own.problem.C).norm(), 1e-12 * own.problem.C.norm());
}

TEST(BodyPair, BodiesOfDifferentKindsAreAnError)
{
  const auto plane = block();
  meshes::BlockGrid grid;
  grid.x          = meshes::even_lines(0, 2, 2);
  grid.y          = meshes::even_lines(-1, 0, 2);
  const auto mesh = meshes::mesh_block(grid, scratch());
  const fem::SectionBody round(mesh, steel, 2, fem::Section::axisymmetric);
  std::filesystem::remove(mesh.path);
  auto held = clamped(round, "bottom");
  for (const int node : round.group("left"))
    held[2 * node] = 1;
  const fem::CondensedSurface a(plane.stiffness(), 2, clamped(plane, "bottom"), plane.surface("patch")),
      b(round.stiffness(), 2, held, round.surface("patch"));
  EXPECT_THROW(fem::pair_bodies({&a}, {&b, Vector2d(1, -1).asDiagonal(), {}}, {fem::DrivenMode()}), InputError);
}

TEST(BodyPair, FrictionKeepsTheNormalProblemAndAddsTheTangents)
{
  const auto lower = block();
  meshes::BlockGrid grid;
  grid.x          = meshes::even_lines(0, 2, 3);
  grid.y          = meshes::even_lines(-1, 0, 2);
  const auto mesh = meshes::mesh_block(grid, scratch());
  const fem::SectionBody upper(mesh, steel, 2, fem::Section::plane_strain);
  std::filesystem::remove(mesh.path);
  fem::SurfaceOptions options;
  options.tangential = true;
  const fem::CondensedSurface a(lower.stiffness(), 2, clamped(lower, "bottom"), lower.surface("patch"), options),
      b(upper.stiffness(), 2, clamped(upper, "bottom"), upper.surface("patch"), options),
      bare(upper.stiffness(), 2, clamped(upper, "bottom"), upper.surface("patch"));
  fem::DrivenMode down, sideways;
  down.master.translation     = Vector2d(0, -1);
  sideways.master.translation = Vector2d(1, 0);
  const Eigen::MatrixXd flip  = Eigen::DiagonalMatrix<double, 2>(1, -1);
  const auto plain            = fem::pair_bodies({&a}, {&b, flip, {}}, {down, sideways});
  const auto rough            = fem::pair_with_friction({&a}, {&b, flip, {}}, {down, sideways}, 0.3);
  const auto n                = plain.problem.C.rows();
  ASSERT_EQ(rough.problem.C.rows(), 2 * n);
  EXPECT_LT((rough.problem.C.topLeftCorner(n, n) - plain.problem.C).norm(), 1e-12 * plain.problem.C.norm());
  EXPECT_LT((rough.problem.G.topRows(n) - plain.problem.G).norm(), 1e-12);
  for (Eigen::Index i = 0; i < n; ++i) {
    EXPECT_TRUE(near(std::abs(rough.problem.G(n + i, 1)), 1, rounding));  // all of a push is slip
    EXPECT_LT(std::abs(rough.problem.G(n + i, 0)), 1e-12);
  }
  EXPECT_THROW(fem::pair_with_friction({&a}, {&bare, flip, {}}, {down}, 0.3), InputError);

  // Below the sliding load all that presses also sticks, and the force is carried; beyond it nothing holds.
  contact::FrictionSolver solver(rough.problem);
  const auto pressed = solver.advance({Vector2d(1e6, 0), {}});
  EXPECT_TRUE(near(pressed.resultant[0], 1e6, rounding));
  EXPECT_NO_THROW(solver.advance({Vector2d(1e6, 0.2e6), {}}));
  EXPECT_THROW(solver.advance({Vector2d(1e6, 0.4e6), {}}), SolverError);
}
