#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace mill {
/// Lines and single points in space with vectors on them, for ParaView.
struct LineField {
  Eigen::MatrixXd position;                      ///< (n, 3) m
  std::vector<std::vector<Eigen::Index>> cells;  ///< numbers of points; one: a vertex, more: a line through them
  struct Vectors {
    std::string name, unit;
    Eigen::MatrixXd value;  ///< (n, 3)
  };
  struct Scalars {
    std::string name, unit;
    Eigen::VectorXd value;  ///< (n)
  };
  std::vector<Vectors> vectors;
  std::vector<Scalars> scalars;
};

/// VTK XML file of an unstructured grid, text; the unit stands behind the name of an array.
std::string line_vtu(const LineField &field);
}  // namespace mill
