#pragma once
#include "core/model/two_cylinders.h"
#include "core/process/progress.h"
#include "core/records/records.h"

// Numbers of two bodies in plane strain, per metre of length, by boundary elements on half planes, with their
// errors and closed forms.  theory.md 33.1, 33.2, 33.4
namespace mill::contact {
/// Scalars of a contact at one load; of errors each member is relative.
struct LineValues {
  double half_width;     ///< m
  double peak_pressure;  ///< Pa
  double approach;       ///< m
  double tangent;        ///< N/m2
  double secant;         ///< N/m2
};

/// Relative errors of values from a finer and a coarser mesh.  Half width and peak pressure are fitted apart
/// (1.4), so a parabola of them must carry the load again; the tangent covers the slope with the active set held.
/// @param load   N/m
/// @param exact  N/m2, of the active set; NaN: the engine has none
/// @param ratio  -, element size of the coarser mesh over that of the finer one
LineValues line_errors(const LineValues &fine, const LineValues &coarse, double load, double exact, double ratio);

/// -, width of the coarser strips of this engine over that of the finer ones: an odd number of either, one in the
/// middle, so not quite 2.
double half_plane_coarsening();

/// @param line_load  N/m
/// @param fine       else with strips that are half_plane_coarsening() times as wide
LineValues half_plane_values(const TwoCylinders &pair, double line_load, bool fine);

/// The load-approach curve.
/// @param loads  (n) N/m
ContactCurve half_plane_curve(const TwoCylinders &pair, const Eigen::VectorXd &loads, const Progress &progress);

/// Pressure over the width of the contact at the working load; under a tangential load with the shear.
struct LineWidth {
  Eigen::VectorXd x;         ///< (n) m, middle of each strip
  Eigen::VectorXd pressure;  ///< (n) Pa
  Eigen::VectorXd shear;     ///< (n) Pa; empty without a tangential load
};
LineWidth half_plane_width(const TwoCylinders &pair);

/// Partial slip under a tangential load; displacements with the datum of the normal approach.
struct SlipValues {
  double stick;            ///< m, half width
  double displacement;     ///< m
  double first_stiffness;  ///< N/m2, of the first increment
  double tangent;          ///< N/m2, at the tangential load
};
struct LineSlip {
  SlipValues value, coarse;  ///< the second on the wider strips
  SlipValues error;          ///< -, relative; of unlike materials the stuck strips are whole, one is included
  SlipValues closed;         ///< Cattaneo (33.5), (33.10): equal materials
  bool coupled;              ///< the materials are not equal: pressure and shear are not apart
  LineWidth width;
};
/// @param pair  with a tangential load
LineSlip half_plane_slip(const TwoCylinders &pair);
}  // namespace mill::contact
