#pragma once
#include "core/base/parameter.h"
#include "core/base/warning.h"
#include "core/model/dynamics_settings.h"
#include "core/model/kind_of_case.h"
#include "core/records/csv.h"
#include "core/records/speed_verdict.h"
#include <map>
#include <optional>
#include <string>
#include <vector>

// A run directory as read back from disk.  The report knows nothing else: what is not stored cannot be shown.
namespace mill::report {
/// One entry of results.json.
struct Result {
  std::string name;                      ///< "K3.tangent"
  double value;                          ///< SI; NaN when the run stored none
  std::string unit;                      ///< SI unit, "N/m", "1"
  std::string source;                    ///< "computed: contact FEM", "given", ...
  std::string at;                        ///< load or state, "976.2 kN"; empty when it has none
  double error_estimate;                 ///< relative; NaN: none can be stated
  std::vector<std::string> inputs;       ///< keys of the case file
  std::vector<Check> checks;             ///< independent values to compare it with
  std::vector<std::string> error_lacks;  ///< why none can be stated: inputs whose own error is not known
  std::vector<std::string> estimated           = {};  ///< those of the inputs that are estimates
  std::vector<OperatingPoint::Value> at_values = {};  ///< the numbers of `at`
};

/// A value that no drawing gave: results.json, "estimates".
struct EstimateInfo {
  std::string key;          ///< "frame.upper_post_mass"
  double value, low, high;  ///< in `unit`
  std::string unit;         ///< SI
  std::string rule;
  std::vector<std::pair<std::string, double>> moves;  ///< result and what half the interval moves it by, relative
};

struct PassInfo {
  std::string name;  ///< "pass 1"
  std::string slug;  ///< "pass-1", names response/<slug>.csv
  double load;       ///< N, working load; the mean of the record when the case states none; NaN: neither stored
  bool synthetic;    ///< the force record is made, not measured
  std::optional<ForceMeaning> force_meaning;  ///< nothing: not stored
};

struct Timing {
  std::string stage;
  double seconds;  ///< s, wall clock
  bool cached;     ///< taken over from an earlier run
};

/// A bearing of the case, as far as the run stored it.
struct BearingInfo {
  std::map<std::string, double> size;  ///< m, rad or a count, by the keys of the case: "bore", "cup_angle", "rows"
  std::string hands;                   ///< "+-+-", axial direction in which each row carries

  double operator()(const std::string &key) const;  ///< NaN when not stored
};

/// run.json: who, when, with what.
struct Manifest {
  std::string program, version, case_path, title, run_id, date, hostname, blas;
  std::optional<KindOfCase> kind;  ///< nothing: a kind that this version does not know
  int threads        = 0;
  double peak_memory = 0;  ///< byte; 0: not stored
  std::vector<std::pair<std::string, std::string>> versions;
  std::vector<Timing> timings;
  std::map<std::string, double> geometry;       ///< m, "work_roll_diameter", ...
  std::map<std::string, BearingInfo> bearings;  ///< by name
  std::vector<PassInfo> passes;
  std::vector<SpeedVerdict> speeds;  ///< critical speed of the passes, the worst first
};

struct Run {
  std::string directory;
  std::string case_name;
  std::string status;  ///< "ok", "warnings" or anything else, which is a failure
  std::vector<Result> results;
  std::vector<Warning> warnings;
  std::vector<std::string> assumptions;
  std::vector<EstimateInfo> estimates;  ///< the one that costs most accuracy first
  Manifest manifest;
  std::map<std::string, Table> tables;  ///< by path in the run directory without ending: "curves/modes"
  std::vector<std::string> remarks;     ///< what is missing or could not be read, one sentence each

  const Result *find(const std::string &name) const;   ///< nullptr when absent
  const Table *table(const std::string &path) const;   ///< nullptr when absent
  BearingInfo bearing(const std::string &name) const;  ///< without entries when not stored
};

/// Reads results.json, run.json and every table in curves/ and response/.  Without run.json, or with a table that
/// cannot be read, the run is still a run: a remark says what is missing.
///
/// @throws InputError  no results.json, not the JSON this program writes (names the place), or files of two runs
/// Cost: reads every table once, about 0.2 s per million numbers.
Run read_run(const std::string &directory);

/// The same for the run that has just written this folder: tables it still has are not read from their files where
/// these say the same, and no file is compared with its checksum.
/// @param at_hand  by path in the folder without ending
Run read_own_run(const std::string &directory, std::map<std::string, Table> at_hand);
}  // namespace mill::report
