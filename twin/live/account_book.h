#pragma once
#include "twin/live/account.h"
#include <Eigen/Core>
#include <cstdint>
#include <deque>
#include <vector>

namespace mill::live {
/// Keeps the account of a source from the numbers of its samples, for any order of arrival.  theory.md (48.7)
/// Samples that were counted as missing and come late move to `rejected`; what comes a second time is counted
/// apart and in no account, since it was offered once.
class AccountBook {
public:
  explicit AccountBook(Eigen::Index n_channels);

  /// What of an arriving block is new.
  struct Part {
    std::int64_t gap  = 0;  ///< samples, lost before it
    Eigen::Index skip = 0;  ///< rows at its beginning that are late or doubled
    Eigen::Index take = 0;  ///< rows behind them: to be processed
  };
  /// Books the gap before a block and what of it is not new; the caller processes the rest and calls take().
  Part arrive(std::int64_t first, Eigen::Index n);
  /// Books new rows: numbers are processed, NaN is missing.
  /// @param rows  (n, channels)
  void take(const Eigen::Ref<const Eigen::MatrixXd> &rows);
  /// A line with these samples was refused.
  void refuse(std::int64_t first, std::int64_t n);
  /// A block was dropped since the queue was full.
  void overrun(std::int64_t first, std::int64_t n);
  /// The numbers start again; the counts stay.
  void renumber(std::int64_t next);

  bool begun() const
  {
    return begun_;
  }
  std::int64_t next() const
  {
    return next_;
  }
  const std::vector<ChannelAccount> &channels() const
  {
    return channels_;
  }
  bool balanced() const;
  std::int64_t doubled() const  ///< samples that came again
  {
    return doubled_;
  }
  std::int64_t gaps() const  ///< how often samples were lost
  {
    return gaps_;
  }
  /// Goes on from stored values.
  void resume(std::vector<ChannelAccount> channels, std::int64_t next, std::int64_t doubled, std::int64_t gaps);

private:
  struct Hole {
    std::int64_t from, to;
  };
  void offer_gap(std::int64_t first);
  std::int64_t fill(std::int64_t from, std::int64_t to);
  void book(std::int64_t first, std::int64_t n, std::int64_t ChannelAccount::*where);

  std::vector<ChannelAccount> channels_;
  std::deque<Hole> holes_;  // the last ones, ascending
  std::int64_t next_ = 0, doubled_ = 0, gaps_ = 0;
  bool begun_ = false;
};
}  // namespace mill::live
