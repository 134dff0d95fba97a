#pragma once
#include "model_data.h"
#include <string>
#include <vector>

// The variables of an exported model: one table, from which the runtime serves every call and the exporter writes
// modelDescription.xml.
namespace mill::fmu {
enum class Causality { parameter, calculated_parameter, input, output, independent };
enum class Variability { fixed, tunable, discrete, continuous };
enum class Type { real, whole, boolean };

/// What a variable is in the model.
enum class Role {
  time,
  bite_force,
  mean_force,
  stored_force,
  mass,
  spring,
  gap_damper,
  modal_damping,
  acceleration,
  displacement,
  cell_force,
  frequency,
  // of a stand whose bite is part of the model
  bite_number,   ///< what the working point is made of; index: BiteNumber
  bite_reading,  ///< what the bite answers; index: BiteReadingKind
  steady_number  ///< of the working point; index: SteadyNumber
};

/// Parameters and inputs of kind "chatter".
enum class BiteNumber {
  roll_speed,
  reduction,
  entry_thickness,
  entry_tension,
  exit_tension,
  viscosity,       ///< of the oil, law film
  friction,        ///< Coulomb's mu, where the law is a number
  friction_scale,  ///< factor on the coefficient of a law without film
  entry_thickness_change,
  start
};
/// Outputs of kind "chatter" in addition to accelerations and displacements.
enum class BiteReadingKind {
  gap_change,
  exit_thickness,
  force,
  force_change,
  entry_tension,
  exit_tension,
  friction,
  events
};
/// Calculated parameters of kind "chatter".
enum class SteadyNumber { force, friction, flattened_radius };

/// One variable; its value reference is its place in the table, in FMI 2 and FMI 3 alike.
struct Variable {
  std::string name;  ///< "K3", "a_upper_work_roll"
  Role role;
  int index;  ///< of the mass, spring, point or mode
  Type type;
  Causality causality;
  Variability variability;
  const char *unit;          ///< SI, "" for a truth value or a count
  const char *display_unit;  ///< "" for none
  double low, high;          ///< range of a parameter; high < low: none
  double start;              ///< in SI; of an input or a parameter
  double nominal;            ///< typical size, for clients that scale; 0: not stated
  bool bounded() const
  {
    return low <= high;
  }
  /// Has a value before anything is computed: parameters and inputs.
  bool has_start() const
  {
    return causality == Causality::parameter || causality == Causality::input;
  }
};

/// The table of a model.  Entry 0 is the time, which only FMI 3 shows.
std::vector<Variable> variables_of(const ModelData &model);
}  // namespace mill::fmu
