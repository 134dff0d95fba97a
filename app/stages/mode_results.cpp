#include "app/stages/mode_results.h"
#include "core/records/result_names.h"
#include "reduce/stand/mode_names.h"
#include "reduce/stand/six_masses.h"
#include <fmt/format.h>
#include <utility>

namespace mill {
std::string frequency_result(const StandModel &model, const std::size_t mode)
{
  const std::string number = fmt::format("f{}", mode + 1);
  return model.name == "six-mass" ? number : result_name({model.name, number});
}

const char *words_of_model(const std::string &name)
{
  if (name == "six-mass")
    return "six masses";
  return name == "beam" ? "rolls as beams" : "rolls as reduced finite elements";
}

reduce::StandWithModes chain_with_modes(LumpedModel model, const DynamicsSettings &dynamics)
{
  if (dynamics.force_meaning == "measured")
    model.K[3].value = 0;
  reduce::StandWithModes s{reduce::chain_stand(model, dynamics.frame), {}};
  s.modes = reduce::stand_modes(s.model);
  return s;
}

void add_named_modes(RunContext &run, const std::vector<const reduce::StandWithModes *> &models,
                     const double limit)
{
  std::vector<std::vector<reduce::ModeName>> names;
  for (const auto *model : models)
    names.push_back(reduce::mode_names(*model));
  const reduce::StandWithModes &first = *models.front();
  for (std::size_t i = 0; i < names[0].size() && first.modes.frequency[Eigen::Index(i)] <= limit; ++i) {
    const reduce::ModeName &mode = names[0][i];
    const Parameter *frequency   = run.results.find(frequency_result(first.model, i));
    if (mode.key == "mixed" || !frequency)
      continue;
    Parameter p = *frequency;
    p.method    = mode.name + ": " + mode.decided + "; " + p.method;
    p.checks.clear();
    for (std::size_t m = 1; m < models.size(); ++m)
      for (std::size_t k = 0; k < names[m].size(); ++k)
        if (names[m][k].key == mode.key)
          p.checks.push_back({words_of_model(models[m]->model.name), models[m]->modes.frequency[Eigen::Index(k)],
                              names[m][k].decided});
    run.results.add(result_name({family::mode, mode.key, "frequency"}), p);
  }
}
}  // namespace mill
