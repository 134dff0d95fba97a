#pragma once
#include "app/run/run_context.h"
#include "fem/bearing/ring_flexibility.h"
#include "fem/bearing/roller_contact.h"
#include "reduce/bearing/bearing_models.h"
#include "reduce/bearing/chock_supports.h"
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace mill {
struct Case;

/// A bearing ready to be loaded: its geometry, the law of its roller and how far its rings deflect, each with what
/// it is known to.
struct BearingParts {
  bearing::BearingModel model;
  std::vector<bearing::BearingVariant> companions;     ///< on coarser meshes, one ingredient at a time
  std::vector<bearing::BearingVariant> supports;       ///< of the chock, where the case leaves them open
  bearing::RingFlexibility coarse_rings;               ///< rings and chock on coarser meshes; none for rigid rings
  std::shared_ptr<const fem::CondensedRoller> roller;  ///< roller_law = "fe" only
  double law_depth_inner = 0, law_depth_outer = 0;     ///< m, of the raceways in the law of one roller
  std::vector<std::string> notes;                      ///< sentences for the report
  std::map<std::string, fem::RingResult> surroundings;  ///< of the cup, by the name of the chock's support
};

/// Everything that the kept parts of a bearing depend on, as text; its hash is the key of the cache.  Empty: the
/// bearing has no such part.
std::string roller_inputs(const RollerBearing &bearing, double largest_load);
std::string ring_inputs(const RollerBearing &bearing);

/// Meshes and condenses roller, raceways, rings and chock side by side, or takes them from the cache.  A support
/// of the chock that is left open costs another two seconds each, on the coarser mesh.
/// @param largest_load  N, on one roller
/// @param also          other supports that with_support will be asked for
BearingParts bearing_parts(RunContext &run, const RollerBearing &bearing, double largest_load,
                           const std::vector<bearing::ChockSupport> &also = {});

/// The model and its companions with the chock held in another way: the chock alone is meshed again, on the
/// coarser mesh, or taken from the cache.
/// @param bearing  with elastic rings, that the parts are made for
BearingParts with_support(RunContext &run, const RollerBearing &bearing, BearingParts parts,
                          const bearing::ChockSupport &support);

/// Profile drop of one contact, m, at x from mid-roller.
std::function<double(double)> drop_of(const RollerBearing &bearing);

/// Largest load of one roller, N, that its contact elements are meshed for, with room for the ends; beyond it only
/// the slices speak.
double largest_contact_load(const BearingParts &parts);

/// Displacement and stress of the chock with its cup under roller loads as VTU; nothing for a cup that is held.
/// @param load  (rows, Z) N, azimuths from the support
/// Cost: meshes the chock again, one factorisation: some two seconds.
void write_chock(RunContext &run, const RollerBearing &bearing, const Eigen::MatrixXd &load);

/// Sentences for check: at which cup angle the apex condition of each tapered bearing closes, and which
/// arrangement of its rows is assumed.
std::vector<std::string> said_of_bearings(const Case &the_case);

/// Refuses bearings whose preload or negative clearance presses the raceways beyond their yield pressure before
/// any load acts, and drawings that leave no rings to mesh.
/// @throws InputError  at the keys, with the numbers
void check_fits(const Case &the_case);
}  // namespace mill
