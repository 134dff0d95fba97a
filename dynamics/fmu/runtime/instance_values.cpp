#include "instance.h"
#include <algorithm>
#include <cmath>
#include <string>

namespace mill::fmu {
namespace {
constexpr double steepest = 1e24;  // N/s, from end to end of the range of the force within a picosecond

std::string with_unit(const double value, const Variable &variable)
{
  return number_text(value) + (std::string(variable.unit) == "1" ? "" : std::string(" ") + variable.unit);
}

const char *name_of(const Type type)
{
  return type == Type::real ? "Real (Float64)" : type == Type::whole ? "Integer (Int32)" : "Boolean";
}

// Is its value computed from others?
bool is_computed(const Variable &variable)
{
  return !variable.has_start() && variable.causality != Causality::independent;
}
}  // namespace

const Variable *Instance::known(const char *function, const Reference reference, const Type type) const
{
  const std::string prefix = std::string(function) + ": ";
  if (reference >= variables_.size()) {
    log_->refuse(Status::error, prefix + "there is no variable with the value reference " +
                                    std::to_string(reference) + ", the last one is " +
                                    std::to_string(variables_.size() - 1));
    return nullptr;
  }
  const Variable &variable = variables_[reference];
  if (variable.type != type) {
    log_->refuse(Status::error, prefix + variable.name + " is of type " + name_of(variable.type));
    return nullptr;
  }
  return &variable;
}

Status Instance::refuse_type(const char *function, const Reference *references, const std::size_t n,
                             const char *type) const
{
  if (n == 0)
    return Status::ok;
  if (!references)
    return log_->refuse(Status::error, std::string(function) + ": a pointer is missing");
  if (references[0] < variables_.size())
    known(function, references[0], variables_[references[0]].type == Type::real ? Type::boolean : Type::real);
  return log_->refuse(Status::error, std::string(function) + ": the model has no variable of type " + type);
}

// Version 3 shows start values before initialization.
bool Instance::may_get(const char *function) const
{
  if (version_ == 3 && now_.phase == Phase::instantiated)
    return true;
  return allows(function, {Phase::initialization, Phase::step, Phase::intermediate, Phase::terminated});
}

// Makes the values of the variables of a call ready to be read.
Status Instance::compute(const char *function, const Reference *references, const std::size_t n, const Type type)
{
  bool outputs = false, working_point = false;
  for (std::size_t i = 0; i < n; ++i) {
    const Variable *variable = known(function, references[i], type);
    if (!variable)
      return Status::error;
    outputs       = outputs || is_computed(*variable);
    working_point = working_point || variable->role == Role::steady_number;
  }
  if (!outputs)
    return Status::ok;
  if (now_.phase == Phase::instantiated)
    now_.outputs_stale = true;
  if (working_point || now_.outputs_stale)
    if (const std::string why = solve_pass(); !why.empty())
      return log_->refuse(Status::discard, std::string(function) + ": " + why);
  bring_up_to_date();
  return Status::ok;
}

Status Instance::get(const char *function, const Reference *references, const std::size_t n, double *values)
{
  if (!may_get(function))
    return Status::error;
  if (n > 0 && (!references || !values))
    return log_->refuse(Status::error, std::string(function) + ": a pointer is missing");
  if (const Status status = compute(function, references, n, Type::real); status != Status::ok)
    return status;
  for (std::size_t i = 0; i < n; ++i)
    values[i] = now_.values[references[i]];
  return Status::ok;
}

Status Instance::get_whole(const char *function, const Reference *references, const std::size_t n,
                           std::int32_t *values)
{
  if (!may_get(function))
    return Status::error;
  if (n > 0 && (!references || !values))
    return log_->refuse(Status::error, std::string(function) + ": a pointer is missing");
  if (const Status status = compute(function, references, n, Type::whole); status != Status::ok)
    return status;
  constexpr double largest = 2147483647;  // of the type; events are counted up to it
  for (std::size_t i = 0; i < n; ++i)
    values[i] = std::int32_t(std::min(largest, now_.values[references[i]]));
  return Status::ok;
}

Status Instance::set_whole(const char *function, const Reference *references, const std::size_t n)
{
  if (n > 0 && !references)
    return log_->refuse(Status::error, std::string(function) + ": a pointer is missing");
  for (std::size_t i = 0; i < n; ++i) {
    const Variable *variable = known(function, references[i], Type::whole);
    if (!variable || !may_set(function, *variable))
      return Status::error;
  }
  return Status::ok;
}

Status Instance::get_truth(const char *function, const Reference *references, const std::size_t n, bool *values)
{
  if (!may_get(function))
    return Status::error;
  if (n > 0 && (!references || !values))
    return log_->refuse(Status::error, std::string(function) + ": a pointer is missing");
  for (std::size_t i = 0; i < n; ++i) {
    if (!known(function, references[i], Type::boolean))
      return Status::error;
    values[i] = now_.use_stored == StoredForce::on;
  }
  return Status::ok;
}

bool Instance::may_set(const char *function, const Variable &variable) const
{
  const bool early =
      now_.phase == Phase::instantiated || now_.phase == Phase::set_up || now_.phase == Phase::initialization;
  const bool between = variable.causality == Causality::input || variable.variability == Variability::tunable;
  if (now_.phase == Phase::intermediate ? variable.role == Role::bite_force
                                        : variable.has_start() && (early || between))
    return true;
  const char *why = " is computed and cannot be set";
  if (variable.causality == Causality::independent)
    why = " is given by the steps and cannot be set";
  else if (variable.has_start())
    why = now_.phase == Phase::intermediate ? " cannot be set inside a step"
                                            : " is fixed: it can only be set before the first step";
  log_->refuse(Status::error, std::string(function) + ": " + variable.name + why);
  return false;
}

bool Instance::in_range(const char *function, const Variable &variable, const double value) const
{
  if (std::isfinite(value) && (!variable.bounded() || (value >= variable.low && value <= variable.high)))
    return true;
  const Reference reference = Reference(&variable - variables_.data());
  log_->refuse(Status::discard, std::string(function) + ": " + variable.name + " = " + with_unit(value, variable) +
                                    (variable.bounded() ? " is out of range (" + number_text(variable.low) +
                                                              " .. " + with_unit(variable.high, variable) + ")"
                                                        : std::string(" is not a finite number")) +
                                    "; it stays " + with_unit(now_.values[reference], variable));
  return false;
}

Status Instance::set(const char *function, const Reference *references, const std::size_t n, const double *values)
{
  if (!allows(function,
              {Phase::instantiated, Phase::set_up, Phase::initialization, Phase::step, Phase::intermediate}))
    return Status::error;
  if (n > 0 && (!references || !values))
    return log_->refuse(Status::error, std::string(function) + ": a pointer is missing");
  bool only_force = true;
  for (std::size_t i = 0; i < n; ++i) {
    const Variable *variable = known(function, references[i], Type::real);
    if (!variable || !may_set(function, *variable))
      return Status::error;
    if (!in_range(function, *variable, values[i]))
      return Status::discard;
    only_force = only_force && references[i] == bite_force;
  }
  if (!only_force) {
    if (model_.kind == StandKind::chain) {
      std::vector<double> wanted = now_.values;
      for (std::size_t i = 0; i < n; ++i)
        wanted[references[i]] = values[i];
      if (!is_held(modal_system(model_, tuning_of(wanted))))
        return log_->refuse(Status::discard,
                            std::string(function) +
                                ": with these masses and springs a part of the chain is not held to "
                                "the ground; all values stay as they were");
    }
    if (now_.phase == Phase::step)
      bring_up_to_date();  // what is read before the next step belongs to the last one
  }
  for (std::size_t i = 0; i < n; ++i) {
    now_.values[references[i]] = values[i];
    now_.input_set             = now_.input_set || references[i] == bite_force;
  }
  if (!only_force)
    use_parameters();
  if (now_.phase == Phase::initialization)
    now_.outputs_stale = true;
  return Status::ok;
}

Status Instance::set_truth(const char *function, const Reference *references, const std::size_t n,
                           const bool *values)
{
  if (!allows(function,
              {Phase::instantiated, Phase::set_up, Phase::initialization, Phase::step, Phase::intermediate}))
    return Status::error;
  if (n > 0 && (!references || !values))
    return log_->refuse(Status::error, std::string(function) + ": a pointer is missing");
  for (std::size_t i = 0; i < n; ++i) {
    const Variable *variable = known(function, references[i], Type::boolean);
    if (!variable || !may_set(function, *variable))
      return Status::error;
  }
  for (std::size_t i = 0; i < n; ++i)
    now_.use_stored = values[i] ? StoredForce::on : StoredForce::off;
  if (now_.phase == Phase::initialization)
    now_.outputs_stale = true;
  return Status::ok;
}

bool Instance::of_order_one(const char *function, const Variable &variable, const int order) const
{
  if (order == 1)
    return true;
  log_->refuse(Status::error, std::string(function) + ": derivative of order " + std::to_string(order) + " of " +
                                  variable.name + "; only order 1 is known");
  return false;
}

Status Instance::set_input_derivatives(const char *function, const Reference *references, const std::size_t n,
                                       const int *orders, const double *values)
{
  if (!allows(function, {Phase::instantiated, Phase::set_up, Phase::initialization, Phase::step}))
    return Status::error;
  if (n > 0 && (!references || !orders || !values))
    return log_->refuse(Status::error, std::string(function) + ": a pointer is missing");
  const Variable *held = nullptr;
  for (std::size_t i = 0; i < n; ++i) {
    const Variable *variable = known(function, references[i], Type::real);
    if (!variable || !of_order_one(function, *variable, orders[i]))
      return Status::error;
    if (variable->causality != Causality::input)
      return log_->refuse(Status::error, std::string(function) + ": " + variable->name + " is not an input");
    if (variable->role != Role::bite_force) {
      held = variable;
      continue;
    }
    if (!(std::abs(values[i]) <= steepest))
      return log_->refuse(Status::discard, std::string(function) + ": the derivative of " + variable->name + ", " +
                                               number_text(values[i]) + " N/s, is out of range (" +
                                               number_text(-steepest) + " .. " + number_text(steepest) +
                                               " N/s); it stays " + number_text(now_.slope) + " N/s");
  }
  for (std::size_t i = 0; i < n; ++i)
    if (references[i] == bite_force) {
      now_.slope     = values[i];
      now_.input_set = true;
    }
  if (held)
    return log_->refuse(Status::warning, std::string(function) + ": " + held->name +
                                             " is held over each step; its derivative is not used");
  return Status::ok;
}

// Of order 1: velocities instead of displacements, and q''' from the equation of motion instead of q''.
Status Instance::get_output_derivatives(const char *function, const Reference *references, const std::size_t n,
                                        const int *orders, double *values)
{
  if (!allows(function, {Phase::step, Phase::terminated}))
    return Status::error;
  if (n > 0 && (!references || !orders || !values))
    return log_->refuse(Status::error, std::string(function) + ": a pointer is missing");
  for (std::size_t i = 0; i < n; ++i) {
    const Variable *variable = known(function, references[i], Type::real);
    if (!variable || !of_order_one(function, *variable, orders[i]))
      return Status::error;
    if (variable->causality != Causality::output)
      return log_->refuse(Status::error, std::string(function) + ": " + variable->name + " is not an output");
  }
  if (chatter_)
    return log_->refuse(Status::error, std::string(function) + ": outputs of this model have no derivatives");
  ModalState rates{now_.modes.p, {}, {}};
  motion_->acceleration(now_.modes, now_.force - mean(), rates.p);
  if (curves_)
    curves_->add_springs(now_.modes, rates.p);
  std::vector<double> derived = now_.values;
  derived[2]                  = 0;  // the mean force has no derivative
  evaluate(rates, now_.last_slope, derived, &now_.modes);
  for (std::size_t i = 0; i < n; ++i)
    values[i] = derived[references[i]];
  return Status::ok;
}

bool Instance::may_derive(const char *function, const Direction &asked) const
{
  if (!allows(function, {Phase::initialization, Phase::step, Phase::terminated}))
    return false;
  const std::size_t seeds  = asked.adjoint ? asked.n_unknowns : asked.n_knowns;
  const std::size_t length = asked.adjoint ? asked.n_knowns : asked.n_unknowns;
  if ((asked.n_unknowns > 0 && !asked.unknowns) || (asked.n_knowns > 0 && !asked.knowns) ||
      (seeds > 0 && !asked.seed) || (length > 0 && !asked.result)) {
    log_->refuse(Status::error, std::string(function) + ": a pointer is missing");
    return false;
  }
  for (std::size_t i = 0; i < asked.n_unknowns; ++i) {
    const Variable *variable = known(function, asked.unknowns[i], Type::real);
    if (!variable)
      return false;
    if (variable->causality != Causality::output && variable->causality != Causality::calculated_parameter) {
      log_->refuse(Status::error, std::string(function) + ": " + variable->name + " is not an unknown");
      return false;
    }
  }
  for (std::size_t i = 0; i < asked.n_knowns; ++i) {
    const Variable *variable = known(function, asked.knowns[i], Type::real);
    if (!variable)
      return false;
    if (is_computed(*variable)) {
      log_->refuse(Status::error, std::string(function) + ": " + variable->name + " is not a known");
      return false;
    }
  }
  return true;
}

// N/s, of the stored force while it is played, behind the present time.
double Instance::stored_force_rate() const
{
  const std::size_t place = std::size_t(now_.place);
  if (!plays_series() || place == 0 || place >= series_.time.size())
    return 0;
  return (series_.force[place] - series_.force[place - 1]) / (series_.time[place] - series_.time[place - 1]);
}

// The unknowns for other values of inputs and parameters, and a force that is larger by more_force (N): in
// initialization mode in equilibrium, else with the displacements and velocities of the points as they are.
std::vector<double> Instance::unknowns_at(std::vector<double> values, const double more_force,
                                          const Direction &asked)
{
  Snapshot kept            = now_;
  const Tuning kept_tuning = built_;
  now_.values              = std::move(values);
  use_parameters();
  if (now_.phase == Phase::initialization)
    settle(first_force() + more_force);
  else
    now_.force = (plays_series() ? now_.force : now_.values[bite_force]) + more_force;
  evaluate(now_.modes, now_.force, now_.values);
  std::vector<double> result;
  for (std::size_t i = 0; i < asked.n_unknowns; ++i)
    result.push_back(now_.values[asked.unknowns[i]]);
  now_ = std::move(kept);
  if (!same_tuning(kept_tuning, built_)) {
    ModalState modes;
    std::swap(modes, now_.modes);  // they belong to the system that comes back
    use_parameters();
    std::swap(modes, now_.modes);
  }
  return result;
}

// Central differences at two widths, extrapolated: exact for what is linear, else of fourth order.  (35.8)
std::vector<double> Instance::by_known(const Direction &asked, const Reference reference)
{
  const Variable &variable = variables_[reference];
  const double value       = now_.values[reference];
  double width = 1e-3 * std::abs(value), rate = 1;
  const bool by_time = variable.role == Role::time;  // by the force that is played
  if (by_time) {
    width = curves_ ? 1e-3 * curves_->rest_force() : 1e6;
    rate  = stored_force_rate();
  } else if (variable.role == Role::bite_force || variable.role == Role::mean_force)
    width = curves_ ? 1e-3 * curves_->rest_force() : std::max(1e6, std::abs(value));
  else if (variable.role == Role::gap_damper)
    width = std::max(1e3, std::abs(value));
  else if (variable.role == Role::modal_damping)
    width = 0.01;
  else if (value == 0)
    width = 1e-3 * *std::max_element(built_.stiffness.begin(), built_.stiffness.end());
  const auto difference = [&](const double d) {
    std::vector<double> values = now_.values;
    values[reference]          = value + (by_time ? 0 : d);
    std::vector<double> above  = unknowns_at(values, by_time ? d : 0, asked);
    values[reference]          = value - (by_time ? 0 : d);
    const auto below           = unknowns_at(values, by_time ? -d : 0, asked);
    for (std::size_t i = 0; i < above.size(); ++i)
      above[i] = rate * (above[i] - below[i]) / (2 * d);
    return above;
  };
  std::vector<double> fine = difference(width / 2);
  const auto coarse        = difference(width);
  for (std::size_t i = 0; i < fine.size(); ++i)
    fine[i] = (4 * fine[i] - coarse[i]) / 3;
  return fine;
}

Status Instance::derivative(const char *function, const Direction &asked)
{
  if (chatter_)
    return log_->refuse(Status::error, std::string(function) + ": this model has no partial derivatives");
  if (!may_derive(function, asked))
    return Status::error;
  bring_up_to_date();
  std::fill(asked.result, asked.result + (asked.adjoint ? asked.n_knowns : asked.n_unknowns), 0.0);
  for (std::size_t k = 0; k < asked.n_knowns; ++k) {
    const auto column = by_known(asked, asked.knowns[k]);
    for (std::size_t u = 0; u < asked.n_unknowns; ++u)
      if (asked.adjoint)
        asked.result[k] += asked.seed[u] * column[u];
      else
        asked.result[u] += asked.seed[k] * column[u];
  }
  return Status::ok;
}
}  // namespace mill::fmu
