#include "chatter_motion.h"
#include <algorithm>
#include <cmath>

namespace mill::fmu {
namespace {
constexpr double tolerance    = 1e-8;   // -, relative error per step
constexpr double least_motion = 1e-9;   // m of gap, below which errors are not looked for
constexpr double smallest_gap = 0.02;   // of the steady one: rolls that come closer count as touching
constexpr double event_time   = 1e-11;  // s, within which an edge is located

// J. R. Dormand, P. J. Prince, J. Comput. Appl. Math. 6 (1980) 19.
constexpr double A[7][6]     = {{0, 0, 0, 0, 0, 0},
                                {1. / 5, 0, 0, 0, 0, 0},
                                {3. / 40, 9. / 40, 0, 0, 0, 0},
                                {44. / 45, -56. / 15, 32. / 9, 0, 0, 0},
                                {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729, 0, 0},
                                {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656, 0},
                                {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}};
constexpr double time_of[7]  = {0, 1. / 5, 3. / 10, 4. / 5, 8. / 9, 1, 1};
constexpr double error_of[7] = {71. / 57600, 0, -71. / 16695, 71. / 1920, -17253. / 339200, 22. / 525, -1. / 40};

enum Edge { entry_tight, exit_tight, held_edge, from_exit, from_entry, n_edges };
}  // namespace

ChatterMotion::ChatterMotion(const ChatterData &data, const PassData &pass)
    : data_(data), pass_(pass), bite_(pass), n_(data.gap_row.size()), contacts_(data.contact_stiffness.size()),
      entry_(data.strip_modulus / data.entry_distance), exit_(data.strip_modulus / data.exit_distance),
      impedance_(std::sqrt(data.strip_modulus * data.strip_density))
{
  for (auto &stage : stage_)
    stage.resize(2 * n_ + 2);
}

ChatterState ChatterMotion::displaced(const double distance) const
{
  ChatterState state;
  state.z.assign(2 * n_ + 2, 0);
  for (std::size_t i = 0; i < n_; ++i)
    state.z[i] = distance * data_.displaced[i];
  return state;
}

BiteMoment ChatterMotion::moment_of(const double *z, const ChatterInput &input) const
{
  const BiteMoment &steady = bite_.steady_moment();
  double gap = 0, rate = 0;
  for (std::size_t i = 0; i < n_; ++i) {
    gap += data_.gap_row[i] * z[i];
    rate += data_.gap_row[i] * z[n_ + i];
  }
  return {steady[0] + gap, rate, std::max(0., steady[2] + z[2 * n_]), std::max(0., steady[3] + z[2 * n_ + 1]),
          steady[4] + input.entry_thickness};
}

// A free strip is two bars that meet, (26.6).
BiteReading ChatterMotion::answer(const double *z, const bool held, const ChatterInput &input) const
{
  const BiteMoment m = moment_of(z, input);
  if (held)
    return bite_.at(m);
  const BiteMoment &steady = bite_.steady_moment();
  BiteReading free;
  free.contact        = false;
  free.exit_thickness = m[4];
  free.entry_speed    = free.exit_speed =
      (steady[4] * bite_.steady().entry_speed + steady[0] * bite_.steady().exit_speed +
       (steady[0] * m[3] - steady[4] * m[2]) / impedance_) /
      (steady[4] + steady[0]);
  return free;
}

// Force between work and backup roll, N; below zero where it would have to pull.
double ChatterMotion::pressing(const std::size_t contact, const double *z) const
{
  double approach   = 0;
  const double *row = &data_.contact_row[contact * n_];
  for (std::size_t i = 0; i < n_; ++i)
    approach += row[i] * z[i];
  return bite_.steady().force + data_.contact_stiffness[contact] * approach;
}

void ChatterMotion::slope(const double *z, const bool held, const double time, const ChatterInput &input,
                          double *derivative) const
{
  const BiteReading a = answer(z, held, input);
  const double force  = a.force - bite_.steady().force + input.force + input.slope * time;
  for (std::size_t i = 0; i < n_; ++i) {
    derivative[i]   = z[n_ + i];
    double sum      = data_.force_row[i] * force;
    const double *K = &data_.stiffness[i * n_], *C = &data_.damping[i * n_];
    for (std::size_t j = 0; j < n_; ++j)
      sum -= K[j] * z[j] + C[j] * z[n_ + j];
    derivative[n_ + i] = sum;
  }
  for (std::size_t c = 0; c < contacts_; ++c)
    if (const double pull = std::min(0., pressing(c, z)); pull < 0)  // which the spring has and a contact has not
      for (std::size_t i = 0; i < n_; ++i)
        derivative[n_ + i] += data_.contact_force_row[c * n_ + i] * pull;
  derivative[2 * n_]     = entry_ * (a.entry_speed - bite_.steady().entry_speed);
  derivative[2 * n_ + 1] = -exit_ * (a.exit_speed - bite_.steady().exit_speed);
}

// One step; returns its error over what is allowed.
double ChatterMotion::try_step(const std::vector<double> &z, const bool held, const double time, const double h,
                               const ChatterInput &input, std::vector<double> &result) const
{
  const std::size_t size = z.size();
  result.resize(size);
  for (int s = 0; s < 7; ++s) {
    for (std::size_t i = 0; i < size; ++i) {
      double sum = 0;
      for (int r = 0; r < s; ++r)
        sum += A[s][r] * stage_[r][i];
      result[i] = z[i] + h * sum;
    }
    slope(result.data(), held, time + time_of[s] * h, input, stage_[s].data());
  }
  // Errors over the motion as a whole, in metres of gap: a state that passes zero is not looked at more closely.
  double motion = least_motion, error = 0;
  for (std::size_t i = 0; i < size; ++i)
    motion = std::max(motion, std::max(std::abs(z[i]), std::abs(result[i])) / data_.magnitude[i]);
  for (std::size_t i = 0; i < size; ++i) {
    double sum = 0;
    for (int s = 0; s < 7; ++s)
      sum += error_of[s] * stage_[s][i];
    error = std::max(error, std::abs(h * sum) / (tolerance * motion * data_.magnitude[i]));
  }
  return std::isfinite(error) ? error : 1e30;
}

void ChatterMotion::edges(const double *z, const bool held, const ChatterInput &input,
                          std::vector<double> &value) const
{
  const BiteMoment &steady = bite_.steady_moment(), m = moment_of(z, input);
  value.assign(n_edges + contacts_, 1);
  value[entry_tight] = 1e-9 * (steady[2] + z[2 * n_]);
  value[exit_tight]  = 1e-9 * (steady[3] + z[2 * n_ + 1]);
  value[held_edge]   = bite_.contact_reserve(m) / steady[4];
  if (held && value[held_edge] > 0) {
    const BiteReading a = bite_.at(m);
    value[from_exit]    = a.from_exit;
    value[from_entry]   = a.from_entry;
  }
  for (std::size_t c = 0; c < contacts_; ++c)
    value[n_edges + c] = pressing(c, z) / bite_.steady().force;
}

// What ends a run: a strip that tears, rolls that meet.
std::string ChatterMotion::refusal(const double *z, const ChatterInput &input) const
{
  const BiteMoment m = moment_of(z, input);
  const auto whole   = bite_.yield_reserve(m);
  if (!(whole[0] > 0))
    return "the entry tension reaches the flow stress of the strip: it tears";
  if (!(whole[1] > 0))
    return "the exit tension reaches the flow stress of the strip: it tears";
  if (!(m[0] > smallest_gap * bite_.steady_moment()[0]))
    return "the gap closes: the rolls would meet";
  return "";
}

std::string ChatterMotion::advance(ChatterState &state, double &length, const ChatterInput &input) const
{
  const double whole = length;
  double elapsed     = 0;
  std::vector<double> before, after;
  edges(state.z.data(), state.strip_held, input, before);
  // The strip may have been taken or let go by an input that was changed.
  state.strip_held = before[held_edge] > 0;
  edges(state.z.data(), state.strip_held, input, before);
  if (std::string why = refusal(state.z.data(), input); !why.empty()) {
    length = 0;
    return why;
  }
  if (!(state.next_step > 0))
    state.next_step = 0.05 * data_.longest_step;
  const auto crossed = [&] {
    for (std::size_t e = 0; e < before.size(); ++e)
      if ((before[e] > 0) != (after[e] > 0))
        return true;
    return false;
  };
  while (elapsed < whole) {
    const double left = whole - elapsed;
    double h          = std::min(std::min(state.next_step, data_.longest_step), left);
    if (left - h < 1e-3 * h)
      h = left;
    const double error = try_step(state.z, state.strip_held, elapsed, h, input, trial_);
    const double grow  = std::min(5., std::max(0.2, 0.9 * std::pow(std::max(error, 1e-10), -0.2)));
    if (error > 1) {
      state.next_step = h * grow;
      if (state.next_step < 1e-13) {
        length = elapsed;
        return "the motion cannot be followed with any step";
      }
      continue;
    }
    if (h == left ? grow < 1 : true)
      state.next_step = h * grow;
    edges(trial_.data(), state.strip_held, input, after);
    if (crossed()) {
      // The first edge between 0 and h: no edge is crossed at low, one is at high.
      double low = 0, high = h;
      std::vector<double> at_low = before, at_high = after;
      int side = 0;
      for (int turn = 0; high - low > event_time && turn < 100; ++turn) {
        double middle = high;
        for (std::size_t e = 0; e < before.size(); ++e)
          if ((at_low[e] > 0) != (at_high[e] > 0)) {
            const double share = at_low[e] / (at_low[e] - at_high[e]);
            middle             = std::min(middle, low + (share > 0 && share < 1 ? share : 0.5) * (high - low));
          }
        // A chord that keeps one end is halved in between.
        if (std::abs(side) > 1)
          middle = 0.5 * (low + high);
        middle = std::min(std::max(middle, low + 0.3 * event_time), high - 0.3 * event_time);
        try_step(state.z, state.strip_held, elapsed, middle, input, trial_);
        edges(trial_.data(), state.strip_held, input, after);
        if (crossed()) {
          high    = middle;
          at_high = after;
          side    = side < 0 ? side - 1 : -1;
        } else {
          low    = middle;
          at_low = after;
          side   = side > 0 ? side + 1 : 1;
        }
      }
      h = high;
      try_step(state.z, state.strip_held, elapsed, h, input, trial_);
      edges(trial_.data(), state.strip_held, input, after);
      state.events += 1;
      state.next_step = std::min(state.next_step, 0.05 * data_.longest_step);
    }
    state.z.swap(trial_);
    elapsed          = h == left ? whole : elapsed + h;
    state.strip_held = after[held_edge] > 0;
    edges(state.z.data(), state.strip_held, input, before);
    if (std::string why = refusal(state.z.data(), input); !why.empty()) {
      length = elapsed;
      return why;
    }
  }
  return "";
}

ChatterMotion::Reading ChatterMotion::read(const ChatterState &state, const ChatterInput &input) const
{
  const double *z    = state.z.data();
  const BiteMoment m = moment_of(z, input);
  Reading r;
  r.bite          = answer(z, state.strip_held, input);
  r.gap           = m[0] - bite_.steady_moment()[0];
  r.entry_tension = m[2];
  r.exit_tension  = m[3];
  std::vector<double> derivative(z ? state.z.size() : 0);
  slope(z, state.strip_held, 0, input, derivative.data());
  const std::size_t points = data_.point.size() / n_;
  for (std::size_t p = 0; p < points; ++p) {
    double a = 0, y = 0;
    for (std::size_t i = 0; i < n_; ++i) {
      a += data_.point[p * n_ + i] * derivative[n_ + i];
      y += data_.point[p * n_ + i] * z[i];
    }
    r.acceleration.push_back(a);
    r.displacement.push_back(y);
  }
  return r;
}
}  // namespace mill::fmu
