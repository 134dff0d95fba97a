#include "core/base/files.h"
#include "core/base/errors.h"
#include "core/base/input_file.h"
#include "core/base/name_part.h"
#include "core/base/save_in_place.h"
#include "core/base/text.h"
#include "core/base/uninterrupted.h"
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <dirent.h>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <random>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace mill {
namespace {
[[noreturn]] void cannot(const char *what, const std::string &path, const std::string &reason)
{
  throw InputError(Place{path}, fmt::format("cannot be {}: {}", what, reason));
}

[[noreturn]] void cannot_read(const std::string &path, const int error)
{
  if (error == EACCES || error == EPERM)  // of an input: the user named a file that is not theirs
    cannot("read", path, std::strerror(error));
  refuse_file(error, Place{path}, fmt::format("cannot be read: {}", std::strerror(error)));
}

[[noreturn]] void cannot_write(const std::string &path, const int error)
{
  refuse_file(error, Place{path}, fmt::format("cannot be written: {}", std::strerror(error)));
}

class Descriptor {
public:
  Descriptor(const std::string &path, const int flags) : number(open_file(path, flags)) {}
  ~Descriptor()
  {
    if (number >= 0)
      ::close(number);
  }
  explicit Descriptor(const int opened) : number(opened) {}
  Descriptor(Descriptor &&other) : number(std::exchange(other.number, -1)) {}
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

// The file that is written aside, new and locked as long as it is open: remove_stale_parts() tells a living writer
// by the lock.  One that it took for dead between open and lock is gone, and made again.
Descriptor opened_aside(const std::string &temporary)
{
  while (true) {
    Descriptor file(temporary, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW);
    struct stat status {};
    if (file.number < 0 || !lock_file(file.number, LOCK_EX) || ::fstat(file.number, &status) != 0 ||
        status.st_nlink > 0)
      return file;
  }
}

// "name.<16 hex digits>.part"
bool is_part_name(const std::string &name)
{
  const std::size_t tail = std::strlen(".0123456789abcdef.part");
  return name.size() > tail && name[name.size() - tail] == '.' && text_ends_with(name, ".part") &&
         has_only(name.substr(name.size() - tail + 1, 16), "0123456789abcdef");
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

namespace {
// Mode and, where the system allows it, owner of the file that is replaced; 0 or the error number.
int become_like(const int file, const struct stat &old)
{
  if (::fchown(file, old.st_uid, old.st_gid) != 0)
    errno = 0;  // of another user: the file becomes ours, as with every editor that renames
  return ::fchmod(file, old.st_mode & 0777) == 0 ? 0 : errno;
}

void replace_file(const std::string &path, const std::string &text, const bool keep_mode)
{
  struct stat target {};
  const bool exists = ::lstat(path.c_str(), &target) == 0;
  if (exists && !S_ISLNK(target.st_mode) && !S_ISDIR(target.st_mode))
    if (const std::string kind = other_kind(target.st_mode); !kind.empty())
      cannot("written", path, kind);
  // A rename is atomic only inside one file system, hence a name in the same folder.
  const std::string temporary = name_aside(path);
  Descriptor file             = opened_aside(temporary);
  if (file.number < 0)
    cannot_write(path, errno);
  const Descriptor lock(::fcntl(file.number, F_DUPFD_CLOEXEC, 0));  // ours until the file has its name
  int error = keep_mode && exists && S_ISREG(target.st_mode) ? become_like(file.number, target) : 0;
  if (error == 0)
    error = write_all(file.number, text);
  const int closed = file.close();
  if (error == 0)
    error = closed;
  if (error == 0 && uninterrupted([&] { return std::rename(temporary.c_str(), path.c_str()); }) != 0)
    error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    cannot_write(path, error);
  }
}
}  // namespace

void write_atomically(const std::string &path, const std::string &text)
{
  replace_file(path, text, false);
}

void save_in_place(const std::string &path, const std::string &text)
{
  std::error_code error;
  const auto file = std::filesystem::canonical(path, error);  // a new file, and a link to nothing, have none
  replace_file(error ? path : file.string(), text, true);
}

std::string read_text(const std::string &path)
{
  const Descriptor file(path, O_RDONLY | O_NONBLOCK);  // a pipe without a writer would be waited for
  struct stat status {};
  if (file.number < 0 || ::fstat(file.number, &status) != 0)
    cannot_read(path, errno);
  if (const std::string kind = other_kind(status.st_mode); !kind.empty())
    cannot("read", path, kind);
  require_memory(path, double(status.st_size), 2.0 * double(status.st_size));
  std::string text, block(1 << 16, '\0');
  text.reserve(std::min<std::size_t>(std::size_t(status.st_size), 1 << 26));  // a size may be a lie
  while (true) {
    const ssize_t n = uninterrupted([&] { return ::read(file.number, block.data(), block.size()); });
    if (n < 0)
      cannot_read(path, errno);
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
  constexpr std::size_t longest = 255;  // bytes of a name: NAME_MAX of every file system that Linux has
  const std::string tail        = "." + random_name() + ending;
  const std::size_t begin       = path.find_last_of('/') + 1;
  std::size_t kept              = std::min(path.size(), begin + longest - tail.size());
  while (kept < path.size() && kept > begin && (path[kept] & 0xC0) == 0x80)  // whole characters
    --kept;
  return path.substr(0, kept) + tail;
}

void remove_stale_parts(const std::string &folder)
{
  std::error_code error;
  for (const std::string &name : names_in(folder, error)) {
    if (!is_part_name(name))
      continue;
    const std::string path = folder + "/" + name;
    const Descriptor part(path, O_RDWR | O_NOFOLLOW | O_NONBLOCK);
    struct stat status {};
    if (part.number >= 0 && ::fstat(part.number, &status) == 0 && S_ISREG(status.st_mode) &&
        lock_file(part.number, LOCK_EX | LOCK_NB))
      ::unlink(path.c_str());
  }
}

int open_file(const std::string &path, const int flags)
{
  return uninterrupted([&] { return ::open(path.c_str(), flags | O_CLOEXEC | O_NOCTTY, 0666); });
}

std::vector<std::string> names_in(const std::string &folder, std::error_code &error)
{
  std::vector<std::string> names;
  do {
    names.clear();
    errno              = 0;
    DIR *const entries = ::opendir(folder.c_str());
    if (entries) {
      while (const dirent *entry = ::readdir(entries))  // nullptr at the end and after an error
        names.push_back(entry->d_name);
      const int reason = errno;
      ::closedir(entries);
      errno = reason;
    }
  } while (errno == EINTR);
  error.assign(errno, std::generic_category());
  if (error)
    return {};
  names.erase(std::remove_if(names.begin(), names.end(),
                             [](const std::string &name) { return name.size() <= 2 && has_only(name, "."); }),
              names.end());
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> names_in(const std::string &folder)
{
  std::error_code error;
  auto names = names_in(folder, error);
  if (error)
    cannot_read(folder, error.value());
  return names;
}

void remove_folder(const std::string &path)
{
  std::error_code error;
  do
    std::filesystem::remove_all(path, error);
  while (error == std::errc::interrupted);
}

bool lock_file(const int file, const int how)
{
  return uninterrupted([&] { return ::flock(file, how); }) == 0;
}

void sync_to_disk(const std::string &path)
{
  const Descriptor file(path, O_RDONLY | O_NONBLOCK | O_NOFOLLOW);
  if (file.number < 0)
    cannot_write(path, errno);
  if (uninterrupted([&] { return ::fsync(file.number); }) != 0 && errno != EINVAL && errno != EROFS)
    cannot_write(path, errno);
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
  for (const char c : with_plain_names(name))
    if (std::isalnum(static_cast<unsigned char>(c)))
      out += char(std::tolower(static_cast<unsigned char>(c)));
    else if (!out.empty() && out.back() != '-')
      out += '-';
  while (!out.empty() && out.back() == '-')
    out.pop_back();
  return out.empty() ? "pass" : out;
}
}  // namespace mill
