#include "reduce/bite/linear/linear_sensitivity.h"
#include <cmath>

// The numbers of a pass by name.
namespace mill::bite {
namespace {
constexpr int first_of_flow = int(PassNumber::stress), first_of_friction = int(PassNumber::friction);
static_assert(int(PassNumber::initial_thickness) == first_of_flow + int(n_flow_constants) &&
                  n_pass_numbers == first_of_friction + int(n_friction_constants),
              "the constants of the laws stand in the order of core/laws");

// Constant of a law that is this number, or null.
const FlowStressConstant *flow_constant(const PassNumber number)
{
  const int i = int(number) - first_of_flow;
  return i >= 0 && i < int(n_flow_constants) ? &flow_stress_constants()[std::size_t(i)] : nullptr;
}

const FrictionConstant *friction_constant(const PassNumber number)
{
  const int i = int(number) - first_of_friction;
  return i >= 0 ? &friction_constants()[std::size_t(i)] : nullptr;
}

/// Where a number stands; none for the factor on the flow stress.
double *place_of(RollBite &bite, const PassNumber number)
{
  Strip &s = bite.strip;
  if (const auto *constant = flow_constant(number))
    return &(s.flow_stress.*constant->member);
  if (const auto *constant = friction_constant(number))
    return &(s.friction.*constant->member);
  double *const places[first_of_flow] = {
      &s.entry_thickness, &s.exit_thickness, &s.entry_tension,          &s.exit_tension,          &s.width,
      &bite.roll_speed,   &bite.roll_radius, &bite.roll.youngs_modulus, &bite.roll.poisson_ratio, nullptr};
  return number == PassNumber::initial_thickness ? &s.initial_thickness : places[int(number)];
}

bool is_read(const RollBite &bite, const PassNumber number)
{
  if (const auto *constant = flow_constant(number))
    return reads(bite.strip.flow_stress, constant->member);
  if (const auto *constant = friction_constant(number))
    return *constant->name && reads(bite.strip.friction, constant->member);
  return number != PassNumber::initial_thickness || hardens(bite.strip.flow_stress);
}
}  // namespace

double value_of(const RollBite &bite, const PassNumber number)
{
  RollBite copy       = bite;
  const double *place = place_of(copy, number);
  return place ? *place : 1;
}

std::vector<PassNumber> numbers_of(const RollBite &bite)
{
  std::vector<PassNumber> numbers;
  for (int i = 0; i < n_pass_numbers; ++i) {
    const auto number  = PassNumber(i);
    const double value = value_of(bite, number);
    if (is_read(bite, number) && value != 0 && !std::isnan(value))
      numbers.push_back(number);
  }
  return numbers;
}

RollBite with_number_scaled(RollBite bite, const PassNumber number, const double factor)
{
  if (double *place = place_of(bite, number)) {
    *place *= factor;
    return bite;
  }
  bite.strip.flow_stress = scaled(bite.strip.flow_stress, factor);
  return bite;
}

PassNumberName name_of(const PassNumber number)
{
  if (const auto *constant = flow_constant(number))
    return {std::string("strip.flow_stress.") + constant->key, constant->name, constant->si_unit};
  if (const auto *constant = friction_constant(number))
    return {constant->input, constant->name, constant->si_unit};
  if (number == PassNumber::initial_thickness)
    return {"strip.initial_thickness", "thickness before the first stand", "m"};
  static const PassNumberName names[first_of_flow] = {
      {"condition.entry_thickness", "entry thickness", "m"},
      {"condition.exit_thickness", "exit thickness", "m"},
      {"condition.entry_tension", "entry tension", "Pa"},
      {"condition.exit_tension", "exit tension", "Pa"},
      {"condition.width", "strip width", "m"},
      {"condition.speed", "roll speed", "m/s"},
      {"work_roll.diameter", "work roll diameter", "m"},
      {"steel.youngs_modulus", "Young's modulus of the rolls", "Pa"},
      {"steel.poisson_ratio", "Poisson's ratio of the rolls", "1"},
      {"strip.flow_stress", "flow stress as a whole", "1"}};
  return names[int(number)];
}
}  // namespace mill::bite
