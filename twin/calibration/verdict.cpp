#include "twin/calibration/verdict.h"
#include "core/numerics/quantiles.h"
#include "twin/calibration/calibration_parts.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double upper_5_percent = 0.05, upper_permille = 0.001;  // probabilities

void add_band_refusals(std::vector<std::string> &refusals, const CalibrationInput &in, const RecordFit &fit,
                       const std::string &record)
{
  const auto [wrong, worst] = wrong_bands(fit.bands);
  if (worst)
    refusals.push_back(fmt::format(
        "in {} of {} third octaves of the {} the residual is above the noise and a model error of {:.3g} %; the "
        "worst is {:.1f} Hz of {}: {:.2f} times, limit {:.2f}",
        wrong, fit.bands.size(), record, 100 * in.model_error, worst->centre,
        in.sensors[std::size_t(worst->sensor)], worst->ratio, worst->limit));
}

/// The remedy where one damping ratio for all modes is the only thing that fails.
void add_ratio_refusal(std::vector<std::string> &refusals, const Calibration &c)
{
  if (c.with_ratios.empty())
    return;
  std::string names;
  for (const std::string &name : c.with_ratios)
    names += (names.empty() ? "" : ",") + name;
  refusals.push_back(
      "only the common damping ratio fails: with a ratio for each mode all third octaves are within "
      "their limits. Repeat with --free \"" +
      names + "\"");
}

int freed(const Calibration &c)
{
  return int(std::count_if(c.unknowns.begin(), c.unknowns.end(),
                           [](const Calibrated &u) { return moves(u) != Moves::delay; }));
}

bool any_identified(const Calibration &c)
{
  return std::any_of(c.unknowns.begin(), c.unknowns.end(),
                     [](const Calibrated &u) { return u.identified && moves(u) != Moves::delay; });
}

/// Deviance that the case exceeds with this probability by chance alone.
double by_chance(const Calibration &c, const double probability)
{
  return chi_square_above(probability, freed(c));
}

bool any_wrong(const RecordFit &fit)
{
  return std::any_of(fit.bands.begin(), fit.bands.end(), [](const BandResidual &b) { return b.wrong(); }) ||
         std::any_of(fit.levels.begin(), fit.levels.end(), [](const LevelBand &b) { return b.wrong(); });
}
}  // namespace

bool case_agrees(const Calibration &c, const RecordFit &fit_at_case, const RecordFit &check_at_case)
{
  if (!any_identified(c) || any_wrong(fit_at_case) || any_wrong(check_at_case))
    return false;
  const bool no_better = !(c.check.after < c.check.before);
  return c.case_deviance <= by_chance(c, upper_5_percent) ||
         (no_better && c.force_recorded() && c.case_deviance <= by_chance(c, upper_permille));
}

std::string agreement_words(const Calibration &c)
{
  return fmt::format(
      "the case agrees with these records already: freeing {} unknowns lowers the deviance by {:.1f}, "
      "chance alone lowers it by up to {:.1f}; no calibrated case is written",
      freed(c), c.case_deviance, by_chance(c, c.check.after < c.check.before ? upper_5_percent : upper_permille));
}

std::vector<std::string> refusals_of(const CalibrationInput &in, const Calibration &c)
{
  std::vector<std::string> refusals;
  add_band_refusals(refusals, in, c.fit, "fitted records");
  add_band_refusals(refusals, in, c.check, "check records");
  add_ratio_refusal(refusals, c);
  add_other_refusals(refusals, in, c);
  return refusals;
}

void add_other_refusals(std::vector<std::string> &refusals, const CalibrationInput &in, const Calibration &c)
{
  if (!any_identified(c))
    refusals.push_back("these records identify no unknown; --plan shows which record would identify them");
  else if (!c.agrees && !(c.check.after < c.check.before))
    refusals.push_back(fmt::format("the check records fit no better than before: misfit {:.4g}, before {:.4g}",
                                   c.check.after, c.check.before));
  for (std::size_t i = 0; i < c.unknowns.size(); ++i) {
    const Calibrated &u = c.unknowns[i];
    const double moved  = (u.estimate - in.unknowns[i].prior) / u.prior_sd;
    if (moves(u) == Moves::delay) {
      const double limit = 1 / (20 * in.high);
      if (u.sd > limit)
        refusals.push_back(fmt::format("the delay of the clocks is uncertain by {:.3g} ms; up to {:.0f} Hz "
                                       "{:.3g} ms are allowed",
                                       1e3 * u.sd, in.high, 1e3 * limit));
    } else if (std::abs(moved) > far_from_prior)
      refusals.push_back(
          fmt::format("{} would move by {:.1f} times its prior standard deviation of {:.2g} %; beyond "
                      "{:g} times the records contradict the case",
                      u.name, moved, 100 * u.prior_sd, far_from_prior));
  }
  if (c.delay && c.delay->too_large())
    refusals.push_back(c.delay->words(in.rate));
  for (const std::string &channel : in.clipped)
    refusals.push_back(channel + " is clipped");
  if (!c.scan.best.converged)
    refusals.push_back("the fit did not converge");
}
}  // namespace mill::twin
