// Coupling of non-matching surface grids: what multipliers transmit, in the plane and in space.
#include "core/base/errors.h"
#include "fem/contact/mortar.h"
#include "tests/support/near.h"
#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace mill;

namespace {
// A line through n_faces faces of given degree, x from a to b, lifted by a profile; runs towards +x, so the body
// that lies on its left is above it.
template <class Profile>
Surface line(const double a, const double b, const int n_faces, const int degree, const unsigned seed,
             const Profile &profile)
{
  Surface s;
  const int n = n_faces * degree + 1;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shake(-0.3, 0.3);
  Eigen::VectorXd corner(n_faces + 1);
  for (int i = 0; i <= n_faces; ++i)
    corner[i] = a + (b - a) * (i + (i > 0 && i < n_faces ? shake(random) : 0)) / n_faces;
  s.points.resize(n, 2);
  s.faces.resize(n_faces, degree + 1);
  for (int f = 0; f < n_faces; ++f)
    for (int k = 0; k <= degree; ++k) {
      const double x = corner[f] + (corner[f + 1] - corner[f]) * k / degree;
      s.points.row(f * degree + k) << x, profile(x);
      s.faces(f, k) = f * degree + k;
    }
  for (int i = 0; i < n; ++i)
    s.node.push_back(i);
  return s;
}

double flat(double)
{
  return 0;
}

// The same line seen from the body below it.
Surface below(const Surface &line)
{
  return contact::placed(line, Eigen::Vector2d(1, -1).asDiagonal(), Eigen::Vector2d::Zero());
}

// n x m quadrilaterals in the plane z = 0 with normal +z; mesh lines are shaken, or each corner alone
// (general quadrilaterals); then turned about z.
Surface sheet(const double a, const double b, const int n, const int m, const int degree, const unsigned seed,
              const double angle = 0, const bool general = false)
{
  const int nx = n * degree + 1, ny = m * degree + 1;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shake(-0.2, 0.2);
  Eigen::MatrixXd corner((n + 1) * (m + 1), 2);
  std::vector<double> column(n + 1), row(m + 1);
  for (double &c : column)
    c = shake(random);
  for (double &r : row)
    r = shake(random);
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= n; ++i) {
      const double dx = i > 0 && i < n ? (general ? shake(random) : column[i]) : 0,
                   dy = j > 0 && j < m ? (general ? shake(random) : row[j]) : 0;
      corner.row(j * (n + 1) + i) << a + (b - a) * (i + dx) / n, a + (b - a) * (j + dy) / m;
    }
  Surface s;
  s.points.setZero(nx * ny, 3);
  s.faces.resize(n * m, (degree + 1) * (degree + 1));
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i)
      for (int l = 0; l <= degree; ++l)
        for (int k = 0; k <= degree; ++k) {
          const double u = double(k) / degree, v = double(l) / degree;
          const int node = (j * degree + l) * nx + i * degree + k;
          s.points.row(node).head(2) =
              (1 - u) * (1 - v) * corner.row(j * (n + 1) + i) + u * (1 - v) * corner.row(j * (n + 1) + i + 1) +
              (1 - u) * v * corner.row((j + 1) * (n + 1) + i) + u * v * corner.row((j + 1) * (n + 1) + i + 1);
          s.faces(j * n + i, l * (degree + 1) + k) = node;
        }
  for (int i = 0; i < nx * ny; ++i)
    s.node.push_back(i);
  return contact::placed(s, Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
                         Eigen::Vector3d::Zero());
}

Surface upside_down(const Surface &sheet)
{
  return contact::placed(sheet, Eigen::Vector3d(1, 1, -1).asDiagonal(), Eigen::Vector3d::Zero());
}

// Integral of each shape function: what a unit pressure puts on the nodes.
Eigen::VectorXd shares(const Surface &s)
{
  const auto c = contact::couple_to_rigid(s);
  return c.slave.transpose() * c.weight;
}

const auto rounding = within(1e-11,
                             "every integrand is a polynomial that the rule integrates exactly; rounding of "
                             "some hundred terms and of a Gram matrix of condition about 1e3",
                             1);
}  // namespace

TEST(Mortar, AUniformPressureArrivesAsAUniformPressureInThePlane)
{
  for (const bool ring : {false, true})
    for (const int slave_degree : {1, 2})
      for (const int master_degree : {1, 2}) {
        Surface slave      = line(0, 2, 7, slave_degree, 1, flat),
                master     = below(line(0, 2, 5, master_degree, 2, flat));
        slave.axisymmetric = master.axisymmetric = ring;
        const auto c                             = contact::couple(slave, master);
        EXPECT_TRUE(near(c.covered, 1, rounding));
        EXPECT_GT(c.weight.minCoeff(), 0);
        const Eigen::VectorXd on_slave  = c.slave.transpose() * c.weight,
                              on_master = c.master.transpose() * c.weight;
        const Eigen::VectorXd s = shares(slave), m = shares(master);
        for (int i = 0; i < s.size(); ++i)
          EXPECT_TRUE(near(on_slave[i], s[i], rounding)) << "slave " << slave_degree << " ring " << ring;
        for (int i = 0; i < m.size(); ++i)
          EXPECT_TRUE(near(on_master[i], m[i], rounding)) << "master " << master_degree << " ring " << ring;
      }
}

TEST(Mortar, ALinearDisplacementIsCarriedOverExactly)
{
  for (const int degree : {1, 2}) {
    const Surface slave = line(0, 2, 7, degree, 1, flat), master = below(line(0, 2, 5, degree, 2, flat));
    const auto c                = contact::couple(slave, master);
    const Eigen::VectorXd there = c.slave * slave.points.col(0), here = c.master * master.points.col(0),
                          mean = c.mean * c.points.col(0);
    for (int i = 0; i < there.size(); ++i) {
      EXPECT_TRUE(near(here[i], there[i], rounding));
      EXPECT_TRUE(near(mean[i], there[i], rounding));
    }
  }
}

TEST(Mortar, AUniformPressureArrivesInSpaceOnShakenAndTurnedGrids)
{
  for (const int slave_degree : {1, 2})
    for (const int master_degree : {1, 2}) {
      // The master reaches beyond the slave, so only the slave's shares and the total are known.
      const Surface slave  = sheet(-1, 1, 3, 4, slave_degree, 3),
                    master = upside_down(sheet(-2, 2, 4, 5, master_degree, 4, 0.3));
      const auto c         = contact::couple(slave, master);
      EXPECT_TRUE(near(c.covered, 1, rounding));
      const Eigen::VectorXd on_slave = c.slave.transpose() * c.weight, on_master = c.master.transpose() * c.weight;
      const Eigen::VectorXd s = shares(slave);
      for (int i = 0; i < s.size(); ++i)
        EXPECT_TRUE(near(on_slave[i], s[i], rounding)) << slave_degree << master_degree;
      EXPECT_TRUE(near(on_master.sum(), 4, rounding));
      // Moments: the same resultant on both sides.
      for (const int axis : {0, 1})
        EXPECT_TRUE(near(on_master.dot(master.points.col(axis)), on_slave.dot(slave.points.col(axis)), rounding));
    }
}

TEST(Mortar, EqualSheetsInSpaceShareEveryNodesForce)
{
  for (const bool general : {false, true})
    for (const int degree : {1, 2}) {
      const Surface slave       = sheet(0, 2, 3, 3, degree, 5, 0.2, general),
                    master      = upside_down(sheet(0, 2, 4, 4, degree, 6, 0.2, general));
      const auto c              = contact::couple(slave, master);
      const Eigen::VectorXd got = c.master.transpose() * c.weight, m = shares(master);
      for (int i = 0; i < m.size(); ++i)
        EXPECT_TRUE(near(got[i], m[i],
                         general ? within(1e-7,
                                          "parameters of a general quadrilateral are no polynomials of the "
                                          "place: the rule leaves 1e-9 at a distortion of 20 %",
                                          1)
                                 : rounding));
    }
}

TEST(Mortar, APartlyCoveredSlaveHasPositiveWeightsAndTheWholeForce)
{
  for (const int degree : {1, 2})
    for (const double end : {0.53, 0.75, 1.0001, 1.9}) {
      const Surface slave = line(0, 2, 2, degree, 1, flat), master = below(line(0, end, 3, degree, 2, flat));
      const auto c = contact::couple(slave, master);
      EXPECT_TRUE(near(c.covered, end / 2, rounding));
      EXPECT_GT(c.weight.minCoeff(), 0) << degree << " " << end;
      EXPECT_LE(c.node.size(), std::size_t(2 * degree + 1));
      const Eigen::VectorXd m = shares(master), got = c.master.transpose() * c.weight;
      for (int i = 0; i < m.size(); ++i)
        EXPECT_TRUE(near(got[i], m[i], rounding)) << degree << " " << end;
      EXPECT_TRUE(near((c.slave.transpose() * c.weight).dot(slave.points.col(0)), 0.5 * end * end, rounding));
    }
}

TEST(Mortar, APartlyCoveredSheetInSpaceKeepsForceAndMoments)
{
  for (const int degree : {1, 2}) {
    // The master covers the square -0.7 .. 0.7 of the slave's -1 .. 1, turned by 0.3.
    const Surface slave  = sheet(-1, 1, 3, 3, degree, 8),
                  master = upside_down(sheet(-0.7, 0.7, 3, 2, degree, 9, 0.3));
    const auto c         = contact::couple(slave, master);
    EXPECT_TRUE(near(c.covered, 0.49, rounding));
    EXPECT_GT(c.weight.minCoeff(), 0);
    const Eigen::VectorXd on_slave = c.slave.transpose() * c.weight, on_master = c.master.transpose() * c.weight,
                          m = shares(master);
    for (int i = 0; i < m.size(); ++i)
      EXPECT_TRUE(near(on_master[i], m[i], rounding)) << degree;
    EXPECT_TRUE(near(on_slave.sum(), 1.96, rounding));
    for (const int axis : {0, 1})
      EXPECT_TRUE(near(on_slave.dot(slave.points.col(axis)), on_master.dot(master.points.col(axis)), rounding));
  }
}

TEST(Mortar, MatchingGridsAreCoupledNodeByNode)
{
  const Surface slave = sheet(0, 1, 3, 3, 2, 7), master = upside_down(slave);
  const auto c = contact::couple(slave, master);
  EXPECT_LT((Eigen::MatrixXd(c.master) - Eigen::MatrixXd::Identity(49, 49)).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_LT((Eigen::MatrixXd(c.slave) - Eigen::MatrixXd::Identity(49, 49)).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(Mortar, GapAndNormalsOfCircles)
{
  // Outer circle of radius 1 with the body outside, inner one of radius 0.9 with the body inside.
  const auto arc = [](const double radius, const int n_faces, const bool body_inside) {
    Surface s;
    const int n = 2 * n_faces + 1;
    s.points.resize(n, 2);
    s.faces.resize(n_faces, 3);
    for (int i = 0; i < n; ++i)
      s.points.row(i) << radius * std::cos(0.5 * M_PI * i / (n - 1)), radius * std::sin(0.5 * M_PI * i / (n - 1));
    for (int f = 0; f < n_faces; ++f)
      for (int k = 0; k < 3; ++k)  // counter-clockwise has the inside on its left
        s.faces(f, k) = 2 * f + (body_inside ? k : 2 - k);
    return s;
  };
  const Surface outer = arc(1, 9, false), inner = arc(0.9, 7, true);
  const Eigen::MatrixXd n = contact::nodal_normals(outer);
  for (int i = 0; i < n.rows(); ++i)
    EXPECT_TRUE(
        near(n.row(i).dot(outer.points.row(i)), -1,
             within(1e-4, "a quadratic edge of 10 degrees turns by h^2/24 = 1e-3 too little at its end, and "
                          "the cosine of that is wrong by 1e-6; one-sided at the two ends of the arc")));
  const auto c = contact::couple(outer, inner);
  EXPECT_TRUE(near(c.covered, 1, within(1e-3, "the one-sided normals at the ends of the arc miss the last bit")));
  for (int q = 0; q < c.gap.size(); ++q)
    EXPECT_TRUE(near(c.gap[q], 0.1,
                     within(1e-4, "quadratic edges leave a circle by R t^3/72 with t = 0.087 and 0.112 "
                                  "half an edge: 2e-5 of 0.1")));
}

TEST(Mortar, SurfacesThatDoNotFaceEachOtherAreAnError)
{
  const Surface slave = line(0, 1, 3, 1, 1, flat), same = line(0, 1, 3, 1, 1, flat),
                away = below(line(5, 6, 3, 1, 1, flat));
  EXPECT_THROW(contact::couple(slave, same), InputError);
  EXPECT_THROW(contact::couple(slave, away), InputError);
}
