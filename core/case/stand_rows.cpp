#include "core/case/stand_rows.h"

// Columns of a row: key, destination, unit (or form), range in that unit, default in that unit, example, meaning.
// Ranges are generous: they catch a slip of unit or of a power of ten, they do not judge a design.
namespace mill {
namespace {
constexpr Range stand_stiffness{1, 1e7};  // kN/mm, from a soft spring to far beyond a solid block of steel
constexpr Range part_mass{0, 5e5};        // kg

// The profile of the barrel, the same keys for work and backup roll.  z is measured from mid-length, positive
// towards the drive side.
template <class T> void add_profile_rows(std::vector<Field<T>> &rows)
{
  const auto add = [&](const char *key, Member<T> member, const char *form, Range range, Fallback fallback,
                       const char *example, const char *meaning) {
    rows.push_back({key, member, form, range, fallback, example, meaning});
  };
  add("crown", &T::crown, "um", {-2000, 2000}, 0, "0 um",
      "diameter at mid-length minus diameter at the barrel end, parabola between");
  add("crown_table", &T::crown_table, "mm, um", {-5000, 5000}, absent,
      R"([["-700 mm", "0 um"], ["700 mm", "0 um"]])",
      "position from mid-length and diameter minus nominal, instead of crown");
  add("crown_polynomial", &T::crown_polynomial, "1, um", {-5000, 5000}, absent, R"([[1, "0 um"], [3, "0 um"]])",
      "powers and coefficients of the diameter minus nominal in 2 z / barrel_length, instead of crown; odd powers "
      "make a CVC profile");
  add("thermal_crown", &T::thermal_crown, "um", {-2000, 2000}, 0, "0 um",
      "growth of the diameter by heat at mid-length against the barrel end, parabola between; adds to the ground "
      "crown");
  add("thermal_crown_table", &T::thermal_crown_table, "mm, um", {-5000, 5000}, absent,
      R"([["-700 mm", "0 um"], ["700 mm", "0 um"]])",
      "position from mid-length and growth of the diameter by heat, instead of thermal_crown");
  add("end_chamfer_length", &T::end_chamfer_length, "mm", {0, 1000}, 0, "0 mm",
      "length of the relief at each barrel end");
  add("end_chamfer_depth", &T::end_chamfer_depth, "um", {0, 5000}, 0, "0 um",
      "how much the radius has fallen at the barrel end, straight over end_chamfer_length");
}
}  // namespace

const std::vector<Field<CaseHead>> &head_rows()
{
  static const std::vector<Field<CaseHead>> rows{
      {"schema", &CaseHead::schema, "count", any, required, "1", "version of the case file format"},
      {"kind", &CaseHead::kind, "text", any, required, "four-high", "what the case describes"},
      {"title", &CaseHead::title, "text", any, "", "1400 four-high, demo stand", "headline of the report"},
      {"confirmed", &CaseHead::confirmed, "text", any, "", "work_roll strip.width",
       "keys and sections whose values are intentionally those of the template, separated by blanks, or \"all\": "
       "the run lists the remaining ones"},
  };
  return rows;
}

const std::vector<Field<Material>> &steel_rows()
{
  using T = Material;
  static const std::vector<Field<T>> rows{
      {"youngs_modulus", &T::youngs_modulus, "GPa", {1, 1000}, 210, "210 GPa", "Young's modulus of every solid"},
      {"poisson_ratio", &T::poisson_ratio, "1", {0, 0.49}, 0.28, "0.28", "Poisson's ratio"},
      {"density", &T::density, "kg/m3", {500, 25000}, 7700, "7700 kg/m3", "density"},
      {"yield_stress",
       &T::yield_stress,
       "MPa",
       {1, 10000},
       absent,
       "1500 MPa",
       "yield stress of the rolls; when given, pressures above five times it are warned of"},
  };
  return rows;
}

const std::vector<Field<WorkRollInput>> &work_roll_rows()
{
  using T                                 = WorkRollInput;
  static const std::vector<Field<T>> rows = [] {
    std::vector<Field<T>> all{
        {"barrel_diameter",
         &T::barrel_diameter,
         "mm",
         {40, 2500},
         required,
         "420 mm",
         "ground diameter of the barrel"},
        {"barrel_length", &T::barrel_length, "mm", {100, 6000}, required, "1400 mm", "length of the barrel"},
        {"neck_diameter", &T::neck_diameter, "mm", {20, 2500}, required, "266.7 mm", "diameter of both necks"},
        {"total_length", &T::total_length, "mm", {100, 12000}, required, "2320 mm", "over both necks"},
        {"bearing_span",
         &T::bearing_span,
         "mm",
         {100, 12000},
         required,
         "2000 mm",
         "between the centres of the two bearings"},
        {"bearing", &T::bearing, "text", any, required, "trb", "name of a [bearing.*]"},
        {"bearing_mass", &T::bearing_mass, "kg", part_mass, required, "90 kg", "bearing set, per side"},
        {"chock_mass_upper", &T::chock_mass_upper, "kg", part_mass, required, "0 kg", "upper chock, per side"},
        {"chock_mass_lower", &T::chock_mass_lower, "kg", part_mass, required, "880 kg", "lower chock, per side"},
        {"axial_shift",
         &T::axial_shift,
         "mm",
         {-1000, 1000},
         0,
         "0 mm",
         "of the upper work roll against the backup roll, towards the drive side; the lower work roll has the "
         "opposite offset"},
        {"bending_force",
         &T::bending_force,
         "kN",
         {-10000, 10000},
         absent,
         R"(["0 kN", "0 kN"])",
         "on the chocks of drive and operator side, positive towards the backup roll"},
        {"bearing_load",
         &T::bearing_load,
         "kN",
         {0.001, 50000},
         absent,
         "48.8 kN",
         "radial load of one bearing; when absent F/20 is assumed and reported as an assumption"},
    };
    add_profile_rows(all);
    return all;
  }();
  return rows;
}

const std::vector<Field<Roll>> &backup_roll_rows()
{
  using T                                 = Roll;
  static const std::vector<Field<T>> rows = [] {
    std::vector<Field<T>> all{
        {"barrel_diameter",
         &T::barrel_diameter,
         "mm",
         {40, 2500},
         required,
         "1450 mm",
         "ground diameter of the barrel"},
        {"barrel_length", &T::barrel_length, "mm", {100, 6000}, required, "1400 mm", "length of the barrel"},
        {"neck_diameter", &T::neck_diameter, "mm", {20, 2500}, required, "950 mm", "diameter of both necks"},
        {"neck_length",
         &T::neck_length,
         "mm",
         {50, 5000},
         required,
         "950 mm",
         "each side, from the barrel end to the end of the roll"},
        {"bearing_span",
         &T::bearing_span,
         "mm",
         {100, 12000},
         required,
         "2450 mm",
         "between the centres of the two bearings"},
        {"bending_model", &T::bending_model, "choice", any, BendingModel::solid, "solid",
         "source of K_ZW and of the shapes of the rolls: finite elements of the rolls as drawn, or "
         "the "
         "closed forms of stepped beams, which are too stiff at the shoulders"},
        {"bearing", &T::bearing, "text", any, required, "crb", "name of a [bearing.*]"},
        {"bearing_mass", &T::bearing_mass, "kg", part_mass, required, "1500 kg", "bearing, per side"},
        {"chock_mass_upper", &T::chock_mass_upper, "kg", part_mass, required, "10900 kg", "upper chock, per side"},
        {"chock_mass_lower", &T::chock_mass_lower, "kg", part_mass, required, "9800 kg", "lower chock, per side"},
        {"bearing_load",
         &T::bearing_load,
         "kN",
         {0.001, 50000},
         absent,
         "488 kN",
         "radial load of one bearing; when absent half the rolling force"},
    };
    add_profile_rows(all);
    return all;
  }();
  return rows;
}

const std::vector<Field<Frame>> &frame_rows()
{
  using T = Frame;
  static const std::vector<Field<T>> rows{
      {"upper_post_mass", &T::upper_post_mass, "kg", part_mass, required, "5200 kg", "reduced, both sides"},
      {"upper_beam_mass", &T::upper_beam_mass, "kg", part_mass, required, "2700 kg", "reduced"},
      {"upper_packing_mass", &T::upper_packing_mass, "kg", part_mass, required, "420 kg", "whole stand"},
      {"piston_mass", &T::piston_mass, "kg", part_mass, required, "1000 kg", "screw-down pistons, whole stand"},
      {"cylinder_mass", &T::cylinder_mass, "kg", part_mass, required, "7400 kg", "screw-down cylinder, per side"},
      {"balance_mass", &T::balance_mass, "kg", part_mass, required, "8000 kg", "roll balance gear, whole stand"},
      {"lower_post_mass", &T::lower_post_mass, "kg", part_mass, required, "2150 kg", "reduced, both sides"},
      {"lower_beam_mass", &T::lower_beam_mass, "kg", part_mass, required, "1850 kg", "reduced"},
      {"load_cell_mass", &T::load_cell_mass, "kg", part_mass, required, "240 kg", "whole stand"},
      {"lower_packing_mass", &T::lower_packing_mass, "kg", part_mass, required, "420 kg", "whole stand"},
      {"upper_post_stiffness", &T::upper_post_stiffness, "kN/mm", stand_stiffness, required, "6.0e4 kN/mm",
       "upper part of the posts"},
      {"upper_beam_stiffness", &T::upper_beam_stiffness, "kN/mm", stand_stiffness, required, "7.30e3 kN/mm",
       "top beam"},
      {"piston_stiffness", &T::piston_stiffness, "kN/mm", stand_stiffness, required, "4.0e5 kN/mm",
       "screw-down pistons"},
      {"upper_packing_stiffness", &T::upper_packing_stiffness, "kN/mm", stand_stiffness, required, "4.5e5 kN/mm",
       "top packing"},
      {"oil_column_stiffness", &T::oil_column_stiffness, "kN/mm", stand_stiffness, required, "1.80e4 kN/mm",
       "oil columns of the screw-down cylinders"},
      {"cylinder_body_stiffness", &T::cylinder_body_stiffness, "kN/mm", stand_stiffness, required, "1.25e5 kN/mm",
       "bodies of the screw-down cylinders"},
      {"upper_chock_stiffness", &T::upper_chock_stiffness, "kN/mm", stand_stiffness, required, "1.03e5 kN/mm",
       "upper backup-roll chocks; not needed, and left out, when the stiffness of their bearing includes the "
       "chock"},
      {"lower_chock_stiffness", &T::lower_chock_stiffness, "kN/mm", stand_stiffness, required, "1.03e5 kN/mm",
       "lower backup-roll chocks; likewise"},
      {"lower_post_stiffness", &T::lower_post_stiffness, "kN/mm", stand_stiffness, required, "6.0e4 kN/mm",
       "lower part of the posts"},
      {"lower_beam_stiffness", &T::lower_beam_stiffness, "kN/mm", stand_stiffness, required, "8.05e3 kN/mm",
       "bottom beam"},
      {"lower_packing_stiffness", &T::lower_packing_stiffness, "kN/mm", stand_stiffness, required, "2.25e5 kN/mm",
       "bottom packing"},
      {"load_cell_stiffness", &T::load_cell_stiffness, "kN/mm", stand_stiffness, absent, "5e4 kN/mm",
       "load cells; rigid when absent"},
      {"chock_to_housing_stiffness", &T::chock_to_housing_stiffness, "kN/mm", stand_stiffness, absent, "2e4 kN/mm",
       "horizontal seat of one work roll's chocks, both sides together; rigid when absent"},
  };
  return rows;
}

const std::vector<Field<PassInput>> &pass_rows()
{
  using T = PassInput;
  static const std::vector<Field<T>> rows{
      {"name", &T::name, "text", any, required, "pass 1", "unique; names the response file"},
      {"force", &T::force_file, "path", any, absent, "data/pass-1.csv",
       "recorded rolling force, columns time [s] and force [kN]; CSV, MATLAB, numpy, universal files, LabVIEW"},
      {"measured", &T::measured_file, "path", any, absent, "data/pass-1-measured.csv",
       "measured accelerations, columns time [s], upper_work_roll [g], lower_work_roll [g]"},
      {"synthetic", &T::synthetic, "flag", any, 0, "true", "the force record is made, not measured"},
      {"load",
       &T::load,
       "kN",
       {0.1, 100000},
       absent,
       "976.2 kN",
       "working load; when absent the mean of the force record"},
      {"entry_thickness", &T::entry_thickness, "mm", {0.01, 1000}, absent, "8 mm", "when absent that of [strip]"},
      {"exit_thickness", &T::exit_thickness, "mm", {0.005, 1000}, absent, "5 mm", "when absent that of [strip]"},
      {"entry_tension",
       &T::entry_tension,
       "MPa",
       {0, 2000},
       absent,
       "0 MPa",
       "back tension, when absent that of [strip]"},
      {"exit_tension",
       &T::exit_tension,
       "MPa",
       {0, 2000},
       absent,
       "0 MPa",
       "front tension, when absent that of [strip]"},
      {"speed",
       &T::speed,
       "m/s",
       {0.001, 100},
       absent,
       "2 m/s",
       "of the rolls' surface, for friction that depends on it"},
      {"forward_slip",
       &T::forward_slip,
       "%",
       {-20, 100},
       absent,
       "4.2 %",
       "measured: speed of the strip behind the bite over that of the rolls, less one; for bite.fit"},
      {"torque",
       &T::torque,
       "kN m",
       {-10000, 10000},
       absent,
       "17 kN m",
       "measured: of one roll at the bite, without bearings and drive; for bite.fit"},
      {"force_deviation",
       &T::force_deviation,
       "%",
       {0.01, 50},
       2,
       "2 %",
       "standard deviation of the measured load, for bite.fit"},
      {"slip_deviation",
       &T::slip_deviation,
       "%",
       {0.001, 20},
       0.3,
       "0.3 %",
       "standard deviation of forward_slip in points, for bite.fit"},
      {"torque_deviation",
       &T::torque_deviation,
       "%",
       {0.01, 100},
       5,
       "5 %",
       "standard deviation of torque over its value, for bite.fit"},
      {"published_peak",
       &T::published_peak,
       "g",
       {0, 10000},
       absent,
       R"(["1.40 g", "0.75 g"])",
       "peak accelerations of a published model, upper and lower work roll, for comparison with the result"},
      {"measured_peak",
       &T::measured_peak,
       "g",
       {0, 10000},
       absent,
       R"(["1.20 g", "0.60 g"])",
       "measured peak accelerations where no record is known, upper and lower work roll"},
      {"synthetic_range",
       &T::synthetic_range,
       "kN",
       {0.1, 100000},
       absent,
       R"(["972.898 kN", "979.537 kN"])",
       "instead of a force file: band-limited white noise that touches both ends"},
      {"synthetic_duration", &T::synthetic_duration, "s", {0.01, 600}, 10, "10 s", "length of the noise"},
      {"synthetic_bandwidth",
       &T::synthetic_bandwidth,
       "Hz",
       {1, 100000},
       1000,
       "1000 Hz",
       "upper end of its band"},
      {"synthetic_seed", &T::synthetic_seed, "count", {0, 2147483647}, 1, "1", "seed of the noise"},
  };
  return rows;
}

const std::vector<Field<ContactSettings>> &roll_contact_rows()
{
  using T = ContactSettings;
  static const std::vector<Field<T>> rows{
      {"loads",
       &T::loads,
       "kN",
       {0.1, 100000},
       absent,
       R"(["100 kN", "2000 kN"])",
       "swept range; when absent chosen around the working loads"},
      {"samples", &T::samples, "count", {5, 1000}, 24, "24", "loads in the sweep, logarithmically spaced"},
      {"elements_per_half_width",
       &T::elements_per_half_width,
       "count",
       {2, 64},
       8,
       "8",
       "quadratic elements per Hertz half width at the largest load"},
      {"tilt",
       &T::tilt,
       "mrad",
       {-50, 50},
       absent,
       "0.02 mrad",
       "angle of the two axes in the plane of the load, closing on the drive side"},
      {"load_offset",
       &T::load_offset,
       "mm",
       {-5000, 5000},
       absent,
       "20 mm",
       "position of the resultant force from mid-length, towards the drive side; instead of tilt"},
      {"cross_angle",
       &T::cross_angle,
       "deg",
       {-5, 5},
       0,
       "0.1 deg",
       "angle of the two axes in the plane of contact"},
      {"axis_offset",
       &T::axis_offset,
       "mm",
       {-500, 500},
       0,
       "2 mm",
       "distance of the two axes across the plane of the load"},
      {"friction",
       &T::friction,
       "1",
       {0, 2},
       absent,
       "0.2",
       "Coulomb friction between the rolls; when given its effect on the stiffness is computed"},
      {"path_trim",
       &T::path_trim,
       "%",
       {0, 45},
       10,
       "10 %",
       "share of the contact path left out at each end for the plateau value (.path_plateau)"},
  };
  return rows;
}

const std::vector<Field<DynamicsSettings>> &dynamics_rows()
{
  using T = DynamicsSettings;
  static const std::vector<Field<T>> rows{
      {"modal_damping", &T::modal_damping, "%", {0, 50}, 1, "1 %", "ratio of critical, the same in every mode"},
      {"force_meaning", &T::force_meaning, "choice", any, ForceMeaning::measured, "measured",
       "measured: total bite force, K4 and C rest; disturbance: without the reaction of the gap; published: K4 "
       "and C "
       "in parallel"},
      {"output_rate", &T::output_rate, "kHz", {0.1, 10000}, 20, "20 kHz", "samples of the response per second"},
      {"frame", &T::frame, "choice", any, FrameForm::open, "open",
       "open: K1 and K7 end at the ground; closed: K1 joins M1 to M6"},
      {"contact", &T::contact, "choice", any, ContactSprings::linear, "linear",
       "springs of roll contacts and bearings under the rolling force: linear: their slopes at the working load; "
       "curve: their computed force over compression, which parts at zero force"},
      {"mass_reference", &T::mass_reference, "choice", any, MassReference::mid, "mid",
       "displacement the equivalent masses refer to: mid-span or load-weighted mean"},
      {"mass_source", &T::mass_source, "choice", any, MassSource::closed_form, "closed-form",
       "shapes behind the equivalent masses of the rolls: closed forms, or finite elements of the rolls"},
      {"model", &T::model, "choice", any, StandModelKind::six_mass, "six-mass",
       "what the rolling force drives: the chain of six masses, rolls as beams, or rolls and housing as reduced "
       "finite elements"},
      {"frequency_limit",
       &T::frequency_limit,
       "Hz",
       {20, 20000},
       1000,
       "1000 Hz",
       "up to which the modes of beam and craig-bampton are to be right, and are compared"},
      {"elements_per_radius",
       &T::elements_per_radius,
       "count",
       {3, 12},
       3,
       "3",
       "least number of quadratic elements over the radius of a roll in the meshes of craig-bampton; more are "
       "used where the frequency limit needs them"},
      {"model_files", &T::model_files, "choice", any, ModelFileSet::small, "small",
       "small: damping matrix and MATLAB file of a model of more than 100 unknowns are left out of models/; all: "
       "they "
       "are written"},
  };
  return rows;
}

const std::vector<Field<DynamicsSettings>> &chain_dynamics_rows()
{
  // A chain of given masses has no shapes and no rolls: what concerns them comes last in the rows above.
  static const std::vector<Field<DynamicsSettings>> rows(dynamics_rows().begin(), dynamics_rows().begin() + 6);
  return rows;
}
}  // namespace mill
