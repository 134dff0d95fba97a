#include "twin/calibration/calibration.h"
#include "dynamics/response/response_slopes.h"
#include "twin/calibration/calibration_parts.h"
#include "twin/calibration/output_only_calibration.h"
#include "twin/calibration/verdict.h"
#include "twin/calibration/words.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double identified_shrink = 0.5;
}  // namespace

MeasuredResponse measured_response(const CalibrationInput &in, const std::vector<ForcedSamples> &pieces)
{
  Fourier fourier;
  MeasuredResponse data{{}, in.places};
  for (const ForcedSamples &piece : pieces)
    data.pieces.push_back(
        band_record(piece.force, piece.acceleration, in.rate, in.low, in.high, fourier, in.between));
  return data;
}

double seconds_of(const MeasuredResponse &data)
{
  double sum = 0;
  for (const BandRecord &band : data.pieces)
    sum += band.duration;
  return sum;
}

namespace {
/// A delay of two clocks: where the case explains most of the record, over +-50 ms.
double first_delay(const CalibrationInput &in, const MeasuredResponse &data, const NoiseDensity &noise,
                   Eigen::VectorXd theta, const Eigen::Index delay)
{
  const double step = 0.1 / in.high;
  double best = 0, lowest = std::numeric_limits<double>::infinity();
  for (double tau = -0.05; tau <= 0.05; tau += step) {
    theta[delay]      = tau;
    const double cost = likelihood(in.stand, in.unknowns, theta, data, noise, Wanted::cost, in.threads).residual;
    if (cost < lowest) {
      lowest = cost;
      best   = tau;
    }
  }
  return best;
}

Eigen::Index index_of(const std::vector<Unknown> &unknowns, const std::string &name)
{
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    if (unknowns[i].name == name)
      return Eigen::Index(i);
  return -1;
}

Eigen::VectorXd start_of(const CalibrationInput &in, const MeasuredResponse &data)
{
  CalibrationInput moved   = in;
  const Eigen::Index delay = index_of(in.unknowns, delay_name);
  if (delay >= 0) {
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(Eigen::Index(in.unknowns.size()));
    // noise of all that is measured: an early misfit of one mode must not decide about the delay
    moved.unknowns[std::size_t(delay)].prior = first_delay(in, data, noise_before(data), zero, delay);
  }
  return coarse_start(in.stand, moved.unknowns, in.fit, in.places, in.rate, in.low, in.high);
}

}  // namespace

std::vector<Calibrated> judged(const ScannedFit &scan, const Eigen::VectorXd &sd)
{
  const Fit &fit = scan.best;
  std::vector<Calibrated> all;
  for (std::size_t i = 0; i < fit.unknowns.size(); ++i) {
    const auto j        = Eigen::Index(i);
    const double shrink = sd[j] / fit.unknowns[i].prior_sd;
    Calibrated c{fit.unknowns[i].name,
                 fit.unknowns[i].prior_sd,
                 fit.estimate[j],
                 sd[j],
                 scan.interval(j, 0),
                 scan.interval(j, 1),
                 shrink,
                 shrink <= identified_shrink,
                 fit.estimate[j],
                 "",
                 0};
    if (!c.identified)
      c.why_not =
          fmt::format("not identified by these data: {:.0f} % of the prior's deviation is left", 100 * c.shrink);
    for (const Basin &basin : scan.basins)
      if (basin.name == c.name && basin.deviance < other_basin) {
        c.identified = false;
        c.why_not    = fmt::format("not identified by these data: a second minimum at {:+.1f} %, deviance {:.1f}",
                                   100 * std::expm1(basin.theta), basin.deviance);
      }
    all.push_back(std::move(c));
  }
  return all;
}

namespace {
/// Indices of what is not identified, that of which the records say most last.
std::vector<std::size_t> not_identified(const std::vector<Calibrated> &unknowns)
{
  std::vector<std::size_t> rest;
  for (std::size_t i = 0; i < unknowns.size(); ++i)
    if (!unknowns[i].identified)
      rest.push_back(i);
  std::stable_sort(rest.begin(), rest.end(),
                   [&](const auto a, const auto b) { return unknowns[a].shrink > unknowns[b].shrink; });
  return rest;
}

/// Minimum with some unknowns at their priors, and what that costs.
struct KeptFit {
  Fit fit;
  double deviance;
};

KeptFit fit_with_priors(const ProblemOf &problem_of, const Fit &joint, const int threads,
                        const std::vector<std::size_t> &at_prior)
{
  std::vector<Unknown> unknowns = joint.unknowns;
  Eigen::VectorXd theta         = joint.estimate;
  for (const std::size_t i : at_prior) {
    unknowns[i].prior_sd   = 1e-6;  // a prior that no record moves
    theta[Eigen::Index(i)] = unknowns[i].prior;
  }
  KeptFit kept{minimised(problem_of(unknowns), theta, joint.noise, {3, 60, 1e-4, threads}), 0};
  const double cost =
      problem_of(joint.unknowns).likelihood(kept.fit.estimate, joint.noise, Wanted::cost, threads).cost;
  kept.deviance = 2 * (cost - joint.cost);
  return kept;
}
}  // namespace

Eigen::VectorXd keep_priors(const ProblemOf &problem_of, const Fit &joint, const int threads, Calibration &result)
{
  for (Calibrated &u : result.unknowns)
    u.taken = true;
  std::vector<std::size_t> rest = not_identified(result.unknowns);
  if (rest.empty())
    return joint.estimate;
  KeptFit kept = fit_with_priors(problem_of, joint, threads, rest);
  while (kept.deviance > most_kept_deviance) {
    Calibrated &contradicted = result.unknowns[rest.back()];
    contradicted.why_not +=
        fmt::format("; the value of the fit is taken, since the value of the case raises the deviance by {:.3g}",
                    kept.deviance);
    rest.pop_back();
    if (rest.empty()) {
      kept = {joint, 0};
      break;
    }
    kept = fit_with_priors(problem_of, joint, threads, rest);
  }
  result.kept_deviance     = kept.deviance;
  const Eigen::VectorXd sd = kept.fit.sd();
  for (std::size_t i = 0; i < result.unknowns.size(); ++i) {
    result.unknowns[i].kept    = kept.fit.estimate[Eigen::Index(i)];
    result.unknowns[i].kept_sd = sd[Eigen::Index(i)];
  }
  for (const std::size_t i : rest) {
    result.unknowns[i].taken   = false;
    result.unknowns[i].kept    = joint.unknowns[i].prior;
    result.unknowns[i].kept_sd = 0;
  }
  return kept.fit.estimate;
}

namespace {
/// The case with the delay of the clocks that was found, which is not a property of the stand.
Eigen::VectorXd case_of(const CalibrationInput &in, const Eigen::VectorXd &theta)
{
  Eigen::VectorXd before = Eigen::VectorXd::Zero(theta.size());
  if (const Eigen::Index delay = index_of(in.unknowns, delay_name); delay >= 0)
    before[delay] = theta[delay];
  return before;
}

std::vector<BandResidual> bands_at(const CalibrationInput &in, const std::vector<Unknown> &unknowns,
                                   const Eigen::VectorXd &theta, const MeasuredResponse &data,
                                   const std::vector<ForcedSamples> &pieces)
{
  const auto noise = noise_of(residuals(in.stand, unknowns, theta, data, noise_before(data)));
  return band_residuals(data, residuals(in.stand, unknowns, theta, data, noise), pieces, in.rate, in.low, in.high,
                        in.model_error);
}

/// A record and its pieces in samples.
struct RecordParts {
  const MeasuredResponse &data;
  const std::vector<ForcedSamples> &pieces;
};

RecordFit record_fit(const CalibrationInput &in, const Eigen::VectorXd &theta, const RecordParts &record,
                     const MeasuredResponse &fit_data, const NoiseDensity &noise)
{
  RecordFit fit;
  fit.before = misfit_on(in.stand, in.unknowns, case_of(in, theta), record.data, fit_data, noise);
  fit.after  = misfit_on(in.stand, in.unknowns, theta, record.data, fit_data, noise);
  fit.bands  = bands_at(in, in.unknowns, theta, record.data, record.pieces);
  for (const BandResidual &band : fit.bands)
    if (band.decisive)
      fit.worst = std::max(fit.worst, band.ratio / band.limit);
  return fit;
}

/// Where bands fail with one damping ratio for all modes: the unknowns with one for each mode, if with them no
/// band fails and no unknown is far from its prior; else empty.
std::vector<std::string> ratios_that_suffice(const CalibrationInput &in, const Fit &joint, const RecordParts &fit,
                                             const RecordParts &check)
{
  const Eigen::Index common = index_of(in.unknowns, ratios_name);
  const bool some_free      = std::any_of(in.unknowns.begin(), in.unknowns.end(),
                                          [](const Unknown &u) { return moves(u) == Moves::ratio; });
  if (common < 0 || some_free)
    return {};
  std::vector<Unknown> unknowns;
  std::vector<double> start;
  for (std::size_t i = 0; i < in.unknowns.size(); ++i)
    if (Eigen::Index(i) != common) {
      unknowns.push_back(in.unknowns[i]);
      start.push_back(joint.estimate[Eigen::Index(i)]);
    }
  const StandAt trial = stand_at(in.stand, in.unknowns, joint.estimate);
  for (Eigen::Index k = 0; k < trial.frequency.size() && trial.frequency[k] < 2 * M_PI * in.high; ++k) {
    const Unknown &zeta = in.unknowns[std::size_t(common)];
    unknowns.push_back({ratio_name(k), zeta.prior_sd, zeta.prior});
    start.push_back(joint.estimate[common]);
  }
  const Fit joint_fit =
      fitted(in.stand, unknowns, Eigen::Map<Eigen::VectorXd>(start.data(), Eigen::Index(start.size())), fit.data,
             {1, 60, 1e-4, in.threads});
  std::vector<std::string> names;
  for (std::size_t i = 0; i < unknowns.size(); ++i) {
    const bool far =
        std::abs(joint_fit.estimate[Eigen::Index(i)] - unknowns[i].prior) > far_from_prior * unknowns[i].prior_sd;
    if (moves(unknowns[i]) == Moves::delay)
      continue;
    if (far && !moves_damping(unknowns[i]))
      return {};
    names.push_back(unknowns[i].name);
  }
  for (const RecordParts *record : {&fit, &check})
    if (wrong_bands(bands_at(in, unknowns, joint_fit.estimate, record->data, record->pieces)).worst)
      return {};
  return names;
}

/// |H1| of the check records, of the case and of the calibrated case.
Table response_table(const CalibrationInput &in, const Eigen::VectorXd &theta)
{
  Eigen::Index longest = 0;
  for (const ForcedSamples &piece : in.check)
    longest = std::max(longest, piece.force.size());
  Eigen::Index L = 1 << 15;
  while (L > 512 && L > longest / 3)
    L /= 2;
  const CrossSpectra s = cross_spectra(in.check, in.rate, L);
  const double df      = in.rate / double(L);
  const auto first     = Eigen::Index(std::ceil(in.low / df)),
             last      = std::min<Eigen::Index>(L / 2, Eigen::Index(std::floor(in.high / df)));
  Table table;
  if (s.n == 0 || last < first)
    return table;
  const Eigen::Index k = last - first + 1;
  table.add("frequency", "Hz", Eigen::VectorXd::LinSpaced(k, double(first) * df, double(last) * df));
  const StandAt ends[] = {stand_at(in.stand, in.unknowns, Eigen::VectorXd::Zero(theta.size())),
                          stand_at(in.stand, in.unknowns, theta)};
  for (std::size_t j = 0; j < in.places.size(); ++j) {
    const Eigen::VectorXd measured = s.cross.col(Eigen::Index(j))
                                         .segment(first, k)
                                         .cwiseAbs()
                                         .cwiseQuotient(s.force.segment(first, k).cwiseMax(1e-300));
    table.add(in.sensors[j] + ".measured", "m/s2/N", measured);
    for (int e = 0; e < 2; ++e) {
      Eigen::VectorXd model(k);
      for (Eigen::Index b = 0; b < k; ++b) {
        const double w           = 2 * M_PI * table.columns[0][b];
        std::complex<double> sum = 0;
        for (Eigen::Index i = 0; i < ends[e].frequency.size(); ++i) {
          const double wi = ends[e].frequency[i];
          sum += ends[e].shape(in.places[j], i) * ends[e].force[i] /
                 std::complex<double>(wi * wi - w * w, 2 * ends[e].damping[i] * wi * w);
        }
        model[b] = w * w * std::abs(sum);
      }
      table.add(in.sensors[j] + (e == 0 ? ".before" : ".after"), "m/s2/N", model);
    }
  }
  return table;
}
}  // namespace

namespace {
/// Scans of springs and of modes, again where a mode shows a lower minimum.
ScannedFit scan_of(const CalibrationInput &in, const FitProblem &problem, Fit start, const FitSettings &settings,
                   const Progress &progress)
{
  for (int again = 0;; ++again) {
    ScannedFit scan = scanned(problem, start, settings, [&](const double f) { progress.at("basins", f); });
    std::optional<Eigen::VectorXd> lower;
    scan.modes = scanned_modes(in.stand, problem, scan.best, in.unknowns, in.high, settings, lower);
    if (!lower || again == 2)
      return scan;
    start = fitted(problem, *lower, settings);
  }
}
}  // namespace

Calibration calibrate(const CalibrationInput &in, const Progress &progress)
{
  if (!in.force_recorded)
    return calibrate_output_only(in, progress);
  Calibration result;
  progress.at("start", 0);
  const MeasuredResponse data = measured_response(in, in.fit);
  const Eigen::VectorXd start = start_of(in, data);
  const FitSettings settings{3, 60, 1e-4, in.threads};
  progress.at("fit", 0);
  const Fit first       = fitted(in.stand, in.unknowns, start, data, settings);
  result.scan           = scan_of(in, recorded_force(in.stand, in.unknowns, data), first, settings, progress);
  result.unknowns       = judged(result.scan, result.scan.best.sd());
  result.identification = identification(result.scan.best.information, in.unknowns);
  result.unseen         = unseen_directions(result.identification, in.stand);
  const Eigen::VectorXd scale = result.scan.best.sd().cwiseInverse();
  result.correlation          = scale.asDiagonal() * result.scan.best.covariance * scale.asDiagonal();
  keep_priors([&](const std::vector<Unknown> &unknowns) { return recorded_force(in.stand, unknowns, data); },
              result.scan.best, in.threads, result);
  progress.at("check", 0);
  const MeasuredResponse check = measured_response(in, in.check);
  Eigen::VectorXd theta(Eigen::Index(in.unknowns.size()));
  for (std::size_t i = 0; i < result.unknowns.size(); ++i)
    theta[Eigen::Index(i)] = result.unknowns[i].kept;
  result.modes              = predicted_modes(in.stand, result.scan, theta, in.high);
  const NoiseDensity &noise = result.scan.best.noise;
  const RecordParts fit_parts{data, in.fit}, check_parts{check, in.check};
  result.fit           = record_fit(in, theta, fit_parts, data, noise);
  result.check         = record_fit(in, theta, check_parts, data, noise);
  result.fit_seconds   = seconds_of(data);
  result.check_seconds = seconds_of(check);
  result.response      = response_table(in, theta);
  if (index_of(in.unknowns, delay_name) < 0)
    result.delay = clock_delay(in.stand, result.scan.best, data, in.fit, in.rate, in.low, in.high, settings);
  const Eigen::VectorXd as_it_is = case_of(in, result.scan.best.estimate);
  result.case_deviance =
      2 * (likelihood(in.stand, in.unknowns, as_it_is, data, noise, Wanted::cost, in.threads).cost -
           result.scan.best.cost);
  result.agrees = case_agrees(result, record_fit(in, as_it_is, fit_parts, data, noise),
                              record_fit(in, as_it_is, check_parts, data, noise));
  if (wrong_bands(result.fit.bands).worst || wrong_bands(result.check.bands).worst)
    result.with_ratios = ratios_that_suffice(in, result.scan.best, fit_parts, check_parts);
  result.refusals = refusals_of(in, result);
  return result;
}
}  // namespace mill::twin
