#include "app/console.h"
#include "core/case/error_list.h"
#include "core/case/visible_text.h"
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
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

struct ProgressBar::State {
  std::vector<std::pair<std::string, double>> stages;
  bool quiet, terminal;
  double done                                 = 0;  // share of the whole, never falls
  int last_percent                            = -1;
  std::size_t stage_at                        = 0;  // how far in the list of stages
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
};

ProgressBar::ProgressBar(std::vector<std::pair<std::string, double>> stages, const bool quiet)
    : state(new State{std::move(stages), quiet, isatty(STDERR_FILENO) == 1})
{
}

ProgressBar::~ProgressBar() = default;

void ProgressBar::show(const std::string &stage, const double fraction)
{
  State &s = *state;
  if (s.quiet)
    return;
  // Stages come in the order of the list; one that is skipped (cached) counts as done.
  double before = 0, all = 0, own = 0;
  for (std::size_t i = s.stage_at; i < s.stages.size(); ++i)
    if (s.stages[i].first == stage) {
      s.stage_at = i;
      break;
    }
  for (std::size_t i = 0; i < s.stages.size(); ++i) {
    all += s.stages[i].second;
    before += i < s.stage_at ? s.stages[i].second : 0;
    own = i == s.stage_at ? s.stages[i].second : own;
  }
  s.done = std::max(s.done, all > 0 ? (before + own * fraction) / all : fraction);
  // The next report of the same name belongs to the next stage of that name.
  if (fraction >= 1 && s.stage_at < s.stages.size() && s.stages[s.stage_at].first == stage)
    ++s.stage_at;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - s.start;
  const int percent                           = int(100 * s.done);
  if (s.terminal) {
    const int filled = int(30 * s.done);
    const std::string left =
        s.done > 0.02 ? fmt::format("{:.0f} s left", elapsed.count() * (1 - s.done) / s.done) : "";
    put(fmt::format("\r\033[K[{}{}] {:3} %  {}  {}", std::string(filled, '#'), std::string(30 - filled, '.'),
                    percent, visible(stage, true), left));
  } else if (percent / 10 > s.last_percent / 10 || s.last_percent < 0) {
    say(fmt::format("{:3} %  {}\n", percent, stage));
    s.last_percent = percent;
  }
}

void ProgressBar::finish()
{
  if (!state->quiet && state->terminal)
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
  for (const auto &[name, text] : {
           std::pair{"usual cause", r.cause },
           std::pair{"change",      r.remedy},
           std::pair{"kept",        r.kept  }
  })
    if (!text.empty())
      say(fmt::format("  {:<12}  {}\n", name, visible(text, true)));
}

void show(const OutputError &error)
{
  say(std::string("error: ") + error.what() + "\n");
}

void show_bug(const std::exception &error, const std::string &manifest)
{
  say(std::string("millstand failed on its own account: ") + error.what() + "\n" +
      "please report this with the case file" + (manifest.empty() ? "" : " and " + manifest) + "\n");
}
}  // namespace mill::console
