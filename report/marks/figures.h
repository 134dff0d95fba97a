#pragma once
#include "core/records/marks_record.h"
#include "report/page/run.h"
#include <string>

// Marks on the strip: what a run of `millstand marks` stored, its tables and maps; empty when there is nothing to
// show.
namespace mill::report {
/// curves/marks.json as this run stored it.
struct MarksData : MarksRecord {
  bool stored = false;
  std::string problem;  ///< why a file that is there cannot be used; empty: nothing wrong
};

/// A folder of `millstand marks`, which holds nothing else.
bool holds_marks(const Run &run);

/// Never throws: without the file `stored` is false, `problem` says when it is not such a JSON.
MarksData read_marks(const std::string &run_directory);

/// One sentence: spacing, frequency, what it is whole on, the mode nearest to it.
std::string marks_sentence(const MarksData &data);
/// Rolls and what happens in a turn against the spacing.
std::string marks_table(const MarksData &data);
/// Modes against its frequency, with the waves and speeds of every roll next to the one asked for.
std::string marks_mode_table(const MarksData &data);
/// Side bands of every roll, and a measured distance compared with its rotation.
std::string side_band_table(const MarksData &data);
/// Magnification over speed and number of waves around one roll.
std::string marks_map(const MarksData &data, const MarkMap &map);
}  // namespace mill::report
