#pragma once
#include "core/base/each_member.h"
#include "core/base/warning.h"
#include "core/model/material.h"
#include <array>
#include <string>
#include <vector>

// Forces of a pass schedule with what was fitted to them: curves/schedule.json.  bite/ and app/ fill the record,
// report/ draws it.  A number that is not known is NaN, a text that says nothing empty.  theory.md 39
namespace mill {
/// In the folder of a run.
constexpr const char *schedule_file = "curves/schedule.json";
/// Second part of the names of results that belong to all passes: "cluster.schedule.hardening_exponent".
constexpr const char *schedule_subject = "schedule";

/// The flow stress that returns the force of a pass on one arc.
struct PassFit {
  double flow_stress   = not_given;  ///< Pa, plane strain; fitted
  double radius        = not_given;  ///< m, of the arc
  double mean_pressure = not_given;  ///< Pa, force over projected contact
  double neutral_point = not_given;  ///< -, over the arc
  double peak_pressure = not_given;  ///< Pa
  std::string refused;               ///< why there is none
};

/// The pass at the fitted stress by one theory.
struct TheoryForce {
  std::string key;            ///< "karman-elastic-arc"
  std::string name;           ///< in words
  double force  = not_given;  ///< N
  double torque = not_given;  ///< N m, of one roll
  double radius = not_given;  ///< m, of the arc, or of the circle through a free one
  double peak   = not_given;  ///< Pa
  std::string refused;
};

/// One pass.
struct PassForce {
  std::string name;
  double entry_thickness         = not_given;               ///< m
  double exit_thickness          = not_given;               ///< m
  double entry_tension           = not_given;               ///< Pa
  double exit_tension            = not_given;               ///< Pa
  double speed                   = not_given;               ///< m/s
  double strain                  = not_given;               ///< -, ln(h0/h_out)
  double friction                = not_given;               ///< -, by its law, or mean of the factors
  double given                   = not_given;               ///< N, load of the pass
  double published               = not_given;               ///< N
  std::array<double, 2> measured = {not_given, not_given};  ///< N, range
  double fitted_to               = not_given;               ///< N, force of the fits
  std::string fitted_to_what;                               ///< "load of the pass"
  bool in_common_fit = true;            ///< else a blind test of what all passes have in common
  PassFit rigid, flat;                  ///< on the roll's own radius, on Hitchcock's
  double radius_beyond    = not_given;  ///< m, R' at the force by the power beyond Hitchcock's range
  double factor_exact     = not_given;  ///< -, friction factor of Hu and Ehmann with the same force; fitted
  double factor_published = not_given;  ///< -, by the form as published; fitted
  double factor_of_mean   = not_given;  ///< -, 2 mu p/k
  double law_stress       = not_given;  ///< Pa, of the case's own flow stress law at the exit
  double law_force        = not_given;  ///< N, by that law on Hitchcock's arc
  std::string law_refused;
  double power      = not_given;  ///< W, of homogeneous deformation, both rolls
  double roll_force = not_given;  ///< N, of that power at the surface of one roll
  double torque     = not_given;  ///< N m, of that power, one roll
  std::vector<TheoryForce> theories;
};

/// What one hardening law for all passes gives back for one of them.
struct LawPass {
  double flow_stress = not_given;  ///< Pa
  double force       = not_given;  ///< N
  double friction    = not_given;  ///< -, that would return the force of the fit with this stress
  double blind_force = not_given;  ///< N, by a law fitted to all other passes of the fit
  std::string refused;             ///< why a number is missing
};

/// k/2 = Y ln(h0/h_out)^n fitted to the stresses of several passes.
struct ScheduleLaw {
  bool flattened     = false;
  double Y           = not_given;  ///< Pa
  double n           = not_given;  ///< -
  double Y_deviation = not_given;  ///< -, of ln Y
  double n_deviation = not_given;  ///< -
  int unknowns = 2, data = 0;
  std::vector<LawPass> passes;
};

/// Dynamic force of one pass.
struct DynamicForce {
  std::string name;
  double printed          = not_given;  ///< N
  double per_displacement = not_given;  ///< N/m
  double displacement     = not_given;  ///< m, of the printed force; fitted
  double constant         = not_given;  ///< m2/s, G that returns the printed force; fitted
  double with_common      = not_given;  ///< N, by the common constant
  double common_error     = not_given;  ///< -, over the printed force, less one
  bool in_fit             = false;      ///< its printed force is one that the common constant was made from
};

/// Dynamic forces of a schedule with one constant.
struct DynamicForces {
  bool flattened = false;
  double common  = not_given;  ///< m2/s, geometric mean of the constants in the fit
  int data       = 0;          ///< forces that it was made from; the unknown is one
  std::vector<DynamicForce> passes;
};

struct ScheduleRecord {
  std::vector<PassForce> passes;
  std::vector<ScheduleLaw> laws;
  std::vector<DynamicForces> dynamics;
  std::vector<Warning> notes;  ///< what could not be fitted
};

template <class Io, class R, if_record<R, PassFit> = 0> void each_member(Io &&io, R &record)
{
  auto &[flow_stress, radius, mean_pressure, neutral_point, peak_pressure, refused] = record;
  io("flow_stress", flow_stress);
  io("radius", radius);
  io("mean_pressure", mean_pressure);
  io("neutral_point", neutral_point);
  io("peak_pressure", peak_pressure);
  io("refused", refused);
}

template <class Io, class R, if_record<R, TheoryForce> = 0> void each_member(Io &&io, R &record)
{
  auto &[key, name, force, torque, radius, peak, refused] = record;
  io("key", key);
  io("name", name);
  io("force", force);
  io("torque", torque);
  io("radius", radius);
  io("peak", peak);
  io("refused", refused);
}

template <class Io, class R, if_record<R, PassForce> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, entry_thickness, exit_thickness, entry_tension, exit_tension, speed, strain, friction, given,
         published, measured, fitted_to, fitted_to_what, in_common_fit, rigid, flat, radius_beyond, factor_exact,
         factor_published, factor_of_mean, law_stress, law_force, law_refused, power, roll_force, torque,
         theories] = record;
  io("name", name);
  io("entry_thickness", entry_thickness);
  io("exit_thickness", exit_thickness);
  io("entry_tension", entry_tension);
  io("exit_tension", exit_tension);
  io("speed", speed);
  io("strain", strain);
  io("friction", friction);
  io("given", given);
  io("published", published);
  io("measured", measured);
  io("fitted_to", fitted_to);
  io("fitted_to_what", fitted_to_what);
  io("in_common_fit", in_common_fit);
  io("rigid", rigid);
  io("flat", flat);
  io("radius_beyond", radius_beyond);
  io("factor_exact", factor_exact);
  io("factor_published", factor_published);
  io("factor_of_mean", factor_of_mean);
  io("law_stress", law_stress);
  io("law_force", law_force);
  io("law_refused", law_refused);
  io("power", power);
  io("roll_force", roll_force);
  io("torque", torque);
  io("theories", theories);
}

template <class Io, class R, if_record<R, LawPass> = 0> void each_member(Io &&io, R &record)
{
  auto &[flow_stress, force, friction, blind_force, refused] = record;
  io("flow_stress", flow_stress);
  io("force", force);
  io("friction", friction);
  io("blind_force", blind_force);
  io("refused", refused);
}

template <class Io, class R, if_record<R, ScheduleLaw> = 0> void each_member(Io &&io, R &record)
{
  auto &[flattened, Y, n, Y_deviation, n_deviation, unknowns, data, passes] = record;
  io("flattened", flattened);
  io("Y", Y);
  io("n", n);
  io("Y_deviation", Y_deviation);
  io("n_deviation", n_deviation);
  io("unknowns", unknowns);
  io("data", data);
  io("passes", passes);
}

template <class Io, class R, if_record<R, DynamicForce> = 0> void each_member(Io &&io, R &record)
{
  auto &[name, printed, per_displacement, displacement, constant, with_common, common_error, in_fit] = record;
  io("name", name);
  io("printed", printed);
  io("per_displacement", per_displacement);
  io("displacement", displacement);
  io("constant", constant);
  io("with_common", with_common);
  io("common_error", common_error);
  io("in_fit", in_fit);
}

template <class Io, class R, if_record<R, DynamicForces> = 0> void each_member(Io &&io, R &record)
{
  auto &[flattened, common, data, passes] = record;
  io("flattened", flattened);
  io("common", common);
  io("data", data);
  io("passes", passes);
}

template <class Io, class R, if_record<R, ScheduleRecord> = 0> void each_member(Io &&io, R &record)
{
  auto &[passes, laws, dynamics, notes] = record;
  io("passes", passes);
  io("laws", laws);
  io("dynamics", dynamics);
  io("notes", notes);
}
}  // namespace mill
