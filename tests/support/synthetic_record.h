#pragma once
#include <Eigen/Core>
#include <complex>
#include <cstdint>
#include <string>
#include <vector>

// Records whose truth is known, by the recipes of the description of the twin (its section 7), written apart from
// the program.
namespace synthetic {
/// Uniform numbers of splitmix64, upper 53 bits.
Eigen::VectorXd uniforms(std::uint64_t seed, Eigen::Index n);
/// Normal numbers, pairs by Box and Muller.
Eigen::VectorXd normals(std::uint64_t seed, Eigen::Index n);
/// White noise of one-sided density `density` per sqrt(Hz).
Eigen::VectorXd white(std::uint64_t seed, Eigen::Index n, double rate, double density);

/// Force in a band: lines i rate/n in (low, high], each of normal amplitude.
struct BandForce {
  Eigen::VectorXd force;  ///< N, samples
  Eigen::VectorXd
      drive;  ///< N, samples of the same lines / sinc^2(f/rate): what straight lines between samples lack
};
BandForce band_force(std::uint64_t seed, Eigen::Index n, double rate, double rms, double low, double high);

/// A chain of six masses in its modes.
struct Chain {
  Eigen::VectorXd frequency;  ///< Hz
  Eigen::MatrixXd shape;      ///< (6, 6) mass-normalised, one column per mode
  Eigen::MatrixXd strain;     ///< (6, 7) share of the strain energy of mode i in spring j
  Eigen::MatrixXd kinetic;    ///< (6, 6) share of the kinetic energy of mode i in mass j
  double damping;             ///< ratio of critical
};
Chain chain(const Eigen::VectorXd &M, const Eigen::VectorXd &K, double damping);

/// Modal accelerations (n, modes) kg^1/2 m/s2 from equilibrium under the first value, straight lines between
/// samples of the drive; one mode at a time by its closed solution.
/// @param gain  (modes) kg^-1/2, force on each mode
Eigen::MatrixXd modal_response(const Eigen::VectorXd &frequency, const Eigen::VectorXd &gain, double damping,
                               const Eigen::VectorXd &drive, double rate);

/// Accelerations (n, 6) m/s2 of the masses, by modal_response().
Eigen::MatrixXd response(const Chain &chain, const Eigen::VectorXd &drive, double rate);

/// Sum of cosines {frequency, amplitude, phase}, offset, drift and white noise.
Eigen::VectorXd lines_record(const std::vector<std::array<double, 3>> &lines, double offset, double drift,
                             double density, std::uint64_t seed, Eigen::Index n, double rate);

/// A mode of growth rate sigma(t) driven by noise: complex envelope of rms `rms0` while sigma is -1.5 1/s, turned
/// at f0; white noise beside it.
struct Onset {
  Eigen::VectorXd signal;     ///< (n)
  Eigen::VectorXd amplitude;  ///< (n) of the mode alone, 0-peak
};
Onset onset(std::uint64_t seed, Eigen::Index n, double rate, double f0, double rms0, double density,
            const std::vector<double> &sigma);
}  // namespace synthetic
