#pragma once
#include "core/stand.h"
#include <Eigen/Core>

namespace mill::bearing {
/// Load-approach law of one roller between both raceways, cut into laminae:  q_k = c_s max(0, d_k)^(10/9).
/// theory.md 5.2
struct RollerLaw {
  double lamina_constant;    ///< N/m^(10/9), c_s = c_L / n
  Eigen::VectorXd position;  ///< (n) m, middle of each lamina along the roller, from its middle
  Eigen::VectorXd drop;      ///< (n) m, both contacts together: what the profile takes from the approach there
};

/// Load of one roller and its slopes at one approach.
struct RollerLoad {
  double load;       ///< N, sum over the laminae
  double stiffness;  ///< N/m, d(load)/d(approach)
};

/// Constant c_L of a whole roller, N/m^(10/9):  Q = c_L d^(10/9) with d the approach of both raceways together.
/// @param law  "iso": 35948 l^(8/9) N/mm^(10/9), ISO/TS 16281 (35);
///             "palmgren": two contacts of 3.84e-5 Q^0.9 / l^0.8 mm in series, 37310 l^(8/9), (5.4)
/// @throws InputError  another law
double roller_constant(const std::string &law, double roller_length);

/// Law of the bearing's roller with its profile (none | iso | log | crown), laminae and length.
/// @throws InputError  unknown profile; a profile without roller diameter; crown without crown_drop; no lamina
RollerLaw roller_law(const RollerBearing &bearing);

/// Load of a roller pressed by `approach` (m, both raceways, at its middle) and tilted by `tilt` (rad) in its
/// axial plane. Cost O(n), one power per loaded lamina.
RollerLoad roller_load(const RollerLaw &law, double approach, double tilt);

/// Inverse of roller_load without tilt: approach, m, at which the roller carries `load` (N, > 0).
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

/// Independent check of the roller law at `load` (N) with raceways held at `depth` (m) behind the contact.
/// Rings and roller of bearing steel, E 206 GPa, nu 0.3; raceway radii D_pw/2 -+ D_we/2.
/// @throws InputError  load or depth not positive, roller or pitch diameter missing
/// Source: K. L. Johnson, Contact Mechanics (1985), chapter 5.
ElasticRoller elastic_roller(const RollerBearing &bearing, double load, double depth);
}  // namespace mill::bearing
