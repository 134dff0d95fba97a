#include "core/model/two_cylinders.h"
#include "app/case_kinds.h"
#include "app/stages/contact_stage.h"
#include "app/trace/quick_parts.h"
#include "core/model/case.h"
#include <nlohmann/json.hpp>

namespace mill {
const RunKind &run_kind(const TwoCylinders &)
{
  static const RunKind kind = [] {
    RunKind k;
    k.verbs  = {"run", "stiffness"};
    k.stages = [](const Case &) -> std::vector<std::pair<std::string, double>> {
      return {
          {"condensation", 1},
          {"condensation", 3},
          {"condensation", 1},
          {"condensation", 3},
          {"contact line", 1}
      };
    };
    k.run = [](RunContext &run, Goal, const std::string &) {
      solve_cylinders(run, std::get<TwoCylinders>(run.the_case.spec));
    };
    k.describe = [](const Case &the_case, nlohmann::ordered_json &manifest) {
      const auto &pair     = std::get<TwoCylinders>(the_case.spec);
      manifest["geometry"] = {
          {"upper_diameter", pair.upper_diameter},
          {"lower_diameter", pair.lower_diameter}
      };
    };
    k.inputs = [](const Case &, const Results &, const std::string &name) -> std::optional<KeyList> {
      return cylinder_keys(name);
    };
    k.trace = [](const Case &the_case, QuickMemory &, const std::map<std::string, double> &) {
      return quick_cylinders(std::get<TwoCylinders>(the_case.spec));
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
