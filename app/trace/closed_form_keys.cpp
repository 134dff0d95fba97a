#include "app/trace/closed_form_keys.h"
#include "core/records/chain_number.h"

namespace mill {
namespace {
Station spring(const char *equation, const std::string &from)
{
  return {"springs in series", "reduce/chain/spring_chain", equation, words_of(from), {}};
}

Station mass(const char *equation, const std::string &from, const RollPlace roll, MovingKeys *keys)
{
  return {"mass moving with the static shape", "reduce/chain/equivalent_mass", equation, words_of(from),
          keys ? moving_roll_keys(*keys, roll) : KeyList()};
}
}  // namespace

Station station_of(const std::string &name, const MassReference reference, MovingKeys *const keys)
{
  const auto number = choice_named<ChainNumber>(name);
  const Station sum{"sum of reduced masses", "reduce/chain/equivalent_mass", "(4.13)"};
  if (!number)
    return sum;
  switch (*number) {
  case ChainNumber::K_ZW:
    return {"bending and shear of the backup roll", "reduce/chain/beam_shapes",
            reference == MassReference::mean ? "(4.8b)" : "(4.8a)"};
  case ChainNumber::K1:
    return spring("(4.1a)", "");
  case ChainNumber::K2:
    return spring("(4.1b)", "K_Zy K_ZW");
  case ChainNumber::K6:
    return spring("(4.1c)", "K_Zy_lower K_ZW");
  case ChainNumber::K7:
    return spring("(4.1d)", "");
  case ChainNumber::M2:
    return mass("(4.14)", "K1 K_Zy K_ZW K2", RollPlace::upper_backup, keys);
  case ChainNumber::M3:
    return mass("(4.16)", "K1 K2 K3", RollPlace::upper_work, keys);
  case ChainNumber::M4:
    return mass("(4.16)", "K7 K6 K5", RollPlace::lower_work, keys);
  case ChainNumber::M5:
    return mass("(4.15)", "K7 K_Zy_lower K_ZW K6", RollPlace::lower_backup, keys);
  case ChainNumber::M1:
  case ChainNumber::M6:
  case ChainNumber::K3:
  case ChainNumber::K4:
  case ChainNumber::K5:
  case ChainNumber::K_Zy:
  case ChainNumber::K_Zy_lower:
  case ChainNumber::Kzc1:
  case ChainNumber::Kzc2:
  case ChainNumber::Kzc3:
  case ChainNumber::Kzc4:
    break;
  }
  return sum;
}
}  // namespace mill
