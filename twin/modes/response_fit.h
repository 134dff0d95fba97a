#pragma once
#include "twin/modes/force_response.h"
#include <Eigen/Core>
#include <complex>
#include <vector>

// Poles and residues of a frequency response in a narrow band, by least squares.  Chapter 42.3.
namespace mill::twin {
/// One pole of the fit.
struct FittedPole {
  std::complex<double> lambda;  ///< 1/s, upper half plane
  double frequency, damping;    ///< Hz, -
  double sd_frequency;          ///< Hz, standard deviation
  double sd_damping;            ///< -, same
  Eigen::VectorXcd residue;     ///< (p) unit of H times 1/s
  Eigen::VectorXd sd_residue;   ///< (p) same, of its real and imaginary part each, the pole held
};

/// Response of one pole as segments under a Hann window see it: its impulse response times the autocorrelation of
/// the window.  theory.md (42.11)
/// @param w  rad/s; @param length  s, of a segment
std::complex<double> windowed_pole(std::complex<double> lambda, double w, double length);

/// Fits H_p(w) = sum_r [a_pr W(w, lambda_r) + conj(a_pr) W(w, conj lambda_r)] + c_p + d_p w in the bins.
/// @param start  poles to begin with, upper half plane
/// @param first, last  bins, both used
/// @returns empty where it does not converge or a pole leaves the band
/// Intervals follow from what is left of H, bins counted as often as they are independent.  theory.md (42.12)
/// Cost: p (bins) (2 poles + 4)^2 times some ten steps.
std::vector<FittedPole> fit_response(const ForceResponse &response, const std::vector<std::complex<double>> &start,
                                     Eigen::Index first, Eigen::Index last);
}  // namespace mill::twin
