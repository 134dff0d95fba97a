#include "fem/roll/roll_component.h"
#include "meshes/roll/roll.h"
#include "tests/support/near.h"
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace mill;

// The outside of a roll: what its component's coordinates do there.
namespace {
const Material steel{210e9, 0.28, 7700};
const RollGeometry roll{0.2, 0.5, 0.1, 0.6, 0.95, 0};

const Component &component()
{
  static const Component made = [] {
    const std::string path = (std::filesystem::temp_directory_path() /
                              ("millstand-roll-component-" + std::to_string(::getpid()) + ".msh"))
                                 .string();
    const MeshFile mesh = meshes::mesh_roll("roll", roll, meshes::vibration_mesh_size(roll, 3), path);
    const fem::ElasticBody body(mesh, steel, 2);
    fem::RollComponentOptions options;
    options.n_modes = 2;
    Component c     = fem::roll_component("roll", body, roll, steel, options).component;
    std::remove(path.c_str());
    return c;
  }();
  return made;
}

Eigen::VectorXd unit(const char *name)
{
  const auto &all = component().interface;
  return Eigen::VectorXd::Unit(component().M.rows(), std::find(all.begin(), all.end(), name) - all.begin());
}
}  // namespace

TEST(RollSurface, LiesOnTheOutside)
{
  const ComponentSurface &s = component().surface;
  ASSERT_GT(s.faces.rows(), 20);
  EXPECT_EQ(s.displacement.rows(), 3 * s.position.rows());
  EXPECT_EQ(s.stress.rows(), 6 * s.position.rows());
  EXPECT_EQ(s.faces.maxCoeff(), double(s.position.rows() - 1));
  double area = 0;  // of the flat faces: a little less than that of the cylinders
  for (Eigen::Index f = 0; f < s.faces.rows(); ++f) {
    const auto value_at = [&](const int c) -> Eigen::Vector3d {
      return s.position.row(Eigen::Index(s.faces(f, c))).transpose();
    };
    area += 0.5 * (value_at(2) - value_at(0)).cross(value_at(3) - value_at(1)).norm();
  }
  const double drawn = M_PI / 2 * (roll.radius * roll.half_length + roll.neck_radius * roll.neck_length) +
                       M_PI / 4 * roll.radius * roll.radius;  // shoulder and end together
  EXPECT_TRUE(near(area, drawn, within(0.03, "chords of an arc in six parts")));
}

TEST(RollSurface, ARigidMotionHasNoStress)
{
  const ComponentSurface &s    = component().surface;
  const Eigen::VectorXd lifted = unit("barrel P0") + unit("seat");
  const Eigen::VectorXd u      = s.displacement * lifted;
  const Eigen::Map<const Eigen::Matrix3Xd> by_point(u.data(), 3, s.position.rows());
  EXPECT_TRUE(by_point.row(1).isOnes(1e-9));
  EXPECT_LT(by_point.row(0).cwiseAbs().maxCoeff() + by_point.row(2).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((s.stress * lifted).cwiseAbs().maxCoeff(), 1e-7 * steel.youngs_modulus) << "per metre";
}

// A neck whose seat is moved against a held barrel is a cantilever: sigma = M r / I.
TEST(RollSurface, TheNeckIsBentAsABeam)
{
  const ComponentSurface &s = component().surface;
  const Eigen::VectorXd q = unit("seat"), stress = s.stress * q;
  const double force   = 0.5 * q.dot(component().K * q);  // N per metre of the seat, at one end of the roll
  const double inertia = M_PI / 4 * std::pow(roll.neck_radius, 4);
  int seen             = 0;
  for (Eigen::Index i = 0; i < s.position.rows(); ++i) {
    const double y = s.position(i, 1), z = s.position(i, 2);
    const bool top = std::abs(y - roll.neck_radius) < 1e-6 && std::abs(s.position(i, 0)) < 1e-6;
    // Off the shoulder by one radius, off the window of the seat, which begins 0.15 m before its centre.
    if (!top || z < roll.half_length + roll.neck_radius || z > roll.seat_centre - 0.15 - 0.5 * roll.neck_radius)
      continue;
    ++seen;
    EXPECT_TRUE(near(stress[6 * i + 2], -force * (roll.seat_centre - z) * y / inertia,
                     within(0.05, "a radius from where the beam ends; three elements per radius")))
        << z;
  }
  EXPECT_GT(seen, 0);
}
