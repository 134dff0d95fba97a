#pragma once
#include "twin/records/raw_record.h"
#include <string>
#include <string_view>
#include <vector>

// Names and units of columns, the same for every format.
namespace mill::twin {
/// "force [kN]", "Kraft (kN)", "Kraft in kN" taken apart; no unit: empty.
struct ColumnHead {
  std::string name, unit;
};
ColumnHead head_of(std::string_view text);

/// How far a name alone speaks for the time.
enum class TimeName {
  none,
  weak,   ///< x, x-axis, X_Value: the time of an oscilloscope, or an axis of a sensor
  strong  ///< time, Zeit, t, timestamp, ..
};
TimeName time_name(const std::string &name);

/// What is known of a column that may hold the time.
struct TimeEvidence {
  std::string name, unit;
  bool is_text       = false;  ///< dates and times of day as texts
  bool is_increasing = false;  ///< numbers that never go back and do not all stand still
};

/// Which of the columns holds the time, from name, unit and monotony together; -1: none does.
/// A column with a unit of another quantity ("x [g]", "t [degC]") never does.
int time_column_among(const std::vector<TimeEvidence> &columns);

/// Makes a channel of a column: name by the map, numbers to SI, a voltage by its scale.  Names become valid UTF-8
/// here, whatever the format.  Notes name an unknown unit and values that cannot be measured values.
/// @param numbers  (n) as in the file; NaN where there is none
void add_channel(RawRecord &record, const ColumnHead &head, const Place &place, const ReadOptions &options,
                 Eigen::VectorXd numbers);

/// As a shell takes one word: in single quotes where it holds more than plain letters.
std::string shell_word(const std::string &text);

/// The command as it was typed, with more options: "millstand analyse r.mat --unit a=g --unit b=g".
std::string command_with(const ReadOptions &options, const std::string &file, const std::string &more);

/// "; give it: millstand analyse r.mat --rate 20000"; nothing for a record of a case, which has no options.
std::string by_option(const ReadOptions &options, const std::string &file, const std::string &text,
                      const std::string &more);

/// "--unit a=g --unit 'b c=g'" for the first columns of a record.
std::string unit_options(const std::vector<std::string> &columns);

/// "'a', 'b' and 3 more"
std::string listed(const std::vector<std::string> &names, std::size_t most = 12);

/// @throws InputError  a channel that appears twice; no channel with a known unit; an option for a column that the
///         record does not have
/// @param remedy  for a file that can hold its units, "write the unit behind the name, .."
void require_usable_channels(RawRecord &record, const ReadOptions &options, const std::string &remedy);
}  // namespace mill::twin
