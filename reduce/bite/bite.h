#pragma once
#include "core/base/each_member.h"
#include "core/base/warning.h"
#include "core/model/material.h"
#include "core/model/strip.h"
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

// What every model of the roll bite is given and what it returns, slab or finite element.
namespace mill::bite {
/// One pair of work rolls and the strip between them.
/// x runs from the line of roll centres towards the entry; the strip moves towards -x.  theory.md 8
struct RollBite {
  Strip strip;
  double roll_radius = 0;         ///< m, work roll before it is flattened
  Material roll;                  ///< for the flattening
  double roll_speed = not_given;  ///< m/s, of the roll's surface; needed by the laws that know a speed
  double gap_rate   = 0;  ///< m/s, opening of the gap on the line of centres; for those that know a moving gap
};

/// How the roll's surface is shaped by the pressure.
enum class Arc {
  rigid,      ///< circle of the roll's own radius
  hitchcock,  ///< circle of a larger radius, (8.9)
  elastic     ///< any shape: flexibility of the surface, with elastic zones of the strip
};

/// Inputs by which a model can be differentiated.
enum class Input {
  entry_thickness,  ///< per m
  exit_thickness,   ///< per m; of the gap on the line of centres
  entry_tension,    ///< per Pa
  exit_tension,     ///< per Pa
  friction,         ///< per unit of mu; of both factors where the law is one of factors
  flow_stress,      ///< per unit of a factor on k_f
  arc_radius,       ///< per m, of the radius of the arc, R' where it is flattened
  roll_speed,       ///< per m/s
  gap_rate          ///< per m/s
};
constexpr int n_inputs = 9;
/// Derivatives by Input, in its order; nan where the model does not know the input.
using Gradient = std::array<double, n_inputs>;
inline double by(const Gradient &gradient, const Input input)
{
  return gradient[static_cast<int>(input)];
}

/// The bite as one model sees it.
struct BiteState {
  std::string model;                  ///< "Karman slab, Hitchcock's arc": as it is called in the report
  double force          = 0;          ///< N, over the strip width, pushes the rolls apart
  double torque         = 0;          ///< N m, of one roll, over the strip width, positive where the roll drives
  double friction       = 0;          ///< -, Coulomb coefficient, or mean of the factors
  double film_thickness = not_given;  ///< m, film law only
  double flattened_radius =
      0;  ///< m, R'; of the circle through entry, exit and thinnest point where the arc is none
  double arc_length     = 0;  ///< m, from the line of centres to the entry
  double exit_position  = 0;  ///< m, where the arc ends; negative behind the line of centres
  double contact_length = 0;  ///< m, of the whole contact where elastic zones make it longer than the arc; else 0
  double bite_angle     = 0;  ///< rad, arc length / flattened radius
  double neutral_position  = 0;  ///< m; of several (a zone without slip) the middle
  double neutral_thickness = 0;  ///< m
  double sticking_length   = 0;  ///< m, of the arc on which the friction stress is at its limit or slip is zero
  double entry_speed       = not_given;  ///< m/s, of the strip; nan without a roll speed
  double exit_speed        = not_given;  ///< m/s
  double forward_slip      = 0;          ///< -, exit speed / roll speed - 1
  double peak_pressure     = 0;          ///< Pa
  double entry_flow_stress = 0;          ///< Pa, plane strain
  double exit_flow_stress  = 0;          ///< Pa
  double largest_shear     = 0;  ///< -, largest mu p over shear yield stress before any limit; above one: sticking
  int iterations           = 0;  ///< of the flattening
  Gradient force_by{};           ///< N per unit of the input, shape of the arc held
  Gradient torque_by{};          ///< N m per unit of the input, shape of the arc held
  double force_by_exit_following = not_given;  ///< N/m, dF/dh_exit with the arc following the force
  Eigen::VectorXd position;                    ///< (n) m, rising, from exit to entry
  Eigen::VectorXd thickness;                   ///< (n) m
  Eigen::VectorXd pressure;                    ///< (n) Pa
  Eigen::VectorXd shear;             ///< (n) Pa, on the strip, positive towards the exit (roll faster than strip)
  Eigen::VectorXd slip;              ///< (n) -, strip speed / roll speed - 1 along the arc
  std::vector<Warning> notes;        ///< where the model leaves its range, without subject
  std::vector<std::string> remarks;  ///< what happens in the bite, within the range of the model
};

template <class Io, class R, if_record<R, BiteState> = 0> void each_member(Io &&io, R &record)
{
  auto &[model, force, torque, friction, film_thickness, flattened_radius, arc_length, exit_position,
         contact_length, bite_angle, neutral_position, neutral_thickness, sticking_length, entry_speed, exit_speed,
         forward_slip, peak_pressure, entry_flow_stress, exit_flow_stress, largest_shear, iterations, force_by,
         torque_by, force_by_exit_following, position, thickness, pressure, shear, slip, notes, remarks] = record;
  io("model", model);
  io("force", force);
  io("torque", torque);
  io("friction", friction);
  io("film_thickness", film_thickness);
  io("flattened_radius", flattened_radius);
  io("arc_length", arc_length);
  io("exit_position", exit_position);
  io("contact_length", contact_length);
  io("bite_angle", bite_angle);
  io("neutral_position", neutral_position);
  io("neutral_thickness", neutral_thickness);
  io("sticking_length", sticking_length);
  io("entry_speed", entry_speed);
  io("exit_speed", exit_speed);
  io("forward_slip", forward_slip);
  io("peak_pressure", peak_pressure);
  io("entry_flow_stress", entry_flow_stress);
  io("exit_flow_stress", exit_flow_stress);
  io("largest_shear", largest_shear);
  io("iterations", iterations);
  io("force_by", force_by);
  io("torque_by", torque_by);
  io("force_by_exit_following", force_by_exit_following);
  io("position", position);
  io("thickness", thickness);
  io("pressure", pressure);
  io("shear", shear);
  io("slip", slip);
  io("notes", notes);
  io("remarks", remarks);
}

/// Four stiffnesses that all go by the name K4, N/m over the strip width.  theory.md 8.5
struct BiteStiffness {
  double plastic_slope           = 0;          ///< -dF/dh_exit at fixed entry thickness and fixed arc, (8.10)
  double plastic_slope_following = not_given;  ///< the same with the arc following the force, (8.11)
  double flattening              = 0;          ///< elastic flattening of one roll on the strip, (8.12)
  double combined                = 0;          ///< plastic slope (arc fixed) in series with both rolls, (8.13)
};

/// Elastic flexibility of the surface of a roll around the line of centres, plane strain.
/// Radial displacement towards the roll's axis of n points, from pressures that vary linearly between them.
struct ArcFlexibility {
  Eigen::VectorXd position;  ///< (n) m, rising
  Eigen::MatrixXd
      influence;       ///< (n, n) m/Pa, displacement at i by unit pressure at j; relative to the axis of the roll
  std::string method;  ///< "half plane", "finite elements of the roll's section, 21000 unknowns"
};

template <class Io, class R, if_record<R, ArcFlexibility> = 0> void each_member(Io &&io, R &record)
{
  auto &[position, influence, method] = record;
  io("position", position);
  io("influence", influence);
  io("method", method);
}
}  // namespace mill::bite
