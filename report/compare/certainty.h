#pragma once
#include "report/compare/comparison.h"
#include <string>
#include <vector>

// How sure the difference of a result between two runs is.  theory.md 34.5
namespace mill::report {
/// An input in which two resolved cases differ.
struct DifferentInput {
  std::string key;              ///< "given.K4"
  std::string first, other;     ///< as resolved.toml has them; empty: not there
  bool estimated_once = false;  ///< an estimate in one of the two, given in the other
  bool own_error      = false;  ///< a value of either states an error of its own
};

/// What is known of a difference.
struct DifferenceError {
  Certainty certainty = Certainty::unknown;
  double error        = 0;          ///< -, of the difference, over the value in the first run; 0: certain
  std::vector<std::string> behind;  ///< keys that differ and that the result is made from
};

/// Does a key choose a model, a method or a mesh, and not a part or a size of the mill?
/// @param value  as resolved.toml has it
bool chooses_model(const std::string &key, const std::string &value);

/// @param change   -, from `first` to `other`, over the value of `first`
/// @param inputs   in which the two cases differ
DifferenceError error_of_difference(const Run &first, const Run &other, const Result &in_first,
                                    const Result &in_other, double change,
                                    const std::vector<DifferentInput> &inputs);
}  // namespace mill::report
