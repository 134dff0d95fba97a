#pragma once
#include "twin/spectra/welch.h"
#include <Eigen/Core>
#include <vector>

// What follows the speed of the mill and what does not.  Chapter 41.4.
namespace mill::twin {
/// Spectra of frames one after the other, half overlapping.
struct Waterfall {
  double rate    = 0;       ///< Hz
  Eigen::Index L = 0;       ///< samples of a frame
  Eigen::VectorXd time;     ///< (m) s, middle of each frame
  Eigen::VectorXd speed;    ///< (m) m/s, mean over the frame; empty: not recorded
  Eigen::MatrixXf density;  ///< (L/2 + 1, m) unit^2/Hz
};

/// Segment of frames of about 0.8 s at this rate: a power of two.
Eigen::Index frame_length(double rate);

/// @param speed  (n) m/s; empty: none
/// @param most   frames kept; more are averaged together
Waterfall waterfall(const Eigen::VectorXd &value, const std::vector<Span> &pieces, double rate,
                    const Eigen::VectorXd &speed, Eigen::Index L, Eigen::Index most, Fourier &fourier);

/// A channel over the rolled length s = integral of v dt, on even steps of v_min / rate.
struct OverLength {
  double rate = 0;        ///< 1/m, samples per metre
  Eigen::VectorXd value;  ///< (n) in the unit of the channel
  std::vector<Span> pieces;
};
/// Pieces, or parts of them, in which the mill runs (speed above a twentieth of the highest).  No pieces: the
/// mill does not run.
OverLength over_length(const Eigen::VectorXd &value, const std::vector<Span> &pieces, const Eigen::VectorXd &speed,
                       double rate);

/// How the level moves with the speed: exponent q for which the mean of ln P along f = f_ref (v / v_ref)^q is
/// largest; 0 fixed, 1 locked to the speed.  theory.md (41.10)
struct SpeedExponent {
  double q;     ///< -
  double gain;  ///< -, nepers of power over the median of all q
};
SpeedExponent speed_exponent(const Waterfall &map, double frequency, double reference_speed);

enum class Follows { fixed, locked, neither, cannot_tell };
const char *name_of(Follows follows);
/// 0 +- 0.1, 1 +- 0.1 or neither; "not distinguishable" where the speeds span less than five relative widths of
/// the peak.
/// @param span  -, highest over lowest speed, less one
Follows follows_speed(const SpeedExponent &exponent, double span, double relative_width);
}  // namespace mill::twin
