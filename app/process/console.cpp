#include "app/process/console.h"
#include "core/base/error_list.h"
#include "core/base/visible_text.h"
#include "core/process/stop.h"
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <mutex>
#include <unistd.h>
#include <vector>

namespace mill::console {
namespace {
void put(const std::string &text)
{
  std::fwrite(text.data(), 1, text.size(), stderr);
  std::fflush(stderr);
}

[[noreturn]] void output_failed(const int error)
{
  throw OutputError(std::string("standard output cannot be written: ") + std::strerror(error));
}
}  // namespace

void open_standard_files()
{
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(number, F_GETFD) < 0)
      ::open("/dev/null",
             number == STDIN_FILENO ? O_WRONLY : O_RDONLY);  // used the wrong way round: an error, as closed
}

void print(const std::string &text)
{
  const std::string shown = visible(text);
  if (std::fwrite(shown.data(), 1, shown.size(), stdout) != shown.size())
    output_failed(errno);
}

void flush()
{
  if (std::fflush(stdout) != 0)
    output_failed(errno);
}

void say(const std::string &text)
{
  put(visible(text));
}

// What one command has shown; bars may be shown from several threads.
struct CommandProgress {
  double done                                 = 0;  // share of the command, never falls
  double next_end                             = 1;
  int last_percent                            = -1;
  int line_every                              = 10;  // per cent
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  std::function<void(const std::string &, double)> listener;  // in place of the screen
};

namespace {
CommandProgress of_process;
thread_local std::shared_ptr<CommandProgress> heard;
std::mutex progress_access;

CommandProgress &of_command()
{
  return heard ? *heard : of_process;
}
}  // namespace

HeardProgress::HeardProgress(std::function<void(const std::string &, double)> listener)
{
  heard           = std::make_shared<CommandProgress>();
  heard->listener = std::move(listener);
}

HeardProgress::~HeardProgress()
{
  heard.reset();
}

void begin_progress()
{
  const std::lock_guard lock(progress_access);
  of_command() = {};
}

void next_bar_ends_at(const double share)
{
  const std::lock_guard lock(progress_access);
  of_command().next_end = share;
}

void progress_line_every(const int percent)
{
  const std::lock_guard lock(progress_access);
  of_command().line_every = percent;
}

struct ProgressBar::State {
  std::vector<std::pair<std::string, double>> stages;
  bool quiet, terminal;
  std::shared_ptr<CommandProgress> listened = heard;
  double begin = 0, end = 1;                                              // share of the command
  double done                  = 0;                                       // share of this bar, never falls
  std::vector<double> fraction = std::vector<double>(stages.size(), 0.);  // of each stage
};

ProgressBar::ProgressBar(std::vector<std::pair<std::string, double>> stages, const bool quiet)
    : state(new State{std::move(stages), quiet, isatty(STDERR_FILENO) == 1})
{
  const std::lock_guard lock(progress_access);
  CommandProgress &c = of_command();
  state->begin       = c.done;
  state->end         = std::max(c.done, c.next_end);
  c.next_end         = 1;
}

ProgressBar::~ProgressBar() = default;

void ProgressBar::show(const std::string &stage, const double fraction)
{
  stop_if_asked();
  State &s = *state;
  if (s.quiet && !s.listened)
    return;
  const std::lock_guard lock(progress_access);
  // Stages run side by side; the next report of a name that is done belongs to the next stage of that name.
  double all = 0, reached = 0;
  bool known = false;
  for (std::size_t i = 0; i < s.stages.size(); ++i) {
    if (!known && s.stages[i].first == stage && s.fraction[i] < 1) {
      s.fraction[i] = std::max(s.fraction[i], fraction);
      known         = true;
    }
    all += s.stages[i].second;
    reached += s.stages[i].second * s.fraction[i];
  }
  s.done             = std::max(s.done, all > 0 ? reached / all : fraction);
  CommandProgress &c = s.listened ? *s.listened : of_process;
  c.done             = std::max(c.done, s.begin + (s.end - s.begin) * std::min(1., s.done));
  if (c.listener) {
    c.listener(stage, c.done);
    return;
  }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - c.start;
  const int percent                           = int(100 * c.done);
  if (s.terminal) {
    const int filled = int(30 * c.done);
    const std::string left =
        c.done > 0.02 ? fmt::format("{:.0f} s left", elapsed.count() * (1 - c.done) / c.done) : "";
    put(fmt::format("\r\033[K[{}{}] {:3} %  {}  {}", std::string(filled, '#'), std::string(30 - filled, '.'),
                    percent, visible(stage, true), left));
  } else if (percent / c.line_every > c.last_percent / c.line_every || c.last_percent < 0) {
    say(fmt::format("{:3} %  {}\n", percent, stage));
    c.last_percent = percent;
  }
}

void ProgressBar::finish()
{
  if (!state->quiet && !state->listened && state->terminal)
    put("\r\033[K");
}

void show(const InputError &error)
{
  say(render_list(error.problems));
}

void show(const SolverError &error)
{
  const auto &r = error.report;
  say(visible(r.what, true) + "\n");
  if (!r.where.empty())
    say("  " + visible(r.where, true) + "\n");
  for (const auto &[name, text] :
       {std::pair{"usual cause", r.cause}, std::pair{"change", r.remedy}, std::pair{"kept", r.kept}})
    if (!text.empty())
      say(fmt::format("  {:<12}  {}\n", name, visible(text, true)));
}

void show(const OutputError &error)
{
  say(std::string("error: ") + error.what() + "\n");
}

void show_bug(const std::exception &error, const std::string &manifest)
{
  say(std::string("internal error of millstand: ") + error.what() + "\n" +
      "please report this with the case file" + (manifest.empty() ? "" : " and " + manifest) + "\n");
}
}  // namespace mill::console
