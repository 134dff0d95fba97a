#include "app/stages/stand/headline.h"
#include "app/stages/stand/mode_results.h"
#include "reduce/stand/mode_names.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double share_felt = 0.04;  // of the static compliance of the gap: a mode that the strip feels

std::string frequency_text(const Eigen::VectorXd &all, const int mode)
{
  return mode < 0 ? "-" : fmt::format("{:.1f}", all[mode]);
}

int partner(const std::vector<reduce::ModePair> &pairs, const Eigen::Index mode)
{
  for (const reduce::ModePair &pair : pairs)
    if (pair.mode == mode)
      return pair.other;
  return -1;
}

// The mode of the same name; -1: none.
int mode_named(const reduce::StandWithModes &stand, const std::string &key)
{
  for (std::size_t i = 0; i < stand.names.size(); ++i)
    if (!key.empty() && stand.names[i].key == key)
      return int(i);
  return -1;
}

// One line: with the strip, without it, share of the gap, name, six masses.
std::string mode_line(const std::string &rolling, const std::string &open, const reduce::ModeName &name,
                      const std::string &six_masses)
{
  return fmt::format("{:>10} {:>9} {:>6.1f} %  {:<48} {:>8}\n", rolling, open, 100 * name.gap_share, name.name,
                     six_masses);
}
}  // namespace

const reduce::StandWithModes &best_model(const StandModels &models)
{
  for (const auto *model : {&models.craig_bampton, &models.beam})
    if (model->modes.frequency.size() > 0)
      return *model;
  return models.chain;
}

std::string headline(const StandStates &states, const double limit)
{
  const StandModels &models          = states.named().models;
  const reduce::StandWithModes &best = best_model(models), &open = best_model(states.open.models);
  const Eigen::VectorXd &f = best.modes.frequency;
  std::string text =
      fmt::format("modes below {:g} Hz: {}, compared with the six masses\n", limit, title_of(best.model.name));
  text += states.rolling ? fmt::format("{:>10} {:>9} {:>8}  {:<48} {:>8}\n", "rolling Hz", "open Hz", "of gap",
                                       "mode", "6 masses")
                         : "open stand: K4 is not known\n";
  int folded = 0;
  for (Eigen::Index i = 0; i < f.size() && f[i] <= limit; ++i) {
    const reduce::ModeName &name = best.names.at(std::size_t(i));
    if (!name.listed) {
      ++folded;
      continue;
    }
    text += mode_line(frequency_text(f, int(i)),
                      states.rolling ? frequency_text(open.modes.frequency, mode_named(open, name.key)) : "", name,
                      frequency_text(models.chain.modes.frequency, partner(models.verdict.pairs, i)));
  }
  for (std::size_t i = 0;
       states.rolling && i < open.names.size() && open.modes.frequency[Eigen::Index(i)] <= limit; ++i)
    if (open.names[i].listed && mode_named(best, open.names[i].key) < 0)
      text += mode_line("-", frequency_text(open.modes.frequency, int(i)), open.names[i], "");
  if (folded > 0)
    text += fmt::format("{} further modes that neither gap nor sensors see\n", folded);
  if (!models.verdict.sentences.empty())
    text += models.verdict.sentences.front() + "\n";
  return text;
}

std::optional<Warning> six_mass_gap_error(const reduce::StandWithModes &detailed,
                                          const reduce::StandWithModes &chain, const double limit)
{
  const Eigen::VectorXd share = reduce::gap_shares(detailed);
  const auto pairs =
      reduce::pair_modes(reduce::mac_with_chain(detailed, chain), detailed.modes.frequency, chain.modes.frequency);
  const Eigen::VectorXd of_chain = reduce::gap_shares(chain);
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
    if (pair.other >= 0 && of_chain[pair.mode] >= share_felt && share[pair.other] >= share_felt)
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
    return {};
  return Warning{WarningId::six_mass_gap_mode,
                 "",
                 fmt::format("six masses put a mode of the gap at {:.1f} Hz, {} at {:.1f} Hz: {:+.1f} %", here,
                             title_of(detailed.model.name), there, 100 * worst),
                 "",
                 "take the detailed model unless six masses are what you need",
                 {},
                 "dynamics.model"};
}

std::optional<Warning> six_mass_gap_error(const StandModels &models, const double limit)
{
  return six_mass_gap_error(best_model(models), models.chain, limit);
}
}  // namespace mill
