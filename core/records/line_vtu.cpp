#include "core/records/line_vtu.h"
#include <fmt/format.h>

namespace mill {
namespace {
constexpr int vertex = 1, poly_line = 4, polygon = 7;  // cell types of VTK

std::string xml_text(const std::string &text)
{
  std::string out;
  for (const char c : text)
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

std::string array(const std::string &name, const Eigen::MatrixXd &rows, const int digits)
{
  std::string out =
      fmt::format("<DataArray type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"ascii\">\n",
                  xml_text(name), rows.cols());
  for (Eigen::Index i = 0; i < rows.rows(); ++i)
    for (Eigen::Index j = 0; j < rows.cols(); ++j)
      out += fmt::format("{:.{}g}{}", rows(i, j), digits, j + 1 < rows.cols() ? ' ' : '\n');
  return out + "</DataArray>\n";
}

std::string with_unit(const std::string &name, const std::string &unit)
{
  return unit.empty() ? name : name + " [" + unit + "]";
}
}  // namespace

std::string line_vtu(const LineField &field)
{
  std::string out = fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
                                "byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" "
                                "NumberOfCells=\"{}\">\n<Points>\n",
                                field.position.rows(), field.cells.size());
  out += array("points", field.position, field.digits) + "</Points>\n<PointData>\n";
  for (const auto &v : field.vectors)
    out += array(with_unit(v.name, v.unit), v.value, field.digits);
  for (const auto &s : field.scalars)
    out += array(with_unit(s.name, s.unit), s.value, field.digits);
  std::string connectivity, offsets, types;
  std::size_t end = 0;
  for (const auto &cell : field.cells) {
    for (const Eigen::Index i : cell)
      connectivity += fmt::format("{} ", i);
    connectivity += "\n";
    offsets += fmt::format("{}\n", end += cell.size());
    types += fmt::format("{}\n", cell.size() == 1                  ? vertex
                                 : field.filled && cell.size() > 2 ? polygon
                                                                   : poly_line);
  }
  return out + "</PointData>\n<Cells>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n" +
         connectivity + "</DataArray>\n<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">\n" + offsets +
         "</DataArray>\n<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">\n" + types +
         "</DataArray>\n</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}
}  // namespace mill
