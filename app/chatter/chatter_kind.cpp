#include "app/chatter/chatter_stage.h"
#include "app/kinds/kind_inputs.h"
#include "app/kinds/mark_sources.h"
#include "app/run/run_kind.h"
#include "app/trace/closed_form_parts.h"
#include "core/case/moving_keys.h"
#include "core/model/case.h"
#include "core/records/rows_of_bite.h"
#include "core/records/rows_of_chatter.h"
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace mill {
namespace {
std::optional<KeyList> inputs_of(const ChatterCase &spec, const std::string &name)
{
  const auto id = result_id(name);
  for (std::size_t i = 0; id && i < spec.conditions.size(); ++i) {
    if (spec.conditions[i].name != id->place("pass"))
      continue;
    const KeyList speed = keys_in(fmt::format("condition.{}", i), "speed");
    if (id->is_of(row::bite::all) || id->is_of(row::bite_model::all) || id->is_of(row::bite_slope::all))
      return joined(chatter_bite_keys(spec, i), speed);
    const KeyList searched =
        joined(chatter_bite_keys(spec, i), chatter_stand_keys(spec), keys_in("analysis", "speeds"));
    if (id->is_of(row::chatter::critical_speed) || id->is_of(row::chatter::frequency))
      return searched;
  }
  return {};
}
}  // namespace

const RunKind &chatter_kind()
{
  static const RunKind kind = [] {
    RunKind k;
    k.verbs  = {Verb::run, Verb::chatter};
    k.check  = check_conditions;
    k.stages = [](const Case &) -> std::vector<std::pair<std::string, double>> { return {{"chatter", 1}}; };
    k.run    = [](RunContext &run, Goal, const std::string &) {
      solve_chatter_case(run, std::get<ChatterCase>(run.the_case.spec));
    };
    k.mark_sources = [](const Case &the_case) { return mark_sources(std::get<ChatterCase>(the_case.spec)); };
    k.describe     = [](const Case &the_case, nlohmann::ordered_json &manifest) {
      manifest["geometry"]["work_roll_diameter"] = std::get<ChatterCase>(the_case.spec).roll_diameter;
    };
    k.files = [](const Case &the_case) {
      const auto &spec = std::get<ChatterCase>(the_case.spec);
      std::vector<std::string> files{spec.stand.from};
      if (const auto &m = spec.files)
        files.insert(files.end(), {m->mass, m->stiffness, m->force, m->readings, m->names});
      return files;
    };
    k.inputs = [](MovingKeys &keys, const std::string &name) {
      return inputs_of(std::get<ChatterCase>(keys.spec()), name);
    };
    k.trace = [](const Case &the_case, ClosedFormMemory &, const std::map<std::string, double> &) {
      return closed_form_chatter(std::get<ChatterCase>(the_case.spec));
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
