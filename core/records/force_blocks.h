#pragma once
#include "core/records/records.h"
#include <cstdio>
#include <memory>
#include <string>

namespace mill {
/// A recorded rolling force read piece by piece, for records longer than memory.  Rules and messages are those of
/// read_force(), with the line of the file; blanks in quotes that run over several lines are not understood.
class ForceBlocks {
public:
  /// @param bytes  read at a time, about
  /// @throws InputError as read_force()
  explicit ForceBlocks(std::string path, std::size_t bytes = 4 << 20);

  /// The next samples, at least one; false at the end.  Memory: some ten times `bytes`.
  /// @throws InputError as read_force(), SystemError  the disk refuses it
  bool next(ForceRecord &block);

  double fraction() const;  ///< -, of the file that has been read
  long long n_samples() const
  {
    return n_samples_;
  }

private:
  struct Close {
    void operator()(std::FILE *file) const
    {
      std::fclose(file);
    }
  };
  bool read_lines(std::string &lines);
  void parse(std::string lines, ForceRecord &block);

  std::string path_;
  std::size_t bytes_;
  std::unique_ptr<std::FILE, Close> file_;
  long long size_ = 0, done_ = 0;
  std::string header_, rest_;
  int lines_before_ = 0, header_line_ = 0;
  long long n_samples_ = 0;
  double last_time_    = 0;  ///< s
  bool ended_          = false;
};
}  // namespace mill
