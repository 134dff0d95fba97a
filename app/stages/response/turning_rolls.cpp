#include "app/stages/response/turning_rolls.h"
#include "core/model/case.h"
#include "core/model/four_high.h"
#include "core/model/lumped.h"

namespace mill {
namespace {
// The bearing of a roll, when it has rollers.
const RollerBearing *rollers_of(const FourHigh &stand, const Roll &roll)
{
  return roll.bearing.empty() || oil_film_of(stand.oil_films, roll.bearing)
             ? nullptr  // its stiffness is given
             : &bearing_of(stand.bearings, roll.bearing);
}
}  // namespace

std::vector<TurningRoll> turning_rolls(const FourHigh &stand)
{
  return {{RollKind::work_roll, stand.work_roll.barrel_diameter, "work_roll.barrel_diameter",
           rollers_of(stand, stand.work_roll)},
          {RollKind::backup_roll, stand.backup_roll.barrel_diameter, "backup_roll.barrel_diameter",
           rollers_of(stand, stand.backup_roll)}};
}

std::vector<TurningRoll> turning_rolls(const Lumped &lumped)
{
  return {{RollKind::work_roll, lumped.campbell.work_roll_diameter, "campbell.work_roll_diameter"},
          {RollKind::backup_roll, lumped.campbell.backup_roll_diameter, "campbell.backup_roll_diameter"}};
}
}  // namespace mill
