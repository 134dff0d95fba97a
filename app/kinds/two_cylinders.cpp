#include "core/model/two_cylinders.h"
#include "app/run/run_kind.h"
#include "app/stages/contact/body_pair.h"
#include "app/stages/contact/contact_stage.h"
#include "app/trace/closed_form_chain.h"
#include "core/model/case.h"
#include <nlohmann/json.hpp>

namespace mill {
const RunKind &run_kind(const TwoCylinders &)
{
  static const RunKind kind = [] {
    RunKind k;
    k.verbs  = {Verb::run, Verb::stiffness};
    k.check  = check_tilt;
    k.stages = [](const Case &the_case) -> std::vector<std::pair<std::string, double>> {
      const auto &pair = std::get<TwoCylinders>(the_case.spec);
      if (pair.in_space)
        return {{"contact space", 1}};
      std::vector<std::pair<std::string, double>> stages;
      const PlaneEngine engine = plane_engine(pair);
      for (int cylinder = 0; cylinder < (engine == PlaneEngine::two_cylinders ? 2
                                         : engine == PlaneEngine::half_planes ? 0
                                                                              : 1);
           ++cylinder) {
        stages.emplace_back("condensation", 1);
        stages.emplace_back("condensation", 3);
      }
      stages.emplace_back("contact line", 1);
      return stages;
    };
    k.run = [](RunContext &run, Goal, const std::string &) {
      solve_cylinders(run, std::get<TwoCylinders>(run.the_case.spec));
    };
    k.describe = [](const Case &the_case, nlohmann::ordered_json &manifest) {
      const auto &pair     = std::get<TwoCylinders>(the_case.spec);
      manifest["geometry"] = nlohmann::ordered_json::object();
      if (!pair.upper.plane())
        manifest["geometry"]["upper_diameter"] = pair.upper.diameter;
      if (!pair.lower.plane())
        manifest["geometry"]["lower_diameter"] = pair.lower.diameter;
    };
    k.trace = [](const Case &the_case, ClosedFormMemory &memory, const std::map<std::string, double> &) {
      return closed_form_cylinders(std::get<TwoCylinders>(the_case.spec),
                                   wanted_keys(memory, the_case.spec).get());
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
