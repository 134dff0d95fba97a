#include "app/contact_files.h"
#include "fem/elastic_body.h"

namespace mill
{
Table curve_table(const ContactCurve &curve)
{
  return {{"load", "approach", "half_width", "peak_pressure", "tangent", "secant", "iterations"},
          {"N", "m", "m", "Pa", "N/m", "N/m", ""},
          {curve.load, curve.approach, curve.half_width, curve.peak_pressure, curve.tangent, curve.secant,
           curve.iterations.cast<double>()}};
}

Table closed_table(const reduce::CylinderPair &pair, const Eigen::VectorXd &loads)
{
  Table table{{"load", "hertz_secant", "hertz_tangent", "foeppl_secant", "half_space_secant", "palmgren_secant"},
              {"N", "N/m", "N/m", "N/m", "N/m", "N/m"},
              std::vector<Eigen::VectorXd>(6, loads)};
  for (Eigen::Index i = 0; i < loads.size(); ++i) {
    const auto hertz = reduce::line_contact(pair, loads[i]);
    const auto laws  = reduce::secant_laws(pair, loads[i]);
    const double row[] = {loads[i], hertz.secant, hertz.tangent, laws.foeppl, laws.half_space, laws.palmgren};
    for (int c = 0; c < 6; ++c)
      table.columns[c][i] = row[c];
  }
  return table;
}

void write_fields(Session &session, const std::string &file, const CondensedPair &roll, const Material &steel,
                  const fem::ContactState &state)
{
  const fem::ElasticBody body(roll.coarse_mesh, steel, 2);
  Eigen::VectorXd pressure     = Eigen::VectorXd::Zero(body.nodes().rows());
  const std::vector<int> patch = fem::patch_in_grid_order(body);
  for (std::size_t i = 0; i < patch.size(); ++i)
    pressure[patch[i]] = state.nodal[Eigen::Index(i)] / roll.coarse->area[Eigen::Index(i)];
  body.write_vtu(session.out.file(file), roll.coarse->field_squeeze * state.nodal, pressure);
}
} // namespace mill
