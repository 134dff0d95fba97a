#pragma once
#include "twin/live/compare/alarm_book.h"
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace mill::live {
/// A vibration that rose in one band of one channel.
struct Rise {
  std::size_t band = 0;
  double frequency = 0;  ///< Hz, that the envelope shows
  double level     = 0;  ///< m/s2, 0-peak
  double utc       = 0;  ///< s since 1970
  std::string text;      ///< after "chatter at 149.8 Hz", for instance ", upper_work_roll: 3 m/s2 is .."
};

/// One alarm for one chatter.  The vibration of one chatter rises in neighbouring bands, in several channels, at
/// multiples of its frequency, and through the flanks of the filters in all bands; these rises join one alarm.  So
/// do rises that begin within a second of each other: a strip that enters shakes every band at once.
class ChatterEvents {
public:
  /// @param frequency  (bands) Hz, of the watched bands
  explicit ChatterEvents(std::vector<double> frequency);
  /// Begins an alarm, or joins the rise to an open one.
  /// @param level  m/s2 of a band in the channel of the rise, now
  void rise(const Rise &rise, const std::function<double(std::size_t band)> &level, AlarmBook &book);
  /// The level is above the limit of the mill: joins the open alarm of the band, else begins one.
  /// @param sentence  for an open alarm, "above the limit of .."
  void beyond_limit(const Rise &rise, const std::string &sentence,
                    const std::function<double(std::size_t band)> &level, AlarmBook &book);
  /// Ends every alarm whose bands have all become calm.
  void end_calm(const std::function<bool(std::size_t band)> &calm, AlarmBook &book);
  /// Takes over alarms that were open before a restart.
  void take_over(const AlarmBook &book);
  /// Is the cause a chatter in one of the watched bands?
  bool knows(const std::string &cause) const;

private:
  struct Event {
    std::string cause;
    double frequency = 0, began = 0;
    std::vector<std::size_t> bands;
    std::string text;
    bool above_limit = false;
  };
  Event *event_of(const Rise &rise, const std::function<double(std::size_t band)> &level);
  Event &begin(const Rise &rise);
  static void raise(const Event &event, AlarmBook &book);

  std::vector<double> band_frequency;
  std::vector<Event> open;
};
}  // namespace mill::live
