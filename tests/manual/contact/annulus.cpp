#include "tests/manual/contact/annulus.h"
#include "fem/body/harmonic_body.h"
#include "fem/body/held_stiffness.h"
#include "meshes/common/block.h"
#include <Eigen/LU>
#include <cmath>

namespace mill::verify {
namespace {
constexpr double thickness = 20e-3;  // m, of the slab that is in plane strain
}  // namespace

// Radii are counted in b, displacements in p b / (2 mu).
double inner_displacement(const Annulus &ring, const int m, const Material &material)
{
  const double nu = material.poisson_ratio, kappa = 3 - 4 * nu, s = ring.a / ring.b;
  const double mu = material.youngs_modulus / (2 * (1 + nu));
  if (m == 0) {  // Lame: 2 mu u = A (kappa - 1) r + B / r,  sigma_r = 2 A - B / r^2
    Eigen::Matrix2d M;
    M << 2, -1 / (s * s), ring.held ? kappa - 1 : 2, ring.held ? 1 : -1;
    const Eigen::Vector2d c = M.inverse() * Eigen::Vector2d(-1, 0);
    return ring.b / (2 * mu) * (c[0] * (kappa - 1) * s + c[1] / s);
  }
  // Each column scaled to one at the side where it is largest.
  const double n[4]      = {double(m), double(-m), double(m + 2), double(2 - m)};
  const double ur[4]     = {double(-m), double(m), kappa - m - 1, kappa + m - 1};
  const double utheta[4] = {double(m), double(m), kappa + m + 1, -(kappa - m + 1)};
  Eigen::Matrix4d M;
  Eigen::RowVector4d at_a;
  for (int k = 0; k < 4; ++k) {
    const double scale = n[k] > 0 ? 1 : std::pow(s, -n[k]);
    const auto stress  = [&](const double r) { return scale * std::pow(r, n[k] - 2); };
    const auto motion  = [&](const double r) { return scale * std::pow(r, n[k] - 1); };
    M(0, k)            = (n[k] - m * m) * stress(s);
    M(1, k)            = m * (n[k] - 1) * stress(s);
    M(2, k)            = ring.held ? ur[k] * motion(1) : (n[k] - m * m) * stress(1);
    M(3, k)            = ring.held ? utheta[k] * motion(1) : m * (n[k] - 1) * stress(1);
    at_a[k]            = ur[k] * motion(s);
  }
  const Eigen::Vector4d c = M.fullPivLu().solve(Eigen::Vector4d(-1, 0, 0, 0));
  return ring.b / (2 * mu) * at_a.dot(c);
}

AnnulusByElements::AnnulusByElements(const Annulus &annulus, const Material &material, const int n_elements)
    : ring(annulus), file("annulus"), body(mesh(n_elements), material, 2, fem::Section::axisymmetric)
{
  RacewayLine line;
  line.middle = {ring.a, 0.5 * thickness};
  line.normal = {1, 0};
  line.along  = {0, 1};
  load        = fem::raceway_loads(body, "left", line, thickness, 1, 1);
}

MeshFile AnnulusByElements::mesh(const int n_elements) const
{
  meshes::BlockGrid grid;
  // Elements grow with the depth below the loaded side, as the waves decay.
  for (const double r : meshes::mesh_lines({0, 0, (ring.b - ring.a) / (3. * n_elements), 1.08, ring.b - ring.a}))
    grid.x.push_back(ring.a + r);
  grid.y = meshes::even_lines(0, thickness, 2);
  return meshes::mesh_block(grid, file.path);
}

double AnnulusByElements::displacement(const int m) const
{
  const auto &p = body.nodes();
  std::vector<char> held(std::size_t(3 * p.rows()), 0);
  for (Eigen::Index n = 0; n < p.rows(); ++n) {
    const auto hold = [&](const int c) { held[std::size_t(3 * n + c)] = 1; };
    if (p(n, 1) < 1e-9 || p(n, 1) > thickness - 1e-9)
      hold(2);
    if (m == 0)
      hold(1);
    if (ring.held && p(n, 0) > ring.b * (1 - 1e-9))
      for (const int c : {0, 1, 2})
        hold(c);
  }
  const double per_pressure = (m == 0 ? 2 : 1) * M_PI * ring.a * thickness;
  return per_pressure * fem::HeldStiffness(body.harmonic_stiffness(m), held).flexibility(load)(0, 0);
}

}  // namespace mill::verify
