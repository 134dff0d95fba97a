#pragma once
#include "core/base/choice.h"
#include "core/model/material.h"
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace mill {
enum class BearingType { four_row_tapered, four_row_cylindrical, oil_film };
constexpr auto words_of(BearingType)
{
  return choice_words<BearingType>("four-row tapered", "four-row cylindrical", "oil-film");
}
enum class RollerProfile { none, iso, log, lundberg, three_parameter, crown, table };
constexpr auto words_of(RollerProfile)
{
  return choice_words<RollerProfile>("none", "iso", "log", "lundberg", "three-parameter", "crown", "table");
}
enum class OneRollerLaw { fe, iso, palmgren, elastic };
constexpr auto words_of(OneRollerLaw)
{
  return choice_words<OneRollerLaw>("fe", "iso", "palmgren", "elastic");
}
enum class RingBodies { elastic, rigid };
constexpr auto words_of(RingBodies)
{
  return choice_words<RingBodies>("elastic", "rigid");
}
/// What holds the cup when the rings are elastic.
enum class ChockForm { block, round, rigid };
constexpr auto words_of(ChockForm)
{
  return choice_words<ChockForm>("block", "round", "rigid");
}
/// Test that the flow stress of a raceway comes from.
enum class RacewayTest { uniaxial, plane_strain };
constexpr auto words_of(RacewayTest)
{
  return choice_words<RacewayTest>("uniaxial", "plane-strain");
}

/// One set of rollers that gives the published ratings of a bearing.  theory.md 5.9
struct RollerCandidate {
  int rollers_per_row    = 0;
  double roller_diameter = 0;  ///< m
  double roller_length   = 0;  ///< m, effective
  double cup_angle       = 0;  ///< rad
  double filling         = 0;  ///< -, of the pitch circle by the rollers' diameters
  double stiffness       = 0;  ///< -, radial stiffness over that of the first candidate, (5.30)
};

/// Roller bearing from what a catalogue gives, and the chock it sits in.  Radial bearings have both angles zero.
struct RollerBearing {
  std::string name;                        ///< the * of [bearing.*]
  std::optional<BearingType> type;         ///< absent: a catalogue that does not say it
  double bore                = not_given;  ///< m
  double outside_diameter    = not_given;  ///< m
  double width               = not_given;  ///< m
  double pitch_diameter      = not_given;  ///< m, at mid-roller; absent: mean of bore and outside diameter
  int rows                   = 4;
  int rollers_per_row        = 0;
  double roller_length       = 0;          ///< m, effective
  double roller_total_length = not_given;  ///< m; absent: the effective length
  double roller_diameter     = not_given;  ///< m, mean; absent: from the apex condition, where it can be
  double roller_cone_angle   = 0;          ///< rad, included
  double cup_angle           = 0;          ///< rad, contact angle on the outer ring
  double rib_angle           = not_given;  ///< rad, of the rib's normal; absent: along the roller's axis
  std::string arrangement =
      "+-+-";  ///< key `arrangement`: axial direction in which each row carries, repeated over the rows
  bool arrangement_assumed = false;      ///< the case does not say how the rows of a tapered bearing are arranged
  double radial_clearance  = 0;          ///< m, diametral
  double end_play          = not_given;  ///< m, axial; replaces radial_clearance
  double preload           = not_given;  ///< N, axial, of each row; replaces radial_clearance
  RollerProfile profile    = RollerProfile::none;
  double crown_drop        = not_given;  ///< m, drop of the roller end: crown, three-parameter
  double profile_load      = not_given;  ///< N, on one roller, for which log, lundberg, three-parameter are ground
  double profile_share     = 1;          ///< -, three-parameter: crowned part of the length
  std::vector<std::array<double, 2>> profile_table;  ///< m, (x from mid-roller, drop of one contact)
  double youngs_modulus      = 206e9;  ///< Pa, bearing steel: rollers, rings, and with them neck and chock
  double poisson_ratio       = 0.3;    ///< -
  double yield_pressure      = 4e9;    ///< Pa, contact pressure that a raceway bears without a dent
  OneRollerLaw roller_law    = OneRollerLaw::iso;
  RingBodies rings           = RingBodies::rigid;
  int slices                 = 41;  ///< per roller
  ChockForm chock            = ChockForm::block;
  double chock_width         = not_given;  ///< m, across the load
  double chock_height        = not_given;  ///< m, along the load
  double chock_length        = not_given;  ///< m, along the axis
  double chock_support_width = not_given;  ///< m, of the face that carries the chock, centred on the load line
  double chock_support_gap   = not_given;  ///< m, its middle part, which carries nothing: two feet; absent: none
  bool chock_assumed =
      false;  ///< the case does not say what holds the cup, and gives no size of it: a block is assumed
  bool support_assumed = false;     ///< the case does not say where the block is supported
  std::vector<std::string> filled;  ///< sentences about what was not given and has been filled in

  // What a catalogue says, and what life and limits are rated with: no equilibrium knows of these.
  std::string designation;                ///< of the catalogue; empty: the case draws the bearing itself
  std::string catalogue;                  ///< the user's own file, searched first
  std::string catalogue_source;           ///< where the catalogue has its figures from
  double dynamic_rating     = not_given;  ///< N, C as published; absent: from the rollers
  double static_rating      = not_given;  ///< N, C_0
  double viscosity_ratio    = not_given;  ///< -, kappa of ISO 281
  double contamination      = not_given;  ///< -, e_C of ISO 281
  double raceway_flow       = not_given;  ///< Pa, flow stress of the raceway
  RacewayTest raceway_state = RacewayTest::uniaxial;  ///< of raceway_flow
  std::vector<std::string> estimated;                 ///< keys that stand for what the catalogue does not give
  std::vector<RollerCandidate> candidates;  ///< rollers that give the published ratings; chosen one first
};

/// m, at mid-roller: the given one, else the mean of bore and outside diameter (NaN without these).
double pitch_diameter(const RollerBearing &bearing);

/// rad, cup angle at which the apex condition of a tapered bearing closes; NaN for a cylindrical one, without
/// roller or pitch diameter, and where none closes.
double closing_cup_angle(const RollerBearing &bearing);

/// Whether the stiffness of the bearing includes its chock: then no other spring may include it.
bool counts_its_chock(const RollerBearing &bearing);

/// Arrangements of the rows in use: for two rows +- and -+, for four -+-+, +-+-, ++-- and --++, for another number
/// these, repeated or cut; one row has none.
std::vector<std::string> usual_arrangements(int rows);

/// "+-+-, pairs of rows back to back (TQI)": hands cut or repeated to the rows, with the name of the arrangement.
std::string arrangement_name(const std::string &arrangement, int rows);

// A bearing with all that its equilibrium follows.  Type follows from the angles; name and the values that were
// filled in are for messages; catalogue and ratings are read off the state afterwards.
template <class Io> void each_member(Io &&io, const RollerBearing &record)
{
  const auto &[name, type, bore, outside_diameter, width, pitch_diameter, rows, rollers_per_row, roller_length,
               roller_total_length, roller_diameter, roller_cone_angle, cup_angle, rib_angle, arrangement,
               arrangement_assumed, radial_clearance, end_play, preload, profile, crown_drop, profile_load,
               profile_share, profile_table, youngs_modulus, poisson_ratio, yield_pressure, roller_law, rings,
               slices, chock, chock_width, chock_height, chock_length, chock_support_width, chock_support_gap,
               chock_assumed, support_assumed, filled, designation, catalogue, catalogue_source, dynamic_rating,
               static_rating, viscosity_ratio, contamination, raceway_flow, raceway_state, estimated, candidates] =
      record;
  io("bore", bore);
  io("outside_diameter", outside_diameter);
  io("width", width);
  io("pitch_diameter", pitch_diameter);
  io("rows", rows);
  io("rollers_per_row", rollers_per_row);
  io("roller_length", roller_length);
  io("roller_total_length", roller_total_length);
  io("roller_diameter", roller_diameter);
  io("roller_cone_angle", roller_cone_angle);
  io("cup_angle", cup_angle);
  io("rib_angle", rib_angle);
  io("arrangement", arrangement);
  io("arrangement_assumed", arrangement_assumed);
  io("radial_clearance", radial_clearance);
  io("end_play", end_play);
  io("preload", preload);
  io("profile", profile);
  io("crown_drop", crown_drop);
  io("profile_load", profile_load);
  io("profile_share", profile_share);
  io("profile_table", profile_table);
  io("youngs_modulus", youngs_modulus);
  io("poisson_ratio", poisson_ratio);
  io("yield_pressure", yield_pressure);
  io("roller_law", roller_law);
  io("rings", rings);
  io("slices", slices);
  io("chock", chock);
  io("chock_width", chock_width);
  io("chock_height", chock_height);
  io("chock_length", chock_length);
  io("chock_support_width", chock_support_width);
  io("chock_support_gap", chock_support_gap);
  io("chock_assumed", chock_assumed);
  io("support_assumed", support_assumed);
}
}  // namespace mill
