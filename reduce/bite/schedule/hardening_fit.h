#pragma once
#include "core/model/material.h"
#include <string>
#include <vector>

// One hardening law for several passes.  theory.md 39.3
namespace mill::bite {
/// What a pass contributes.
struct HardeningPoint {
  std::string pass;        ///< name, for messages
  double strain      = 0;  ///< -, ln(h0/h_out) > 0
  double flow_stress = 0;  ///< Pa, plane strain, fitted to the force of the pass
};

/// k/2 = Y ln(h0/h_out)^n, (39.4): two unknowns.
struct HardeningFit {
  double Y           = 0;                   ///< Pa, shear yield stress at a strain of one
  double n           = 0;                   ///< -
  double Y_deviation = not_given;           ///< -, standard deviation of ln Y; nan: as many data as unknowns
  double n_deviation = not_given;           ///< -
  std::vector<double> misfit;               ///< (passes) -, law over the fitted stress, less one
  int unknowns = 2;                         ///< -
  int data     = 0;                         ///< -
  double flow_stress(double strain) const;  ///< Pa, plane strain
};

/// Least squares in the logarithms of stress and strain.
/// @throws InputError  fewer passes than unknowns, all of one strain, a strain or a stress that is not positive
HardeningFit fit_hardening(const std::vector<HardeningPoint> &points);
}  // namespace mill::bite
