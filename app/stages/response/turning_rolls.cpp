#include "app/stages/response/turning_rolls.h"
#include "core/model/case.h"
#include "core/model/four_high.h"
#include "core/model/lumped.h"
#include "core/records/record_text.h"
#include <algorithm>
#include <type_traits>
#include <variant>

namespace mill {
namespace {
// The bearing of a roll, when it has rollers.
const RollerBearing *rollers_of(const FourHigh &stand, const Roll &roll)
{
  if (roll.bearing.empty() || oil_film_of(stand.oil_films, roll.bearing))
    return nullptr;  // its stiffness is given
  const auto bearing = std::find_if(stand.bearings.begin(), stand.bearings.end(),
                                    [&](const RollerBearing &b) { return b.name == roll.bearing; });
  return bearing == stand.bearings.end() ? nullptr : &*bearing;
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

std::string text_of_line(const CaseSpec &spec, const std::string &name)
{
  return std::visit(
      [&](const auto &stand) -> std::string {
        using Stand = std::decay_t<decltype(stand)>;
        if constexpr (std::is_same_v<Stand, FourHigh> || std::is_same_v<Stand, Lumped>) {
          const CampbellSettings &settings = stand.campbell;
          std::vector<DriveOrder> drive    = stand.drive;
          for (std::size_t i = 0; i < drive.size(); ++i)
            drive[i].name = std::to_string(i);
          const auto lines = turning_lines(settings, {nullptr, turning_rolls(stand), stand.passes, drive}).lines;
          const auto line =
              std::find_if(lines.begin(), lines.end(), [&](const CampbellLine &one) { return one.name == name; });
          // Which crossing is the nearest depends on how many orders there are.
          std::string text = record_text(working_speeds(settings, stand.passes), settings.speeds,
                                         settings.roll_orders, settings.bearing_harmonics);
          if (line == lines.end())
            return text;
          return text + record_text(line->per_turn, line->per_length, line->group);
        }
        return "";
      },
      spec);
}
}  // namespace mill
