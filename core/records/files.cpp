#include "core/records/files.h"
#include "core/case/errors.h"
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <random>
#include <sys/stat.h>
#include <unistd.h>

namespace mill {
namespace {
[[noreturn]] void cannot(const char *what, const std::string &path, const std::string &reason)
{
  throw InputError(Place{path}, fmt::format("cannot be {}: {}", what, reason));
}

[[noreturn]] void cannot(const char *what, const std::string &path, const int error)
{
  cannot(what, path, std::strerror(error));
}

// A call that a signal interrupted is made again.
template <class Call> auto uninterrupted(const Call &call)
{
  auto result = call();
  while (result < 0 && errno == EINTR)
    result = call();
  return result;
}

class Descriptor {
public:
  Descriptor(const std::string &path, const int flags)
      : number(uninterrupted([&] { return ::open(path.c_str(), flags | O_CLOEXEC | O_NOCTTY, 0666); }))
  {
  }
  ~Descriptor()
  {
    if (number >= 0)
      ::close(number);
  }
  Descriptor(const Descriptor &)            = delete;
  Descriptor &operator=(const Descriptor &) = delete;
  // Closed now; 0 or the error number.  What an interrupted close has closed stays closed.
  int close()
  {
    const int error = ::close(number) == 0 || errno == EINTR ? 0 : errno;
    number          = -1;
    return error;
  }
  int number;
};

// Why such a file is not read or replaced; empty for a regular file.
std::string other_kind(const mode_t mode)
{
  if (S_ISREG(mode))
    return "";
  if (S_ISDIR(mode))
    return "it is a folder";
  const char *kind = S_ISFIFO(mode) ? "a named pipe" : S_ISSOCK(mode) ? "a socket" : "a device";
  return fmt::format("it is {}; name a regular file", kind);
}

// Everything, or the error number.
int write_all(const int file, const std::string &text)
{
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = uninterrupted([&] { return ::write(file, text.data() + done, text.size() - done); });
    if (n < 0)
      return errno;
    done += std::size_t(n);
  }
  return uninterrupted([&] { return ::fsync(file); }) == 0 ? 0 : errno;
}
}  // namespace

void write_atomically(const std::string &path, const std::string &text)
{
  struct stat target {};
  if (::lstat(path.c_str(), &target) == 0 && !S_ISLNK(target.st_mode) && !S_ISDIR(target.st_mode))
    if (const std::string kind = other_kind(target.st_mode); !kind.empty())
      cannot("written", path, kind);
  // A rename is atomic only inside one file system, hence a name in the same folder.
  const std::string temporary = name_aside(path);
  Descriptor file(temporary, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW);
  if (file.number < 0)
    cannot("written", path, errno);
  int error        = write_all(file.number, text);
  const int closed = file.close();
  if (error == 0)
    error = closed;
  if (error == 0 && uninterrupted([&] { return std::rename(temporary.c_str(), path.c_str()); }) != 0)
    error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    cannot("written", path, error);
  }
}

std::string read_text(const std::string &path)
{
  const Descriptor file(path, O_RDONLY | O_NONBLOCK);  // a pipe without a writer would be waited for
  struct stat found {};
  if (file.number < 0 || ::fstat(file.number, &found) != 0)
    cannot("read", path, errno);
  if (const std::string kind = other_kind(found.st_mode); !kind.empty())
    cannot("read", path, kind);
  std::string text, block(1 << 16, '\0');
  text.reserve(std::min<std::size_t>(std::size_t(found.st_size), 1 << 26));  // a size may be a lie
  while (true) {
    const ssize_t n = uninterrupted([&] { return ::read(file.number, block.data(), block.size()); });
    if (n < 0)
      cannot("read", path, errno);
    if (n == 0)
      return text;
    text.append(block, 0, std::size_t(n));
  }
}

std::optional<std::string> text_if_readable(const std::string &path)
{
  try {
    return read_text(path);
  } catch (const InputError &) {
    return {};
  }
}

std::string random_name()
{
  std::random_device bits;
  return fmt::format("{:08x}{:08x}", bits(), bits());
}

std::string name_aside(const std::string &path, const std::string &ending)
{
  return path + "." + random_name() + ending;
}

void sync_to_disk(const std::string &path)
{
  const Descriptor file(path, O_RDONLY | O_NONBLOCK | O_NOFOLLOW);
  if (file.number < 0)
    cannot("written", path, errno);
  if (uninterrupted([&] { return ::fsync(file.number); }) != 0 && errno != EINVAL && errno != EROFS)
    cannot("written", path, errno);
}

std::string hash_of(const std::string &bytes)
{
  std::uint64_t hash = 0xcbf29ce484222325u;  // offset basis and prime of 64-bit FNV-1a (Fowler, Noll, Vo)
  for (const char c : bytes) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 0x100000001b3u;
  }
  return fmt::format("{:016x}", hash);
}

std::string slug(const std::string &name)
{
  std::string out;
  for (const char c : name)
    if (std::isalnum(static_cast<unsigned char>(c)))
      out += char(std::tolower(static_cast<unsigned char>(c)));
    else if (!out.empty() && out.back() != '-')
      out += '-';
  while (!out.empty() && out.back() == '-')
    out.pop_back();
  return out.empty() ? "pass" : out;
}
}  // namespace mill
