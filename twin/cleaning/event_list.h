#pragma once
#include "twin/cleaning/clean_record.h"
#include <utility>

namespace mill::twin {
/// The first events of many, and how many there were: a record of hours may have one for each second sample.
class EventList {
public:
  static constexpr std::size_t most_listed = 200;

  void push_back(CleaningEvent event)
  {
    if (n_++ < most_listed)
      first_.push_back(std::move(event));
  }
  std::size_t size() const  ///< of all, listed or not
  {
    return n_;
  }
  const std::vector<CleaningEvent> &listed() const
  {
    return first_;
  }

private:
  std::size_t n_ = 0;
  std::vector<CleaningEvent> first_;
};
}  // namespace mill::twin
