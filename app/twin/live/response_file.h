#pragma once
#include "twin/live/engine/engine.h"
#include <cstdio>
#include <string>

namespace mill {
/// Accelerations of the twin as a table: s, time [s], force [N], places [m/s2], settling; every digit.
class ResponseFile {
public:
  /// @param overwrite  an existing file is replaced
  /// @param at_end     then the old file stays until finish(); else until begin()
  /// @throws InputError, SystemError  it cannot be written, exists, or is a symbolic link
  ResponseFile(std::string path, bool overwrite, bool at_end);
  ~ResponseFile();
  ResponseFile(const ResponseFile &)            = delete;
  ResponseFile &operator=(const ResponseFile &) = delete;
  void begin(const live::LiveSource &source);
  void take(const live::LiveBlock &block);
  /// @throws SystemError  the file is not complete
  void finish();
  bool leaves_old_file() const;  ///< up to now, an existing file is as it was

private:
  std::string path_, aside_;  // aside_: written there until finish(); empty: in the file itself
  bool replaces_   = false;
  std::FILE *file_ = nullptr;
  bool begun_      = false;
};
}  // namespace mill
