#pragma once
#include "report/page/curves.h"
#include "report/page/run.h"
#include "report/plot/svg_plot.h"
#include <array>
#include <string>
#include <vector>

namespace mill::report {
struct WorkingLoad {
  std::string name;
  double load;     ///< in the unit of ContactCurves::load
  double tangent;  ///< in the unit of ContactCurves::stiffness, from results.json; NaN: not there, the curve has
                   ///< to do
  double secant;   ///< likewise
};

/// The stored curves of one contact and the units in which they are shown.  Rolls have a load and a stiffness;
/// cylinders in plane strain have both per length, which their file says by its units.
struct ContactCurves {
  std::string name;
  const Table *curve;               ///< load-approach curve, each roll squeezed between two opposite contacts
  const Table *closed;              ///< closed forms at the same loads; nullptr when not stored
  std::vector<StoredCurve> curves;  ///< load-approach curves of every kind, that one first
  std::string load;                 ///< "kN" or "N/mm"
  std::string stiffness;            ///< "kN/mm" or "kN/mm per m"
  std::vector<WorkingLoad> loads;
  bool per_length = false;  ///< of bodies in plane strain
};
ContactCurves contact_curves(const Run &run, const std::string &name);

/// One of the closed forms of a line contact's secant.
struct ClosedForm {
  const char *column, *label;
  Pen pen_of_curve;   ///< where it is compared with one computed curve
  Pen pen_of_slopes;  ///< where tangent and secant are drawn together
};
extern const std::array<ClosedForm, 4> closed_secants;

/// The computed tangent and secant at the working loads and their place in the band that the closed forms span.
/// Empty when no working load lies inside the curves.
std::string band_table(const ContactCurves &contact);
}  // namespace mill::report
