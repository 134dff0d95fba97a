#include "app/stages/bearing/bearing_store.h"
#include "core/records/record_text.h"

namespace mill {
namespace {
// Raised by hand when the equilibrium of a bearing changes what it computes.
constexpr const char *equilibrium_version = "bearing 2";
}  // namespace

std::string bearing_inputs_text(const BearingQuestion &q, const double largest_load)
{
  return record_text(equilibrium_version, roller_inputs(q.bearing, largest_load), ring_inputs(q.bearing),
                     q.bearing, q.radial, q.axial, q.tilt, q.cage_angle, q.loads, q.axial_displacement, q.moment,
                     q.centrifugal);
}
}  // namespace mill
