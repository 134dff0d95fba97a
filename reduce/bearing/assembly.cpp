#include "reduce/bearing/assembly.h"
#include "reduce/bearing/bearing_stiffness.h"
#include "reduce/bearing/clearance.h"
#include "reduce/bearing/geometry.h"
#include "reduce/bearing/roller_set.h"
#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

namespace mill::bearing {
namespace {
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int step_limit = 200;

/// Unknowns: motion of the inner ring and the loads that bend the rings; and what follows from them.
struct Point {
  Vector5 motion = Vector5::Zero();
  VectorXd bending_load;  ///< (rows Z ring modes) N, equal to the roller loads in equilibrium
  VectorXd ring_motion;   ///< (rows Z ring modes) m, flexibility * bending_load
  RollerForces rollers;
  Vector5 force;       ///< N, N m, of the rollers, against which the load stands
  VectorXd imbalance;  ///< (rows Z ring modes) N, roller loads - bending_load
};

std::string stood_at(const Point &point, const double residual, const std::string &also)
{
  std::ostringstream text;
  const int loaded = int(std::count(point.rollers.on_raceway.begin(), point.rollers.on_raceway.end(), char(1)));
  text << "inner ring at x " << point.motion[0] * 1e6 << ", y " << point.motion[1] * 1e6 << ", z "
       << point.motion[2] * 1e6 << " um, tilt " << point.motion[3] * 1e3 << " and " << point.motion[4] * 1e3
       << " mrad, " << loaded << " rollers loaded, out of balance by " << residual << " of the load" << also;
  return text.str();
}
}  // namespace

struct BearingAssembly::Implementation {
  BearingModel model;
  double radius;   // m, of the pitch circle: lever that turns rotations into metres
  int modes;       // along the line: at least the two that a motion of the ring needs
  int ring_modes;  // of which the rings know
  RollerSet rollers;
  RollerPlaces places;
  MatrixXd flexibility;  // S, (rows Z ring modes)^2 m/N; empty: rigid rings
  VectorXd offset;       // (rows) m
  std::optional<Point> last;

  explicit Implementation(BearingModel m)
      : model(std::move(m)), radius(pitch_diameter(model.bearing) / 2),
        modes(std::max(2, model.rings.rows ? model.rings.modes : 0)),
        ring_modes(model.rings.rows ? model.rings.modes : 0),
        rollers(model.roller, model.bearing.roller_length, modes,
                least_cup_load(model.bearing, model.centrifugal_force))
  {
    require_closed_apex(model.bearing);
    if (model.rings.rows && model.rings.rows != model.bearing.rows)
      throw InputError("bearing." + model.bearing.name + ": flexibility of " + std::to_string(model.rings.rows) +
                       " rows for a bearing of " + std::to_string(model.bearing.rows));
    place();
    seat();
  }

  void place()
  {
    places = roller_places(model.bearing, model.cage_angle, modes);
    if (ring_modes)
      flexibility = flexibility_at(model.rings, places.azimuth);
  }

  // Offsets of the rows.  With preload rings deflect too: the rows are set until each carries it in the
  // concentric position, by Newton's method on the offsets.
  void seat()
  {
    offset               = VectorXd::Constant(places.rows, approach_offset(model.bearing, model.roller));
    const double preload = preloaded_roller(model.bearing);
    if (!(preload > 0) || !ring_modes)
      return;
    MatrixXd row = MatrixXd::Zero(count() * modes, places.rows);  // even approach of all rollers of a row
    for (Index j = 0; j < count(); ++j)
      row(j * modes, j / places.rollers) = 1;
    const VectorXd wanted = VectorXd::Constant(places.rows, preload * places.rollers);
    RingLoading rest;
    rest.prescribed = {true, true, true, true, true};
    Point point     = at_motion(Vector5::Zero());
    for (int i = 0; i < 50; ++i) {
      int iterations          = 0;
      point                   = equilibrium(rest, point, iterations);
      const VectorXd short_of = wanted - row.transpose() * point.rollers.load;
      if (short_of.cwiseAbs().maxCoeff() <= 1e-11 * wanted[0])
        return;
      offset += stiffness(point, row).tangent.ldlt().solve(short_of);
      evaluate(point, nullptr);
    }
    throw no_equilibrium(rest, point, "the offsets of the rows that give the preload were not found");
  }

  Index count() const
  {
    return Index(places.rows) * places.rollers;
  }

  // ---- one point
  void evaluate(Point &evaluated, const RollerForces *start) const
  {
    VectorXd approach = places.press * evaluated.motion;
    if (ring_modes)
      evaluated.ring_motion = flexibility * evaluated.bending_load;
    for (Index j = 0; j < count(); ++j) {
      approach[j * modes] += offset[j / places.rollers];
      if (ring_modes)
        approach.segment(j * modes, ring_modes) -= evaluated.ring_motion.segment(j * ring_modes, ring_modes);
    }
    evaluated.rollers   = rollers.forces(approach, start);
    evaluated.force     = places.press.transpose() * evaluated.rollers.load;
    evaluated.imbalance = ring_loads(evaluated.rollers.load) - evaluated.bending_load;
  }

  VectorXd ring_loads(const VectorXd &load) const
  {
    VectorXd out(ring_modes ? count() * ring_modes : 0);
    for (Index j = 0; j < count() && ring_modes; ++j)
      out.segment(j * ring_modes, ring_modes) = load.segment(j * modes, ring_modes);
    return out;
  }

  double total(const Point &evaluated) const
  {
    double sum = 0;
    for (Index j = 0; j < count(); ++j)
      sum += std::abs(evaluated.rollers.load[j * modes]);
    return sum;
  }

  /// @param press  (rows Z modes, n) approach for a unit of each of n motions
  BearingStiffness stiffness(const Point &evaluated, const MatrixXd &press) const
  {
    return bearing_stiffness(evaluated.rollers, press, flexibility, evaluated.imbalance);
  }

  // ---- Newton
  struct Step {
    Vector5 motion;
    VectorXd bending_load;
  };

  Vector5 unbalanced(const Point &evaluated, const RingLoading &loading) const
  {
    Vector5 out = Vector5::Zero();
    for (std::size_t i = 0; i < 5; ++i)
      if (!loading.prescribed[i])
        out[Index(i)] = loading.value[Index(i)] - evaluated.force[Index(i)];
    return out;
  }

  // Slope of the energy along a step: negative while the energy still falls.
  double slope(const Point &point, const RingLoading &loading, const Step &step) const
  {
    double sum = -unbalanced(point, loading).dot(step.motion);
    if (ring_modes)
      sum -= point.imbalance.dot(flexibility * step.bending_load);
    return sum;
  }

  double residual(const Point &point, const RingLoading &loading) const
  {
    Vector5 scaled = unbalanced(point, loading);
    scaled.tail<2>() /= radius;
    double worst = scaled.cwiseAbs().maxCoeff();
    if (point.imbalance.size())
      worst = std::max(worst, point.imbalance.cwiseAbs().maxCoeff());
    double scale = total(point);
    for (std::size_t i = 0; i < 5; ++i)
      if (!loading.prescribed[i])
        scale = std::max(scale, std::abs(loading.value[Index(i)]) / (i < 3 ? 1 : radius));
    return scale > 0 ? worst / scale : 0;
  }

  // Directions in which nothing resists and nothing pulls are left alone; nothing that resists a pull: a long
  // step, cut to `reach` so that rollers come into contact on the way.
  Step newton_step(const Point &point, const RingLoading &loading, const BearingStiffness &k,
                   const double reach) const
  {
    std::vector<Index> free;
    for (std::size_t i = 0; i < 5; ++i)
      if (!loading.prescribed[i])
        free.push_back(Index(i));
    Step step{Vector5::Zero(), VectorXd::Zero(point.imbalance.size())};
    if (!free.empty()) {
      const Vector5 pull = unbalanced(point, loading) + k.press.transpose() * k.solved_bend;
      Vector5 lever;
      lever << 1, 1, 1, radius, radius;
      const double size = (k.tangent.diagonal().array() / lever.array().square()).maxCoeff();
      MatrixXd K        = k.tangent(free, free);
      for (std::size_t i = 0; i < free.size(); ++i)
        K(Index(i), Index(i)) += 1e-13 * size * lever[free[i]] * lever[free[i]];
      const VectorXd move = K.ldlt().solve(VectorXd(pull(free)));
      double cut          = 1;
      for (std::size_t i = 0; i < free.size(); ++i) {
        step.motion[free[i]] = move[Index(i)];
        cut                  = std::min(cut, reach / std::max(1e-300, std::abs(move[Index(i)]) * lever[free[i]]));
      }
      step.motion *= cut;
    }
    if (ring_modes)
      step.bending_load = point.imbalance + ring_loads(k.root * (k.solved * step.motion - k.solved_bend));
    return step;
  }

  Point moved(const Point &from, const Step &step, const double by) const
  {
    Point to;
    to.motion       = from.motion + by * step.motion;
    to.bending_load = from.bending_load + by * step.bending_load;
    evaluate(to, &from.rollers);
    return to;
  }

  // The energy is convex, so its slope along the step grows: full step if the slope has not turned by much, else
  // where it has nearly vanished.
  Point along(const Point &from, const RingLoading &loading, const Step &step) const
  {
    const double start = slope(from, loading, step);
    Point to           = moved(from, step, 1);
    double high_slope  = slope(to, loading, step);
    if (!(start < 0) || high_slope <= 0.9 * -start)
      return to;
    double low = 0, high = 1, low_slope = start;
    for (int i = 0; i < 40; ++i) {
      double by      = low - low_slope * (high - low) / (high_slope - low_slope);
      by             = std::clamp(by, low + 0.05 * (high - low), high - 0.05 * (high - low));
      to             = moved(from, step, by);
      const double s = slope(to, loading, step);
      if (std::abs(s) <= 0.5 * std::abs(start))
        return to;
      (s > 0 ? high : low)             = by;
      (s > 0 ? high_slope : low_slope) = s;
    }
    return to;
  }

  Point equilibrium(const RingLoading &loading, Point point, int &iterations) const
  {
    double reach = 20e-6, best = INFINITY;
    for (iterations = 0; iterations < step_limit; ++iterations) {
      const double off = residual(point, loading);
      // To 1e-13; where the motion's last digit moves more than that (a light load behind a large clearance),
      // until nothing improves.
      if (off <= 1e-13 || (iterations > 3 && off <= 1e-10 && off > 0.5 * best) || (iterations > 20 && off <= 1e-7))
        return point;
      best = std::min(best, off);
      if (point.motion.head<3>().norm() > 0.1 * radius)
        throw no_equilibrium(loading, point,
                             "the rings moved apart: the load has no counterpart, for instance a single "
                             "row that its own radial load pushes out axially");
      const Step step = newton_step(point, loading, stiffness(point, places.press), reach);
      reach           = std::max(reach, 4 * step.motion.head<3>().norm());
      point           = along(point, loading, step);
    }
    throw no_equilibrium(loading, point, "an input that is not a number, or a load far beyond the bearing");
  }

  // ---- start
  Point at_motion(const Vector5 &motion) const
  {
    Point point;
    point.motion       = motion;
    point.bending_load = VectorXd::Zero(ring_modes ? count() * ring_modes : 0);
    evaluate(point, nullptr);
    return point;
  }

  bool pressed(const Point &point) const
  {
    return std::count(point.rollers.on_raceway.begin(), point.rollers.on_raceway.end(), char(1)) > 0;
  }

  // Moved along the load by what clearance and the heaviest roller take (Stribeck), then on until rollers touch.
  Point cold_start(const RingLoading &loading) const
  {
    const RollerBearing &b = model.bearing;
    Vector5 motion = Vector5::Zero(), along_load = Vector5::Zero();
    for (std::size_t i = 0; i < 5; ++i)
      (loading.prescribed[i] ? motion : along_load)[Index(i)] = loading.value[Index(i)];
    const double radial = along_load.head<2>().norm(), ca = std::cos(b.cup_angle), sa = std::sin(b.cup_angle);
    if (radial > 0) {
      const double heaviest = 4.1 * radial / (double(count()) * ca);
      const double travel   = std::max(roller_approach(model.roller, heaviest) - offset.minCoeff(), 1e-9) / ca;
      motion.head<2>() += travel * along_load.head<2>() / radial;
    } else if (along_load[2] != 0 && sa > 0) {
      const double each = std::abs(along_load[2]) / (double(count()) * sa);
      motion[2] += std::copysign(std::max(roller_approach(model.roller, each) - offset.minCoeff(), 1e-9) / sa,
                                 along_load[2]);
    }
    Point point     = at_motion(motion);
    Vector5 towards = along_load;
    towards.tail<2>() /= radius * radius;  // as motions: a turn that moves the rim as a translation would
    const double size = std::max(towards.head<3>().norm(), radius * towards.tail<2>().norm());
    for (double travel = 1e-6; !pressed(point) && size > 0 && travel < 0.1 * radius; travel *= 2)
      point = at_motion(motion + travel / size * towards);
    if (!pressed(point) && size > 0)
      throw no_equilibrium(loading, point, "no roller is pressed by a motion in the direction of the load");
    return point;
  }

  Point warm_start(const RingLoading &loading) const
  {
    Point point = *last;
    for (std::size_t i = 0; i < 5; ++i)
      if (loading.prescribed[i])
        point.motion[Index(i)] = loading.value[Index(i)];
    const RollerForces before = point.rollers;
    evaluate(point, &before);
    return pressed(point) ? point : cold_start(loading);
  }

  // A start far off may stall on the rounding of its own large loads: then once more from the load's direction.
  Point from_any_start(const RingLoading &loading, int &iterations) const
  {
    if (last)
      try {
        return equilibrium(loading, warm_start(loading), iterations);
      } catch (const SolverError &) {
      }
    return equilibrium(loading, cold_start(loading), iterations);
  }

  SolverError no_equilibrium(const RingLoading &loading, const Point &point, const std::string &cause) const
  {
    return SolverError(
        {"bearing " + model.bearing.name + ": no equilibrium under " + loading_text(loading),
         stood_at(point, residual(point, loading), ""), cause,
         "impose the motion of a component that nothing holds, or change load, clearance or preload", ""});
  }

  // ---- result
  // The rollers that carry.  The laws are steepest where contact begins: a roller at its edge, whose approach is
  // rounding, would have a fifth of the slope of the heaviest one and more.
  RollerForces carrying(const RollerForces &all) const
  {
    RollerForces out           = all;
    const Eigen::RowVectorXd Q = all.slice_load.colwise().sum();
    for (Index i = 0; i < count(); ++i)
      if (!carries(Q[i], Q.maxCoeff()))
        out.on_raceway[std::size_t(i)] = 0;
    return out;
  }

  AssemblyState state(const Point &point, const RingLoading &loading, const int iterations) const
  {
    const RollerBearing &b = model.bearing;
    const int R = places.rows, Z = places.rollers;
    AssemblyState s;
    s.motion      = point.motion;
    s.load        = point.force;
    s.tangent     = bearing_stiffness(carrying(point.rollers), places.press, flexibility, point.imbalance).tangent;
    s.azimuth     = places.azimuth;
    s.iterations  = iterations;
    s.residual    = residual(point, loading);
    s.slice_load  = point.rollers.slice_load;
    s.ring_motion = point.ring_motion;
    for (MatrixXd *table :
         {&s.roller_load, &s.roller_moment, &s.roller_approach, &s.roller_tangent, &s.inner_load, &s.rib_force})
      table->setZero(R, Z);
    s.row_radial = s.row_axial = s.row_share = VectorXd::Zero(R);
    s.loaded_rollers                         = Eigen::VectorXi::Zero(R);
    const double radial                      = s.load.head<2>().norm();
    const Eigen::Vector2d towards =
        radial > 0 ? Eigen::Vector2d(s.load.head<2>() / radial) : Eigen::Vector2d(1, 0);
    const VectorXd press = places.press * point.motion;
    for (int r = 0; r < R; ++r)
      for (int j = 0; j < Z; ++j) {
        const Index i         = Index(r) * Z + j;
        const double Q        = point.rollers.slice_load.col(i).sum();
        s.roller_load(r, j)   = Q;
        s.roller_moment(r, j) = point.rollers.slice_load.col(i).dot(model.roller.position);
        s.roller_approach(r, j) =
            press[i * modes] + offset[r] - (ring_modes ? point.ring_motion[i * ring_modes] : 0);
        s.roller_tangent(r, j)        = point.rollers.slope(0, i * modes);
        const RollerTriangle triangle = roller_triangle(b, Q, model.centrifugal_force);
        s.inner_load(r, j)            = triangle.cone;
        s.rib_force(r, j)             = triangle.rib;
        const Eigen::Vector2d normal(std::cos(places.azimuth[j]), std::sin(places.azimuth[j]));
        s.row_radial[r] += Q * std::cos(b.cup_angle) * normal.dot(towards);
        s.row_axial[r] += Q * std::sin(b.cup_angle) * places.hand[r];
      }
    const double heaviest = s.roller_load.maxCoeff();
    for (Index i = 0; i < count(); ++i)
      s.loaded_rollers[i / Z] +=
          point.rollers.on_raceway[std::size_t(i)] && carries(s.roller_load(i / Z, i % Z), heaviest);
    // A load that is only rounding, as of an axial load on a full ring, has no direction and no shares.
    if (radial > 1e-9 * s.roller_load.sum())
      s.row_share = s.row_radial / radial;
    return s;
  }

  AssemblyState solve(const RingLoading &loading)
  {
    if (!loading.value.allFinite())
      throw InputError("bearing." + model.bearing.name + ": a load or motion that is not a number");
    int iterations = 0;
    Point point    = from_any_start(loading, iterations);
    const bool all_imposed =
        std::all_of(loading.prescribed.begin(), loading.prescribed.end(), [](bool imposed) { return imposed; });
    if (!all_imposed && !pressed(point))
      throw no_equilibrium(loading, point,
                           "no roller carries load: without load a bearing with clearance is loose and has "
                           "no stiffness");
    const AssemblyState out = state(point, loading, iterations);
    last                    = std::move(point);
    return out;
  }
};

BearingAssembly::BearingAssembly(BearingModel model) : self(std::make_unique<Implementation>(std::move(model))) {}
BearingAssembly::~BearingAssembly()                           = default;
BearingAssembly::BearingAssembly(BearingAssembly &&) noexcept = default;

AssemblyState BearingAssembly::solve(const RingLoading &loading)
{
  return self->solve(loading);
}

AssemblyCurve BearingAssembly::curve(const std::vector<RingLoading> &loadings)
{
  AssemblyCurve out;
  for (const RingLoading &loading : loadings)
    try {
      out.states.push_back(solve(loading));
    } catch (const SolverError &error) {
      out.failure       = error.report;
      out.failure->kept = std::to_string(out.states.size()) + " of " + std::to_string(loadings.size()) + " states";
      break;
    }
  return out;
}

void BearingAssembly::forget()
{
  self->last.reset();
}

void BearingAssembly::turn_cage(const double angle)
{
  self->model.cage_angle = angle;
  self->place();
}

const BearingModel &BearingAssembly::model() const
{
  return self->model;
}

const VectorXd &BearingAssembly::offset() const
{
  return self->offset;
}
}  // namespace mill::bearing
