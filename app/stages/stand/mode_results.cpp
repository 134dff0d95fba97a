#include "app/stages/stand/mode_results.h"
#include "app/run/curve_files.h"
#include "core/base/files.h"
#include "core/records/csv.h"
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

const char *title_of(const std::string &model)
{
  if (model == "six-mass")
    return "six masses";
  return model == "beam" ? "rolls as beams" : "rolls as reduced finite elements";
}

reduce::StandWithModes chain_with_modes(LumpedModel model, const DynamicsSettings &dynamics)
{
  if (dynamics.force_meaning == "measured")
    model.K[3].value = 0;
  reduce::StandWithModes s{reduce::chain_stand(model, dynamics.frame), {}};
  s.modes = reduce::stand_modes(s.model);
  s.names = reduce::mode_names(s);
  return s;
}

void add_named_modes(RunContext &run, const std::vector<const reduce::StandWithModes *> &models,
                     const double limit)
{
  const reduce::StandWithModes &best = *models.front();
  for (std::size_t i = 0; i < best.names.size() && best.modes.frequency[Eigen::Index(i)] <= limit; ++i) {
    const reduce::ModeName &mode = best.names[i];
    const Parameter *frequency   = run.results.find(frequency_result(best.model, i));
    if (mode.key == "mixed" || !frequency)
      continue;
    Parameter p = *frequency;
    p.method    = mode.name + ": " + mode.decided + "; " + p.method;
    p.checks.clear();
    for (std::size_t m = 1; m < models.size(); ++m)
      for (std::size_t k = 0; k < models[m]->names.size(); ++k)
        if (const reduce::ModeName &other = models[m]->names[k]; other.key == mode.key)
          p.checks.push_back(
              {title_of(models[m]->model.name), models[m]->modes.frequency[Eigen::Index(k)], other.decided});
    run.results.add(result_name({family::mode, mode.key, "frequency"}), p);
  }
}

void write_mode_table(RunContext &run, const reduce::StandWithModes &s)
{
  const auto n = s.modes.frequency.size();
  Table table;
  table.add("mode", "", Eigen::VectorXd::LinSpaced(n, 1, double(n))).add("frequency", "Hz", s.modes.frequency);
  for (const StandPoint &point : s.model.points) {
    Eigen::VectorXd y = s.modes.shape.transpose() * point.row;
    for (Eigen::Index i = 0; i < n; ++i) {
      double largest = 0;
      for (const StandPoint &any : s.model.points)
        largest = std::max(largest, std::abs(any.row.dot(s.modes.shape.col(i))));
      y[i] /= largest;
    }
    table.add(slug(point.name), "", y);
  }
  write_curve(run, curve::modes_of_model, s.model.name, table);
}
}  // namespace mill
