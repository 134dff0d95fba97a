#pragma once
#include "fem/roll/contact_study.h"

namespace mill::fem {
/// Slopes of a load-approach curve at one load.  theory.md 2.4
struct ContactSlope {
  double tangent;    ///< N/m, of the fitted curve where it is that of a line contact, else of the active set
  double secant;     ///< N/m
  double exact;      ///< N/m, of the active set at this one load: steps as nodes come into contact
  double curvature;  ///< N/m2, NaN where it is not a line contact or the curve is too rough
};
/// Whether a curve is a result, or only judges one.
enum class Role {
  result,    ///< fitted when it is smooth
  companion  ///< of a coarse mesh: fitted when it is a line contact at all, so that like is compared with like
};

/// @param curve  of the same pair, swept over loads that hold this one
/// @throws InputError  the load is outside the curve
ContactSlope slope_at(const ContactPair &pair, const ContactCurve &curve, double load, Role role = Role::result);

/// The same from the samples alone, for curves of another engine; exact is NaN.
ContactSlope slope_of(const ContactCurve &curve, double load);
}  // namespace mill::fem
