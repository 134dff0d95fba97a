#pragma once
#include "twin/calibration/band_record.h"
#include "twin/calibration/fitted_stand.h"
#include <Eigen/Core>
#include <vector>

namespace mill::twin {
/// Bins first .. first + size - 1 of one piece.
struct Block {
  Eigen::Index first, size;
};

/// What a stand does in one block of bins that does not depend on the sensor: (k, n), one column per mode.  A
/// sensor sees it through its row of the shapes.
struct ModalColumns {
  Eigen::ArrayXXcd admittance;  ///< 1/d_i
  /// -w^2 g_i F/d_i, F late by the delay; of a force in straight lines with all that the samples fold back
  Eigen::ArrayXXcd driven;
  std::vector<Eigen::ArrayXXcd> derivative;  ///< (p) of the modal accelerations to theta
};

ModalColumns modal_columns(const StandAt &stand, const BandRecord &band, const Block &block);

/// Of a force in straight lines the slopes are those of what is not folded back, and of the masses' share in that.
/// (44.3): -A_p x / d for what changes the stand; the driven part itself for gain and delay.
/// @param transient  (2 n) alpha_i and beta_i w_i of each mode
void add_derivatives(ModalColumns &c, const StandAt &stand, const std::vector<Unknown> &unknowns,
                     const BandRecord &band, const Block &block, const Eigen::VectorXd &transient);
}  // namespace mill::twin
