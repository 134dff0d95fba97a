#pragma once
#include "core/base/input_file.h"
#include "core/base/valid_text.h"
#include <string>
#include <string_view>

namespace mill::twin {
/// Lines of a text file, read block by block; they end with LF, CR LF, or CR alone; UTF-16 and Windows-1252 become
/// UTF-8.
class LineSource {
public:
  static constexpr std::size_t longest_line = 1 << 24;  ///< byte

  /// @throws InputError  no such file, no regular file; SystemError  the system refuses it
  explicit LineSource(const std::string &path);

  /// The next line without its end; the view holds until the next call.  False at the end of the file.
  /// @throws InputError  a line of more than longest_line: this is not a text file
  bool next(std::string_view &line);
  int number() const;  ///< of the line that next() gave, from 1; of very long files the largest int
  bool ended_without_newline() const;
  TextEncoding encoding() const;  ///< of the lines up to now
  bool had_mark() const;          ///< a byte-order mark was at the beginning
  double size() const;            ///< byte
  double done() const;            ///< byte, read so far

private:
  bool fill();
  void find_end_of_lines();

  InputFile file_;
  std::string path_, buffer_, raw_, converted_;
  TextEncoding encoding_ = TextEncoding::utf8;
  Utf16Decoder decoder_{true};
  char end_       = '\n';
  std::size_t at_ = 0;
  double done_    = 0;
  int number_     = 0;
  bool mark_ = false, open_end_ = false;
};

/// Lines of a text file by some looks at it, since its first lines may be much shorter than the others; exact
/// below 2 MiB.
/// @throws InputError, SystemError  as the constructor of LineSource
double expected_lines(const std::string &path);
}  // namespace mill::twin
