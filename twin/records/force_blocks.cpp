#include "twin/records/force_blocks.h"
#include "twin/records/channel_names.h"
#include <algorithm>
#include <cmath>
#include <filesystem>

namespace mill::twin {
namespace {
constexpr double largest_force_number = 1e15;  // in the file's unit: no measured value of a mill reaches it

// The channels of a CSV file without their values.
RawRecord channels_of(const CsvRows &rows, const std::string &path, const ReadOptions &options)
{
  RawRecord record;
  record.file = path;
  for (const std::size_t column : rows.columns()) {
    const CsvLayout::Column &one = rows.layout().columns[column];
    add_channel(record, one.head, one.place, options, {});
  }
  require_usable_channels(record, options, "write the unit behind the name, for example \"force [kN]\", or");
  return record;
}
}  // namespace

ForceBlocks::ForceBlocks(std::string path, const std::size_t samples) : path_(std::move(path)), samples_(samples)
{
  std::error_code error;
  const auto status = std::filesystem::status(path_, error);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw InputError(path_ + " is not a regular file; a record that is read in blocks is read twice");
  if (is_record_file(path_) && !is_csv_record(path_))
    whole_ = read_force(path_);
  rewind();
}

void ForceBlocks::rewind()
{
  ended_     = false;
  given_     = 0;
  n_samples_ = 0;
  if (whole_)
    return;
  source_.emplace(path_);
  head_.clear();
  std::string_view line;
  while (head_.size() < CsvRows::lines_looked_at && source_->next(line))
    head_.emplace_back(line);
  rows_.emplace(path_, head_, options_, evidence_ ? &*evidence_ : nullptr);
  next_of_head_             = std::size_t(rows_->layout().first_data_line - 1);
  const RawRecord channels  = channels_of(*rows_, path_, options_);
  const std::size_t channel = force_channel(channels);
  const ColumnHead &head    = rows_->layout().columns[rows_->columns()[channel]].head;
  column_                   = {channel, unit_of_column(head.unit, channels.channels[channel].name).factor};
  feed_.emplace(rows_->time_column());
}

bool ForceBlocks::look_at_all_rows()
{
  if (whole_ || evidence_ || !rows_)
    return false;
  auto all = evidence_of_all_rows(path_, *rows_);
  if (!all)
    return false;
  evidence_ = std::move(all);
  rewind();
  return true;
}

double ForceBlocks::fraction() const
{
  if (whole_)
    return double(given_) / double(whole_->time.size());
  return !ended_ && source_->size() > 0 ? std::min(1.0, source_->done() / source_->size()) : 1;
}

// Adds what the line completes to the block.
void ForceBlocks::take(const std::string_view line, const int number, const bool last)
{
  if (rows_->take(line, number, last) != CsvRows::Kind::samples)
    return;
  const double time = rows_->clock().first_number() + rows_->seconds(), value = rows_->values()[column_.index];
  const bool usable  = std::abs(value) <= largest_force_number;  // not true of NaN
  const double force = usable ? value * column_.factor : std::nan("");
  if (feed_->n_used() > 0)
    rows_->require_not_before(feed_->last(), time, line, number);
  feed_->take(time, {force, force}, [&](const double then, const SampleFeed::Values &values) {
    time_.push_back(then);
    force_.push_back(values[0]);
    ++n_samples_;
  });
}

bool ForceBlocks::next_of_whole(ForceRecord &block)
{
  const Eigen::Index n = std::min(Eigen::Index(samples_), whole_->time.size() - given_);
  block.time           = whole_->time.segment(given_, n);
  block.force          = whole_->force.segment(given_, n);
  block.notes          = whole_->notes;
  given_ += n;
  n_samples_ = given_;
  return n > 0;
}

void ForceBlocks::finish(ForceRecord &block)
{
  block.notes       = rows_->notes();
  const auto faults = feed_->finish();
  block.notes.insert(block.notes.end(), faults.begin(), faults.end());
  if (rows_->had_comma())
    block.notes.push_back("decimal commas were read as decimal points");
}

bool ForceBlocks::next(ForceRecord &block)
{
  block.notes.clear();
  if (whole_)
    return next_of_whole(block);
  if (ended_)
    return false;
  time_.clear();
  force_.clear();
  std::string_view line;
  while (time_.size() < samples_ && !ended_)
    if (next_of_head_ < head_.size()) {
      const auto i = next_of_head_++;
      take(head_[i], int(i) + 1, i + 1 == head_.size() && source_->ended_without_newline());
    } else if (source_->next(line))
      take(line, source_->number(), source_->ended_without_newline());
    else
      ended_ = true;
  if (ended_)
    finish(block);
  block.time  = Eigen::Map<const Eigen::VectorXd>(time_.data(), Eigen::Index(time_.size()));
  block.force = Eigen::Map<const Eigen::VectorXd>(force_.data(), Eigen::Index(force_.size()));
  return !time_.empty();
}
}  // namespace mill::twin
