#pragma once
#include "dynamics/cluster/stack.h"

// Small motion about the state at rest.  theory.md 38.4
namespace mill::cluster {
/// Share of one contact, support or roll in a mode.
struct Share {
  std::string name;  ///< "W-I", "E", "W y"
  double value = 0;  ///< -, of the whole; the geometric term of a contact makes its share smaller
};

struct Mode {
  double frequency = 0;        ///< Hz; negative: -sqrt(-eigenvalue)/2 pi of a motion that grows
  Eigen::VectorXd shape;       ///< per unknown, largest 1
  double modal_mass = 0;       ///< kg, of that shape
  std::vector<Share> elastic;  ///< contacts, then supports, in the order of the stack
  std::vector<Share> kinetic;  ///< every roll and direction: "W x", "W y"
  std::string label;           ///< "E y on E", "I y, W y against E"
};

/// All modes, in rising order of the eigenvalue.
/// @param u  state at rest, two unknowns a roll
/// Cost: one symmetric eigenvalue problem of the size of the stack.
std::vector<Mode> modes(const Stack &stack, const Motion &u);

/// 1/s2, smallest eigenvalue of M^-1 K.
double least_root(const Stack &stack, const Motion &u);

/// A motion that has a name: weights of unknowns.
struct NamedShape {
  std::string name;
  Eigen::VectorXd shape;
};
/// Mass-weighted modal assurance of a shape with a mode, 0 .. 1.  theory.md (38.14)
double assurance(const Stack &stack, const Eigen::VectorXd &shape, const Mode &mode);
/// Which mode each named shape is: largest assurance first, every mode once; -1: none left.
std::vector<int> identified(const Stack &stack, const std::vector<NamedShape> &named,
                            const std::vector<Mode> &all);

/// "W y, I y 0.8, L x -1" over the unknowns.
/// @throws InputError  a roll or a direction that there is not
Eigen::VectorXd parsed_shape(const Stack &stack, const std::string &text);

/// State with a third unknown, zero, for every roll.
Motion with_rotation(const Motion &u);
}  // namespace mill::cluster
