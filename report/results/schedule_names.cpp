#include "report/results/names.h"
#include <map>

namespace mill::report {
std::string schedule_meaning(const std::string &quantity)
{
  static const std::map<std::string, std::string> words{
      {"flow_stress", "flow stress, fitted with flattened rolls"},
      {"flow_stress_unflattened", "flow stress, fitted with rigid rolls"},
      {"flattened_radius", "flattened radius"},
      {"friction", "friction by its law"},
      {"deformation_power", "power of homogeneous deformation"},
      {"deformation_torque", "torque of homogeneous deformation, one roll"},
      {"dynamic_force", "dynamic force by one constant for all passes"},
      {"force_per_displacement", "force per displacement of a work roll"},
      {"hardening_stress", "hardening law of all passes, shear stress at strain 1"},
      {"hardening_exponent", "hardening law of all passes, exponent"},
      {"dynamic_constant", "constant of the dynamic force, all passes"}};
  const auto match = words.find(quantity);
  return match == words.end() ? "" : match->second;
}
}  // namespace mill::report
