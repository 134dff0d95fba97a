#include "twin/live/compare/comparison.h"
#include "core/base/errors.h"
#include "core/base/si_unit.h"
#include "core/model/assumed_error.h"
#include "core/model/case.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

namespace mill::live {
namespace {
constexpr double calm_memory = 60;  // s, of the level while the mill is calm
constexpr double least_error = 0.05;

std::vector<std::string> compared_places(const ComparisonSetup &setup)
{
  std::vector<std::string> names;
  for (const LiveChannel &channel : setup.channels)
    if (is_in(channel.unit, SiUnit::acceleration) &&
        std::find(setup.places.begin(), setup.places.end(), channel.name) != setup.places.end())
      names.push_back(channel.name);
  return names;
}

// Every acceleration, at a place of the model or not.
std::vector<std::string> watched_channels(const ComparisonSetup &setup)
{
  std::vector<std::string> names;
  for (const LiveChannel &channel : setup.channels)
    if (is_in(channel.unit, SiUnit::acceleration))
      names.push_back(channel.name);
  return names;
}

std::vector<WatchedBand> all_bands(const ComparisonSetup &setup)
{
  std::vector<WatchedBand> bands = setup.bands;
  const auto now                 = setup.modes.at(0);
  for (std::size_t m = 0; m < now.size(); ++m) {
    if (!setup.mode_names.empty() && (m >= setup.mode_names.size() || setup.mode_names[m].empty()))
      continue;  // neither gap nor sensors see it
    bands.push_back(
        {setup.mode_names.empty() ? fmt::format("mode {}", m + 1) : setup.mode_names[m], now[m].frequency, true});
  }
  return bands;
}

ModeTracker::Setup tracked(const ComparisonSetup &setup)
{
  ModeTracker::Setup tracker;
  tracker.rate   = setup.rate;
  tracker.places = compared_places(setup);
  tracker.modes  = setup.modes;
  tracker.names  = setup.mode_names;
  return tracker;
}

// Up to two missing samples in a row by straight lines, as in a record.
void fill_short_gaps(Eigen::MatrixXd &x)
{
  for (Eigen::Index c = 0; c < x.cols(); ++c)
    for (Eigen::Index k = 1; k + 1 < x.rows(); ++k) {
      if (std::isfinite(x(k, c)) || !std::isfinite(x(k - 1, c)))
        continue;
      if (std::isfinite(x(k + 1, c)))
        x(k, c) = 0.5 * (x(k - 1, c) + x(k + 1, c));
      else if (k + 2 < x.rows() && std::isfinite(x(k + 2, c))) {
        x(k, c)     = (2 * x(k - 1, c) + x(k + 2, c)) / 3;
        x(k + 1, c) = (x(k - 1, c) + 2 * x(k + 2, c)) / 3;
      }
    }
}
}  // namespace

std::vector<twin::Unknown> unknowns_of(const LumpedModel &chain)
{
  std::vector<twin::Unknown> unknowns;
  for (std::size_t j = 0; j < chain.K.size(); ++j) {
    const Parameter &K = chain.K[j];
    if (!(K.value > 0))
      continue;
    const bool known = std::isfinite(K.error_estimate);
    const double sd  = K.source == Source::measured && known ? K.error_estimate
                       : known                               ? std::max(least_error, K.error_estimate)
                                                             : assumed_spring_error;
    unknowns.push_back({fmt::format("K{}", j + 1), sd});
  }
  unknowns.push_back({twin::ratios_name, std::log(2.0)});
  return unknowns;
}

Comparison::Comparison(ComparisonSetup setup)
    : setup_(std::move(setup)), levels(setup_.rate, Eigen::Index(compared_places(setup_).size())),
      onset(setup_.rate, watched_channels(setup_), all_bands(setup_), setup_.limit), modes(tracked(setup_))
{
  for (std::size_t c = 0; c < setup_.channels.size(); ++c) {
    const LiveChannel &channel = setup_.channels[c];
    if (is_in(channel.unit, SiUnit::acceleration))
      watched.push_back(Eigen::Index(c));
    const auto place = std::find(setup_.places.begin(), setup_.places.end(), channel.name);
    if (place == setup_.places.end())
      continue;
    if (is_in(channel.unit, SiUnit::acceleration))
      pairs.push_back({Eigen::Index(c), place - setup_.places.begin(), channel.name});
    else
      remarks.push_back(
          fmt::format("channel {} is in \"{}\" and not in m/s2: it is not compared", channel.name, channel.unit));
  }
  if (pairs.empty())
    remarks.push_back(
        "no channel is an acceleration at a place of the model: the twin is not compared with the mill");
  baseline.assign(pairs.size(), unknown);
  if (setup_.chatter) {
    setup_.chatter->wait = setup_.wait;
    chatter.emplace(*setup_.chatter, setup_.channels, setup_.rate);
    if (chatter->has_speed())
      remarks.insert(remarks.end(), chatter->notes().begin(), chatter->notes().end());
    else {
      chatter.reset();
      no_chatter = "no channel speed or exit_speed: no distance to the critical speed";
      remarks.push_back(no_chatter);
    }
  }
}

ComparisonNews Comparison::take(const LiveBlock &block)
{
  const auto begin = std::chrono::steady_clock::now();
  ComparisonNews news;
  const Eigen::Index n = block.measured.rows();
  const double utc     = block.start_time + double(block.first + n) / setup_.rate;
  Eigen::MatrixXd measured(n, Eigen::Index(pairs.size())), simulated(n, measured.cols());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    measured.col(Eigen::Index(i))  = block.measured.col(pairs[i].channel);
    simulated.col(Eigen::Index(i)) = block.simulated.col(pairs[i].place);
  }
  fill_short_gaps(measured);
  Eigen::MatrixXd accelerations(n, Eigen::Index(watched.size()));
  for (std::size_t i = 0; i < watched.size(); ++i)
    accelerations.col(Eigen::Index(i)) = block.measured.col(watched[i]);
  fill_short_gaps(accelerations);
  if (block.after_gap) {
    levels.restart();
    onset.restart();
    modes.restart();
  }
  onset.take(block.first, block.start_time, accelerations, book);
  if (block.settling) {
    levels.restart();
    modes.restart();
  } else if (!pairs.empty()) {
    add_levels(news, levels.take(block.first, measured, simulated), block.start_time);
    if (block.driven)
      news.modes = modes.take(block.first, block.start_time, block.force, measured, book);
    if (news.modes)
      watch_drift(utc);
  }
  if (auto result = task.finished(); result && answered)
    end_recalibration(utc, std::move(*result));
  add_chatter(news, block, utc);
  news.alarms    = book.news();
  news.proposals = offered.news();
  spent += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return news;
}

void Comparison::add_levels(ComparisonNews &news, const twin::RunningComparison::News &compared,
                            const double start_time)
{
  for (const twin::SpectrumPair &pair : compared.spectra) {
    PageSpectrum page;
    page.place    = pairs[std::size_t(pair.place)].name;
    page.utc      = start_time + compared.spectra_time;
    page.df       = pair.resolution;
    page.enbw     = 1.5 * pair.resolution;
    page.segments = 3;  // an exponential mean over half a second of segments every 0.2 to 0.4 s
    for (Eigen::Index k = 0; k < pair.measured.size(); ++k) {
      page.measured.push_back(std::sqrt(pair.measured[k]));
      page.simulated.push_back(std::sqrt(pair.simulated[k]));
    }
    news.spectra.push_back(std::move(page));
  }
  for (std::size_t s = 0; s < compared.seconds.size(); ++s) {
    PageLevels page;
    page.utc = start_time + compared.time[s];
    for (const twin::PlaceSecond &row : compared.seconds[s]) {
      double &calm = baseline[std::size_t(row.place)];
      calm         = std::isnan(calm) ? row.measured.rms : calm + (row.measured.rms - calm) / calm_memory;
      PlaceLevel level;
      level.place           = pairs[std::size_t(row.place)].name;
      level.measured_rms    = row.measured.rms;
      level.measured_peak   = row.measured.peak;
      level.measured_crest  = row.measured.crest;
      const bool simulated  = row.simulated.rms > 0;  // a twin that is not driven has no level
      level.simulated_rms   = simulated ? row.simulated.rms : unknown;
      level.simulated_peak  = simulated ? row.simulated.peak : unknown;
      level.simulated_crest = simulated ? row.simulated.crest : unknown;
      level.baseline_rms    = calm;
      level.ratio_db        = row.ratio;
      level.delay           = row.delay.value;
      level.delay_sd        = row.delay.sd;
      for (const twin::IncoherentShare &band : row.bands)
        level.incoherent.push_back({band.centre, band.share});
      page.places.push_back(std::move(level));
    }
    news.levels = std::move(page);
  }
}

void Comparison::add_chatter(ComparisonNews &news, const LiveBlock &block, const double utc)
{
  const auto bands = onset.bands();
  double highest = unknown, growth = unknown;
  for (const ChatterBand &band : bands)
    if (!(band.growth_high <= highest) && std::isfinite(band.growth_high)) {
      highest = band.growth_high;
      growth  = band.growth;
    }
  if (chatter)
    news.chatter = chatter->take(block, highest, book);
  else if (const auto second = std::int64_t(std::floor(utc)); second != chatter_second) {
    chatter_second        = second;
    news.chatter          = PageChatter{};
    news.chatter->utc     = utc;
    news.chatter->because = no_chatter;
  }
  if (news.chatter) {
    news.chatter->growth = growth;
    news.chatter->bands  = bands;
  }
}

void Comparison::watch_drift(const double utc)
{
  for (const ModeDrift &drift : modes.drifts())
    if (!waiting && !answered)
      waiting = drift;
  if (!waiting || setup_.unknowns.empty())
    return;
  begin_recalibration(*waiting);
  if (setup_.wait)
    if (auto result = task.wait())
      end_recalibration(utc, std::move(*result));
}

void Comparison::begin_recalibration(const ModeDrift &drift)
{
  twin::DriftRecord record;
  record.rate        = setup_.rate;
  double seconds     = 0;
  const auto sensors = modes.blocks().empty() ? std::vector<std::size_t>{} : modes.blocks().back().sensors;
  load_              = 0;
  for (const ModeBlock &block : modes.blocks())
    if (block.number >= drift.from && block.sensors == sensors) {
      if (record.blocks.empty())
        from_ = block.utc - block.spectra.duration;
      record.blocks.push_back(block.spectra);
      seconds += block.spectra.duration;
      to_ = block.utc;
      load_ += block.load;
    }
  if (sensors.empty() || seconds < 0.99 * setup_.recalibrate_on || task.busy())
    return;
  load_ /= double(record.blocks.size());
  for (const std::size_t sensor : sensors)
    record.places.push_back(pairs[sensor].place);
  for (const twin::ModeRow &row : modes.rows())
    record.modes.push_back(row.measured);
  const LumpedModel chain = setup_.chain_at ? setup_.chain_at(load_) : setup_.chain;
  twin::FittedStand stand =
      setup_.detailed ? setup_.detailed(chain)
                      : twin::FittedStand{dynamics::mill_model(chain, setup_.dynamics), setup_.modes.damping};
  std::vector<twin::Unknown> unknowns;
  for (const twin::Unknown &unknown :
       setup_.unknowns)  // K4 belongs to the chain by the meaning of the force alone
    if (twin::moves(unknown) == twin::Moves::ratios || twin::is_spring(stand, unknown.name))
      unknowns.push_back(unknown);
  const auto work = [stand = std::move(stand), record = std::move(record), unknowns, load = load_] {
    twin::Recalibration recalibration;
    try {
      recalibration = twin::recalibrate(stand, unknowns, record);
    } catch (const std::exception &error) {
      recalibration.refused = error.what();
    }
    recalibration.load = load;
    return recalibration;
  };
  task.start(work);
  answered = drift;
  waiting.reset();
}

void Comparison::end_recalibration(const double utc, twin::Recalibration result)
{
  const ModeDrift drift = *answered;
  answered.reset();
  const std::string name   = drift.mode < setup_.mode_names.size() && !setup_.mode_names[drift.mode].empty()
                                 ? setup_.mode_names[drift.mode]
                                 : fmt::format("Mode {}", drift.mode + 1);
  const twin::ModeRow &row = modes.rows()[drift.mode];
  std::string reason       = fmt::format("{} has {} by {:.2f} %", name, drift.change < 0 ? "fallen" : "risen",
                                         100 * std::abs(std::expm1(drift.change)));
  if (row.measured.why_not.empty())
    reason +=
        fmt::format(", to {:.5g} Hz against {:.5g} Hz of the twin", row.measured.frequency, row.twin.frequency);
  reason += ".";
  if (!result.refused.empty()) {
    book.raise(recalibration_cause, utc, "drift", "warning",
               reason + " Nothing is proposed: " + result.refused + ".");
    return;
  }
  book.end(recalibration_cause);
  Proposal proposal;
  proposal.utc            = utc;
  proposal.from           = from_;
  proposal.to             = to_;
  proposal.reason         = std::move(reason);
  proposal.before         = setup_.chain;
  proposal.chain          = recalibrated(setup_.chain, result, result.load);
  proposal.damping_before = setup_.dynamics.modal_damping;
  proposal.damping        = recalibrated(setup_.dynamics.modal_damping, result);
  proposal.recalibration  = std::move(result);
  offered.add(std::move(proposal));
}

void Comparison::set_twin(const LumpedModel &chain, const DynamicsSettings &dynamics, const twin::ModesAtLoad &now)
{
  const bool same = now.frequency.cols() == setup_.modes.frequency.cols() &&
                    now.frequency.rows() == setup_.modes.frequency.rows() &&
                    now.frequency == setup_.modes.frequency && now.damping == setup_.modes.damping;
  setup_.chain    = chain;
  setup_.dynamics = dynamics;
  for (const twin::Unknown &now_known : unknowns_of(chain))  // an adopted spring has its posterior
    for (twin::Unknown &unknown : setup_.unknowns)
      if (unknown.name == now_known.name)
        unknown.prior_sd = now_known.prior_sd;
  if (same)  // set again, for instance since another place is shown
    return;
  setup_.modes = now;
  modes.set_twin(now);
  waiting.reset();
  answered.reset();
  offered.twin_changed();
  book.end(recalibration_cause);
  for (std::size_t m = 0; m < std::size_t(now.frequency.cols()); ++m)
    book.end(ModeTracker::cause_of(m));
}

void Comparison::set_chatter(twin::ChatterModel model)
{
  if (chatter)
    chatter->set_model(std::move(model));
}

std::optional<Proposal> Comparison::adopt(const std::int64_t id, const double utc, const std::string &folder,
                                          const Case &origin)
{
  return offered.adopt(id, utc, folder, [&](const Proposal &proposal, const std::string &directory) {
    return setup_.adopted_case ? setup_.adopted_case(proposal, directory)
                               : calibrated_case(proposal, origin, directory);
  });
}

const std::vector<Proposal> &Comparison::proposals() const
{
  return offered.all();
}

std::vector<PageAlarm> Comparison::open_alarms() const
{
  std::vector<PageAlarm> open;
  for (const auto &[cause, alarm] : book.state().now)
    open.push_back(alarm);
  return open;
}

TrackedModes Comparison::drift() const
{
  return modes.tracked();
}

std::vector<ChatterBand> Comparison::bands() const
{
  return onset.bands();
}

const std::vector<std::string> &Comparison::notes() const
{
  return remarks;
}

double Comparison::busy() const
{
  return spent;
}

void publish(const ComparisonNews &news, const Publish &publish)
{
  if (news.levels)
    publish(event_names::levels, levels_text(*news.levels));
  for (const PageSpectrum &spectrum : news.spectra)
    publish(event_names::spectrum, spectrum_text(spectrum));
  if (news.modes)
    publish(event_names::modes, modes_text(*news.modes));
  if (news.chatter)
    publish(event_names::chatter, chatter_text(*news.chatter));
  for (const PageAlarm &alarm : news.alarms)
    publish(event_names::alarm, alarm_text(alarm));
  for (const PageProposal &proposal : news.proposals)
    publish(event_names::proposal, proposal_text(proposal));
}
}  // namespace mill::live
