#pragma once
#include "app/command/calibrate_options.h"
#include "app/twin/calibrate/calibrated_case.h"
#include "core/base/note.h"
#include <string>
#include <vector>

namespace mill {
/// What a record would identify, before anyone measures.  theory.md 45
struct RecordPlan {
  std::string case_name, stand;         ///< "six masses as given"
  std::vector<std::string> sensors;     ///< (m) places
  twin::PlannedRecord record;           ///< with the places of the sensors
  double force_rms = 0;                 ///< N
  std::vector<twin::Unknown> unknowns;  ///< (p)
  twin::Identification identification;  ///< of them; without a recorded force its density is one more
  std::vector<twin::Unknown> ratios;    ///< a damping ratio for each mode in place of the common one; may be empty
  Eigen::VectorXd ratio_frequency;      ///< (ratios) Hz
  Eigen::VectorXd ratio_shrink;         ///< (ratios) -
  std::vector<std::string> unseen;      ///< directions that the record would not show
  std::string weakest;                  ///< the weakest direction as a sum
  std::vector<std::string> places;      ///< of the stand, for `next`
  std::vector<twin::NextSensor> next;   ///< the sensor that would add most comes first
  std::vector<Note> notes;
};

/// @throws InputError  an option that is wrong
RecordPlan record_plan(const PriorChain &prior, const std::string &case_name,
                       const std::vector<twin::Unknown> &unknowns, const CalibrateOptions &options);

/// For the console: a line for each unknown, directions that would not be seen, the sensor that would help most.
std::string plan_text(const RecordPlan &plan);

/// plan.json: all numbers with full digits.
std::string plan_json(const RecordPlan &plan);
}  // namespace mill
