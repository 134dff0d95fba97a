#pragma once
#include "twin/calibration/calibration.h"
#include "twin/cleaning/clean_record.h"
#include "twin/records/raw_record.h"
#include <limits>
#include <string>
#include <vector>

namespace mill {
/// A measured level of records.toml: one number of a pass, no record.
struct MeasuredLevel {
  std::string place;                                        ///< "upper_work_roll"
  double rms   = std::numeric_limits<double>::quiet_NaN();  ///< m/s2; NaN: the peak was measured
  double peak  = std::numeric_limits<double>::quiet_NaN();  ///< m/s2, 0-peak; it follows the rms by its crest
  double error = 0.03;                                      ///< -, relative standard deviation
};

/// One record of a folder.
struct RecordEntry {
  std::string file;                                        ///< path
  std::string role;                                        ///< "fit" | "check" | "": last third is the check
  double load = std::numeric_limits<double>::quiet_NaN();  ///< N, mean rolling force; NaN: that of the record
  std::string between = "smooth";                          ///< smooth | lines
  std::map<std::string, std::string> channels;             ///< plant's name -> place
};

/// What records.toml of a folder says, or all records of the folder where there is none.
struct RecordSet {
  std::string folder;
  std::vector<RecordEntry> entries;
  std::array<double, 2> band = {20, 900};  ///< Hz
  std::vector<MeasuredLevel> levels;
  double level_force     = std::numeric_limits<double>::quiet_NaN();  ///< N, rms of the force behind the levels
  double level_bandwidth = 1000;                                      ///< Hz, of that force
};

/// @throws InputError  no folder, no record, a wrong records.toml with file:line:column
RecordSet read_record_set(const std::string &folder);

/// Pieces of all records with the same sensors, and with force where it was recorded.
struct MeasuredPieces {
  std::vector<std::string> sensors;  ///< places, in the order of the chain
  double rate                  = 0;  ///< Hz
  double load                  = 0;  ///< N, mean force of the fitted records; 0: not recorded, nor given
  bool force_recorded          = true;
  twin::BetweenSamples between = twin::BetweenSamples::smooth;
  std::vector<twin::ForcedSamples> fit, check;
  std::vector<std::string> clipped;  ///< channels
  std::vector<std::string> files;    ///< stems of the records
  std::vector<std::string> notes;    ///< what was left out, and why
};

/// Reads and cleans the records.
/// @param places  of the chain, "upper_frame" ..
/// @throws InputError  force in some records only, no common sensor, different rates, pieces that are too short
MeasuredPieces measured_pieces(const RecordSet &set, const std::vector<std::string> &places,
                               const twin::ReadOptions &options);
}  // namespace mill
