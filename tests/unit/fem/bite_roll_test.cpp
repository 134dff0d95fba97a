#include "core/base/errors.h"
#include "fem/strip/bite_roll.h"
#include "meshes/roll/bite_roll.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <cmath>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace mill;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {
constexpr double mm = 1e-3;

meshes::BiteRollSize coarse_size()
{
  meshes::BiteRollSize size;
  size.radius  = 210 * mm;
  size.arc     = 25.1 * mm;
  size.spacing = 0.15;
  return size;
}

fem::BiteRoll roll_of(const meshes::BiteRollSize &size)
{
  fem::BiteRoll roll;
  roll.radius            = size.radius;
  roll.arc               = size.arc;
  roll.backup_half_width = 6 * mm;
  const auto points      = meshes::arc_points(size);
  roll.position          = Eigen::Map<const VectorXd>(points.data(), Index(points.size()));
  return roll;
}

class Mesh {
public:
  explicit Mesh(const meshes::BiteRollSize &size)
      : path((std::filesystem::temp_directory_path() /
              ("millstand-bite-roll-" + std::to_string(::getpid()) + ".msh"))
                 .string()),
        file(meshes::mesh_bite_roll(size, path))
  {
  }
  ~Mesh()
  {
    std::filesystem::remove(path);
  }
  Mesh(const Mesh &) = delete;
  std::string path;
  MeshFile file;
};

}  // namespace

TEST(BiteRoll, PointsAreSymmetricAndGrowOutward)
{
  const auto size = coarse_size();
  const auto x    = meshes::arc_points(size);
  ASSERT_EQ(x.size() % 2, 1u);
  EXPECT_EQ(x[x.size() / 2], 0);
  EXPECT_DOUBLE_EQ(x.back(), size.reach * size.arc);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_EQ(x[i], -x[x.size() - 1 - i]);
    if (i > 0 && i + 1 < x.size() && x[i] > 0)
      EXPECT_GE(x[i + 1] - x[i], (x[i] - x[i - 1]) * (1 - 1e-12)) << i;  // rounding of the subdivision
  }
}

TEST(BiteRoll, MeshIsSoundForLongAndShortArcs)
{
  for (const double arc : {1 * mm, 6 * mm, 55 * mm}) {
    auto size = coarse_size();
    size.arc  = arc;
    const Mesh mesh(size);
    EXPECT_GT(mesh.file.smallest_jacobian, 0.05) << arc;
    EXPECT_EQ(mesh.file.groups.count("surface") + mesh.file.groups.count("symmetry.x") +
                  mesh.file.groups.count("symmetry.y"),
              3u);
  }
}

// Mirror image of load and shape; pressure at every point pushes itself in; the far side of the arc deflects
// less.
TEST(BiteRoll, InfluenceIsMirroredAndPositive)
{
  const auto size = coarse_size();
  const Mesh mesh(size);
  auto roll         = roll_of(size);
  roll.with_shear   = true;
  const auto r      = fem::bite_roll_flexibility(roll, mesh.file);
  const MatrixXd &C = r.flexibility.influence;
  const Index n     = roll.position.size();
  ASSERT_EQ(C.rows(), n);
  ASSERT_EQ(C.cols(), n);
  const double size_c = C.cwiseAbs().maxCoeff(), size_s = r.shear_influence.cwiseAbs().maxCoeff();
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      EXPECT_TRUE(near(C(i, j), C(n - 1 - i, n - 1 - j),
                       within_absolute(1e-13 * size_c, "a symmetric mesh: the same sums in another order")));
      EXPECT_TRUE(near(r.shear_influence(i, j), -r.shear_influence(n - 1 - i, n - 1 - j),
                       within_absolute(1e-13 * size_s, "a symmetric mesh: the same sums in another order")));
      EXPECT_GT(C(i, j), 0);
    }
  EXPECT_GT(C(n / 2, n / 2), C(n / 2 + 5, n / 2));
  EXPECT_EQ(r.error_estimate, 0);
  EXPECT_EQ(r.flexibility.method,
            "finite elements of the roll's section, " + std::to_string(r.n_unknowns) + " unknowns");
}

// Work of one pressure along the displacement by another, Betti's theorem.  Displacements are read at points and
// not averaged over the hats, so it holds to the order of the spacing squared.
TEST(BiteRoll, WorkOfTwoPressuresIsReciprocal)
{
  const auto size = coarse_size();
  const Mesh mesh(size);
  const auto roll      = roll_of(size);
  const MatrixXd C     = fem::bite_roll_flexibility(roll, mesh.file).flexibility.influence;
  const VectorXd &x    = roll.position;
  const VectorXd share = x / size.arc, p = (1 - (share.array() - 0.4).square()).max(0.),
                 q = (1 - (2 * share.array() + 0.7).square()).max(0.);
  VectorXd weight  = VectorXd::Zero(x.size());
  for (Index i = 0; i + 1 < x.size(); ++i) {
    weight[i] += 0.5 * (x[i + 1] - x[i]);
    weight[i + 1] += 0.5 * (x[i + 1] - x[i]);
  }
  // per length of the arc, ds = dx / cos
  weight.array() /= (1 - (x.array() / size.radius).square()).sqrt();
  const double a = (weight.cwiseProduct(q)).dot(C * p), b = (weight.cwiseProduct(p)).dot(C * q);
  EXPECT_TRUE(
      near(a / b, 1,
           within(2e-3, "displacements at points and not means over the hats: order of the spacing squared")));
}

// What carries the roll moves it bodily and hardly changes its shape at the strip (Saint-Venant).
TEST(BiteRoll, SupportFarAwayDoesNotShapeTheArc)
{
  const auto size = coarse_size();
  const Mesh mesh(size);
  auto roll              = roll_of(size);
  const auto wide        = fem::bite_roll_flexibility(roll, mesh.file).flexibility;
  roll.backup_half_width = 0;
  const auto necks       = fem::bite_roll_flexibility(roll, mesh.file).flexibility;
  const double change    = fem::arc_difference(wide, necks, size.arc);
  EXPECT_LT(change, 0.01);  // (arc / radius)^2 is 0.014
  EXPECT_GT(change, 0);
  const Index middle = roll.position.size() / 2;
  EXPECT_GT(std::abs(wide.influence(middle, middle) / necks.influence(middle, middle) - 1), 1e-4);
}

TEST(BiteRoll, ErrorEstimateFallsWithTheMesh)
{
  auto fine_size                 = coarse_size();
  const auto size                = coarse_size();
  fine_size.elements_per_spacing = 2;
  const Mesh coarse(size);
  const MeshFile kept     = coarse.file;
  const std::string aside = coarse.path + ".kept.msh";
  std::filesystem::copy_file(coarse.path, aside, std::filesystem::copy_options::overwrite_existing);
  MeshFile second = kept;
  second.path     = aside;
  const Mesh fine(fine_size);
  const auto r = fem::bite_roll_flexibility(roll_of(size), fine.file, &second);
  std::filesystem::remove(aside);
  EXPECT_GT(r.error_estimate, 0);
  EXPECT_LT(r.error_estimate, 2e-3);  // elements of 0.15 arc; 4e-4 at the default 0.04
}

TEST(BiteRoll, WhatIsRefused)
{
  auto size = coarse_size();
  size.arc  = 80 * mm;
  EXPECT_EQ(
      refusal([&] { meshes::arc_points(size); }),
      "roll in the bite: points up to 192 mm on a roll of radius 210 mm; an arc that reaches past 135 mm (40 "
      "degrees) is not one of rolling strip: reduce the reach or the draft");
  size.arc = 0;
  EXPECT_EQ(refusal([&] { meshes::arc_points(size); }),
            "roll in the bite: radius, arc, spacing < fine < reach must be positive and growth at least 1");
  const auto good = coarse_size();
  const Mesh mesh(good);
  auto roll              = roll_of(good);
  roll.backup_half_width = 150 * mm;
  EXPECT_EQ(refusal([&] { fem::bite_roll_flexibility(roll, mesh.file); }),
            "roll in the bite: the contact with the back-up roll must be narrower than half the radius");
  roll             = roll_of(good);
  roll.position[0] = -2 * roll.position[roll.position.size() - 1];
  EXPECT_EQ(refusal([&] { fem::bite_roll_flexibility(roll, mesh.file); }),
            "roll in the bite: the points of the arc must rise and be symmetric about the line of centres");
  roll.position = VectorXd::LinSpaced(4, -1, 1);
  EXPECT_EQ(refusal([&] { fem::bite_roll_flexibility(roll, mesh.file); }),
            "roll in the bite: the arc needs an odd number of points, three at least, one of them on the line of "
            "centres");
  const auto a = fem::bite_roll_flexibility(roll_of(good), mesh.file).flexibility;
  auto b       = a;
  b.position *= 1.1;
  EXPECT_EQ(refusal([&] { fem::arc_difference(a, b, good.arc); }),
            "roll in the bite: two flexibilities can only be compared at the same points");
}
