#pragma once
#include <memory>
#include <string>

namespace mill {
class OutputDir;

/// The log of a run: millstand.log of its folder, a file of the user's choice, the terminal.
class RunLog {
public:
  /// @param chosen    file named with --log; empty: none
  /// @param verbose   the terminal as well
  /// @throws InputError  the file cannot be written, is not a regular file, is a link, belongs to the results, or
  /// holds
  ///                     something else than an earlier log: a case file is not overwritten by a slip
  RunLog(const OutputDir &out, const std::string &chosen, bool verbose);
  ~RunLog();
  void line(const std::string &text) const;  ///< one line; control characters are written out
  /// @throws SystemError  a file could not take all lines (disk full)
  void require_complete() const;

private:
  struct State;
  std::unique_ptr<State> state;
};
}  // namespace mill
