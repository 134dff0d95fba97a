#pragma once

// Reading of folders that signals interrupt.  The program of a test that links this file opens folders through it.
namespace interrupted_folder {
/// While it lives, each second call that opens a folder fails with EINTR.
class EachSecondCall {
public:
  EachSecondCall();
  ~EachSecondCall();
  int failed() const;  ///< calls so far
};
}  // namespace interrupted_folder
