#include "fem/bearing/roller_slices.h"
#include "core/base/errors.h"
#include <cmath>

namespace mill::fem {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// (n_x) shares of a Hertz pressure of this half width, of one side; sums to 1/2.
VectorXd across(const VectorXd &x, const double half_width)
{
  if (half_width > x[x.size() - 1])
    throw InputError("roller: the reference load spreads wider than the mesh of the contact");
  // x = b sin(phi) takes the root out of the ellipse; the shape functions are smooth between the stations.
  constexpr int n = 2000;
  VectorXd w      = VectorXd::Zero(x.size());
  Index e         = 0;
  for (int i = 0; i < n; ++i) {
    const double phi = 0.5 * M_PI * (i + 0.5) / n, place = half_width * std::sin(phi);
    while (e + 2 < x.size() - 1 && place > x[e + 2])
      e += 2;
    const double s = (place - x[e]) / (x[e + 2] - x[e]), share = std::pow(std::cos(phi), 2) / n;
    w.segment<3>(e) += share * Eigen::Vector3d((1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1));
  }
  return w;
}
}  // namespace

bearing::RollerLaw fe_roller_law(const CondensedRoller &roller, const int slices,
                                 const std::function<double(double)> &drop, const double reference_load)
{
  if (slices < 1)
    throw InputError("roller: at least one slice");
  const RollerSetup &s  = roller.setup;
  const PatchGrid &grid = roller.grid;
  const double L = s.contact_length, nu = s.material.poisson_ratio;
  const double body = (1 - nu * nu) / (M_PI * s.material.youngs_modulus);  // of one body, per unit line load
  bearing::RollerLaw law;
  law.slice_length        = L / slices;
  law.kappa               = 4 * body;
  law.reference_line_load = (reference_load > 0 ? reference_load : M_E * s.largest_load) / L;
  law.position.resize(slices);
  law.drop.resize(slices);
  const VectorXd inner = across(grid.x, line_half_width(s, s.inner_radius, law.reference_line_load)),
                 outer = across(grid.x, line_half_width(s, -s.outer_radius, law.reference_line_load));
  const Index n        = grid.area.size();
  MatrixXd spread(2 * n, slices);
  for (int k = 0; k < slices; ++k) {
    const double from    = -0.5 * L + k * law.slice_length;
    law.position[k]      = from + 0.5 * law.slice_length;
    law.drop[k]          = drop ? 2 * drop(law.position[k]) : 0;
    const VectorXd along = axial_weights(grid.z, from, from + law.slice_length, grid.degree) / law.slice_length;
    for (int j = 0; j < grid.n_z; ++j) {
      spread.col(k).segment(j * grid.n_x, grid.n_x)     = along[j] * inner;
      spread.col(k).segment(n + j * grid.n_x, grid.n_x) = along[j] * outer;
    }
  }
  law.influence = 2 * spread.transpose() * (pair_flexibility(roller) * spread);  // both sides of x = 0
  // The mean of the gap x^2 / 2R over a Hertz pressure, b^2 / 8R, is closed too: twice, at both contacts.
  law.influence.diagonal().array() += 2 * body / law.slice_length;
  law.influence = (0.5 * (law.influence + law.influence.transpose())).eval();
  return law;
}
}  // namespace mill::fem
