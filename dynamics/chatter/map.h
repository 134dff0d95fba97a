#pragma once
#include "dynamics/chatter/speed.h"
#include <Eigen/Core>
#include <array>
#include <string>

// Stability over roll speed and one more quantity.  theory.md 27.5
namespace mill::dynamics {
enum class MapQuantity {
  reduction,  ///< -, 1 - h_d/h_e at fixed entry thickness
  tension,    ///< -, factor on both tensions
  viscosity   ///< Pa s, of the oil
};

/// Bite with one quantity changed.
/// @throws InputError  a reduction outside 0..1, a negative factor, a viscosity that is not positive or without
/// oil
bite::RollBite with_quantity(bite::RollBite bite, MapQuantity quantity, double value);

/// The same quantity of a bite: its reduction, one, its viscosity.
double quantity_of(const bite::RollBite &bite, MapQuantity quantity);

/// "reduction", "factor on both tensions", "viscosity of the oil" with its unit.
std::string quantity_name(MapQuantity quantity);

/// Why a cell of a map is empty.
enum class NoBite {
  none,           ///< there is a bite
  flattening,     ///< the arc flattens faster than the gap closes
  not_drawn_in,   ///< the rolls skid: neutral point beyond the exit
  torn_through,   ///< the rolls skid: neutral point before the entry
  entry_tension,  ///< the strip yields before the bite
  exit_tension,   ///< the strip yields behind the bite
  film,           ///< film and speeds do not settle
  other
};
constexpr int n_no_bite = 8;
/// In words.
std::string reason_of(NoBite reason);

struct StabilityMap {
  MapQuantity quantity = MapQuantity::reduction;
  Eigen::VectorXd speed;                          ///< (n) m/s, the rows
  Eigen::VectorXd value;                          ///< (m) of the quantity, the columns
  Eigen::MatrixXd growth;                         ///< (n, m) 1/s, largest real part; nan: no bite
  Eigen::MatrixXd frequency;                      ///< (n, m) Hz, of that root
  Eigen::MatrixXi reason;                         ///< (n, m) NoBite
  std::array<int, n_no_bite> cells{};             ///< how many cells have that reason
  std::array<std::string, n_no_bite> examples{};  ///< the message of the first such cell, by rows
  Eigen::VectorXd critical_speed;                 ///< (m) m/s, lowest crossing upward within the rows; nan: none
  Eigen::VectorXd critical_frequency;             ///< (m) Hz
};

/// Growth rate in every cell and the boundary of each column, found by root finding as critical_speed does, not
/// from the grid.  Cells are independent, so the result is the same bit for bit with any number of threads.
/// @param bite      its roll speed is not read
/// @param speed     (n) m/s, > 0, rising
/// @param value     (m) of the quantity
/// @param threads   that share the columns
/// @throws InputError  an axis without values; a quantity the bite does not have
/// Cost: 0.07 ms a cell and some 10 ms a column, 200 x 200 some 3 s on two cores.
StabilityMap stability_map(const ChatterStandModel &stand, const bite::RollBite &bite, Linearisation scheme,
                           const Eigen::VectorXd &speed, MapQuantity quantity, const Eigen::VectorXd &value,
                           int threads = 2);
}  // namespace mill::dynamics
