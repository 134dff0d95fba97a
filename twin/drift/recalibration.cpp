#include "twin/drift/recalibration.h"
#include "core/base/errors.h"
#include "twin/calibration/calibration_parts.h"
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double better = 0.9, frequency_floor = 1e-4;

MeasuredResponse response_of(const DriftRecord &record, const double low)
{
  MeasuredResponse data;
  data.places = record.places;
  for (const BlockSpectra &block : record.blocks) {
    const auto first = Eigen::Index(std::ceil(low * block.duration)), n = block.force.size() - first;
    const double scale = std::sqrt(2 / block.duration) / record.rate;  // |.|^2 a one-sided density
    BandRecord band;
    band.duration = block.duration;
    band.angular =
        Eigen::VectorXd::LinSpaced(n, double(first), double(first + n - 1)) * (2 * M_PI / block.duration);
    band.force        = block.force.tail(n) * scale;
    band.acceleration = block.response.bottomRows(n) * scale;
    data.pieces.push_back(std::move(band));
  }
  return data;
}

// theta at which the identified modes have the frequencies that were measured, as near to the prior as that
// allows.
Eigen::VectorXd start_of(const FittedStand &stand, const std::vector<Unknown> &unknowns, const DriftRecord &record)
{
  const auto p          = Eigen::Index(unknowns.size());
  Eigen::VectorXd theta = Eigen::VectorXd::Zero(p);
  for (int round = 0; round < 5; ++round) {
    const StandAt changed = stand_at(stand, unknowns, theta);
    Eigen::MatrixXd A     = Eigen::MatrixXd::Zero(p, p);
    Eigen::VectorXd b     = Eigen::VectorXd::Zero(p);
    for (Eigen::Index j = 0; j < p; ++j) {
      const double sd = unknowns[std::size_t(j)].prior_sd;
      A(j, j)         = 1 / (sd * sd);
      b[j]            = -theta[j] / (sd * sd);
    }
    for (std::size_t i = 0; i < record.modes.size() && Eigen::Index(i) < changed.frequency.size(); ++i) {
      if (!record.modes[i].why_not.empty())
        continue;
      const double w      = changed.frequency[Eigen::Index(i)],
                   off    = std::log(2 * M_PI * record.modes[i].frequency / w),
                   sd     = std::max(record.modes[i].sd, frequency_floor);
      Eigen::VectorXd row = Eigen::VectorXd::Zero(p);  // d ln w / d theta: half the strain share
      for (Eigen::Index j = 0; j < p; ++j)
        if (const auto &K = changed.stiffness[std::size_t(j)]; K.size())
          row[j] = 0.5 * K(Eigen::Index(i), Eigen::Index(i)) / (w * w);
      A += row * row.transpose() / (sd * sd);
      b += row * (off / (sd * sd));
    }
    theta += A.ldlt().solve(b);
  }
  return theta;
}

// The identified values of a fit; an estimate far from its prior is the reason to refuse.
void judge(Recalibration &result, const Fit &fit, const RecalibrationSettings &settings)
{
  const Eigen::VectorXd sd = fit.sd(), shrink = fit.shrink();
  for (std::size_t j = 0; j < fit.unknowns.size(); ++j)
    for (RecalibratedValue &value : result.values)
      if (value.name == fit.unknowns[j].name) {
        const auto i     = Eigen::Index(j);
        value.change     = fit.estimate[i];
        value.sd         = sd[i];
        value.identified = shrink[i] <= settings.identified_below;
        if (std::abs(value.change) > far_from_prior * value.prior_sd)
          result.refused =
              fmt::format("{} would move by {:+.1f} %, beyond {:.0f} of its prior standard deviations", value.name,
                          100 * std::expm1(value.change), far_from_prior);
      }
}
}  // namespace

Recalibration recalibrate(const FittedStand &stand, std::vector<Unknown> unknowns, const DriftRecord &record,
                          const RecalibrationSettings &settings)
{
  Recalibration result;
  for (const BlockSpectra &block : record.blocks)
    result.seconds += block.duration;
  std::vector<double> known;  // before the change
  for (Unknown &unknown : unknowns) {
    known.push_back(unknown.prior_sd);
    unknown.prior_sd = std::max(settings.wider * unknown.prior_sd, settings.least);
    result.values.push_back({unknown.name, unknown.prior_sd, 0, unknown.prior_sd, false});
  }
  const MeasuredResponse data = response_of(record, settings.low);
  FitSettings fit_settings;
  fit_settings.renewals = settings.renewals;
  Eigen::VectorXd start = start_of(stand, unknowns, record);
  Fit fit               = fitted(stand, unknowns, start, data, fit_settings);
  judge(result, fit, settings);
  std::vector<Unknown> identified;
  std::vector<double> estimates;
  for (std::size_t j = 0; j < unknowns.size(); ++j)
    if (result.values[j].identified) {
      identified.push_back(unknowns[j]);
      estimates.push_back(fit.estimate[Eigen::Index(j)]);
    } else {
      result.values[j].change = 0;
      result.values[j].sd     = known[j];
    }
  if (identified.empty()) {
    result.refused = "the blocks since the change identify no parameter";
    return result;
  }
  if (identified.size() < unknowns.size()) {
    fit = fitted(stand, identified, Eigen::Map<Eigen::VectorXd>(estimates.data(), Eigen::Index(estimates.size())),
                 data, fit_settings);
    judge(result, fit, settings);
  }
  double values = 0;
  for (const BandRecord &band : data.pieces)
    values += double(band.acceleration.size());
  const auto misfit = [&](const Eigen::VectorXd &theta) {
    return likelihood(stand, identified, theta, data, fit.noise, Wanted::cost).residual / values;
  };
  result.misfit_after  = misfit(fit.estimate);
  result.misfit_before = misfit(Eigen::VectorXd::Zero(fit.estimate.size()));
  if (result.refused.empty() && !(result.misfit_after < better * result.misfit_before))
    result.refused = fmt::format("no other parameters explain these blocks better: misfit {:.3f} against {:.3f}",
                                 result.misfit_after, result.misfit_before);
  return result;
}
}  // namespace mill::twin
