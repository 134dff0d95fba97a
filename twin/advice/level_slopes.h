#pragma once
#include "dynamics/response/mill_model.h"
#include "twin/advice/force_band.h"
#include <Eigen/Core>
#include <string>
#include <vector>

namespace mill::twin {
/// How the rms accelerations of a chain follow its numbers.
struct LevelSlopes {
  std::vector<std::string> names;  ///< (p) "K1" .. "M6", "zeta": all damping ratios at once
  Eigen::MatrixXd slope;           ///< (m, p) -, d ln level / d ln number; 0 where nothing moves
  double of(Eigen::Index place, const std::string &name) const;  ///< NaN: no such number
};

/// d ln rms / d ln p = sum Re(H* dH/d ln p) / sum |H|^2 over the band, the damping ratios kept where a spring or a
/// mass changes.  theory.md (46.6), 43
/// @param damping     (n) -, ratio of critical of every mode
/// @param gap_damper  N s/m
/// Cost: one response_slopes() for each frequency, some 5 us with six masses.
LevelSlopes level_slopes(const dynamics::MillModel &model, const Eigen::VectorXd &damping, double gap_damper,
                         const ForceBand &force);
}  // namespace mill::twin
