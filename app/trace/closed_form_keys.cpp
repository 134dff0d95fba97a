#include "app/trace/closed_form_keys.h"

namespace mill {
namespace {
// Drawing of a roll with what sits on its ends.
KeyList roll_keys(const std::string &section, const std::string &chock)
{
  return joined(KeyList{"steel.density"}, roll_body_keys(section), keys_in(section, chock));
}

Station spring(const char *equation, const std::string &from)
{
  return {"springs in series", "reduce/chain/spring_chain", equation, words_of(from), {}};
}

Station mass(const char *equation, const std::string &from, const KeyList &own_keys)
{
  return {"mass moving with the static shape", "reduce/chain/equivalent_mass", equation, words_of(from), own_keys};
}

KeyList work_roll_keys(const std::string &chock)
{
  return joined(roll_keys("work_roll", chock), keys_in("strip", "width"), keys_in("steel", "youngs_modulus"));
}
}  // namespace

Station station_of(const std::string &name, const MassReference reference)
{
  if (name == "K_ZW")
    return {"bending and shear of the backup roll", "reduce/chain/beam_shapes",
            reference == MassReference::mean ? "(4.8b)" : "(4.8a)"};
  if (name == "K1")
    return spring("(4.1a)", "");
  if (name == "K2")
    return spring("(4.1b)", "K_Zy K_ZW");
  if (name == "K6")
    return spring("(4.1c)", "K_Zy_lower K_ZW");
  if (name == "K7")
    return spring("(4.1d)", "");
  if (name == "M2")
    return mass(
        "(4.14)", "K1 K_Zy K_ZW K2",
        joined(roll_keys("backup_roll", "chock_mass_upper"), keys_in("frame", "cylinder_mass balance_mass")));
  if (name == "M3")
    return mass("(4.16)", "K1 K2 K3", work_roll_keys("chock_mass_upper"));
  if (name == "M4")
    return mass("(4.16)", "K7 K6 K5", work_roll_keys("chock_mass_lower"));
  if (name == "M5")
    return mass("(4.15)", "K7 K_Zy_lower K_ZW K6", roll_keys("backup_roll", "chock_mass_lower"));
  return {"sum of reduced masses", "reduce/chain/equivalent_mass", "(4.13)"};
}
}  // namespace mill
