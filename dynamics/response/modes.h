#pragma once
#include "dynamics/response/mill_model.h"
#include <Eigen/Core>
#include <vector>

namespace mill::dynamics {
/// Undamped modes of n masses on s springs, ascending.  theory.md (6.11) to (6.13)
struct Modes {
  Eigen::VectorXd frequency;      ///< (n) Hz
  Eigen::MatrixXd shape;          ///< (n, n) kg^-1/2, one column per mode, V^T M V = 1, largest component positive
  Eigen::MatrixXd strain_share;   ///< (n, s) -, part of the strain energy of mode i in spring j; half of it is the
                                  ///<         relative change of frequency per relative change of stiffness
  Eigen::MatrixXd kinetic_share;  ///< (n, n) -, part of the kinetic energy of mode i in mass j
};

/// Modes of M y'' + K y = 0.  Cost O(n^3).
/// @throws SolverError  the eigenvalue iteration fails, which only a NaN in the matrices can cause
Modes modes(const MillModel &model);

/// How far a natural frequency of the chain may be off.
struct ModeError {
  double error = 0;                ///< -, relative; NaN: a spring or mass that the mode follows states no error
  std::vector<std::string> lacks;  ///< which, or what would state it
};
/// Half the strain share of each spring, and half the kinetic share of each mass, is how the frequency follows it.
/// @param modes  of mill_model(model, ..): seven springs, six masses
ModeError mode_error(const Modes &modes, Eigen::Index mode, const LumpedModel &model);

/// One pole of the damped model.
struct Pole {
  double frequency;  ///< Hz, |lambda| / 2 pi
  double damping;    ///< -, -Re(lambda) / |lambda|; 1 for a real, decaying pole
};

/// Poles of M y'' + C y' + K y = 0 in ascending |lambda|, a complex pair once, real poles one by one.  theory.md
/// (6.14) Taken from the state matrix and not from the modes, so that any C is right, the gap damper included.
/// Cost O(n^3).
std::vector<Pole> poles(const MillModel &model);

/// Poles with spring `name` replaced by the complex stiffness k (1 + i eta), C left out.  theory.md (6.15)
/// An eigenvalue is w^2 (1 + i eta_k): frequency w / 2 pi, damping eta_k / 2, half of the loss factor of the mode.
/// @throws InputError  no spring of that name
std::vector<Pole> loss_factor_poles(const MillModel &model, const std::string &name, double eta);
}  // namespace mill::dynamics
