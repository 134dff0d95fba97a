#include "core/records/chain_number.h"
#include "core/records/stand_place.h"
#include "twin/advice/advice.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

// Actions that are tried where the case names none.
namespace mill::twin {
double resolving_step(const VibratingStand &stand, const double high)
{
  const double half_width = stand.damping.cwiseProduct(stand.frequency).minCoeff() / (2 * M_PI);
  return std::max(0.25 * half_width, high / 200000);
}

std::string means_of_spring(const std::string &name)
{
  static const std::map<std::string, std::string> means{
      {"K1", "posts and beam of the upper housing"},
      {"K2", "height of the oil column, cylinder, chock and bearing of the upper backup roll, its bending"},
      {"K3", "contact of the upper rolls: load and common length; diameters hardly move it"},
      {"K4", "bite: reduction, width, friction"},
      {"K5", "contact of the lower rolls: load and common length; diameters hardly move it"},
      {"K6", "chock and bearing of the lower backup roll, its bending"},
      {"K7", "lower housing and its foundation"},
  };
  const auto entry = means.find(name);
  return entry == means.end() ? "" : entry->second;
}

std::string damper_name(const VibratingStand &stand, const Attachment &damper)
{
  const auto place = [&](const int i) { return i < 0 ? std::string(ground_place) : stand.places[std::size_t(i)]; };
  return fmt::format("damper {:g} kN s/m, {} to {}", damper.damper / 1e3, place(damper.from), place(damper.to));
}

std::vector<DamperChoice> usual_dampers(const VibratingStand &stand, const double damper)
{
  std::vector<DamperChoice> choices;
  const auto between = [&](const char *from, const char *to) {
    Attachment a;
    a.from   = stand.place(from);
    a.to     = stand.place(to);
    a.damper = damper;
    return a;
  };
  const Attachment upper = between("upper work roll", "upper backup roll"),
                   lower = between("lower work roll", "lower backup roll"),
                   rolls = between("upper work roll", "lower work roll");
  for (const Attachment &a : {upper, lower, rolls})
    if (a.from >= 0 && a.to >= 0)
      choices.push_back({damper_name(stand, a), {a}});
  if (choices.size() == 3)
    choices.push_back(
        {fmt::format("dampers {:g} kN s/m, both work rolls to their backup rolls", damper / 1e3), {upper, lower}});
  return choices;
}

LevelQuestion usual_question(const AdvisedStand &advised, const double low, const double high)
{
  LevelQuestion q;
  q.place = std::max(0, advised.stand.place("upper work roll"));
  q.force = white_force(low, high, resolving_step(advised.stand, high));
  if (advised.chain)
    for (const dynamics::Spring &spring : advised.chain->springs)
      if (spring.stiffness > 0 && spring.name != word_of(ChainNumber::K4))
        q.springs.push_back({spring.name, 0.8, 1.2, means_of_spring(spring.name)});
  q.dampers = usual_dampers(advised.stand, 1e5);
  q.tuned   = {TunedChoice{q.place}};
  return q;
}
}  // namespace mill::twin
