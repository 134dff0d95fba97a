#pragma once
#include "reduce/bite/bite.h"
#include <string>

// Passes on which the models of the bite are compared.
namespace mill::verify {
/// A pass per metre of width.
struct PassRow {
  std::string name;
  double radius;         ///< mm
  double entry;          ///< mm
  double exit;           ///< mm
  double stress;         ///< MPa, plane-strain flow stress; uniaxial factor of Swift's law where n > 0
  double friction;       ///< -, Coulomb; 0: sticking
  double entry_tension;  ///< MPa
  double exit_tension;   ///< MPa
  double eps0;           ///< -, uniaxial strain
  double n;              ///< -
};
bite::RollBite bite_of(const PassRow &row);

/// B1 demo pass, B2 the same sticking, B3 thick hot, B4 hot, B5 medium cold, B6 thin hard, B7 light, B8 cold
/// perfectly plastic, B9 very thick.
bite::RollBite reference_pass(const std::string &name);
}  // namespace mill::verify
