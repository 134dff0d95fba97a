#include "reduce/bite/slab/flattening.h"
#include "core/base/errors.h"
#include "reduce/bite/sentence.h"
#include <algorithm>
#include <cmath>

namespace mill::bite {
namespace {
constexpr double hitchcock_range    = 5;     // R'/R up to which the formula is used in practice
constexpr double largest_flattening = 20;    // R'/R; Hitchcock's ellipse has lost its meaning long before
constexpr int most_evaluations      = 2000;  // plain iteration next to a double root takes hundreds

double reduction(const RollBite &bite)
{
  return bite.strip.entry_thickness - bite.strip.exit_thickness;
}
}  // namespace

double flattening_compliance(const RollBite &bite)
{
  const Material &m = bite.roll;
  return 16 * (1 - m.poisson_ratio * m.poisson_ratio) / (M_PI * m.youngs_modulus * bite.strip.width);
}

double hitchcock_radius(const RollBite &bite, const double force)
{
  return bite.roll_radius * (1 + flattening_compliance(bite) * force / reduction(bite));
}

bool beyond_hitchcock(const RollBite &bite, const double radius)
{
  return radius > hitchcock_range * bite.roll_radius;
}

Warning beyond_hitchcock_note(const RollBite &bite, const double radius)
{
  return {WarningId::bite_flattening, "",
          sentence("R'/R = ", radius / bite.roll_radius, " is beyond ", hitchcock_range,
                   ", where Hitchcock's circular arc no longer holds")};
}

FlattenedArc flattened_arc(const RollBite &bite, const std::function<double(double)> &force_of_radius)
{
  const double limit = largest_flattening * bite.roll_radius;
  FlattenedArc arc;
  // A point below the root: s = sqrt(R'), gap = Phi/s - s > 0 there.
  struct Point {
    double s, gap, next_radius;
  };
  const auto value_at = [&](const double s) {
    ++arc.evaluations;
    arc.radius        = s * s;
    arc.force         = force_of_radius(arc.radius);
    const double next = hitchcock_radius(bite, arc.force);
    return Point{s, next / s - s, next};
  };
  Point last = value_at(std::sqrt(bite.roll_radius)), before = last;
  double slope = -INFINITY;  // of the last chord; it must rise as long as the function is convex
  bool chords  = true;
  while (arc.evaluations < most_evaluations) {
    if (!(last.next_radius <= limit))
      break;
    if (last.gap <= 4e-16 * last.s)
      return arc;
    double s = std::sqrt(last.next_radius);
    if (chords && before.s < last.s) {
      const double chord = (last.gap - before.gap) / (last.s - before.s);
      if (!(chord >= slope - 1e-6 * std::abs(slope)))
        chords = false;
      slope = chord;
      // A chord that rises has passed the lowest gap: no root follows, and plain steps must say so.
      if (chords && chord < 0)
        s = std::max(s, last.s - last.gap / chord);
    }
    if (!(s * s < limit))
      s = std::sqrt(last.next_radius);
    if (s <= last.s)
      return arc;  // at rest to the last digit
    const Point trial = value_at(s);
    if (trial.gap < 0) {
      if (trial.gap >= -1e-14 * s)
        return arc;
      chords              = false;
      const Point careful = value_at(std::sqrt(last.next_radius));  // cannot pass the root
      before              = last;
      last                = careful;
      continue;
    }
    const bool rests = std::abs(trial.s - last.s) <= 1e-15 * trial.s;
    before           = last;
    last             = trial;
    if (rests)
      return arc;
  }
  throw NoFlattenedRadius(
      {"roll bite: no flattened radius",
       sentence("R'/R = ", arc.radius / bite.roll_radius, " and still growing after ", arc.evaluations,
                " steps, force there ", arc.force / 1e3, " kN"),
       sentence("the strip is too thin or too hard for this roll: the arc flattens faster than the gap closes "
                "(entry thickness ",
                bite.strip.entry_thickness * 1e3, " mm, exit thickness ", bite.strip.exit_thickness * 1e3, " mm)"),
       "a smaller work roll, less friction, more tension, or a thicker strip.exit_thickness", ""});
}

double following_slope(const RollBite &bite, const double force, const double by_exit, const double by_radius)
{
  // (8.11): R' = Phi(R', h) differentiated along the flattened states
  const double c = bite.roll_radius * flattening_compliance(bite) / reduction(bite);
  return by_exit + by_radius * c * (by_exit + force / reduction(bite)) / (1 - c * by_radius);
}
}  // namespace mill::bite
