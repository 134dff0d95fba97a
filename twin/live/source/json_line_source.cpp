#include "core/base/errors.h"
#include "twin/live/source/file_sources.h"
#include <cerrno>
#include <cstring>
#include <poll.h>
#include <unistd.h>

namespace mill::live {
void read_json_lines(const int file, const SourceRules &rules, SampleQueue &queue, const std::atomic<bool> &stop)
{
  LineSession session(rules);
  LineCutter cutter;
  bool open       = true;
  const auto take = [&](const std::string_view line) {
    if (!open)
      return;
    LineSession::Answer answer = session.take(line);
    if (answer.message)
      open = queue.push(std::move(*answer.message));
    if (answer.close) {
      queue.push(SourceNote{"note", "the source was closed: " + answer.reply});
      open = false;
    }
  };
  char bytes[1 << 16];
  while (open && !stop && !queue.closed()) {
    pollfd ready{file, POLLIN, 0};
    if (::poll(&ready, 1, 50) <= 0)
      continue;
    const ssize_t n = ::read(file, bytes, sizeof bytes);
    if (n < 0 && (errno == EINTR || errno == EAGAIN))
      continue;
    if (n < 0)
      throw SystemError(std::string("standard input cannot be read: ") + std::strerror(errno));
    if (n == 0)
      break;
    cutter.add({bytes, std::size_t(n)}, take);
  }
  if (open && !cutter.rest().empty())
    take(std::string(cutter.rest()));
}
}  // namespace mill::live
