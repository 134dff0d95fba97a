#pragma once
#include <fstream>
#include <string>
#include <string_view>

namespace mill::twin {
/// Lines of a text file of any length, read block by block; UTF-16 and Windows-1252 become UTF-8.
class LineSource {
public:
  /// @throws InputError  no such file, no regular file; SystemError  the system refuses it
  explicit LineSource(const std::string &path);

  /// The next line without its end; the view holds until the next call.  False at the end of the file.
  bool next(std::string_view &line);
  int number() const;  ///< of the line that next() gave, from 1
  bool ended_without_newline() const;
  const std::string &encoding() const;  ///< "UTF-8", "UTF-16 little endian", ..
  bool had_mark() const;                ///< a byte-order mark stood at the beginning
  double size() const;                  ///< byte
  double done() const;                  ///< byte, read so far

private:
  bool fill();
  void append_utf16(const char *bytes, std::size_t n);

  std::ifstream file_;
  std::string path_, buffer_, encoding_ = "UTF-8";
  std::string raw_, half_;
  std::size_t at_ = 0;
  double size_ = 0, done_ = 0;
  int number_ = 0;
  bool mark_ = false, open_end_ = false;
  unsigned high_surrogate_ = 0;
};

/// Text that is no UTF-8 taken for Windows-1252, the encoding of western Windows: "\xB5" becomes the micro sign.
std::string utf8_of(std::string_view text, bool &converted);
}  // namespace mill::twin
