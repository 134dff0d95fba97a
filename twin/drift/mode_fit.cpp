#include "twin/drift/mode_fit.h"
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>

namespace mill::twin {
namespace {
using Complex = std::complex<double>;
using Columns = Eigen::MatrixXd;  // (2 lines, columns): real parts above imaginary parts

constexpr double fitted_half_widths = 5;  // of the band on each side
constexpr Eigen::Index least_lines = 240, mode_columns = 4;
constexpr double least_significance = 60;

Eigen::VectorXd parts(const Eigen::ArrayXcd &a)
{
  Eigen::VectorXd real(2 * a.size());
  real << a.real().matrix(), a.imag().matrix();
  return real;
}

// Lines first .. first + n - 1 around a frequency.
struct Band {
  Eigen::Index first = 0, n = 0;
};

Band band_around(const BlockSpectra &block, const ExpectedMode &mode)
{
  const double reach  = std::max(fitted_half_widths * mode.damping * mode.frequency * block.duration,
                                 double(least_lines) / 2),
               centre = mode.frequency * block.duration;
  const auto first    = std::max<Eigen::Index>(1, Eigen::Index(std::ceil(centre - reach)));
  const auto last     = std::min(block.force.size() - 1, Eigen::Index(std::floor(centre + reach)));
  return {first, std::max<Eigen::Index>(0, last - first + 1)};
}

Eigen::ArrayXcd dynamic_stiffness(const Eigen::ArrayXd &w, const ExpectedMode &mode)
{
  const double w0 = 2 * M_PI * mode.frequency;
  Eigen::ArrayXcd d(w.size());
  d.real() = w0 * w0 - w.square();
  d.imag() = 2 * mode.damping * w0 * w;
  return d;
}

// The block's lines in a band, what does not depend on frequency and damping taken off.
class NarrowBand {
public:
  NarrowBand(const BlockSpectra &block, const Band &band, const std::vector<ExpectedMode> &others)
      : w((Eigen::ArrayXd::LinSpaced(band.n, double(band.first), double(band.first + band.n - 1)) *
           (2 * M_PI / block.duration))),
        force(block.force.segment(band.first, band.n).array()), measured(2 * band.n, block.response.cols())
  {
    const double middle = w.mean(), reach = 0.5 * (w[w.size() - 1] - w[0]), size = std::sqrt(force.abs2().mean());
    force /= size > 0 ? size : 1;
    const Eigen::ArrayXcd across = ((w - middle) / reach).cast<Complex>(), one = across * 0. + 1.;
    std::vector<Eigen::ArrayXcd> columns;
    const auto both = [&](const Eigen::ArrayXcd &a) {  // a complex factor
      columns.push_back(a);
      columns.push_back(a * Complex(0, 1));
    };
    for (const Eigen::ArrayXcd &a : {Eigen::ArrayXcd(force), Eigen::ArrayXcd(force * across),
                                     Eigen::ArrayXcd(force * across.square()), one, across})
      both(a);
    for (const ExpectedMode &other : others) {
      const Eigen::ArrayXcd d = dynamic_stiffness(w, other) / (2 * other.damping * std::pow(middle, 2));
      both(force / d);
      both(one / d);
    }
    Columns fixed(2 * band.n, Eigen::Index(columns.size()));
    for (std::size_t i = 0; i < columns.size(); ++i)
      fixed.col(Eigen::Index(i)) = parts(columns[i]);
    basis = orthonormal(fixed);
    for (Eigen::Index s = 0; s < measured.cols(); ++s)
      measured.col(s) = parts(block.response.col(s).segment(band.first, band.n).array());
    measured = rest(basis, measured);
    noise    = measured.colwise().squaredNorm() / dof();
  }

  // Degrees of freedom of a sensor's residual.
  double dof() const
  {
    return double(measured.rows() - basis.cols() - mode_columns);
  }

  struct Point {
    double cost = 0;          // half the weighted squares
    Eigen::VectorXd squares;  // (sensors) not weighted
    Eigen::Vector2d slope;
    Eigen::Matrix2d information;
  };

  // @param slopes  also the slopes by ln frequency and ln damping, with those of the eliminated unknowns
  Point at(const ExpectedMode &mode, const bool slopes) const
  {
    const double w0 = 2 * M_PI * mode.frequency, scale = 2 * mode.damping * w0 * w0;
    const Eigen::ArrayXcd d       = dynamic_stiffness(w, mode) / scale;
    const Eigen::ArrayXcd shape[] = {force * (w / w0).square(), force * (w / w0).square() * Complex(0, 1),
                                     Eigen::ArrayXcd::Ones(w.size()), (w / w0).cast<Complex>() * Complex(0, 1)};
    Columns columns(2 * w.size(), mode_columns);
    for (int i = 0; i < mode_columns; ++i)
      columns.col(i) = parts(shape[i] / d);
    columns = rest(basis, columns);
    const Eigen::HouseholderQR<Columns> qr(columns);
    const Columns Q = qr.householderQ() * Columns::Identity(columns.rows(), mode_columns);
    const Eigen::MatrixXd coefficients =
        qr.matrixQR().topRows(mode_columns).triangularView<Eigen::Upper>().solve(Q.transpose() * measured);
    const Columns residual = rest(Q, measured);
    Point point;
    point.squares = residual.colwise().squaredNorm();
    point.cost    = 0.5 * (point.squares.array() / noise.array()).sum();
    if (!slopes)
      return point;
    const Eigen::ArrayXcd by_damping   = Complex(0, 2 * mode.damping * w0) * w / scale,
                          by_frequency = 2 * w0 * w0 / scale + by_damping;
    point.slope.setZero();
    point.information.setZero();
    Columns moved[2] = {Columns(columns.rows(), mode_columns), Columns(columns.rows(), mode_columns)};
    for (int i = 0; i < mode_columns; ++i) {
      moved[0].col(i) = parts(-shape[i] * by_frequency / d.square());
      moved[1].col(i) = parts(-shape[i] * by_damping / d.square());
    }
    for (Columns &m : moved)
      m = rest(Q, rest(basis, m));
    for (Eigen::Index s = 0; s < measured.cols(); ++s) {
      Columns J(columns.rows(), 2);  // of the fitted part
      J << moved[0] * coefficients.col(s), moved[1] * coefficients.col(s);
      point.slope -= J.transpose() * residual.col(s) / noise[s];
      point.information += J.transpose() * J / noise[s];
    }
    return point;
  }

  void weigh(const Eigen::VectorXd &squares)
  {
    noise = (squares / dof()).cwiseMax(1e-12 * measured.colwise().squaredNorm().transpose() / dof());
    noise = noise.cwiseMax(std::numeric_limits<double>::min());
  }

  // Twice the gain of the logarithm of the likelihood by the mode's own columns, at the noise of the residual.
  double significance(const Point &point) const
  {
    return ((measured.colwise().squaredNorm().transpose() - point.squares).array() / noise.array()).sum();
  }

private:
  static Columns orthonormal(const Columns &a)
  {
    const Eigen::ColPivHouseholderQR<Columns> qr(a);
    return qr.householderQ() * Columns::Identity(a.rows(), qr.rank());
  }
  static Columns rest(const Columns &Q, const Columns &a)
  {
    return a - Q * (Q.transpose() * a);
  }

  Eigen::ArrayXd w;  // rad/s
  Eigen::ArrayXcd force;
  Columns measured, basis;
  Eigen::VectorXd noise;  // (sensors) variance of a part
};

// Lowest of a coarse grid over the band.
ExpectedMode coarse_minimum(const NarrowBand &band, const ExpectedMode &expected)
{
  ExpectedMode best = expected;
  double lowest     = std::numeric_limits<double>::infinity();
  for (double width = -0.9 * fitted_half_widths; width <= 0.9 * fitted_half_widths; width += 0.5) {
    ExpectedMode mode = expected;
    mode.frequency *= 1 + width * expected.damping;
    if (const double cost = band.at(mode, false).cost; cost < lowest) {
      lowest = cost;
      best   = mode;
    }
  }
  return best;
}

// Levenberg and Marquardt over ln frequency and ln damping; the noise is renewed with every step taken.
NarrowBand::Point minimise(NarrowBand &band, ExpectedMode &mode)
{
  auto here     = band.at(mode, true);
  double lambda = 1e-3;
  for (int i = 0; i < 30; ++i) {
    band.weigh(here.squares);
    here = band.at(mode, true);
    const Eigen::Matrix2d A =
        here.information + lambda * Eigen::Matrix2d(here.information.diagonal().asDiagonal());
    const Eigen::Vector2d move = (-A.inverse() * here.slope).cwiseMax(-0.5).cwiseMin(0.5);
    ExpectedMode next{mode.frequency * std::exp(move[0]), mode.damping * std::exp(move[1])};
    next.damping     = std::clamp(next.damping, 1e-5, 0.3);
    const auto there = band.at(next, false);
    if (!(there.cost < here.cost)) {
      lambda *= 10;
      if (lambda > 1e6)
        break;
      continue;
    }
    lambda         = std::max(1e-9, 0.1 * lambda);
    const bool end = here.cost - there.cost < 1e-5;
    mode           = next;
    here           = band.at(mode, true);
    if (end)
      break;
  }
  band.weigh(here.squares);
  return band.at(mode, true);
}
}  // namespace

ModeFit fit_mode(const BlockSpectra &block, const ExpectedMode &expected, const std::vector<ExpectedMode> &others)
{
  ModeFit fit;
  ExpectedMode mode = expected;
  NarrowBand::Point point;
  for (int centred = 0; centred < 3; ++centred) {
    ExpectedMode centre = mode;
    centre.damping      = std::max(mode.damping, expected.damping);
    const Band lines    = band_around(block, centre);
    if (lines.n < least_lines / 2) {
      fit.why_not = "its band lies beyond the record's";
      return fit;
    }
    std::vector<ExpectedMode> within;
    for (const ExpectedMode &other : others)
      if (std::abs(other.frequency * block.duration - double(lines.first + lines.n / 2)) < double(lines.n))
        within.push_back(other);
    NarrowBand band(block, lines, within);
    fit.lines = lines.n;
    if (band.dof() < 10) {
      fit.why_not = "its band has too few lines";
      return fit;
    }
    mode             = coarse_minimum(band, centre);
    mode.damping     = centre.damping;
    point            = minimise(band, mode);
    fit.significance = band.significance(point);
    if (std::abs(mode.frequency / centre.frequency - 1) < 0.5 * fitted_half_widths * centre.damping)
      break;
  }
  fit.frequency                    = mode.frequency;
  fit.damping                      = mode.damping;
  const Eigen::Matrix2d covariance = point.information.inverse();
  fit.sd                           = std::sqrt(covariance(0, 0));
  fit.damping_sd                   = std::sqrt(covariance(1, 1));
  if (!(fit.significance > least_significance))
    fit.why_not = "the force does not move it above the noise";
  else if (!(fit.sd < 0.25 * mode.damping))
    fit.why_not = "its peak is lost among the others";
  return fit;
}
}  // namespace mill::twin
