#pragma once
#include "core/base/each_member.h"
#include "core/records/strip_lines.h"
#include "reduce/bite/bite.h"
#include <Eigen/Core>
#include <string>
#include <vector>

// What both finite-element solvers of the rolled strip return.  theory.md 18, 19
namespace mill::fem {
/// One accepted step of the continuation.
struct StripFlowLevel {
  std::string stage;              ///< "Picard", "Newton, fixed surface", "Newton, free surface"
  int n_unknowns            = 0;  ///< of its grid
  double cutoff_strain_rate = 0;  ///< -, g0 over the mean rate of shear
  double cutoff_slip        = 0;  ///< -, d0 over the roll's speed
  double flexibility        = 0;  ///< -, share of the roll's flattening
  int iterations            = 0;
  double residual           = 0;  ///< -, scaled, at the end of the level
  double force              = 0;  ///< N
};

/// How a solution was come to.
struct StripCourse {
  std::vector<StripFlowLevel> levels;
  double work = 0;  ///< unknowns times factorisations, of levels that failed as well
  /// Notes one factorisation.  @throws SolverError  more work than the limit
  void spend(int n_unknowns, double limit);
};

/// What must close if the solution is one, each over its reference.  theory.md 18.6
struct StripFlowBalance {
  double flux    = 0;  ///< -, (flux out - flux in) / flux in
  double force_x = 0;  ///< -, horizontal forces on the strip over k h1
  double power   = 0;  ///< -, (power brought in - power dissipated) / power dissipated
};

template <class Io, class R, if_record<R, StripFlowBalance> = 0> void each_member(Io &&io, R &record)
{
  auto &[flux, force_x, power] = record;
  io("flux", flux);
  io("force_x", force_x);
  io("power", power);
}

/// State of the strip and its rolls.  Fields are given on a grid of n_columns spines (along, rising with x: outlet
/// first) by n_rows (through the upper half, mid plane first): the nodes of the biquadratic elements, every second
/// one a corner.  x runs as in bite::RollBite: towards the entry, x = 0 on the line of centres.  Rows are
/// streamlines.
struct StripFlow {
  bite::BiteState state;
  std::vector<StripFlowLevel> history;
  StripFlowBalance balance;
  StripLines lines;
  int n_unknowns        = 0;
  double seconds        = 0;       ///< s
  double work           = 0;       ///< unknowns times factorisations
  double entry_position = 0;       ///< m, where the contact begins
  double exit_thickness = 0;       ///< m, of the strip far behind the bite
  double exit_tension   = 0;       ///< Pa, given, or found where StripFlowModel::exit_speed is given
  double second_peak = not_given;  ///< Pa, of the pressure hill apart from the edge of entry; nan: there is none
  int slip_changes   = 0;          ///< of sign along the arc: one neutral point, or more
  double negative_length = 0;      ///< m, of the arc with tension between roll and strip

  Eigen::MatrixXd x, y;           ///< (columns, rows) m
  Eigen::MatrixXd vx, vy;         ///< (columns, rows) m/s; over the roll's speed where that is not given; vx < 0
  Eigen::MatrixXd pressure;       ///< (columns, rows) Pa, mean stress with opposite sign
  Eigen::MatrixXd strain;         ///< (columns, rows) -, accumulated, as thickness strain ln(h0/h) of plane strain
  Eigen::MatrixXd rate;           ///< (columns, rows) 1/s, of that strain; 1/m where the roll's speed is not given
  Eigen::MatrixXd sxx, syy, sxy;  ///< (columns, rows) Pa
  int first_contact = 0;          ///< column in which the strip leaves the roll
  int last_contact  = 0;          ///< column of entry
  Eigen::VectorXd nodal_force;    ///< (contact columns) N, normal, over the strip width
  Eigen::VectorXd roll_surface;   ///< (contact columns) m, height of the roll's surface over the mid plane
  Eigen::VectorXd flattening;     ///< (contact columns) m, of the roll towards its axis; zero for a circle
  Eigen::VectorXd unknowns;       ///< of the solver, scaled, for a start nearby
};

// The solution, without how it was come to.
template <class Io, class R, if_record<R, StripFlow> = 0> void each_member(Io &&io, R &record)
{
  auto &[state, history, balance, lines, n_unknowns, seconds, work, entry_position, exit_thickness, exit_tension,
         second_peak, slip_changes, negative_length, x, y, vx, vy, pressure, strain, rate, sxx, syy, sxy,
         first_contact, last_contact, nodal_force, roll_surface, flattening, unknowns] = record;
  io("state", state);
  io("balance", balance);
  io("n_unknowns", n_unknowns);
  io("seconds", seconds);
  io("entry_position", entry_position);
  io("exit_thickness", exit_thickness);
  io("exit_tension", exit_tension);
  io("second_peak", second_peak);
  io("slip_changes", slip_changes);
  io("negative_length", negative_length);
  io("x", x);
  io("y", y);
  io("vx", vx);
  io("vy", vy);
  io("pressure", pressure);
  io("strain", strain);
  io("rate", rate);
  io("sxx", sxx);
  io("syy", syy);
  io("sxy", sxy);
  io("first_contact", first_contact);
  io("last_contact", last_contact);
  io("nodal_force", nodal_force);
  io("roll_surface", roll_surface);
  io("flattening", flattening);
}

/// Fields on the grid as VTU; upper half. Written aside and renamed.
void write_strip_flow_vtu(const std::string &path, const StripFlow &flow);
}  // namespace mill::fem
