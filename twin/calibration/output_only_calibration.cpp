#include "twin/calibration/output_only_calibration.h"
#include "twin/calibration/calibration_parts.h"
#include "twin/calibration/output_only_start.h"
#include "twin/calibration/second_minima.h"
#include "twin/calibration/verdict.h"
#include "twin/calibration/words.h"
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <memory>

namespace mill::twin {
namespace {
FitSettings settings_with(const int threads)
{
  return {3, 60, 1e-4, threads};
}

/// The accelerations as a problem of minimisation by unknowns of the stand with these priors and the knots.
FitProblem problem_of(const OutputOnly &record, const std::vector<Unknown> &all, const NoiseDensity &before)
{
  FitProblem problem;
  OutputOnly copy    = record;
  copy.unknowns      = {all.begin(), all.begin() + long(record.unknowns.size())};
  const auto kept    = std::make_shared<const OutputOnly>(std::move(copy));
  problem.unknowns   = all;
  problem.is_spring  = [kept](const std::string &name) { return moves_springs(kept->stand, name); };
  problem.likelihood = [kept](const Eigen::VectorXd &theta, const NoiseDensity &noise, const Wanted wanted,
                              const int threads) {
    return output_only_likelihood(*kept, theta, noise, wanted, threads);
  };
  problem.renewed = [kept](const Eigen::VectorXd &theta, const NoiseDensity &noise) {
    return renewed_noise(*kept, theta, noise);
  };
  problem.before = before;
  problem.values = number_of_values(record.data);
  return problem;
}

/// The scan without the knots of the force, which are fitted together with the stand.
ScannedFit of_the_stand(const ScannedFit &scan, const std::vector<Unknown> &unknowns)
{
  const auto p           = Eigen::Index(unknowns.size());
  ScannedFit stand       = scan;
  stand.best.unknowns    = unknowns;
  stand.best.estimate    = scan.best.estimate.head(p);
  stand.best.covariance  = scan.best.covariance.topLeftCorner(p, p);
  stand.interval         = scan.interval.topRows(p);
  Eigen::MatrixXd inside = stand.best.covariance.ldlt().solve(Eigen::MatrixXd::Identity(p, p));
  for (Eigen::Index i = 0; i < p; ++i)
    inside(i, i) -= 1 / (unknowns[std::size_t(i)].prior_sd * unknowns[std::size_t(i)].prior_sd);
  stand.best.information = inside;
  return stand;
}

/// What is identified, and how well a recorded force would have identified the rest.
std::vector<Calibrated> judged_without_force(const OutputOnly &record, const Fit &joint, const ScannedFit &scan)
{
  const Eigen::VectorXd recorded =
      posterior_covariance(information_with_force(record, joint.estimate, joint.noise), record.unknowns)
          .diagonal()
          .cwiseSqrt();
  std::vector<Calibrated> all = judged_with_minima(scan);
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!all[i].identified)
      all[i].why_not +=
          fmt::format("; had the force been recorded, {:.2g} % of the prior's deviation would be left",
                      100 * recorded[Eigen::Index(i)] / all[i].prior_sd);
  return all;
}

/// The density of the force that suits another record, the stand unchanged.
Eigen::VectorXd with_own_force(const OutputOnly &record, const Eigen::VectorXd &theta, const NoiseDensity &noise,
                               const int threads)
{
  std::vector<Unknown> all = record.all_unknowns();
  for (std::size_t i = 0; i < record.unknowns.size(); ++i)
    all[i] = {all[i].name, 1e-9, theta[Eigen::Index(i)]};
  FitSettings settings     = settings_with(threads);
  settings.covariance      = false;
  Eigen::VectorXd estimate = minimised(problem_of(record, all, noise), theta, noise, settings).estimate;
  estimate.head(Eigen::Index(record.unknowns.size())) = theta.head(Eigen::Index(record.unknowns.size()));
  return estimate;
}

struct FittedRecord {
  RecordFit fit;
  Eigen::VectorXd theta, before;  // with the density of the force of this record
};

FittedRecord fitted_record(const CalibrationInput &in, const OutputOnly &record, const Eigen::VectorXd &theta,
                           const NoiseDensity &carried, const std::vector<ForcedSamples> &pieces)
{
  FittedRecord result;
  Eigen::VectorXd case_itself = theta;
  for (std::size_t i = 0; i < record.unknowns.size(); ++i)
    case_itself[Eigen::Index(i)] = 0;
  result.theta               = with_own_force(record, theta, carried, in.threads);
  result.before              = with_own_force(record, case_itself, carried, in.threads);
  result.fit.before          = output_only_misfit(record, result.before, carried, in.low, in.high);
  result.fit.after           = output_only_misfit(record, result.theta, carried, in.low, in.high);
  const NoiseDensity renewed = renewed_noise(record, result.theta, carried);
  const auto seen            = seen_force(record, result.theta, renewed);
  result.fit.bands  = direction_residuals(record, seen, renewed, pieces, in.rate, in.low, in.high, in.model_error);
  result.fit.levels = level_bands(record, seen, in.low, in.high, in.model_error);
  for (const BandResidual &band : result.fit.bands)
    if (band.decisive)
      result.fit.worst = std::max(result.fit.worst, band.ratio / band.limit);
  for (const LevelBand &band : result.fit.levels)
    if (band.decisive)
      result.fit.worst = std::max(result.fit.worst, band.excess());
  return result;
}

void add_band_refusals(std::vector<std::string> &refusals, const RecordFit &fit, const std::string &records)
{
  const auto [wrong, worst] = wrong_bands(fit.bands);
  if (worst)
    refusals.push_back(fmt::format("in {} of {} third octaves of the {} the residual is above what one force and "
                                   "the model error leave; the worst is {:.1f} Hz: {:.2f} times, limit {:.2f}",
                                   wrong, fit.bands.size(), records, worst->centre, worst->ratio, worst->limit));
  const LevelBand *steep = nullptr;
  int uneven             = 0;
  for (const LevelBand &band : fit.levels)
    if (band.wrong()) {
      ++uneven;
      if (!steep || band.excess() > steep->excess())
        steep = &band;
    }
  if (steep)
    refusals.push_back(
        fmt::format("in {} of {} narrow bands of the {} this stand needs a force that is not smooth over a third "
                    "octave; the worst is {:.1f} Hz: {:.2f} times its surroundings, limit {:.2f}. Record the "
                    "force, or leave out lines of the force by the band of records.toml",
                    uneven, fit.levels.size(), records, steep->centre, steep->ratio, steep->limit));
}

/// Levels of the check records, of the case and of the calibrated case, over Hann segments.
Table response_table(const CalibrationInput &in, const OutputOnly &record, const FittedRecord &check,
                     const NoiseDensity &noise)
{
  Eigen::Index longest = 0;
  for (const ForcedSamples &piece : in.check)
    longest = std::max(longest, piece.acceleration.rows());
  Eigen::Index L = 1 << 15;
  while (L > 512 && L > longest / 3)
    L /= 2;
  const SpectralMatrices s = spectral_matrices(in.check, in.rate, L);
  const double df          = in.rate / double(L);
  const auto first = Eigen::Index(std::ceil(in.low / df)), last = Eigen::Index(std::floor(in.high / df));
  Table table;
  if (s.n == 0 || last < first)
    return table;
  OutputOnly at_bins = record;
  BandRecord bins;
  bins.angular =
      Eigen::VectorXd::LinSpaced(last - first + 1, 2 * M_PI * df * double(first), 2 * M_PI * df * double(last));
  bins.acceleration   = Eigen::MatrixXcd::Zero(bins.angular.size(), Eigen::Index(in.places.size()));
  at_bins.data.pieces = {bins};
  set_unit_force(at_bins.data);
  const NoiseDensity there = carried_noise(noise, record.data, at_bins.data);
  table.add("frequency", "Hz", bins.angular / (2 * M_PI));
  const SeenForce before = seen_force(at_bins, check.before, there).front(),
                  after  = seen_force(at_bins, check.theta, there).front();
  for (std::size_t j = 0; j < in.places.size(); ++j) {
    const auto c = Eigen::Index(j);
    Eigen::VectorXd measured(bins.angular.size());
    for (Eigen::Index b = 0; b < measured.size(); ++b)
      measured[b] = std::sqrt(s.density[std::size_t(first + b)](c, c).real());
    const auto level = [&](const SeenForce &seen) {
      return (seen.response.col(c).cwiseAbs2().cwiseProduct(seen.density) + there.front().col(c))
          .cwiseSqrt()
          .eval();
    };
    table.add(in.sensors[j] + ".measured", "m/s2/sqrt(Hz)", measured);
    table.add(in.sensors[j] + ".before", "m/s2/sqrt(Hz)", level(before));
    table.add(in.sensors[j] + ".after", "m/s2/sqrt(Hz)", level(after));
  }
  return table;
}

EstimatedForce estimated_force(const OutputOnly &record, const Fit &joint)
{
  const Eigen::Index q = record.force.knots.size();
  return {record.force.knots, record.force.level * joint.estimate.tail(q).array().exp().matrix(),
          joint.sd().tail(q)};
}

/// Does the case explain the accelerations already, with a force of its own?  (45.8)
void judge_the_case(const CalibrationInput &in, const OutputOnly &record, const OutputOnly &check,
                    const Fit &joint, const NoiseDensity &carried, Calibration &result)
{
  Eigen::VectorXd as_it_is = joint.estimate;
  as_it_is.head(Eigen::Index(record.unknowns.size())).setZero();
  const FittedRecord fitted  = fitted_record(in, record, as_it_is, joint.noise, in.fit),
                     checked = fitted_record(in, check, as_it_is, carried, in.check);
  const auto at_case         = output_only_likelihood(record, fitted.theta, joint.noise, Wanted::cost, in.threads);
  result.case_deviance       = 2 * (at_case.cost - joint.cost);
  result.agrees              = case_agrees(result, fitted.fit, checked.fit);
}

OutputOnly record_of(const CalibrationInput &in, const std::vector<ForcedSamples> &pieces,
                     const ForceSpectrum &force)
{
  OutputOnly record{in.stand, in.unknowns, measured_response(in, pieces), force};
  set_unit_force(record.data);
  return record;
}
}  // namespace

Calibration calibrate_output_only(const CalibrationInput &in, const Progress &progress)
{
  Calibration result;
  progress.at("start", 0);
  OutputOnly record           = record_of(in, in.fit, force_spectrum(in.low, in.high));
  const Eigen::VectorXd start = output_only_start(record, in.fit, in.rate, in.low, in.high);
  const FitSettings settings  = settings_with(in.threads);
  const NoiseDensity before   = equal_noise(record, start);
  const FitProblem problem    = problem_of(record, record.all_unknowns(), before);
  progress.at("fit", 0);
  const Fit first = fitted(problem, start, settings);
  ScannedFit scan = scanned(problem, first, settings, [&](const double f) { progress.at("basins", f); });
  prefer_a_correction(problem, Eigen::Index(in.unknowns.size()), settings, scan);
  const Fit joint             = scan.best;
  result.scan                 = of_the_stand(scan, in.unknowns);
  result.unknowns             = judged_without_force(record, joint, result.scan);
  result.identification       = identification(result.scan.best.information, in.unknowns);
  result.unseen               = unseen_directions(result.identification, in.stand);
  const Eigen::VectorXd scale = result.scan.best.sd().cwiseInverse();
  result.correlation          = scale.asDiagonal() * result.scan.best.covariance * scale.asDiagonal();
  const Eigen::VectorXd kept  = keep_priors(
      [&](const std::vector<Unknown> &all) { return problem_of(record, all, before); }, joint, in.threads, result);
  result.modes = predicted_modes(in.stand, result.scan, kept.head(Eigen::Index(in.unknowns.size())), in.high);
  progress.at("check", 0);
  // Is the model right?  What is not identified may be anything, so all unknowns are free here.
  const OutputOnly check      = record_of(in, in.check, record.force);
  const NoiseDensity carried  = carried_noise(joint.noise, record.data, check.data);
  const FittedRecord of_fit   = fitted_record(in, record, joint.estimate, joint.noise, in.fit),
                     of_check = fitted_record(in, check, joint.estimate, carried, in.check);
  result.fit                  = of_fit.fit;
  result.check                = of_check.fit;
  result.fit_seconds          = seconds_of(record.data);
  result.check_seconds        = seconds_of(check.data);
  result.response             = response_table(in, check, of_check, carried);
  result.force                = estimated_force(record, joint);
  judge_the_case(in, record, check, joint, carried, result);
  add_band_refusals(result.refusals, result.fit, "fitted records");
  add_band_refusals(result.refusals, result.check, "check records");
  add_other_refusals(result.refusals, in, result);
  return result;
}
}  // namespace mill::twin
