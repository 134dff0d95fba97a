#pragma once
#include "core/model/material.h"
#include "core/model/ring_sections.h"
#include "core/model/roller_bearing.h"
#include "core/model/roller_setup.h"
#include "core/model/stand.h"
#include "core/model/strip.h"
#include "core/records/mesh_file.h"

// The members of the records that computations are made from, each list once.  A structured binding takes apart
// the whole struct: a member that is added to it and not named here does not compile.  What a list leaves out
// although it is named is no part of any answer; the line above says why.
namespace mill {
/// What of a material a body at rest has; for keys of static stages.
struct ElasticConstants {
  double youngs_modulus = 0;  ///< Pa
  double poisson_ratio  = 0;  ///< -
};

inline ElasticConstants at_rest(const Material &material)
{
  return {material.youngs_modulus, material.poisson_ratio};
}

template <class Io> void each_member(Io &&io, const ElasticConstants &record)
{
  const auto &[youngs_modulus, poisson_ratio] = record;
  io("youngs_modulus", youngs_modulus);
  io("poisson_ratio", poisson_ratio);
}

// The yield stress is compared with pressures after they are computed.
template <class Io> void each_member(Io &&io, const Material &record)
{
  const auto &[youngs_modulus, poisson_ratio, density, yield_stress] = record;
  io("youngs_modulus", youngs_modulus);
  io("poisson_ratio", poisson_ratio);
  io("density", density);
}

// The constants of the laws are listed with them (core/laws).
template <class Io> void each_member(Io &&io, const FlowStress &record)
{
  io("law", name_of(record.law));
  for (const FlowStressConstant &constant : flow_stress_constants())
    io(constant.key, record.*constant.member);
  io("table", record.table);
}

template <class Io> void each_member(Io &&io, const Friction &record)
{
  io("law", name_of(record.law));
  for (const FrictionConstant &constant : friction_constants())
    io(constant.key, record.*constant.member);
}

template <class Io> void each_member(Io &&io, const Strip &record)
{
  const auto &[width, entry_thickness, exit_thickness, entry_tension, exit_tension, initial_thickness,
               youngs_modulus, poisson_ratio, flow_stress, friction] = record;
  io("width", width);
  io("entry_thickness", entry_thickness);
  io("exit_thickness", exit_thickness);
  io("entry_tension", entry_tension);
  io("exit_tension", exit_tension);
  io("initial_thickness", initial_thickness);
  io("youngs_modulus", youngs_modulus);
  io("poisson_ratio", poisson_ratio);
  io("flow_stress", flow_stress);
  io("friction", friction);
}

template <class Io> void each_member(Io &&io, const RollGeometry &record)
{
  const auto &[radius, half_length, neck_radius, neck_length, seat_centre, contact_half_length] = record;
  io("radius", radius);
  io("half_length", half_length);
  io("neck_radius", neck_radius);
  io("neck_length", neck_length);
  io("seat_centre", seat_centre);
  io("contact_half_length", contact_half_length);
}

template <class Io> void each_member(Io &&io, const RollerSetup &record)
{
  const auto &[diameter, length, contact_length, inner_radius, outer_radius, inner_depth, outer_depth, land,
               material, largest_load, finest_load, elements_per_half_width, end_element, largest_element] =
      record;
  io("diameter", diameter);
  io("length", length);
  io("contact_length", contact_length);
  io("inner_radius", inner_radius);
  io("outer_radius", outer_radius);
  io("inner_depth", inner_depth);
  io("outer_depth", outer_depth);
  io("land", land);
  io("material", at_rest(material));
  io("largest_load", largest_load);
  io("finest_load", finest_load);
  io("elements_per_half_width", elements_per_half_width);
  io("end_element", end_element);
  io("largest_element", largest_element);
}

template <class Io> void each_member(Io &&io, const RacewayLine &record)
{
  const auto &[middle, normal, along, hand] = record;
  io("middle", middle);
  io("normal", normal);
  io("along", along);
  io("hand", hand);
}

template <class Io> void each_member(Io &&io, const RingSection &record)
{
  const auto &[inner, raceways, length, land, seat_radius, half_width, depth] = record;
  io("inner", inner);
  io("raceways", raceways);
  io("length", length);
  io("land", land);
  io("seat_radius", seat_radius);
  io("half_width", half_width);
  io("depth", depth);
}

template <class Io> void each_member(Io &&io, const Housing &record)
{
  const auto &[kind, radius, half_length, width, height, support_width, support_gap] = record;
  io("kind", kind);
  io("radius", radius);
  io("half_length", half_length);
  io("width", width);
  io("height", height);
  io("support_width", support_width);
  io("support_gap", support_gap);
}

template <class Io> void each_member(Io &&io, const RingSections &record)
{
  const auto &[cone, cup, housing, material] = record;
  io("cone", cone);
  io("cup", cup);
  io("housing", housing);
  io("material", at_rest(material));
}

// Modulus and density as given are in `steel`, completed.
template <class Io> void each_member(Io &&io, const MillHousing &record)
{
  const auto &[thickness, post_width, window_width, window_height, upper_beam_height, lower_beam_height,
               fillet_radius, foot_height, screw_pad, seat_pad, modulus, density, steel] = record;
  io("thickness", thickness);
  io("post_width", post_width);
  io("window_width", window_width);
  io("window_height", window_height);
  io("upper_beam_height", upper_beam_height);
  io("lower_beam_height", lower_beam_height);
  io("fillet_radius", fillet_radius);
  io("foot_height", foot_height);
  io("screw_pad", screw_pad);
  io("seat_pad", seat_pad);
  io("steel", steel);
}

// A bearing with all that its equilibrium follows.  Type is said again by the angles; name and what was filled in
// are for messages; catalogue and ratings are read off the state afterwards.
template <class Io> void each_member(Io &&io, const RollerBearing &record)
{
  const auto &[name, type, bore, outside_diameter, width, pitch_diameter, rows, rollers_per_row, roller_length,
               roller_total_length, roller_diameter, roller_cone_angle, cup_angle, rib_angle, row_hands,
               row_hands_assumed, radial_clearance, end_play, preload, profile, crown_drop, profile_load,
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
  io("row_hands", row_hands);
  io("row_hands_assumed", row_hands_assumed);
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

// A roll as its contact sees it: what hangs on its necks and how the chain takes its bending is no part of it.
template <class Io> void each_member(Io &&io, const Roll &record)
{
  const auto &[barrel_diameter, barrel_length, neck_diameter, neck_length, bearing_span, crown, crown_table,
               crown_polynomial, thermal_crown, thermal_crown_table, end_chamfer_length, end_chamfer_depth,
               axial_shift, bending_force, bending_model, bearing, bearing_mass, chock_mass_upper,
               chock_mass_lower, bearing_load] = record;
  io("barrel_diameter", barrel_diameter);
  io("barrel_length", barrel_length);
  io("neck_diameter", neck_diameter);
  io("neck_length", neck_length);
  io("bearing_span", bearing_span);
  io("crown", crown);
  io("crown_table", crown_table);
  io("crown_polynomial", crown_polynomial);
  io("thermal_crown", thermal_crown);
  io("thermal_crown_table", thermal_crown_table);
  io("end_chamfer_length", end_chamfer_length);
  io("end_chamfer_depth", end_chamfer_depth);
  io("axial_shift", axial_shift);
  io("bending_force", bending_force);
}

// The two places are for messages.
template <class Io> void each_member(Io &&io, const ContactSettings &record)
{
  const auto &[loads, samples, elements_per_half_width, length, at, tilt, load_offset, cross_angle, axis_offset,
               friction, path_trim, loads_place, elements_place] = record;
  io("loads", loads);
  io("samples", samples);
  io("elements_per_half_width", elements_per_half_width);
  io("length", length);
  io("at", at);
  io("tilt", tilt);
  io("load_offset", load_offset);
  io("cross_angle", cross_angle);
  io("axis_offset", axis_offset);
  io("friction", friction);
  io("path_trim", path_trim);
}

/// Of the settings of a bite what its finite elements follow.  Method and theory say who else is asked, samples
/// and path_trim how the answer is shown.
struct FlowSettings {
  std::string arc, strip;
  int elements_along = 0, elements_through = 0;
};

inline FlowSettings flow_settings(const BiteSetup &setup)
{
  const auto &[method, theory, arc, strip, elements_along, elements_through, samples, path_trim] = setup;
  return {arc, strip, elements_along, elements_through};
}

template <class Io> void each_member(Io &&io, const FlowSettings &record)
{
  const auto &[arc, strip, elements_along, elements_through] = record;
  io("arc", arc);
  io("strip", strip);
  io("elements_along", elements_along);
  io("elements_through", elements_through);
}
}  // namespace mill
