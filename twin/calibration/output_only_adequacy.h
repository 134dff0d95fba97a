#pragma once
#include "twin/calibration/adequacy.h"
#include "twin/calibration/output_only_start.h"
#include <vector>

// Is the model right, where no force was recorded?  theory.md 45.5
namespace mill::twin {
/// Density of the force that one narrow band needs, over a density that is smooth over a third octave.
struct LevelBand {
  double centre;      ///< Hz, twelve bands an octave
  Eigen::Index bins;  ///< of the whole record's transform
  double ratio;       ///< -, 1 where the density is smooth and the stand right
  double limit;       ///< -, (1.05 + 4 / sqrt(bins)) (1 + model error)^2; as a factor both ways
  double energy;      ///< -, share of the accelerations' energy in the whole band
  bool decisive;      ///< accelerations show more of the force than of the noise, and 1 % of the energy is here
  double excess() const;  ///< ratio or its inverse, over the limit
  bool wrong() const
  {
    return decisive && excess() > 1;
  }
};

/// Residual of the stand with one force per third octave, over the residual that any one force leaves of the
/// spectral matrices; `sensor` is -1: all of them together, over the root of their noise.  None of one sensor
/// alone.
std::vector<BandResidual> direction_residuals(const OutputOnly &record, const std::vector<SeenForce> &seen,
                                              const NoiseDensity &noise, const std::vector<ForcedSamples> &pieces,
                                              double rate, double low, double high,
                                              double model_error = usual_model_error);

std::vector<LevelBand> level_bands(const OutputOnly &record, const std::vector<SeenForce> &seen, double low,
                                   double high, double model_error = usual_model_error);

/// Mean of |r|^2 over the noise of what no single force explains with the directions of the stand; of one sensor
/// alone that of the levels, 2 bins (x - 1 - ln x).  1 where the stand explains the records.
double output_only_misfit(const OutputOnly &record, const Eigen::VectorXd &theta, const NoiseDensity &noise,
                          double low, double high);
}  // namespace mill::twin
