#pragma once
#include "core/base/note.h"
#include "core/model/record_set.h"
#include "twin/calibration/calibration.h"
#include "twin/cleaning/clean_record.h"
#include "twin/records/raw_record.h"
#include <map>
#include <string>
#include <vector>

namespace mill {
/// @throws InputError  no folder, no record, a wrong records.toml with file:line:column
RecordSet read_record_set(const std::string &folder);

/// Pieces of all records with the same sensors, and with force where it was recorded.
struct MeasuredPieces {
  std::vector<std::string> sensors;  ///< places, in the order of the chain
  double rate            = 0;        ///< Hz
  double load            = 0;        ///< N, mean force of the fitted records; 0: not recorded, nor given
  bool force_recorded    = true;
  BetweenSamples between = BetweenSamples::smooth;
  std::vector<twin::ForcedSamples> fit, check;
  std::vector<std::string> clipped;  ///< channels
  std::vector<std::string> files;    ///< stems of the records
  std::vector<Note> notes;           ///< what was left out, and why
};

/// Reads and cleans the records.
/// @param places  of the chain, "upper_frame" ..
/// @param options  of the command line; its names of columns come before those of records.toml
/// @param of_case  names of columns in the case, for those that neither of them names
/// @throws InputError  force in some records only, no common sensor, different rates, pieces that are too short
MeasuredPieces measured_pieces(const RecordSet &set, const std::vector<std::string> &places,
                               const twin::ReadOptions &options,
                               const std::map<std::string, std::string> &of_case = {});
}  // namespace mill
