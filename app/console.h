#pragma once
#include "core/errors.h"
#include "core/progress.h"
#include <memory>
#include <string>

namespace mill::console {
/// What the user sees while a run works: a bar with stage and time left on a terminal, percent lines elsewhere.
class ProgressBar {
public:
  /// @param stages  expected stages and their share of the time, in order; shares need not sum to one
  ProgressBar(std::vector<std::pair<std::string, double>> stages, bool quiet);
  ~ProgressBar();
  void show(const std::string &stage, double fraction);
  void finish();

private:
  struct State;
  std::unique_ptr<State> state;
};

void show(const InputError &error);
void show(const SolverError &error);
/// @param manifest  path of run.json, empty when there is none
void show_bug(const std::exception &error, const std::string &manifest);
}  // namespace mill::console
