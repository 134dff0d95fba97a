#include "dynamics/chatter/run.h"
#include "core/base/errors.h"
#include "dynamics/chatter/equations.h"
#include "dynamics/chatter/run_solver.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill::dynamics {
namespace {
using Edge = ChatterEquations::Edge;

constexpr std::size_t most_events = 100000;

struct Run {
  ChatterEquations equations;
  ChatterRun out;
  int skidding = 0;  // as it was last noted: 0 or one of the two changes

  void note(const double time, const ChatterChange change, const int contact = -1)
  {
    out.events.push_back({time, change, contact});
  }

  void stop_at_yield(const bite::Moment &m, const int side)
  {
    out.stopped = fmt::format("the {} tension of {:.4g} MPa reaches the flow stress of the strip there: it tears",
                              side ? "exit" : "entry", 1e-6 * m[2 + side]);
  }

  void stop_at_gap(const bite::Moment &m)
  {
    out.stopped = fmt::format("the gap closes to {:.3g} mm of {:.3g} mm: the rolls would meet", 1e3 * m[0],
                              1e3 * equations.steady_moment[0]);
  }

  // What holds at the start, as if it had just happened.
  void begin(const double *z)
  {
    std::vector<double> value(std::size_t(equations.edges()));
    equations.strip_held = bite::contact_reserve(equations.roll_bite, equations.moment(z)) > 0;
    equations.edge_values(z, value.data());
    std::vector<int> crossed(value.size());
    std::transform(value.begin(), value.end(), crossed.begin(), [](const double v) { return v < 0 ? -1 : 0; });
    pass(0, crossed, z);
  }

  void pass(const double time, const std::vector<int> &crossed, const double *z)
  {
    const auto crossing_of = [&](const int edge) { return crossed[std::size_t(edge)]; };
    if (crossing_of(Edge::entry_tight))
      note(time, crossing_of(Edge::entry_tight) < 0 ? ChatterChange::entry_slack : ChatterChange::entry_taut);
    if (crossing_of(Edge::exit_tight))
      note(time, crossing_of(Edge::exit_tight) < 0 ? ChatterChange::exit_slack : ChatterChange::exit_taut);
    for (std::size_t i = Edge::n_edges; i < crossed.size(); ++i)
      if (crossed[i])
        note(time, crossed[i] < 0 ? ChatterChange::rolls_part : ChatterChange::rolls_meet, int(i) - Edge::n_edges);
    if (crossing_of(Edge::held)) {
      equations.strip_held = crossing_of(Edge::held) > 0;
      note(time, equations.strip_held ? ChatterChange::strip_gripped : ChatterChange::strip_free);
    }
    skid(time, z);
    const bite::Moment m = equations.moment(z);
    for (const int side : {0, 1})
      if (crossing_of(Edge::entry_whole + side) < 0)
        stop_at_yield(m, side);
    if (crossing_of(Edge::gap_open) < 0)
      stop_at_gap(m);
    if (out.events.size() > most_events)
      out.stopped = fmt::format("more than {} events: the motion rattles", most_events);
  }

  // By the state, not by the crossing: a strip that is gripped again may skid from the start.
  void skid(const double time, const double *z)
  {
    const bite::BiteAnswer a = equations.answer(z);
    const int now            = !a.contact         ? 0
                               : a.from_exit < 0  ? int(ChatterChange::skid_exit)
                               : a.from_entry < 0 ? int(ChatterChange::skid_entry)
                                                  : 0;
    if (now == skidding)
      return;
    if (now != 0)
      note(time, ChatterChange(now));
    else if (a.contact)
      note(time, ChatterChange::grip);
    skidding = now;
  }

  void record(const Eigen::Index k, const double *z)
  {
    const Eigen::Index n     = equations.structure.n();
    const bite::Moment m     = equations.moment(z);
    const bite::BiteAnswer a = equations.answer(z);
    ChatterHistory &h        = out.history;
    h.gap[k]                 = m[0] - equations.steady_moment[0];
    h.gap_rate[k]            = m[1] - equations.steady_moment[1];
    h.entry_tension[k]       = m[2] - equations.steady_moment[2];
    h.exit_tension[k]        = m[3] - equations.steady_moment[3];
    h.force[k]               = a.force - equations.steady.force;
    h.friction[k]            = a.friction - equations.steady.friction;
    h.point.col(k)           = equations.structure.point * Eigen::Map<const Eigen::VectorXd>(z, n);
  }

  void size(const Eigen::Index moments, const double rate)
  {
    ChatterHistory &h = out.history;
    h.time            = Eigen::VectorXd::LinSpaced(moments, 0, double(moments - 1)) / rate;
    for (Eigen::VectorXd *row : {&h.gap, &h.gap_rate, &h.force, &h.entry_tension, &h.exit_tension, &h.friction})
      row->resize(moments);
    h.point.resize(equations.structure.point.rows(), moments);
  }

  void cut(const Eigen::Index moments)
  {
    ChatterHistory &h = out.history;
    for (Eigen::VectorXd *row :
         {&h.time, &h.gap, &h.gap_rate, &h.force, &h.entry_tension, &h.exit_tension, &h.friction})
      row->conservativeResize(moments);
    h.point.conservativeResize(Eigen::NoChange, moments);
  }
};
}  // namespace

ChatterRun nonlinear_run(const ChatterStandModel &stand, const WorkingPoint &point, const Linearisation scheme,
                         const Eigen::VectorXd &start, const ChatterRunOptions &options)
{
  if (!(options.duration > 0) || !(options.rate > 0) || !std::isfinite(options.duration * options.rate))
    throw InputError(fmt::format("a run needs a duration and a rate above zero, not {} s and {} Hz",
                                 options.duration, options.rate));
  if (!(options.tolerance > 0) || !(options.tolerance <= 1e-2))
    throw InputError(fmt::format("a run needs a tolerance above zero and at most 0.01, not {}; 1e-8 is usual",
                                 options.tolerance));
  Run run{ChatterEquations(stand, point, scheme, options), {}, 0};
  if (start.size() != run.equations.size() || !start.allFinite())
    throw InputError(fmt::format("a run of this stand starts from {} finite numbers, not from {}",
                                 run.equations.size(), start.size()));
  const auto moments = Eigen::Index(std::floor(options.duration * options.rate * (1 + 1e-12))) + 1;
  run.size(moments, options.rate);
  ChatterIntegrator integrator(run.equations, start, options.tolerance);
  run.begin(integrator.state());
  if (!run.out.stopped.empty())
    throw InputError("a run cannot start like this: " + run.out.stopped);
  run.record(0, integrator.state());
  Eigen::Index done = 1;
  while (done < moments && run.out.stopped.empty()) {
    const auto reached = integrator.advance(run.out.history.time[done]);
    run.out.end        = reached.time;
    if (!reached.failure.empty())
      run.out.stopped = reached.failure;
    else if (reached.crossed.empty())
      run.record(done++, integrator.state());
    else {
      run.pass(reached.time, reached.crossed, integrator.state());
      integrator.restart(reached.time);
    }
  }
  run.cut(done);
  run.out.history.last = Eigen::Map<const Eigen::VectorXd>(integrator.state(), run.equations.size());
  run.out.steps        = integrator.steps();
  run.out.bites        = run.equations.bites;
  return std::move(run.out);
}
}  // namespace mill::dynamics
