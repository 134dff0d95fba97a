#include "core/numerics/gauss.h"
#include "fem/housing/housing_component.h"
#include "reduce/chain/screwdown.h"
#include "tests/manual/stand/housing_models.h"
#include <Eigen/Dense>
#include <cmath>

namespace mill::verify {
namespace {
// ---- housing-component ----------------------------------------------------------------------------------------

Eigen::VectorXd frequencies(const Component &c)
{
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(c.K, c.M, Eigen::EigenvaluesOnly);
  return modes.eigenvalues().cwiseSqrt() / (2 * M_PI);
}
}  // namespace

std::vector<Check> housing_component_checks()
{
  const MillHousing h = demo_housing();
  const auto body     = meshed(h, {2, 1, 0});
  const auto kept     = [&](const fem::ElasticBody &on, const int n) {
    fem::HousingComponentOptions options;
    options.n_modes = n;
    return fem::housing_component(h, on, options);
  };
  // The whole model: nothing held but the feet's mean, so that its fixed-interface modes are the housing's own.
  const fem::PartModel part("housing", body, fem::housing_support(body));
  fem::PartInterface feet = fem::housing_interface(body);
  feet.names              = {"foot"};
  feet.weights            = feet.weights.rightCols(1).eval();
  fem::ModeChoice choice;
  choice.n_modes              = 5;
  const Eigen::VectorXd whole = fem::component_modes(part, feet, choice).fixed_frequency;

  std::vector<Check> checks;
  double before = frequencies(kept(body, 0))[0] / whole[0] - 1;
  for (const int n : {2, 5, 10, 20}) {
    const Component c       = kept(body, n);
    const Eigen::VectorXd f = frequencies(c);
    const double off        = f[0] / whole[0] - 1;
    checks.push_back(
        at_most("error of the first frequency, " + std::to_string(n) + " modes kept, over that with fewer", "-",
                off / before, 1));
    before = off;
    if (n == 20)
      for (int i = 0; i < 5; ++i)
        checks.push_back(relative("frequency " + std::to_string(i + 1) + " against the whole model", "Hz", f[i],
                                  whole[i], 1e-3));
  }
  const Eigen::VectorXd refined = frequencies(kept(meshed(h, {4, 1, 0}), 10));
  checks.push_back(relative("first frequency against a mesh twice as fine", "Hz", whole[0], refined[0], 1e-2));
  checks.push_back(relative("second frequency against a mesh twice as fine", "Hz", whole[1], refined[1], 1e-2));
  return checks;
}

// ---- screwdown-springs ----------------------------------------------------------------------------------------

std::vector<Check> screwdown_checks()
{
  // Two screws 440 mm, 600 mm free, in nuts of 700 x 900 mm; cylinders 800 x 40 mm of oil, pistons 300 mm long;
  // ring-shaped load cells 500 / 200 x 120 mm.
  Screwdown s;
  s.screw_diameter       = 0.44;
  s.screw_length         = 0.6;
  s.nut_outside_diameter = 0.7;
  s.nut_height           = 0.9;
  s.piston_diameter      = 0.8;
  s.piston_length        = 0.3;
  s.stroke               = 0.04;
  s.load_cell_diameter   = 0.5;
  s.load_cell_bore       = 0.2;
  s.load_cell_height     = 0.12;
  const Material steel;
  const auto k = reduce::screwdown_springs(s, steel);
  // Energy of thread and nut by quadrature of their forces, from the load the thread carries per height.
  const double EA_screw = 210e9 * M_PI / 4 * 0.44 * 0.44, EA_nut = 110e9 * M_PI / 4 * (0.7 * 0.7 - 0.44 * 0.44);
  const GaussRule gauss = gauss_legendre(4);
  double energy         = 0;
  for (int i = 0; i < 4; ++i) {
    const double position = 0.45 * (1 + gauss.node[i]);
    const auto carried    = [](const double y) { return 2 / 0.9 * (1 - y / 0.9); };  // 1/m, of a unit force
    double beyond         = 0;  // carried between here and the far end
    for (int j = 0; j < 4; ++j)
      beyond += 0.5 * (0.9 - position) * gauss.weight[j] *
                carried(position + 0.5 * (0.9 - position) * (1 + gauss.node[j]));
    energy += 0.45 * gauss.weight[i] * 0.5 * beyond * beyond * (1 / EA_screw + 1 / EA_nut);
  }
  const double rounding = 1e-12;
  const auto frame      = reduce::frame_with_screwdown(Frame(), s, steel).frame;
  return {
      relative("oil column", "N/m", k.oil_column, 2 * 1.4e9 * M_PI * 0.16 / 0.04, rounding),
      relative("screw", "N/m", k.screw, 2 * 210e9 * M_PI * 0.0484 / 0.6, rounding),
      relative("piston", "N/m", k.piston, 2 * 210e9 * M_PI * 0.16 / 0.3, rounding),
      relative("load cell", "N/m", k.load_cell, 2 * 210e9 * M_PI * (0.0625 - 0.01) / 0.12, rounding),
      relative("nut and thread", "N/m", k.nut, 1 / energy, rounding),
      relative("spring of the frame: screw, nut, piston", "N/m", frame.piston_stiffness,
               1 / (1 / k.screw + 1 / k.nut + 1 / k.piston), rounding),
      reported("the same, compared with the fitted value of the demo stand", "N/m", frame.piston_stiffness,
               4.0e11),
      reported("oil column, compared with the fitted value of the demo stand", "N/m", k.oil_column, 1.8e10),
  };
}
}  // namespace mill::verify
