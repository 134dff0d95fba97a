#include "app/stages/contact/contact_files.h"
#include "fem/body/elastic_body.h"
#include "meshes/roll/roll.h"
#include <array>
#include <filesystem>

namespace mill {
Table curve_table(const ContactCurve &curve, const std::string &force, const std::string &stiffness)
{
  Table table;
  table.add("load", force, curve.load).add("approach", "m", curve.approach);
  table.add("half_width", "m", curve.half_width).add("peak_pressure", "Pa", curve.peak_pressure);
  table.add("tangent", stiffness, curve.tangent).add("secant", stiffness, curve.secant);
  table.add("iterations", "", curve.iterations.cast<double>());
  return table;
}

Table closed_table(const reduce::CylinderPair &pair, const Eigen::VectorXd &loads, const std::string &force,
                   const std::string &stiffness)
{
  Eigen::MatrixXd values(loads.size(), 5);
  for (Eigen::Index i = 0; i < loads.size(); ++i) {
    const auto hertz = reduce::line_contact(pair, loads[i]);
    const auto laws  = reduce::secant_laws(pair, loads[i]);
    values.row(i) << hertz.secant, hertz.tangent, laws.foeppl, laws.half_space, laws.palmgren;
  }
  Table table;
  table.add("load", force, loads);
  const char *names[] = {"hertz_secant", "hertz_tangent", "foeppl_secant", "half_space_secant", "palmgren_secant"};
  for (int c = 0; c < 5; ++c)
    table.add(names[c], stiffness, values.col(c));
  return table;
}

Table barrel_table(const BarrelProfile &p)
{
  Table table;
  table.add("z", "m", p.z).add("line_load", "N/m", p.line_load).add("approach", "m", p.approach);
  table.add("tangent", "N/m2", p.tangent).add("half_width", "m", p.half_width);
  table.add("peak_pressure", "Pa", p.peak_pressure);
  return table;
}

namespace {
// Forces of the side z >= 0 and of the side z <= 0 as those of the even and the odd symmetry case.
std::array<Eigen::VectorXd, 2> fold(const fem::PatchGrid &grid, const Eigen::VectorXd &nodal)
{
  const Eigen::Index n = grid.x.size() * grid.z.size();
  if (nodal.size() == n)
    return {nodal, Eigen::VectorXd()};
  std::array<Eigen::VectorXd, 2> parts{Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (int k = 0; k < grid.n_z; ++k)
    for (int i = 0; i < grid.n_x; ++i) {
      const double right         = nodal[(grid.n_z - 1 + k) * grid.n_x + i],
                   left          = nodal[(grid.n_z - 1 - k) * grid.n_x + i];
      parts[0][k * grid.n_x + i] = k == 0 ? 0.5 * right : 0.5 * (right + left);
      parts[1][k * grid.n_x + i] = k == 0 ? 0 : 0.5 * (right - left);
    }
  return parts;
}
}  // namespace

void write_fields(RunContext &run, const std::string &file, const CondensedPair &roll, const Material &steel,
                  const contact::State &state)
{
  const std::string mesh_file = run.out.file(file + ".msh");
  write_atomically(mesh_file, roll.coarse->field_mesh);
  const fem::ElasticBody body(meshes::known_mesh(mesh_file, roll.coarse->geometry), steel, 2);
  std::filesystem::remove(mesh_file);
  const auto &grid             = roll.coarse->grid;
  const auto [even, odd]       = fold(grid, state.nodal);
  Eigen::VectorXd pressure     = Eigen::VectorXd::Zero(body.nodes().rows());
  const std::vector<int> patch = fem::patch_in_grid_order(body);
  for (std::size_t i = 0; i < patch.size(); ++i) {
    const auto node    = Eigen::Index(i);
    pressure[patch[i]] = (even[node] + (odd.size() > 0 ? odd[node] : 0)) / grid.area[node];
  }
  Eigen::VectorXd displacement = roll.coarse->symmetric.field * even;
  if (odd.size() > 0)
    displacement += roll.coarse->symmetric_odd.field * odd;
  body.write_vtu(run.out.file(file), displacement, pressure);
}
}  // namespace mill
