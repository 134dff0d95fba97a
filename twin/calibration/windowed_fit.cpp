#include "twin/calibration/windowed_fit.h"
#include "twin/calibration/hann_window.h"
#include "twin/calibration/modal_columns.h"
#include <algorithm>
#include <cmath>
#include <complex>

namespace mill::twin {
namespace {
/// What the stand shows in the averaged bins, and how that follows theta.
struct Shown {
  Eigen::MatrixXcd H;                   ///< (k, m)
  std::vector<Eigen::MatrixXcd> slope;  ///< (m) (k, p); empty: not wanted
};

Shown shown(const WindowedFit &fit, const Eigen::VectorXd &theta, const Wanted wanted)
{
  const bool slopes    = wanted != Wanted::cost;
  const StandAt modes  = stand_at(fit.stand, fit.unknowns, theta);
  const Eigen::Index p = theta.size(), k = fit.measured.H.rows(), n = modes.frequency.size();
  const Block whole{0, fit.fine.angular.size()};
  ModalColumns c = modal_columns(modes, fit.fine, whole);
  if (slopes)
    add_derivatives(c, modes, fit.unknowns, fit.fine, whole, Eigen::VectorXd::Zero(2 * n));
  Shown model{Eigen::MatrixXcd(k, fit.measured.H.cols()), {}};
  for (std::size_t j = 0; j < fit.places.size(); ++j) {
    const Eigen::VectorXd shape  = modes.shape.row(fit.places[j]).transpose();
    model.H.col(Eigen::Index(j)) = seen_through(c.driven.matrix() * shape, fit.weights, k);
    if (!slopes)
      continue;
    Eigen::MatrixXcd J(k, p);
    for (Eigen::Index q = 0; q < p; ++q)
      J.col(q) = seen_through(c.derivative[std::size_t(q)].matrix() * shape, fit.weights, k);
    model.slope.push_back(std::move(J));
  }
  return model;
}

Likelihood nothing(const Eigen::Index unknowns, const Wanted wanted)
{
  Likelihood sum;
  if (wanted != Wanted::cost) {
    sum.slope       = Eigen::VectorXd::Zero(unknowns);
    sum.information = Eigen::MatrixXd::Zero(unknowns, unknowns);
  }
  return sum;
}
}  // namespace

AveragedResponse averaged_response(const CrossSpectra &s, const double low, const double high)
{
  const double df          = s.rate / double(s.L);
  const Eigen::Index first = std::max<Eigen::Index>(2, Eigen::Index(std::ceil(low / df))),
                     last  = std::min<Eigen::Index>(s.L / 2 - 1, Eigen::Index(std::floor(high / df)));
  const Eigen::Index k = std::max<Eigen::Index>(0, last - first + 1), m = s.response.cols();
  AveragedResponse e{first, 2 * M_PI * df, Eigen::MatrixXcd(k, m), Eigen::MatrixXd(k, m)};
  for (Eigen::Index b = 0; b < k; ++b)
    for (Eigen::Index j = 0; j < m; ++j) {
      const double FF = std::max(s.force[first + b], 1e-300), YY = s.response(first + b, j);
      const auto FY = s.cross(first + b, j);
      e.H(b, j)     = FY / FF;
      // what one force does not explain, never less than 1e-6 of it: rounding is not a measurement
      const double left = std::max(YY - std::norm(FY) / FF, 1e-6 * YY);
      e.variance(b, j)  = std::max(left / (FF * std::max(1.0, s.averages() - 1)), 1e-300);
    }
  return e;
}

WindowedFit windowed_fit(const FittedStand &stand, const std::vector<Unknown> &unknowns,
                         const std::vector<Eigen::Index> &places, const AveragedResponse &measured)
{
  return {stand,         unknowns, places, measured, fine_grid(measured.bin, measured.first, measured.H.rows()),
          hann_weights()};
}

Likelihood WindowedFit::squares(const Eigen::VectorXd &theta, const Wanted wanted) const
{
  const Shown model = shown(*this, theta, wanted);
  Likelihood sum    = nothing(theta.size(), wanted);
  for (Eigen::Index j = 0; j < measured.H.cols(); ++j) {
    const Eigen::ArrayXd w = measured.variance.col(j).array().rsqrt();
    const Eigen::VectorXcd r =
        ((measured.H.col(j) - model.H.col(j)).array() * w.cast<std::complex<double>>()).matrix();
    sum.residual += r.squaredNorm();
    if (wanted == Wanted::cost)
      continue;
    const Eigen::MatrixXcd J = w.matrix().asDiagonal() * model.slope[std::size_t(j)];
    sum.slope -= 2 * (J.adjoint() * r).real();
    sum.information += 2 * (J.adjoint() * J).real();
  }
  sum.cost = sum.residual;
  add_prior(sum, unknowns, theta);
  return sum;
}

Likelihood WindowedFit::logarithms(const Eigen::VectorXd &theta, const Wanted wanted) const
{
  constexpr double least = 0.3;  // ln: no bin is worth more than a misfit of a third
  const Shown model      = shown(*this, theta, wanted);
  Likelihood sum         = nothing(theta.size(), wanted);
  for (Eigen::Index j = 0; j < measured.H.cols(); ++j) {
    const Eigen::ArrayXd size  = measured.H.col(j).array().abs().max(1e-300);
    const Eigen::ArrayXcd H    = model.H.col(j).array();
    const Eigen::ArrayXd shape = H.abs().max(1e-300);
    const Eigen::ArrayXd w     = (measured.variance.col(j).array() / size.square() + least * least).rsqrt();
    const Eigen::VectorXd r    = ((size.log() - shape.log()) * w).matrix();
    sum.residual += 0.5 * r.squaredNorm();
    if (wanted == Wanted::cost)
      continue;
    // d ln |H| = Re(dH / H)
    const Eigen::VectorXcd by = (H.conjugate() / shape.square() * w.cast<std::complex<double>>()).matrix();
    const Eigen::MatrixXd J   = (by.asDiagonal() * model.slope[std::size_t(j)]).real();
    sum.slope -= J.transpose() * r;
    sum.information += J.transpose() * J;
  }
  sum.cost = sum.residual;
  add_prior(sum, unknowns, theta);
  return sum;
}
}  // namespace mill::twin
