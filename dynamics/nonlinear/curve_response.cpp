#include "dynamics/nonlinear/curve_response.h"
#include "core/base/errors.h"
#include "core/base/require.h"
#include "dynamics/response/time_walk.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace mill::dynamics {
namespace {
// Keeps what the springs reach and writes the outputs of one run.
class CurveRecorder {
public:
  CurveRecorder(const CurveStand &stand, const ModalModel &model, const OutputGrid &grid, const double mean)
      : stand_(stand), model_(model), mean_(mean)
  {
    const auto n = Eigen::Index(stand.modes()), m = model.point.rows();
    require(model.frequency.size() == n, "points and springs are seen in the same modes");
    run.response.labels = model.labels;
    run.response.time =
        Eigen::VectorXd::LinSpaced(grid.n, grid.begin, grid.begin + double(grid.n - 1) * grid.step);
    run.response.force.resize(grid.n);
    run.response.acceleration.resize(grid.n, m);
    run.response.load_cell.resize(grid.n);
    run.response.form = HoldForm::modal;
    run.modal_peak    = Eigen::VectorXd::Zero(n);
    acceleration_.resize(n);
    std::map<std::string, std::size_t> places;
    for (const CurveSpring &spring : stand.springs) {
      const auto [place, fresh] = places.emplace(spring.name, run.springs.size());
      if (fresh)
        run.springs.push_back({spring.name, spring.force, 1, grid.begin, 1, 0});
      group_.push_back(place->second);
    }
  }

  // Springs and modes at any moment; modal forces of the springs for a following output().
  void see(const double time, const double *q)
  {
    const auto n = Eigen::Index(stand_.modes());
    for (Eigen::Index k = 0; k < n; ++k) {
      run.modal_peak[k] = std::max(run.modal_peak[k], std::abs(q[k]));
      acceleration_[k]  = 0;
    }
    for (std::size_t j = 0; j < stand_.springs.size(); ++j) {
      const CurveSpring &spring = stand_.springs[j];
      const double d            = further_compression(spring, q);
      const SpringForce beyond  = beyond_tangent(stand_, spring, d);
      const double over  = std::max(0.0, 1 + (beyond.force / spring.share + spring.stiffness * d) / spring.force);
      SpringReach &reach = run.springs[group_[j]];
      if (over < reach.least) {
        reach.least    = over;
        reach.least_at = time;
      }
      reach.largest = std::max(reach.largest, over);
      for (Eigen::Index k = 0; k < n; ++k)
        acceleration_[k] -= spring.row[std::size_t(k)] * beyond.force;
    }
  }

  void output(const Eigen::Index i, const double F, const double *q, const double *v)
  {
    const auto n = Eigen::Index(stand_.modes());
    const Eigen::Map<const Eigen::VectorXd> positions(q, n), rate_of(v, n);
    const double bite = F - stand_.gap_damper * model_.force.dot(rate_of);
    for (Eigen::Index k = 0; k < n; ++k) {
      const double w = stand_.rate[std::size_t(k)];
      acceleration_[k] += model_.force[k] * bite - 2 * stand_.damping * w * v[k] - w * w * q[k];
    }
    run.response.force[i]            = F + mean_;
    run.response.acceleration.row(i) = (model_.point * acceleration_).transpose();
    run.response.load_cell[i]        = model_.load_cell.dot(positions) + model_.load_cell_share * mean_;
  }

  CurveRun run;

private:
  const CurveStand &stand_;
  const ModalModel &model_;
  double mean_;
  std::vector<std::size_t> group_;
  Eigen::VectorXd acceleration_;
};

CurveState start_of(const CurveStand &stand, const double force)
{
  CurveState start;
  if (!rest_under(stand, force, start))
    throw SolverError({"curves of the contacts: no equilibrium under the first sample of the force",
                       fmt::format("{:.6g} kN about the mean", force / 1e3),
                       "a force below zero pulls the rolls apart, and nothing holds them then",
                       "check the force record, or set dynamics.contact = \"linear\"", ""});
  return start;
}
}  // namespace

CurveRun curve_response(const CurveStand &stand, const ModalModel &model, const ForceRecord &force,
                        const double output_rate, const double tolerance)
{
  const double mean = force.force.mean();
  const ForceRecord fluctuation{force.time, force.force.array() - mean, {}};
  const OutputGrid grid = output_grid(force, output_rate);
  CurveRecorder recorder(stand, model, grid, mean);
  const CurveState start = start_of(stand, fluctuation.force[0]);
  const double energy    = energy_of(stand, start.q.data(), start.v.data());
  AdaptiveRun motion(stand, start, grid.begin, tolerance);
  CurveRun &run = recorder.run;
  recorder.see(grid.begin, motion.q());
  recorder.output(0, fluctuation.force[0], motion.q(), motion.v());
  double now = grid.begin;
  walk(fluctuation, grid, [&](const Step &step) {
    now = step.output > 0 ? grid.begin + double(step.output) * grid.step : now + step.length;
    motion.advance(now, step.F0, step.F1, run.events);
    recorder.see(now, motion.q());
    run.work = std::max(run.work, std::abs(motion.work()));
    if (step.output > 0)
      recorder.output(step.output, step.F1, motion.q(), motion.v());
  });
  run.steps            = motion.steps();
  const double balance = energy_of(stand, motion.q(), motion.v()) - energy - motion.work() + motion.loss();
  run.balance          = run.work > 0 ? balance / run.work : 0;
  for (const SpringEvent &event : run.events)
    for (SpringReach &reach : run.springs)
      if (event.parts && reach.name == stand.springs[event.spring].name) {
        ++reach.parted;
        if (reach.least > 0)
          reach.least_at = event.time;
        reach.least = 0;
      }
  return std::move(recorder.run);
}

CurveRun fixed_step_response(const CurveStand &stand, const ModalModel &model, const ForceRecord &force,
                             const double output_rate, const int parts)
{
  const double mean = force.force.mean();
  const ForceRecord fluctuation{force.time, force.force.array() - mean, {}};
  const OutputGrid grid = output_grid(force, output_rate);
  CurveRecorder recorder(stand, model, grid, mean);
  CurveState state = start_of(stand, fluctuation.force[0]);
  std::map<double, FixedStep> kernels;  // by length of step: few, since samples and outputs are even
  recorder.see(grid.begin, state.q.data());
  recorder.output(0, fluctuation.force[0], state.q.data(), state.v.data());
  double now = grid.begin;
  walk(fluctuation, grid, [&](const Step &step) {
    auto kernel = kernels.find(step.length);
    if (kernel == kernels.end()) {
      if (kernels.size() > 1000)
        kernels.clear();
      kernel = kernels.emplace(step.length, FixedStep(stand, step.length / parts)).first;
    }
    const double rise = (step.F1 - step.F0) / parts;
    for (int i = 0; i < parts; ++i)
      if (!kernel->second.advance(state, step.F0 + i * rise, step.F0 + (i + 1) * rise))
        throw SolverError(
            {fmt::format("curves of the contacts: a fixed step at t = {:.9g} s has no solution", now), "",
             "a step far longer than the fastest mode's period", "raise dynamics.output_rate", ""});
    now += step.length;
    recorder.see(now, state.q.data());
    ++recorder.run.steps;
    if (step.output > 0)
      recorder.output(step.output, step.F1, state.q.data(), state.v.data());
  });
  return std::move(recorder.run);
}
}  // namespace mill::dynamics
