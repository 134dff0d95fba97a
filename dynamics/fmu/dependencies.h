#pragma once
#include "dynamics/fmu/exported_model.h"
#include "dynamics/fmu/runtime/variables.h"
#include <vector>

namespace mill::fmu {
/// What the unknowns of a model depend on, as places in the table of variables_of().
class Dependencies {
public:
  explicit Dependencies(const ModelData &model);

  /// Knowns with which an output changes at once at a communication point, while the state of motion is held:
  /// inputs, parameters and the time.
  std::vector<unsigned> at_communication(const Variable &output) const;
  /// Knowns that decide an output or a calculated parameter in initialization.
  std::vector<unsigned> at_start(const Variable &unknown) const;
  /// Those of a list that are inputs: FMI 2 knows only these at communication points.
  std::vector<unsigned> inputs_of(const std::vector<unsigned> &knowns) const;

private:
  std::vector<unsigned> with(bool (*belongs)(const Variable &)) const;
  std::vector<unsigned> force() const;
  std::vector<unsigned> friction_of_bite() const;
  std::vector<unsigned> chatter_output(const Variable &output) const;
  bool feels_force(const Variable &acceleration) const;
  bool is_displaced(const Variable &displacement) const;
  bool follows_start(BiteReadingKind reading) const;

  const ModelData &model_;
  std::vector<Variable> all_;
};
}  // namespace mill::fmu
