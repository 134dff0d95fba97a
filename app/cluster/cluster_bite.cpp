#include "app/cluster/cluster_bite.h"
#include "app/cluster/cluster_schedule.h"
#include "core/model/case.h"
#include "reduce/bite/schedule/force_fit.h"
#include "reduce/bite/schedule/schedule.h"
#include "reduce/bite/slab/slab_bite.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
void add_key(std::string &list, const bool missing, const std::string &key)
{
  if (missing)
    list += (list.empty() ? "" : ", ") + key;
}
}  // namespace

std::optional<RolledBite> rolled_bite(const ClusterStand &stand, const ClusterPass &pass,
                                      const ClusterForce &force)
{
  const auto drawn = bite_of_pass(stand, pass);
  if (!drawn)
    return std::nullopt;
  RolledBite rolled;
  if (force.given) {
    const auto fit =
        bite::fit_flow_stress(*drawn, bite::closed_form_theory(drawn->strip), bite::Arc::hitchcock, force.value);
    rolled.bite   = fit.bite;
    rolled.stress = fmt::format("{:.4g} MPa, fitted to the load of the pass", 1e-6 * fit.value);
  } else {
    rolled.bite   = bite::with_exit_stress(*drawn);
    rolled.stress = fmt::format("{:.4g} MPa, strip.flow_stress at the exit of the pass",
                                1e-6 * rolled.bite.strip.flow_stress.k);
  }
  const auto state =
      bite::solve_slab(rolled.bite, {bite::closed_form_theory(rolled.bite.strip), bite::Arc::hitchcock, 0});
  rolled.K4 = bite::slab_stiffness(rolled.bite, state).combined;
  return rolled;
}

std::string missing_of_bite(const ClusterStand &stand, const std::size_t p)
{
  const ClusterPass &pass = stand.schedule[p];
  const std::string of    = fmt::format("pass.{}.", p);
  std::string missing;
  add_key(missing, !(stand.strip.width > 0), "strip.width");
  add_key(missing, std::isnan(pass.entry_thickness), of + "entry_thickness");
  add_key(missing, std::isnan(pass.exit_thickness), of + "exit_thickness");
  add_key(missing, !bite::has_friction(stand.strip.friction), "strip.friction");
  add_key(missing, std::isnan(pass.load) && !bite::has_flow_stress(stand.strip), "strip.flow_stress");
  add_key(missing, needs_speed(stand.strip.friction) && std::isnan(pass.speed), of + "speed");
  return missing;
}

std::string missing_of_chatter(const ClusterStand &stand, const std::size_t p)
{
  const ClusterPass &pass = stand.schedule[p];
  const std::string of    = fmt::format("pass.{}.", p);
  std::string missing     = missing_of_bite(stand, p);
  add_key(missing, std::isnan(pass.speed) && !needs_speed(stand.strip.friction), of + "speed");
  add_key(missing, std::isnan(pass.entry_tension), of + "entry_tension");
  add_key(missing, std::isnan(pass.exit_tension), of + "exit_tension");
  return missing;
}

double strip_spring(const ClusterStand &stand, const ClusterPass &pass, const ClusterForce &force)
{
  if (!std::isnan(stand.stack.strip_stiffness))
    return stand.stack.strip_stiffness;
  const auto rolled = rolled_bite(stand, pass, force);
  return rolled ? rolled->K4 : not_given;
}

ClusterStand rolled_stand(const ClusterStand &stand, const ClusterPass &pass, const ClusterForce &force)
{
  ClusterStand rolled = stand;
  if (stand.stack.strip.find('-') != std::string::npos)
    rolled.stack.strip_stiffness = strip_spring(stand, pass, force);
  return rolled;
}

void check_strip_contact(const Case &the_case, const ClusterStand &stand)
{
  if (stand.stack.strip_stiffness == 0) {
    const auto place = the_case.places.find("stack.strip_stiffness");
    throw InputError(
        place == the_case.places.end() ? Place{the_case.path} : place->second,
        "stack.strip_stiffness = 0 kN/mm: the strip between the work rolls carries nothing; give K4 of "
        "the bite, above zero, or leave the key out: then it is computed from thicknesses, friction and "
        "flow stress of the pass, or the rolling force is imposed");
  }
  for (const ClusterPass &pass : stand.schedule) {
    const ClusterForce force = cluster_force(stand, pass);
    if (!(force.value > 0))
      throw InputError(
          pass.place,
          fmt::format("pass \"{}\": the strip carries {:.4g} kN{}: its contact carries nothing and the "
                      "stack has no load; give load, or lower tensions, more reduction or more flow "
                      "stress",
                      pass.name, 1e-3 * force.value, force.given ? "" : " by " + force.method));
    const double K4 = [&] {
      try {
        return strip_spring(stand, pass, force);
      } catch (const InputError &e) {
        throw InputError(pass.place, "pass \"" + pass.name + "\": " + e.problems.front().message);
      }
    }();
    if (K4 <= 0)
      throw InputError(pass.place,
                       fmt::format("pass \"{}\": K4 of the bite is {:.4g} kN/mm: the strip does not push "
                                   "back; give stack.strip_stiffness, or other thicknesses and tensions",
                                   pass.name, 1e-6 * K4));
  }
}
}  // namespace mill
