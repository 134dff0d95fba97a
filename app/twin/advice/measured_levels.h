#pragma once
#include "core/base/note.h"
#include "twin/advice/force_band.h"
#include "twin/records/raw_record.h"
#include <map>
#include <string>
#include <vector>

namespace mill {
/// What records say of the force that shakes a stand, and how it vibrates.
struct MeasuredLevels {
  twin::ForceBand force;                ///< mean square over the records, by their lengths
  std::map<std::string, double> level;  ///< m/s2, rms in the band by place, "upper_work_roll"
  double duration   = 0;                ///< s, of all records together
  double resolution = 0;                ///< Hz, of the coarsest spectrum
  std::vector<std::string> files;       ///< in their order
  std::vector<Note> notes;
};

/// Every record of a folder, or one file, that has a channel "force"; cleaned as millstand analyse cleans them.
/// The band ends where that of a record's force does.
/// @param step  Hz, of the force
/// @throws InputError  no such folder, no record in it, none with a force; what reading a record refuses
MeasuredLevels measured_levels(const std::string &path, const twin::ReadOptions &options, double low, double high,
                               double step);
}  // namespace mill
