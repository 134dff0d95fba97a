#include "app/stages/stand/headline.h"
#include "app/stages/stand/mode_results.h"
#include <algorithm>
#include <cmath>
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

namespace {
constexpr double least_share = 0.04;  // of the static compliance of the gap: a mode that the strip feels

// Share of each mode in the static compliance of the gap.
Eigen::VectorXd gap_shares(const reduce::StandWithModes &stand)
{
  const Eigen::VectorXd g =
      (stand.modes.shape.transpose() * stand.model.b).cwiseQuotient(stand.modes.frequency).cwiseAbs2();
  return g / g.sum();
}
}  // namespace

std::string six_mass_gap_error(const reduce::StandWithModes &detailed, const reduce::StandWithModes &chain,
                               const double limit)
{
  const Eigen::VectorXd share = gap_shares(detailed);
  const auto pairs =
      reduce::pair_modes(reduce::mac_with_chain(detailed, chain), detailed.modes.frequency, chain.modes.frequency);
  const Eigen::VectorXd of_chain = gap_shares(chain);
  double worst = 0, here = 0, there = 0;
  const auto compare = [&](const Eigen::Index of_six, const Eigen::Index exact) {
    const double f = chain.modes.frequency[of_six], g = detailed.modes.frequency[exact];
    if (g <= limit && std::abs(f / g - 1) > std::abs(worst)) {
      worst = f / g - 1;
      here  = f;
      there = g;
    }
  };
  for (const reduce::ModePair &pair : pairs)
    if (pair.other >= 0 && of_chain[pair.mode] >= least_share && share[pair.other] >= least_share)
      compare(pair.mode, pair.other);
  Eigen::Index leading = 0, of_detailed = 0;
  of_chain.maxCoeff(&leading);
  share.maxCoeff(&of_detailed);
  const bool paired = std::any_of(pairs.begin(), pairs.end(), [&](const reduce::ModePair &pair) {
    return pair.mode == leading && pair.other >= 0;
  });
  if (!paired)  // the two that yield most are compared
    compare(leading, of_detailed);
  if (std::abs(worst) <= reduce::right_frequency)
    return "";
  return fmt::format(
      "six masses put a mode of the gap at {:.1f} Hz, {} at {:.1f} Hz: {:+.1f} %; take the detailed "
      "model unless six masses are what you need",
      here, title_of(detailed.model.name), there, 100 * worst);
}

std::string six_mass_gap_error(const StandModels &models, const double limit)
{
  return six_mass_gap_error(best_model(models), models.chain, limit);
}
}  // namespace mill
