#pragma once
#include <Eigen/Core>
#include <vector>

namespace mill {
/// Named contact surface of a meshed body: its nodes and the faces between them.  A line in a plane or meridian
/// section, a face in space.
struct Surface {
  Eigen::MatrixXd points;     ///< (n, d) m, d = 2 (x, y or r, z) or 3
  Eigen::MatrixXi faces;      ///< (f, m) into points; m = 2, 3 (line, degree 1, 2) or 4, 9 (quadrilateral);
                              ///< lexicographic: first parameter fastest
  std::vector<int> node;      ///< (n) node of the body, ascending
  bool axisymmetric = false;  ///< measures carry 2 pi r
};
}  // namespace mill
