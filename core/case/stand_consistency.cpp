#include "core/base/units.h"
#include "core/case/stand_reader.h"
#include "core/model/four_high.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

// Parts of one stand against each other: what cannot be is an error, what hardly is a warning.
namespace mill {
void doubt(Reading &reading, const std::string &key, const Doubt &why, const std::vector<std::string> &others)
{
  Warning warning{WarningId::value_doubtful, "", reading.as_written(key) + " " + why.fact, why.detail, why.remedy};
  warning.key   = key;
  warning.place = reading.place(key);
  for (const std::string &other : others)
    if (reading.places.count(other))
      warning.related.push_back(reading.place(other));
  reading.warnings.push_back(std::move(warning));
}

namespace {
constexpr double rounding_of_units = 1 + 1e-9;
constexpr double loose_seat        = 0.8;  // of the bore: no neck is ground smaller than this

// A roller bearing on the necks of a roll, with the names of their keys.
struct OnRoll {
  std::string section;
  const Roll &roll;
  const RollerBearing &bearing;
  std::string of_roll(const char *key) const
  {
    return section + "." + key;
  }
  std::string of_bearing(const char *key) const
  {
    return "bearing." + bearing.name + "." + key;
  }
};

std::vector<OnRoll> bearings_on_rolls(const FourHigh &stand)
{
  std::vector<OnRoll> all;
  for (const auto &[section, roll] :
       {std::pair("work_roll", &stand.work_roll), std::pair("backup_roll", &stand.backup_roll)})
    for (const RollerBearing &bearing : stand.bearings)
      if (bearing.name == roll->bearing)
        all.push_back({section, *roll, bearing});
  return all;
}

void check_neck_in_bore(const OnRoll &seat, Reading &reading)
{
  const std::string neck = seat.of_roll("neck_diameter"), bore = seat.of_bearing("bore");
  if (!reading.usable({neck, bore, seat.of_roll("bearing")}) || std::isnan(seat.bearing.bore))
    return;
  if (seat.roll.neck_diameter > seat.bearing.bore * rounding_of_units)
    contradict(
        reading, neck,
        fmt::format(
            "does not fit into bearing.{}, whose bore is {}; for a stepped neck give the seat of the bearing",
            seat.bearing.name, millimetres(seat.bearing.bore)),
        {bore});
  else if (seat.roll.neck_diameter < loose_seat * seat.bearing.bore)
    doubt(reading, neck,
          {fmt::format("is loose in bearing.{}, whose bore is {}", seat.bearing.name,
                       millimetres(seat.bearing.bore))},
          {bore});
}

// Half the width of the bearing to both sides of its centre, between barrel and end of the roll.
void check_place_of_bearing(const OnRoll &seat, Reading &reading)
{
  const Roll &roll       = seat.roll;
  const std::string span = seat.of_roll("bearing_span"), barrel = seat.of_roll("barrel_length"),
                    width = seat.of_bearing("width");
  if (!reading.usable({span, barrel, width, seat.of_roll("bearing")}) || std::isnan(seat.bearing.width) ||
      !(roll.bearing_span > roll.barrel_length))
    return;
  const double from_barrel = (roll.bearing_span - roll.barrel_length) / 2, half = seat.bearing.width / 2;
  if (half > from_barrel * rounding_of_units)
    contradict(reading, span,
               fmt::format("puts bearing.{}, {} wide, into the barrel: its centre is {} from the barrel end",
                           seat.bearing.name, millimetres(seat.bearing.width), millimetres(from_barrel)),
               {barrel, width});
  else if (roll.neck_length > from_barrel && from_barrel + half > roll.neck_length * rounding_of_units)
    doubt(reading, span,
          {fmt::format("lets bearing.{}, {} wide, stand out beyond the end of the roll", seat.bearing.name,
                       millimetres(seat.bearing.width)),
           fmt::format("its centre is {} from the barrel end, and the neck {} long", millimetres(from_barrel),
                       millimetres(roll.neck_length))},
          {barrel, width});
}

// A bearing without a width is at least as long as what carries its load: all rows of rollers, or the oil film.
void check_carrying_length(const std::string &section, const Roll &roll, const double length,
                           const std::vector<std::string> &keys, const std::string &what, Reading &reading)
{
  const std::string span = section + ".bearing_span", barrel = section + ".barrel_length";
  const double from_barrel = (roll.bearing_span - roll.barrel_length) / 2;
  if (!reading.usable(keys) || !reading.usable({span, barrel, section + ".bearing"}) || !(from_barrel > 0) ||
      !(length / 2 > from_barrel * rounding_of_units))
    return;
  std::vector<std::string> related{barrel};
  related.insert(related.end(), keys.begin(), keys.end());
  doubt(reading, span,
        {fmt::format("puts bearing.{} into the barrel", roll.bearing),
         fmt::format("{} {} long, its centre is {} from the barrel end", what, millimetres(length),
                     millimetres(from_barrel)),
         "give a larger span"},
        related);
}

void check_rows_on_neck(const OnRoll &seat, Reading &reading)
{
  const RollerBearing &b = seat.bearing;
  if (!std::isnan(b.width))
    return;
  const bool ends = !std::isnan(b.roller_total_length);
  check_carrying_length(seat.section, seat.roll, b.rows * (ends ? b.roller_total_length : b.roller_length),
                        {seat.of_bearing(ends ? "roller_total_length" : "roller_length"), seat.of_bearing("rows")},
                        fmt::format("its {} {} of rollers {}", b.rows, b.rows > 1 ? "rows" : "row",
                                    b.rows > 1 ? "are together" : "is"),
                        reading);
}

void check_sleeve(const FourHigh &stand, Reading &reading)
{
  for (const OilFilmBearing &film : stand.oil_films)
    if (film.name == stand.backup_roll.bearing)
      check_carrying_length("backup_roll", stand.backup_roll, film.length, {"bearing." + film.name + ".length"},
                            "its oil film is", reading);
  for (const OilFilmBearing &film : stand.oil_films) {
    const std::string diameter = "bearing." + film.name + ".diameter", neck = "backup_roll.neck_diameter";
    if (film.name == stand.backup_roll.bearing && reading.usable({diameter, neck}) &&
        stand.backup_roll.neck_diameter > film.diameter * rounding_of_units)
      contradict(reading, neck,
                 fmt::format("does not go into the sleeve of bearing.{}, which is {} outside", film.name,
                             millimetres(film.diameter)),
                 {diameter});
  }
}

void check_chock_in_window(const OnRoll &seat, const MillHousing &housing, Reading &reading)
{
  const RollerBearing &b = seat.bearing;
  const std::string key  = seat.of_bearing("chock_width");
  if (!reading.usable({key, "housing.window_width"}) || std::isnan(b.chock_width) ||
      b.chock_width <= housing.window_width * rounding_of_units)
    return;
  if (reading.places.count(key))
    contradict(reading, key,
               fmt::format("does not go into the window of the housing, which is {} wide",
                           millimetres(housing.window_width)),
               {"housing.window_width"});
  else
    doubt(reading, "housing.window_width",
          {fmt::format("is narrower than the {} assumed for the chock of bearing.{}", millimetres(b.chock_width),
                       b.name),
           "", "give its chock_width"},
          {});
}

void check_rolls_in_window(const FourHigh &stand, Reading &reading)
{
  const MillHousing &housing = stand.housing;
  const double work = stand.work_roll.barrel_diameter, backup = stand.backup_roll.barrel_diameter;
  if (reading.usable({"backup_roll.barrel_diameter", "housing.window_width"}) &&
      backup >= housing.window_width * rounding_of_units)
    contradict(reading, "backup_roll.barrel_diameter",
               fmt::format("does not pass through the window of the housing, which is {} wide",
                           millimetres(housing.window_width)),
               {"housing.window_width"});
  if (!reading.usable({"backup_roll.barrel_diameter", "work_roll.barrel_diameter", "backup_roll.neck_diameter",
                       "housing.window_height"}))
    return;
  const double least = backup + 2 * work + stand.backup_roll.neck_diameter;
  if (housing.window_height < least)
    contradict(
        reading, "housing.window_height",
        fmt::format("is too low: the axes of the backup rolls are {} apart, and half a neck of {} lies beyond "
                    "each; {} at least",
                    millimetres(backup + 2 * work), millimetres(stand.backup_roll.neck_diameter),
                    millimetres(least)),
        {"work_roll.barrel_diameter", "backup_roll.barrel_diameter"});
}

// Both drawn, side by side on the axes: the heights take more than the axes are apart.
void check_chocks_apart(const std::vector<OnRoll> &seats, Reading &reading)
{
  if (seats.size() != 2)
    return;
  const OnRoll &work = seats[0], &backup = seats[1];
  for (const OnRoll *seat : {&work, &backup})
    for (const char *key : {"chock_height", "chock_length"})
      if (!reading.places.count(seat->of_bearing(key)) || !reading.usable({seat->of_bearing(key)}))
        return;
  if (!reading.usable({"work_roll.barrel_diameter", "backup_roll.barrel_diameter", "work_roll.bearing_span",
                       "backup_roll.bearing_span"}))
    return;
  const double axes  = (work.roll.barrel_diameter + backup.roll.barrel_diameter) / 2,
               high  = (work.bearing.chock_height + backup.bearing.chock_height) / 2,
               along = std::abs(work.roll.bearing_span - backup.roll.bearing_span) / 2,
               both  = (work.bearing.chock_length + backup.bearing.chock_length) / 2;
  if (high > axes && along < both)
    doubt(reading, work.of_bearing("chock_height"),
          {fmt::format("and the chock of the backup roll overlap by {}", millimetres(high - axes)),
           fmt::format(
               "half of both heights is {}, the axes are {} apart; this is possible only where one chock lies "
               "between the legs of the other",
               millimetres(high), millimetres(axes))},
          {backup.of_bearing("chock_height")});
}

// Half the rolling force, or a share of it: a load of another order is written in another unit.
void check_bearing_loads(const FourHigh &stand, Reading &reading)
{
  for (const auto &[section, roll, share] :
       {std::tuple("work_roll", &stand.work_roll, 1.), std::tuple("backup_roll", &stand.backup_roll, 0.5)})
    for (std::size_t p = 0; p < stand.passes.size(); ++p) {
      const std::string key = std::string(section) + ".bearing_load", load = fmt::format("pass.{}.load", p);
      const double usual = share * stand.passes[p].load;
      if (!reading.places.count(key) || !reading.usable({key, load}) || std::isnan(usual))
        continue;
      const bool backup = share < 1;
      if (roll->bearing_load > (backup ? 2 : 1) * usual || (backup && roll->bearing_load < 0.1 * usual))
        doubt(reading, key,
              {fmt::format("is {:.4g} times {} of {}", roll->bearing_load / usual,
                           backup ? "half the rolling force" : "the rolling force", reading.as_written(load)),
               "", "is one of the two in another unit?"},
              {load});
    }
}
}  // namespace

void check_consistency(const FourHigh &stand, Reading &reading)
{
  const std::vector<OnRoll> seats = bearings_on_rolls(stand);
  for (const OnRoll &seat : seats) {
    check_neck_in_bore(seat, reading);
    check_place_of_bearing(seat, reading);
    check_rows_on_neck(seat, reading);
    if (stand.housing.present())
      check_chock_in_window(seat, stand.housing, reading);
  }
  check_sleeve(stand, reading);
  if (stand.housing.present())
    check_rolls_in_window(stand, reading);
  check_chocks_apart(seats, reading);
  check_bearing_loads(stand, reading);
}
}  // namespace mill
