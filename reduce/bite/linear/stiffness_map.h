#pragma once
#include "reduce/bite/slab/slab_bite.h"

// Maps of K4 over two quantities of the pass.
namespace mill::bite {
enum class MapQuantity {
  reduction,      ///< -, 1 - h_d/h_e at fixed entry thickness
  friction,       ///< -, Coulomb's mu, or both factors; law coulomb or factor
  entry_tension,  ///< Pa
  exit_tension,   ///< Pa
  roll_speed      ///< m/s
};

struct MapAxis {
  MapQuantity quantity = MapQuantity::reduction;
  Eigen::VectorXd value;  ///< in the unit of the quantity
};

/// Rows go with the first axis, columns with the second; nan where the rolls cannot roll this strip.
struct StiffnessMap {
  Eigen::MatrixXd force;             ///< N
  Eigen::MatrixXd slope;             ///< N/m, K4 at fixed arc, (8.10)
  Eigen::MatrixXd slope_following;   ///< N/m, K4 with the arc following, (8.11)
  Eigen::MatrixXd flattened_radius;  ///< m
  Eigen::MatrixXi reason;            ///< index into `reasons`, -1 where there is a state
  std::vector<std::string> reasons;  ///< each different one once, in the order of the cells
};

/// Bite with one quantity changed.
/// @throws InputError  friction by a law that has no single number
RollBite with_quantity(RollBite bite, MapQuantity quantity, double value);

/// Solves every cell; what cannot be rolled keeps its reason and stops nothing.
/// @param threads  that share the rows
/// @throws InputError  an axis without values, or with a quantity the friction law does not have
/// Cost: a state per cell, 10 000 of Bland and Ford with flattening about 0.3 s on one core.
StiffnessMap stiffness_map(const RollBite &bite, const SlabModel &model, const MapAxis &rows,
                           const MapAxis &columns, int threads = 2);
}  // namespace mill::bite
