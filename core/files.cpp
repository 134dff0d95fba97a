#include "core/files.h"
#include "core/errors.h"
#include <atomic>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <sstream>
#include <sys/stat.h>
#include <unistd.h>

namespace mill {
namespace {
[[noreturn]] void cannot_write(const std::string &path, const int error)
{
  throw InputError(Place{path}, fmt::format("cannot be written: {}", std::strerror(error)));
}

// Everything, or the error number.
int write_all(const int file, const std::string &text)
{
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = ::write(file, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR)
      continue;
    if (n < 0)
      return errno;
    done += std::size_t(n);
  }
  return ::fsync(file) == 0 ? 0 : errno;
}
}  // namespace

void write_atomically(const std::string &path, const std::string &text)
{
  // A rename is atomic only inside one file system, hence a name in the same folder, of this process and call
  // alone.
  static std::atomic<unsigned> calls{0};
  const std::string temporary = fmt::format("{}.{}-{}.part", path, ::getpid(), calls++);
  const int file              = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0)
    cannot_write(path, errno);
  int error = write_all(file, text);
  if (::close(file) != 0 && error == 0)
    error = errno;
  if (error == 0 && std::rename(temporary.c_str(), path.c_str()) != 0)
    error = errno;
  if (error != 0) {
    ::unlink(temporary.c_str());
    cannot_write(path, error);
  }
}

std::string read_text(const std::string &path)
{
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    throw InputError(Place{path}, "cannot be read: it is a folder");
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw InputError(Place{path}, fmt::format("cannot be read: {}", std::strerror(errno)));
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
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
