#pragma once
#include "core/records/records.h"

namespace mill::reduce {
/// The two slopes of a load-approach curve at one load.  theory.md 3.2
struct ContactStiffness {
  double tangent;       ///< N/m, dF/d(approach) at the working load: what a vibrating mill feels
  double secant;        ///< N/m, F/approach at the working load: what screwing down feels
  double curvature;     ///< N/m2, d2F/d(approach)2 at the working load
  double working_load;  ///< N, total over the contact length
  double fit_error;     ///< -, largest |fitted - computed approach| / approach over the samples used
};

/// Stiffness of one contact, for instance K3, upper backup roll on upper work roll.
/// Fits  approach = F (c0 + c1 u + c2 u^2),  u = ln(F / working load), so that the slope is analytic and not a
/// difference of two nearly equal numbers.  With c2 = 0 this is the form of a plane-strain line contact (3.6); c2
/// takes up what crown and barrel ends add.  The fit is local: up to seven samples nearest to the working load,
/// weighted towards it.
///
/// @param curve         n >= 5 samples in increasing load; only load and approach are read
///                        curve.load      (n)  N, total over the contact length, > 0
///                        curve.approach  (n)  m, distance the two roll axes come together, > 0
/// @param working_load  N, inside the sampled range; a curve is never extrapolated
/// @param worst_fit     -, largest fit_error: a smooth sweep reaches 1e-5, and 1e-3 means that the form no longer
///                      holds; a coarse mesh, which only judges another, steps by more
///
/// @throws InputError   n < 5, loads not increasing or not positive, or working_load outside the samples;
///                      names the key that sets the range
/// @throws SolverError  fit_error > worst_fit: no line contact any more (edge contact, lost nodes)
/// Cost O(n).  No state, no files.
/// Source: K. L. Johnson, Contact Mechanics (1985), chapter 5; the slope is derived in theory.md 3.2.
ContactStiffness contact_stiffness(const ContactCurve &curve, double working_load, double worst_fit = 1e-3);
}  // namespace mill::reduce
