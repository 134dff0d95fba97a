#pragma once
#include "core/records/stand_model.h"
#include "reduce/stand/mode_name.h"
#include "reduce/stand/stand_modes.h"
#include <Eigen/Core>
#include <string>
#include <vector>

namespace mill::reduce {
/// Relative error of a frequency up to which a mode is shown rightly.
inline constexpr double right_frequency = 0.05;

/// A stand model with its modes.
struct StandWithModes {
  StandModel model;
  StandModes modes;
  std::vector<ModeName> names = {};  ///< (modes), by reduce/stand/mode_names; empty: not named
};

/// (n, 6): shapes of least strain energy with one of the six points displaced by 1 and the others held.
/// theory.md (22.16)
Eigen::MatrixXd chain_shapes(const StandModel &stand);

/// (m): share of the kinetic energy of each mode that lies in the space of chain_shapes: 1 for a mode that six
/// masses can show.  theory.md (22.18)
Eigen::VectorXd in_chain(const StandWithModes &stand);

/// (modes of the stand, modes of the chain): modal assurance between a detailed stand and a chain whose shapes are
/// expanded by chain_shapes, weighted with the stand's mass.  theory.md (22.17)
Eigen::MatrixXd mac_with_chain(const StandWithModes &stand, const StandWithModes &chain);

/// (modes of other, modes of beam): modal assurance between two detailed stands; `other` is read at the nodes of
/// the beam stand (axes and points of the same name) and weighted with the beam stand's mass; what the beams carry
/// has its own displacement.  theory.md (22.19)
/// @throws InputError  a line or point of `beam` that `other` lacks
Eigen::MatrixXd mac_between(const StandWithModes &other, const StandWithModes &beam);

/// A mode of one model and its counterpart in another.
struct ModePair {
  int mode          = -1;  ///< of the first model, from 0
  int other         = -1;  ///< of the second; -1: none
  double mac        = 0;   ///< -, of the pair
  double difference = 0;   ///< -, frequency of the first / that of the second - 1; 0 without a pair
};

/// For every mode of the columns (first model) its best partner among the rows (second model); no row is used
/// twice, best assurance first.  Pairs below `least`, or whose frequencies are further apart than the ratio
/// `most_apart`, are left open: two shapes may look alike at the few places that are compared.
std::vector<ModePair> pair_modes(const Eigen::MatrixXd &mac, const Eigen::VectorXd &row_frequency,
                                 const Eigen::VectorXd &column_frequency, double least = 0.5,
                                 double most_apart = 1.5);

/// What six masses show of a detailed stand below a frequency limit.
struct ChainVerdict {
  std::vector<ModePair> pairs;  ///< one for each mode of the detailed stand below the limit: other = chain mode
  std::vector<double> missing;  ///< Hz, modes below the limit that no mode of the chain represents
  std::vector<std::string> sentences;  ///< in words, with the numbers
};

/// @param title  of the detailed model in the sentences: "the beam model"
ChainVerdict chain_verdict(const StandWithModes &detailed, const StandWithModes &chain, double limit,
                           const std::string &title);
}  // namespace mill::reduce
