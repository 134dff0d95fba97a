#pragma once

namespace mill {
/// While it lives, SIGINT, SIGTERM and SIGHUP ask for an end and do not end the program: whoever works looks at
/// `asked()` between two pieces of work.  A second signal ends the program as usual.  One that was ignored before
/// (nohup) stays so.
class CutSignal {
public:
  CutSignal();
  ~CutSignal();
  CutSignal(const CutSignal &)            = delete;
  CutSignal &operator=(const CutSignal &) = delete;
  int asked() const;  ///< number of the signal, 0: none
};
}  // namespace mill
