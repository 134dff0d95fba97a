#pragma once
#include "dynamics/chatter/chatter.h"
#include "reduce/bite/linear/stiffness_map.h"
#include <Eigen/Core>
#include <string>
#include <vector>

// Stability over two quantities of the pass.  theory.md 27.5
namespace mill::dynamics {
/// Rows go with the first axis, columns with the second; nan where the strip does not enter the bite.
struct GrowthMap {
  bite::MapAxis rows, columns;       ///< friction by a law of several constants: the factor on it
  Eigen::MatrixXd growth;            ///< (n, m) 1/s, largest real part of the roots: above zero it is unstable
  Eigen::MatrixXd frequency;         ///< (n, m) Hz, of that root
  Eigen::MatrixXi reason;            ///< (n, m) index into `reasons`, -1 where there is a bite
  std::vector<std::string> reasons;  ///< each different one once, in the order of the cells
};

/// @param bite     at its roll speed, unless an axis is that
/// @param threads  that share the rows; the result is the same bit for bit with any number
/// @throws InputError  an axis without values, twice the same quantity, one that the friction law does not have
/// Cost: 0.1 ms a cell
GrowthMap growth_map(const ChatterStandModel &stand, const bite::RollBite &bite, Linearisation scheme,
                     const bite::MapAxis &rows, const bite::MapAxis &columns, int threads = 2);

/// "reduction" .., "roll_speed": the word of a quantity.
std::string word_of(bite::MapQuantity quantity);
/// @throws InputError  no such word; names all of them
bite::MapQuantity map_quantity(const std::string &word);
/// SI, "1", "Pa", "m/s".
std::string unit_of(bite::MapQuantity quantity);

/// n values of a quantity from half to one and a half of what the bite has, a reduction up to 0.9 at most.
/// @throws InputError  the bite has none of it
bite::MapAxis axis_around(const bite::RollBite &bite, bite::MapQuantity quantity, Eigen::Index n);
}  // namespace mill::dynamics
