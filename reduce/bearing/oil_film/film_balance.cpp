#include "reduce/bearing/oil_film/film_balance.h"
#include "core/base/errors.h"
#include "reduce/bearing/oil_film/closed_forms.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::bearing {
namespace {
constexpr double tolerance = 1e-7;  // of force and direction
constexpr int most_turns   = 60;

// Eccentricity over its room as a number without bounds.
struct Place {
  double s;          // ln(e / (room - e))
  double direction;  // rad
};

double eccentricity_at(const Place &place, const double room)
{
  return room / (1 + std::exp(-place.s));
}

[[noreturn]] void refuse(const FilmFailure why, const FilmProblem &p, const double force)
{
  const char *cause = why == FilmFailure::touching ? "sleeve and bush touch"
                      : why == FilmFailure::unbounded_pressure
                          ? "the viscosity rises with the pressure without bound"
                          : "the iteration does not settle";
  throw SolverError(
      {"oil film: no film carries the load",
       fmt::format("displacement {:.4g}, {:.4g} of the clearance, force {:.4g} in mu w (R/c)^2 R L/2",
                   p.displacement[0], p.displacement[1], force),
       cause, "less load, more speed, a thicker oil or less tilt", ""});
}

struct Trial {
  std::shared_ptr<Film> film;
  Eigen::Vector2d force;
  Eigen::Vector2d error;  // ln |f| - ln W, direction of f
};

class Search {
public:
  Search(FilmProblem problem, const FilmMesh &grid, const double load)
      : of(std::move(problem)), mesh(grid), W(load)
  {
  }
  double room(const double direction) const
  {
    return largest_eccentricity(of, direction);
  }
  Trial trial(const Place &trial_place, const Film *start)
  {
    const double e  = eccentricity_at(trial_place, room(trial_place.direction));
    of.displacement = {e * std::cos(trial_place.direction), e * std::sin(trial_place.direction)};
    Trial t;
    t.film = std::make_shared<Film>(of, film_grid(of, mesh), start);
    if (t.film->failure() != FilmFailure::none)
      return t;
    t.force = force_of(*t.film);
    t.error = {std::log(t.force.norm() / W), std::atan2(t.force[1], t.force[0])};
    return t;
  }
  // Newton's step of (s, direction).
  Eigen::Vector2d step(const Place &place, const Trial &t) const
  {
    const double full = room(place.direction), e = eccentricity_at(place, full);
    const Eigen::Matrix2d K = film_coefficients(*t.film, false).stiffness;
    const Eigen::Vector2d along(std::cos(place.direction), std::sin(place.direction)), f = t.force;
    const Eigen::Vector2d by_s = K * along * (e * (full - e) / full);
    constexpr double turn      = 1e-6;  // rad; the room is smooth but for a sign of the tilt
    const double room_turn     = (room(place.direction + turn) - room(place.direction - turn)) / (2 * turn);
    const Eigen::Vector2d by_turn =
        K * (Eigen::Vector2d(-along[1], along[0]) * e + along * (e / full * room_turn));
    const double f2  = f.squaredNorm();
    const auto cross = [&](const Eigen::Vector2d &d) { return (f[0] * d[1] - f[1] * d[0]) / f2; };
    Eigen::Matrix2d J;
    J << f.dot(by_s) / f2, f.dot(by_turn) / f2, cross(by_s), cross(by_turn);
    return -J.inverse() * t.error;
  }
  FilmProblem of;

private:
  static Eigen::Vector2d force_of(const Film &film)
  {
    return film_reactions(film).force;
  }
  FilmMesh mesh;
  double W;
};

Place first_place(const FilmProblem &p, const double W)
{
  if (const double e = p.displacement.norm(); e > 0) {
    const double direction = std::atan2(p.displacement[1], p.displacement[0]);
    const double room      = std::max(largest_eccentricity(p, direction), e * 1.0001);
    return {std::log(e / (room - e)), direction};
  }
  const double e = ocvirk_eccentricity(p.length_ratio, W);
  return {std::log(e / (1 - e)), ocvirk_attitude(e)};
}
}  // namespace

double largest_eccentricity(const FilmProblem &p, const double direction)
{
  const double lean = std::abs(p.tilt[0] * std::cos(direction) + p.tilt[1] * std::sin(direction));
  return std::sqrt(std::max(0., lean * lean + 1 - p.tilt.squaredNorm())) - lean;
}

BalancedFilm balance_film(FilmProblem problem, const FilmMesh &mesh, const double W, const BalancedFilm *near)
{
  require_input(W > 0, "an oil film without a load has no stiffness: the load must be above zero");
  if (near)
    problem.displacement = near->film->problem().displacement;
  Search search(problem, mesh, W);
  Place place = first_place(problem, W);
  Trial best  = search.trial(place, near ? near->film.get() : nullptr);
  for (int turn = 0; turn < most_turns; ++turn) {
    if (best.film->failure() != FilmFailure::none) {  // begin with a thicker film
      place.s -= 0.7;
      if (place.s < -16)
        refuse(best.film->failure(), search.of, W);
      best = search.trial(place, nullptr);
      continue;
    }
    if (best.error.norm() < tolerance)
      return {best.film, film_reactions(*best.film)};
    Eigen::Vector2d step = search.step(place, best);
    if (!step.allFinite())
      refuse(FilmFailure::no_convergence, search.of, W);
    step *= std::min(1., std::min(2.5 / (std::abs(step[0]) + 1e-300), 0.8 / (std::abs(step[1]) + 1e-300)));
    Trial next;
    Place there = place;
    for (int half = 0; half < 12; ++half, step /= 2) {
      there = {std::min(place.s + step[0], 12.), place.direction + step[1]};
      next  = search.trial(there, best.film.get());
      if (next.film->failure() == FilmFailure::none && next.error.norm() < best.error.norm())
        break;
    }
    if (next.film->failure() != FilmFailure::none || !(next.error.norm() < best.error.norm())) {
      if (best.error.norm() < 1e3 * tolerance)  // as near as the moving rupture boundary allows
        return {best.film, film_reactions(*best.film)};
      refuse(next.film->failure() != FilmFailure::none ? next.film->failure() : FilmFailure::no_convergence,
             search.of, W);
    }
    place = there;
    best  = std::move(next);
  }
  refuse(FilmFailure::no_convergence, search.of, W);
}
}  // namespace mill::bearing
