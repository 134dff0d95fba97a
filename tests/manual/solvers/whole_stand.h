#pragma once
#include "core/records/stand_model.h"
#include "fem/body/part_model.h"
#include <vector>

namespace mill::fem {
/// A body of an assembly with the interface it is joined by.
struct StandBody {
  const PartModel *part;
  const PartInterface *interface;
};

/// Bodies on their meshes, joined by springs, without any reduction: what component modes are measured against.
/// Coordinates y, in this order: the interfaces of the bodies, one body after the other, then n_lumps lumps.
/// All values are of whole bodies.
struct WholeStand {
  std::vector<StandBody> bodies;
  int n_lumps = 0;
  Eigen::MatrixXd mass;                 ///< (n_y, n_y) kg: point masses on interfaces, and of the lumps
  std::vector<Connection> connections;  ///< rows over y
};
int n_coordinates(const WholeStand &stand);

struct WholeModes {
  Eigen::VectorXd frequency;            ///< (k) Hz, ascending
  Eigen::MatrixXd y;                    ///< (n_y, k) kg^-1/2, of mass-normalised modes
  std::vector<Eigen::MatrixXd> fields;  ///< by body, (3N, k) kg^-1/2
};

/// The lowest modes, by Lanczos on the exact inverse of the assembled stiffness.  theory.md 21.5
/// @throws InputError   the springs leave a rigid motion: names a part that takes part in it
/// @throws SolverError  fewer modes converged than asked for
/// Cost: one solution per body and Lanczos step.
WholeModes whole_modes(const WholeStand &stand, int n_modes);

/// (n_y, k) m: displacement of the coordinates under forces on them, (n_y, k) N.
Eigen::MatrixXd whole_static(const WholeStand &stand, const Eigen::MatrixXd &forces);
}  // namespace mill::fem
