#pragma once
#include "fem/strip/common/strip_state.h"

// Steady plane-strain rolling of an elastic-plastic strip by finite elements.  theory.md 19
namespace mill::fem {
/// Mesh, regularisations, roll.
struct StripElasticModel {
  bite::Arc arc        = bite::Arc::rigid;  ///< rigid circle, or any shape (elastic)
  int elements_along   = 24;                ///< on the contact where it is long and smooth; its ends are finer
  int elements_through = 4;                 ///< through half the thickness
  double finest        = 0.125;             ///< -, element at the ends of the contact over the others
  double outside       = 0;  ///< -, inlet and outlet over the entry thickness; 0: 1, or 1.5 for thick strip
  double cutoff_slip =
      2e-3;  ///< -, d0 over ln(h1/h2) of the roll's speed: the sign of slip is regularised over it
  double cutoff_strain_rate = 0;         ///< -, g0 over the mean rate of shear; 0: a sharp yield limit
  double tolerance          = 1e-9;      ///< -, norm of the scaled residual of a converged state
  double stiffness          = 1;         ///< -, factor on the strip's elastic moduli
  bool derivatives          = true;      ///< by all inputs, two more factorisations
  double work_limit         = INFINITY;  ///< unknowns times factorisations, after which a solution is given up
};

/// State of the strip, its elastic zones and what stays in it.  Fields as in StripFlow; entry and exit are those
/// of the contact.  Strip::exit_thickness is the gap on the line of centres of rigid rolls, and the smallest
/// thickness of the loaded strip between elastic ones; the strip springs back from there.
struct StripElastic {
  StripFlow flow;
  double smallest_thickness = 0;  ///< m, of the strip under the rolls
  double elastic_entry      = 0;  ///< m, contact before the strip's surface yields
  double elastic_exit       = 0;  ///< m, contact behind its last yielding
  double elastic_power      = 0;  ///< -, elastic energy carried off over the power spent
  int n_yielding            = 0;  ///< points of the mesh that yield
  int n_points              = 0;
  std::vector<double> lines;  ///< m, abscissae of the mesh lines along the strip (against x), rising
  double touch_from  = 0;     ///< m, along the strip: between these contact was looked for
  double touch_to    = 0;     ///< m
  int entry_spine    = -1;    ///< line (twice its number) of the mesh that begins the contact; -1: not fitted
  int exit_spine     = -1;
  double entry_ratio = 1;         ///< -, rigid roll: abscissa of that line over the geometric arc
  bool ends_fitted   = false;     ///< elastic roll: lines of the mesh end the contact exactly
  double stress_unit = 0;         ///< Pa, of flow.unknowns
  Eigen::VectorXd outlet_height;  ///< (3 elements_through) m, from the mid plane
  Eigen::VectorXd outlet_stress;  ///< (3 elements_through) Pa, along the strip far behind the bite: tension and
                                  ///< residual stress
  Eigen::VectorXd
      outlet_weight;  ///< (3 elements_through) m, of each height in an integral over half the thickness
};

/// Solves for velocity, pressure, stress, strain, rows, surface and roll pressure in one system of equations.
/// Every row of elements is a streamline; contact is where the roll presses, found and not prescribed, at both
/// ends. Friction: Coulomb with the limit Friction::shear_limit (nan: none), factor, speed and film law. The roll
/// speed only sets the scale of speeds (and friction where its law knows one): the strip knows no rate.
///
/// @param bite         rolls and strip; no moving gap
/// @param flexibility  of the roll's surface, Arc::elastic only; null: half plane
/// @param start        a state nearby, its mesh is kept; null: cold start on a coarse mesh, then one that is fine
/// where
///                     the contact turned out to end
/// @throws InputError   what no roll can do with this strip; strip without elasticity; a flexibility that is too
/// short
/// @throws SolverError  no convergence: last converged level, residual, remedy
/// Cost: 24 x 4 elements: some 60 factorisations of 3000 unknowns and 40 of 10000, 5 to 8 s of one core; warm
/// start 1 s. Near-rigid thick strip (its contact begins at an edge) is the domain of solve_strip_flow. Source:
/// own formulation, theory.md 19; time integration along the streamlines: E. Hairer, G. Wanner, Solving Ordinary
/// Differential Equations II (1996), chapter IV.5 (Radau IIA) and IV.12 (algebraic stability); complementarity: A.
/// Fischer, Optimization 24 (1992) 269.
StripElastic solve_elastic_strip(const bite::RollBite &bite, const StripElasticModel &model = {},
                                 const bite::ArcFlexibility *flexibility = nullptr,
                                 const StripElastic *start               = nullptr);
}  // namespace mill::fem
