#pragma once
#include "core/case/errors.h"
#include "core/model/chatter.h"
#include "core/model/material.h"
#include "core/model/oil_film_bearing.h"
#include "core/model/roller_bearing.h"
#include "core/model/strip.h"
#include "core/records/parameter.h"
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace mill {
/// A roll as drawn.  Work roll and backup roll are the same struct; the case file names their lengths differently.
struct Roll {
  double barrel_diameter = 0;  ///< m, ground diameter of the barrel
  double barrel_length   = 0;  ///< m
  double neck_diameter   = 0;  ///< m
  double neck_length     = 0;  ///< m, each side, from the barrel end to the end of the roll
  double bearing_span    = 0;  ///< m, between the centres of the two bearings
  double crown           = 0;  ///< m, diameter at mid-length minus diameter at the barrel end (parabola)
  std::vector<std::array<double, 2>> crown_table;  ///< m, (z, diameter difference to the nominal); replaces crown
  std::vector<std::array<double, 2>> crown_polynomial;  ///< (power -, m on the diameter), in 2 z / barrel_length
  double thermal_crown = 0;                             ///< m, on the diameter, as crown
  std::vector<std::array<double, 2>> thermal_crown_table;  ///< m, as crown_table
  double end_chamfer_length           = 0;                 ///< m
  double end_chamfer_depth            = 0;                 ///< m, on the radius
  double axial_shift                  = 0;                 ///< m, upper work roll towards z > 0
  std::array<double, 2> bending_force = {0, 0};  ///< N, chocks at z > 0 and z < 0, towards the backup roll
  std::string bending_model = "solid";  ///< solid | beam, of the backup roll: where the chain's K_ZW and shapes
                                        ///< come from
  std::string bearing;                  ///< name of a [bearing.*]
  double bearing_mass     = 0;          ///< kg, per side
  double chock_mass_upper = 0;          ///< kg, per side, in the upper half of the stand
  double chock_mass_lower = 0;          ///< kg, per side, in the lower half
  double bearing_load =
      not_given;  ///< N, radial load of one bearing; absent: F/2 (backup), F/20 assumed (work roll)
};

/// Frame, screw-down and chocks: masses already reduced to the moving point, stiffnesses of the whole stand.
struct Frame {
  double upper_post_mass = 0, upper_beam_mass = 0, upper_packing_mass = 0, piston_mass = 0;     ///< kg
  double cylinder_mass   = 0;                                                                   ///< kg, per side
  double balance_mass    = 0;                                                                   ///< kg, total
  double lower_post_mass = 0, lower_beam_mass = 0, load_cell_mass = 0, lower_packing_mass = 0;  ///< kg
  double upper_post_stiffness = 0, upper_beam_stiffness = 0, piston_stiffness = 0;              ///< N/m
  double upper_packing_stiffness = 0, oil_column_stiffness = 0, cylinder_body_stiffness = 0;    ///< N/m
  double upper_chock_stiffness = 0, lower_chock_stiffness = 0;                                  ///< N/m
  double lower_post_stiffness = 0, lower_beam_stiffness = 0, lower_packing_stiffness = 0;       ///< N/m
  double load_cell_stiffness = not_given;  ///< N/m, absent: rigid
  double chock_to_housing_stiffness =
      not_given;                            ///< N/m, Kx of each work roll, both sides together; absent: rigid
  std::map<std::string, double> tolerance;  ///< -, relative, of the members above by their keys, as far as given
};

/// Mill housing of one side, a closed window frame of one thickness; the other side is the same.  x along the pass
/// line, y up, z along the rolls.  Absent when thickness is not given.
struct MillHousing {
  double thickness         = not_given;  ///< m, along the rolls
  double post_width        = 0;          ///< m, along the pass line
  double window_width      = 0;          ///< m, between the posts
  double window_height     = 0;          ///< m, between the beams
  double upper_beam_height = 0;          ///< m
  double lower_beam_height = 0;          ///< m
  double fillet_radius     = 0;          ///< m, of the corners of the window
  double foot_height       = 0;  ///< m, from the window's bottom up to where the posts stand on the foundation
  double screw_pad         = 0;  ///< m, side of the square that the nut presses on, under the upper beam
  double seat_pad          = 0;  ///< m, side of the square that the lower chock presses on, on the lower beam
  double modulus           = not_given;  ///< Pa, as given; absent: that of the rolls
  double density           = not_given;  ///< kg/m3, the same
  Material steel;                        ///< complete
  bool present() const
  {
    return !std::isnan(thickness);
  }
};

/// Screw-down of one side as drawn; each part that is given replaces a stiffness of the frame.
struct Screwdown {
  double screw_diameter       = not_given;  ///< m, of the core
  double screw_length         = not_given;  ///< m, free length
  double nut_outside_diameter = not_given;  ///< m
  double nut_height           = not_given;  ///< m
  double nut_modulus          = 110e9;      ///< Pa, bronze
  double piston_diameter      = not_given;  ///< m, of oil column and piston
  double piston_length        = not_given;  ///< m
  double stroke               = not_given;  ///< m, height of the oil column
  double oil_modulus          = 1.4e9;      ///< Pa
  double load_cell_diameter   = not_given;  ///< m
  double load_cell_bore       = 0;          ///< m
  double load_cell_height     = not_given;  ///< m
};

/// One pass: a recorded rolling force, and what was measured with it.
struct Pass {
  std::string name;                                    ///< unique, names the response file
  std::string force_file;                              ///< path as usable from the working directory
  std::string measured_file;                           ///< same; empty: none
  Place place;                                         ///< of the [[pass]] header
  Place force_place, measured_place;                   ///< of the two path values
  double entry_thickness                 = not_given;  ///< m, absent: that of [strip]
  double exit_thickness                  = not_given;  ///< m
  double entry_tension                   = not_given;  ///< Pa, absent: that of [strip]
  double exit_tension                    = not_given;  ///< Pa
  double speed                           = not_given;  ///< m/s, of the rolls' surface
  std::array<double, 2> published_peak_g = {not_given,
                                            not_given};  ///< g, upper and lower work roll, a published model's
  std::array<double, 2> measured_peak_g  = {not_given,
                                            not_given};  ///< g, a measurement of which only peaks are known
  bool synthetic = false;      ///< the force record is made, not measured; said wherever it appears
  double load    = not_given;  ///< N, working load; absent: mean of the force record
  std::array<double, 2> synthetic_range = {not_given,
                                           not_given};  ///< N, without a file: white noise in this range
  double synthetic_duration             = 10;           ///< s
  double synthetic_bandwidth            = 1000;         ///< Hz
  int synthetic_seed                    = 1;
};

/// How one contact line is solved.
struct ContactSettings {
  std::array<double, 2> loads = {not_given, not_given};  ///< N (four-high), N/m (two-cylinders): swept range
  int samples                 = 24;                      ///< loads in the sweep, logarithmically spaced
  int elements_per_half_width = 8;          ///< quadratic elements per Hertz half width of the largest load
  double length               = not_given;  ///< m, two-cylinders: plane strain over this length
  double at                   = not_given;  ///< N/m, two-cylinders: load of the scalar results
  double tilt                 = not_given;  ///< rad, of the axes in the plane of the load, closing at z > 0
  double load_offset          = not_given;  ///< m, of the resultant from mid-length
  double cross_angle          = 0;          ///< rad, of the axes in the plane of contact
  double axis_offset          = 0;          ///< m, across the plane of the load
  double friction             = not_given;  ///< -, Coulomb; absent: frictionless
  double path_trim            = 0.1;        ///< -, share of the path left out at each end for the plateau
  Place loads_place, elements_place;        ///< for messages
};

/// How the roll bite is computed.
struct BiteSetup {
  std::string method   = "fe";         ///< fe | slab: what gives K4; slab theories stand beside finite elements
  std::string theory   = "karman";     ///< bland-ford | hu-ehmann | karman | orowan | sims
  std::string arc      = "hitchcock";  ///< rigid | hitchcock | elastic
  std::string strip    = "rigid-plastic";  ///< rigid-plastic | elastic-plastic, in the finite-element bite
  int elements_along   = 48;               ///< of the arc
  int elements_through = 12;               ///< of half the thickness
  int samples          = 9;                ///< along every curve of K4
  double path_trim     = 0.2;              ///< -, share of the contact path left out at each end for the plateau
};

/// Settings of the lumped model's runs.
struct DynamicsSettings {
  double modal_damping       = 0.01;           ///< -, ratio of critical, every mode
  std::string force_meaning  = "measured";     ///< measured | disturbance | published
  double output_rate         = 20e3;           ///< Hz
  std::string frame          = "open";         ///< open | closed
  std::string mass_reference = "mid";          ///< mid | mean: reference displacement of M2..M5
  std::string mass_source    = "closed-form";  ///< closed-form | fe: shapes behind M2..M5
  std::string model          = "six-mass";     ///< six-mass | beam | craig-bampton: what is driven
  double frequency_limit     = 1000;           ///< Hz, up to which the modes are to be right
  int elements_per_radius    = 3;              ///< of the rolls' meshes behind their modes
  Place force_meaning_place;
};

/// Values that replace computed ones, by name: M1..M6, K1..K7, Kzc1..Kzc4, Kzc1_across..Kzc4_across, C, K_Zy,
/// K_ZW. A tolerance given beside a value is its error estimate.
struct GivenValue {
  Parameter parameter;
  Place place;
};
using GivenValues = std::map<std::string, GivenValue>;

/// kind = "four-high"
struct FourHigh {
  Material steel;
  Roll work_roll, backup_roll;
  std::vector<RollerBearing> bearings;
  std::vector<OilFilmBearing> oil_films;
  Frame frame;
  MillHousing housing;
  Screwdown screwdown;
  Strip strip;
  std::vector<Pass> passes;
  ContactSettings upper_contact, lower_contact;  ///< upper: K3, lower: K5
  BiteSetup bite;
  DynamicsSettings dynamics;
  StandSpan span;            ///< strip before and behind the stand, for chatter
  ChatterAnalysis analysis;  ///< of chatter
  GivenValues given;
  GivenValues published;  ///< same names; only shown beside the computed values
};

/// kind = "lumped": starts at the lumped model.
struct Lumped {
  GivenValues given;
  std::vector<Pass> passes;
  DynamicsSettings dynamics;
};

/// kind = "two-cylinders": two long solid cylinders, plane strain.
struct TwoCylinders {
  Material steel;
  double upper_diameter = 0;  ///< m
  double lower_diameter = 0;  ///< m
  ContactSettings contact;
};

/// [load] of kind = "bearing".
struct BearingLoad {
  std::string bearing;                                    ///< name of a [bearing.*]
  double radial                = 0;                       ///< N, towards the support of the chock
  double axial                 = 0;                       ///< N, on the inner ring; 0: it keeps its axial place
  double tilt                  = 0;                       ///< rad, of the inner ring in the plane of the load
  std::array<double, 2> loads  = {not_given, not_given};  ///< N, swept range of the radial load
  int samples                  = 20;
  double cage_angle            = 0;          ///< rad
  double tilt_across           = 0;          ///< rad, oil film: of the sleeve across the plane of the load
  double speed                 = not_given;  ///< Hz, oil film: of the sleeve
  std::array<double, 2> speeds = {not_given, not_given};  ///< Hz, oil film: swept range
};

/// [dynamics] of kind = "bearing": a mass on the bearing's curve.
struct BearingExcitation {
  double mass        = not_given;  ///< kg; absent: nothing is driven
  double damping     = 0;          ///< N s/m
  double amplitude   = 0;          ///< N, of the harmonic force
  double frequency   = 100;        ///< Hz
  double direction   = 0;          ///< rad, from the line of the load
  double duration    = 0.5;        ///< s
  double output_rate = 20e3;       ///< Hz
};

/// kind = "bearing": one roller bearing in its chock, or one oil-film bearing.
struct BearingCase {
  std::vector<RollerBearing> bearings;
  std::vector<OilFilmBearing> oil_films;
  BearingLoad load;
  BearingExcitation motion;
  GivenValues published;  ///< only shown beside the computed values
};

/// kind = "bite": the strip between two work rolls, nothing of the stand.
struct BiteCase {
  Material steel;            ///< of the rolls
  double roll_diameter = 0;  ///< m, work roll
  Strip strip;
  std::vector<Pass> passes;  ///< load: a measured force to stand beside the computed one
  BiteSetup bite;
  GivenValues published;  ///< only shown beside the computed values
};

/// A case file, read and checked.  SI inside.
struct Case {
  std::string path;  ///< of the file as given by the user
  std::string name;  ///< stem of the file name
  std::string kind;  ///< four-high | lumped | two-cylinders | bearing | bite | chatter
  std::string title;
  std::variant<FourHigh, Lumped, TwoCylinders, BearingCase, BiteCase, ChatterCase> spec;
  std::string resolved;  ///< text of resolved.toml
  std::map<std::string, Place>
      places;  ///< "work_roll.barrel_diameter" -> where its value stands; defaults are absent
};

/// Bearing by name; the reader has checked that it exists.
const RollerBearing &bearing_of(const std::vector<RollerBearing> &bearings, const std::string &name);

/// The oil-film bearing of this name; nullptr when there is none.
const OilFilmBearing *oil_film_of(const std::vector<OilFilmBearing> &bearings, const std::string &name);

/// Reads, checks and converts a case.  `sets` are overrides "section.key=value" that go through the same rows.
/// @throws InputError with every problem of the case in one go, sorted by place
Case read_case(const std::string &path, const std::vector<std::string> &sets = {});
}  // namespace mill
