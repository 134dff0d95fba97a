#include "reduce/bite/slab/karman_arc.h"
#include "core/base/errors.h"
#include "core/numerics/root_search.h"
#include "reduce/bite/sentence.h"
#include "reduce/bite/slab/karman_path.h"
#include "reduce/bite/slab/slab_checks.h"
#include <algorithm>
#include <cmath>
#include <optional>

namespace mill::bite {
namespace {
constexpr int n_slopes = 7;

/// An input as the number it is, or with its direction.
template <class T> T input(const double value, const Input which, const double slope = 1)
{
  if constexpr (std::is_same_v<T, double>) {
    (void)which;
    (void)slope;
    return value;
  } else
    return T::variable(value, static_cast<int>(which), slope);
}

std::vector<FlowPiece> flow_pieces(const FlowStress &law, const double reference, const double h1, const double h2,
                                   const double radius, const bool small_angles)
{
  const auto coordinate = [&](const double h) {
    return std::sqrt((h - h2) * (small_angles ? radius : 0.25 / radius));
  };
  std::vector<FlowPiece> pieces;
  for (const SmoothFlowStress &smooth : smooth_pieces_of(law, std::log(reference / h2), std::log(reference / h1)))
    pieces.push_back({coordinate(std::max(h2, reference * std::exp(-smooth.from))), smooth.law});
  pieces.front().from = 0;
  return pieces;
}

template <class T>
SliceInputs<T> slice_inputs(const RollBite &bite, const Theory theory, const double radius, const double mu,
                            const KarmanOptions &options)
{
  const Strip &strip       = bite.strip;
  const Friction &friction = strip.friction;
  SliceInputs<T> in;
  in.entry_thickness  = input<T>(strip.entry_thickness, Input::entry_thickness);
  in.exit_thickness   = input<T>(strip.exit_thickness, Input::exit_thickness);
  in.strain_reference = std::isfinite(strip.initial_thickness) ? T(strip.initial_thickness) : in.entry_thickness;
  in.entry_tension    = input<T>(strip.entry_tension, Input::entry_tension);
  in.exit_tension     = input<T>(strip.exit_tension, Input::exit_tension);
  in.flow_factor      = input<T>(1.0, Input::flow_stress);
  in.radius           = input<T>(radius, Input::arc_radius);
  in.arm              = bite.roll_radius;
  in.wedge            = theory == Theory::orowan;
  in.small_angles     = options.small_angles;
  // Both factors grow alike per unit of mu: mu p is the friction stress at a mean pressure of k/2 over mu.
  in.friction = traction_of(friction, input<T>(slides(friction) ? mu : 0.0, Input::friction));
  in.pieces   = flow_pieces(strip.flow_stress, value_of(in.strain_reference), strip.entry_thickness,
                            strip.exit_thickness, radius, options.small_angles);
  return in;
}

/// Coordinate of the entry, (17.5).
template <class T> T entry_coordinate(const SliceInputs<T> &in)
{
  using std::sqrt;
  const T draft = in.entry_thickness - in.exit_thickness;
  return in.small_angles ? sqrt(draft * in.radius) : sqrt(draft / (4.0 * in.radius));
}

/// Both branches of one bite.
struct Hill {
  SliceInputs<double> in;
  double t_entry;
  BranchPath exit, entry;
  Hill(SliceInputs<double> inputs, const double tolerance)
      : in(std::move(inputs)), t_entry(entry_coordinate(in)),
        exit(in, -1, 0.0, -in.exit_tension * in.exit_thickness, t_entry, tolerance),
        entry(in, +1, t_entry, -in.entry_tension * in.entry_thickness, 0.0, tolerance)
  {
  }
  Hill(const Hill &) = delete;  // the branches refer to the inputs

  /// Exit branch minus entry branch of the horizontal force, rising in t, and its slope.
  double gap(const double t, double &slope)
  {
    const double f_exit = exit.at(t)[0], f_entry = entry.at(t)[0];
    const Slice<double> d = exit.slice_at(t, f_exit), e = entry.slice_at(t, f_entry);
    slope = (d.pressure - e.pressure) * d.by_pressure + (d.shear + e.shear) * d.by_shear;
    return f_exit - f_entry;
  }
};

struct Meeting {
  double t;  ///< -, coordinate; the nearer end of the arc if there is none inside
  bool inside;
};

/// Where the branches meet.  Newton, kept inside what is known.
Meeting meeting(Hill &hill, const double tolerance, const double share = 0.35)
{
  double low = 0, high = hill.t_entry, t = share * hill.t_entry;
  bool at_low = false, at_high = false;
  const double small = tolerance * hill.t_entry;
  for (int i = 0; i < 80; ++i) {
    double slope     = 0;
    const double gap = hill.gap(t, slope);
    if ((t <= 0 && gap > 0) || (t >= hill.t_entry && gap < 0))
      return {t, false};  // even at that end the strip is on the same side of the rolls' speed
    (gap > 0 ? high : low)       = t;
    (gap > 0 ? at_high : at_low) = true;
    double next                  = t - gap / slope;
    if (!(slope > 0) || !(next > low) || !(next < high)) {
      if (slope > 0 && next >= high && !at_high)
        next = hill.t_entry;
      else if (slope > 0 && next <= low && !at_low)
        next = 0;
      else
        next = 0.5 * (low + high);
    }
    if (std::abs(next - t) <= small)
      break;
    t = next;
  }
  return {t, true};
}

/// Smallest friction, as a multiple of the given one, with which there is a neutral point; nothing up to 1000.
std::optional<double> least_friction(const RollBite &bite, const Theory theory, const double radius,
                                     const double mu, KarmanOptions options)
{
  const auto there = [&](const double multiple) {
    RollBite more = bite;
    more.strip.friction.entry_factor *= multiple;
    more.strip.friction.exit_factor *= multiple;
    Hill hill(slice_inputs<double>(more, theory, radius, mu * multiple, options), 1e-6);
    return meeting(hill, 1e-6).inside;
  };
  double low = 1, high = 1.25;
  while (!there(high)) {
    low = high;
    high *= 1.25;
    if (high > 1000)
      return std::nullopt;
  }
  return border_between(high, low, there, 1e-4).holds;
}

/// Pressures and shear at n places of one side, by Runge-Kutta's fourth order from one to the next: no more than
/// the eye needs (1e-8), and starting afresh at every node of the accurate integration.
void sample(BranchPath &path, const SliceInputs<double> &in, const int side, const Eigen::VectorXd &t,
            const Eigen::Index first, CircularBite &out)
{
  SliceEquation<double> equation(in, side);
  std::size_t node = 0;
  double place     = path.nodes()[0].t;
  double f         = path.nodes()[0].y[0];
  const auto slope = [&](const double x, const double y) { return equation(x, {y, 0, 0})[0]; };
  for (Eigen::Index j = 0; j < t.size(); ++j) {
    const Eigen::Index i = side < 0 ? j : t.size() - 1 - j;  // away from the edge
    const auto &nodes    = path.nodes();
    while (node + 1 < nodes.size() && (side > 0 ? nodes[node + 1].t >= t[i] : nodes[node + 1].t <= t[i])) {
      ++node;
      place = nodes[node].t;
      f     = nodes[node].y[0];
    }
    equation.piece    = nodes[node].piece;
    equation.at_limit = nodes[node].at_limit;
    const double h    = t[i] - place;
    if (h != 0) {
      const double a = slope(place, f), b = slope(place + h / 2, f + h / 2 * a),
                   c = slope(place + h / 2, f + h / 2 * b);
      f += h / 6 * (a + 2 * b + 2 * c + slope(t[i], f + h * c));
      place = t[i];
    }
    const Slice<double> s    = equation.slice(t[i], f);
    out.thickness[first + i] = s.thickness;
    out.pressure[first + i]  = s.pressure;
    out.shear[first + i]     = side * s.shear;
  }
}

double along(const SliceInputs<double> &in, const double t)
{
  return in.small_angles ? t : 2 * in.radius * t * std::sqrt(1 - t * t);  // R sin(phi)
}

void sample_arc(Hill &hill, const double t_n, const int points, CircularBite &out)
{
  const int n_exit  = std::max(2, static_cast<int>(std::lround(points * t_n / hill.t_entry)));
  const int n_entry = std::max(2, points - n_exit);
  out.position.resize(n_exit + n_entry - 1);
  out.thickness = out.pressure = out.shear = out.slip = out.position;
  const Eigen::VectorXd t_exit                        = Eigen::VectorXd::LinSpaced(n_exit, 0, t_n);
  const Eigen::VectorXd t_entry                       = Eigen::VectorXd::LinSpaced(n_entry, t_n, hill.t_entry);
  sample(hill.exit, hill.in, -1, t_exit, 0, out);
  sample(hill.entry, hill.in, +1, t_entry, n_exit - 1, out);
  out.shear[n_exit - 1] = 0;  // neither way
  const auto cosine     = [&](const double t) { return hill.in.small_angles ? 1.0 : 1 - 2 * t * t; };
  const double h_n      = out.thickness[n_exit - 1] * cosine(t_n);
  for (Eigen::Index i = 0; i < out.position.size(); ++i) {
    const double t  = i < n_exit ? t_exit[i] : t_entry[i - n_exit + 1];
    out.position[i] = along(hill.in, t);
    out.slip[i]     = h_n / (out.thickness[i] * cosine(t)) - 1;
  }
}

// Pressure at the steps of one branch up to the neutral point, Pa.
double least_pressure(BranchPath &path, const double t_n)
{
  double least    = INFINITY;
  const bool down = path.nodes().front().t > t_n;
  for (const PathNode &node : path.nodes())
    if (down ? node.t >= t_n : node.t <= t_n)
      least = std::min(least, path.slice_at(node.t, node.y[0]).pressure);
  return least;
}

double limited_length(const BranchPath &path, const SliceInputs<double> &in, const double end)
{
  double length     = 0;
  const auto &nodes = path.nodes();
  const bool down   = nodes.front().t > end;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!(nodes[i].at_limit || !in.friction.slides))
      continue;
    const double a = nodes[i].t, b = i + 1 < nodes.size() ? nodes[i + 1].t : end;
    const double x = down ? std::max(a, end) : std::min(a, end), y = down ? std::max(b, end) : std::min(b, end);
    length += std::abs(along(in, x) - along(in, y));
  }
  return length;
}
}  // namespace

void refuse_skidding(const RollBite &bite, const Theory theory, const double radius, const double mu,
                     const KarmanOptions &options)
{
  const Friction &law = bite.strip.friction;
  const bool factor   = !slides(law);
  const double given  = friction_value(law, mu);
  const double draft  = bite.strip.entry_thickness - bite.strip.exit_thickness;
  const double angle =
      options.small_angles ? std::sqrt(draft / radius) : 2 * std::asin(std::sqrt(draft / (4 * radius)));
  const std::string words = factor ? sentence("a mean friction factor of ", given) : friction_in_words(law, given);
  Hill hill(slice_inputs<double>(bite, theory, radius, mu, options), 1e-6);
  const bool beyond_exit = meeting(hill, 1e-6).t < 0.5 * hill.t_entry;
  const auto multiple    = given > 0 ? least_friction(bite, theory, radius, mu, options) : std::nullopt;
  if (multiple)
    refuse_neutral_point(words, angle, *multiple * given, beyond_exit);
  throw InputError(sentence(words, " is too small for an angle of bite of ", angle,
                            " rad, and no friction up to its limit is enough: the neutral point "
                            "would lie ",
                            beyond_exit ? "beyond the exit" : "before the entry",
                            "; a smaller reduction or another balance of the tensions is needed"));
}

void check_slices(const RollBite &bite)
{
  check_pass(bite);
  check_friction(bite);
  if (bite.gap_rate != 0)
    throw InputError(
        sentence("the gap opens at ", bite.gap_rate,
                 " m/s: the integrated slab theories take it as resting; bland_ford and hu_ehmann know "
                 "a moving gap"));
  const double limit = bite.strip.friction.shear_limit;
  if (limit <= 0 || limit > 1)
    throw InputError(sentence("strip.friction.shear_limit = ", limit,
                              " must be above 0 and at most 1, the shear yield stress of the strip"));
}

CircularBite solve_on_circle(const RollBite &bite, const Theory theory, const double radius, const double mu,
                             const KarmanOptions &options, const double share)
{
  Hill hill(slice_inputs<double>(bite, theory, radius, mu, options), options.tolerance);
  const SliceInputs<double> &in = hill.in;
  // Newton's gap is in rounding long before: the meeting place to a tenth of the tolerance of the force.
  const Meeting neutral       = meeting(hill, std::max(1e-14, 0.1 * options.tolerance), share);
  const double t_n            = neutral.t;
  const Branch<double> y_exit = hill.exit.at(t_n), y_entry = hill.entry.at(t_n);
  const Slice<double> d = hill.exit.slice_at(t_n, y_exit[0]), e = hill.entry.slice_at(t_n, y_entry[0]);

  CircularBite out;
  out.skids         = !neutral.inside;
  out.neutral_share = std::clamp(t_n / hill.t_entry, 0.01, 0.99);
  Slope t(t_n);
  const auto finish = [&](const auto &inputs) {
    using T         = std::decay_t<decltype(inputs.radius)>;
    const T t_entry = entry_coordinate(inputs);
    if constexpr (!std::is_same_v<T, double>) {
      const Branch<T> exit =
          repeat<T>(hill.exit, inputs, -1, T(0.0), T(-inputs.exit_tension * inputs.exit_thickness), t_n);
      const Branch<T> entry =
          repeat<T>(hill.entry, inputs, +1, t_entry, T(-inputs.entry_tension * inputs.entry_thickness), t_n);
      // The branches were repeated up to a fixed place; they meet at one that moves with the inputs.
      const double slope       = (d.pressure - e.pressure) * d.by_pressure + (d.shear + e.shear) * d.by_shear;
      out.force                = exit[1] - entry[1];
      out.torque               = exit[2] - entry[2];
      const double force_step  = 0.5 * ((d.pressure - e.pressure) * d.by_shear -
                                       (in.small_angles ? 0 : (d.shear + e.shear) * d.by_pressure));
      const double torque_step = -(d.shear + e.shear) * d.torque_by_shear;
      for (int i = 0; i < n_slopes; ++i) {
        if (out.skids)
          break;  // it stays at the end of the arc
        t.by[i] = -(exit[0].by[i] - entry[0].by[i]) / slope;
        out.force.by[i] += force_step * t.by[i];
        out.torque.by[i] += torque_step * t.by[i];
      }
    } else {
      out.force  = y_exit[1] - y_entry[1];
      out.torque = y_exit[2] - y_entry[2];
    }
    const Slope t2        = t * t;
    out.neutral_thickness = in.small_angles ? Slope(inputs.exit_thickness + t2 / inputs.radius)
                                            : Slope(inputs.exit_thickness + 4.0 * Slope(inputs.radius) * t2);
    out.neutral_cosine    = in.small_angles ? Slope(1.0) : 1.0 - 2.0 * t2;
    out.arc_length        = in.small_angles ? Slope(t_entry)
                                            : 2.0 * Slope(inputs.radius) * Slope(t_entry) *
                                           sqrt(1.0 - Slope(t_entry) * Slope(t_entry));
    SliceEquation<T> equation(inputs, 1);
    equation.piece        = inputs.pieces.size() - 1;
    out.entry_flow_stress = Slope(equation.yield(inputs.entry_thickness));
    equation.piece        = 0;
    out.exit_flow_stress  = Slope(equation.yield(inputs.exit_thickness));
  };
  if (options.derivatives)
    finish(slice_inputs<Slope>(bite, theory, radius, mu, options));
  else
    finish(in);

  out.neutral_position = along(in, t_n);
  out.peak_pressure    = std::max(d.pressure, e.pressure);
  out.sticking_length  = limited_length(hill.exit, in, t_n) + limited_length(hill.entry, in, t_n);
  out.least_pressure   = std::min(least_pressure(hill.exit, t_n), least_pressure(hill.entry, t_n));
  const double limit   = 0.5 * d.yield;
  out.largest_shear    = in.friction.slides ? mu * out.peak_pressure / limit
                                            : std::max(in.friction.entry_factor, in.friction.exit_factor);
  if (options.points > 0) {
    sample_arc(hill, t_n, options.points, out);
    out.peak_pressure = std::max(out.peak_pressure, out.pressure.maxCoeff());
  }
  out.steps = hill.exit.attempts() + hill.entry.attempts();
  return out;
}

IdleDrawing draw_through_idle_rolls(const RollBite &bite, const KarmanOptions &options)
{
  RollBite idle           = bite;
  idle.strip.exit_tension = 0;
  idle.strip.friction     = {};
  check_pass(idle);
  const SliceInputs<double> in = slice_inputs<double>(idle, Theory::karman, bite.roll_radius, 0, options);
  const double t_entry         = entry_coordinate(in);
  BranchPath path(in, 1, t_entry, -in.entry_tension * in.entry_thickness, 0, options.tolerance);
  const Branch<double> y = path.at(0);
  const double tension   = -y[0] / in.exit_thickness;
  const double yield     = path.slice_at(0, y[0]).yield;
  if (!(tension < yield))
    throw InputError(sentence("drawing through idle rolls takes ", tension / 1e6,
                              " MPa, and the flow stress of the strip at the exit is ", yield / 1e6,
                              " MPa: it would tear; give less reduction or back tension"));
  return {tension, -y[1] * bite.strip.width};
}
}  // namespace mill::bite
