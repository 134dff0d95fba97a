#include "twin/live/account_book.h"
#include <algorithm>
#include <cmath>

namespace mill::live {
namespace {
constexpr std::size_t holes_remembered = 1024;
}

AccountBook::AccountBook(const Eigen::Index n_channels) : channels_(std::size_t(n_channels)) {}

void AccountBook::offer_gap(const std::int64_t first)
{
  if (!begun_) {
    begun_ = true;
    next_  = first;
  }
  if (first <= next_)
    return;
  for (ChannelAccount &account : channels_) {
    account.offered += first - next_;
    account.missing += first - next_;
  }
  holes_.push_back({next_, first});
  if (holes_.size() > holes_remembered)
    holes_.pop_front();
  ++gaps_;
  next_ = first;
}

// How many of these samples are in holes; they are in none afterwards.
std::int64_t AccountBook::fill(const std::int64_t from, const std::int64_t to)
{
  std::int64_t filled = 0;
  std::deque<Hole> left;
  for (const Hole &hole : holes_) {
    const std::int64_t a = std::max(hole.from, from), b = std::min(hole.to, to);
    if (a >= b) {
      left.push_back(hole);
      continue;
    }
    filled += b - a;
    if (hole.from < a)
      left.push_back({hole.from, a});
    if (b < hole.to)
      left.push_back({b, hole.to});
  }
  holes_.swap(left);
  return filled;
}

// Samples that will not be processed: those before next_ if they are counted as missing, all others as new ones.
void AccountBook::book(const std::int64_t first, const std::int64_t n, std::int64_t ChannelAccount::*const where)
{
  offer_gap(first);
  const std::int64_t end = first + n, late_end = std::min(end, next_);
  std::int64_t late = 0;
  if (first < late_end) {
    late = fill(first, late_end);
    doubled_ += late_end - first - late;
  }
  const std::int64_t fresh = std::max<std::int64_t>(0, end - next_);
  for (ChannelAccount &account : channels_) {
    account.missing -= late;
    account.offered += fresh;
    account.*where += late + fresh;
  }
  next_ += fresh;
}

AccountBook::Part AccountBook::arrive(const std::int64_t first, const Eigen::Index n)
{
  Part part;
  const std::int64_t before = begun_ ? next_ : first;
  offer_gap(first);
  part.gap  = next_ - before;
  part.skip = Eigen::Index(std::clamp<std::int64_t>(next_ - first, 0, n));
  part.take = n - part.skip;
  if (part.skip > 0)
    book(first, part.skip, &ChannelAccount::rejected);
  return part;
}

void AccountBook::take(const Eigen::Ref<const Eigen::MatrixXd> &rows)
{
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    const auto numbers = std::int64_t(rows.col(Eigen::Index(c)).array().isFinite().count());
    channels_[c].offered += rows.rows();
    channels_[c].processed += numbers;
    channels_[c].missing += rows.rows() - numbers;
  }
  next_ += rows.rows();
}

void AccountBook::refuse(const std::int64_t first, const std::int64_t n)
{
  book(first, n, &ChannelAccount::rejected);
}

void AccountBook::overrun(const std::int64_t first, const std::int64_t n)
{
  book(first, n, &ChannelAccount::overrun);
}

void AccountBook::renumber(const std::int64_t next)
{
  next_  = next;
  begun_ = true;
  holes_.clear();
}

bool AccountBook::balanced() const
{
  return std::all_of(channels_.begin(), channels_.end(), live::balanced);
}

void AccountBook::resume(std::vector<ChannelAccount> channels, const std::int64_t next, const std::int64_t doubled,
                         const std::int64_t gaps)
{
  channels_ = std::move(channels);
  next_     = next;
  doubled_  = doubled;
  gaps_     = gaps;
  begun_    = true;
}
}  // namespace mill::live
