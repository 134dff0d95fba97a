#include "reduce/bite/schedule/arc_force.h"
#include "core/base/errors.h"
#include "reduce/bite/slab/bland_ford.h"
#include "reduce/bite/slab/flattening.h"
#include "reduce/bite/slab/hu_ehmann.h"
#include <cmath>

namespace mill::bite {
double force_on_arc(const RollBite &bite, const Theory theory, const double radius)
{
  const HillRules &rules = hill_rules(bite);
  const auto in          = pass_inputs<double>(bite, radius);
  const Strip &s         = bite.strip;
  double speed = (std::isnan(bite.roll_speed) ? 1 : bite.roll_speed) * s.exit_thickness / s.entry_thickness;
  if (theory == Theory::bland_ford)
    return bland_ford_state(bite, in, speed, rules).force;
  if (theory != Theory::hu_ehmann)
    throw InputError("a force is fitted by the closed theories alone: Bland and Ford, Hu and Ehmann");
  const auto how = hardens(s.flow_stress) ? Integration::quadrature : Integration::closed;
  return hu_ehmann_state(bite, in, speed, rules, how).force;
}

double radius_under(const RollBite &bite, const Arc arc, const double force)
{
  if (arc == Arc::elastic)
    throw InputError("a force is fitted on circular arcs alone, rigid or Hitchcock's");
  return arc == Arc::rigid ? bite.roll_radius : hitchcock_radius(bite, force);
}
}  // namespace mill::bite
