#pragma once
#include "core/records/component.h"
#include "fem/body/part_model.h"

namespace mill::fem {
/// Which fixed-interface modes a component keeps.
struct ModeChoice {
  int n_modes            = -1;  ///< exactly so many; -1: by the limit
  double frequency_limit = 0;   ///< Hz, up to which the component is meant to be used
  double reach           = 0;   ///< Hz, of the mesh (mesh_reach); 0: not checked
  /// By the limit: modes are added until no mode of an assembly up to the limit can be too high by more than
  /// this share, (21.10).
  double residual_share = 1e-3;  ///< -
};

/// What a component's coordinates stand for, on the mesh.
struct ComponentBasis {
  Eigen::MatrixXd constraint;  ///< (3N, n_i) per unit of each interface displacement
  Eigen::MatrixXd modes;       ///< (3N, n_m), each of modal mass 1 kg for the whole body
};

/// Craig-Bampton component of a meshed part: static constraint modes of its interface, then fixed-interface modes.
/// theory.md 21.3.  M, K, residual and mass count the whole body; axis and barrel are left to the caller.
///
/// By the limit: all modes below twice the limit, and more until the residual is small enough (see ModeChoice).
/// @throws InputError   the limit is above the mesh's reach, or more modes are asked for than the mesh has; the
///                      interface does not hold the part (names part and direction)
/// @throws SolverError  the eigenvalue solver found fewer modes than asked for
/// Cost: some solutions with the factor per mode.
/// Source: R. R. Craig, M. C. C. Bampton, AIAA Journal 6 (1968) 1313.
Component component_modes(const PartModel &part, const PartInterface &interface, const ModeChoice &choice,
                          ComponentBasis *basis = nullptr);

/// Largest share by which an assembly's mode at `frequency` (Hz) can be too high, (21.10).
double residual_share(const Component &component, double frequency);

/// Modes of a body that nothing holds, without its rigid motions.
struct FreeModes {
  Eigen::VectorXd frequency;  ///< (k) Hz, ascending
  Eigen::MatrixXd shapes;     ///< (3N, k), each of modal mass 1 kg for the whole body
};
/// @throws as component_modes
FreeModes free_modes(const PartModel &part, int n_modes);
}  // namespace mill::fem
