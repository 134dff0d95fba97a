#pragma once
#include "app/calibrate/record_set.h"
#include "core/records/lumped_model.h"
#include "twin/calibration/calibration.h"
#include <string>
#include <vector>

namespace mill {
struct Case;

/// The chain of a case before its records.
struct PriorChain {
  LumpedModel model;
  std::string source;  ///< "six masses as given"
  twin::FittedStand stand;
  std::vector<std::string> places;     ///< (6) "upper_frame" ..
  std::vector<twin::Unknown> springs;  ///< every spring that is not zero, then "zeta"
  std::vector<std::string> notes;
};

/// Deviations before the records: the error estimate of the value, at least 5 % for computed contacts; 10 % for a
/// given stiffness without one; a factor of 2 for the damping.  The force of a record is the whole bite force, so
/// that K4 and the gap damper have no part whatever force_meaning says.
/// @param load  N, of the records; NaN: of the first pass
/// @throws InputError  a case without a chain, no damping to start from
PriorChain prior_chain(const Case &the_case, double load);

/// Unknowns by the names of --free; all where it is empty.
/// @throws InputError  a name that is none
std::vector<twin::Unknown> chosen(const PriorChain &chain, const std::string &free);

/// calibrated.toml: a case of kind lumped with what is told; what is not told stays as it was.
/// @param accepted  it was refused and is written all the same, which the text says
std::string calibrated_toml(const PriorChain &chain, const Case &origin, const twin::Calibration &result,
                            const std::vector<std::string> &files, bool accepted, const std::string &directory);
}  // namespace mill
