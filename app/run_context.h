#pragma once
#include "app/output_dir.h"
#include "core/process/progress.h"
#include "core/records/results.h"
#include "core/model/stand.h"
#include <chrono>
#include <set>
#include <string>
#include <vector>

namespace mill {
/// Time of one stage of a run.
struct StageTime {
  std::string stage;
  double seconds = 0;
  bool cached    = false;  ///< taken over from an earlier run
};

/// What the stages of one run share.
struct RunContext {
  const Case &the_case;
  const OutputDir &out;
  std::string cache;           ///< folder of condensed rolls
  bool fresh = false;          ///< ignore what the cache holds
  std::set<std::string> made;  ///< keys of what this run condensed: --fresh does not do it twice
  int threads = 1;
  Progress progress;
  Results results;
  std::vector<StageTime> times;
  std::string summary;                       ///< what the console says after the results
  std::string started;                       ///< local date and time
  void warn(const std::string &sentence);    ///< into results and log
  void assume(const std::string &sentence);  ///< same
};

/// Times a stage from construction to destruction.
class StageTimer {
public:
  StageTimer(RunContext &run, std::string stage);
  ~StageTimer();
  bool cached = false;

private:
  RunContext &run;
  std::string stage;
  std::chrono::steady_clock::time_point start;
};

std::string version();  ///< "0.1.0"

/// Hash of all that decides the results of a run: version, verb, resolved case, bytes of the records and models
/// that the case names.  @param force_file  record that replaces those of the passes; empty: none
std::string run_id_of(const Case &the_case, const std::string &verb, const std::string &force_file);

/// run.json: versions, BLAS, threads, timings, memory, geometry, passes, checksums of the files staged so far.
std::string manifest_json(const RunContext &run);
}  // namespace mill
