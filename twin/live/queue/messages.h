#pragma once
#include "twin/live/live_block.h"
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

// What readers of sources hand to the engine, in the order of arrival.
namespace mill::live {
/// What a source sends, said once at its beginning.
struct SourceHead {
  double rate = 0;                    ///< Hz
  std::optional<double> start;        ///< s since 1970 UTC of sample 0; none: not known
  std::string source;                 ///< how it calls itself
  std::vector<LiveChannel> channels;  ///< SI where the unit is known
  std::vector<double> factor;         ///< -, (channels) SI value over the number sent
};

/// Even samples.
struct SourceBlock {
  std::int64_t first = 0;  ///< number of the first sample
  Eigen::MatrixXd value;   ///< (n, channels) in the units of the head; NaN: missing
};

/// A line that was refused.
struct RefusedLine {
  std::string reason;
  std::int64_t first = 0;  ///< its samples, where they are known
  std::int64_t n     = 0;  ///< 0: not known; they show as missing when the next block comes
};

/// A block that found the queue full.
struct DroppedBlock {
  std::int64_t first = 0;  ///< -
  std::int64_t n     = 0;  ///< samples
};

/// Something to be said: possible loss, a connection that came or went.
struct SourceNote {
  std::string kind;  ///< "loss", "connection", "note"
  std::string text;
};

/// The file that the samples before this message are from, of a source that goes through files.
struct SourceFile {
  std::string print;       ///< hash of its first lines: recognises it under any name
  std::int64_t first = 0;  ///< number of its first sample
};

/// The source has nothing more and will not come back.
struct SourceEnd {
  std::string text;
};

using Message =
    std::variant<SourceHead, SourceBlock, RefusedLine, DroppedBlock, SourceNote, SourceFile, SourceEnd>;
}  // namespace mill::live
