#include "instance.h"
#include "scaled_friction.h"
#include <cmath>
#include <stdexcept>

// What an instance of kind "chatter" does differently.  theory.md 37
namespace mill::fmu {
namespace {
// The numbers of a pass that a client can change.
std::vector<double> key_of(const PassData &pass)
{
  std::vector<double> key{pass.roll_speed, pass.exit_thickness, pass.entry_thickness, pass.entry_tension,
                          pass.exit_tension};
  for (const FrictionConstant &constant : friction_constants())
    if (reads(pass.friction, constant.member))
      key.push_back(pass.friction.*constant.member);
  return key;
}
}  // namespace

PassData Instance::pass_of(const std::vector<double> &values) const
{
  PassData pass    = model_.chatter.pass;
  double reduction = 0;
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    if (variables_[i].role != Role::bite_number)
      continue;
    switch (BiteNumber(variables_[i].index)) {
    case BiteNumber::roll_speed:
      pass.roll_speed = values[i];
      break;
    case BiteNumber::reduction:
      reduction = values[i];
      break;
    case BiteNumber::entry_thickness:
      pass.entry_thickness = values[i];
      break;
    case BiteNumber::entry_tension:
      pass.entry_tension = values[i];
      break;
    case BiteNumber::exit_tension:
      pass.exit_tension = values[i];
      break;
    case BiteNumber::viscosity:
      pass.friction.viscosity = values[i];
      break;
    case BiteNumber::friction:
      pass.friction = with_number(pass.friction, values[i]);
      break;
    case BiteNumber::friction_scale:
      pass.friction = scaled(pass.friction, values[i] / own_scale(pass.friction));
      break;
    case BiteNumber::entry_thickness_change:
    case BiteNumber::start:
      break;
    }
  }
  // The exit thickness of the case itself comes back to its last digit.
  const PassData &pass_data = model_.chatter.pass;
  const bool same           = pass.entry_thickness == pass_data.entry_thickness &&
                    reduction == 1 - pass_data.exit_thickness / pass_data.entry_thickness;
  pass.exit_thickness = same ? pass_data.exit_thickness : pass.entry_thickness * (1 - reduction);
  return pass;
}

double Instance::bite_number(const BiteNumber number) const
{
  for (std::size_t i = 0; i < variables_.size(); ++i)
    if (variables_[i].role == Role::bite_number && variables_[i].index == int(number))
      return now_.values[i];
  return 0;
}

// The working point of the present parameters, solved where they have changed.  Gap, thickness and tensions count
// from it: what holds them in the mill (screws, speeds of the neighbours) has followed, the vibration about it
// goes on.
// @return  empty, or why there is no steady bite: the last working point is kept then
std::string Instance::solve_pass()
{
  if (model_.kind != StandKind::chatter)
    return "";
  const PassData pass     = pass_of(now_.values);
  std::vector<double> key = key_of(pass);
  if (!chatter_ || key != built_pass_) {
    try {
      chatter_ = std::make_unique<ChatterMotion>(model_.chatter, pass);
    } catch (const std::runtime_error &e) {
      return e.what();
    }
    built_pass_ = std::move(key);
  }
  const BiteReading &steady = chatter_->bite().steady();
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    if (variables_[i].role != Role::steady_number)
      continue;
    const auto number = SteadyNumber(variables_[i].index);
    now_.values[i]    = number == SteadyNumber::force      ? steady.force
                        : number == SteadyNumber::friction ? steady.friction
                                                           : chatter_->bite().flattened_radius();
  }
  return "";
}

ChatterInput Instance::input_now() const
{
  return {now_.force, 0, bite_number(BiteNumber::entry_thickness_change)};
}

void Instance::evaluate_vibration()
{
  const auto r        = chatter_->read(now_.vibration, input_now());
  const double steady = chatter_->bite().steady().force;
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const Variable &v = variables_[i];
    double &value     = now_.values[i];
    if (v.role == Role::acceleration)
      value = r.acceleration[std::size_t(v.index)];
    else if (v.role == Role::displacement)
      value = r.displacement[std::size_t(v.index)];
    else if (v.role == Role::bite_reading)
      switch (BiteReadingKind(v.index)) {
      case BiteReadingKind::gap_change:
        value = r.gap;
        break;
      case BiteReadingKind::exit_thickness:
        value = r.bite.exit_thickness;
        break;
      case BiteReadingKind::force:
        value = r.bite.force;
        break;
      case BiteReadingKind::force_change:
        value = r.bite.force - steady;
        break;
      case BiteReadingKind::entry_tension:
        value = r.entry_tension;
        break;
      case BiteReadingKind::exit_tension:
        value = r.exit_tension;
        break;
      case BiteReadingKind::friction:
        value = r.bite.friction;
        break;
      case BiteReadingKind::events:
        value = now_.vibration.events;
        break;
      }
  }
}

// @return  why the motion ends before `end`, which is that moment then
std::string Instance::vibrate(double &end)
{
  const double begin = now_.values[bite_force], from = now_.time, wanted = end - from;
  ChatterInput input     = input_now();
  input.force            = begin;
  input.slope            = now_.slope;
  double length          = wanted;
  const std::string stop = chatter_->advance(now_.vibration, length, input);
  const std::string why  = stop.empty() ? "" : "at " + number_text(from + length) + " s " + stop;
  if (!why.empty()) {
    // A client of version 3 has rows before this moment, unless it is the start of the run.
    const bool has_rows = from + length > from || (version_ == 3 && from > now_.start);
    if (!has_rows)
      throw std::runtime_error(why);
    end = from + length;
  }
  const bool given        = why.empty() && end_is_given_;
  now_.force              = given ? force_at_end_ : begin + now_.slope * (why.empty() ? wanted : length);
  now_.last_slope         = now_.slope;
  now_.values[bite_force] = given ? force_at_end_ : now_.values[bite_force];
  return why;
}
}  // namespace mill::fmu
