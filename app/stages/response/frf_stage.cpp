#include "app/stages/response/frf_stage.h"
#include "app/run/curve_files.h"
#include "app/stages/stand/mode_results.h"
#include "core/case/moving_keys.h"
#include "core/records/csv.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_response.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
const char *const bite = "bite";

std::string force_name(const dynamics::RespondingModel &model, const std::size_t force)
{
  return force == 0 ? bite : model.places[force - 1];
}

std::string word_of_place(std::string name)
{
  std::replace_if(
      name.begin(), name.end(), [](const char c) { return c == ' ' || c == '-'; }, '_');
  return name;
}

void write_responses(RunContext &run, const dynamics::RespondingModel &model)
{
  for (std::size_t force = 0; force < model.response.size(); ++force) {
    Table table;
    table.add("frequency", "Hz", model.frequency);
    for (std::size_t p = 0; p < model.places.size(); ++p) {
      const auto a = model.response[force].col(Eigen::Index(p));
      table.add(slug(model.places[p]) + "_real", "1/kg", a.real());
      table.add(slug(model.places[p]) + "_imag", "1/kg", a.imag());
    }
    write_curve(run, curve::frf, model.model->name + "-" + slug(force_name(model, force)), table);
  }
}

void write_band(RunContext &run, const dynamics::RespondingModel &model, const dynamics::ResponseBand &band)
{
  Table table;
  table.add("frequency", "Hz", model.frequency);
  for (std::size_t p = 0; p < model.places.size(); ++p) {
    table.add(slug(model.places[p]) + "_low", "1/kg", band.low.col(Eigen::Index(p)));
    table.add(slug(model.places[p]) + "_high", "1/kg", band.high.col(Eigen::Index(p)));
  }
  write_curve(run, curve::frf_band, model.model->name + "-" + bite, table);
}

// The natural frequency behind a peak, with its error; nullptr: none within a half-power bandwidth.
const Parameter *mode_at(const RunContext &run, const StandModel &model, const GapState named,
                         const double frequency, const double damping)
{
  const Parameter *best = nullptr;
  for (std::size_t i = 0; const Parameter *f = run.find(frequency_result(model, i, named)); ++i)
    if (!best || std::abs(f->value - frequency) < std::abs(best->value - frequency))
      best = f;
  return best && std::abs(best->value - frequency) < std::max(damping, 1e-3) * frequency ? best : nullptr;
}

void add_peak(RunContext &run, const dynamics::ResponseStudy &study, const dynamics::StudiedPeak &studied,
              const DynamicsSettings &dynamics, const RespondingStand &stand)
{
  const auto &first = study.models.front();
  const auto &peak  = studied.peak;
  Parameter p;
  p.value     = peak.magnitude;
  p.unit      = "1/kg";
  p.method    = fmt::format("{}, sum over {} modes (32.3), {:g} % damping, largest between {:.4g} and {:.4g} Hz",
                            title_of(first.model->name), first.modal.frequency.size(), 100 * dynamics.modal_damping,
                            study.range[0], study.range[1]);
  p.at        = stand.at;
  p.inputs    = joined(stand.inputs, frequency_response_keys(*run.keys));
  Parameter f = p;
  p.error_estimate = studied.error;
  p.error_lacks    = study.lacks;
  p.checks.push_back(
      {"solution without modes (32.1), damping by a matrix root (32.5)", studied.direct, "at the same frequency"});
  f.value = peak.frequency;
  f.unit  = "Hz";
  if (const Parameter *mode = mode_at(run, *first.model, stand.named, peak.frequency, dynamics.modal_damping)) {
    f.error_estimate = mode->error_estimate;
    f.error_lacks    = mode->error_lacks;
    f.checks.push_back({"natural frequency nearby", mode->value, "undamped"});
  } else
    f.error_lacks = {"no mode within its bandwidth"};
  for (std::size_t m = 0; m < studied.others.size(); ++m)
    if (const auto &other = studied.others[m]; !std::isnan(other.frequency)) {
      const std::string title = title_of(study.models[m + 1].model->name);
      p.checks.push_back({title, other.magnitude, "its own largest"});
      f.checks.push_back({title, other.frequency, "of its own largest"});
    }
  const std::string excited = word_of_place(force_name(first, studied.force)),
                    seen    = word_of_place(first.places[studied.place]);
  run.results.add(row::response::frf_peak.of(excited, seen), p);
  run.results.add(row::response::frf_frequency.of(excited, seen), f);
}
}  // namespace

void add_frequency_responses(RunContext &run, const FrequencyResponseSettings &settings,
                             const DynamicsSettings &dynamics, const RespondingStand &stand)
{
  StageTimer timer(run, "frequency response");
  const auto study = dynamics::response_study(stand, settings, dynamics.modal_damping);
  for (const auto &model : study.models)
    write_responses(run, model);
  if (!(dynamics.modal_damping > 0))
    run.assume("without modal damping the frequency response is infinite at every mode: frf.* has no peaks");
  if (study.uncertain)
    write_band(run, study.models.front(), study.band);
  for (const auto &peak : study.peaks)
    add_peak(run, study, peak, dynamics, stand);
}
}  // namespace mill
