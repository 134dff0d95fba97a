#pragma once
#include "core/base/parameter.h"
#include "core/base/warning.h"
#include "core/model/estimate.h"
#include "core/records/result_row.h"
#include "core/records/speed_verdict.h"
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace mill {
/// An estimate of the case and what its interval moves, by result: relative, half the interval.
struct EstimateRecord {
  Estimate estimate;
  std::vector<std::pair<std::string, double>> moves;
};

/// All scalar results of a run in the order they were computed.  A name is made by a row
/// (core/records/result_row.h): a result without row and meaning does not compile.
struct Results {
  std::vector<std::pair<std::string, Parameter>> values;
  std::vector<Warning> warnings;  ///< facts that a reader needs to know, in the order of the stages
  std::vector<std::string>
      assumptions;                   ///< values that are not known and were assumed by the run, one sentence each
  std::vector<SpeedVerdict> speeds;  ///< how far each pass is from its critical speed, in the order of the passes
  std::vector<EstimateRecord> estimates;      ///< the one that costs most accuracy first
  std::vector<std::string> left_at_template;  ///< keys whose values are still those of the template
  /// With the unit of the row where the parameter states none.  A name twice is our bug.
  void add(const ResultName &name, Parameter parameter);
  void append(std::vector<std::pair<std::string, Parameter>> more);  ///< those of another stage, as they are
  const Parameter *find(const std::string &name) const;              ///< nullptr when absent
};

/// results.json, schema 1: 17 digits, UTF-8, '\n'; NaN is written as null.
/// @param run_id  which run the file is of (core/records/run_identity.h); empty: left out
std::string results_json(const Results &results, const std::string &case_name, const std::string &status,
                         const std::string &run_id = "");
}  // namespace mill
