#pragma once
#include "dynamics/response/response.h"
#include "dynamics/response/spectrum.h"
#include <array>

// Levels and spectra of a pass with what judges them: no text, no files.
namespace mill::dynamics {
/// Of the upper and of the lower work roll, where there are two.
struct PassStudy {
  Response response;
  std::array<Level, 2> level;
  std::array<Level, 2> half_rate;  ///< at half the output rate: what the sampling moves
  Spectrum force;                  ///< N/sqrt(Hz)
  std::array<Spectrum, 2> rolls;   ///< m/s2/sqrt(Hz)
};

/// A linear model driven at the output rate (Hz), and once more at half of it.
/// Errors as mill_response; cost one and a half of it.
PassStudy pass_study(const DrivenModel &model, const ForceRecord &force, double output_rate);

/// A response made otherwise, of which half the rate keeps every other sample.
PassStudy pass_study(const Response &response, double output_rate);
}  // namespace mill::dynamics
