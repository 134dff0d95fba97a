#include "app/stages/result_inputs.h"
#include "app/case_kinds.h"
#include "core/records/provenance.h"
#include <optional>

namespace mill {
void set_inputs(Results &results, const Case &the_case)
{
  for (auto &[name, parameter] : results.values)
    if (const auto keys = run_kind(the_case).inputs(the_case, results, name))
      parameter.inputs = *keys;
}

std::vector<std::string> beside_the_chain(const Case &the_case, const std::string &key)
{
  std::vector<std::string> names{"K3.friction_tangent", "K3.path_plateau", "K5.friction_tangent",
                                 "K5.path_plateau",     "K4.path_plateau", "Kzc.motion.frequency"};
  std::vector<std::string> found;
  for (const std::string &name : names) {
    const auto keys = run_kind(the_case).inputs(the_case, Results(), name);
    if (keys && holds(*keys, key))
      found.push_back(name);
  }
  return found;
}

void set_inputs(reduce::ChainInputs &springs, const FourHigh &stand, const std::size_t pass)
{
  springs.K3.inputs         = contact_keys(stand, "upper", pass);
  springs.K5.inputs         = contact_keys(stand, "lower", pass);
  springs.K4.inputs         = bite_keys({stand.strip, stand.bite, pass, "work_roll.barrel_diameter"});
  springs.K_Zy_upper.inputs = seat_keys(stand, 0, pass);
  springs.K_Zy_lower.inputs = seat_keys(stand, 3, pass);
  for (std::size_t i = 0; i < springs.Kzc.size(); ++i) {
    springs.Kzc[i].inputs        = seat_keys(stand, i, pass);
    springs.Kzc_across[i].inputs = seat_across_keys(stand, i, pass);
  }
}
}  // namespace mill
