#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace mill {
/// Lines, faces and single points in space with vectors and tensors on them, for ParaView.
struct LineField {
  Eigen::MatrixXd position;                      ///< (n, 3) m
  std::vector<std::vector<Eigen::Index>> cells;  ///< numbers of points; one: a vertex, more: a line through them
  bool filled = false;                           ///< cells of three and more points are faces
  int digits  = 9;                               ///< of every number
  struct Vectors {
    std::string name, unit;
    Eigen::MatrixXd value;  ///< (n, 3); a tensor: (n, 9)
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
