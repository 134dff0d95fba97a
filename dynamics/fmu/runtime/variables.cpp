#include "variables.h"
#include "scaled_friction.h"

namespace mill::fmu {
namespace {
// Ranges of what a client may set: those of [given] and [dynamics] of a case file.
constexpr double least_mass = 1e-3, largest_mass = 1e9;            // kg
constexpr double least_stiffness = 1e3, largest_stiffness = 1e15;  // N/m
constexpr double largest_damper        = 1e15;                     // N s/m
constexpr double largest_damping_ratio = 0.5;                      // -
constexpr double largest_force         = 1e12;                     // N

// "y_upper_work_roll"
std::string displacement_of(const std::string &point)
{
  return "y_" + point;
}

Variable parameter(std::string name, const Role role, const int index, const Variability variability,
                   const char *unit, const double low, const double high, const double start)
{
  return {std::move(name), role, index, Type::real, Causality::parameter, variability, unit, "", low, high,
          start,           0};
}

Variable output(std::string name, const Role role, const int index, const char *unit, const char *display,
                const double nominal)
{
  return {std::move(name),
          role,
          index,
          Type::real,
          Causality::output,
          Variability::continuous,
          unit,
          display,
          0,
          -1,
          0,
          nominal};
}

void add_parameters(const ModelData &model, std::vector<Variable> &all)
{
  Variable mean = parameter("F_mean", Role::mean_force, 0, Variability::fixed, "N", -largest_force, largest_force,
                            model.mean_force);
  mean.display_unit = "kN";
  if (model.kind == StandKind::curves)  // what the springs carry at rest belongs to it
    mean.low = mean.high = model.mean_force;
  all.push_back(mean);
  if (model.has_series)
    all.push_back({"use_stored_force", Role::stored_force, 0, Type::boolean, Causality::parameter,
                   Variability::fixed, "", "", 0, -1, 0, 0});
  for (std::size_t i = 0; i < model.mass.size(); ++i)
    all.push_back(parameter("M" + std::to_string(i + 1), Role::mass, int(i), Variability::fixed, "kg", least_mass,
                            largest_mass, model.mass[i]));
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    const SpringData &spring = model.springs[i];
    Variable K               = parameter(spring.name, Role::spring, int(i), Variability::tunable, "N/m",
                           spring.may_rest ? 0 : least_stiffness, largest_stiffness, spring.start);
    K.display_unit           = "kN/mm";
    all.push_back(K);
  }
  all.push_back(
      parameter("C", Role::gap_damper, 0, Variability::tunable, "N.s/m", 0, largest_damper, model.gap_damper));
  Variable damping     = parameter("modal_damping", Role::modal_damping, 0, Variability::tunable, "1", 0,
                                   largest_damping_ratio, model.modal_damping);
  damping.display_unit = "%";
  all.push_back(damping);
}
}  // namespace

namespace {
void add_bite_numbers(const ModelData &model, std::vector<Variable> &all)
{
  const PassData &p = model.chatter.pass;
  const auto add    = [&](const char *name, const BiteNumber number, const char *unit, const char *display,
                       const double low, const double high, const double start) {
    Variable v     = parameter(name, Role::bite_number, int(number), Variability::tunable, unit, low, high, start);
    v.display_unit = display;
    all.push_back(v);
  };
  // What other units of a mill give at every step: speeds and tensions of drives, the strip of the stand before.
  const auto add_input = [&](const char *name, const BiteNumber number, const char *unit, const char *display,
                             const double low, const double high, const double start, const double nominal) {
    add(name, number, unit, display, low, high, start);
    all.back().causality   = Causality::input;
    all.back().variability = Variability::continuous;
    all.back().nominal     = nominal;
  };
  add_input("roll_speed", BiteNumber::roll_speed, "m/s", "", 1e-3, 100, p.roll_speed, 10);
  add("reduction", BiteNumber::reduction, "1", "%", 1e-4, 0.9, 1 - p.exit_thickness / p.entry_thickness);
  add_input("entry_thickness", BiteNumber::entry_thickness, "m", "mm", 1e-5, 1, p.entry_thickness, 1e-3);
  add_input("entry_tension", BiteNumber::entry_tension, "Pa", "MPa", 0, 2e9, p.entry_tension, 1e8);
  add_input("exit_tension", BiteNumber::exit_tension, "Pa", "MPa", 0, 2e9, p.exit_tension, 1e8);
  if (has_film(p.friction))
    add("viscosity", BiteNumber::viscosity, "Pa.s", "", 1e-9, 100, p.friction.viscosity);
  else if (is_a_number(p.friction))
    add("friction", BiteNumber::friction, "1", "", 1e-4, 1, p.friction.coefficient);
  else
    add("friction_scale", BiteNumber::friction_scale, "1", "", 1e-4, 100, own_scale(p.friction));
  add_input("dh_entry", BiteNumber::entry_thickness_change, "m", "um", -1e-2, 1e-2, 0, 1e-6);
  Variable start = parameter("start_displacement", Role::bite_number, int(BiteNumber::start), Variability::fixed,
                             "m", -1e-3, 1e-3, model.chatter.start);
  start.display_unit = "um";
  all.push_back(start);
}

void add_bite_readings(std::vector<Variable> &all)
{
  const auto add = [&](const char *name, const BiteReadingKind kind, const char *unit, const char *display,
                       const double nominal) {
    all.push_back(output(name, Role::bite_reading, int(kind), unit, display, nominal));
  };
  add("dh", BiteReadingKind::gap_change, "m", "um", 1e-6);
  add("exit_thickness", BiteReadingKind::exit_thickness, "m", "mm", 1e-3);
  add("F", BiteReadingKind::force, "N", "kN", 1e6);
  add("dF", BiteReadingKind::force_change, "N", "kN", 1e3);
  add("sigma_entry", BiteReadingKind::entry_tension, "Pa", "MPa", 1e8);
  add("sigma_exit", BiteReadingKind::exit_tension, "Pa", "MPa", 1e8);
  add("mu", BiteReadingKind::friction, "1", "", 0.01);
  add("events", BiteReadingKind::events, "", "", 0);
  all.back().type        = Type::whole;
  all.back().variability = Variability::discrete;
  const auto steady = [&](const char *name, const SteadyNumber number, const char *unit, const char *display) {
    all.push_back({name, Role::steady_number, int(number), Type::real, Causality::calculated_parameter,
                   Variability::tunable, unit, display, 0, -1, 0, 0});
  };
  steady("F_steady", SteadyNumber::force, "N", "kN");
  steady("mu_steady", SteadyNumber::friction, "1", "");
  steady("R_flattened", SteadyNumber::flattened_radius, "m", "mm");
}

std::vector<Variable> chatter_variables(const ModelData &model)
{
  std::vector<Variable> all;
  all.push_back(
      {"time", Role::time, 0, Type::real, Causality::independent, Variability::continuous, "s", "", 0, -1, 0, 0});
  all.push_back({"F_disturbance", Role::bite_force, 0, Type::real, Causality::input, Variability::continuous, "N",
                 "kN", -largest_force, largest_force, 0, 1e3});
  add_bite_numbers(model, all);
  for (std::size_t j = 0; j < model.points.size(); ++j)
    all.push_back(output("a_" + model.points[j], Role::acceleration, int(j), "m/s2", "g", 1));
  for (std::size_t j = 0; j < model.points.size(); ++j)
    all.push_back(output(displacement_of(model.points[j]), Role::displacement, int(j), "m", "um", 1e-6));
  add_bite_readings(all);
  return all;
}
}  // namespace

std::vector<Variable> variables_of(const ModelData &model)
{
  if (model.kind == StandKind::chatter)
    return chatter_variables(model);
  std::vector<Variable> all;
  all.push_back(
      {"time", Role::time, 0, Type::real, Causality::independent, Variability::continuous, "s", "", 0, -1, 0, 0});
  all.push_back({"F_roll", Role::bite_force, 0, Type::real, Causality::input, Variability::continuous, "N", "kN",
                 -largest_force, largest_force, model.mean_force, 1e6});
  add_parameters(model, all);
  for (std::size_t j = 0; j < model.points.size(); ++j)
    all.push_back(output("a_" + model.points[j], Role::acceleration, int(j), "m/s2", "g", 1));
  for (std::size_t j = 0; j < model.points.size(); ++j)
    all.push_back(output(displacement_of(model.points[j]), Role::displacement, int(j), "m", "um", 1e-6));
  all.push_back(output("F_cell", Role::cell_force, 0, "N", "kN", 1e6));
  // Springs that may be tuned move the frequencies; modes that are kept as they are do not move.
  for (std::size_t k = 0; k < model.n_modes(); ++k)
    all.push_back(
        {"f" + std::to_string(k + 1), Role::frequency, int(k), Type::real, Causality::calculated_parameter,
         model.kind == StandKind::chain ? Variability::tunable : Variability::fixed, "Hz", "", 0, -1, 0, 0});
  return all;
}
}  // namespace mill::fmu
