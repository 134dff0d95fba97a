#pragma once
#include <string>
#include <vector>

namespace mill {
/// Flags of `millstand study`, as written; what it varies and watches is in SweepOptions.
struct StudyOptions {
  std::string action;                  ///< new, run, work, status, merge or report
  std::string method;                  ///< new --method
  long samples = 0;                    ///< new --samples; 0: not given
  int seed     = 1;                    ///< new --seed
  std::string list;                    ///< new --list: CSV of rows
  std::string minimise, maximise;      ///< new --minimise, --maximise: objective of --method optimise
  std::vector<std::string> correlate;  ///< new --correlate "KEY1,KEY2=0.5"
  bool yes           = false;          ///< new --yes: more than ten million rows
  std::string shard  = "1/1";          ///< work --shard
  std::string engine = "here";         ///< run --engine
  int jobs           = 0;              ///< run --jobs; 0: chosen by the engine
  std::string hosts;                   ///< run --hosts
  bool keep         = false;           ///< run, work --keep
  bool dry_run      = false;           ///< run --dry-run
  bool allow_failed = false;           ///< report --allow-failed
};
}  // namespace mill
