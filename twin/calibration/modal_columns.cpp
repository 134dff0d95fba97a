#include "twin/calibration/modal_columns.h"
#include <cmath>
#include <complex>

namespace mill::twin {

ModalColumns modal_columns(const StandAt &at, const BandRecord &band, const Block &block)
{
  const Eigen::Index n = at.frequency.size();
  ModalColumns c;
  c.admittance.resize(block.size, n);
  c.driven.resize(block.size, n);
  for (Eigen::Index b = 0; b < block.size; ++b) {
    const double w                = band.angular[block.first + b];
    const std::complex<double> up = -w * w * band.force[block.first + b] * std::polar(1.0, -w * at.delay);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double re = (at.frequency[i] - w) * (at.frequency[i] + w),
                   im = 2 * at.damping[i] * at.frequency[i] * w, size = re * re + im * im;
      c.admittance(b, i) = std::complex<double>(re / size, -im / size);
      c.driven(b, i)     = up * at.force[i] * c.admittance(b, i);
    }
  }
  return c;
}

void add_derivatives(ModalColumns &c, const StandAt &at, const std::vector<Unknown> &unknowns,
                     const BandRecord &band, const Block &block, const Eigen::VectorXd &transient)
{
  const auto w            = band.angular.segment(block.first, block.size).array();
  Eigen::ArrayXXcd motion = c.driven;
  for (Eigen::Index i = 0; i < at.frequency.size(); ++i) {
    // beta is scaled by 1/w_i, so that both numbers of a mode have the same size
    const double alpha = transient[2 * i], beta = transient[2 * i + 1] / at.frequency[i];
    for (Eigen::Index b = 0; b < block.size; ++b)
      motion(b, i) += std::complex<double>(alpha, beta * w[b]) * c.admittance(b, i);
  }
  for (std::size_t p = 0; p < unknowns.size(); ++p) {
    Eigen::ArrayXXcd d;
    if (unknowns[p].name == "gain")
      d = c.driven;
    else if (unknowns[p].name == "delay") {
      d = c.driven;
      for (Eigen::Index b = 0; b < block.size; ++b)
        d.row(b) *= std::complex<double>(0, -w[b]);
    } else {
      const Eigen::MatrixXcd still = motion.matrix() * at.stiffness[p], moving = motion.matrix() * at.damper[p];
      d.resize(block.size, still.cols());
      for (Eigen::Index i = 0; i < still.cols(); ++i)
        for (Eigen::Index b = 0; b < block.size; ++b)
          d(b, i) = -(still(b, i) + std::complex<double>(0, w[b]) * moving(b, i)) * c.admittance(b, i);
      if (at.mass[p].size()) {
        const Eigen::MatrixXcd heavy = motion.matrix() * at.mass[p];
        for (Eigen::Index i = 0; i < heavy.cols(); ++i)
          for (Eigen::Index b = 0; b < block.size; ++b)
            d(b, i) += w[b] * w[b] * heavy(b, i) * c.admittance(b, i);
      }
    }
    c.derivative.push_back(std::move(d));
  }
}
}  // namespace mill::twin
