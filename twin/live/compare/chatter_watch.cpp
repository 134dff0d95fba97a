#include "twin/live/compare/chatter_watch.h"
#include "core/base/errors.h"
#include "core/base/units.h"
#include "dynamics/chatter/chatter.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

namespace mill::live {
namespace {
constexpr double calm_growth     = -0.5;  // 1/s, as for the growth rate of a band
constexpr double agree           = 1e-6;  // -, of what is followed and what a search finds
constexpr int seconds_beyond     = 1;
constexpr std::size_t steady_for = 60;    // s, over which a growth rate is measured
constexpr double steady_within   = 0.01;  // -, of the speed meanwhile
constexpr double search_unknown  = 10;    // s, from search to search while there is nothing to follow

const char *names[] = {"speed",          "exit_speed",    "entry_thickness",
                       "exit_thickness", "entry_tension", "exit_tension"};
}  // namespace

ChatterWatch::ChatterWatch(Setup setup, const std::vector<LiveChannel> &channels, const double rate)
    : setup_(std::move(setup)), per_second(std::max<std::int64_t>(1, std::lround(rate))),
      track(std::in_place, setup_.model)
{
  const char *units[] = {"m/s", "m/s", "m", "m", "Pa", "Pa"};
  for (int i = 0; i < n_inputs; ++i) {
    column[std::size_t(i)] = -1;
    bool named             = false;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      if (channels[c].name != names[i])
        continue;
      named             = true;
      const Unit *known = find_unit(channels[c].unit);
      const bool force  = known && i >= entry_tension && known->dimension == unit("N").dimension;
      if (!known || (!(known->dimension == unit(units[i]).dimension) && !force)) {
        remarks.push_back(
            fmt::format("channel {} is in \"{}\"; the distance to the critical speed needs {}{}: the value "
                        "of the case is taken",
                        names[i], channels[c].unit, units[i], i >= entry_tension ? " or N" : ""));
        continue;
      }
      column[std::size_t(i)]   = int(c);
      is_force[std::size_t(i)] = force;
      to_si_[std::size_t(i)]   = known->multiply / known->divide;
    }
    if (i >= entry_thickness && !named)
      remarks.push_back(fmt::format("no channel {}: the value of the case is taken", names[i]));
  }
}

bool ChatterWatch::has_speed() const
{
  return column[speed] >= 0 || column[exit_speed] >= 0;
}

const ChatterWatch::Second &ChatterWatch::last() const
{
  return now;
}

const std::vector<std::string> &ChatterWatch::notes() const
{
  return remarks;
}

std::optional<PageChatter> ChatterWatch::take(const LiveBlock &block, const double growth, AlarmBook &book)
{
  std::optional<PageChatter> row;
  const Eigen::Index rows = block.measured.rows();
  for (Eigen::Index done = 0; done < rows;) {
    const std::int64_t sample = block.first + done, this_second = sample / per_second;
    const auto end = std::min<Eigen::Index>(rows, done + Eigen::Index((this_second + 1) * per_second - sample));
    if (second >= 0 && this_second != second) {  // after a gap the rest of a second is taken as one
      row = close_second(block.start_time + double(sample) / double(per_second), growth, book);
    }
    second = this_second;
    for (int i = 0; i < n_inputs; ++i) {
      if (column[std::size_t(i)] < 0)
        continue;
      for (Eigen::Index k = done; k < end; ++k)
        if (const double x = block.measured(k, column[std::size_t(i)]) * to_si_[std::size_t(i)];
            std::isfinite(x)) {
          sum[std::size_t(i)] += x;
          ++n[std::size_t(i)];
        }
    }
    done = end;
    if (sample / per_second != (block.first + done) / per_second) {
      row    = close_second(block.start_time + double(block.first + done) / double(per_second), growth, book);
      second = -1;
    }
  }
  return row;
}

twin::ChatterInputs ChatterWatch::inputs_of_second()
{
  for (std::size_t i = 0; i < n_inputs; ++i) {
    mean[i] = n[i] > 0 ? sum[i] / double(n[i]) : unknown;
    sum[i]  = 0;
    n[i]    = 0;
  }
  twin::ChatterInputs in;
  in.entry_thickness = mean[entry_thickness];
  in.exit_thickness  = mean[exit_thickness];
  const Strip strip  = twin::with_inputs(setup_.model.bite, in).strip;
  in.entry_tension =
      is_force[entry_tension] ? mean[entry_tension] / (strip.width * strip.entry_thickness) : mean[entry_tension];
  in.exit_tension =
      is_force[exit_tension] ? mean[exit_tension] / (strip.width * strip.exit_thickness) : mean[exit_tension];
  return in;
}

// Of the strip's speed behind the stand by the forward slip of the steady bite.
double ChatterWatch::roll_speed(const bite::RollBite &bite) const
{
  if (std::isfinite(mean[speed]))
    return mean[speed];
  double v = mean[exit_speed];
  try {
    for (int i = 0; i < 8 && v > 0; ++i)
      v = mean[exit_speed] / (1 + dynamics::working_point(bite, v, setup_.model.scheme).state.forward_slip);
  } catch (const InputError &) {
    return unknown;
  } catch (const SolverError &) {
    return unknown;
  }
  return v;
}

// What is followed belongs to the stand of before, and so does a search that still runs.
void ChatterWatch::set_model(twin::ChatterModel model)
{
  setup_.model = std::move(model);
  track.emplace(setup_.model);
  no_speed.clear();
  ++model_number;
}

void ChatterWatch::search(const bite::RollBite &bite)
{
  const double followed = track->following() ? track->point().speed : unknown;
  const auto work       = [model = setup_.model, number = model_number, bite, followed] {
    Search search;
    search.model_number = number;
    search.followed     = followed;
    try {
      search.critical = dynamics::critical_speed(model.stand, bite, model.scheme, model.range);
      search.spread   = twin::scheme_spread(model, bite);
    } catch (const std::exception &error) {
      search.trouble = error.what();
    }
    return search;
  };
  if (!task.start(work))
    return;
  since_search = 0;
  if (setup_.wait)
    take_search(*task.wait());
}

void ChatterWatch::take_search(Search result)
{
  if (result.model_number != model_number)
    return;
  if (!result.trouble.empty()) {
    no_speed = result.trouble;
    return;
  }
  now.spread = result.spread;
  // at the same inputs the one that is followed has to be the one that a search finds
  const bool same = result.critical.verdict == dynamics::Verdict::crossing && track->following() &&
                    std::abs(result.followed / result.critical.speed - 1) < agree;
  if (!same)
    track->begin(result.critical);
  no_speed = track->why();
}

PageChatter ChatterWatch::close_second(const double utc, const double growth, AlarmBook &book)
{
  const auto begin = std::chrono::steady_clock::now();
  ++since_search;
  now.inputs      = inputs_of_second();
  const auto bite = twin::with_inputs(setup_.model.bite, now.inputs);
  if (auto result = task.finished())
    take_search(std::move(*result));
  if (track->following() && !track->follow(bite))
    no_speed = track->why();
  const bool first = !track->following() && no_speed.empty();
  if (first || since_search >= (track->following() ? setup_.rescan : search_unknown) ||
      (!track->following() && since_search >= 1 && now.critical.speed == now.critical.speed))
    search(bite);
  now.speed    = roll_speed(bite);
  now.critical = track->following() ? track->point() : twin::CriticalPoint{};
  now.interval = track->following() ? track->interval(bite, setup_.doubts) : twin::CriticalInterval{};
  now.growth   = now.speed > 0 ? track->growth_at(bite, now.speed) : unknown;
  now.took     = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  judge(utc, growth, book);
  PageChatter page;
  page.utc      = utc;
  page.speed    = now.speed;
  page.critical = now.critical.speed;
  page.low      = now.interval.low;
  page.high     = now.interval.high;
  page.distance = (now.critical.speed - now.speed) / now.speed;
  if (!track->following())
    page.because = no_speed.empty() ? "the range of speeds is being searched" : no_speed;
  else if (!(now.speed > 0))
    page.because = "no channel speed or exit_speed with a value";
  return page;
}

void ChatterWatch::judge(const double utc, const double growth, AlarmBook &book)
{
  const double vc          = now.critical.speed;
  const std::string judged = book.level(cause);
  beyond                   = now.speed > vc ? beyond + 1 : 0;
  if (!(now.speed > 0) || !(vc > 0)) {
    if (now.speed > 0 && no_speed.empty())
      return;  // the first search runs: an alarm of before a restart stands until it is answered
    book.end(cause);
    speeds.clear();
    return;
  }
  const std::string interval =
      fmt::format("95 % {:.2f} to {:.2f} by {:.1f} % of what is measured and {:.1f} % of the model{}",
                  now.interval.low, now.interval.high, 100 * now.interval.streamed, 100 * now.interval.model,
                  std::isfinite(now.spread)
                      ? fmt::format("; linearisations of the bite differ by another +-{:.1f} %", 100 * now.spread)
                      : "");
  // a growth rate of the last minute says nothing of a speed that was not there for a minute
  speeds.push_back(now.speed);
  if (speeds.size() > steady_for)
    speeds.pop_front();
  const auto [slowest, fastest] = std::minmax_element(speeds.begin(), speeds.end());
  const bool steady             = speeds.size() == steady_for && *fastest - *slowest < steady_within * now.speed;
  const bool calm               = steady && growth < calm_growth;
  const std::string level       = beyond >= seconds_beyond               ? (calm ? "warning" : "alarm")
                                  : now.speed > now.interval.low         ? "warning"
                                  : now.speed < 0.995 * now.interval.low ? ""
                                                                         : judged;
  if (level.empty())
    book.end(cause);
  else if (level != judged && beyond >= seconds_beyond)
    book.raise(cause, utc, "chatter", level,
               fmt::format("the speed of {:.2f} m/s is above the critical speed of {:.2f} m/s at {:.1f} Hz ({}){}",
                           now.speed, vc, now.critical.frequency, interval,
                           calm ? "; the measured vibration still dies away" : ""));
  else if (level != judged)
    book.raise(
        cause, utc, "chatter", level,
        fmt::format("the speed of {:.2f} m/s is {:.1f} % below the critical speed of {:.2f} m/s at {:.1f} Hz, "
                    "within its interval ({})",
                    now.speed, 100 * (1 - now.speed / vc), vc, now.critical.frequency, interval));
}
}  // namespace mill::live
