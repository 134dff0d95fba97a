#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace mill {
/// One variable of a MATLAB file: a real matrix, or a column of texts (a cell array).
struct MatVariable {
  std::string name;  ///< a MATLAB name: letters, digits, underscores, a letter first
  Eigen::MatrixXd matrix;
  std::vector<std::string> texts;  ///< not empty: a cell array of these in place of the matrix
};

/// A MATLAB file of level 5, without compression and without a date, so that equal models make equal files.
/// @throws std::logic_error  a name that MATLAB does not take: our own bug
/// Source: The MathWorks, MAT-File Format, level 5 (public description, 2019), chapter 1.
std::string mat_file(const std::vector<MatVariable> &variables);
}  // namespace mill
