#include "app/study/worker_processes.h"
#include "app/study/row_model.h"
#include "app/study/started_program.h"
#include <algorithm>
#include <csignal>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <sys/wait.h>
#include <thread>

namespace mill {
namespace {
constexpr int most_restarts  = 100;
constexpr auto between_waits = std::chrono::milliseconds(5);

class WorkerProcesses {
public:
  WorkerProcesses(const Study &asked, const CommandLine &command, const long n_jobs) : study(asked), jobs(n_jobs)
  {
    const long processors = long(std::max(1u, std::thread::hardware_concurrency()));
    const long threads    = command.threads > 0 ? command.threads : std::max(1L, processors / jobs);
    common                = {"-q", "--threads", std::to_string(threads)};
    if (!command.cache.empty())
      common.insert(common.end(), {"--cache", command.cache});
    if (cache_limit(command) > 0)
      common.insert(common.end(), {"--cache-limit", command.sweep.cache_limit});
    if (!command.memory.empty())
      common.insert(common.end(), {"--memory", command.memory});
    if (command.study.keep)
      common.push_back("--keep");
    if (command.fresh)
      common.push_back("--fresh");
  }

  int work(const CutSignal &signal, RowWatch &watch)
  {
    for (long i = 1; i <= jobs; ++i)
      start(i);
    int worst = 0;
    bool sent = false;
    while (!running.empty()) {
      if (signal.asked() && !sent) {
        for (const auto &[process, shard] : running)
          ::kill(process, SIGTERM);
        sent = true;
      }
      const auto ended = end_of_one();
      if (!ended) {
        watch.look();
        std::this_thread::sleep_for(between_waits);
        continue;
      }
      const auto [shard, status] = *ended;
      const bool crashed         = WIFSIGNALED(status);
      if (crashed && !signal.asked() && ++restarts <= most_restarts)
        start(shard);
      else
        worst = std::max(worst, crashed ? 3 : WEXITSTATUS(status));
    }
    return signal.asked() ? 128 + signal.asked() : worst;
  }

private:
  void start(const long shard)
  {
    std::vector<std::string> words{"study", "work", study.folder, "--shard", fmt::format("{}/{}", shard, jobs)};
    words.insert(words.end(), common.begin(), common.end());
    running[start_program(program_path("millstand-all"), words, "rows of a study")] = shard;
  }

  // Shard and status of a worker that has ended.
  std::optional<std::pair<long, int>> end_of_one()
  {
    for (auto one = running.begin(); one != running.end(); ++one) {
      int status = 0;
      if (::waitpid(one->first, &status, WNOHANG) != one->first)
        continue;
      const std::pair<long, int> ended{one->second, status};
      running.erase(one);
      return ended;
    }
    return {};
  }

  const Study &study;
  long jobs;
  int restarts = 0;
  std::vector<std::string> common;
  std::map<pid_t, long> running;
};
}  // namespace

int run_workers_here(const Study &study, const CommandLine &command, const long jobs, const CutSignal &signal,
                     RowWatch &watch)
{
  return WorkerProcesses(study, command, jobs).work(signal, watch);
}

int wait_or_end(const pid_t process, const CutSignal &signal, RowWatch &watch)
{
  bool sent = false;
  int status;
  while (::waitpid(process, &status, WNOHANG) == 0) {
    if (signal.asked() && !sent) {
      ::kill(process, SIGTERM);
      sent = true;
    }
    watch.look();
    std::this_thread::sleep_for(between_waits);
  }
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}
}  // namespace mill
