#pragma once
#include "app/process/console.h"
#include "app/study/study_folder.h"
#include <chrono>
#include <set>

namespace mill {
/// Shows how many rows of a study are over while other processes compute them.
class RowWatch {
public:
  /// @param open  rows that are not over now
  RowWatch(const Study &study, long open, bool quiet);
  /// Reads the files of the workers, once a second at most.  Cost: one query for each file of this run.
  void look();
  void finish();

private:
  const Study &study;
  long open;
  std::set<std::string> files_before;
  std::chrono::steady_clock::time_point last_look;
  console::ProgressBar bar;
};
}  // namespace mill
