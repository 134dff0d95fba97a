#include "dynamics/fmu/dependencies.h"
#include "core/laws/friction_law.h"
#include <algorithm>
#include <cmath>

namespace mill::fmu {
namespace {
constexpr double rounding = 1e-12;  // of the terms of a sum, below which the sum is zero

// Is a sum of products zero but for rounding?
class Sum {
public:
  void add(const double product)
  {
    sum_ += product;
    terms_ += std::abs(product);
  }
  bool is_zero() const
  {
    return !(std::abs(sum_) > rounding * terms_);
  }

private:
  double sum_ = 0, terms_ = 0;
};

bool is_mass(const Variable &v)
{
  return v.role == Role::mass;
}
bool is_spring(const Variable &v)
{
  return v.role == Role::spring;
}
bool is_gap_damper(const Variable &v)
{
  return v.role == Role::gap_damper;
}
bool is_damping(const Variable &v)
{
  return v.role == Role::modal_damping;
}
bool is_force(const Variable &v)
{
  return v.role == Role::bite_force;
}
// What the force of the bite is made of, above or below the mean.
bool is_driving(const Variable &v)
{
  return v.role == Role::bite_force || v.role == Role::mean_force || v.role == Role::stored_force;
}
bool is_mean_force(const Variable &v)
{
  return v.role == Role::mean_force;
}
bool is_bite(const Variable &v, const BiteNumber number)
{
  return v.role == Role::bite_number && v.index == int(number);
}
bool is_start(const Variable &v)
{
  return is_bite(v, BiteNumber::start);
}
bool is_entry_tension(const Variable &v)
{
  return is_bite(v, BiteNumber::entry_tension);
}
bool is_exit_tension(const Variable &v)
{
  return is_bite(v, BiteNumber::exit_tension);
}
bool is_friction(const Variable &v)
{
  return is_bite(v, BiteNumber::friction);
}
bool is_working_point(const Variable &v)
{
  return v.role == Role::bite_number && !is_start(v) && !is_bite(v, BiteNumber::entry_thickness_change);
}
bool is_of_bite(const Variable &v)
{
  return v.role == Role::bite_number && !is_start(v);
}

std::vector<unsigned> joined(std::vector<unsigned> all, const std::vector<unsigned> &more)
{
  all.insert(all.end(), more.begin(), more.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}
}  // namespace

Dependencies::Dependencies(const ModelData &model) : model_(model), all_(variables_of(model)) {}

std::vector<unsigned> Dependencies::with(bool (*const belongs)(const Variable &)) const
{
  std::vector<unsigned> places;
  for (std::size_t i = 0; i < all_.size(); ++i)
    if (belongs(all_[i]))
      places.push_back(unsigned(i));
  return places;
}

// A record that may be played makes the time one of the knowns.
std::vector<unsigned> Dependencies::force() const
{
  const std::vector<unsigned> driving = with(is_driving);
  return model_.has_series ? joined(driving, {0}) : driving;
}

// A friction coefficient that is a number depends on nothing else.
std::vector<unsigned> Dependencies::friction_of_bite() const
{
  return is_a_number(model_.chatter.pass.friction) ? with(is_friction) : with(is_of_bite);
}

// Does a point feel the bite force at once?
bool Dependencies::feels_force(const Variable &acceleration) const
{
  const std::size_t j = std::size_t(acceleration.index);
  if (model_.kind == StandKind::chain)
    return model_.bite_row[j] != 0;
  const bool chatter               = model_.kind == StandKind::chatter;
  const std::vector<double> &point = chatter ? model_.chatter.point : model_.shape;
  const std::vector<double> &b     = chatter ? model_.chatter.force_row : model_.bite_mode;
  Sum sum;
  for (std::size_t k = 0; k < b.size(); ++k)
    sum.add(point[j * b.size() + k] * b[k]);
  return !sum.is_zero();
}

// Does a point leave the datum under a constant force, or with displaced rolls?
bool Dependencies::is_displaced(const Variable &displacement) const
{
  if (model_.kind == StandKind::chain)
    return true;
  const std::size_t n = model_.n_modes(), j = std::size_t(displacement.index);
  Sum sum;
  for (std::size_t k = 0; k < n; ++k)
    sum.add(model_.kind == StandKind::chatter
                ? model_.chatter.point[j * n + k] * model_.chatter.displaced[k]
                : model_.shape[j * n + k] * model_.bite_mode[k] / (model_.frequency[k] * model_.frequency[k]));
  return !sum.is_zero();
}

// Does a reading of the bite change with the displacement of the rolls at the start?
bool Dependencies::follows_start(const BiteReadingKind reading) const
{
  switch (reading) {
  case BiteReadingKind::gap_change:
  case BiteReadingKind::exit_thickness:
  case BiteReadingKind::force:
  case BiteReadingKind::force_change:
    return true;
  case BiteReadingKind::friction:
    return !is_a_number(model_.chatter.pass.friction);
  case BiteReadingKind::entry_tension:
  case BiteReadingKind::exit_tension:
  case BiteReadingKind::events:
    break;
  }
  return false;
}

std::vector<unsigned> Dependencies::chatter_output(const Variable &output) const
{
  if (output.role == Role::acceleration)
    return feels_force(output) ? joined(with(is_force), with(is_of_bite)) : std::vector<unsigned>();
  if (output.role != Role::bite_reading)
    return {};
  switch (BiteReadingKind(output.index)) {
  case BiteReadingKind::exit_thickness:
  case BiteReadingKind::force:
  case BiteReadingKind::force_change:
    return with(is_of_bite);
  case BiteReadingKind::friction:
    return friction_of_bite();
  case BiteReadingKind::entry_tension:
    return with(is_entry_tension);
  case BiteReadingKind::exit_tension:
    return with(is_exit_tension);
  case BiteReadingKind::gap_change:
  case BiteReadingKind::events:
    break;
  }
  return {};
}

std::vector<unsigned> Dependencies::at_communication(const Variable &output) const
{
  if (model_.kind == StandKind::chatter)
    return chatter_output(output);
  if (output.role == Role::acceleration) {
    // Modal damping couples every mass of a chain with every other one.
    std::vector<unsigned> all = joined(with(is_damping), joined(with(is_mass), with(is_spring)));
    return feels_force(output) ? joined(all, joined(force(), with(is_gap_damper))) : all;
  }
  if (output.role != Role::cell_force)
    return {};
  std::vector<unsigned> all = with(is_mean_force);
  if (model_.kind != StandKind::chain)
    return model_.load_cell_share != 0 ? all : std::vector<unsigned>();
  const auto springs = with(is_spring);
  return joined(all, model_.share_from_statics
                         ? springs
                         : std::vector<unsigned>{springs[std::size_t(model_.load_cell_spring)]});
}

std::vector<unsigned> Dependencies::at_start(const Variable &unknown) const
{
  if (model_.kind == StandKind::chatter) {
    if (unknown.role == Role::steady_number)
      return SteadyNumber(unknown.index) == SteadyNumber::friction && is_a_number(model_.chatter.pass.friction)
                 ? with(is_friction)
                 : with(is_working_point);
    const std::vector<unsigned> at_once = chatter_output(unknown);
    const bool moved                    = unknown.role == Role::displacement   ? is_displaced(unknown)
                                          : unknown.role == Role::acceleration ? true
                                                                               : follows_start(BiteReadingKind(unknown.index));
    return moved ? joined(at_once, with(is_start)) : at_once;
  }
  const auto springs = with(is_spring);
  switch (unknown.role) {
  case Role::displacement:
    return is_displaced(unknown) ? joined(force(), springs) : std::vector<unsigned>();
  case Role::cell_force:
    return joined(force(), springs);
  case Role::frequency:
    return joined(with(is_mass), springs);
  default:
    break;
  }
  return {};  // accelerations are zero at rest
}

std::vector<unsigned> Dependencies::inputs_of(const std::vector<unsigned> &knowns) const
{
  std::vector<unsigned> inputs;
  for (const unsigned known : knowns)
    if (all_[known].causality == Causality::input)
      inputs.push_back(known);
  return inputs;
}
}  // namespace mill::fmu
