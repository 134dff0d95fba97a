#pragma once
#include "core/records/records.h"
#include "twin/records/raw_record.h"
#include <array>
#include <string>
#include <vector>

namespace mill::twin {
/// A recorded rolling force: the column 'force', or the only column with a unit of force, in every format,
/// notation and time of read_record().  One or two samples without a value between others are filled linearly;
/// longer gaps have no samples, so that they are seen in the times.  Times are those of the file, also where they
/// do not begin at zero.
/// @throws InputError  as read_record(); no such column, more than 1 % of the times doubled, fewer than two
/// samples
ForceRecord read_force(const std::string &path);

/// Measured accelerations: the columns 'upper_work_roll' and 'lower_work_roll', read as a force is.
MeasuredRecord read_measured(const std::string &path);

/// Options of a record that a case or a command names, where no option can follow: remedies change the file.
ReadOptions options_of_case_record();

/// Index of the channel that holds the rolling force.  @throws InputError  none, or several
std::size_t force_channel(const RawRecord &record);

/// Samples one after the other as a stand is driven by them, for a record of any length.
class SampleFeed {
public:
  static constexpr std::size_t longest_filled = 2;  ///< samples, as in an analysis
  using Values                                = std::array<double, 2>;

  /// @param column  of the times, for messages
  explicit SampleFeed(Place column);

  /// Calls emit(time, values) for each sample that this one completes.
  /// @param time    s
  /// @param values  NaN: the file has none
  /// @throws InputError  the time goes backwards
  template <class Emit> void take(const double time, const Values &values, const Emit &emit)
  {
    if (!accepts(time, values))
      return;
    if (n_used_ > 0 && pending_.size() <= longest_filled)
      for (const double between : pending_) {
        const double share = (between - last_) / (time - last_);
        emit(between, Values{last_values_[0] + share * (values[0] - last_values_[0]),
                             last_values_[1] + share * (values[1] - last_values_[1])});
      }
    pending_.clear();
    emit(time, values);
    last_        = time;
    last_values_ = values;
    ++n_used_;
  }

  /// What was found, one sentence each.
  /// @throws InputError  too many doubled times, fewer than two samples with a value
  std::vector<std::string> finish() const;

  long long n_used() const  ///< samples with a value
  {
    return n_used_;
  }
  double last() const  ///< s, time of the last one
  {
    return last_;
  }

private:
  bool accepts(double time, const Values &values);

  Place column_;
  std::vector<double> pending_;         // s, samples without a value since the last one that has one
  double last_ = 0, last_doubled_ = 0;  // s
  Values last_values_{};
  long long n_used_ = 0, n_doubled_ = 0, n_missing_ = 0;
};
}  // namespace mill::twin
