#include "instance.h"
#include "resources.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

namespace mill::fmu {
namespace {
const char *name_of(const Phase phase)
{
  switch (phase) {
  case Phase::instantiated:
    return "after instantiation";
  case Phase::set_up:
    return "after the experiment was set up";
  case Phase::initialization:
    return "in initialization mode";
  case Phase::step:
    return "between steps";
  case Phase::intermediate:
    return "inside a step";
  case Phase::terminated:
    return "after termination";
  case Phase::failed:
    break;
  }
  return "after a failure";
}

std::uint64_t hash_of(const std::string &text)
{
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  for (const char c : text)
    hash = (hash ^ std::uint64_t(static_cast<unsigned char>(c))) * 1099511628211u;
  return hash;
}
}  // namespace

std::string number_text(const double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  for (char *c = text; *c; ++c)
    if (*c == ',')
      *c = '.';
  return text;
}

Instance::Instance(std::string folder, const std::string &token, std::unique_ptr<Log> log, const int version)
    : folder_(std::move(folder)), log_(std::move(log)), version_(version)
{
  const std::string path = folder_ + "model.json";
  const std::string text = read_file(path);
  try {
    model_ = read_model(text);
  } catch (const std::exception &e) {
    throw std::runtime_error(path + " is not a model of this runtime: " + e.what());
  }
  if (token != model_.guid)
    throw std::runtime_error("the model has the identity " + model_.guid + ", the description has " + token +
                             "; they belong to different exports");
  variables_ = variables_of(model_);
  mark_      = hash_of(model_.guid);
  set_start_values();
}

void Instance::set_start_values()
{
  now_ = Snapshot();
  now_.values.reserve(variables_.size());
  for (const Variable &variable : variables_)
    now_.values.push_back(variable.start);
  use_parameters();
}

bool Instance::allows(const char *function, const std::initializer_list<Phase> phases) const
{
  if (std::find(phases.begin(), phases.end(), now_.phase) != phases.end())
    return true;
  log_->refuse(Status::error, std::string(function) + " is not allowed " + name_of(now_.phase));
  return false;
}

Status Instance::set_up(const char *function, const double start, const bool has_stop, const double stop)
{
  if (!allows(function, {Phase::instantiated, Phase::set_up}))
    return Status::error;
  if (!std::isfinite(start) || (has_stop && !(stop >= start)))
    return log_->refuse(Status::error, std::string(function) + ": start time " + number_text(start) +
                                           (has_stop ? " s and stop time " + number_text(stop) : "") +
                                           " s do not give a span of time");
  now_.start     = start;
  now_.time      = start;
  now_.has_stop  = has_stop;
  now_.stop      = stop;
  now_.phase     = Phase::set_up;
  now_.values[0] = start;
  return Status::ok;
}

Status Instance::enter_initialization(const char *function)
{
  if (!allows(function, {Phase::set_up}))
    return Status::error;
  now_.phase         = Phase::initialization;
  now_.outputs_stale = true;
  return Status::ok;
}

Status Instance::exit_initialization(const char *function)
{
  if (!allows(function, {Phase::initialization}))
    return Status::error;
  if (const std::string why = solve_pass(); !why.empty())
    return log_->refuse(Status::error, std::string(function) + ": " + why);
  bring_up_to_date();
  now_.phase = Phase::step;
  log_->event((chatter_ ? "vibrates from " : "at rest under " + number_text(now_.force) + " N at ") +
              number_text(now_.time) + " s");
  return Status::ok;
}

Status Instance::terminate(const char *function)
{
  if (!allows(function, {Phase::step}))
    return Status::error;
  bring_up_to_date();
  now_.phase = Phase::terminated;
  return Status::ok;
}

Status Instance::reset(const char *function)
{
  if (now_.phase == Phase::intermediate)
    return log_->refuse(Status::error, std::string(function) + " is not allowed inside a step");
  set_start_values();
  log_->event("all values are those after instantiation");
  return Status::ok;
}

double Instance::mean() const
{
  return now_.values[2];
}

// Only when it is needed: most clients give a force.
void Instance::load_series()
{
  if (!series_.time.empty())
    return;
  const std::string path = folder_ + "force.csv";
  const std::string text = read_file(path);
  try {
    series_ = read_series(text);
  } catch (const std::exception &e) {
    throw std::runtime_error(path + ": " + e.what());
  }
}

// N, at the start of the run.
double Instance::first_force()
{
  if (!plays_series())
    return now_.values[bite_force];
  load_series();
  now_.place = series_.before(now_.time, 0);
  return series_.at(now_.time, now_.place);
}

// The state at the start of a run: rest in the equilibrium under a force, or displaced rolls.
void Instance::settle(const double force)
{
  now_.force      = force;
  now_.last_slope = 0;
  if (model_.kind == StandKind::chatter) {
    now_.vibration = chatter_->displaced(bite_number(BiteNumber::start));
    return;
  }
  const double above = force - mean();
  now_.modes         = curves_ ? curves_->equilibrium(above) : motion_->equilibrium(above);
}

// In kind "chatter" the working point of the present parameters is solved before, or can be.
void Instance::bring_up_to_date()
{
  if (!now_.outputs_stale)
    return;
  if (const std::string why = solve_pass(); !why.empty())
    throw std::runtime_error(why);
  if (now_.phase == Phase::initialization || now_.phase == Phase::instantiated)
    settle(first_force());
  if (chatter_)
    evaluate_vibration();
  else
    evaluate(now_.modes, now_.force, now_.values);
  now_.outputs_stale = false;
}

Tuning Instance::tuning_of(const std::vector<double> &values) const
{
  Tuning tuning;
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const Role role = variables_[i].role;
    if (role == Role::mass)
      tuning.mass.push_back(values[i]);
    else if (role == Role::spring)
      tuning.stiffness.push_back(values[i]);
    else if (role == Role::gap_damper)
      tuning.gap_damper = values[i];
    else if (role == Role::modal_damping)
      tuning.modal_damping = values[i];
  }
  return tuning;
}

// The modes of the present parameters; displacements and velocities of the points stay what they are.  (35.7)
void Instance::use_parameters()
{
  if (model_.kind == StandKind::chatter)
    return;  // solve_pass(), where its working point is needed
  const Tuning tuning = tuning_of(now_.values);
  if (motion_ && same_tuning(tuning, built_))
    return;
  ModalSystem system = modal_system(model_, tuning);
  if (!now_.modes.q.empty() && system.from_points.rows > 0) {
    const std::size_t n = system.rad.size(), m = model_.points.size();
    ModalState moved{std::vector<double>(n), std::vector<double>(n), {}};
    for (std::size_t j = 0; j < m; ++j) {
      double y = 0, v = 0;
      for (std::size_t k = 0; k < n; ++k) {
        y += system_.point(j, k) * now_.modes.q[k];
        v += system_.point(j, k) * now_.modes.p[k];
      }
      for (std::size_t k = 0; k < n; ++k) {
        moved.q[k] += system.from_points(k, j) * y;
        moved.p[k] += system.from_points(k, j) * v;
      }
    }
    now_.modes = moved;
  }
  now_.modes.z.clear();
  system_ = std::move(system);
  motion_ = std::make_unique<Motion>(system_);
  built_  = tuning;
  if (model_.kind == StandKind::curves) {
    if (!curves_)
      curves_ = std::make_unique<CurveMotion>(model_);
    curves_->tune(tuning.modal_damping, tuning.gap_damper);
  }
  for (std::size_t i = 0; i < variables_.size(); ++i)
    if (variables_[i].role == Role::frequency)
      now_.values[i] = system_.rad[std::size_t(variables_[i].index)] / (2 * 3.14159265358979323846);
}

// Outputs of modes under a force.  (35.1), (36.4)
void Instance::evaluate(const ModalState &modes, const double force, std::vector<double> &values,
                        const ModalState *rates_at)
{
  motion_->acceleration(modes, force - values[2], scratch_);
  if (curves_ && rates_at)
    curves_->add_spring_rates(*rates_at, scratch_);
  else if (curves_)
    curves_->add_springs(modes, scratch_);
  for (std::size_t i = 0; i < variables_.size(); ++i) {
    const Variable &variable = variables_[i];
    const auto at_point      = [&](const std::vector<double> &of_modes) {
      const double *row = &system_.point.entry[std::size_t(variable.index) * system_.rad.size()];
      double sum        = 0;
      for (std::size_t k = 0; k < of_modes.size(); ++k)
        sum += row[k] * of_modes[k];
      return sum;
    };
    if (variable.role == Role::acceleration)
      values[i] = at_point(scratch_);
    else if (variable.role == Role::displacement)
      values[i] = at_point(modes.q);
    else if (variable.role == Role::cell_force) {
      values[i] = system_.load_cell_share * values[2];
      for (std::size_t k = 0; k < modes.q.size(); ++k)
        values[i] += system_.load_cell[k] * modes.q[k];
    }
  }
}

Status Instance::may_step(const char *function, const double from, const double length)
{
  const std::string prefix = std::string(function) + ": ";
  if (!allows(function, {Phase::step}))
    return Status::error;
  constexpr double longest = 1e9;  // s
  if (!(length > 0 && length <= longest) || !std::isfinite(from))
    return log_->refuse(Status::error, prefix + "the step from " + number_text(from) + " s over " +
                                           number_text(length) + " s must have a length above zero and up to " +
                                           number_text(longest) + " s");
  const double end = from + length;
  // A client adds or multiplies its step sizes: some rounding of the time, or a small part of the step.
  const double close = 1e-9 * length + 64 * 2.2e-16 * std::max(std::abs(from), std::abs(now_.time));
  if (std::abs(from - now_.time) > close || !(end > now_.time))
    return log_->refuse(Status::error, prefix + "the step begins at " + number_text(from) +
                                           " s, the instance is at " + number_text(now_.time) + " s");
  if (now_.has_stop && end > now_.stop + 1e-9 * length + 64 * 2.2e-16 * std::abs(now_.stop))
    return log_->refuse(Status::error, prefix + "the step to " + number_text(end) + " s passes the stop time " +
                                           number_text(now_.stop) + " s");
  if (now_.ended)
    return log_->refuse(Status::error, prefix + "the run has ended at " + number_text(now_.time) + " s");
  if (const std::string why = solve_pass(); !why.empty())
    return log_->refuse(version_ == 3 ? Status::discard : Status::error,
                        prefix + why + "; the instance stays at " + number_text(now_.time) + " s");
  return Status::ok;
}

// One straight stretch of force.
void Instance::travel(const double length, const StraightForce &force)
{
  if (curves_)
    curves_->advance(now_.modes, length, force);
  else
    motion_->advance(now_.modes, length, force);
}

Status Instance::do_step(const char *function, const double from, const double length)
{
  double end = from + length;
  std::string why;
  if (chatter_)
    why = vibrate(end);
  else if (plays_series())
    play_series(end);
  else
    drive(end);
  end_is_given_      = false;
  now_.slope         = 0;
  now_.time          = end;
  now_.values[0]     = end;
  now_.outputs_stale = true;
  return why.empty() ? Status::ok : end_run(function, why);
}

// The motion cannot go on: the rest of the step is not taken.
Status Instance::end_run(const char *function, const std::string &why)
{
  now_.ended             = true;
  const std::string text = std::string(function) + ": " + why;
  if (version_ == 2)
    return log_->refuse(Status::discard, text);
  log_->refuse(Status::warning, text);
  return Status::ok;
}

// A step under the force of the client.
void Instance::drive(const double end)
{
  const double begin = now_.values[bite_force], length = end - now_.time;
  if (!curves_)
    motion_->begin(now_.modes);
  travel(length, {begin - mean(), now_.slope});
  if (!curves_)
    motion_->end(now_.modes);
  now_.force      = end_is_given_ ? force_at_end_ : begin + now_.slope * length;
  now_.last_slope = now_.slope;
  if (end_is_given_)
    now_.values[bite_force] = force_at_end_;
}

// The stored force acts where the client asks for it, and where no input is connected.
bool Instance::plays_series() const
{
  if (!model_.has_series)
    return false;
  if (now_.use_stored != StoredForce::not_set)
    return now_.use_stored == StoredForce::on;
  return !now_.input_set && !force_expected_;
}

// Every sample inside the step ends a stretch, so that each sees one straight line.
void Instance::play_series(const double end)
{
  const auto &time = series_.time;
  double instant = now_.time, force = now_.force, slope = 0;
  if (!curves_)
    motion_->begin(now_.modes);
  for (std::size_t place = std::size_t(now_.place);;) {
    const bool inside = place > 0 && place < time.size();
    const double stop = place < time.size() ? std::min(end, time[place]) : end;
    slope = inside ? (series_.force[place] - series_.force[place - 1]) / (time[place] - time[place - 1]) : 0;
    travel(stop - instant, {force - mean(), slope});
    instant = stop;
    if (place < time.size() && time[place] <= end) {
      force = series_.force[place];
      ++place;
    } else {
      now_.place = place;
      break;
    }
  }
  if (!curves_)
    motion_->end(now_.modes);
  now_.force      = series_.at(end, std::size_t(now_.place));
  now_.last_slope = slope;
}

void Instance::enter_intermediate()
{
  force_before_ = now_.values[bite_force];
  now_.phase    = Phase::intermediate;
}

void Instance::leave_intermediate(const double length)
{
  now_.phase              = Phase::step;
  force_at_end_           = now_.values[bite_force];
  now_.values[bite_force] = force_before_;
  now_.slope              = (force_at_end_ - force_before_) / length;
  end_is_given_           = true;
}
}  // namespace mill::fmu
