#pragma once
#include <atomic>

namespace mill {
/// While it lives, SIGINT, SIGTERM and, unless nohup ignores it, SIGHUP ask for an end and do not end
/// the program: whoever works looks at `asked()` between two pieces of work.  A second signal ends the program as
/// usual.  Work that its caller can stop (core/process/stop.h) leaves the signals to that caller and looks at its
/// wish.
class CutSignal {
public:
  CutSignal();
  ~CutSignal();
  CutSignal(const CutSignal &)            = delete;
  CutSignal &operator=(const CutSignal &) = delete;
  int asked() const;  ///< number of the signal, 0: none

private:
  const std::atomic<bool> *const of_caller;
};
}  // namespace mill
