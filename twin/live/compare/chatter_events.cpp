#include "twin/live/compare/chatter_events.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fmt/format.h>

namespace mill::live {
namespace {
constexpr double one_band   = 20;    // Hz, half width of the filter of a band
constexpr double leak_share = 0.02;  // -, of a level that passes the flanks of a filter; Hamming's window: 0.002
constexpr double at_once    = 1;     // s, between the beginnings of rises that are one event
constexpr int highest_multiple = 10;
const std::string chatter_head = "chatter ";

bool is_multiple(const double high, const double low)
{
  const double n = std::round(high / low);
  return n >= 2 && n <= highest_multiple && std::abs(high - n * low) < std::max(2.0, 0.01 * high);
}
}  // namespace

ChatterEvents::ChatterEvents(std::vector<double> frequency) : band_frequency(std::move(frequency)) {}

ChatterEvents::Event *ChatterEvents::event_of(const Rise &rise,
                                              const std::function<double(std::size_t band)> &level)
{
  for (Event &event : open) {
    double loudest = 0;
    for (const std::size_t band : event.bands)
      if (const double here = level(band); here > loudest)
        loudest = here;
    const bool near = std::abs(rise.frequency - event.frequency) < one_band;
    const bool multiple =
        is_multiple(rise.frequency, event.frequency) || is_multiple(event.frequency, rise.frequency);
    if (near || multiple || rise.level < leak_share * loudest || std::abs(rise.utc - event.began) < at_once)
      return &event;
  }
  return nullptr;
}

ChatterEvents::Event &ChatterEvents::begin(const Rise &rise)
{
  Event event;
  event.cause     = fmt::format("{}{:.6g}", chatter_head, rise.frequency);
  event.frequency = rise.frequency;
  event.began     = rise.utc;
  event.bands     = {rise.band};
  event.text      = fmt::format("chatter at {:.0f} Hz{}", rise.frequency, rise.text);
  open.push_back(std::move(event));
  return open.back();
}

void ChatterEvents::raise(const Event &event, AlarmBook &book)
{
  book.raise(event.cause, event.began, "chatter", "alarm", event.text);
}

void ChatterEvents::rise(const Rise &rise, const std::function<double(std::size_t band)> &level, AlarmBook &book)
{
  if (Event *event = event_of(rise, level)) {
    if (std::find(event->bands.begin(), event->bands.end(), rise.band) == event->bands.end())
      event->bands.push_back(rise.band);
    return;
  }
  raise(begin(rise), book);
}

void ChatterEvents::beyond_limit(const Rise &rise, const std::string &sentence,
                                 const std::function<double(std::size_t band)> &level, AlarmBook &book)
{
  Event *event      = event_of(rise, level);
  const bool is_new = event == nullptr;
  if (is_new)
    event = &begin(rise);
  else if (std::find(event->bands.begin(), event->bands.end(), rise.band) == event->bands.end())
    event->bands.push_back(rise.band);
  if (event->above_limit)
    return;
  event->above_limit = true;
  if (!is_new)
    event->text += "; " + sentence;
  raise(*event, book);
}

void ChatterEvents::end_calm(const std::function<bool(std::size_t band)> &calm, AlarmBook &book)
{
  open.erase(std::remove_if(open.begin(), open.end(),
                            [&](const Event &event) {
                              if (!std::all_of(event.bands.begin(), event.bands.end(), calm))
                                return false;
                              book.end(event.cause);
                              return true;
                            }),
             open.end());
}

void ChatterEvents::take_over(const AlarmBook &book)
{
  for (const auto &[cause, alarm] : book.state().now) {
    const auto same = [&, &name = cause](const Event &event) { return event.cause == name; };
    if (!knows(cause) || std::any_of(open.begin(), open.end(), same))
      continue;
    Event event;
    event.cause     = cause;
    event.frequency = std::atof(cause.c_str() + chatter_head.size());
    event.began     = alarm.utc;
    event.text      = alarm.text;
    for (std::size_t band = 0; band < band_frequency.size(); ++band)
      if (std::abs(band_frequency[band] - event.frequency) < one_band)
        event.bands.push_back(band);
    open.push_back(std::move(event));
  }
}

bool ChatterEvents::knows(const std::string &cause) const
{
  if (cause.compare(0, chatter_head.size(), chatter_head) != 0)
    return false;
  const double frequency = std::atof(cause.c_str() + chatter_head.size());
  return std::any_of(band_frequency.begin(), band_frequency.end(),
                     [&](const double band) { return std::abs(band - frequency) < one_band; });
}
}  // namespace mill::live
