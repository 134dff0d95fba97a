#include "app/kinds/manifest_parts.h"
#include "app/run/run_kind.h"
#include "app/stages/bearing/bearing_stage.h"
#include "app/trace/closed_form_chain.h"
#include <nlohmann/json.hpp>
#include <utility>

namespace mill {
const RunKind &run_kind(const BearingCase &)
{
  static const RunKind kind = [] {
    RunKind k;
    k.verbs  = {Verb::run, Verb::stiffness};
    k.stages = [](const Case &the_case) -> std::vector<std::pair<std::string, double>> {
      return {{"roller", 3},
              {"roller", 10},
              {"rings", 20},
              {"bearing " + std::get<BearingCase>(the_case.spec).load.bearing, 4}};
    };
    k.run = [](RunContext &run, Goal, const std::string &) {
      solve_bearing_case(run, std::get<BearingCase>(run.the_case.spec));
    };
    k.describe = [](const Case &the_case, nlohmann::ordered_json &manifest) {
      add_bearings(manifest, all_bearings(the_case));
    };
    k.trace = [](const Case &the_case, ClosedFormMemory &memory, const std::map<std::string, double> &) {
      return closed_form_bearing_case(std::get<BearingCase>(the_case.spec),
                                      wanted_keys(memory, the_case.spec).get());
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
