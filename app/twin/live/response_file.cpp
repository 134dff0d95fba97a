#include "app/twin/live/response_file.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/base/units.h"
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace mill {
ResponseFile::ResponseFile(std::string path, const bool overwrite, const bool at_end) : path_(std::move(path))
{
  std::error_code ignored;
  const auto status = std::filesystem::symlink_status(path_, ignored);
  replaces_         = overwrite && std::filesystem::is_regular_file(status);
  if (replaces_ && at_end)
    aside_ = name_aside(path_);
  const int mode = O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | (overwrite && aside_.empty() ? 0 : O_EXCL);
  const int file = ::open((aside_.empty() ? path_ : aside_).c_str(), mode, 0666);
  const int why  = errno;
  made_          = file >= 0 && aside_.empty() && status.type() == std::filesystem::file_type::not_found;
  if (file >= 0)
    file_ = ::fdopen(file, "w");
  if (file < 0 && (why == ELOOP || std::filesystem::is_symlink(status)))
    throw InputError(path_ + " is a symbolic link, and live does not write through it; name the file itself with "
                             "--response");
  if (file < 0 && why == EEXIST)
    throw InputError("the file " + path_ + " exists; choose another with --response, or give --force-overwrite");
  if (!file_)
    refuse_file(why, "cannot write " + path_ + ": " + std::strerror(why));
}

ResponseFile::~ResponseFile()
{
  if (file_)
    close();
}

// Without what was written aside, or a file in which there is nothing.
void ResponseFile::close()
{
  std::fclose(file_);
  file_ = nullptr;
  if (!aside_.empty())
    std::remove(aside_.c_str());
  else if (made_ && !written_)
    std::remove(path_.c_str());
}

bool ResponseFile::leaves_old_file() const
{
  return replaces_ && file_ && (!written_ || !aside_.empty());
}

void ResponseFile::begin(const live::LiveSource &source)
{
  if (!head_.empty())
    return;
  head_ = "s,time [s],force [N]";
  for (const std::string &place : source.places)
    head_ += "," + place + " [m/s2]";
  head_ += ",settling\n";
}

void ResponseFile::write_head()
{
  if (std::exchange(written_, true))
    return;
  if (replaces_ && aside_.empty() && ::ftruncate(::fileno(file_), 0) != 0)
    refuse_file(errno, "cannot write " + path_ + ": " + std::strerror(errno));
  std::fwrite(head_.data(), 1, head_.size(), file_);
}

void ResponseFile::take(const live::LiveBlock &block)
{
  write_head();
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (Eigen::Index i = 0; i < block.force.size(); ++i) {
    fmt::format_to(out, "{},{},{}", block.first + i, number_text(double(block.first + i) / block.rate),
                   number_text(block.force[i]));
    for (Eigen::Index p = 0; p < block.simulated.cols(); ++p)
      fmt::format_to(out, ",{}", number_text(block.simulated(i, p)));
    fmt::format_to(out, ",{}\n", block.settling ? 1 : 0);
  }
  if (std::fwrite(text.data(), 1, text.size(), file_) != text.size())
    problem_ = path_ + " cannot be written: " + std::strerror(errno) + "; it ends there, the twin goes on";
}

void ResponseFile::finish()
{
  if (!head_.empty() && !replaces_)
    write_head();
  if (!written_)
    return close();
  bool whole = std::fflush(file_) == 0 && !std::ferror(file_);
  std::fclose(file_);
  file_ = nullptr;
  if (!aside_.empty())
    whole = whole && std::rename(aside_.c_str(), path_.c_str()) == 0;
  if (!whole)
    throw SystemError(path_ + ": the file could not be written completely");
}
}  // namespace mill
