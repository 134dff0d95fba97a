#pragma once
#include "twin/modes/decimated.h"
#include "twin/spectra/fourier.h"

namespace mill::twin {
/// First singular value of the matrix of cross spectra: how much all channels move together.  theory.md (42.13)
struct FirstSingularValue {
  Eigen::VectorXd frequency;  ///< (k) Hz
  Eigen::VectorXd value;      ///< (k) 1/Hz, of channels divided by their rms
};

/// @param highest  Hz
/// Hann window, half-overlapping segments of about a second.  Cost p transforms of each segment, p^2 per bin.
FirstSingularValue first_singular_value(const DecimatedRecord &record, double highest, Fourier &fourier);
}  // namespace mill::twin
