#include "app/run/run_log.h"
#include "app/run/output_dir.h"
#include "core/base/errors.h"
#include "core/base/visible_text.h"
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <mutex>
#include <regex>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace fs = std::filesystem;

namespace mill {
namespace {
[[noreturn]] void refuse(const std::string &file, const std::string &why)
{
  throw InputError("the log " + file + " " + why);
}

// Lines go to an open file as they come; the first failure is kept and never ends the run.
class FileSink : public spdlog::sinks::base_sink<std::mutex> {
public:
  FileSink(std::string file, const int descriptor, const bool ours)
      : name(std::move(file)), number(descriptor), closes_file(ours)
  {
  }
  ~FileSink() override
  {
    if (closes_file)
      ::close(number);
  }
  const std::string name;
  int error = 0;

protected:
  void sink_it_(const spdlog::details::log_msg &message) override
  {
    spdlog::memory_buf_t line;
    formatter_->format(message, line);
    for (std::size_t done = 0; done < line.size();) {
      const ssize_t n = ::write(number, line.data() + done, line.size() - done);
      if (n < 0 && errno == EINTR)
        continue;
      if (n < 0) {
        error = error == 0 ? errno : error;
        return;
      }
      done += std::size_t(n);
    }
  }
  void flush_() override {}

private:
  const int number;
  const bool closes_file;
};

void refuse_other_kinds(const std::string &file)
{
  struct stat status {};
  if (::lstat(file.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
    refuse(file, S_ISLNK(status.st_mode) ? "is a symbolic link; name the file that it points to"
                                         : "is not a regular file; name one with --log");
}

// The first line of a log begins with date, time and the name of the program.
void refuse_other_content(const std::string &file)
{
  static const std::regex first_line(R"(^\d{4}-\d\d-\d\d \d\d:\d\d:\d\d\.\d{3} millstand )");
  const std::string text = read_text(file);
  if (!text.empty() && !std::regex_search(text.substr(0, 60), first_line))
    refuse(file, "exists and is not a log of this program; choose another with --log, or remove it first");
}

void refuse_results(const std::string &file, const OutputDir &out)
{
  std::error_code ignored;
  const fs::path whole = fs::weakly_canonical(file, ignored);
  const auto &names    = result_names();
  if (whole.parent_path() == fs::weakly_canonical(out.path(), ignored) &&
      std::find(names.begin(), names.end(), whole.filename().string()) != names.end())
    refuse(file, "is one of the results in " + out.path() + "; choose another with --log");
}

std::shared_ptr<FileSink> opened(const std::string &file, const int flags)
{
  const int number = open_file(file, O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | flags);
  if (number < 0)
    refuse_file(errno, "the log " + file + " cannot be written: " + std::strerror(errno));
  return std::make_shared<FileSink>(file, number, true);
}

std::shared_ptr<FileSink> opened_log(const std::string &file, const OutputDir &out)
{
  refuse_other_kinds(file);
  refuse_results(file, out);
  if (fs::exists(file))
    refuse_other_content(file);
  return opened(file, O_TRUNC);
}
}  // namespace

struct RunLog::State {
  std::vector<std::shared_ptr<FileSink>> files;
  std::shared_ptr<spdlog::logger> log;
};

RunLog::RunLog(const OutputDir &out, const std::string &chosen, const bool verbose) : state(new State)
{
  State &s = *state;
  if (!chosen.empty())
    s.files.push_back(opened_log(chosen, out));
  s.files.push_back(opened(out.file("millstand.log"), O_EXCL));
  std::vector<spdlog::sink_ptr> sinks(s.files.begin(), s.files.end());
  if (verbose)
    sinks.push_back(std::make_shared<FileSink>("standard error", STDERR_FILENO, false));
  s.log = std::make_shared<spdlog::logger>("millstand", sinks.begin(), sinks.end());
  s.log->set_pattern("%Y-%m-%d %H:%M:%S.%e %v");
}

RunLog::~RunLog() = default;

void RunLog::line(const std::string &text) const
{
  state->log->info(visible(text, true));
}

void RunLog::require_complete() const
{
  for (const auto &file : state->files)
    if (file->error != 0)
      refuse_file(file->error, "the log " + file->name + " is not complete: " + std::strerror(file->error) +
                                   "; the results are");
}
}  // namespace mill
