#pragma once
#include "core/base/choice.h"
#include "twin/cleaning/described_channel.h"
#include "twin/cleaning/time_grid.h"
#include "twin/records/raw_record.h"
#include <limits>
#include <string>
#include <vector>

namespace mill::twin {
/// Samples begin .. end - 1 of a grid.
struct Span {
  Eigen::Index begin, end;
  Eigen::Index size() const
  {
    return end - begin;
  }
};

enum class CleaningFault { gap, missing, clipped, stuck, doubled, jitter };
constexpr auto words_of(CleaningFault)
{
  return choice_words<CleaningFault>("gap", "missing", "clipped", "stuck", "doubled", "jitter");
}

/// Something that was found wrong and what was done about it.
struct CleaningEvent {
  std::string channel;  ///< empty: all of the record
  CleaningFault fault;
  double from, to;     ///< s from the start of the record, first and last sample
  Eigen::Index count;  ///< samples
  std::string done;    ///< "filled linearly", "cut here", ..
};

/// A channel on the even grid, its offset and drift taken off (not of a speed).
struct CleanChannel {
  std::string name, column, unit;
  Quantity quantity = Quantity::other;
  Eigen::VectorXd value;     ///< (n) in `unit`; outside of the pieces without meaning
  std::vector<Span> pieces;  ///< whole, between long gaps
  double offset        = 0;  ///< in `unit`, mean that was taken off
  double drift         = 0;  ///< in `unit`/s, slope that was taken off
  Eigen::Index missing = 0;  ///< empty cells
  Eigen::Index filled  = 0;  ///< samples filled linearly
  Eigen::Index clipped = 0;  ///< samples at a clip level
  Eigen::Index stuck   = 0;  ///< samples of pieces that stand still
  double clip_low      = std::numeric_limits<double>::quiet_NaN();  ///< in `unit`, level below; NaN: none
  double clip_high     = std::numeric_limits<double>::quiet_NaN();  ///< in `unit`, level above; NaN: none
  double clipped_share = 0;                                         ///< -, of the samples there are
  Eigen::Index n_used() const;                                      ///< samples in pieces
};

/// A text that a column of the record held from one time to another: a coil number, OK, TRUE.
struct Label {
  std::string column, text;
  double from, to;  ///< s from the start of the record, first and last sample
};

/// A record as it is analysed.
struct CleanRecord {
  std::string file, format;
  double rate       = 0;        ///< Hz
  double jitter     = 0;        ///< s, of the times about the grid
  bool interpolated = false;    ///< values were put onto the grid by a cubic spline
  Eigen::Index n    = 0;        ///< samples of the grid
  std::optional<double> start;  ///< s since 1970-01-01 UTC
  std::vector<CleanChannel> channels;
  std::vector<DescribedChannel> described;  ///< columns that do not vibrate: not among the channels
  std::vector<Label> labels;                ///< by column, then by time
  std::vector<CleaningEvent> events;        ///< by channel, then by time; at most 200 of one channel
  std::vector<std::string> notes;
  const CleanChannel *find(const std::string &name) const;  ///< nullptr when absent
  double duration() const;                                  ///< s
};

/// Counts and dates every fault of a record (chapter 41.2) and puts the channels onto an even grid.
/// @throws InputError  the time column is too coarse, or every channel has one constant value
/// Cost O(n) per channel.
CleanRecord clean_record(RawRecord &&record);
}  // namespace mill::twin
