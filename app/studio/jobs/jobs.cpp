#include "app/studio/jobs/jobs.h"
#include "core/base/errors.h"
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <mutex>
#include <spawn.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

extern char **environ;

namespace mill::studio {
namespace {
constexpr std::size_t most_said = 4000;  // bytes

// Starts a program in a process group of its own, its output in a pipe.
pid_t start_with_pipe(const std::string &file, const std::vector<std::string> &arguments, const int output)
{
  std::vector<std::string> words{file};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char *> pointers;
  for (std::string &word : words)
    pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
  pid_t process   = 0;
  const int error = posix_spawn(&process, file.c_str(), &actions, &attributes, pointers.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0)
    throw InputError("the program '" + file + "' cannot be started: " + std::strerror(error));
  return process;
}

double now()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// " 37 %  contact upper": per cent and stage of a line of progress; false for another line.
bool is_progress(const std::string &line, int &percent, std::string &stage)
{
  char *end          = nullptr;
  const long number  = std::strtol(line.c_str(), &end, 10);
  const bool matches = end != line.c_str() && std::strncmp(end, " %  ", 4) == 0 && number >= 0 && number <= 100;
  if (matches) {
    percent = int(number);
    stage   = end + 4;
  }
  return matches;
}
}  // namespace

struct Jobs::State {
  std::function<void(const JobState &)> changed;
  mutable std::mutex access;
  JobState job;
  double begin     = 0;
  pid_t process    = 0;  // 0: nothing runs
  bool to_be_ended = false;
  std::mutex starts;   // held while a program is started, and at the end
  bool ended = false;  // guarded by `starts`
  std::thread reader;  // likewise

  JobState with_time() const
  {
    JobState s = job;
    if (process != 0)
      s.seconds = now() - begin;
    if (process != 0 && s.percent > 2)
      s.left = s.seconds * (100 - s.percent) / s.percent;
    return s;
  }
  void tell()
  {
    JobState s;
    {
      const std::lock_guard lock(access);
      s = with_time();
    }
    changed(s);
  }
  void take_line(const std::string &line)
  {
    bool progress = false;
    {
      const std::lock_guard lock(access);
      progress = is_progress(line, job.percent, job.stage);
      if (!progress)
        job.printed += line + "\n";
      if (job.printed.size() > most_said)
        job.printed.erase(0, job.printed.size() - most_said);
    }
    if (progress)
      tell();
  }
  void read_until_the_end(const int pipe, const pid_t child)
  {
    std::string line;
    std::array<char, 4096> buffer;
    for (ssize_t n; (n = ::read(pipe, buffer.data(), buffer.size())) > 0 || (n < 0 && errno == EINTR);)
      for (ssize_t i = 0; i < n; ++i)
        if (buffer[std::size_t(i)] != '\n')
          line += buffer[std::size_t(i)];
        else {
          take_line(line);
          line.clear();
        }
    close(pipe);
    if (!line.empty())
      take_line(line);
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR)
      ;
    {
      const std::lock_guard lock(access);
      job.seconds = now() - begin;
      job.status  = WIFEXITED(status) && WEXITSTATUS(status) == 0 ? JobStatus::done  // before it was cancelled
                    : to_be_ended                                 ? JobStatus::cancelled
                                                                  : JobStatus::failed;
      if (job.status == JobStatus::done)
        job.percent = 100;
      process = 0;
    }
    tell();
  }
};

Jobs::Jobs(std::function<void(const JobState &)> changed) : state_(std::make_unique<State>())
{
  state_->changed = std::move(changed);
}

Jobs::~Jobs()
{
  end();
}

void Jobs::end()
{
  const std::lock_guard alone(state_->starts);
  state_->ended = true;
  cancel();
  if (state_->reader.joinable())
    state_->reader.join();
}

void Jobs::start(const std::string &id, const std::string &program, const std::vector<std::string> &arguments,
                 const std::string &file)
{
  State &s = *state_;
  const std::lock_guard alone(s.starts);
  if (s.ended)
    throw InputError("the studio ends; nothing is started");
  {
    const std::lock_guard lock(s.access);
    if (s.process != 0)
      throw InputError(s.job.id + " is running; wait for its end, or cancel it");
  }
  if (s.reader.joinable())
    s.reader.join();
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0)
    refuse_file(errno, "the run cannot be started");
  const auto path = (std::filesystem::read_symlink("/proc/self/exe").parent_path() / program).string();
  {
    const std::lock_guard lock(s.access);
    try {
      s.process = start_with_pipe(path, arguments, ends[1]);
    } catch (const InputError &) {
      close(ends[0]);
      close(ends[1]);
      throw;
    }
    s.job         = {};
    s.job.id      = id;
    s.job.file    = file;
    s.job.status  = JobStatus::running;
    s.job.stage   = "begins";
    s.begin       = now();
    s.to_be_ended = false;
  }
  close(ends[1]);
  s.reader = std::thread([&s, pipe = ends[0], child = s.process] { s.read_until_the_end(pipe, child); });
  s.tell();
}

void Jobs::cancel()
{
  const std::lock_guard lock(state_->access);
  if (state_->process == 0)
    return;
  state_->to_be_ended = true;
  kill(-state_->process, SIGTERM);
}

JobState Jobs::state() const
{
  const std::lock_guard lock(state_->access);
  return state_->with_time();
}
}  // namespace mill::studio
