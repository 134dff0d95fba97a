#pragma once
#include "app/run/run_context.h"
#include "core/model/two_cylinders.h"
#include "core/records/records.h"

// Two bodies in plane strain by boundary elements on half planes, and partial slip.  theory.md 33.2, 33.4
namespace mill {
/// Scalars of a contact in plane strain, per metre of length, and of the same with half as fine elements.
struct LineValues {
  double half_width, peak_pressure, approach, tangent, secant;
};

/// @param fine  else with half as many strips
LineValues half_plane_values(const TwoCylinders &pair, double line_load, bool fine);

/// The load-approach curve.
ContactCurve half_plane_curve(const TwoCylinders &pair, const Eigen::VectorXd &loads, const Progress &progress);

/// Writes curves/contact-line-width.csv: pressure and, under a tangential load, shear over the width; and adds
/// contact.line.stick_half_width, .tangential_*.
void solve_over_width(RunContext &run, const TwoCylinders &pair);
}  // namespace mill
