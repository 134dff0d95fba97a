#include "dynamics/nonlinear/adaptive_run.h"
#include "core/base/errors.h"
#include <algorithm>
#include <arkode/arkode_erkstep.h>
#include <cmath>
#include <fmt/format.h>
#include <nvector/nvector_serial.h>

namespace mill::dynamics {
struct AdaptiveRun::Solver {
  const CurveStand &stand;
  std::size_t n;
  SUNContext context = nullptr;
  N_Vector state     = nullptr;  // q, q', work, loss
  void *arkode       = nullptr;
  double now         = 0;
  double from = 0, to = 0, F0 = 0, F1 = 0;  // straight line of the force
  std::vector<bool> touches;
  std::vector<double> before, reach;  // state and compressions at the beginning of a step
  std::vector<double> q_slope;        // compression rates
  std::string complaint;

  explicit Solver(const CurveStand &s) : stand(s), n(s.modes()) {}
  Solver(const Solver &)            = delete;
  Solver &operator=(const Solver &) = delete;
  ~Solver()
  {
    ERKStepFree(&arkode);
    if (state)
      N_VDestroy(state);
    SUNContext_Free(&context);
  }

  double *values() const
  {
    return NV_DATA_S(state);
  }

  static int slope(const double t, N_Vector y, N_Vector derivative, void *self)
  {
    const Solver &s         = *static_cast<Solver *>(self);
    const CurveStand &stand = s.stand;
    const double *q = NV_DATA_S(y), *v = q + s.n;
    double *dq = NV_DATA_S(derivative), *dv = dq + s.n;
    double gap = 0, lost = 0;
    for (std::size_t k = 0; k < s.n; ++k)
      gap += stand.push[k] * v[k];
    const double force = s.F0 + (s.F1 - s.F0) * (t - s.from) / (s.to - s.from),
                 bite  = force - stand.gap_damper * gap;
    for (std::size_t k = 0; k < s.n; ++k) {
      const double damper = 2 * stand.damping * stand.rate[k] * v[k];
      dq[k]               = v[k];
      dv[k]               = stand.push[k] * bite - damper - stand.rate[k] * stand.rate[k] * q[k];
      lost += damper * v[k];
    }
    for (const CurveSpring &spring : stand.springs) {
      const double f = beyond_tangent(stand, spring, further_compression(spring, q)).force;
      for (std::size_t k = 0; k < s.n; ++k)
        dv[k] -= spring.row[k] * f;
    }
    dv[s.n]     = force * gap;
    dv[s.n + 1] = lost + stand.gap_damper * gap * gap;
    return std::isfinite(dv[s.n]) && std::isfinite(dv[s.n + 1]) ? 0 : 1;
  }

  static void listen(int, const char *, const char *, char *message, void *self)
  {
    static_cast<Solver *>(self)->complaint = message;
  }

  void require(const int flag, const char *what) const
  {
    if (flag < 0)
      throw SolverError({fmt::format("curves of the contacts: {} failed with flag {}", what, flag), complaint,
                         "memory is exhausted", "shorten the record or lower its rate", ""});
  }

  // Sizes of the motion in every mode, from what the springs give way at rest.
  void set_tolerances(const double tolerance) const
  {
    double energy = 0, fastest = 0;
    for (const CurveSpring &spring : stand.springs)
      energy += 0.5 * spring.share * spring.stiffness * spring.rest * spring.rest;
    for (const double w : stand.rate)
      fastest = std::max(fastest, w);
    const double speed = std::sqrt(2 * energy);  // of a mode with that energy
    N_Vector absolute  = N_VClone(state);
    for (std::size_t k = 0; k < n; ++k) {
      NV_Ith_S(absolute, sunindextype(k))     = tolerance * speed / std::max(stand.rate[k], 1e-3 * fastest);
      NV_Ith_S(absolute, sunindextype(n + k)) = tolerance * speed;
    }
    NV_Ith_S(absolute, sunindextype(2 * n)) = NV_Ith_S(absolute, sunindextype(2 * n + 1)) = tolerance * energy;
    const int flag = ERKStepSVtolerances(arkode, tolerance, absolute);
    N_VDestroy(absolute);
    require(flag, "ERKStepSVtolerances");
    // A tenth of the shortest period: no spring may part and touch unseen within one step.
    require(ERKStepSetMaxStep(arkode, 0.2 * M_PI / fastest), "ERKStepSetMaxStep");
  }

  void start_at(const CurveState &start, const double time, const double tolerance)
  {
    require(SUNContext_Create(nullptr, &context), "SUNContext_Create");
    state = N_VNew_Serial(sunindextype(2 * n + 2), context);
    std::copy(start.q.begin(), start.q.end(), values());
    std::copy(start.v.begin(), start.v.end(), values() + n);
    values()[2 * n] = values()[2 * n + 1] = 0;
    now                                   = time;
    from                                  = time;
    to                                    = time + 1;
    arkode                                = ERKStepCreate(slope, time, state, context);
    require(arkode ? 0 : -1, "ERKStepCreate");
    require(ERKStepSetErrHandlerFn(arkode, listen, this), "ERKStepSetErrHandlerFn");
    require(ERKStepSetUserData(arkode, this), "ERKStepSetUserData");
    require(ERKStepSetOrder(arkode, 8), "ERKStepSetOrder");
    require(ERKStepSetMaxNumSteps(arkode, 1000000), "ERKStepSetMaxNumSteps");
    // Where a contact begins to carry its force goes with a power near one of the compression: short steps there.
    require(ERKStepSetMaxErrTestFails(arkode, 60), "ERKStepSetMaxErrTestFails");
    set_tolerances(tolerance);
    before.resize(2 * n + 2);
    for (const CurveSpring &spring : stand.springs) {
      reach.push_back(compression(spring));
      touches.push_back(reach.back() > 0);
    }
    q_slope.resize(reach.size());
  }

  double compression(const CurveSpring &spring) const
  {
    return spring.rest + further_compression(spring, values());
  }
  double closing(const CurveSpring &spring) const  // m/s
  {
    return further_compression(spring, values() + n);
  }

  void restart(const double time)
  {
    require(ERKStepReset(arkode, time, state), "ERKStepReset");
    now = time;
  }

  // One step, not beyond `end`.
  void step_to(const double end, const int mode)
  {
    if (!(end - now > 1e-14 * std::max(1.0, std::abs(end)))) {  // closer than a step can be
      now = end;
      return;
    }
    require(ERKStepSetStopTime(arkode, end), "ERKStepSetStopTime");
    const int flag = ERKStepEvolve(arkode, end, state, &now, mode);
    if (flag < 0)
      throw SolverError(
          {fmt::format("curves of the contacts: the integration stops at t = {:.9g} s (ARKODE flag {})", now,
                       flag),
           complaint, "a damping many orders from what the stiffness asks for, or a force that is not a number",
           "check dynamics.modal_damping and the force record", "the motion before this time"});
  }

  void back_to(const double time)
  {
    std::copy(before.begin(), before.end(), values());
    restart(time);
  }

  // s, the first moment within a step at which this spring changes its state; NaN: none.  The cubic
  // through compressions and rates at both ends says where to look.
  double crossing_guess(const std::size_t j, const double start, const double rate_at_start) const
  {
    const CurveSpring &spring = stand.springs[j];
    const double h = now - start, c0 = reach[j], c1 = compression(spring);
    const double sign = touches[j] ? 1 : -1;
    if (sign * c1 < 0)
      return start + h * (c0 == c1 ? 1 : std::clamp(c0 / (c0 - c1), 0.0, 1.0));
    // Both ends on the same side: the extreme of the cubic between them.
    const double a = h * rate_at_start, b = h * closing(spring), rise = c1 - c0;
    if (!(sign * a < 0 && sign * b > 0))
      return std::nan("");
    const double p2 = 3 * rise - 2 * a - b, p3 = a + b - 2 * rise;
    double t = 0.5;
    for (int k = 0; k < 20; ++k) {
      const double slope = a + t * (2 * p2 + 3 * t * p3), curve = 2 * p2 + 6 * t * p3;
      t = std::clamp(t - slope / curve, 0.0, 1.0);
    }
    return sign * (c0 + t * (a + t * (p2 + t * p3))) < 0 ? start + t * h : std::nan("");
  }

  // Moves to the moment within (start, end] at which spring j changes; `end` is on the other side.
  void refine(const std::size_t j, const double start, double end)
  {
    const CurveSpring &spring = stand.springs[j];
    double low = start, guess = end;
    const double sign = touches[j] ? 1 : -1, fine = 1e-13 * std::max(1.0, std::abs(end));
    for (int round = 0; round < 60; ++round) {
      back_to(start);
      step_to(guess, ARK_NORMAL);
      const double c = sign * compression(spring), rate = sign * closing(spring);
      (c > 0 ? low : end) = guess;
      if (end - low <= fine)
        break;
      double next = guess - c / rate;
      if (!(next > low && next < end))
        next = 0.5 * (low + end);
      if (std::abs(next - guess) <= 0.5 * fine)
        break;
      guess = next;
    }
  }

  // A step that crossed an edge is taken again up to the first crossing.
  void settle_events(const double start, const std::vector<double> &rate_at_start,
                     std::vector<SpringEvent> &events)
  {
    const double whole = now;
    std::size_t first  = stand.springs.size();
    double earliest    = 0;
    for (std::size_t j = 0; j < stand.springs.size(); ++j) {
      const double guess = crossing_guess(j, start, rate_at_start[j]);
      if (!std::isnan(guess) && (first == stand.springs.size() || guess < earliest)) {
        first    = j;
        earliest = guess;
      }
    }
    if (first == stand.springs.size())
      return;
    // A guess from an extreme is the other side itself; one from a change of sign is between.
    const double sign = touches[first] ? 1 : -1;
    double other_side = whole;
    if (sign * compression(stand.springs[first]) > 0) {
      back_to(start);
      step_to(earliest, ARK_NORMAL);
      if (sign * compression(stand.springs[first]) > 0)
        return;  // came close only; the step ends there
      other_side = earliest;
    }
    refine(first, start, other_side);
    touches[first] = !touches[first];
    events.push_back({now, first, !touches[first]});
  }

  // s, longest step near the edge of a contact, where the force is a power of the compression that no polynomial
  // follows: half of the way to the edge, and as much away from it.  theory.md 36.4
  double longest_near_edges() const
  {
    constexpr double least = 1e-9, part = 0.2;
    double longest = INFINITY;
    for (std::size_t j = 0; j < stand.springs.size(); ++j)
      if (reach[j] >= 0)
        longest = std::min(longest, std::max(least, part * reach[j] / std::abs(q_slope[j])));
    return longest;
  }

  void note_reach()
  {
    for (std::size_t j = 0; j < stand.springs.size(); ++j) {
      reach[j]   = compression(stand.springs[j]);
      q_slope[j] = closing(stand.springs[j]);
    }
  }
};

AdaptiveRun::AdaptiveRun(const CurveStand &stand, const CurveState &start, const double time,
                         const double tolerance)
    : solver_(std::make_unique<Solver>(stand))
{
  solver_->start_at(start, time, tolerance);
}

AdaptiveRun::~AdaptiveRun() = default;

void AdaptiveRun::advance(const double time, const double F0, const double F1, std::vector<SpringEvent> &events)
{
  Solver &s = *solver_;
  s.from    = s.now;
  s.to      = time;
  s.F0      = F0;
  s.F1      = F1;
  while (s.now < time) {
    const double start = s.now;
    std::copy(s.values(), s.values() + s.before.size(), s.before.begin());
    s.note_reach();
    const double longest = s.longest_near_edges();
    s.step_to(longest < time - start ? start + longest : time, ARK_ONE_STEP);
    s.settle_events(start, s.q_slope, events);
  }
}

double AdaptiveRun::time() const
{
  return solver_->now;
}
const double *AdaptiveRun::q() const
{
  return solver_->values();
}
const double *AdaptiveRun::v() const
{
  return solver_->values() + solver_->n;
}
double AdaptiveRun::work() const
{
  return solver_->values()[2 * solver_->n];
}
double AdaptiveRun::loss() const
{
  return solver_->values()[2 * solver_->n + 1];
}
long AdaptiveRun::steps() const
{
  long now = 0;
  ERKStepGetNumSteps(solver_->arkode, &now);
  return now;
}
}  // namespace mill::dynamics
