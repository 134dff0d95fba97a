#include "reduce/chain/chain_keys.h"
#include "core/case/provenance.h"
#include "reduce/chain/frame_closure.h"
#include "reduce/chain/screwdown.h"
#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace mill::reduce {
Keys backup_roll_keys(const bool solid)
{
  // A beam ends at its bearings; what sits there bends nothing.
  Keys body;
  for (const std::string &key : roll_body_keys("backup_roll"))
    if (!holds(keys_in("backup_roll", "neck_length bearing_mass"), key))
      body.push_back(key);
  return joined(body, keys_in("backup_roll", "bending_model"), keys_in("steel", "youngs_modulus poisson_ratio"),
                keys_in("dynamics", "mass_reference"),
                solid ? joined(keys_in("backup_roll", "neck_length"),
                               keys_in("dynamics", "elements_per_radius frequency_limit"))
                      : Keys());
}

Keys housing_keys(const MillHousing &housing, const bool mass)
{
  const Keys shape =
      keys_in("housing", "thickness post_width window_width window_height upper_beam_height lower_beam_height "
                         "fillet_radius foot_height screw_pad seat_pad youngs_modulus");
  const auto of_rolls = [](const double given_by_roll, const char *key) {
    return std::isnan(given_by_roll) ? Keys{std::string("steel.") + key} : Keys{};
  };
  return joined(shape, of_rolls(housing.modulus, "youngs_modulus"), Keys{"steel.poisson_ratio"},
                mass ? joined(Keys{"housing.density"}, of_rolls(housing.density, "density")) : Keys{});
}

namespace {
bool is_of_housing(const std::string &key)
{
  constexpr const char *parts[] = {"frame.upper_post_", "frame.upper_beam_", "frame.lower_post_",
                                   "frame.lower_beam_"};
  return std::any_of(std::begin(parts), std::end(parts),
                     [&](const char *part) { return key.rfind(part, 0) == 0; });
}
}  // namespace

Keys as_drawn(const Keys &keys, const FourHigh &stand)
{
  const auto replaced = frame_with_screwdown(stand.frame, stand.screwdown, stand.steel).replaced;
  const auto drawn_as = [&](const std::string &key) -> Keys {
    if (stand.housing.present() && is_of_housing(key))
      return housing_keys(stand.housing, key.find("_mass") != std::string::npos);
    // A backup bearing that contains its chock has taken it out of the chain.
    for (const auto &[chock, stiffness] :
         {std::pair("frame.upper_chock_stiffness", stand.frame.upper_chock_stiffness),
          std::pair("frame.lower_chock_stiffness", stand.frame.lower_chock_stiffness)})
      if (key == chock && std::isinf(stiffness))
        return {};
    for (const Replacement &drawn : replaced)
      if (drawn.key == key)
        return drawn.inputs;
    return {key};
  };
  Keys all;
  for (const std::string &key : keys)
    all = joined(std::move(all), drawn_as(key));
  return all;
}

std::map<std::string, Keys> given_springs(const FourHigh &stand)
{
  std::map<std::string, Keys> keys;
  for (const char *name : {"K1", "K7", "K_ZW"})
    if (const auto given = stand.given.find(name); given != stand.given.end()) {
      const Keys &inputs = given->second.parameter.inputs;
      keys[name]         = inputs.empty() ? Keys{std::string("given.") + name} : inputs;
    }
  return keys;
}

Keys closure_keys(const FourHigh &stand)
{
  if (!is_closed(stand.frame))
    return {};
  return joined(Keys{"frame.modulus"}, keys_in("steel", "youngs_modulus poisson_ratio"),
                keys_in("work_roll", "barrel_diameter barrel_length"),
                stand.passes.empty() ? Keys() : load_keys(stand.passes.front(), 0));
}

std::array<Keys, 13> chain_keys(const SpringKeys &s, const bool solid)
{
  // A given spring replaces what it is made of, in the load path too.
  const auto or_given = [&](const char *name, const Keys &keys) {
    const auto given = s.given.find(name);
    return given == s.given.end() ? keys : given->second;
  };
  const Keys beam = backup_roll_keys(solid);
  Keys K1 = keys_in("frame", "upper_post_stiffness upper_beam_stiffness piston_stiffness upper_packing_stiffness");
  Keys K2 = joined(keys_in("frame", "oil_column_stiffness cylinder_body_stiffness upper_chock_stiffness"),
                   s.K_Zy_upper, or_given("K_ZW", beam));
  Keys K6 = joined(keys_in("frame", "lower_chock_stiffness"), s.K_Zy_lower, or_given("K_ZW", beam));
  Keys K7 =
      keys_in("frame", "lower_post_stiffness lower_beam_stiffness lower_packing_stiffness load_cell_stiffness");

  if (!s.closure.empty()) {
    const Keys path = joined(s.closure, K1, K2, s.K3, s.K5, K6, K7);
    for (Keys *spring : {&K1, &K2, &K6, &K7})
      *spring = joined(std::move(*spring), path);
  }

  const Keys upper_path = or_given("K1", K1), lower_path = or_given("K7", K7);
  const Keys density = keys_in("steel", "density");
  // A given K_ZW scales a beam, whose shape then no longer depends on its modulus.
  Keys drawn = beam;
  if (s.given.count("K_ZW"))
    drawn.erase(std::remove(drawn.begin(), drawn.end(), "steel.youngs_modulus"), drawn.end());
  const Keys shape  = joined(drawn, or_given("K_ZW", {}));
  const Keys backup = joined(shape, keys_in("backup_roll", "neck_length bearing_mass"), density);
  const Keys work =
      joined(roll_body_keys("work_roll"), keys_in("strip", "width"), density, Keys{"steel.youngs_modulus"}, shape);
  // The masses of a drawn housing are reduced to where the chain has its point.
  const Keys M1 = joined(keys_in("frame", "upper_post_mass upper_beam_mass upper_packing_mass piston_mass"),
                         s.drawn_housing ? upper_path : Keys{});
  const Keys M2 = joined(backup, keys_in("backup_roll", "chock_mass_upper"),
                         keys_in("frame", "cylinder_mass balance_mass"), upper_path, K2);
  const Keys M3 = joined(work, keys_in("work_roll", "chock_mass_upper"), s.K3, upper_path, K2);
  const Keys M4 = joined(work, keys_in("work_roll", "chock_mass_lower"), s.K5, lower_path, K6);
  const Keys M5 = joined(backup, keys_in("backup_roll", "chock_mass_lower"), lower_path, K6);
  const Keys M6 = joined(keys_in("frame", "lower_post_mass lower_beam_mass load_cell_mass lower_packing_mass"),
                         s.drawn_housing ? lower_path : Keys{});
  return {M1, M2, M3, M4, M5, M6, K1, K2, s.K3, s.K4, s.K5, K6, K7};
}
}  // namespace mill::reduce
