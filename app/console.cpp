#include "app/console.h"
#include "core/error_list.h"
#include <chrono>
#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>
#include <vector>

namespace mill::console {
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
    fmt::print(stderr, "\r\033[K[{}{}] {:3} %  {}  {}", std::string(filled, '#'), std::string(30 - filled, '.'),
               percent, stage, left);
    std::fflush(stderr);
  } else if (percent / 10 > s.last_percent / 10 || s.last_percent < 0) {
    fmt::print(stderr, "{:3} %  {}\n", percent, stage);
    s.last_percent = percent;
  }
}

void ProgressBar::finish()
{
  if (!state->quiet && state->terminal)
    fmt::print(stderr, "\r\033[K");
}

void show(const InputError &error)
{
  fmt::print(stderr, "{}", render_list(error.problems));
}

void show(const SolverError &error)
{
  const auto &r = error.report;
  fmt::print(stderr, "{}\n", r.what);
  if (!r.where.empty())
    fmt::print(stderr, "  {}\n", r.where);
  for (const auto &[name, text] : {
           std::pair{"usual cause", r.cause },
           std::pair{"change",      r.remedy},
           std::pair{"kept",        r.kept  }
  })
    if (!text.empty())
      fmt::print(stderr, "  {:<12}  {}\n", name, text);
}

void show_bug(const std::exception &error, const std::string &manifest)
{
  fmt::print(stderr, "millstand failed on its own account: {}\n", error.what());
  fmt::print(stderr, "please report this with the case file{}\n", manifest.empty() ? "" : " and " + manifest);
}
}  // namespace mill::console
