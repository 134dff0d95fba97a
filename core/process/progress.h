#pragma once
#include <functional>
#include <string>

namespace mill {
/// How library code tells the outside what it is doing; it never prints.  Both members may be empty.
struct Progress {
  std::function<void(const std::string &stage, double fraction)> step;  ///< fraction of this stage, 0..1
  std::function<void(const std::string &line)> log;                     ///< one line for the log file
  void at(const std::string &stage, double fraction) const
  {
    if (step)
      step(stage, fraction);
  }
  void note(const std::string &line) const
  {
    if (log)
      log(line);
  }
};
}  // namespace mill
