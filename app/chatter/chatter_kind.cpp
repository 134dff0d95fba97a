#include "app/chatter/chatter_stage.h"
#include "app/kinds/mark_sources.h"
#include "app/run/run_kind.h"
#include "app/trace/closed_form_chain.h"
#include "core/case/moving_keys.h"
#include "core/model/case.h"
#include <nlohmann/json.hpp>

namespace mill {
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
    k.trace = [](const Case &the_case, ClosedFormMemory &memory, const std::map<std::string, double> &) {
      return closed_form_chatter(std::get<ChatterCase>(the_case.spec), wanted_keys(memory, the_case.spec).get());
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
