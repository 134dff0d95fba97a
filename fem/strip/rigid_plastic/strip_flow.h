#pragma once
#include "bite/bite.h"
#include "core/records/mesh_file.h"
#include <Eigen/Core>
#include <string>
#include <vector>

// Steady plane-strain rolling of a rigid-plastic strip by finite elements.  theory.md 18
namespace mill::fem {
/// Regularisations and what the computation holds.
struct StripFlowModel {
  bite::Arc arc     = bite::Arc::rigid;  ///< circle of the roll, Hitchcock's circle, or any shape
  double least_rate = 1e-3;  ///< -, g0 over the mean rate of shear of the pass: below it the strip creeps
  double least_slip = 1e-3;  ///< -, d0 over the roll's speed: the sign of slip is smeared over it
  double tolerance  = 1e-9;  ///< -, norm of the scaled residual of a converged state; rounding stops it at 1e-10
  double exit_speed = not_given;  ///< -, over the roll's; given: drawn at that speed, exit tension is a result
  bool release = true;  ///< the contact ends where the pressure has fallen to zero; false: on the line of centres
  bool follow_surface = true;  ///< false: contact begins at the geometric entry, mesh lines stay where they are
  bool derivatives    = true;  ///< by all inputs, two more factorisations
};

/// Lines of the structured mesh, from the entry (inlet first) to the outlet, i.e. against x.
struct StripLines {
  Eigen::VectorXd inlet;   ///< (n) m, distance before the contact, falling to 0
  Eigen::VectorXd arc;     ///< (n) -, share of the arc of contact, 0 at the entry to 1
  Eigen::VectorXd outlet;  ///< (n) m, distance behind the contact, rising from 0
  Eigen::VectorXd rows;    ///< (n) -, share of half the thickness at the inlet, 0 on the mid plane to 1
};

/// Lines of a mesh made by meshes::write_strip_block.
/// @throws InputError  the mesh has no group "roll" or its nodes are not on lines
StripLines strip_lines(const MeshFile &mesh);

/// One accepted step of the continuation.
struct StripFlowLevel {
  std::string stage;       ///< "Picard", "Newton, fixed surface", "Newton, free surface"
  int n_unknowns     = 0;  ///< of its grid
  double least_rate  = 0;  ///< -, g0 over the mean rate of shear
  double least_slip  = 0;  ///< -, d0 over the roll's speed
  double flexibility = 0;  ///< -, share of the roll's flattening
  int iterations     = 0;
  double residual    = 0;  ///< -, scaled, at the end of the level
  double force       = 0;  ///< N
};

/// What must close if the solution is one, each over its reference.  theory.md 18.6
struct StripFlowBalance {
  double flux    = 0;  ///< -, (flux out - flux in) / flux in
  double force_x = 0;  ///< -, horizontal forces on the strip over k h1
  double power   = 0;  ///< -, (power brought in - power dissipated) / power dissipated
};

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

/// Solves for velocity, pressure, roll pressure, surface, ends of contact and strain in one system of equations.
/// Friction: Coulomb with the limit Friction::shear_limit (nan: none), factor, speed and film law.
///
/// @param mesh         of meshes::write_strip_block; its lines follow the strip
/// @param bite         rolls and strip
/// @param flexibility  of the roll's surface, Arc::elastic only; the exit thickness is then that of the strip
/// @param start        a state nearby, on any mesh, or null: cold start from a mesh with every fourth line
/// @throws InputError   what no roll can do with this strip; a flexibility that does not reach the ends of contact
/// @throws SolverError  no convergence: last converged level, residual, remedy
/// Cost: 48 x 12 elements: 15 factorisations of 12700 unknowns after some 50 of coarser grids, 4 s of one core
/// with derivatives; 24 x 6: 0.7 s; warm start a third. Source: flow formulation: O. C. Zienkiewicz, P. C. Jain,
/// E. Onate, Int. J. Solids Struct. 14 (1978) 15.
StripFlow solve_strip_flow(const MeshFile &mesh, const bite::RollBite &bite, const StripFlowModel &model = {},
                           const bite::ArcFlexibility *flexibility = nullptr, const StripFlow *start = nullptr);

/// Fields on the grid as VTU; upper half. Written aside and renamed.
void write_strip_flow_vtu(const std::string &path, const StripFlow &flow);
}  // namespace mill::fem
