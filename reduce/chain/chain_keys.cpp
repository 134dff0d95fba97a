#include "reduce/chain/chain_keys.h"
#include "core/model/four_high.h"
#include "reduce/chain/frame_closure.h"
#include <map>
#include <utility>

namespace mill::reduce {
namespace {
// What stands behind K1, K7 and K_ZW, as far as the case gives them.
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
}  // namespace

std::array<Keys, 13> chain_keys(MovingKeys &keys, const FourHigh &stand, const SpringKeys &s, const bool solid,
                                const ChainReading reading)
{
  using F          = Frame;
  const auto given = given_springs(stand);
  const auto frame = [&](const std::vector<double F::*> &parts) { return frame_keys(keys, parts, reading); };
  // A given spring replaces what it is made of, in the load path too.
  const auto or_given = [&](const char *name, const Keys &made) {
    const auto entry = given.find(name);
    return entry == given.end() ? made : entry->second;
  };
  const Keys bending = or_given("K_ZW", bent_backup_keys(keys, solid, false));
  Keys K1            = frame(
                 {&F::upper_post_stiffness, &F::upper_beam_stiffness, &F::piston_stiffness, &F::upper_packing_stiffness});
  Keys K2 = joined(frame({&F::oil_column_stiffness, &F::cylinder_body_stiffness, &F::upper_chock_stiffness}),
                   s.K_Zy_upper, bending);
  Keys K6 = joined(frame({&F::lower_chock_stiffness}), s.K_Zy_lower, bending);
  Keys K7 = frame(
      {&F::lower_post_stiffness, &F::lower_beam_stiffness, &F::lower_packing_stiffness, &F::load_cell_stiffness});

  if (is_closed(stand.frame)) {
    const Keys path = joined(closure_keys(keys), K1, K2, s.K3, s.K5, K6, K7);
    for (Keys *spring : {&K1, &K2, &K6, &K7})
      *spring = joined(std::move(*spring), path);
  }

  const Keys upper_path = or_given("K1", K1), lower_path = or_given("K7", K7);
  // A given K_ZW scales a beam, whose shape then does not depend on its modulus.
  const bool scaled = given.count("K_ZW") > 0;
  Keys shape        = joined(bent_backup_keys(keys, solid, scaled), or_given("K_ZW", {}));
  if (reading == ChainReading::run)
    shape = joined(std::move(shape), mass_shape_keys(keys));
  const auto mass = [&](const RollPlace roll, const Keys &path, const Keys &spring) {
    return joined(moving_roll_keys(keys, roll), shape, path, spring);
  };
  // The masses of a drawn housing are reduced to where the chain has its point.
  const bool drawn = stand.housing.present();
  const Keys M1 =
      joined(frame({&F::upper_post_mass, &F::upper_beam_mass, &F::upper_packing_mass, &F::piston_mass}),
             drawn ? upper_path : Keys{});
  const Keys M2 = mass(RollPlace::upper_backup, upper_path, K2);
  const Keys M3 = joined(mass(RollPlace::upper_work, upper_path, K2), s.K3);
  const Keys M4 = joined(mass(RollPlace::lower_work, lower_path, K6), s.K5);
  const Keys M5 = mass(RollPlace::lower_backup, lower_path, K6);
  const Keys M6 =
      joined(frame({&F::lower_post_mass, &F::lower_beam_mass, &F::load_cell_mass, &F::lower_packing_mass}),
             drawn ? lower_path : Keys{});
  return {M1, M2, M3, M4, M5, M6, K1, K2, s.K3, s.K4, s.K5, K6, K7};
}
}  // namespace mill::reduce
