#include "app/chatter/chatter_study.h"
#include "app/stages/stability/stability_question.h"
#include "core/base/errors.h"
#include "dynamics/chatter/loop.h"
#include "dynamics/chatter/routh.h"
#include "reduce/bite/slab/slab_bite.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace mill {
namespace {
using dynamics::ChatterStandModel;
using dynamics::StandSpeed;
using dynamics::Verdict;
using Scheme = Linearisation;

dynamics::ChatterMode least_stable_mode(const ChatterStandModel &stand, const bite::LinearCoefficients &by)
{
  return dynamics::chatter_mode(stand, by, dynamics::eigenvalues(dynamics::chatter_matrix(stand, by))[0]);
}

// A second solution of the bite for comparison; it may not exist.
std::optional<bite::BiteState> by_karman(const dynamics::WorkingPoint &point)
{
  try {
    return bite::solve_slab(point.bite, {bite::Theory::karman, bite::Arc::hitchcock, 0});
  } catch (const std::runtime_error &) {
    return {};
  }
}

// The least stable mode as a record of the linear motion shows it; a disturbance need not reach every mode.
std::optional<dynamics::RecordMode> mode_in_time(const ChatterQuestion &q, const dynamics::WorkingPoint &point,
                                                 const dynamics::ChatterMode &mode)
{
  if (!(mode.frequency > 0))
    return {};
  constexpr double rate = 10e3;  // Hz
  try {
    const auto start   = dynamics::displaced_rolls(q.stand.structure, q.analysis.disturbance);
    const auto history = dynamics::linear_history(q.stand, point.by, start, 0.6, rate);
    return dynamics::mode_near(dynamics::record_modes(history.gap, 1 / rate), mode.frequency);
  } catch (const SolverError &) {
    return {};
  }
}

OtherSearch search(const std::string &name, const ChatterStandModel &stand, const ChatterQuestion &q,
                   const Scheme scheme, const dynamics::SpeedRange &range)
{
  OtherSearch other{name, dynamics::critical_speed(stand, q.bite, scheme, range), {}};
  if (other.found.at)
    other.mode = least_stable_mode(stand, other.found.at->by);
  try {
    const auto point = dynamics::working_point(q.bite, q.condition.speed, scheme);
    other.growth     = dynamics::growth_rate(dynamics::chatter_matrix(stand, point.by));
  } catch (const std::runtime_error &) {
    // no bite at the working speed, which is reported once for the condition
  }
  return other;
}

void search_beside(ChatterStudy &s, const dynamics::SpeedRange &range)
{
  const ChatterQuestion &q = s.question;
  const Scheme chosen      = q.analysis.linearisation;
  s.schemes.push_back(search(word_of(chosen), q.stand, q, chosen, range));
  for (const Scheme scheme : every<Scheme>())
    if (scheme != chosen)
      s.schemes.push_back(search(word_of(scheme), q.stand, q, scheme, range));
  for (const NamedStand &variant : q.variants)
    s.variants.push_back(search(variant.name, variant.stand, q, q.scheme, range));
}

// The models of the stand; the first one is the most detailed and becomes the stand of the question.
void search_models(ChatterStudy &s, const dynamics::SpeedRange &range)
{
  ChatterQuestion &q = s.question;
  for (const NamedStand &structure : q.structures)
    s.structures.push_back(search(structure.name, structure.stand, q, q.scheme, range));
  if (s.structures.size() < 2)
    return;
  q.stand     = q.structures.front().stand;
  q.numbers   = q.structures.front().numbers;
  q.structure = q.structures.front().name + " model of this run, the most detailed of " +
                std::to_string(q.structures.size()) + (q.structure.empty() ? "" : ", " + q.structure);
}

// What a second method gives; an edge of the bite or a root on the axis leaves it without an answer.
template <class Value, class Method> void where_defined(Value &value, const Method &method)
{
  try {
    value = method();
  } catch (const InputError &) {
    // no steady bite so near the edge of the range
  } catch (const SolverError &) {
    // a root on the axis: the method is not defined there
  }
}

// Number of unstable roots by two methods without eigenvalues, and the critical speed by one of them.
void count_roots(ChatterStudy &s)
{
  const ChatterQuestion &q = s.question;
  if (s.working) {
    where_defined(s.routh_unstable,
                  [&] { return dynamics::unstable_roots(dynamics::chatter_matrix(q.stand, s.working->by)); });
    where_defined(s.nyquist_unstable, [&] { return dynamics::nyquist_count(q.stand, s.working->by).unstable; });
  }
  const double v = s.found.speed;
  if (s.found.verdict == Verdict::crossing)
    where_defined(s.speed_by_routh, [&] {
      return dynamics::boundary_by_routh(dynamics::matrix_at_speed(q.stand, q.bite, q.scheme), v * (1 - 1e-3),
                                         v * (1 + 1e-3));
    });
}

void follow_roots(ChatterStudy &s)
{
  std::vector<double> speeds;
  for (const auto &point : s.found.points)
    if (point.no_bite.empty())
      speeds.push_back(point.speed);
  if (speeds.empty())
    return;
  s.locus = dynamics::root_locus(dynamics::matrix_at_speed(s.question.stand, s.question.bite, s.question.scheme),
                                 Eigen::Map<const Eigen::VectorXd>(speeds.data(), Eigen::Index(speeds.size())));
}

// Three speeds around the critical one; without one the working speed alone.
void simulate_linear(ChatterStudy &s)
{
  const ChatterQuestion &q = s.question;
  std::vector<std::pair<HistorySpeed, double>> speeds;
  if (s.found.verdict == Verdict::crossing)
    speeds = {{HistorySpeed::below, 0.98 * s.found.speed},
              {HistorySpeed::at, s.found.speed},
              {HistorySpeed::above, 1.02 * s.found.speed}};
  else if (s.working)
    speeds = {{HistorySpeed::at, q.condition.speed}};
  for (const auto &[place, speed] : speeds) {
    ChatterRecord record;
    record.place = place;
    record.speed = speed;
    try {
      const auto point = dynamics::working_point(q.bite, speed, q.scheme);
      const auto root  = dynamics::eigenvalues(dynamics::chatter_matrix(q.stand, point.by))[0];
      record.growth    = root.real();
      record.history   = dynamics::linear_history(
            q.stand, point.by, dynamics::displaced_rolls(q.stand.structure, q.analysis.disturbance),
            q.analysis.duration);
      const auto modes = dynamics::record_modes(record.history.gap, 1e-4);
      if (root.imag() > 0)
        record.in_time = dynamics::mode_near(modes, root.imag() / (2 * M_PI)).growth;
    } catch (const InputError &) {
      continue;  // no steady bite so near the edge of the range
    } catch (const SolverError &) {
      if (record.history.time.size() == 0)
        continue;
    }
    s.records.push_back(std::move(record));
  }
}

// Above the critical speed, from a disturbance large enough to reach what limits the motion within the run.
void simulate_nonlinear(ChatterStudy &s)
{
  const ChatterQuestion &q = s.question;
  if (s.found.verdict != Verdict::crossing)
    return;
  s.run_speed = 1.05 * s.found.speed;
  try {
    const auto point = dynamics::working_point(q.bite, s.run_speed, q.scheme);
    dynamics::ChatterRunOptions options;
    if (q.stand.structure.n() == 6 && q.stand.structure.point.isDiagonal())  // modes have no springs to part
      options.contacts = dynamics::roll_contacts(q.stand.structure, point.state.force);
    for (const auto &contact : options.contacts)
      s.contacts.push_back(contact.name);
    s.run_force    = point.state.force;
    s.run_friction = point.state.friction;
    // Half the draft is beyond what most stands settle at: the motion comes down to its limit, which takes less
    // time than growing up to it.
    const double draft = q.condition.entry_thickness - q.condition.exit_thickness;
    const auto start   = dynamics::critical_mode(q.stand, point.by, 0.5 * draft);
    for (const double duration : {1, 2, 4}) {
      options.duration = duration;
      s.run            = dynamics::nonlinear_run(q.stand, point, q.scheme, start, options);
      s.cycle          = dynamics::limit_cycle(*s.run);
      if (s.cycle.settled || !s.run->stopped.empty())
        break;
    }
    const double end = s.cycle.amplitude / draft;
    if (!s.run->stopped.empty())
      s.remarks.push_back(fmt::format("nonlinear run at {:.4g} m/s: {}", s.run_speed, s.run->stopped));
    else if (end < 1e-4)
      s.remarks.push_back(fmt::format(
          "the nonlinear run at {:.4g} m/s, above the critical speed, decays from an amplitude of half the draft: "
          "slack strip and separating rolls take more energy than the bite supplies, so only small motions grow",
          s.run_speed));
    else if (!s.cycle.settled)
      s.remarks.push_back(fmt::format("the nonlinear run at {:.4g} m/s has not settled after {:g} s ({:.3g} um)",
                                      s.run_speed, options.duration, 1e6 * s.cycle.amplitude));
  } catch (const std::runtime_error &e) {
    s.run.reset();
    s.remarks.push_back(fmt::format("no nonlinear run at {:.4g} m/s: {}", s.run_speed, e.what()));
  }
}

Eigen::VectorXd around(const double value, const double low, const double high, const int n)
{
  return Eigen::VectorXd::LinSpaced(n, low * value, high * value);
}

// Which cells of a map are empty and why: "map of speed and reduction: 12 of 100 cells are empty, ..".
std::string empty_cells(const dynamics::StabilityMap &map)
{
  std::string causes;
  int n_empty = 0;
  for (int k = int(dynamics::NoBite::none) + 1; k < dynamics::n_no_bite; ++k)
    if (const int n = map.cells[std::size_t(k)]; n > 0) {
      n_empty += n;
      causes += fmt::format("{}{} in {}", causes.empty() ? "" : "; ", dynamics::reason_of(dynamics::NoBite(k)), n);
    }
  if (n_empty == 0)
    return "";
  return fmt::format(
      "map of speed and {}: {} of {} cells are empty because the bite has no steady state there ({})",
      dynamics::quantity_name(map.quantity), n_empty, map.growth.size(), causes);
}

std::string empty_boundary(const dynamics::StabilityMap &map)
{
  const auto n_empty = map.critical_speed.array().isNaN().count();
  if (n_empty == 0)
    return "";
  return fmt::format("boundary over {}: {} of {} cells of critical_speed are empty because no vibration begins to "
                     "grow between {:.4g} and {:.4g} m/s",
                     dynamics::quantity_name(map.quantity), n_empty, map.critical_speed.size(), map.speed[0],
                     map.speed[map.speed.size() - 1]);
}

void draw_maps(RunContext &run, ChatterStudy &s)
{
  using dynamics::MapQuantity;
  const ChatterQuestion &q = s.question;
  const int n              = q.analysis.map_points;
  if (n < 2)
    return;
  StageTimer timer(run, "chatter " + q.condition.name + ", maps");
  const Eigen::VectorXd speed = Eigen::VectorXd::LinSpaced(n, q.analysis.speeds[0], q.analysis.speeds[1]);
  std::vector<std::pair<MapQuantity, Eigen::VectorXd>> axes;
  const double reduction = dynamics::quantity_of(q.bite, MapQuantity::reduction);
  axes.emplace_back(MapQuantity::reduction, around(reduction, 0.5, std::min(1.5, 0.9 / reduction), n));
  if (q.condition.entry_tension + q.condition.exit_tension > 0)
    axes.emplace_back(MapQuantity::tension, around(1, 0.25, 1.75, n));
  if (has_film(q.bite.strip.friction))
    axes.emplace_back(MapQuantity::viscosity, around(q.bite.strip.friction.viscosity, 0.4, 2, n));
  for (const auto &[quantity, values] : axes) {
    s.maps.push_back(dynamics::stability_map(q.stand, q.bite, q.scheme, speed, quantity, values, run.threads));
    for (const std::string &sentence : {empty_cells(s.maps.back()), empty_boundary(s.maps.back())})
      if (!sentence.empty())
        s.remarks.push_back(sentence);
  }
}

void find_sensitivities(RunContext &run, ChatterStudy &s, const dynamics::SpeedRange &range)
{
  if (!s.working)
    return;
  StageTimer timer(run, "chatter " + s.question.condition.name + ", sensitivities");
  dynamics::SensitivityRequest request;
  request.scheme        = s.question.scheme;
  request.range         = range;
  request.working_speed = s.question.condition.speed;
  request.threads       = run.threads;
  try {
    s.sensitivities =
        dynamics::chatter_sensitivities(s.question.stand, s.question.numbers, s.question.bite, request);
    // Where k is a factor on the whole flow stress one of the two is enough.
    auto &inputs     = s.sensitivities->inputs;
    const auto named = [&](const char *key) {
      return std::find_if(inputs.begin(), inputs.end(), [&](const auto &one) { return one.key == key; });
    };
    const auto whole = named("strip.flow_stress"), k = named("strip.flow_stress.k");
    if (whole != inputs.end() && k != inputs.end() && std::abs(whole->force - k->force) < 1e-9)
      inputs.erase(whole);
  } catch (const std::runtime_error &e) {
    s.remarks.push_back(std::string("no sensitivities: ") + e.what());
  }
}
}  // namespace

dynamics::SpeedRange chatter_range(const ChatterQuestion &q)
{
  return speed_range(q.analysis);
}

ChatterSearch search_chatter(const ChatterQuestion &q)
{
  ChatterSearch s;
  try {
    s.working = dynamics::working_point(q.bite, q.condition.speed, q.scheme);
    s.growth  = dynamics::growth_rate(dynamics::chatter_matrix(q.stand, s.working->by));
  } catch (const InputError &e) {
    s.no_bite = e.problems.front().message;
  } catch (const SolverError &e) {
    s.no_bite = e.report.what;
  }
  s.found = dynamics::critical_speed(q.stand, q.bite, q.scheme, chatter_range(q));
  if (s.found.verdict == Verdict::no_bite)
    throw SolverError(
        {"chatter: condition \"" + q.condition.name +
             "\" has no steady bite at any speed of the range "
             "searched",
         "", s.found.points.empty() ? s.no_bite : s.found.points.back().no_bite,
         "thinner film or more friction where the rolls skid; less friction, reduction or a smaller roll "
         "where the flattening diverges; another range under analysis.speeds",
         ""});
  return s;
}

ModelBand band_of(const std::vector<OtherSearch> &structures)
{
  ModelBand band;
  for (const OtherSearch &model : structures)
    if (model.found.verdict == Verdict::crossing) {
      band.low  = std::fmin(band.low, model.found.speed);
      band.high = std::fmax(band.high, model.found.speed);
    } else
      band.without.push_back(
          model.name + " " +
          (model.found.verdict == Verdict::unstable ? "unstable at every speed" : word_of(model.found.verdict)));
  return band;
}

ChatterStudy study_chatter(RunContext &run, const ChatterQuestion &question)
{
  ChatterStudy s;
  s.question       = question;
  const auto range = chatter_range(question);
  {
    StageTimer timer(run, "chatter " + question.condition.name + ", critical speed");
    search_models(s, range);
    static_cast<ChatterSearch &>(s) = search_chatter(s.question);
    if (s.working) {
      s.karman       = by_karman(*s.working);
      s.working_mode = least_stable_mode(s.question.stand, s.working->by);
      s.in_time      = mode_in_time(s.question, *s.working, *s.working_mode);
    }
    if (s.found.at)
      s.mode = least_stable_mode(s.question.stand, s.found.at->by);
    else
      s.mode = s.working_mode;
    count_roots(s);
    search_beside(s, range);
    follow_roots(s);
  }
  {
    StageTimer timer(run, "chatter " + question.condition.name + ", histories");
    simulate_linear(s);
    simulate_nonlinear(s);
  }
  find_sensitivities(run, s, range);
  draw_maps(run, s);
  return s;
}
}  // namespace mill
