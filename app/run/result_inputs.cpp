#include "app/run/result_inputs.h"
#include "core/base/require.h"
#include "core/case/contact_inputs.h"
#include "core/case/moving_keys.h"
#include "core/case/provenance.h"
#include "core/model/case.h"
#include "core/records/chain_number.h"
#include "core/records/contact_name.h"
#include "core/records/rows_of_bearing.h"
#include "core/records/rows_of_bite.h"
#include "core/records/rows_of_contact.h"
#include <optional>
#include <utility>
#include <variant>

namespace mill {
std::vector<std::string> results_outside_the_chain(const Case &the_case, const std::string &key)
{
  MovingKeys keys(the_case.spec);
  std::vector<std::string> reached;
  const auto add = [&](const std::string &name, const KeyList &inputs) {
    if (holds(inputs, key))
      reached.push_back(name);
  };
  const bool stand = std::holds_alternative<FourHigh>(the_case.spec);
  if (stand)
    for (const ContactName contact : {ContactName::upper, ContactName::lower}) {
      const char *K = word_of(contact == ContactName::upper ? ChainNumber::K3 : ChainNumber::K5);
      add(row::roll_contact::friction_tangent.of(K),
          contact_keys(keys, word_of(contact), 0, ContactReading::friction));
      add(row::roll_contact::path_plateau.of(K), contact_keys(keys, word_of(contact), 0, ContactReading::path));
    }
  if (stand || std::holds_alternative<BiteCase>(the_case.spec)) {
    BiteReading path;
    path.path_trim = true;
    add(row::bite_spring::path_plateau.of(), bite_keys(keys, 0, path));
  }
  if (std::holds_alternative<BearingCase>(the_case.spec))
    add(row::motion::frequency.of(), bearing_case_keys(keys, {false, false, true}));
  if (stand || std::holds_alternative<Lumped>(the_case.spec)) {
    add("frf.bite.upper_work_roll.peak", frequency_response_keys(keys));
    add("campbell.gap_first_kind.speed", campbell_keys(keys));
  }
  return reached;
}

void set_inputs(reduce::ChainInputs &springs, const FourHigh &stand, const std::size_t pass, MovingKeys &keys)
{
  // What is given was not solved; half of K_Zy is the bearing of its seat.
  const auto given_as = [](const NamedSpring &spring) {
    return spring.number == ChainNumber::K_Zy         ? ChainNumber::Kzc1
           : spring.number == ChainNumber::K_Zy_lower ? ChainNumber::Kzc4
                                                      : spring.number;
  };
  reduce::each_spring(
      [&](const std::string &name, Parameter &parameter) {
        const auto spring = spring_named(name);
        require(spring.has_value(), "no keys are known for the spring " + name);
        const ChainNumber seat = given_as(*spring);
        if (!is_bearing(word_of(seat)) || !stand.given.count(word_of(seat)))
          parameter.inputs = spring_keys(keys, *spring, pass);
      },
      springs);
}
}  // namespace mill
