#include "core/base/errors.h"
#include "fem/body/section_body.h"
#include "tests/support/near.h"
#include <Eigen/SparseCholesky>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <unistd.h>
#include <utility>

using namespace mill;
using fem::Section;
using fem::SectionBody;

namespace {
const Material steel{210e9, 0.3, 7850};
using Map = std::function<Eigen::Vector2d(double s, double t)>;

// n x m quadrilaterals over the unit square of (s, t), mapped; groups left s = 0, right, bottom t = 0, top.
class Grid {
public:
  Grid(const int n, const int m, const Map &map)
  {
    static int serial = 0;
    mesh.path         = (std::filesystem::temp_directory_path() /
                 ("millstand-section-" + std::to_string(getpid()) + "-" + std::to_string(serial++) + ".msh"))
                    .string();
    mesh.groups = {{"left", 1}, {"right", 2}, {"bottom", 3}, {"top", 4}};
    std::ofstream out(mesh.path);
    out.precision(17);
    out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" << (n + 1) * (m + 1) << "\n";
    for (int j = 0; j <= m; ++j)
      for (int i = 0; i <= n; ++i) {
        const Eigen::Vector2d p = map(double(i) / n, double(j) / m);
        out << node(i, j, n) << " " << p[0] << " " << p[1] << " 0\n";
      }
    out << "$EndNodes\n$Elements\n" << n * m + 2 * (n + m) << "\n";
    int e           = 0;
    const auto line = [&](const int group, const int a, const int b) {
      out << ++e << " 1 2 " << group << " " << group << " " << a << " " << b << "\n";
    };
    for (int j = 0; j < m; ++j) {
      line(1, node(0, j, n), node(0, j + 1, n));
      line(2, node(n, j, n), node(n, j + 1, n));
    }
    for (int i = 0; i < n; ++i) {
      line(3, node(i, 0, n), node(i + 1, 0, n));
      line(4, node(i, m, n), node(i + 1, m, n));
    }
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < n; ++i)
        out << ++e << " 3 2 9 9 " << node(i, j, n) << " " << node(i + 1, j, n) << " " << node(i + 1, j + 1, n)
            << " " << node(i, j + 1, n) << "\n";
    out << "$EndElements\n";
  }
  ~Grid()
  {
    std::filesystem::remove(mesh.path);
  }
  MeshFile mesh;

private:
  static int node(const int i, const int j, const int n)
  {
    return j * (n + 1) + i + 1;
  }
};

// A meridian section off the axis with no two sides parallel and no right angle inside.
Eigen::Vector2d skewed(const double s, const double t)
{
  return {0.5 + s + 0.1 * t + 0.2 * s * t, 0.8 * t + 0.15 * s + 0.1 * s * (1 - s) + 0.07 * s * t};
}

Eigen::VectorXd field(const SectionBody &body, const int n_unknowns,
                      const std::function<Eigen::VectorXd(double, double)> &at)
{
  const auto &p = body.nodes();
  Eigen::VectorXd u(n_unknowns * p.rows());
  for (int i = 0; i < p.rows(); ++i)
    u.segment(n_unknowns * i, n_unknowns) = at(p(i, 0), p(i, 1));
  return u;
}

Eigen::VectorXd product(const SymmetricSparse &K, const Eigen::VectorXd &u)
{
  return K.selfadjointView<Eigen::Upper>() * u;
}

// Largest force of K u relative to what the entries of K could make of u.
double force_ratio(const SymmetricSparse &K, const Eigen::VectorXd &u)
{
  const SymmetricSparse size    = K.cwiseAbs();
  const Eigen::VectorXd bounded = size.selfadjointView<Eigen::Upper>() * u.cwiseAbs();
  return product(K, u).cwiseAbs().maxCoeff() / bounded.maxCoeff();
}

std::vector<char> boundary(const SectionBody &body, const int n_unknowns)
{
  std::vector<char> on(n_unknowns * body.nodes().rows(), 0);
  for (const char *name : {"left", "right", "bottom", "top"})
    for (const int node : body.group(name))
      for (int c = 0; c < n_unknowns; ++c)
        on[n_unknowns * node + c] = 1;
  return on;
}

// Displacements under a load with some unknowns held at zero.
Eigen::VectorXd solve(const SymmetricSparse &K, const std::vector<char> &held, Eigen::VectorXd load)
{
  SymmetricSparse A = K;
  for (int j = 0; j < A.outerSize(); ++j)
    for (SymmetricSparse::InnerIterator it(A, j); it; ++it)
      if (held[it.row()] || held[j])
        it.valueRef() = it.row() == j ? 1 : 0;
  for (std::size_t i = 0; i < held.size(); ++i)
    if (held[i])
      load[Eigen::Index(i)] = 0;
  const Eigen::SimplicialLDLT<SymmetricSparse, Eigen::Upper> factor(A);
  return factor.solve(load);
}

// Unit pressure on a group, positive against the outward normal, on its true line: nodal forces along x and y.
Eigen::MatrixX2d pressure_load(const SectionBody &body, const std::string &group)
{
  const Surface s      = body.surface(group);
  Eigen::MatrixX2d out = Eigen::MatrixX2d::Zero(body.nodes().rows(), 2);
  const double g       = std::sqrt(0.6);
  for (int f = 0; f < s.faces.rows(); ++f)
    for (const auto &[t, w] : {std::pair{-g, 5. / 9}, {0., 8. / 9}, {g, 5. / 9}}) {
      const Eigen::Vector3d N(0.5 * t * (t - 1), 1 - t * t, 0.5 * t * (t + 1)), dN(t - 0.5, -2 * t, t + 0.5);
      Eigen::Vector2d tangent = Eigen::Vector2d::Zero(), at = tangent;
      for (int a = 0; a < 3; ++a) {
        tangent += dN[a] * s.points.row(s.faces(f, a)).transpose();
        at += N[a] * s.points.row(s.faces(f, a)).transpose();
      }
      const double measure = s.axisymmetric ? 2 * M_PI * at[0] : 1;
      for (int a = 0; a < 3; ++a)  // the body is on the left of the line: this normal points into it
        out.row(s.node[s.faces(f, a)]) += w * measure * N[a] * Eigen::RowVector2d(-tangent[1], tangent[0]);
    }
  return out;
}

Eigen::VectorXd interleaved(const Eigen::MatrixX2d &load)
{
  Eigen::VectorXd out(2 * load.rows());
  for (int i = 0; i < load.rows(); ++i)
    out.segment<2>(2 * i) = load.row(i);
  return out;
}

// Radial displacement of a thick ring under inner pressure p, plane strain: Lame.
double lame(const double r, const double a, const double b, const double p)
{
  const double E = steel.youngs_modulus, nu = steel.poisson_ratio;
  return p * a * a * (1 + nu) / (E * (b * b - a * a)) * ((1 - 2 * nu) * r + b * b / r);
}
}  // namespace

class SectionDegree : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Both, SectionDegree, testing::Values(1, 2));

TEST_P(SectionDegree, RigidMotionsOfAPlaneSectionCarryNoForce)
{
  const Grid grid(4, 3, skewed);
  const SectionBody body(grid.mesh, steel, GetParam(), Section::plane_strain);
  for (const auto &position : std::vector<std::function<Eigen::VectorXd(double, double)>>{
           [](double, double) { return Eigen::Vector2d(1, 0); },
           [](double, double) { return Eigen::Vector2d(0, 1); },
           [](double x, double y) { return Eigen::Vector2d(-y, x); }})
    EXPECT_LT(force_ratio(body.stiffness(), field(body, 2, position)), 1e-14);
}

TEST_P(SectionDegree, UniformPlaneStrainIsInEquilibriumAndHasItsEnergy)
{
  const Grid grid(4, 3, skewed);
  const SectionBody body(grid.mesh, steel, GetParam(), Section::plane_strain);
  const double xx = 1e-3, yy = -4e-4, xy = 7e-4;  // tensor strains
  const Eigen::VectorXd u = field(body, 2, [&](double x, double y) {
    return Eigen::Vector2d(xx * x + 2 * xy * y, yy * y);  // shear all in one: rotation must not matter
  });
  const Eigen::VectorXd f = product(body.stiffness(), u);
  const auto on           = boundary(body, 2);
  double inside           = 0;
  for (int i = 0; i < f.size(); ++i)
    inside = std::max(inside, on[i] ? 0 : std::abs(f[i]));
  EXPECT_LT(inside, 1e-12 * f.cwiseAbs().maxCoeff());
  const double E = steel.youngs_modulus, nu = steel.poisson_ratio, mu = E / (2 * (1 + nu)),
               lambda  = E * nu / ((1 + nu) * (1 - 2 * nu));
  const double density = 0.5 * lambda * std::pow(xx + yy, 2) + mu * (xx * xx + yy * yy + 2 * xy * xy);
  EXPECT_TRUE(near(0.5 * u.dot(f), density * body.measure(), within(1e-12, "uniform strain is in the space")));
}

TEST_P(SectionDegree, UniformRingStrainHasItsEnergyOverTheCircumference)
{
  const Grid grid(4, 3, skewed);
  const SectionBody body(grid.mesh, steel, GetParam(), Section::axisymmetric);
  const double radial = 5e-4, axial = -2e-4;
  const Eigen::VectorXd u =
      field(body, 2, [&](double r, double z) { return Eigen::Vector2d(radial * r, axial * z); });
  const double E = steel.youngs_modulus, nu = steel.poisson_ratio, mu = E / (2 * (1 + nu)),
               lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
  const double density =
      0.5 * lambda * std::pow(2 * radial + axial, 2) + mu * (2 * radial * radial + axial * axial);
  EXPECT_TRUE(near(0.5 * u.dot(product(body.stiffness(), u)), density * body.measure(),
                   within(1e-12, "uniform strain is in the space, the rule integrates it")));
  EXPECT_LT(force_ratio(body.stiffness(), field(body, 2, [](double, double) { return Eigen::Vector2d(0, 1); })),
            1e-14);
}

TEST_P(SectionDegree, MeasureOfAConeFrustum)
{
  const Grid grid(3, 2, [](double s, double t) { return Eigen::Vector2d(s * (1 + t), 3 * t); });
  const SectionBody body(grid.mesh, steel, GetParam(), Section::axisymmetric);
  EXPECT_TRUE(near(body.measure(), M_PI * 3 / 3. * (1 + 2 + 4), within(1e-13, "a polynomial of degree 2")));
  const SectionBody flat(grid.mesh, steel, GetParam(), Section::plane_strain);
  EXPECT_TRUE(near(flat.measure(), 4.5, within(1e-13, "trapezium")));
}

TEST_P(SectionDegree, RigidMotionsInHarmonicsZeroAndOneCarryNoForce)
{
  const Grid grid(4, 3, skewed);
  const SectionBody body(grid.mesh, steel, GetParam(), Section::axisymmetric);
  using At       = std::function<Eigen::VectorXd(double, double)>;
  const At axial = [](double, double) { return Eigen::Vector3d(0, 0, 1); };
  const At twist = [](double r, double) { return Eigen::Vector3d(0, r, 0); };
  const At shift = [](double, double) { return Eigen::Vector3d(1, -1, 0); };       // along x
  const At tilt  = [](double r, double z) { return Eigen::Vector3d(z, -z, -r); };  // about y
  EXPECT_LT(force_ratio(body.harmonic_stiffness(0), field(body, 3, axial)), 1e-14);
  EXPECT_LT(force_ratio(body.harmonic_stiffness(0), field(body, 3, twist)), 1e-14);
  EXPECT_LT(force_ratio(body.harmonic_stiffness(1), field(body, 3, shift)), 1e-14);
  EXPECT_LT(force_ratio(body.harmonic_stiffness(1), field(body, 3, tilt)), 1e-14);
  // No other harmonic knows them.
  EXPECT_GT(force_ratio(body.harmonic_stiffness(2), field(body, 3, shift)), 1e-3);
  EXPECT_GT(force_ratio(body.harmonic_stiffness(1), field(body, 3, axial)), 1e-3);
}

TEST_P(SectionDegree, UniformStrainAcrossTheAxisIsSpreadOverHarmonicsZeroAndTwo)
{
  // u_x = e x alone: U = e r (1 + cos 2 theta) / 2, V = -e r sin 2 theta / 2.  Its energy is the uniform one.
  const Grid grid(4, 3, skewed);
  const SectionBody body(grid.mesh, steel, GetParam(), Section::axisymmetric);
  const double e = 1e-3, E = steel.youngs_modulus, nu = steel.poisson_ratio, mu = E / (2 * (1 + nu)),
               lambda        = E * nu / ((1 + nu) * (1 - 2 * nu));
  const Eigen::VectorXd zero = field(body, 3, [&](double r, double) { return Eigen::Vector3d(e * r / 2, 0, 0); }),
                        two  = field(body, 3,
                                     [&](double r, double) { return Eigen::Vector3d(e * r / 2, -e * r / 2, 0); });
  const double energy        = 0.5 * zero.dot(product(body.harmonic_stiffness(0), zero)) +
                        0.5 * two.dot(product(body.harmonic_stiffness(2), two));
  EXPECT_TRUE(near(energy, (0.5 * lambda + mu) * e * e * body.measure(),
                   within(1e-12, "both fields are in the space, harmonics are orthogonal")));
}

TEST_P(SectionDegree, HarmonicZeroIsTheRingAndATwist)
{
  const Grid grid(3, 3, skewed);
  const SectionBody body(grid.mesh, steel, GetParam(), Section::axisymmetric);
  const SymmetricSparse K = body.stiffness(), H = body.harmonic_stiffness(0);
  const int n          = int(body.nodes().rows());
  const double largest = K.coeffs().abs().maxCoeff();
  double difference = 0, coupling = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int c = 0; c < 2; ++c) {
        for (int d = 0; d < 2; ++d)
          difference = std::max(difference,
                                std::abs(K.coeff(2 * i + c, 2 * j + d) - H.coeff(3 * i + 2 * c, 3 * j + 2 * d)));
        coupling = std::max(
            {coupling, std::abs(H.coeff(3 * i + 2 * c, 3 * j + 1)), std::abs(H.coeff(3 * i + 1, 3 * j + 2 * c))});
      }
  EXPECT_LT(difference, 1e-14 * largest);
  EXPECT_LT(coupling, 1e-14 * largest);
}

TEST(SectionBody, ThickRingUnderPressurePlaneStrain)
{
  const double a = 0.2, b = 0.5, p = 1e8;
  const Grid grid(8, 12, [&](double s, double t) {
    const double r = a * std::pow(b / a, s), angle = M_PI / 2 * t;  // the field varies as 1/r
    return Eigen::Vector2d(r * std::cos(angle), r * std::sin(angle));
  });
  const SectionBody body(grid.mesh, steel, 2, Section::plane_strain, {{"left", {0, 0}, a}, {"right", {0, 0}, b}});
  EXPECT_TRUE(near(body.measure(), M_PI / 4 * (b * b - a * a),
                   within(1e-5, "arcs of 7.5 degrees by parabolas through three true points")));
  std::vector<char> held(2 * body.nodes().rows(), 0);
  for (const int node : body.group("bottom"))
    held[2 * node + 1] = 1;
  for (const int node : body.group("top"))
    held[2 * node] = 1;
  const Eigen::VectorXd u = solve(body.stiffness(), held, p * interleaved(pressure_load(body, "left")));
  for (const auto &[group, r] : {std::pair{"left", a}, {"right", b}})
    for (const int node : body.group(group)) {
      EXPECT_TRUE(near(body.nodes().row(node).norm(), r,
                       within_absolute(1e-14, "m, nodes are put on the circle, rounding")))
          << "every node of the group is on the circle";
      EXPECT_TRUE(
          near(u.segment<2>(2 * node).norm(), lame(r, a, b, p),
               within(1e-4, "quadratic elements, 8 over the wall, 7.5 degrees each: energy error of order h^4")));
    }
}

TEST(SectionBody, ThickRingUnderPressureAxisymmetric)
{
  const double a = 0.2, b = 0.5, p = 1e8;
  const Grid grid(8, 1,
                  [&](double s, double t) { return Eigen::Vector2d(a + (b - a) * s * (0.6 + 0.4 * s), 0.1 * t); });
  const SectionBody body(grid.mesh, steel, 2, Section::axisymmetric);
  std::vector<char> held(2 * body.nodes().rows(), 0);
  for (const char *face : {"bottom", "top"})
    for (const int node : body.group(face))
      held[2 * node + 1] = 1;
  const Eigen::VectorXd u = solve(body.stiffness(), held, p * interleaved(pressure_load(body, "left")));
  for (const auto &[group, r] : {std::pair{"left", a}, {"right", b}})
    for (const int node : body.group(group))
      EXPECT_TRUE(near(u[2 * node], lame(r, a, b, p), within(1e-4, "quadratic elements, 8 over the wall")));
}

TEST(SectionBody, SolidCylinderUnderAHarmonicPressure)
{
  // Traction cos(m theta) on a solid cylinder in plane strain, from the complex potentials A z^(m+1), B z^(m-1):
  //     u_r = R / (4 mu) [ (3 - 4 nu) / (m + 1) + 1 / (m - 1) ] cos(m theta)
  const double R = 0.3;
  const Grid grid(16, 1, [&](double s, double t) { return Eigen::Vector2d(R * s * (2 - s), 0.05 * t); });
  const SectionBody body(grid.mesh, steel, 2, Section::axisymmetric);
  for (const int m : {2, 3, 6}) {
    std::vector<char> held(3 * body.nodes().rows(), 0);
    for (const char *face : {"bottom", "top"})
      for (const int node : body.group(face))
        held[3 * node + 2] = 1;
    for (const int node : body.group("left"))
      held[3 * node] = held[3 * node + 1] = held[3 * node + 2] = 1;
    Eigen::VectorXd load         = Eigen::VectorXd::Zero(3 * body.nodes().rows());
    const Eigen::MatrixX2d whole = pressure_load(body, "right");
    for (int i = 0; i < whole.rows(); ++i)
      load[3 * i] = -0.5 * whole(i, 0);  // outwards; integral of cos^2 is half the circumference
    const Eigen::VectorXd u = solve(body.harmonic_stiffness(m), held, load);
    const double nu = steel.poisson_ratio, mu = steel.youngs_modulus / (2 * (1 + nu));
    const double exact = R / (4 * mu) * ((3 - 4 * nu) / (m + 1) + 1. / (m - 1));
    for (const int node : body.group("right"))
      EXPECT_TRUE(near(u[3 * node], exact, within(1e-4, "quadratic elements, 16 along the radius")));
  }
}

TEST(SectionBody, SurfaceRunsWithTheBodyOnItsLeft)
{
  const Grid grid(3, 5, skewed);
  for (const int degree : {1, 2}) {
    const SectionBody body(grid.mesh, steel, degree, Section::axisymmetric);
    for (const auto &[name, cells] : {std::pair{"left", 5}, {"right", 5}, {"bottom", 3}, {"top", 3}}) {
      const Surface s = body.surface(name);
      EXPECT_TRUE(s.axisymmetric);
      EXPECT_TRUE(std::is_sorted(s.node.begin(), s.node.end()));
      ASSERT_EQ(s.faces.rows(), cells);
      ASSERT_EQ(s.faces.cols(), degree + 1);
      EXPECT_EQ(int(s.node.size()), cells * degree + 1);
      const Eigen::Vector2d centre = body.nodes().colwise().mean();
      for (int f = 0; f < cells; ++f) {
        const Eigen::Vector2d from = s.points.row(s.faces(f, 0)), to = s.points.row(s.faces(f, degree));
        const Eigen::Vector2d run = to - from, in = centre - from;
        EXPECT_GT(run[0] * in[1] - run[1] * in[0], 0) << name;
        if (degree == 2) {
          const Eigen::Vector2d middle = s.points.row(s.faces(f, 1));
          EXPECT_LT((middle - 0.5 * (from + to)).norm(), 1e-15);
        }
      }
      for (std::size_t i = 0; i < s.node.size(); ++i)
        EXPECT_EQ(s.points.row(int(i)), body.nodes().row(s.node[i]));
    }
  }
}

TEST(SectionBody, RefusesWhatItCannotRead)
{
  MeshFile missing;
  missing.path = "no-such-mesh.msh";
  EXPECT_THROW(SectionBody(missing, steel, 2, Section::plane_strain), InputError);
  const Grid grid(2, 2, skewed);
  {
    std::ofstream spoiled(grid.mesh.path, std::ios::trunc);
    spoiled << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\nnot a number\n";
  }
  EXPECT_THROW(SectionBody(grid.mesh, steel, 2, Section::plane_strain), InputError);
  const Grid good(2, 2, skewed);
  const SectionBody plane(good.mesh, steel, 1, Section::plane_strain);
  EXPECT_THROW(plane.harmonic_stiffness(1), std::logic_error);
}
