#include "twin/live/compare/mode_tracker.h"
#include "twin/spectra/fourier.h"
#include <algorithm>
#include <cmath>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <utility>

namespace mill::live {
namespace {
constexpr double top_over_mode = 1.3;
constexpr double little        = 1e-3;  // -, of a frequency: a fifth of a per cent of a stiffness

// Next even number below or equal to n without prime factors above 5: its transform is quick.
Eigen::Index quick_length(const Eigen::Index n)
{
  for (Eigen::Index length = n; length > 2; --length) {
    if (length % 2)
      continue;
    Eigen::Index rest = length;
    for (const int prime : {2, 3, 5})
      while (rest % prime == 0)
        rest /= prime;
    if (rest == 1)
      return length;
  }
  return 2;
}

std::string clock_text(const double utc)
{
  return fmt::format("{:%Y-%m-%d %H:%M:%S} UTC", fmt::gmtime(std::time_t(utc)));
}
}  // namespace

struct ModeTracker::State {
  Setup setup;
  Eigen::Index n, lines;
  Eigen::MatrixXd collected, work;  // (n, 1 + channels), force first
  Eigen::Index filled = 0;
  std::int64_t next   = -1;
  std::vector<twin::ModeWatch> watches;
  std::vector<twin::ModeRow> rows, coming;
  std::vector<ModeDrift> drifted;
  std::deque<ModeBlock> kept;
  struct BothSides {
    TrackedModes::Since up, down;
  };
  std::vector<BothSides> since;  // by mode
  std::int64_t count = 0;
  twin::Fourier fourier;
  std::vector<double> samples;  // and their lines: kept, since pages of memory are dear
  std::vector<std::complex<double>> transformed_lines;
  // what is still to be done with the block in `work`
  std::optional<ModeBlock> block;
  Eigen::Index transformed = 0;
  std::size_t fitted       = 0;

  explicit State(Setup s) : setup(std::move(s))
  {
    n                = quick_length(Eigen::Index(std::lround(setup.seconds * setup.rate)));
    const double top = setup.modes.frequency.size() ? setup.modes.frequency.maxCoeff() * top_over_mode : 0;
    lines            = std::min(n / 2, Eigen::Index(top * double(n) / setup.rate) + 2);
    collected.resize(n, Eigen::Index(1 + setup.places.size()));
    work.resize(n, collected.cols());
    renew_watches();
  }

  void renew_watches()
  {
    watches.clear();
    for (Eigen::Index m = 0; m < setup.modes.frequency.cols(); ++m)
      watches.emplace_back(setup.modes.sd.size() ? setup.modes.sd[m] : 1.0, setup.rule, setup.reference_blocks);
    coming.clear();
    rows.assign(watches.size(), {});
    since.assign(watches.size(), {});
  }

  void begin_block(const double utc)
  {
    if (!collected.col(0).allFinite())
      return;
    work.swap(collected);
    ModeBlock next_block;
    next_block.number           = count;
    next_block.utc              = utc;
    next_block.load             = work.col(0).mean();
    next_block.spectra.duration = double(n) / setup.rate;
    for (std::size_t c = 0; c < setup.places.size(); ++c)
      if (work.col(Eigen::Index(1 + c)).allFinite())
        next_block.sensors.push_back(c);
    next_block.spectra.response.resize(lines, Eigen::Index(next_block.sensors.size()));
    block       = std::move(next_block);
    transformed = 0;
    fitted      = 0;
    coming.clear();
  }

  Eigen::VectorXcd transform(const Eigen::Index column)
  {
    samples.assign(work.col(column).data(), work.col(column).data() + n);
    fourier.forward(samples, transformed_lines);
    return Eigen::Map<Eigen::VectorXcd>(transformed_lines.data(), lines);
  }

  // One piece of the work; the table when it was the last.
  std::optional<PageModes> work_on(AlarmBook &book)
  {
    const auto sensors = Eigen::Index(block->sensors.size());
    if (transformed <= sensors) {
      if (transformed == 0)
        block->spectra.force = transform(0);
      else
        block->spectra.response.col(transformed - 1) =
            transform(1 + Eigen::Index(block->sensors[std::size_t(transformed - 1)]));
      ++transformed;
      return {};
    }
    const auto twin = setup.modes.at(std::abs(block->load));
    if (fitted < watches.size()) {
      auto others = twin;
      others.erase(others.begin() + std::ptrdiff_t(fitted));
      twin::ModeFit fit;
      if (sensors == 0)
        fit.why_not = "no channel without missing samples";
      else
        fit = twin::fit_mode(block->spectra, twin[fitted], others);
      coming.push_back(watches[fitted].take(fit, twin[fitted]));
      ++fitted;
      return {};
    }
    return end_block(book);
  }

  PageModes end_block(AlarmBook &book)
  {
    rows = coming;
    PageModes table;
    table.utc = block->utc;
    for (std::size_t m = 0; m < rows.size(); ++m) {
      for (auto *side : {&since[m].up, &since[m].down})
        if (std::isnan(side->utc))
          *side = {block->utc - block->spectra.duration, count};
      if (const auto shift = rows[m].shift)
        add_drift(m, *shift, book);
      if (rows[m].up == 0)
        since[m].up = {block->utc, count + 1};
      if (rows[m].down == 0)
        since[m].down = {block->utc, count + 1};
      table.modes.push_back(page_row(m, book.open(cause_of(m))));
    }
    kept.push_back(std::move(*block));
    if (int(kept.size()) > setup.kept_blocks)
      kept.pop_front();
    ++count;
    block.reset();
    return table;
  }

  std::string name_of(const std::size_t mode) const
  {
    return mode < setup.names.size() && !setup.names[mode].empty() ? setup.names[mode]
                                                                   : fmt::format("mode {}", mode + 1);
  }

  void add_drift(const std::size_t m, const twin::Shift &shift, AlarmBook &book)
  {
    const auto &began = shift.sign > 0 ? since[m].up : since[m].down;
    const double now = rows[m].measured.frequency, reference = watches[m].reference();
    const double was = rows[m].twin.frequency * std::exp(reference);
    const ModeDrift drift{m, shift, std::log(now / was), began.utc, block->utc, began.block};
    drifted.push_back(drift);
    book.raise(cause_of(m), block->utc, "drift", "alarm", drift_text(drift, was, now, reference != 0));
  }

  // For whoever stands at the mill: what changed, by how much, since when, what to do.
  std::string drift_text(const ModeDrift &drift, const double was, const double now, const bool learned) const
  {
    const bool fell  = now < was;
    std::string text = fmt::format(
        "{} has {} by {:.2f} %, from {:.5g} Hz{} to {:.5g} Hz at {:.4g} kN, since about {}. ", name_of(drift.mode),
        fell ? "fallen" : "risen", 100 * std::abs(std::expm1(drift.change)), was,
        learned ? " when the watch began" : " by the twin", now, block->load / 1e3, clock_text(drift.since));
    if (std::abs(drift.change) < little)
      text += "That is little, but more than chance: see whether it goes on. ";
    else
      text += fmt::format("Something in the stand has become {}: look for what was changed then at rolls, chocks, "
                          "bearings, wedges or liners, and for loose parts. ",
                          fell ? "softer or heavier" : "stiffer or lighter");
    text += "The twin is as it was; new springs are proposed when a minute since the change was measured, and "
            "hold when "
            "somebody adopts them.";
    return text;
  }

  PageMode page_row(const std::size_t m, const bool drifted_before) const
  {
    const twin::ModeRow &row = rows[m];
    PageMode page;
    page.name           = name_of(m);
    page.twin_frequency = row.twin.frequency;
    page.up             = row.up;
    page.down           = row.down;
    page.limit          = setup.rule.threshold;
    if (!row.measured.why_not.empty()) {
      page.state   = block->sensors.empty() ? "no data" : "not identified";
      page.because = row.measured.why_not;
      return page;
    }
    page.measured  = row.measured.frequency;
    page.sd        = row.measured.sd * row.measured.frequency;
    page.deviation = row.deviation;
    page.state     = drifted_before                                            ? "drifted"
                     : std::max(row.up, row.down) > 0.5 * setup.rule.threshold ? "drifting"
                                                                               : "calm";
    if (row.learning)
      page.because = "its mean deviation from the twin is being learned";
    else if (const double ref = watches[m].reference(); ref != 0)
      page.because =
          fmt::format("sums are about {:+.2f} % from the twin, its deviation at the start", 100 * std::expm1(ref));
    return page;
  }
};

std::string ModeTracker::cause_of(const std::size_t mode)
{
  return fmt::format("drift {}", mode);
}

TrackedModes ModeTracker::tracked() const
{
  TrackedModes now;
  now.blocks = state->count;
  for (std::size_t m = 0; m < state->watches.size(); ++m)
    now.modes.push_back({state->watches[m].state(), state->since[m].up, state->since[m].down});
  return now;
}

void ModeTracker::resume(const TrackedModes &stored)
{
  if (stored.modes.size() != state->watches.size())
    return;
  state->count = stored.blocks;
  for (std::size_t m = 0; m < stored.modes.size(); ++m) {
    state->watches[m].resume(stored.modes[m].watch);
    state->since[m] = {stored.modes[m].up, stored.modes[m].down};
  }
}

ModeTracker::ModeTracker(Setup setup) : state(std::make_unique<State>(std::move(setup))) {}
ModeTracker::~ModeTracker() = default;

void ModeTracker::restart()
{
  state->filled = 0;
  state->next   = -1;
}

void ModeTracker::set_twin(const twin::ModesAtLoad &modes)
{
  state->setup.modes = modes;
  state->block.reset();  // it was compared with the twin before
  state->renew_watches();
}

std::optional<PageModes> ModeTracker::take(const std::int64_t first, const double start_time,
                                           const Eigen::VectorXd &force, const Eigen::MatrixXd &measured,
                                           AlarmBook &book)
{
  State &s = *state;
  if (s.watches.empty() || s.setup.places.empty() || force.size() != measured.rows())
    return {};
  if (s.next >= 0 && s.next != first)
    s.filled = 0;
  s.next = first + force.size();
  std::optional<PageModes> table;
  for (Eigen::Index done = 0; done < force.size();) {
    const Eigen::Index now                    = std::min(force.size() - done, s.n - s.filled);
    s.collected.col(0).segment(s.filled, now) = force.segment(done, now);
    s.collected.rightCols(measured.cols()).middleRows(s.filled, now) = measured.middleRows(done, now);
    s.filled += now;
    done += now;
    if (s.filled < s.n)
      continue;
    while (s.block)  // blocks of the source as long as ours: no call in between to do it in
      if (auto ready = s.work_on(book))
        table = std::move(ready);
    s.begin_block(start_time + double(first + done) / s.setup.rate);
    s.filled = 0;
  }
  if (s.block)
    if (auto ready = s.work_on(book))
      table = std::move(ready);
  return table;
}

std::vector<ModeDrift> ModeTracker::drifts()
{
  return std::exchange(state->drifted, {});
}
const std::deque<ModeBlock> &ModeTracker::blocks() const
{
  return state->kept;
}
const std::vector<twin::ModeRow> &ModeTracker::rows() const
{
  return state->rows;
}
const ModeTracker::Setup &ModeTracker::setup() const
{
  return state->setup;
}
}  // namespace mill::live
