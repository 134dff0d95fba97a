#pragma once
#include "app/run/output_dir.h"
#include "core/base/warning.h"
#include "core/process/progress.h"
#include "core/process/stage_work.h"
#include "core/records/results.h"
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace mill {
class AskedSpeeds;
struct Case;
class MovingKeys;

/// The lists of inputs of a case, see core/case/moving_keys.h.
std::shared_ptr<MovingKeys> moving_keys_of(const Case &the_case);

/// Time of one stage of a run.
struct StageTime {
  std::string stage;
  double seconds           = 0;
  double processor_seconds = 0;
  bool cached              = false;  ///< taken over from an earlier run
  std::vector<Factorisation> factorisations;
};

/// Keys of what a run has made and kept: --fresh does not make it twice, and of two stages that want one part at
/// the same time the second waits for the first.
class MadeKeys {
public:
  bool count(const std::string &key) const;
  void insert(const std::string &key);

  /// Only one stage at a time has the turn for this key, from construction to destruction.
  class Turn {
  public:
    Turn(MadeKeys &all_keys, std::string key);
    ~Turn();
    Turn(const Turn &)            = delete;
    Turn &operator=(const Turn &) = delete;

  private:
    MadeKeys &keys;
    const std::string key;
  };

private:
  mutable std::mutex access;
  std::condition_variable released;
  std::set<std::string> made, taken;
};

/// What the stages of one run share.
struct RunContext {
  const Case &the_case;
  const OutputDir &out;
  std::string cache;                         ///< folder of condensed rolls
  bool fresh                       = false;  ///< ignore what the cache holds
  std::shared_ptr<MadeKeys> made   = std::make_shared<MadeKeys>();
  std::shared_ptr<MovingKeys> keys = moving_keys_of(the_case);  ///< lists of inputs, of the run and its branches
  int threads                      = 1;
  Progress progress;
  Results results;
  std::vector<StageTime> times;
  std::string summary;                  ///< what the console says after the results
  std::string started;                  ///< local date and time
  std::shared_ptr<AskedSpeeds> asked;   ///< of this run and its branches; null: not kept
  const RunContext *earlier = nullptr;  ///< of a branch: what it comes from, unchanged while it runs
  /// Into results and log, once; the place of its key is looked up where the warning has none.
  void warn(Warning warning);
  void assume(const std::string &sentence);  ///< into results and log

  /// A result of this branch or of what was there before it; nullptr: none.
  const Parameter *find(const std::string &name) const;
  /// A separate context for a stage that runs in parallel with others: same case, folder and cache, no messages
  /// yet.
  RunContext branch() const;
  /// Appends results and messages of a branch to those that are here: the order is that of the calls, whatever ran
  /// first.
  void absorb(RunContext &&branch);
};

/// A stage that needs no result of the stages in parallel with it.
using IndependentStage = std::function<void(RunContext &run)>;

/// Stages that run in parallel on the threads of a run, each with its own branch.  Their results and messages
/// comes into the run in the order in which they are taken, so that nothing depends on which ended first.
class SideBySide {
public:
  explicit SideBySide(RunContext &run);
  void add(IndependentStage stage);
  /// Runs all of them, the first ones first; one that has not begun when an earlier one has failed never does.
  void work();
  bool failed(std::size_t i) const;
  /// Absorbs the branch of stage i, as added.  @throws what the stage threw
  void take(std::size_t i);

private:
  RunContext &run;
  std::vector<IndependentStage> stages;
  std::vector<RunContext> branches;
  std::vector<std::exception_ptr> failures;
};

/// Runs stages side by side and takes them in the order of the list.
/// @throws what the first failing one of the list threw; the stages before it are taken
void run_side_by_side(RunContext &run, std::vector<IndependentStage> stages);

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
  StageWork work;
};

/// Hash of all that decides the results of a run: version, verb, resolved case, bytes of the records and models
/// that the case names.  @param force_file  record that replaces those of the passes; empty: none
std::string run_id_of(const Case &the_case, const std::string &verb, const std::string &force_file);

/// run.json: versions, BLAS, threads, timings, memory, geometry, passes, checksums of the files staged so far.
std::string manifest_json(const RunContext &run);
}  // namespace mill
