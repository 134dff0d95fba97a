#include "app/run/result_inputs.h"
#include "app/run/run_kind.h"
#include "core/case/moving_keys.h"
#include "core/case/provenance.h"
#include "core/model/case.h"
#include "core/records/chain_number.h"
#include "core/records/rows_of_stand.h"
#include <optional>
#include <utility>

namespace mill {
void set_inputs(Results &results, const Case &the_case)
{
  MovingKeys keys(the_case.spec);
  for (auto &[name, parameter] : results.values)
    if (auto inputs = run_kind(the_case).inputs(keys, results, name))
      parameter.inputs = std::move(*inputs);
}

std::vector<std::string> results_outside_the_chain(const Case &the_case, const std::string &key)
{
  std::vector<std::string> names{"K3.friction_tangent",
                                 "K3.path_plateau",
                                 "K5.friction_tangent",
                                 "K5.path_plateau",
                                 "K4.path_plateau",
                                 "Kzc.motion.frequency",
                                 "frf.bite.upper_work_roll.peak",
                                 "campbell.gap_first_kind.speed"};
  std::vector<std::string> reached;
  MovingKeys keys(the_case.spec);
  for (const std::string &name : names) {
    const auto inputs = run_kind(the_case).inputs(keys, Results(), name);
    if (inputs && holds(*inputs, key))
      reached.push_back(name);
  }
  return reached;
}

void set_inputs(reduce::ChainInputs &springs, const FourHigh &stand, const std::size_t pass)
{
  // What is given was not solved; half of K_Zy is the bearing of its seat.
  const auto solved = [&](const std::string &name) {
    const auto id = result_id(name);
    if (id && id->is_of(row::chain::K_Zy))
      return !stand.given.count(word_of(ChainNumber::Kzc1));
    if (id && id->is_of(row::chain::K_Zy_lower))
      return !stand.given.count(word_of(ChainNumber::Kzc4));
    return !id || !(id->is_of(row::chain::Kzc) || id->is_of(row::chain::Kzc_across)) ||
           !stand.given.count(id->place("seat"));
  };
  MovingKeys keys(stand);
  reduce::each_spring(
      [&](const std::string &name, Parameter &spring) {
        if (solved(name))
          spring.inputs = spring_keys(keys, name, pass);
      },
      springs);
}
}  // namespace mill
