#pragma once
#include "core/stand.h"
#include <string>

namespace mill {
/// Folder of a run.  Nothing of another case is overwritten by surprise, every file is written aside and renamed.
class OutputDir {
public:
  /// Creates DIR, curves/, response/ and fields/.
  /// @throws InputError  the folder holds files of another case or of no run (unless `overwrite`), or cannot be
  /// written
  OutputDir(std::string path, const Case &of, bool overwrite);

  const std::string &path() const;
  std::string file(const std::string &name) const;  ///< full path of a file in the folder
  void write(const std::string &name, const std::string &text) const;

private:
  std::string directory;
};

/// "pass 1" -> "pass-1": letters, digits and dashes, for file names.
std::string slug(const std::string &name);
}  // namespace mill
