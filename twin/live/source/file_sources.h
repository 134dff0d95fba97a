#pragma once
#include "twin/live/queue/sample_queue.h"
#include "twin/live/source/csv_feed.h"
#include "twin/live/source/line_session.h"
#include <atomic>
#include <string>

// Sources that are files.  Each runs until its end, or until it is stopped or the queue is closed.
namespace mill::live {
struct FileSource {
  std::string path;
  SourceRules rules;
  double speed = 1;                    ///< -, replay: times real time; infinite: as fast as the twin takes it
  std::optional<ResumedFile> resumed;  ///< after a restart; nothing: from the first row
  std::string print;                   ///< of the file that was read before the restart; empty: not known
};

/// Plays a CSV record.  @throws InputError  no such file, no channels, no rate
void replay_csv(const FileSource &source, SampleQueue &queue, const std::atomic<bool> &stop);

/// Reads a CSV file while it grows, by inode and size: an unfinished last line waits; a renamed file is read to
/// its end and the new one of the name opened; one that became shorter, or begins otherwise, was truncated in
/// place: read from its beginning, with a note of possible loss.  A message says which file the samples are from.
/// @throws as replay_csv
void follow_csv(const FileSource &source, SampleQueue &queue, const std::atomic<bool> &stop);

/// JSON lines from an open file (0: standard input).
void read_json_lines(int file, const SourceRules &rules, SampleQueue &queue, const std::atomic<bool> &stop);
}  // namespace mill::live
