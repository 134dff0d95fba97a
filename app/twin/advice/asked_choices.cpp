#include "app/twin/advice/asked_choices.h"
#include "core/case/fields.h"
#include "core/model/case.h"
#include <algorithm>
#include <fmt/format.h>

namespace mill {
Place place_of_key(const Case &the_case, const std::string &key)
{
  const auto place = the_case.places.find(key);
  return place == the_case.places.end() ? Place{the_case.path} : place->second;
}

int place_in(const twin::VibratingStand &stand, const Case &the_case, const std::string &key,
             const std::string &name)
{
  const int place = stand.place(name);
  if (place >= 0)
    return place;
  std::vector<std::string> known = stand.places;
  for (std::string &one : known)
    std::replace(one.begin(), one.end(), ' ', '_');
  throw InputError(place_of_key(the_case, key),
                   fmt::format("{} = \"{}\": the stand has no such place{}", key, name, suggestion(name, known)));
}

std::vector<twin::DamperChoice> damper_choices(const twin::VibratingStand &stand, const StandAdvice &asked,
                                               const Case &the_case)
{
  if (asked.dampers.empty())
    return asked.usual_damper > 0 ? twin::usual_dampers(stand, asked.usual_damper)
                                  : std::vector<twin::DamperChoice>();
  std::vector<twin::DamperChoice> choices;
  for (std::size_t i = 0; i < asked.dampers.size(); ++i) {
    const DamperProposal &one = asked.dampers[i];
    const auto end            = [&](const char *key, const std::string &name) {
      return is_ground(name) ? -1 : place_in(stand, the_case, fmt::format("advice.damper.{}.{}", i, key), name);
    };
    twin::Attachment damper;
    damper.from   = end("from", one.from);
    damper.to     = end("to", one.to);
    damper.damper = one.damper;
    if (damper.from == damper.to)
      throw InputError(place_of_key(the_case, fmt::format("advice.damper.{}.to", i)),
                       fmt::format("advice.damper.{} begins and ends at one place, {}", i, one.to));
    const auto same = std::find_if(choices.begin(), choices.end(),
                                   [&](const auto &c) { return !one.name.empty() && c.name == one.name; });
    if (same != choices.end())
      same->joined.push_back(damper);
    else
      choices.push_back({one.name.empty() ? damper_name(stand, damper) : one.name, {damper}});
  }
  return choices;
}

int on_its_chock(const twin::VibratingStand &stand, const std::string &roll)
{
  for (const char *side : {"upper", "lower"})
    for (const auto &[body, chock] :
         {std::pair{" work roll", " work-roll chock"}, {" backup roll", " backup chock"}})
      if (roll == std::string(side) + body)
        return stand.place(std::string(side) + chock);
  return stand.place(roll);
}

ProcessAdvice process_of(const ChatterAdvice &asked)
{
  ProcessAdvice process;
  process.wanted_speed    = asked.wanted_speed;
  process.force_rise      = asked.force_rise;
  process.torque_rise     = asked.torque_rise;
  process.speed           = asked.speed;
  process.entry_thickness = asked.entry_thickness;
  process.entry_tension   = asked.entry_tension;
  process.exit_tension    = asked.exit_tension;
  process.viscosity       = asked.viscosity;
  process.friction        = {1, 1};
  return process;
}
}  // namespace mill
