#include "app/stages/response/frf_stage.h"
#include "app/run/curve_files.h"
#include "app/stages/stand/mode_results.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/case/moving_keys.h"
#include "core/numerics/root_search.h"
#include "core/records/csv.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_response.h"
#include "dynamics/response/accelerance.h"
#include "dynamics/response/response_band.h"
#include "reduce/stand/mode_names.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill {
namespace {
const char *const bite = "bite";

// One model in all its modes, at its places.
struct Responder {
  const StandModel *model = nullptr;
  std::vector<std::string> places;  // responses; forces are the bite, then these
  std::vector<Eigen::VectorXd> seen, pushed;
  dynamics::ModalResponse modal;
  Eigen::VectorXd frequency;  // Hz, where it is looked at
};

std::string force_name(const Responder &r, const std::size_t force)
{
  return force == 0 ? bite : r.places[force - 1];
}

Responder responder_of(const StandModel &model, const DynamicsSettings &dynamics, const double gap_damper)
{
  Responder r;
  r.model = &model;
  r.pushed.push_back(model.b);
  for (const StandPoint *place : reduce::measured_places(model)) {
    r.places.push_back(place->name);
    r.seen.push_back(place->row);
    r.pushed.push_back(place->row);
  }
  const auto all = reduce::stand_modes(model);
  r.modal = dynamics::modal_response(model, all.frequency, all.shape, r.seen, r.pushed, dynamics.modal_damping,
                                     gap_damper);
  return r;
}

std::array<double, 2> range_of(const FrequencyResponseSettings &settings, const RespondingStand &stand)
{
  if (!std::isnan(settings.range[0]))
    return settings.range;
  const Eigen::VectorXd &modes = stand.models.front()->modes.frequency;
  const double low             = 0.5 * modes[0];
  return {low, std::isnan(stand.limit) ? 1.5 * modes[modes.size() - 1] : std::max(stand.limit, 2 * low)};
}

Eigen::VectorXd frequencies_of(const Responder &r, const FrequencyResponseSettings &settings,
                               const std::array<double, 2> &range)
{
  if (std::isnan(settings.resolution))
    return dynamics::frequencies_around(r.modal.frequency, r.modal.damping, range[0], range[1]);
  const double steps = std::floor((range[1] - range[0]) / settings.resolution * (1 + 1e-12));
  if (steps > most_frequencies)
    throw InputError(
        fmt::format("frequency_response.resolution = {:g} Hz asks for {:.0f} frequencies between {:g} "
                    "and {:g} Hz; at most {:.0f} are computed, raise it or give a range",
                    settings.resolution, steps, range[0], range[1], most_frequencies));
  return Eigen::VectorXd::LinSpaced(Eigen::Index(steps) + 1, range[0], range[0] + steps * settings.resolution);
}

// (f, m) of one force.
Eigen::MatrixXcd response_to(const Responder &r, const std::size_t force)
{
  dynamics::ModalResponse one = r.modal;
  one.pushed                  = r.modal.pushed.row(Eigen::Index(force));
  Eigen::MatrixXcd all(r.frequency.size(), Eigen::Index(r.places.size()));
  for (Eigen::Index i = 0; i < all.rows(); ++i)
    all.row(i) = dynamics::accelerance(one, r.frequency[i]).transpose();
  return all;
}

void write_response(RunContext &run, const Responder &r, const std::size_t force, const Eigen::MatrixXcd &a)
{
  Table table;
  table.add("frequency", "Hz", r.frequency);
  for (std::size_t p = 0; p < r.places.size(); ++p) {
    table.add(slug(r.places[p]) + "_real", "1/kg", a.col(Eigen::Index(p)).real());
    table.add(slug(r.places[p]) + "_imag", "1/kg", a.col(Eigen::Index(p)).imag());
  }
  write_curve(run, curve::frf, r.model->name + "-" + slug(force_name(r, force)), table);
}

struct Peak {
  double frequency = not_given, magnitude = not_given;
};

// Largest local maximum of the magnitude; NaN where it only rises or falls.
Peak peak_of(const Responder &r, const std::size_t force, const std::size_t place, const Eigen::VectorXcd &a)
{
  dynamics::ModalResponse one = r.modal;
  one.pushed                  = r.modal.pushed.row(Eigen::Index(force));
  one.seen                    = r.modal.seen.row(Eigen::Index(place));
  Eigen::Index best           = -1;
  for (Eigen::Index i = 1; i + 1 < a.size(); ++i)
    if (std::abs(a[i]) >= std::abs(a[i - 1]) && std::abs(a[i]) >= std::abs(a[i + 1]) &&
        (best < 0 || std::abs(a[i]) > std::abs(a[best])))
      best = i;
  if (best < 0)
    return {};
  const auto [frequency, negative] =
      minimum_between(r.frequency[best - 1], r.frequency[best + 1],
                      [&](const double f) { return -std::abs(dynamics::accelerance(one, f)(0, 0)); });
  return {frequency, -negative};
}

// What is drawn from, and what states no error.
struct Uncertain {
  std::vector<dynamics::UncertainInput> inputs;
  Eigen::VectorXd mode_error;
  KeyList lacks;
};

Uncertain uncertain_of(const RespondingStand &stand)
{
  Uncertain all;
  for (const reduce::ModalSensitivity &input : stand.uncertain)
    if (std::isnan(input.error))
      all.lacks = joined(std::move(all.lacks), input.lacks);
    else
      all.inputs.push_back({input.error, input.dK, input.dM});
  // Six masses have neither mesh nor modes left out.
  all.mode_error = stand.models.front()->modes.error_estimate.unaryExpr(
      [](const double error) { return std::isnan(error) ? 0 : error; });
  return all;
}

void write_band(RunContext &run, const Responder &r, const dynamics::ResponseBand &band)
{
  Table table;
  table.add("frequency", "Hz", r.frequency);
  for (std::size_t p = 0; p < r.places.size(); ++p) {
    table.add(slug(r.places[p]) + "_low", "1/kg", band.low.col(Eigen::Index(p)));
    table.add(slug(r.places[p]) + "_high", "1/kg", band.high.col(Eigen::Index(p)));
  }
  write_curve(run, curve::frf_band, r.model->name + "-" + bite, table);
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

// Results of one stand, model by model.
class Responses {
public:
  Responses(RunContext &run, const FrequencyResponseSettings &settings, const DynamicsSettings &dynamics,
            const RespondingStand &stand)
      : run(run), settings(settings), dynamics(dynamics), stand(stand), range(range_of(settings, stand))
  {
    for (const auto *model : stand.models) {
      all.push_back(responder_of(model->model, dynamics, stand.gap_damper));
      all.back().frequency = frequencies_of(all.back(), settings, range);
    }
  }

  void write()
  {
    const std::size_t n_forces = all[0].pushed.size();
    for (std::size_t force = 0; force < n_forces; ++force) {
      first.push_back(response_to(all[0], force));
      write_response(run, all[0], force, first.back());
    }
    for (std::size_t m = 1; m < all.size(); ++m) {
      others.push_back(response_to(all[m], 0));
      write_response(run, all[m], 0, others.back());
    }
  }

  void add_results()
  {
    if (!(dynamics.modal_damping > 0)) {
      run.assume("without modal damping the frequency response is infinite at every mode: frf.* has no peaks");
      return;
    }
    const Uncertain uncertain = uncertain_of(stand);
    dynamics::BandSettings sampling;
    sampling.damping_error = std::isnan(settings.damping_tolerance) ? 0 : settings.damping_tolerance;
    band                   = dynamics::response_band(all[0].modal, uncertain.mode_error.size(), uncertain.inputs,
                                                     uncertain.mode_error, all[0].frequency, sampling);
    if (!uncertain.inputs.empty() || uncertain.mode_error.maxCoeff() > 0 || sampling.damping_error > 0)
      write_band(run, all[0], band);
    lacks = uncertain.lacks;
    if (std::isnan(settings.damping_tolerance))
      lacks.push_back("frequency_response.damping_tolerance");
    const auto direct = dynamics::damped_stand(*all[0].model, dynamics.modal_damping, stand.gap_damper);
    for (std::size_t p = 0; p < all[0].places.size(); ++p)
      for (const std::size_t force : {std::size_t(0), p + 1})
        add_peak(direct, force, p);
  }

private:
  void add_peak(const dynamics::DampedStand &direct, const std::size_t force, const std::size_t place)
  {
    const Responder &r = all[0];
    const Peak peak    = peak_of(r, force, place, first[force].col(Eigen::Index(place)));
    if (std::isnan(peak.frequency))
      return;
    Parameter p;
    p.value  = peak.magnitude;
    p.unit   = "1/kg";
    p.method = fmt::format("{}, sum over {} modes (32.3), {:g} % damping, largest between {:.4g} and {:.4g} Hz",
                           title_of(r.model->name), r.modal.frequency.size(), 100 * dynamics.modal_damping,
                           range[0], range[1]);
    p.at     = stand.at;
    p.inputs = joined(stand.inputs, frequency_response_keys(*run.keys));
    const Eigen::Index row = Eigen::Index(place), column = Eigen::Index(force);
    if (lacks.empty())
      p.error_estimate = (band.peak_high(row, column) - band.peak_low(row, column)) / (2 * peak.magnitude);
    else
      p.error_lacks = lacks;
    p.checks.push_back(
        {"solution without modes (32.1), damping by a matrix root (32.5)",
         std::abs(dynamics::direct_accelerance(direct, r.seen[place], r.pushed[force], peak.frequency)),
         "at the same frequency"});
    Parameter f      = p;
    f.value          = peak.frequency;
    f.unit           = "Hz";
    f.error_estimate = not_given;
    f.error_lacks    = {};
    f.checks.clear();
    if (const Parameter *mode = mode_at(run, *r.model, stand.named, peak.frequency, dynamics.modal_damping)) {
      f.error_estimate = mode->error_estimate;
      f.error_lacks    = mode->error_lacks;
      f.checks.push_back({"natural frequency nearby", mode->value, "undamped"});
    } else
      f.error_lacks = {"no mode within its bandwidth"};
    add_others(p, f, force, r.places[place]);
    const std::string excited = result_word(force_name(r, force)), seen = result_word(r.places[place]);
    run.results.add(row::response::frf_peak.of(excited, seen), p);
    run.results.add(row::response::frf_frequency.of(excited, seen), f);
  }

  // What the other models make of the same pair, for the force in the bite.
  void add_others(Parameter &p, Parameter &f, const std::size_t force, const std::string &place) const
  {
    for (std::size_t m = 1; m < all.size() && force == 0; ++m) {
      const auto &names = all[m].places;
      const auto match  = std::find(names.begin(), names.end(), place);
      if (match == names.end())
        continue;
      const auto column = std::size_t(match - names.begin());
      const Peak other  = peak_of(all[m], 0, column, others[m - 1].col(Eigen::Index(column)));
      if (std::isnan(other.frequency))
        continue;
      p.checks.push_back({title_of(all[m].model->name), other.magnitude, "its own largest"});
      f.checks.push_back({title_of(all[m].model->name), other.frequency, "of its own largest"});
    }
  }

  static std::string result_word(std::string name)
  {
    std::replace_if(
        name.begin(), name.end(), [](const char c) { return c == ' ' || c == '-'; }, '_');
    return name;
  }

  RunContext &run;
  const FrequencyResponseSettings &settings;
  const DynamicsSettings &dynamics;
  const RespondingStand &stand;
  const std::array<double, 2> range;
  std::vector<Responder> all;
  std::vector<Eigen::MatrixXcd> first, others;  // of the first model by force, of the others to the bite's
  dynamics::ResponseBand band;
  KeyList lacks;
};
}  // namespace

void add_frequency_responses(RunContext &run, const FrequencyResponseSettings &settings,
                             const DynamicsSettings &dynamics, const RespondingStand &stand)
{
  StageTimer timer(run, "frequency response");
  Responses responses(run, settings, dynamics, stand);
  responses.write();
  responses.add_results();
}
}  // namespace mill
