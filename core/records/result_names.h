#pragma once
#include "core/base/parameter.h"
#include "core/records/csv.h"
#include <array>
#include <optional>
#include <string>
#include <vector>

// Names that one stage writes and another one reads: results, the files in curves/ with their columns, the checks
// next to a number.  Each is written here once.
namespace mill {
/// Note of the check of bite.PASS.force where that force is too far from the one of the pass: what to do.
constexpr const char *force_remedy = "bite.fit = [\"force\"] fits the flow stress to it";

// Results ------------------------------------------------------------------------------------------------------

/// First part of the names of results of one subject: "contact.upper.half_width", "bite.pass 1.force".
namespace family {
constexpr const char *contact = "contact", *bite = "bite", *chatter = "chatter", *bearing = "Kzc",
                     *bite_spring = "K4", *stand = "stand", *mode = "mode", *open = "open", *frf = "frf",
                     *campbell = "campbell", *nonlinear = "nonlinear";
}

/// Second part of the names of what a fit of the bite finds, "bite.fit.friction"; no pass may have this name.
constexpr const char *bite_fit = "fit";

/// Parts joined by dots: result_name({family::bite, "pass 1", "force"}) = "bite.pass 1.force"; empty ones are left
/// out.
std::string result_name(const std::vector<std::string> &parts);

/// The spring of the chain that a roll contact is: "upper" -> "K3", "lower" -> "K5", else "contact.<name>".
std::string spring_of_contact(const std::string &contact);

// Checks -------------------------------------------------------------------------------------------------------

/// A check that somebody looks for.  Others are only shown.
enum class CheckId {
  published,                 ///< as [given] marks it
  published_model,           ///< of a published simulation
  published_total,           ///< bearing stiffness as it was published
  published_times_Z5,        ///< sum of published values of one roller per row, times Z/5
  published_times_stribeck,  ///< the same times Z cos^2(alpha)/4.085
  measured,
  johnson_secant,    ///< line contact of infinitely long rolls
  middle_section,    ///< mid-length section of the computed contact over the whole length
  held_as_in_stand,  ///< rolls held by necks and strip
  closed_form_mass,  ///< where the finite elements are the value
  fe_integral_mass,  ///< integrals of the closed form over the finite-element axis
  fe_solid_mass,     ///< all points of the finite elements
  stepped_beams,     ///< closed form, where the rolls of the chain are solid
};

/// The name under which it stands in results.json and on the page.
const char *name_of(CheckId id);
Check check(CheckId id, double value, std::string note = "");
/// nullptr when no check has this id.
const Check *find_check(const std::vector<Check> &checks, CheckId id);
/// The first one that was published; nullptr without.
const Check *find_published(const std::vector<Check> &checks);
/// Its value; NaN without it.
double value_beside(const std::vector<Check> &checks, CheckId id);

// Curves -------------------------------------------------------------------------------------------------------

/// Where the report shows a curve.
enum class Figure {
  section,        ///< a figure that the section of its family draws for it alone
  load_approach,  ///< load over approach and stiffness over load, one line for each curve of a contact
  barrel,         ///< along the barrel, one line for each curve of a contact
  own,            ///< a plain figure of its own: every other column over the first
};

struct CurveColumn {
  const char *name = "";
  const char *unit = "";  ///< as stored; "" for a pure number
};

/// One kind of file in curves/: <family>[-<item>][<joint><ending>].csv
struct CurveKind {
  const char *family;  ///< "contact"
  bool has_item;       ///< a contact, a bearing, a pass, a condition stands in the name
  const char *ending;  ///< "barrel"; "": the file of the item itself
  const char *title;   ///< what it holds; its label where several curves share a figure
  Figure figure;
  std::array<CurveColumn, 8> columns;  ///< first ones; a curve per length has other units of force
  bool more  = false;                  ///< others follow, one for each row, law, theory
  char joint = '-';  ///< before the ending; a point, which no slug has, where items have any name: "x" and "x-fe"
};

namespace curve {
constexpr std::array<CurveColumn, 8> of_contact{{{"load", "N"},
                                                 {"approach", "m"},
                                                 {"half_width", "m"},
                                                 {"peak_pressure", "Pa"},
                                                 {"tangent", "N/m"},
                                                 {"secant", "N/m"},
                                                 {"iterations", ""}}};
constexpr std::array<CurveColumn, 8> of_barrel{{{"z", "m"},
                                                {"line_load", "N/m"},
                                                {"approach", "m"},
                                                {"tangent", "N/m2"},
                                                {"half_width", "m"},
                                                {"peak_pressure", "Pa"}}};
constexpr std::array<CurveColumn, 8> of_patch{{{"z", "m"}, {"x", "m"}, {"pressure", "Pa"}}};
constexpr std::array<CurveColumn, 8> of_speed{{{"speed", "m/s"}, {"growth_rate", "1/s"}}};

// Inline: kinds are distinguished by their addresses.
// To add a curve of a contact or a bearing to the report: a line here and its name in `all`, and the stage that
// writes it.
inline constexpr CurveKind contact{"contact", true, "", "this run", Figure::load_approach, of_contact};
inline constexpr CurveKind contact_in_stand{
    "contact", true, "in-stand", "held as in the stand", Figure::load_approach, of_contact};
inline constexpr CurveKind contact_second{"contact", true, "second", "Fourier solver", Figure::load_approach,
                                          of_contact};
inline constexpr CurveKind contact_closed{
    "contact", true, "closed", "closed forms", Figure::section, {{{"load", "N"}, {"hertz_secant", "N/m"}}}, true};
inline constexpr CurveKind contact_barrel{"contact", true, "barrel", "as in the stand", Figure::barrel, of_barrel};
inline constexpr CurveKind contact_barrel_mirrored{"contact",         true,           "barrel-mirrored",
                                                   "squeezed evenly", Figure::barrel, of_barrel};
inline constexpr CurveKind contact_barrel_second{
    "contact", true, "barrel-second", "as in the stand, Fourier solver", Figure::barrel, of_barrel};
inline constexpr CurveKind contact_pressure{"contact",       true,    "pressure", "contact pressure",
                                            Figure::section, of_patch};

/// Two bodies of revolution: over the width, along the axes, closed forms of contacts in space, stick and slip.
inline constexpr CurveKind contact_width{
    "contact", true, "width", "over the width", Figure::own, {{{"x", "m"}, {"pressure", "Pa"}}}, true};
inline constexpr CurveKind contact_length{
    "contact",   true,
    "length",    "along the axes",
    Figure::own, {{{"z", "m"}, {"line_load", "N/m"}, {"half_width", "m"}, {"peak_pressure", "Pa"}}}};
inline constexpr CurveKind contact_hertz{"contact",
                                         true,
                                         "hertz",
                                         "Hertz, ellipse",
                                         Figure::load_approach,
                                         {{{"load", "N"}, {"approach", "m"}, {"tangent", "N/m"}}}};
inline constexpr CurveKind contact_lundberg{"contact",
                                            true,
                                            "lundberg",
                                            "Lundberg, even line load",
                                            Figure::load_approach,
                                            {{{"load", "N"}, {"approach", "m"}, {"tangent", "N/m"}}}};
inline constexpr CurveKind contact_slip{
    "contact",       true,
    "slip",          "stick and slip",
    Figure::section, {{{"z", "m"}, {"x", "m"}, {"pressure", "Pa"}, {"shear", "Pa"}, {"used", ""}}}};

inline constexpr CurveKind bearing{
    "bearing", true, "", "load and stiffness", Figure::section, {{{"load", "N"}, {"displacement", "m"}}}, true};
inline constexpr CurveKind bearing_rows{
    "bearing", true, "rows", "load of every row", Figure::section, {{{"row", ""}, {"share", ""}}}, true};
inline constexpr CurveKind bearing_rollers{
    "bearing", true, "rollers", "load of every roller", Figure::section, {{{"angle", "rad"}}}, true};
inline constexpr CurveKind bearing_law{"bearing",         true, "law", "laws of one roller", Figure::section,
                                       {{{"load", "N"}}}, true};
inline constexpr CurveKind bearing_tilt{
    "bearing", true, "tilt", "one roller tilted", Figure::section, {{{"tilt", "rad"}, {"load", "N"}}}, true};
inline constexpr CurveKind bearing_cage{
    "bearing", true, "cage", "one pitch of the cage", Figure::section, {{{"angle", "rad"}, {"tangent", "N/m"}}},
    true};
inline constexpr CurveKind bearing_tangent{
    "bearing", true, "tangent", "tangent of all motions", Figure::section, {{{"per_x", "N or N m per m"}}}, true};
inline constexpr CurveKind bearing_published{"bearing",       true, "published", "published values",
                                             Figure::section, {},   true};
inline constexpr CurveKind bearing_spectrum{
    "bearing", true, "spectrum", "spectra of a mass on it", Figure::section, {{{"frequency", "Hz"}}}, true};
inline constexpr CurveKind bearing_pressure_inner{
    "bearing", true, "pressure-inner", "pressure on the inner raceway", Figure::section, of_patch};
inline constexpr CurveKind bearing_pressure_outer{
    "bearing", true, "pressure-outer", "pressure on the outer raceway", Figure::section, of_patch};

inline constexpr CurveKind bearing_film_speed{
    "bearing", true, "film-speed", "oil film over the speed", Figure::section, {{{"speed", "Hz"}}}, true};
inline constexpr CurveKind bearing_film_pressure{
    "bearing", true, "film-pressure", "pressure in the oil film", Figure::section, of_patch};

inline constexpr CurveKind chatter_speed{"chatter",       true,     "speed", "over the roll speed",
                                         Figure::section, of_speed, true};
inline constexpr CurveKind chatter_locus{
    "chatter", true, "locus", "roots over the roll speed", Figure::section, {{{"speed", "m/s"}}}, true};
inline constexpr CurveKind chatter_map{
    "chatter", true, "map-", "growth over speed and another quantity", Figure::section, {{{"speed", "m/s"}}},
    true};
inline constexpr CurveKind chatter_boundary{
    "chatter", true, "boundary-", "critical speed over another quantity", Figure::section, {}, true};
inline constexpr CurveKind chatter_lobes{"chatter",       true,     "lobes", "lobes of a tandem",
                                         Figure::section, of_speed, true};

/// Of a pass: what the models make of the arc ("fe", "karman"), the loaded roll, the strip.
inline constexpr CurveKind bite_arc{"bite", true, "", "along the arc", Figure::section, {{{"x", "m"}}}, true, '.'};
inline constexpr CurveKind bite_outlet{
    "bite", true, "outlet", "what stays in the strip", Figure::section, {{{"y", "m"}, {"stress", "Pa"}}},
    false,  '.'};
inline constexpr CurveKind bite_k4{"bite", false, "k4-", "K4 over one input", Figure::section, {}, true};
inline constexpr CurveKind bite_map{"bite",
                                    false,
                                    "k4-map",
                                    "K4 over reduction and friction",
                                    Figure::section,
                                    {{{"reduction", ""}, {"friction", ""}}},
                                    true};
inline constexpr CurveKind bite_aspect{
    "bite", false, "aspect", "finite elements over slab theory", Figure::section, {{{"arc_over_thickness", ""}}},
    true};

inline constexpr CurveKind bite_fit{"bite",          false,
                                    "fit",           "95 % region of the fit",
                                    Figure::section, {{{"friction", ""}, {"flow_stress_factor", ""}}}};
inline constexpr CurveKind bite_fit_lines{"bite",          false, "fit-lines", "where one measured value is met",
                                          Figure::section, {},    true};

inline constexpr CurveKind shape_work_roll{
    "shape", false, "work-roll", "deflection of a work roll", Figure::section, {{{"x", "m"}, {"f1_upper", "m/N"}}},
    true};
inline constexpr CurveKind shape_backup_roll{"shape",
                                             false,
                                             "backup-roll",
                                             "deflection of a backup roll",
                                             Figure::section,
                                             {{{"x", "m"}, {"f2_upper", "m/N"}}},
                                             true};
inline constexpr CurveKind modes{"modes",          false, "", "modes of the chain", Figure::section,
                                 {{{"mode", ""}}}, true};
inline constexpr CurveKind modes_horizontal{
    "modes", false, "horizontal", "horizontal modes of the chain", Figure::section, {{{"mode", ""}}}, true};
inline constexpr CurveKind modes_of_model{"modes",          true, "", "modes of another model", Figure::section,
                                          {{{"mode", ""}}}, true};
inline constexpr CurveKind stand_modulus{
    "stand",
    false,
    "modulus",
    "mill modulus over the rolling force",
    Figure::section,
    {{{"load", "N"}, {"kiss_stretch", "m"}, {"kiss_tangent", "N/m"}, {"kiss_secant", "N/m"}}},
    true};
/// Of a model and a force: "craig-bampton-bite"; real and imaginary part of every response follow.
inline constexpr CurveKind frf{"frf", true, "", "accelerance", Figure::section, {{{"frequency", "Hz"}}}, true};
/// Magnitudes between which 95 of 100 stands lie.
inline constexpr CurveKind frf_band{
    "frf", true, "band", "band of the accelerance", Figure::section, {{{"frequency", "Hz"}}}, true};
/// Of a pass, its modes one below the other.
inline constexpr CurveKind backbone{
    "backbone",
    true,
    "",
    "frequency over amplitude",
    Figure::section,
    {{{"mode", ""}, {"amplitude", "m"}, {"frequency", "Hz"}, {"least_force", ""}}}};
/// Of a pass: on the curves of the contacts and on their slopes.
inline constexpr CurveKind nonlinear_spectrum{
    "nonlinear", true, "spectrum", "spectra on curves and on slopes", Figure::section, {{{"frequency", "Hz"}}},
    true};
inline constexpr CurveKind poles{"poles",
                                 false,
                                 "",
                                 "poles of the chain",
                                 Figure::section,
                                 {{{"pole", ""}, {"frequency", "Hz"}, {"damping", ""}}}};

/// Those that are recognised by the name of their file.
inline constexpr const CurveKind *all[] = {&contact,
                                           &contact_in_stand,
                                           &contact_second,
                                           &contact_closed,
                                           &contact_barrel,
                                           &contact_pressure,
                                           &contact_barrel_mirrored,
                                           &contact_barrel_second,
                                           &contact_width,
                                           &contact_length,
                                           &contact_hertz,
                                           &contact_lundberg,
                                           &contact_slip,
                                           &bearing,
                                           &bearing_rows,
                                           &bearing_rollers,
                                           &bearing_law,
                                           &bearing_tilt,
                                           &bearing_cage,
                                           &bearing_tangent,
                                           &bearing_published,
                                           &bearing_spectrum,
                                           &bearing_pressure_inner,
                                           &bearing_pressure_outer,
                                           &bearing_film_speed,
                                           &bearing_film_pressure,
                                           &chatter_speed,
                                           &chatter_locus,
                                           &chatter_map,
                                           &chatter_boundary,
                                           &chatter_lobes};
}  // namespace curve

/// Stands for a condition where the curve is of several stands together.
constexpr const char *tandem_item = "tandem";

/// "curves/contact-upper-barrel".
/// @param of  what of, where the ending of the kind is open ("map-"): "tension"
std::string curve_path(const CurveKind &kind, const std::string &item = "", const std::string &quantity = "");

/// What a file in curves/ is, by its path without ending ".csv".
struct CurveName {
  const CurveKind *kind;
  std::string item;  ///< "upper"
  std::string of;    ///< "tension"
};
/// Nothing when its family is not one of those above.  An ending that no kind has leaves the kind of the item
/// itself, where the family has one: curves_of tells such a file from an item.
std::optional<CurveName> curve_name(const std::string &path);

/// Throws std::logic_error when the columns are not those of the kind: our own bug.
void require_columns(const CurveKind &kind, const Table &table);
}  // namespace mill
