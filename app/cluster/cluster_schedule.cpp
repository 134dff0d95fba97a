#include "app/cluster/cluster_schedule.h"
#include "app/stages/bite/bite_stage.h"
#include "core/model/case.h"
#include "core/records/cluster_names.h"
#include "dynamics/cluster/stack_of_case.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
// Of the roll at the strip in Hitchcock's formula.
Material flattened_material(const ClusterStand &stand, const ClusterRoll &roll)
{
  Material material = stand.steel;
  const auto take   = [](double &value, const double local) {
    if (!std::isnan(local))
      value = local;
  };
  take(material.youngs_modulus, roll.youngs_modulus);
  take(material.poisson_ratio, roll.poisson_ratio);
  take(material.youngs_modulus, stand.stack.flattening_modulus);
  take(material.poisson_ratio, stand.stack.flattening_poisson);
  return material;
}

// Keys of the case behind the bite of a pass.
KeyList bite_keys_of_pass(const Case &the_case, const std::size_t p, const std::size_t roll)
{
  const auto begins_with = [](const std::string &key, const std::string &start) {
    return key.rfind(start, 0) == 0;
  };
  KeyList keys;
  const std::string pass = fmt::format("pass.{}.", p);
  KeyList others         = keys_in("steel", "youngs_modulus poisson_ratio");
  if (!the_case.places.count("strip.initial_thickness"))
    others.push_back("pass.0.entry_thickness");
  const auto vibrates = [&](const std::string &key) {  // the stack answers to it, the bite does not
    return begins_with(key, pass + "dynamic_") || key == pass + "loss_factor" || key == pass + "horizontal_force";
  };
  for (const auto &[key, place] : the_case.places)
    if (!vibrates(key) &&
        (begins_with(key, "strip.") || begins_with(key, "bite.") || begins_with(key, "stack.flattening") ||
         begins_with(key, pass) || begins_with(key, fmt::format("roll.{}.", roll)) || holds(others, key)))
      keys.push_back(key);
  return keys;
}
}  // namespace

std::optional<bite::RollBite> bite_of_pass(const ClusterStand &stand, const ClusterPass &pass)
{
  const ClusterRoll &roll = stand.rolls[std::size_t(cluster::strip_roll(stand))];
  bite::RollBite bite     = bite_of(stand.strip, pass, roll.barrel_diameter, flattened_material(stand, roll));
  const Friction &f       = stand.strip.friction;
  const bool rubs         = f.law != FrictionLaw::coulomb || f.coefficient > 0;
  if (!(stand.strip.width > 0 && bite.strip.entry_thickness > 0 && bite.strip.exit_thickness > 0 && rubs))
    return std::nullopt;
  if (std::isnan(bite.strip.initial_thickness))
    bite.strip.initial_thickness = stand.schedule.front().entry_thickness;
  return bite;
}

ScheduleQuestion schedule_question(const Case &the_case, const bool with_models)
{
  const ClusterStand &stand = *std::get<ClusterCase>(the_case.spec).stand;
  const auto roll           = std::size_t(cluster::strip_roll(stand));
  ScheduleQuestion q;
  q.setup       = stand.bite;
  q.roll_key    = fmt::format("roll.{}.barrel_diameter", roll);
  q.with_models = with_models;
  for (std::size_t p = 0; p < stand.schedule.size(); ++p) {
    const ClusterPass &pass = stand.schedule[p];
    const auto bite         = bite_of_pass(stand, pass);
    if (!bite)
      continue;
    q.passes.push_back({pass.name, *bite, pass.load, pass.published_force, pass.measured_force,
                        pass.published_dynamic, pass.common_fit});
    q.keys.push_back(bite_keys_of_pass(the_case, p, roll));
  }
  return q;
}
}  // namespace mill
