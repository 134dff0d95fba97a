#include "app/study/earlier_ends.h"
#include "app/study/store/row_files.h"
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <unistd.h>

namespace mill {
namespace {
constexpr int most_crashes = 2, most_ends = 6;
char mark_of_crash[4096];

extern "C" void leave_mark(const int signal)
{
  if (const int mark = ::open(mark_of_crash, O_CREAT | O_WRONLY | O_CLOEXEC, 0666); mark >= 0)
    ::close(mark);
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}
}  // namespace

std::map<std::int64_t, EarlierEnds> earlier_ends(const std::string &folder, const std::string &shard)
{
  std::map<std::int64_t, EarlierEnds> ends;
  for (const std::string &file : row_files(folder, shard)) {
    const bool crashed = std::filesystem::exists(crash_mark(file));
    for (const std::int64_t key : begun_rows(file))
      ends[key] = {ends[key].all + 1, ends[key].crashes + crashed};
  }
  return ends;
}

bool gives_up(const EarlierEnds &ends)
{
  return ends.crashes >= most_crashes || ends.all >= most_ends;
}

std::string sentence_of(const EarlierEnds &ends)
{
  return fmt::format("ended the program {} times; not tried again while the study has its rows and finished.db",
                     ends.all);
}

void mark_own_crash(const std::string &path)
{
  if (path.size() >= sizeof mark_of_crash)
    return;
  std::strcpy(mark_of_crash, path.c_str());
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT})
    std::signal(signal, leave_mark);
}
}  // namespace mill
