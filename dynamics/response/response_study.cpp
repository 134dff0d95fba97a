#include "dynamics/response/response_study.h"
#include "core/base/errors.h"
#include "core/model/dynamics_settings.h"
#include "core/numerics/root_search.h"
#include "core/records/key_list.h"
#include "reduce/stand/mode_names.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill::dynamics {
namespace {
std::array<double, 2> range_of_response(const FrequencyResponseSettings &settings, const StandInModels &stand)
{
  if (!std::isnan(settings.range[0]))
    return settings.range;
  const Eigen::VectorXd &modes = stand.models.front()->modes.frequency;
  const double low             = 0.5 * modes[0];
  return {low, std::isnan(stand.limit) ? 1.5 * modes[modes.size() - 1] : std::max(stand.limit, 2 * low)};
}

Eigen::VectorXd looked_at(const ModalResponse &modal, const FrequencyResponseSettings &settings,
                          const std::array<double, 2> &range)
{
  if (std::isnan(settings.resolution))
    return frequencies_around(modal.frequency, modal.damping, range[0], range[1]);
  const double steps = std::floor((range[1] - range[0]) / settings.resolution * (1 + 1e-12));
  if (steps > most_frequencies)
    throw InputError(
        fmt::format("frequency_response.resolution = {:g} Hz asks for {:.0f} frequencies between {:g} "
                    "and {:g} Hz; at most {:.0f} are computed, raise it or give a range",
                    settings.resolution, steps, range[0], range[1], most_frequencies));
  return Eigen::VectorXd::LinSpaced(Eigen::Index(steps) + 1, range[0], range[0] + steps * settings.resolution);
}

RespondingModel responding_model(const StandModel &model, const double damping, const double gap_damper)
{
  RespondingModel r;
  r.model = &model;
  r.pushed.push_back(model.b);
  for (const StandPoint *place : reduce::measured_places(model)) {
    r.places.push_back(place->name);
    r.seen.push_back(place->row);
    r.pushed.push_back(place->row);
  }
  const auto all = reduce::stand_modes(model);
  r.modal        = modal_response(model, all.frequency, all.shape, r.seen, r.pushed, damping, gap_damper);
  return r;
}

ModalResponse for_force(const ModalResponse &modal, const std::size_t force)
{
  ModalResponse one = modal;
  one.pushed        = modal.pushed.row(Eigen::Index(force));
  return one;
}

Eigen::MatrixXcd response_to(const RespondingModel &model, const std::size_t force)
{
  const ModalResponse one = for_force(model.modal, force);
  Eigen::MatrixXcd all(model.frequency.size(), Eigen::Index(model.places.size()));
  for (Eigen::Index i = 0; i < all.rows(); ++i)
    all.row(i) = accelerance(one, model.frequency[i]).transpose();
  return all;
}

// Between the frequencies of the model around the largest sample.
ResponsePeak peak_of(const RespondingModel &model, const std::size_t force, const std::size_t place)
{
  const Eigen::VectorXd size = model.response[force].col(Eigen::Index(place)).cwiseAbs();
  Eigen::Index best          = -1;
  for (Eigen::Index i = 1; i + 1 < size.size(); ++i)
    if (size[i] >= size[i - 1] && size[i] >= size[i + 1] && (best < 0 || size[i] > size[best]))
      best = i;
  if (best < 0)
    return {};
  ModalResponse one = for_force(model.modal, force);
  one.seen          = model.modal.seen.row(Eigen::Index(place));
  const auto [frequency, negative] =
      minimum_between(model.frequency[best - 1], model.frequency[best + 1],
                      [&](const double f) { return -std::abs(accelerance(one, f)(0, 0)); });
  return {frequency, -negative};
}

// (modes) relative errors that belong to no input, zero where there is none; a mode whose error is not known is
// named, as an input is.  Six masses have neither mesh nor modes left out.
Eigen::VectorXd known_mode_errors(const reduce::StandWithModes &stand, std::vector<std::string> &lacks)
{
  const bool chain      = stand.model.name == word_of(StandModelKind::six_mass);
  Eigen::VectorXd error = stand.modes.error_estimate;
  for (Eigen::Index i = 0; i < error.size(); ++i) {
    if (!std::isnan(error[i]))
      continue;
    error[i] = 0;
    if (!chain)
      lacks.push_back(fmt::format("the mode at {:.4g} Hz", stand.modes.frequency[i]));
  }
  return error;
}

// The band of the first model, and what states no error.
void add_band(ResponseStudy &study, const StandInModels &stand, const FrequencyResponseSettings &settings)
{
  std::vector<UncertainInput> inputs;
  for (const reduce::ModalSensitivity &input : stand.uncertain)
    if (std::isnan(input.error))
      study.lacks = joined(std::move(study.lacks), input.lacks);
    else
      inputs.push_back({input.error, input.dK, input.dM});
  const auto mode_error = known_mode_errors(*stand.models.front(), study.lacks);
  BandSettings sampling;
  if (std::isnan(settings.damping_tolerance))
    study.lacks.push_back("frequency_response.damping_tolerance");
  else
    sampling.damping_error = settings.damping_tolerance;
  const RespondingModel &first = study.models.front();
  study.band      = response_band(first.modal, mode_error.size(), inputs, mode_error, first.frequency, sampling);
  study.uncertain = !inputs.empty() || mode_error.maxCoeff() > 0 || sampling.damping_error > 0;
}

std::vector<ResponsePeak> companion_peaks(const std::vector<RespondingModel> &models, const std::string &place)
{
  std::vector<ResponsePeak> peaks(models.size() - 1);
  for (std::size_t m = 1; m < models.size(); ++m) {
    const auto &names = models[m].places;
    const auto match  = std::find(names.begin(), names.end(), place);
    if (match != names.end())
      peaks[m - 1] = peak_of(models[m], 0, std::size_t(match - names.begin()));
  }
  return peaks;
}
}  // namespace

ResponseStudy response_study(const StandInModels &stand, const FrequencyResponseSettings &settings,
                             const double damping)
{
  ResponseStudy study;
  study.range = range_of_response(settings, stand);
  for (const auto *model : stand.models) {
    RespondingModel r = responding_model(model->model, damping, stand.gap_damper);
    r.frequency       = looked_at(r.modal, settings, study.range);
    const bool first  = study.models.empty();
    for (std::size_t force = 0; force < (first ? r.pushed.size() : 1); ++force)
      r.response.push_back(response_to(r, force));
    study.models.push_back(std::move(r));
  }
  if (!(damping > 0))
    return study;
  add_band(study, stand, settings);
  const RespondingModel &first = study.models.front();
  const DampedStand direct     = damped_stand(*first.model, damping, stand.gap_damper);
  for (std::size_t place = 0; place < first.places.size(); ++place)
    for (const std::size_t force : {std::size_t(0), place + 1}) {
      const ResponsePeak peak = peak_of(first, force, place);
      if (std::isnan(peak.frequency))
        continue;
      const auto row = Eigen::Index(place), column = Eigen::Index(force);
      study.peaks.push_back(
          {force,
           place,
           peak,
           study.lacks.empty()
               ? (study.band.peak_high(row, column) - study.band.peak_low(row, column)) / (2 * peak.magnitude)
               : not_given,
           std::abs(direct_accelerance(direct, first.seen[place], first.pushed[force], peak.frequency)),
           {}});
      if (force == 0)
        study.peaks.back().others = companion_peaks(study.models, first.places[place]);
    }
  return study;
}
}  // namespace mill::dynamics
