#pragma once
#include "twin/live/engine/engine.h"
#include <cstdio>
#include <string>

namespace mill {
/// Accelerations of the twin as a table: s, time [s], force [N], places [m/s2], settling; every digit.
class ResponseFile {
public:
  /// @throws InputError, SystemError  it cannot be written, exists, or is a symbolic link
  ResponseFile(std::string path, bool overwrite);
  ~ResponseFile();
  ResponseFile(const ResponseFile &)            = delete;
  ResponseFile &operator=(const ResponseFile &) = delete;
  void begin(const live::LiveSource &source);
  void take(const live::LiveBlock &block);
  /// @throws SystemError  the file is not complete
  void finish();

private:
  std::string path_;
  std::FILE *file_ = nullptr;
  bool begun_      = false;
};
}  // namespace mill
