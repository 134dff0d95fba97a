#include "twin/calibration/modal_columns.h"
#include <cmath>
#include <complex>

namespace mill::twin {
namespace {
using Complex = std::complex<double>;

/// Share of the static response in a mode, (w_i^2 + 2 i zeta w_i w)/d_i, under a force in straight lines between
/// its samples: the transfer function of the samples, exact (first-order hold).  (44.9)
class HeldMode {
public:
  HeldMode(const double w, const double zeta, const double step)
  {
    // partial fractions r/(s - p) + r'/(s - p'); apart also where the mode is critically damped
    const Complex root = std::sqrt(Complex(zeta * zeta - 1 + 1e-12, 0)) * w;
    const Complex p[]  = {-zeta * w + root, -zeta * w - root};
    for (int k = 0; k < 2; ++k) {
      const Complex residue = (w * w + 2 * zeta * w * p[k]) / (p[k] - p[1 - k]), x = p[k] * step;
      forth[k]            = std::exp(x);
      const Complex scale = residue * step / (x * x);
      ahead[k]            = scale * (forth[k] - 1.0 - x);
      behind[k]           = scale * (1.0 - forth[k] + x * forth[k]);
    }
  }
  Complex operator()(const Complex z) const
  {
    return (ahead[0] * z + behind[0]) / (z - forth[0]) + (ahead[1] * z + behind[1]) / (z - forth[1]);
  }

private:
  Complex forth[2], ahead[2], behind[2];
};

/// The whole acceleration of the modes in the samples: the force on the masses less what springs and dampers take.
void hold_lines(ModalColumns &c, const StandAt &stand, const BandRecord &band, const Block &block)
{
  for (Eigen::Index i = 0; i < stand.frequency.size(); ++i) {
    const HeldMode held(stand.frequency[i], stand.damping[i], band.line_step);
    for (Eigen::Index b = 0; b < block.size; ++b) {
      const double w = band.angular[block.first + b], sinc = sinc_of(w, band.line_step);
      const Complex sampled =
          band.force[block.first + b] / (sinc * sinc) * std::polar(1.0, -w * stand.delay) * stand.force[i];
      c.driven(b, i) = sampled * (1.0 - held(std::polar(1.0, w * band.line_step)));
    }
  }
}
}  // namespace

ModalColumns modal_columns(const StandAt &stand, const BandRecord &band, const Block &block)
{
  const Eigen::Index n = stand.frequency.size();
  ModalColumns c;
  c.admittance.resize(block.size, n);
  c.driven.resize(block.size, n);
  for (Eigen::Index b = 0; b < block.size; ++b) {
    const double w                = band.angular[block.first + b];
    const std::complex<double> up = -w * w * band.force[block.first + b] * std::polar(1.0, -w * stand.delay);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double re = (stand.frequency[i] - w) * (stand.frequency[i] + w),
                   im = 2 * stand.damping[i] * stand.frequency[i] * w, size = re * re + im * im;
      c.admittance(b, i) = std::complex<double>(re / size, -im / size);
      c.driven(b, i)     = up * stand.force[i] * c.admittance(b, i);
    }
  }
  if (band.line_step > 0)
    hold_lines(c, stand, band, block);
  return c;
}

void add_derivatives(ModalColumns &c, const StandAt &stand, const std::vector<Unknown> &unknowns,
                     const BandRecord &band, const Block &block, const Eigen::VectorXd &transient)
{
  const auto w            = band.angular.segment(block.first, block.size).array();
  const Eigen::Index n    = stand.frequency.size();
  Eigen::ArrayXXcd motion = c.driven, folded;
  if (band.line_step > 0) {
    for (Eigen::Index b = 0; b < block.size; ++b) {
      const double wb  = w[b];
      const Complex up = -wb * wb * band.force[block.first + b] * std::polar(1.0, -wb * stand.delay);
      for (Eigen::Index i = 0; i < n; ++i)
        motion(b, i) = up * stand.force[i] * c.admittance(b, i);
    }
    folded = c.driven - motion;  // next to g F (1 - sinc^2)
  }
  for (Eigen::Index i = 0; i < stand.frequency.size(); ++i) {
    // beta is scaled by 1/w_i, so that both numbers of a mode have the same size
    const double alpha = transient[2 * i], beta = transient[2 * i + 1] / stand.frequency[i];
    for (Eigen::Index b = 0; b < block.size; ++b)
      motion(b, i) += std::complex<double>(alpha, beta * w[b]) * c.admittance(b, i);
  }
  for (std::size_t p = 0; p < unknowns.size(); ++p) {
    Eigen::ArrayXXcd d;
    if (moves(unknowns[p]) == Moves::gain)
      d = c.driven;
    else if (moves(unknowns[p]) == Moves::delay) {
      d = c.driven;
      for (Eigen::Index b = 0; b < block.size; ++b)
        d.row(b) *= std::complex<double>(0, -w[b]);
    } else {
      const Eigen::MatrixXcd still  = motion.matrix() * stand.stiffness[p],
                             moving = motion.matrix() * stand.damper[p];
      d.resize(block.size, still.cols());
      for (Eigen::Index i = 0; i < still.cols(); ++i)
        for (Eigen::Index b = 0; b < block.size; ++b)
          d(b, i) = -(still(b, i) + std::complex<double>(0, w[b]) * moving(b, i)) * c.admittance(b, i);
      if (stand.mass[p].size()) {
        const Eigen::MatrixXcd heavy = motion.matrix() * stand.mass[p];
        for (Eigen::Index i = 0; i < heavy.cols(); ++i)
          for (Eigen::Index b = 0; b < block.size; ++b)
            d(b, i) += w[b] * w[b] * heavy(b, i) * c.admittance(b, i);
        if (folded.size())
          d -= (folded.matrix() * stand.mass[p]).array();
      }
    }
    c.derivative.push_back(std::move(d));
  }
}
}  // namespace mill::twin
