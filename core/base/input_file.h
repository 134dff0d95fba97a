#pragma once
#include <cstddef>
#include <string>

namespace mill {
/// A regular file that is read block by block; a call that a signal interrupts is made again.
class InputFile {
public:
  /// @throws InputError  not there, not a regular file, or not permitted; SystemError  the disk refuses it
  explicit InputFile(const std::string &path);
  ~InputFile();
  InputFile(const InputFile &)            = delete;
  InputFile &operator=(const InputFile &) = delete;

  /// The next bytes.  @return how many, less than `n` only at the end of the file
  std::size_t read(char *bytes, std::size_t n);
  void go_to(std::size_t byte);
  double size() const  ///< byte
  {
    return size_;
  }

private:
  std::string path_;
  int number_  = -1;
  double size_ = 0;
};

/// Refuses a file that does not fit into memory before it is read.
/// @param size    byte, of the file
/// @param needed  byte, what reading it takes
/// @throws InputError  with the size of the file and the memory that is left
void require_memory(const std::string &path, double size, double needed);
}  // namespace mill
