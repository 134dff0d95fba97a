#pragma once
#include "core/records/nonlinear_record.h"
#include <string>

namespace mill::report {
/// curves/nonlinear-<pass>.json as this run stored it.
struct NonlinearData : NonlinearRecord {
  bool stored = false;
  std::string problem;  ///< why a file that is there cannot be used; empty: nothing wrong
};

/// Never throws: without the file `stored` is false, `problem` says when it is not such a JSON.
/// @param item  the pass as file names have it
NonlinearData read_nonlinear(const std::string &run_directory, const std::string &item);
}  // namespace mill::report
