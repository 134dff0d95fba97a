#pragma once
#include "core/base/errors.h"
#include "core/process/progress.h"
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>

namespace mill::console {
/// Standard output cannot take what is printed: exit code 3.
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A closed standard input, output or error is opened on nothing, so that no file of ours gets its number.  Called
/// first.
void open_standard_files();

/// Text for standard output; control characters are written out.  @throws OutputError
void print(const std::string &text);
/// What was printed has arrived.  @throws OutputError  it has not (disk full, closed)
void flush();
/// Text for standard error, control characters written out; a standard error that accepts nothing is ignored.
void say(const std::string &text);

/// Progress of one command.  A command that shows several bars one after the other names the share of its work
/// that is done with the next one; without that the next bar is the last.
void begin_progress();
void next_bar_ends_at(double share);
/// Per cent between two lines of progress where the output is not a terminal; 10 otherwise.
void progress_line_every(int percent);

/// While it lives, bars that this thread makes tell `listener` their stage and the share of the command that is
/// done, quiet or not, and show nothing.  They may be shown, and so call it, from other threads, one at a time.
class HeardProgress {
public:
  explicit HeardProgress(std::function<void(const std::string &stage, double done)> listener);
  ~HeardProgress();
  HeardProgress(const HeardProgress &)            = delete;
  HeardProgress &operator=(const HeardProgress &) = delete;
};

/// What the user sees while a run works: a bar with stage and time left on a terminal, percent lines elsewhere.
/// What is shown never falls, also from one bar to the next.
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
void show(const OutputError &error);
/// @param manifest  path of run.json, empty when there is none
void show_bug(const std::exception &error, const std::string &manifest);
}  // namespace mill::console
