#include "core/records/cache_entry.h"
#include "core/base/files.h"
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace mill {
namespace {
// Four sums over words of eight bytes by turns, then the odd bytes, then the sums: what is kept of a roll has 50
// MB, and a sum byte by byte takes longer than reading them.  Each step can be undone (exclusive or, product with
// an odd number, rotation), so that no change of a single word is lost.
std::string checksum_of(const std::string &bytes)
{
  constexpr std::uint64_t factor = 0x9e3779b97f4a7c15u;  // 2^64 over the golden ratio, made odd
  const auto add                 = [](std::uint64_t &sum, const std::uint64_t word) {
    sum = (sum ^ word) * factor;
    sum = sum << 29 | sum >> 35;
  };
  constexpr std::size_t lanes = 4, stride = lanes * sizeof(std::uint64_t);
  std::uint64_t sums[lanes] = {1, 2, 3, 4}, total = bytes.size();
  std::size_t position = 0;
  for (; position + stride <= bytes.size(); position += stride) {
    std::uint64_t words[lanes];
    std::memcpy(words, bytes.data() + position, stride);
    for (std::size_t lane = 0; lane < lanes; ++lane)
      add(sums[lane], words[lane]);
  }
  for (; position < bytes.size(); ++position)
    add(total, static_cast<unsigned char>(bytes[position]));
  for (const std::uint64_t sum : sums)
    add(total, sum);
  return fmt::format("words {:016x}", total);
}

// All bytes of an open regular file, or the error number.
int read_all(const int file, const std::size_t expected, std::string &text)
{
  text.resize(expected);
  std::size_t done = 0;
  while (done < expected) {
    const ssize_t n = ::read(file, &text[done], expected - done);
    if (n < 0 && errno == EINTR)
      continue;
    if (n < 0)
      return errno;
    if (n == 0)
      break;  // shortened meanwhile; the checksum tells
    done += std::size_t(n);
  }
  text.resize(done);
  return 0;
}

// Text of a regular file; otherwise empty, and why not, or no reason when there is nothing at the path.
std::string text_of(const std::string &path, std::string &reason)
{
  // O_NONBLOCK: opening a pipe would wait for somebody who writes into it.
  const int file = open_file(path, O_RDONLY | O_NONBLOCK);
  if (file < 0) {
    if (errno != ENOENT)
      reason = std::strerror(errno);
    return "";
  }
  std::string text;
  struct stat status {};
  if (::fstat(file, &status) != 0)
    reason = std::strerror(errno);
  else if (!S_ISREG(status.st_mode))
    reason = S_ISDIR(status.st_mode) ? "it is a folder" : "it is not a regular file";
  else if (const int error = read_all(file, std::size_t(status.st_size), text); error != 0)
    reason = std::strerror(error);
  else if (text.empty())
    reason = "it is empty";
  ::close(file);
  return text;
}
}  // namespace

void write_cache_entry(const std::string &path, const std::string &kind, const std::string &key,
                       const std::string &bytes)
{
  std::error_code error;
  if (std::filesystem::is_other(std::filesystem::symlink_status(path, error)))
    std::filesystem::remove(path, error);  // a pipe or a device in the cache makes room
  write_atomically(path, kind + "\n" + key + "\n" + checksum_of(bytes) + "\n" + bytes);
}

std::optional<std::string> read_cache_entry(const std::string &path, const std::string &kind,
                                            const std::string &key, std::string *note)
{
  std::string reason;
  std::string text   = text_of(path, reason);
  const auto refused = [&](const std::string &why) {
    if (note && !why.empty())
      *note = path + " is not used: " + why;
    return std::nullopt;
  };
  if (!reason.empty() || text.empty())
    return refused(reason);
  const std::size_t key_at = kind.size() + 1, sum_at = key_at + key.size() + 1;
  if (text.substr(0, key_at) != kind + "\n")
    return refused("it is not a " + kind);
  if (text.substr(std::min(key_at, text.size()), key.size() + 1) != key + "\n")
    return refused("it belongs to other inputs");
  const std::size_t sum_end = text.find('\n', sum_at);
  if (sum_end == std::string::npos)
    return refused("it is incomplete");
  const std::string sum = text.substr(sum_at, sum_end - sum_at);
  text.erase(0, sum_end + 1);
  if (checksum_of(text) != sum)
    return refused("its checksum is wrong");
  ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0);  // used now, for keep_cache_below()
  return text;
}
}  // namespace mill
