#pragma once
#include "core/base/errors.h"
#include <Eigen/Core>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace mill::twin {
/// What a column holds, told from its unit and its name.
enum class Quantity {
  acceleration,  ///< m/s2
  velocity,      ///< m/s, of a vibration
  force,         ///< N
  speed,         ///< m/s, of the rolls' surface or of the strip
  voltage,       ///< V, a sensor whose calibration nobody gave
  other          ///< as the file has it; analysed, takes part in no comparison
};
const char *name_of(Quantity quantity);

/// One column of a record as it was read: NaN where the file has no number.
struct RawChannel {
  std::string name;    ///< place ("upper_work_roll"), "force", "speed", or the column's own name
  std::string column;  ///< as the file calls it
  std::string unit;    ///< SI: "m/s2", "N"; as in the file where nobody knows it
  Quantity quantity = Quantity::other;
  bool unit_known   = false;  ///< `unit` is one of the closed list or V
  Place place;                ///< of the head of the column
  Eigen::VectorXd value;      ///< (n) in `unit`
};

/// A record as it was read.  Nothing is repaired here.
struct RawRecord {
  std::string file;
  std::string format;                                      ///< "CSV", "UFF 58b", "numpy", "MATLAB 5"
  Eigen::VectorXd time;                                    ///< (n) s from the first sample; empty: even samples
  double rate = std::numeric_limits<double>::quiet_NaN();  ///< Hz, of even samples; NaN where `time` is there
  std::optional<double> start;       ///< s since 1970-01-01 UTC of the first sample; none: the record has no date
  std::vector<RawChannel> channels;  ///< all of one length, at least one
  std::vector<std::string> notes;    ///< what the reader did to understand the file, one sentence each
  Place time_place;                  ///< of the head of the time column
  const RawChannel *find(const std::string &name) const;  ///< nullptr when absent
  Eigen::Index n_samples() const;
};

/// What the user says about records besides what the files say.
struct ReadOptions {
  std::optional<double> rate;                       ///< Hz, of records without a time column
  std::string zone;                                 ///< "Europe/Berlin", of local times; empty: none given
  std::string zone_folder = "/usr/share/zoneinfo";  ///< where the rules of the zones are
  std::map<std::string, std::string> channels;      ///< plant's name of a column -> place
  std::map<std::string, std::string> units;         ///< plant's name of a column -> unit, where the file says none
};

/// Reads a record by the ending of its name: .csv, .txt, .tsv, .asc; .npy with .json beside it; .uff, .unv; .mat.
/// @throws InputError with file:line:column and remedy
RawRecord read_record(const std::string &path, const ReadOptions &options);

RawRecord read_csv_record(const std::string &path, const ReadOptions &options);
RawRecord read_npy_record(const std::string &path, const ReadOptions &options);
RawRecord read_uff_record(const std::string &path, const ReadOptions &options);
RawRecord read_mat_record(const std::string &path, const ReadOptions &options);
}  // namespace mill::twin
