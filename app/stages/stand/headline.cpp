#include "app/stages/stand/headline.h"
#include "app/stages/stand/mode_results.h"
#include <fmt/format.h>

namespace mill {
const reduce::StandWithModes &best_model(const StandModels &models)
{
  for (const auto *model : {&models.craig_bampton, &models.beam})
    if (model->modes.frequency.size() > 0)
      return *model;
  return models.chain;
}

std::string headline(const StandModels &models, const double limit)
{
  const reduce::StandWithModes &best = best_model(models);
  const Eigen::VectorXd &f           = best.modes.frequency;
  std::string text =
      fmt::format("modes below {:g} Hz: {}, compared with the six masses\n", limit, title_of(best.model.name));
  for (Eigen::Index i = 0; i < f.size() && f[i] <= limit; ++i) {
    std::string six_mass = "-";
    for (const reduce::ModePair &pair : models.verdict.pairs)
      if (pair.mode == i && pair.other >= 0)
        six_mass = fmt::format("{:.1f}", models.chain.modes.frequency[pair.other]);
    const std::string name = best.names.size() > std::size_t(i) ? best.names[std::size_t(i)].name : "";
    text += fmt::format("{:>10.1f} Hz  {:<42} {:>8}\n", f[i], name, six_mass);
  }
  if (!models.verdict.sentences.empty())
    text += models.verdict.sentences.front() + "\n";
  return text;
}
}  // namespace mill
