#include "reduce/bite/slab/elastic_arc.h"
#include "core/base/errors.h"
#include "core/laws/friction_law.h"
#include "reduce/bite/arc/elastic_arc_problem.h"
#include "reduce/bite/sentence.h"
#include "reduce/bite/slab/karman_arc.h"
#include <Eigen/LU>
#include <array>
#include <cmath>

namespace mill::bite {
namespace {
Eigen::VectorXd interpolated(const Eigen::VectorXd &from, const Eigen::VectorXd &value, const Eigen::VectorXd &to)
{
  Eigen::VectorXd y = Eigen::VectorXd::Zero(to.size());
  for (Eigen::Index i = 0; i < to.size(); ++i) {
    const Eigen::Index c = std::upper_bound(from.data(), from.data() + from.size(), to[i]) - from.data();
    if (c > 0 && c < from.size())
      y[i] = value[c - 1] + (value[c] - value[c - 1]) * (to[i] - from[c - 1]) / (from[c] - from[c - 1]);
  }
  return y;
}

ArcEnds ends_of(const ArcResponse<double> &r)
{
  return {r.first, r.last, r.exit, r.entry, r.neutral};
}

/// Solution on evenly spread points, only to learn where the contact is.
ArcEnds first_look(const RollBite &bite, const ArcFlexibility *given, Unknowns &u, Eigen::VectorXd &x,
                   const double stress)
{
  const double length = std::sqrt(bite.roll_radius * (bite.strip.entry_thickness - bite.strip.exit_thickness));
  for (const double window : {1.0, 1.7, 3.0, 5.0}) {
    double first = -0.8 * window * length, last = 2.4 * window * length;
    if (given && given->position.size() > 1) {
      first = std::max(first, given->position[0]);
      last  = std::min(last, given->position[given->position.size() - 1]);
    }
    x = Eigen::VectorXd::LinSpaced(120, first, last);
    try {
      const ArcProblem problem(bite, x, given);
      solve_on(problem, u, false, stress, 1e-7);
      return ends_of(problem.response(u, 1));
    } catch (const SolverError &) {
      if (window == 5.0)
        throw;
    }
  }
  throw SolverError({"roll bite: no contact found", "", "", "", ""});  // not reached
}

void check_elastic_strip(const RollBite &bite)
{
  const Strip &s = bite.strip;
  if (!std::isfinite(s.youngs_modulus) || !(s.youngs_modulus > 0) || !(std::abs(s.poisson_ratio) < 1))
    throw InputError(sentence(
        "the elastic arc needs the strip's elastic zones, but strip.youngs_modulus = ", s.youngs_modulus / 1e9,
        " GPa: without them the pressure ends in a step, under which the surface of the roll has an "
        "infinite slope, and no grid converges. Give the modulus of the strip, or take "
        "Hitchcock's arc"));
}

/// dF/dh_exit with the shape following, per width.  The pressure has kinks at the ends of the zones, and between
/// two points their motion would be seen in steps: the points therefore ride with them.  What that motion
/// contributes is a central difference of the residual alone, a thousandth of a cell to either side; its size is
/// that of the grid's error. (17.16)
double following_slope_of(const ArcProblem &problem, const Unknowns &u, const ArcProblem::Tangent &t,
                          const ArcFlexibility *given)
{
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu(problem.matrix(t));
  const Eigen::VectorXd by_exit = t.by_inputs.col(static_cast<int>(Input::exit_thickness));
  const RollBite &bite          = problem.bite_;
  const double draft            = bite.strip.entry_thickness - bite.strip.exit_thickness;
  Eigen::VectorXd velocity      = Eigen::VectorXd::Zero(problem.n);  // of the points per change of h_exit
  const double cell             = (problem.x.tail(problem.n - 1) - problem.x.head(problem.n - 1)).minCoeff();
  double slope                  = 0;
  for (int pass = 0; pass < 4; ++pass) {
    const double fastest = velocity.cwiseAbs().maxCoeff();
    const double step    = fastest > 0 ? std::min(1e-5 * draft, 1e-3 * cell / fastest) : 1e-6 * draft;
    const ArcProblem ahead(bite, problem.x + step * velocity, given),
        behind(bite, problem.x - step * velocity, given);
    Eigen::VectorXd by_points = Eigen::VectorXd::Zero(problem.n + 1);
    if (fastest > 0) {
      const Unknowns a = ahead.answer(u, 1), b = behind.answer(u, 1);
      by_points << (a.pressure - b.pressure) / (2 * step), (a.mu - b.mu) / (2 * step);
    }
    const Eigen::VectorXd d = lu.solve(by_exit + by_points);
    slope = problem.weight.dot(d.head(problem.n)) + (ahead.weight - behind.weight).dot(u.pressure) / (2 * step);
    // Velocities of the ends, and of the points between them.
    const auto ends = [&](const ArcProblem &points, const double by) {
      RollBite moved = bite;
      moved.strip.exit_thickness += by;
      return ends_of(
          points.response_of(moved, {u.pressure + by * d.head(problem.n), u.mu + by * d[problem.n]}, 1));
    };
    const ArcEnds a = ends(ahead, step), b = ends(behind, -step), here = ends_of(problem.response(u, 1));
    const std::array<double, 5> knots{here.first, here.exit, here.neutral, here.entry, here.last};
    const std::array<double, 5> speed{(a.first - b.first) / (2 * step), (a.exit - b.exit) / (2 * step),
                                      (a.neutral - b.neutral) / (2 * step), (a.entry - b.entry) / (2 * step),
                                      (a.last - b.last) / (2 * step)};
    for (Eigen::Index i = 0; i < problem.n; ++i) {
      const double x = std::clamp(problem.x[i], knots.front(), knots.back());
      const std::size_t c =
          std::clamp<std::size_t>(std::upper_bound(knots.begin(), knots.end(), x) - knots.begin(), 1, 4);
      velocity[i] = speed[c - 1] + (speed[c] - speed[c - 1]) * (x - knots[c - 1]) / (knots[c] - knots[c - 1]);
    }
  }
  return slope;
}

void fill_state(const ArcProblem &problem, const ArcFlexibility *given, const Unknowns &u,
                const KarmanOptions &options, BiteState &state)
{
  const RollBite &bite = problem.bite_;
  const Strip &strip   = bite.strip;
  const auto r         = problem.response(u, 1);
  const double width   = strip.width;
  const bool factor    = !slides(strip.friction);
  state.force          = width * problem.weight.dot(u.pressure);
  state.torque         = width * r.torque;
  state.friction       = friction_value(strip.friction, u.mu);
  state.arc_length     = r.entry;
  state.exit_position  = r.exit;
  state.contact_length = r.last - r.first;
  state.flattened_radius =
      (r.entry - r.exit) * (r.entry - r.exit) / (strip.entry_thickness - strip.exit_thickness);
  state.bite_angle        = (r.entry - r.exit) / state.flattened_radius;
  state.neutral_position  = r.neutral;
  state.neutral_thickness = r.neutral_thickness;
  state.sticking_length   = r.sticking_length;
  state.entry_speed       = bite.roll_speed * r.neutral_thickness / strip.entry_thickness;
  state.exit_speed        = bite.roll_speed * r.neutral_thickness / strip.exit_thickness;
  state.forward_slip      = r.neutral_thickness / strip.exit_thickness - 1;
  state.peak_pressure     = std::max(r.neutral_pressure, u.pressure.maxCoeff());
  state.entry_flow_stress = r.entry_yield;
  state.exit_flow_stress  = r.exit_yield;
  state.largest_shear     = r.largest_shear;
  if (has_film(strip.friction)) {
    const auto plain     = arc_strip<double>(bite, u.mu, [](const double v, Input) { return v; });
    state.film_thickness = film_thickness(strip.friction, inlet_of<double>(plain, r, bite.roll_speed));
  }
  state.force_by.fill(not_given);
  state.torque_by.fill(not_given);
  if (options.derivatives) {
    const auto t = problem.tangent(u, 1, true);
    // Shape held; the friction follows its law.
    const double feedback          = 1 - t.by_mu[problem.n];
    const Eigen::RowVectorXd mu_by = t.by_inputs.row(problem.n) / feedback;
    const Eigen::MatrixXd pressure_by =
        t.by_inputs.topRows(problem.n) +
        t.by_mu.head(problem.n) * (factor ? Eigen::RowVectorXd::Zero(n_arc_directions).eval() : mu_by);
    for (int i = 0; i < n_arc_directions; ++i) {
      state.force_by[i]  = width * problem.weight.dot(pressure_by.col(i));
      state.torque_by[i] = width * (t.torque_by_inputs[i] + (factor ? 0 : t.torque_by_mu * mu_by[i]));
    }
    if (!std::isfinite(bite.roll_speed))
      state.force_by[int(Input::roll_speed)] = state.torque_by[int(Input::roll_speed)] = not_given;
    state.force_by_exit_following = width * following_slope_of(problem, u, t, given);
  }
  if (options.points <= 0)
    return;
  // Points in contact, with the neutral point among them.
  std::vector<std::array<double, 4>> curve;
  const auto g = problem.shape(u, 1);
  bool neutral = false;
  for (Eigen::Index i = 0; i < problem.n; ++i) {
    if (!(u.pressure[i] > 0))
      continue;
    if (!neutral && problem.x[i] > r.neutral) {
      curve.push_back({r.neutral, r.neutral_thickness, r.neutral_pressure, 0});
      neutral = true;
    }
    if (problem.x[i] != r.neutral)
      curve.push_back({problem.x[i], strip.exit_thickness + g.value[i] - r.smallest, u.pressure[i], r.shear[i]});
  }
  const auto size = static_cast<Eigen::Index>(curve.size());
  state.position.resize(size);
  state.thickness = state.pressure = state.shear = state.slip = state.position;
  for (Eigen::Index i = 0; i < size; ++i) {
    state.position[i]  = curve[i][0];
    state.thickness[i] = curve[i][1];
    state.pressure[i]  = curve[i][2];
    state.shear[i]     = curve[i][3];
    state.slip[i]      = r.neutral_thickness / curve[i][1] - 1;
  }
}

/// @throws SolverError, InputError  as solve_elastic_arc, which checks the bite first
BiteState solve_checked(const RollBite &bite, const ArcFlexibility *flexibility, const KarmanOptions &options)
{
  const Friction &law = bite.strip.friction;
  Unknowns u;
  if (slides(law))  // for a film a start, found by Newton with the pressures
    u.mu = follows_bite(law) ? 0.05 : coulomb_coefficient(law, Inlet<double>{bite.roll_speed, 0, 0, 1, 1, 1});
  const double reference =
      std::isfinite(bite.strip.initial_thickness) ? bite.strip.initial_thickness : bite.strip.entry_thickness;
  const double stress = flow_stress(bite.strip.flow_stress, std::log(reference / bite.strip.exit_thickness));
  Eigen::VectorXd x;
  ArcEnds ends = first_look(bite, flexibility, u, x, stress);
  BiteState state;
  // Points where the contact was, then where it is on these.
  for (const int n : {std::min(150, options.arc_points), options.arc_points}) {
    const Eigen::VectorXd graded = graded_arc(ends, n);
    if (graded.size() > 3 * n + 100)
      throw SolverError({"roll bite: the elastic zone at the entry is too short to be resolved",
                         sentence("it is ", (ends.last - ends.entry) * 1e3, " mm of a contact of ",
                                  (ends.last - ends.first) * 1e3, " mm"),
                         "a strip that is nearly rigid where it is elastic", "the strip's true elastic modulus",
                         ""});
    u.pressure = interpolated(x, u.pressure, graded);
    x          = graded;
    const ArcProblem problem(bite, x, flexibility);
    state.iterations += solve_on(problem, u, true, stress, options.tolerance);
    const auto r = problem.response(u, 1);
    ends         = ends_of(r);
    if (n == options.arc_points) {
      if (r.skids)
        refuse_skidding(bite, Theory::karman,
                        (r.entry - r.exit) * (r.entry - r.exit) /
                            (bite.strip.entry_thickness - bite.strip.exit_thickness),
                        u.mu, options);
      if (!r.monotone)
        throw SolverError({"roll bite: the elastic arc opens and closes between entry and exit",
                           sentence("force ", problem.weight.dot(u.pressure) * bite.strip.width / 1e3, " kN"),
                           "foil: a zone without slip forms, in which mu p is not the friction",
                           "a thicker strip, a smaller work roll or more tension", ""});
      fill_state(problem, flexibility, u, options, state);
    }
  }
  return state;
}
}  // namespace

BiteState solve_elastic_arc(const RollBite &bite, const ArcFlexibility *flexibility, const KarmanOptions &options)
{
  check_slices(bite);
  check_elastic_strip(bite);
  try {
    return solve_checked(bite, flexibility, options);
  } catch (const SolverError &) {
    // A bite that cannot roll does not converge either, and says so less well.
    const Friction &law = bite.strip.friction;
    if (follows_bite(law))
      throw;
    const double mu = slides(law) ? coulomb_coefficient(law, Inlet<double>{bite.roll_speed, 0, 0, 1, 1, 1}) : 0;
    KarmanOptions quick = options;
    quick.derivatives   = false;
    quick.points        = 0;
    if (solve_on_circle(bite, Theory::karman, bite.roll_radius, mu, quick).skids)
      refuse_skidding(bite, Theory::karman, bite.roll_radius, mu, quick);
    throw;
  }
}
}  // namespace mill::bite
