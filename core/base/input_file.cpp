#include "core/base/input_file.h"
#include "core/base/errors.h"
#include "core/base/uninterrupted.h"
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace mill {
namespace {
constexpr double usable_share = 0.7;  // of the machine's memory, for one file

}  // namespace

InputFile::InputFile(const std::string &path) : path_(path)
{
  // O_NONBLOCK: a pipe without a writer would be waited for.
  number_ = uninterrupted([&] { return ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY); });
  struct stat status {};
  const int error = number_ < 0 || ::fstat(number_, &status) != 0 ? errno : 0;
  if (error == 0 && S_ISREG(status.st_mode)) {
    size_ = double(status.st_size);
    return;
  }
  if (number_ >= 0)
    ::close(number_);
  if (error == ENOENT || error == ENOTDIR)
    throw InputError("there is no file " + path);
  if (error == 0)
    throw InputError(path + " is not a regular file; a record is read from a file");
  if (error == EACCES || error == EPERM)
    throw InputError(path + " cannot be read: " + std::strerror(error));
  refuse_file(error, path + " cannot be read: " + std::strerror(error));
}

InputFile::~InputFile()
{
  ::close(number_);
}

std::size_t InputFile::read(char *bytes, const std::size_t n)
{
  std::size_t done = 0;
  while (done < n) {
    const ssize_t got = uninterrupted([&] { return ::read(number_, bytes + done, n - done); });
    if (got < 0)
      refuse_file(errno, path_ + " cannot be read: " + std::strerror(errno));
    if (got == 0)
      break;
    done += std::size_t(got);
  }
  return done;
}

void InputFile::go_to(const std::size_t byte)
{
  if (::lseek(number_, off_t(byte), SEEK_SET) < 0)
    refuse_file(errno, path_ + " cannot be read: " + std::strerror(errno));
}

void require_memory(const std::string &path, const double size, const double needed)
{
  const double memory = double(::sysconf(_SC_PHYS_PAGES)) * double(::sysconf(_SC_PAGESIZE));
  if (needed > usable_share * memory)
    throw InputError(
        fmt::format("{} has {:.3g} GB; reading it takes {:.3g} GB of memory, and this machine has {:.3g} "
                    "GB; split the record into shorter ones",
                    path, 1e-9 * size, 1e-9 * needed, 1e-9 * memory));
}
}  // namespace mill
