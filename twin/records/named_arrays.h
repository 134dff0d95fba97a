#pragma once
#include "twin/records/raw_record.h"
#include <Eigen/Core>
#include <string>
#include <vector>

namespace mill::twin {
/// A numeric array of a file that names its arrays (MATLAB, .npz).
struct NamedArray {
  std::string name;       ///< "a", or "run.a" of a structure
  Eigen::MatrixXd value;  ///< (rows, columns)
};

/// What such a file holds.
struct NamedArrays {
  std::vector<NamedArray> arrays;
  std::vector<std::string> others;  ///< "'comment' (text)": what is not an array of real numbers
};

/// Makes a record of them: vectors and columns of matrices of the common length are channels, one of them may be
/// the time, single numbers may be the sampling rate.  Fields of structures lose the name of the structure where
/// that leaves the names distinct.  Columns of a matrix "run" are called run_1, run_2, ..
/// @param units  by name, of a sidecar; may be empty
/// @throws InputError  with the names of the arrays and the command that works
RawRecord record_of_arrays(const std::string &path, const std::string &format, NamedArrays &&arrays,
                           const std::map<std::string, std::string> &units, const ReadOptions &options);
}  // namespace mill::twin
