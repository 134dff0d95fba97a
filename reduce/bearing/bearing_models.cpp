#include "reduce/bearing/bearing_models.h"
#include "reduce/bearing/clearance.h"
#include "reduce/bearing/geometry.h"
#include <cmath>
#include <utility>

namespace mill::bearing {
RollerBearing with_row_places(RollerBearing b)
{
  if (std::isnan(b.width))
    b.width = b.rows * b.roller_length;
  if (std::isnan(pitch_diameter(b)))
    b.pitch_diameter =
        b.rollers_per_row * (std::isnan(b.roller_diameter) ? b.roller_length : b.roller_diameter) / M_PI;
  return b;
}

RollerBearing between_rigid_rings(RollerBearing b)
{
  if (b.roller_law == OneRollerLaw::fe)
    b.roller_law = OneRollerLaw::iso;
  b.rings = RingBodies::rigid;
  return with_row_places(std::move(b));
}

BearingModel with_rigid_rings(BearingModel model)
{
  model.rings         = {};
  model.bearing.rings = RingBodies::rigid;
  return model;
}

BearingModel model_by_law(const RollerBearing &bearing, const OneRollerLaw law)
{
  RollerBearing b = with_row_places(bearing);
  b.roller_law    = law;
  b.rings         = RingBodies::rigid;
  return rigid_model(b);
}

BearingModel with_neighbouring_law(BearingModel model)
{
  RollerBearing b   = model.bearing;
  const bool is_iso = b.roller_law == OneRollerLaw::iso;
  b.roller_law      = is_iso ? OneRollerLaw::palmgren : OneRollerLaw::iso;
  b.rings           = RingBodies::rigid;
  model.roller      = with_limits(roller_law(b));
  return model;
}

std::vector<BearingVariant> other_arrangements(const BearingModel &model)
{
  std::vector<BearingVariant> out;
  const RollerBearing &b = model.bearing;
  if (!b.arrangement_assumed)
    return out;
  for (const std::string &hands : usual_arrangements(b.rows))
    if (const std::string name = arrangement_name(hands, b.rows);
        name != arrangement_name(b.arrangement, b.rows)) {
      out.push_back({name, model});
      out.back().model.bearing.arrangement = hands;
    }
  return out;
}

std::optional<RestingFit> resting_fit(RollerBearing b)
{
  if (!std::isfinite(b.roller_diameter) || !std::isfinite(pitch_diameter(b)))
    return {};
  b.roller_law         = OneRollerLaw::iso;
  const auto law       = roller_law(b);
  const double pressed = approach_offset(b, law);
  const double load    = pressed > 0 ? roller_load(law, pressed, 0).load : 0;
  if (!(load > 0))
    return {};
  const double pressure = elastic_roller(b, load, b.roller_diameter / 2).inner_peak_pressure;
  return RestingFit{load, pressure, std::pow(b.yield_pressure / pressure, b.preload > 0 ? 2 : 1.8)};
}
}  // namespace mill::bearing
