#include "app/run/run_kind.h"
#include "app/stack/stack_stage.h"
#include "core/model/case.h"
#include <nlohmann/json.hpp>

namespace mill {
const RunKind &run_kind(const StackCase &)
{
  static const RunKind kind = [] {
    RunKind k;
    k.verbs  = {"run"};
    k.stages = [](const Case &) -> std::vector<std::pair<std::string, double>> { return {{"stack", 1}}; };
    k.run    = [](RunContext &run, Goal, const std::string &) {
      const auto &spec = std::get<StackCase>(run.the_case.spec);
      run_stack(run, *spec.input, *spec.stack);
    };
    k.describe = [](const Case &the_case, nlohmann::ordered_json &manifest) {
      manifest["geometry"] = nlohmann::ordered_json::object();
      for (const StackRoll &roll : std::get<StackCase>(the_case.spec).stack->rolls)
        manifest["geometry"]["roll_" + roll.name + "_diameter"] = roll.diameter;
    };
    k.inputs = [](const Case &, const Results &results, const std::string &name) -> std::optional<KeyList> {
      const Parameter *made = results.find(name);
      return made ? std::optional<KeyList>(made->inputs) : std::nullopt;
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
