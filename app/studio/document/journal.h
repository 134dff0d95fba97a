#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace mill::studio {
/// "cases/.demo.toml.studio": beside the case.
std::string journal_path(const std::string &case_path);

/// Lines of text that are on the disk when append() returns.  One program at a time holds a journal.
class Journal {
public:
  /// @throws SystemError, InputError  it cannot be opened; another program holds it
  explicit Journal(std::string path);
  ~Journal();
  Journal(const Journal &)            = delete;
  Journal &operator=(const Journal &) = delete;

  /// What earlier programs left; a line that a kill has cut is taken off.
  std::vector<std::string> lines();
  void append(const std::string &line);
  /// These lines in place of all others.
  void replace(const std::vector<std::string> &lines);
  /// What there is moves to a new file, "<path>.old", "<path>.old-2" ..; the journal is empty then.
  /// @return  path of that file
  std::string set_aside();
  std::size_t bytes() const;

private:
  std::string path_;
  int file_          = -1;
  std::size_t bytes_ = 0;
};
}  // namespace mill::studio
