#include "app/kinds/kind_inputs.h"
#include "app/kinds/manifest_parts.h"
#include "app/run/run_kind.h"
#include "app/stages/bearing/bearing_stage.h"
#include "app/trace/closed_form_parts.h"
#include "core/case/kinds.h"
#include "core/case/stand_rows.h"
#include <nlohmann/json.hpp>
#include <utility>

namespace mill {
namespace {
std::optional<KeyList> inputs_of(const BearingCase &spec, const Results &, const std::string &name)
{
  KeyList keys = bearing_case_keys(spec);
  if (ends(name, ".film.least_speed"))
    return joined(keys, keys_in("bearing." + spec.load.bearing, "roughness"));
  if (begins(name, "bearing.") && !oil_film_of(spec.oil_films, spec.load.bearing))
    keys = joined(std::move(keys), rating_keys(bearing_of(spec.bearings, spec.load.bearing)));
  if (!begins(name, "Kzc.motion."))
    return keys;
  KeyList motion = keys_in("load", "loads samples");  // the mass swings on the curve
  for (const Row &row : rows_of(bearing_motion_rows()))
    motion.push_back("dynamics." + row.key);
  return joined(keys, motion);
}
}  // namespace

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
    k.inputs = [](const Case &the_case, const Results &results, const std::string &name) {
      return inputs_of(std::get<BearingCase>(the_case.spec), results, name);
    };
    k.trace = [](const Case &the_case, ClosedFormMemory &, const std::map<std::string, double> &) {
      return closed_form_bearing_case(std::get<BearingCase>(the_case.spec));
    };
    return k;
  }();
  return kind;
}
}  // namespace mill
