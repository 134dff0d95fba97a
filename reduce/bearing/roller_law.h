#pragma once
#include "core/model/roller_bearing.h"
#include <Eigen/Core>

namespace mill::bearing {
inline constexpr double lamina_exponent = 10.0 / 9;  ///< -, load over compression of one slice in the power form

/// Law of one roller between both raceways, cut into n slices.  Two forms:  theory.md 5.2, 5.5
///   power         q_k = lamina_constant * max(0, d_k)^(10/9)                              (iso, palmgren)
///   line contact  d = influence q + local(q) ,  local_k = kappa p_k ln(p_ref / p_k) ,  p_k = q_k / slice_length,
///                 q >= 0, and d_k <= (influence q)_k where q_k = 0                        (elastic, fe)
/// In the second form `influence` is the linear flexibility of roller and raceways with every slice load spread
/// over the Hertz half width of the line load p_ref; the local term is what the half width changes with the load,
/// two contacts of two bodies each.
struct RollerLaw {
  Eigen::VectorXd position;        ///< (n) m, middle of each slice along the contact line, from mid-roller
  Eigen::VectorXd drop;            ///< (n) m, both contacts together: what the profile takes from the approach
  double slice_length    = 0;      ///< m
  double lamina_constant = 0;      ///< N/m^(10/9), c_L / n, power form; 0: line-contact form
  Eigen::MatrixXd influence;       ///< (n, n) m/N, line-contact form, symmetric
  double kappa               = 0;  ///< m/(N/m), 4 (1 - nu^2)/(pi E)
  double reference_line_load = 0;  ///< N/m, p_ref
  double separate_line_load  = 0;  ///< N/m, p_c; set by with_limits
  double shared_line_load    = 0;  ///< N/m, p_d; set by with_limits
};

/// The law with the limits of its local term, from the smallest eigenvalues of `influence`; a power law unchanged.
/// slice_loads does this at each call for a law that lacks it: call it once, 1 ms for n = 41.
/// @throws InputError  influence of another size, not positive definite; kappa, slice length or p_ref not positive
RollerLaw with_limits(RollerLaw law);

/// The law of a roller that carries `factor` times the load of this one at every approach.
/// @throws InputError  factor not positive
RollerLaw stiffened(RollerLaw law, double factor);

/// Walls of the two rings behind the raceways at mid-roller.
struct RingWalls {
  double inner = 0;  ///< m
  double outer = 0;  ///< m
};

/// @throws InputError  bore, outside diameter or roller diameter missing, or no wall left
RingWalls ring_walls(const RollerBearing &bearing);

/// Constant c_L of a whole roller, N/m^(10/9):  Q = c_L d^(10/9) with d the approach of both raceways together.
/// @param law  "iso": 35948 l^(8/9) N/mm^(10/9), ISO/TS 16281 (35);
///             "palmgren": two contacts of 3.84e-5 Q^0.9 / l^0.8 mm in series, 37310 l^(8/9), (5.4)
/// @throws InputError  another law
double roller_constant(OneRollerLaw law, double roller_length);

/// Law of the bearing's roller by its `roller_law` with profile, slices and effective length.
///   iso, palmgren  power form
///   elastic        line-contact form, slices that do not feel each other: (5.9) and (5.10), each raceway held
///                  at the depth of its ring's wall
/// @throws InputError  "fe" (made from a mesh, in another library) or an unknown law; a profile that lacks its
///                     dimensions; no slice; elastic without bore, outside diameter or roller diameter
RollerLaw roller_law(const RollerBearing &bearing);

/// The elastic law with raceways held at these depths.  Errors as roller_law.
RollerLaw elastic_law(const RollerBearing &bearing, const RingWalls &depth);

/// Loads of the slices at given approaches, and how they follow the approaches in given directions.
struct SliceLoads {
  Eigen::VectorXd load;   ///< (n) N
  Eigen::MatrixXd slope;  ///< (n, m) N, d(load)/d(approach) times the m directions
  int iterations = 0;
};

/// @param approach    (n) m, of both raceways at each slice, the profile not yet taken off
/// @param directions  (n, m) changes of the approach; identity gives the full derivative
/// @param start       (n) N, loads of a state near by; empty: cold
/// @throws InputError   sizes
/// @throws SolverError  line contact: no equilibrium in 200 steps (a number that is none)
/// Cost: power form O(n m); line contact a (n, n) Cholesky factor per Newton step, one or two with a start, some 6
/// without: 20 us each for n = 41.
SliceLoads slice_loads(const RollerLaw &law, const Eigen::VectorXd &approach, const Eigen::MatrixXd &directions,
                       const Eigen::VectorXd &start = {});

/// Load of one roller and its slope at one approach.
struct RollerLoad {
  double load;       ///< N, sum over the slices
  double stiffness;  ///< N/m, d(load)/d(approach)
};

/// Load of a roller pressed by `approach` (m, both raceways, at its middle) and tilted by `tilt` (rad) in its
/// axial plane.  Cost as slice_loads.
RollerLoad roller_load(const RollerLaw &law, double approach, double tilt);

/// Inverse of roller_load without tilt: approach, m, at which the roller carries `load` (N, > 0).
/// @throws InputError  load not positive
double roller_approach(const RollerLaw &law, double load);

/// One roller between its raceways by plane-strain elasticity: no empirical constant, but a depth to which the
/// raceway is counted, since a line contact has no deflection without a datum.  theory.md 5.3
struct ElasticRoller {
  double approach;             ///< m, raceway datum to raceway datum
  double roller_part;          ///< m, of the approach, inside the roller
  double inner_half_width;     ///< m
  double outer_half_width;     ///< m
  double inner_peak_pressure;  ///< Pa
  double outer_peak_pressure;  ///< Pa
};

/// Independent check of the roller law at `load` (N), evenly over the effective length, with raceways held at
/// `depth` (m) behind the contact.  Modulus and Poisson's ratio of the bearing; raceway radii D_pw/2 -+ D_we/2.
/// @throws InputError  load or depth not positive, roller or pitch diameter missing
/// Source: K. L. Johnson, Contact Mechanics (1985), chapter 5.
ElasticRoller elastic_roller(const RollerBearing &bearing, double load, double depth);
}  // namespace mill::bearing
