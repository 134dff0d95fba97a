#pragma once
#include "dynamics/response/accelerance.h"
#include <vector>

namespace mill::dynamics {
/// An input of a stand that may be off, as its modes feel it.
struct UncertainInput {
  double error = 0;    ///< -, relative, taken as 1.96 standard deviations of its logarithm
  Eigen::MatrixXd dK;  ///< (n, n) 1/s2, change of the modal stiffness per relative change of the input
  Eigen::MatrixXd dM;  ///< (n, n) -, the same of the modal mass
};

struct BandSettings {
  int samples          = 400;
  unsigned seed        = 1;
  double damping_error = 0;  ///< -, relative, as UncertainInput::error
};

/// Magnitudes between which 95 of 100 stands lie that are drawn from the errors of the inputs.
struct ResponseBand {
  Eigen::MatrixXd low, high;            ///< (f, m) 1/kg, of the first force
  Eigen::MatrixXd peak_low, peak_high;  ///< (m, k) 1/kg, of the largest magnitude at a mode within the frequencies
};

/// Every sample moves all inputs at once, independent and log-normal, solves the modes again in the space of those
/// of the stand and sums over them; what the modes left out contribute stays as it is.  (32.6) to (32.8)
/// @param all         every mode of the stand, m places, k forces
/// @param n           modes that the inputs are known in
/// @param mode_error  (n) -, relative error of each frequency that belongs to no input (mesh, modes left out)
/// @param frequency   (f) Hz
/// Cost: per sample one eigenproblem of n and (f + n k) m n products.
ResponseBand response_band(const ModalResponse &all, Eigen::Index n, const std::vector<UncertainInput> &inputs,
                           const Eigen::VectorXd &mode_error, const Eigen::VectorXd &frequency,
                           const BandSettings &settings = {});
}  // namespace mill::dynamics
