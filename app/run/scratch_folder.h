#pragma once
#include <string>

namespace mill {
/// A name for a folder of files that are not kept, in the folder of temporary files; what is there when this
/// object ends is removed.
class ScratchFolder {
public:
  /// @param prefix     of the name, "millstand-export"
  /// @param in_memory  small files that are written often: in the folder of the system that is memory, where there
  /// is
  ///                   one, since each file of a run waits for the disk
  explicit ScratchFolder(const std::string &prefix, bool in_memory = false);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder &)            = delete;
  ScratchFolder &operator=(const ScratchFolder &) = delete;
  const std::string &path() const;

private:
  std::string path_;
};
}  // namespace mill
