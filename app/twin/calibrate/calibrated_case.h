#pragma once
#include "app/twin/calibrate/record_set.h"
#include "core/base/note.h"
#include "core/model/dynamics_settings.h"
#include "core/model/lumped_model.h"
#include "core/records/stand_model.h"
#include "twin/calibration/calibration.h"
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace mill {
struct Case;

/// The stand of a case before its records: a chain, or a detailed one.
struct PriorChain {
  LumpedModel model;                                       ///< of a chain
  std::optional<StandModel> detailed;                      ///< nothing: the chain
  double load  = not_given;                                ///< N, that a detailed four-high is computed for
  double limit = std::numeric_limits<double>::infinity();  ///< Hz, up to which its modes are right
  std::string source;                                      ///< "six masses as given"
  twin::FittedStand stand;
  std::vector<std::string> places;     ///< (6 or more) "upper_frame" ..
  std::vector<twin::Unknown> springs;  ///< every spring that is not zero, then the damping
  std::vector<twin::Unknown> masses;   ///< every mass
  std::vector<std::string> stated;     ///< masses whose error the case states: free unless --free names others
  std::vector<Note> notes;
};

/// Deviations before the records: the error that the case, its run or the value states; 10 % for a value without
/// one; a factor of 2 for the damping.  The force of a record is the whole bite force, so that K4 and the gap
/// damper have no part in the fit, for any force_meaning.
/// @param load  N, of the records; NaN: of the first pass
/// @throws InputError  a case without a chain, no damping to start from
PriorChain prior_chain(const Case &the_case, double load);

/// Deviation of ln K before the records.
/// @param error     of the value, relative; NaN: not stated
/// @param computed  a contact of rolls (K3, K5) then has 5 % at least
double prior_of_spring(const std::string &name, double error, bool computed);
/// Deviation of ln M before the records.
double prior_of_mass(double error);
/// @throws InputError  no damping
double damping_to_start_from(const DynamicsSettings &dynamics);
/// "upper work-roll chock" -> "upper_work_roll_chock", as the channels of a simulation are called.
std::string place_name(std::string label);

/// Head of a calibrated case, a comment: its records, and the change and interval of each unknown.
std::string calibration_comment(const Case &origin, const twin::Calibration &result,
                                const std::vector<std::string> &files, bool accepted);
/// Of a case of kind four-high or lumped.
DynamicsSettings &dynamics_of(Case &the_case);
/// The case with the damping that is identified; of ratios of single modes the geometric mean.
Case with_damping(const Case &origin, const twin::Calibration &result);

/// calibrated.toml: a case of kind lumped with what is identified, and with what would contradict the records as
/// it was; the rest stays as it was.
/// @param accepted  it was refused and is written because of --accept, which the text says
std::string calibrated_toml(const PriorChain &chain, const Case &origin, const twin::Calibration &result,
                            const std::vector<std::string> &files, bool accepted, const std::string &directory);
}  // namespace mill
