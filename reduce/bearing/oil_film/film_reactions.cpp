#include "reduce/bearing/oil_film/film_reactions.h"
#include <cmath>

namespace mill::bearing {
namespace {
// Sums a pressure over the surface with the directions of the load, plain and with the lever z.
struct Sums {
  Eigen::Vector2d force = {0, 0}, moment = {0, 0};
};

Sums sums_of(const Film &film, const Eigen::MatrixXd &p)
{
  const FilmGrid &g = film.grid();
  Sums s;
  for (Eigen::Index i = 0; i < g.columns(); ++i) {
    const double plain = p.col(i).dot(g.z_width), lever = p.col(i).dot(g.z_width.cwiseProduct(g.z));
    const Eigen::Vector2d n = g.mirror * g.width[i] * Eigen::Vector2d(std::cos(g.angle[i]), std::sin(g.angle[i]));
    s.force += plain * n;
    s.moment += lever * n;
  }
  if (g.mirror > 1)  // both halves alike
    s.moment.setZero();
  return s;
}

// Shear of the moving surface; the part of the pressure's slope by parts, theory.md (29.10).
void add_friction(const Film &film, FilmReactions &r)
{
  const FilmGrid &g = film.grid();
  const double a    = film.problem().pressure_viscosity;
  r.friction = r.friction_streamers = 0;
  for (Eigen::Index j = 0; j < g.rows(); ++j) {
    // The strips at the ends, whose nodes the grid does not keep, shear as the rows next to them.
    const double length = g.z_width[j] + (j + 1 == g.rows() ? g.z_gap[j + 1] / 2 : 0) +
                          (j == 0 && g.mirror == 1 ? g.z_gap[0] / 2 : 0);
    double full = 0, streamers = 0, ruptured_at = 0;
    for (Eigen::Index turn = 0; turn < 2; ++turn)  // the first turn finds the film in which the rupture begins
      for (Eigen::Index i = 0; i < g.columns(); ++i) {
        const bool groove = film.pressure()(j, i) == 0 ? false : !film.carries(j, i);
        if (film.carries(j, i) || groove)
          ruptured_at = film.thickness()(j, i);
        if (turn == 0 || groove)
          continue;
        const double shear = g.width[i] * std::exp(a * film.pressure()(j, i)) / film.thickness()(j, i);
        full += shear;
        streamers += film.carries(j, i) || ruptured_at == 0
                         ? shear
                         : shear * std::min(1., ruptured_at / film.thickness()(j, i));
      }
    r.friction += g.mirror * length * full;
    r.friction_streamers += g.mirror * length * streamers;
  }
  const Eigen::Vector2d e = film.problem().displacement, t = film.problem().tilt;
  double by_slope = 0;
  for (Eigen::Index i = 0; i < g.columns(); ++i)
    for (Eigen::Index j = 0; j < g.rows(); ++j) {
      const Eigen::Vector2d position = e + g.z[j] * t;
      by_slope += film.pressure()(j, i) * g.width[i] * g.z_width[j] *
                  (position[0] * std::sin(g.angle[i]) - position[1] * std::cos(g.angle[i]));
    }
  r.friction -= g.mirror * by_slope / 2;
  r.friction_streamers -= g.mirror * by_slope / 2;
}

// Top of the parabola through three nodes.
double top_between(const double left, const double middle, const double right)
{
  const double curvature = left - 2 * middle + right;
  return curvature < 0 ? middle - (right - left) * (right - left) / (8 * curvature) : middle;
}

void add_peak(const Film &film, FilmReactions &r)
{
  const auto &p  = film.pressure();
  Eigen::Index j = 0, i = 0;
  r.peak_pressure      = p.size() > 0 ? p.maxCoeff(&j, &i) : 0;
  const FilmGrid &g    = film.grid();
  const Eigen::Index n = g.columns();
  r.peak_place         = {std::remainder(g.angle[i], 2 * M_PI), g.z[j]};
  r.peak_pressure      = top_between(p(j, (i + n - 1) % n), r.peak_pressure, p(j, (i + 1) % n));
}
}  // namespace

FilmReactions film_reactions(const Film &film)
{
  FilmReactions r{};
  const Sums s = sums_of(film, film.pressure());
  r.force      = s.force;
  r.moment     = s.moment;
  add_peak(film, r);
  r.least_film = least_rigid_film(film.problem());  // at an end, where no pressure opens it
  add_friction(film, r);
  r.side_flow = film.side_flow();
  return r;
}

FilmCoefficients film_coefficients(const Film &film, const bool with_damping, const bool with_tilt)
{
  FilmCoefficients c;
  c.damping = c.by_tilt = c.tilting = Eigen::Matrix2d::Zero();
  const FilmGrid &g                 = film.grid();
  const auto closing                = [](const int axis, const double angle) {
    return axis == 0 ? -std::cos(angle) : -std::sin(angle);
  };
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::MatrixXd by_place =
        film.response([&](const double angle, double) { return closing(axis, angle); }, {});
    c.stiffness.col(axis) = sums_of(film, by_place).force;
    if (with_damping) {
      Eigen::MatrixXd rate = film.problem().compliance * by_place;
      for (Eigen::Index i = 0; i < g.columns(); ++i)
        rate.col(i).array() += closing(axis, g.angle[i]);
      c.damping.col(axis) = sums_of(film, film.response([](double, double) { return 0.; }, rate)).force;
    }
    if (with_tilt && g.mirror == 1) {
      const Sums s = sums_of(
          film, film.response([&](const double angle, const double z) { return z * closing(axis, angle); }, {}));
      c.by_tilt.col(axis) = s.force;
      c.tilting.col(axis) = s.moment;
    }
  }
  return c;
}

double sommerfeld_number(const double force)
{
  return 2 / (M_PI * force);
}
}  // namespace mill::bearing
