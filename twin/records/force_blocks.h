#pragma once
#include "twin/records/csv_rows.h"
#include "twin/records/force_record.h"
#include "twin/records/line_source.h"
#include <optional>

namespace mill::twin {
/// A recorded rolling force read piece by piece, for CSV records longer than memory.  Rules and messages are those
/// of read_force(); a record of another format is read whole and given piece by piece.
class ForceBlocks {
public:
  /// @param samples  of a block, about
  /// @throws InputError as read_force()
  explicit ForceBlocks(std::string path, std::size_t samples = std::size_t(1) << 16);

  /// The next samples, at least one; false at the end.  Notes stand in the last block.
  /// @throws InputError as read_force(), SystemError  the disk refuses it
  bool next(ForceRecord &block);

  /// Begins again with the first sample.
  void rewind();

  /// For a CSV record that was refused: looks at all rows and begins again where they say other things of the
  /// columns than the first ones did.  False: they say the same, and the refusal stands.
  bool look_at_all_rows();

  double fraction() const;  ///< -, of the file that has been read
  long long n_samples() const
  {
    return n_samples_;
  }

private:
  struct Column {
    std::size_t index;  // among the channels of a line
    double factor;      // N for a number of the file
  };
  void take(std::string_view line, int number, bool last);
  bool next_of_whole(ForceRecord &block);
  void finish(ForceRecord &block);

  std::string path_;
  std::size_t samples_;
  ReadOptions options_ = options_of_case_record();
  std::optional<CsvEvidence> evidence_;  // of all rows, where the first ones were misleading
  std::optional<LineSource> source_;
  std::optional<CsvRows> rows_;
  std::vector<std::string> head_;
  std::size_t next_of_head_ = 0;
  Column column_{0, 1};
  std::optional<SampleFeed> feed_;
  std::vector<double> time_, force_;  // s, N, of the block
  long long n_samples_ = 0;
  std::optional<ForceRecord> whole_;
  Eigen::Index given_ = 0;  // of the whole record
  bool ended_         = false;
};
}  // namespace mill::twin
