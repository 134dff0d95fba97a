#include "app/studio/document/journal.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace mill::studio {
namespace {
void write_all(const int file, const std::string &text, const std::string &path)
{
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(file, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR)
      continue;
    if (n <= 0)
      refuse_file(n < 0 ? errno : ENOSPC, {path, 0, 0}, "the journal of the studio cannot be written");
    done += std::size_t(n);
  }
}
}  // namespace

std::string journal_path(const std::string &case_path)
{
  const fs::path path(case_path);
  return (path.parent_path() / ("." + path.filename().string() + ".studio")).string();
}

Journal::Journal(std::string path) : path_(std::move(path))
{
  file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (file_ < 0)
    refuse_file(errno, {path_, 0, 0}, "the journal of the studio cannot be opened");
  if (!lock_file(file_, LOCK_EX | LOCK_NB)) {
    close(file_);
    throw InputError({path_, 0, 0}, "another millstand studio works on this case; use its page, or end it");
  }
}

Journal::~Journal()
{
  close(file_);
}

std::vector<std::string> Journal::lines()
{
  const std::string text = read_text(path_);
  std::vector<std::string> lines;
  std::size_t begin = 0;
  for (std::size_t end; (end = text.find('\n', begin)) != std::string::npos; begin = end + 1)
    lines.push_back(text.substr(begin, end - begin));
  if (begin < text.size() && ftruncate(file_, off_t(begin)) != 0)
    refuse_file(errno, {path_, 0, 0}, "the journal of the studio cannot be written");
  bytes_ = begin;
  return lines;
}

void Journal::append(const std::string &line)
{
  const auto before = off_t(bytes_);
  try {
    write_all(file_, line + "\n", path_);
    if (fdatasync(file_) != 0)
      refuse_file(errno, {path_, 0, 0}, "the journal of the studio cannot be written");
  } catch (const InputError &) {  // half a line would spoil the next one
    (void)!ftruncate(file_, before);
    throw;
  }
  bytes_ += line.size() + 1;
}

void Journal::replace(const std::vector<std::string> &lines)
{
  std::string text;
  for (const std::string &line : lines)
    text += line + "\n";
  const std::string aside = name_aside(path_);
  const int fresh = open(aside.c_str(), O_RDWR | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0600);
  if (fresh < 0)
    refuse_file(errno, {path_, 0, 0}, "the journal of the studio cannot be written");
  try {
    write_all(fresh, text, path_);
    if (!lock_file(fresh, LOCK_EX | LOCK_NB) || fdatasync(fresh) != 0 || rename(aside.c_str(), path_.c_str()) != 0)
      refuse_file(errno, {path_, 0, 0}, "the journal of the studio cannot be written");
  } catch (const InputError &) {
    close(fresh);
    unlink(aside.c_str());
    throw;
  }
  close(file_);
  file_  = fresh;
  bytes_ = text.size();
}

std::string Journal::set_aside()
{
  const std::string text = read_text(path_);
  std::string aside      = path_ + ".old";
  int file               = -1;
  // An earlier one may hold the only copy of what somebody typed.
  for (int n = 2; (file = open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600)) < 0;
       ++n)
    if (errno == EEXIST)
      aside = fmt::format("{}.old-{}", path_, n);
    else
      refuse_file(errno, {aside, 0, 0}, "the journal of the studio cannot be set aside");
  try {
    write_all(file, text, aside);
    if (fdatasync(file) != 0 || ftruncate(file_, 0) != 0)
      refuse_file(errno, {path_, 0, 0}, "the journal of the studio cannot be written");
  } catch (const InputError &) {
    close(file);
    unlink(aside.c_str());
    throw;
  }
  close(file);
  bytes_ = 0;
  return aside;
}

std::size_t Journal::bytes() const
{
  return bytes_;
}
}  // namespace mill::studio
