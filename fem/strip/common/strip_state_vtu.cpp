#include "core/base/files.h"
#include "fem/strip/common/strip_state.h"
#include <sstream>

namespace mill::fem {
void write_strip_flow_vtu(const std::string &path, const StripFlow &flow)
{
  const auto columns = flow.x.rows(), rows = flow.x.cols(), n = columns * rows;
  const auto n_cells = (columns - 1) / 2 * ((rows - 1) / 2);
  std::ostringstream out;
  out.precision(9);
  out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
         "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\""
      << n << "\" NumberOfCells=\"" << n_cells << "\">\n";
  const auto array = [&](const std::string &name, const int components, const auto &value) {
    out << "<DataArray type=\"Float64\" Name=\"" << name << "\" NumberOfComponents=\"" << components
        << "\" format=\"ascii\">\n";
    for (Eigen::Index i = 0; i < columns; ++i)
      for (Eigen::Index j = 0; j < rows; ++j)
        value(i, j);
    out << "</DataArray>\n";
  };
  const auto scalar = [&](const std::string &name, const Eigen::MatrixXd &field) {
    array(name, 1, [&](const Eigen::Index i, const Eigen::Index j) { out << field(i, j) << '\n'; });
  };
  out << "<Points>\n";
  array("points", 3,
        [&](const Eigen::Index i, const Eigen::Index j) { out << flow.x(i, j) << ' ' << flow.y(i, j) << " 0\n"; });
  out << "</Points>\n<PointData>\n";
  array("velocity", 3, [&](const Eigen::Index i, const Eigen::Index j) {
    out << flow.vx(i, j) << ' ' << flow.vy(i, j) << " 0\n";
  });
  scalar("pressure_Pa", flow.pressure);
  scalar("strain", flow.strain);
  scalar("strain_rate", flow.rate);
  // Plane strain: what acts along the rolls follows from the mean stress, which is the pressure's opposite.
  array("stress_Pa", 9, [&](const Eigen::Index i, const Eigen::Index j) {
    const double along_rolls = -3 * flow.pressure(i, j) - flow.sxx(i, j) - flow.syy(i, j);
    out << flow.sxx(i, j) << ' ' << flow.sxy(i, j) << " 0 " << flow.sxy(i, j) << ' ' << flow.syy(i, j) << " 0 0 0 "
        << along_rolls << '\n';
  });
  out << "</PointData>\n<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
  // Biquadratic quadrilateral: corners counter-clockwise, middles of the sides, centre.
  const int along[9] = {0, 2, 2, 0, 1, 2, 1, 0, 1}, through[9] = {0, 0, 2, 2, 0, 1, 2, 1, 1};
  for (Eigen::Index I = 0; I + 2 < columns; I += 2)
    for (Eigen::Index J = 0; J + 2 < rows; J += 2) {
      for (int a = 0; a < 9; ++a)
        out << (I + along[a]) * rows + J + through[a] << ' ';
      out << '\n';
    }
  out << "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n";
  for (Eigen::Index c = 1; c <= n_cells; ++c)
    out << 9 * c << '\n';
  out << "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n";
  for (Eigen::Index c = 0; c < n_cells; ++c)
    out << "28\n";  // VTK_BIQUADRATIC_QUAD
  out << "</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
  write_atomically(path, out.str());
}
}  // namespace mill::fem
