#include "tests/manual/stand/mass_models.h"

namespace mill::verify {
reduce::LumpedStand demo_chain(const FourHigh &stand, const reduce::SolidRolls &rolls)
{
  const auto spring = [](const double value) {
    Parameter p;
    p.value = value;
    p.unit  = "N/m";
    return p;
  };
  reduce::ChainInputs in;
  in.K3 = in.K5 = spring(40191831577.696884);
  in.K4         = spring(0);
  in.K_Zy_upper = in.K_Zy_lower = spring(102286583389.26591);
  in.Kzc                        = {spring(5.11e10), spring(1.9e10), spring(1.9e10), spring(5.11e10)};
  in.at                         = "976.2 kN";
  in.solid                      = rolls;
  return reduce::lumped_stand(stand, in);
}
}  // namespace mill::verify
