#include "app/contact_files.h"
#include "fem/elastic_body.h"

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

void write_fields(RunContext &run, const std::string &file, const CondensedPair &roll, const Material &steel,
                  const fem::ContactState &state)
{
  const fem::ElasticBody body(roll.coarse_mesh, steel, 2);
  Eigen::VectorXd pressure     = Eigen::VectorXd::Zero(body.nodes().rows());
  const std::vector<int> patch = fem::patch_in_grid_order(body);
  for (std::size_t i = 0; i < patch.size(); ++i)
    pressure[patch[i]] = state.nodal[Eigen::Index(i)] / roll.coarse->area[Eigen::Index(i)];
  body.write_vtu(run.out.file(file), roll.coarse->field_squeeze * state.nodal, pressure);
}
}  // namespace mill
