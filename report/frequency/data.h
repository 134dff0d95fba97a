#pragma once
#include "core/records/campbell_record.h"
#include <string>

namespace mill::report {
/// curves/campbell.json as this run stored it.
struct CampbellData : CampbellRecord {
  bool stored = false;
  std::string problem;  ///< why a file that is there cannot be used; empty: nothing wrong
};

/// Never throws: without the file `stored` is false, `problem` says when it is not such a JSON.  Crossings
/// of modes or lines that are not there are left out.
CampbellData read_campbell(const std::string &run_directory);
}  // namespace mill::report
