#pragma once
#include "twin/records/raw_record.h"
#include <string>
#include <string_view>

// Names and units of columns, the same for every format.
namespace mill::twin {
/// "force [kN]", "Kraft (kN)", "Kraft in kN" taken apart; no unit: empty.
struct ColumnHead {
  std::string name, unit;
};
ColumnHead head_of(std::string_view text);

/// What a unit is in SI.
struct ColumnUnit {
  std::string si;         ///< "m/s2", "N"; the text itself where nobody knows it
  double factor     = 1;  ///< -, SI value over the number in the file
  Quantity quantity = Quantity::other;
  bool known        = false;
};

/// Unit by its spelling; besides those of a case file V, mV, m/s^2, m/s\u00b2, mm/s^2, and the micro sign.
/// @param name  of the column: tells a roll's surface speed from the velocity of a vibration
ColumnUnit unit_of_column(const std::string &unit, const std::string &name);

/// Second units of a time column: s, ms, us, min, h; 0 where it is none.
double seconds_per(const std::string &unit);

/// Does a column of this name hold the time?  time, Zeit, t, timestamp, x-axis, Second, ..
bool is_time_name(const std::string &name);

/// Makes a channel of a column: name by the map, numbers to SI.
/// @param numbers  (n) as in the file; NaN where there is none
RawChannel channel_of(const ColumnHead &head, const Place &place, const ReadOptions &options,
                      Eigen::VectorXd numbers);

/// Lower case of ASCII letters.
std::string lower(std::string_view text);

/// @throws InputError  a channel named twice; no channel with a known unit
void require_usable_channels(const RawRecord &record, const std::string &remedy);
}  // namespace mill::twin
