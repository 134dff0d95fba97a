#pragma once
#include "core/case/stand_rows.h"
#include "core/model/bite_setup.h"
#include "core/model/chatter.h"
#include "core/model/contact_settings.h"
#include "core/model/dynamics_settings.h"
#include "core/model/frame.h"
#include "core/model/given.h"
#include "core/model/housing.h"
#include "core/model/pass.h"
#include "core/model/roll.h"
#include "core/model/roller_bearing.h"
#include "core/model/strip.h"
#include <set>

// Reading of the kinds of case, section by section.
namespace mill {
struct BearingCase;
struct BiteCase;
struct ChatterCase;
struct EstimateInput;
struct FourHigh;
struct Lumped;
struct TwoCylinders;

/// Section "contact.upper" below the root; its node is null when it is left out.  A value where a section is
/// wanted becomes a problem.
Section section_at(const Node &root, const std::string &name, Reading &reading);

/// [[pass]]; `root` may have none.
std::vector<Pass> read_passes(const Node &root, const std::vector<Field<PassInput>> &rows, Reading &reading);
/// @param given  names that stand under [given]: K4 makes thicknesses, friction and flow stress optional; null:
/// the
///               kind has no such section
Strip read_strip(const Node &root, Reading &reading, const std::set<std::string> *given = nullptr);
FlowStress read_flow_stress(const Node &root, Reading &reading);
/// @param section  [strip.friction]
Friction read_friction_law(const Section &section, Reading &reading);
BiteSetup read_bite_setup(const Node &root, Reading &reading);
/// [housing] and [screwdown]; without the section nothing is given.
MillHousing read_housing(const Node &root, const Material &steel, Reading &reading);
Screwdown read_screwdown(const Node &root, Reading &reading);
/// Keys of [frame] that need not be given with them.
/// @param backup_bearing  null: unknown
std::vector<std::string> frame_keys_behind(bool housing, const Screwdown &screwdown,
                                           const RollerBearing *backup_bearing);
/// The chocks of [frame] when the stiffness of a backup bearing includes its chock: left out, with a note.
void drop_counted_chocks(Frame &frame, RollerBearing &backup_bearing, const Reading &reading);
/// Values of tolerance_rows(), by the keys of the quantities they belong to; appended to the echo.
std::map<std::string, double> read_tolerances(const std::vector<Row> &rows, const Section &section,
                                              Reading &reading);
/// [frame]; what is needless and not given is NaN, masses behind what is given are zero.
/// @param given  names that stand under [given]
/// @param wish   what of it is to be estimated
Frame read_frame(const Node &root, const std::vector<std::string> &needless, const std::set<std::string> &given,
                 EstimateInput &wish, Reading &reading);
DynamicsSettings read_dynamics(const Node &root, const std::vector<Field<DynamicsSettings>> &rows,
                               Reading &reading);
FrequencyResponseSettings read_frequency_response(const Node &root, Reading &reading);
CampbellSettings read_campbell(const Node &root, const std::vector<Field<CampbellSettings>> &rows,
                               Reading &reading);
/// [[drive.order]]; `root` may have none.
std::vector<DriveOrder> read_drive_orders(const Node &root, Reading &reading);
/// Where no roll is drawn: the size of every roll whose turns an order refers to.
void check_turning_shafts(const CampbellSettings &campbell, const std::vector<DriveOrder> &orders,
                          Reading &reading);
/// [given] (replaces computed values) or [published] (is compared with them).
GivenValues read_given(const Node &root, const std::string &name, const std::string &kind, Reading &reading);

FourHigh read_four_high(const Node &root, Reading &reading);
Lumped read_lumped(const Node &root, Reading &reading);
TwoCylinders read_two_cylinders(const Node &root, Reading &reading);
BearingCase read_bearing_case(const Node &root, Reading &reading);
BiteCase read_bite_case(const Node &root, Reading &reading);
ChatterCase read_chatter(const Node &root, Reading &reading);
/// [stand] and [analysis] of a four-high, for chatter of its computed structure.
StandSpan read_stand_span(const Node &root, Reading &reading);
ChatterAnalysis read_chatter_analysis(const Node &root, Reading &reading);
/// All [bearing.*], completed and checked.
/// @param on_backup_roll  name of the one that carries the backup rolls
std::vector<RollerBearing> read_bearings(const Node &root, const std::string &on_backup_roll, Reading &reading);
/// Those [bearing.*] whose type is oil-film.
std::vector<OilFilmBearing> read_oil_films(const Node &root, Reading &reading);
/// Does the entry of [bearing] say so?
bool is_oil_film(const Node::Entry &entry);
void check_oil_film(const OilFilmBearing &bearing, Reading &reading);
/// [load] of an oil-film bearing, and sections that belong to rollers.
void check_oil_film_load(const Node &root, const BearingCase &spec, Reading &reading);
/// Backup rolls alone are carried by oil films, at the speed of every pass.
void check_oil_films_of_stand(const FourHigh &stand, Reading &reading);
/// Fills in what follows from the rest of a bearing: a member left out of the apex condition, the law and rings
/// that its drawing allows, sizes of the chock.  Each is noted in `filled`.
/// @param of_backup_roll  its chock is not carried on two feet
void complete_bearing(RollerBearing &bearing, bool of_backup_roll, const Reading &reading);

/// Rows of [bearing.*]; with a designation none of them is required.
std::vector<Field<RollerBearing>> bearing_rows_for(const Section &section);
/// What the designation of a bearing gives, where its keys are left out, and estimates of the rollers.
/// @throws SystemError  the disk refuses the user's catalogue
void complete_by_designation(RollerBearing &bearing, Reading &reading);
/// The estimated keys as comments: they stay open in the echo, so that it runs to the same results.
std::string estimated_lines(const RollerBearing &bearing);

/// Two keys that cannot both be right: the problem stands at the first, the others are shown with it.
void contradict(Reading &reading, const std::string &key, const std::string &why,
                const std::vector<std::string> &others);
/// The same for what is unlikely: a warning, nothing is refused.
struct Doubt {
  std::string fact;  ///< what follows the key and its value: "is narrower than .."
  std::string detail{}, remedy{};
};
void doubt(Reading &reading, const std::string &key, const Doubt &why, const std::vector<std::string> &others);
std::string millimetres(double length);  ///< "4.5 mm"
std::string degrees(double angle);       ///< "19.66 deg"

// Checks between keys.  Each compares only values that were accepted, and names both places.
void check_work_roll(const WorkRollInput &roll, Reading &reading);
void check_backup_roll(const Roll &roll, Reading &reading);
/// Crown, tables and chamfers of the barrel in the section `name`.
void check_profile(const std::string &name, const Roll &roll, Reading &reading);
void check_bearing(const RollerBearing &bearing, Reading &reading);
/// @param key    that names the bearing, "work_roll.bearing"
/// @param names  of all bearings
void check_bearing_name(const std::string &key, const std::string &bearing, const std::vector<std::string> &names,
                        Reading &reading);
void check_bearing_load(const BearingCase &spec, Reading &reading);
void check_strip(const Strip &strip, Reading &reading);
/// Keys that the laws of flow stress and friction cannot do without.
void check_flow_and_friction(const Strip &strip, Reading &reading);
/// A name that becomes part of file names.
void check_not_empty(const std::string &key, const std::string &name, Reading &reading);
void check_pass_names(const std::vector<Pass> &passes, Reading &reading);
/// Thicknesses, tensions and speed of every pass against the strip.
void check_passes_in_bite(const std::vector<Pass> &passes, const Strip &strip, Reading &reading);
void check_bite_setup(const BiteSetup &setup, const Friction &friction, Reading &reading);
/// bite.fit: what it asks is measured, and enough of it.
void check_fit(const BiteSetup &setup, const Strip &strip, const std::vector<Pass> &passes, Reading &reading);
/// Forces of the passes and their files.
void check_passes(const std::vector<Pass> &passes, Reading &reading);
void check_contact(const std::string &section, const ContactSettings &contact, Reading &reading);
/// Two bodies of revolution: shapes, profiles, friction, what the plane and the space contact each need.
void check_bodies(const TwoCylinders &pair, Reading &reading);
/// Rolls against each other, bearings that are named, the strip, passes against strip and contacts.
void check_four_high(const FourHigh &stand, Reading &reading);
/// Neck in its bearing, bearing on its neck, chocks and rolls in the window, chocks next to each other, loads of
/// bearings: what cannot be is a problem, what hardly is a warning.
void check_consistency(const FourHigh &stand, Reading &reading);
/// force_meaning = "published" needs K4 and C.
void check_published_force(const DynamicsSettings &dynamics, const GivenValues &given, Reading &reading);
}  // namespace mill
