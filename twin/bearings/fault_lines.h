#pragma once
#include "twin/spectra/fourier.h"
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

namespace mill::twin {
/// A bearing that turns with a roll, as far as its faults are heard.
struct TurningBearing {
  std::string name, roll;
  double roll_diameter;  ///< m
  double cage;           ///< turns per turn of the roll (FTF)
  double outer;          ///< rollers past a point of the outer ring (BPFO)
  double inner;          ///< of the inner ring (BPFI)
  double roller;         ///< turns of a roller (BSF); its faults are heard twice per turn
};

/// Spectrum of the squared envelope of a band.  theory.md (41.16)
struct EnvelopeSpectrum {
  double low = 0, high = 0;   ///< Hz, the band
  double kurtosis   = 0;      ///< -, of the signal in it; 3 for noise
  double resolution = 0;      ///< Hz
  Eigen::VectorXd magnitude;  ///< (n) unit^2, bins 0, 1, ..
};

/// @param value  (n) whole, n even with small prime factors is quick
/// @param low, high  Hz; both 0: the third octave of largest kurtosis above 1 kHz
EnvelopeSpectrum envelope_spectrum(const Eigen::Ref<const Eigen::VectorXd> &value, double rate, double low,
                                   double high, Fourier &fourier);

/// Levels at the harmonics of one kind of fault.
struct FaultLines {
  std::string family;             ///< "BPFO", "BPFI", "2 BSF", "FTF"
  double frequency = 0;           ///< Hz, by the geometry
  double slip      = 0;           ///< -, common to all harmonics, where the score is largest
  std::array<double, 4> ratio{};  ///< -, of each harmonic over the median of +-8 %
  double score = 0;               ///< -, third best ratio
  bool indicated() const
  {
    return score >= 5;
  }
  bool strong() const
  {
    return score >= 20;
  }
};

/// The four families one after the other, best first: what one explains, side bands included, is not evidence for
/// the next.  theory.md (41.17)
/// @param shaft  Hz, turns of the roll
std::vector<FaultLines> fault_lines(const EnvelopeSpectrum &spectrum, const TurningBearing &bearing, double shaft);
}  // namespace mill::twin
