#pragma once
#include "twin/live/engine/engine.h"
#include <cstdio>
#include <string>

namespace mill {
/// Accelerations of the twin as a table: s, time [s], force [N], places [m/s2], settling; every digit.
class ResponseFile {
public:
  /// @param overwrite  an existing file is replaced
  /// @param at_end     then the old file stays until finish(); else until the first samples
  /// @throws InputError, SystemError  it cannot be written, exists, or is a symbolic link
  ResponseFile(std::string path, bool overwrite, bool at_end);
  ~ResponseFile();  ///< a file that it made and into which nothing came is removed
  ResponseFile(const ResponseFile &)            = delete;
  ResponseFile &operator=(const ResponseFile &) = delete;
  void begin(const live::LiveSource &source);  ///< writes nothing yet
  void take(const live::LiveBlock &block);
  /// Without samples an old file stays.
  /// @throws SystemError  the file is not complete
  void finish();
  bool leaves_old_file() const;  ///< up to now, an existing file is as it was
  /// Why nothing more is written, a sentence; empty: it is.
  const std::string &problem() const
  {
    return problem_;
  }

private:
  void write_head();
  void close();

  std::string path_, aside_;  // aside_: written there until finish(); empty: in the file itself
  std::string head_;          // empty: no source has begun
  std::string problem_;
  bool replaces_ = false, made_ = false;
  std::FILE *file_ = nullptr;
  bool written_    = false;
};
}  // namespace mill
