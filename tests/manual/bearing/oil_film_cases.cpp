#include "reduce/bearing/oil_film/closed_forms.h"
#include "reduce/bearing/oil_film/film_balance.h"
#include "reduce/bearing/oil_film/parabolic_film.h"
#include "tests/manual/check/units.h"
#include "tests/manual/check/verification.h"
#include <cmath>
#include <fmt/format.h>

// Oil-film bearings.
namespace mill::verify {
namespace {
using bearing::Film;
using bearing::FilmProblem;
using bearing::FilmReactions;

// What charts print, from two grids.
struct ChartPoint {
  double sommerfeld, attitude, friction, side_flow, mean_over_peak;
};

ChartPoint chart_point(const double length_ratio, const double eccentricity, const bool from_widest_gap)
{
  FilmProblem p;
  p.length_ratio    = length_ratio;
  p.displacement    = {eccentricity, 0};
  p.from_widest_gap = from_widest_gap;
  const auto on     = [&](const int fineness) {
    const FilmReactions r = film_reactions(Film(p, film_grid(p, {60, 6, fineness})));
    const double W        = r.force.norm();
    return ChartPoint{bearing::sommerfeld_number(W), -std::atan2(r.force[1], r.force[0]), r.friction / W,
                      M_PI * r.side_flow, W / 4 / r.peak_pressure};
  };
  const ChartPoint fine = on(2), coarse = on(1);
  const auto limit = [&](double ChartPoint::*number) { return (4 * fine.*number - coarse.*number) / 3; };
  return {limit(&ChartPoint::sommerfeld), limit(&ChartPoint::attitude), limit(&ChartPoint::friction),
          limit(&ChartPoint::side_flow), limit(&ChartPoint::mean_over_peak)};
}

std::vector<Check> raimondi_boyd()
{
  // L/D, e, S, attitude deg, (R/c) f, Q / (R c N L), side flow over it
  const double table[][7] = {
      {1, 0.2, 0.631, 74.02, 12.8, 3.59, 0.280},    {1, 0.6, 0.121, 50.58, 3.22, 4.33, 0.680},
      {1, 0.9, 0.0188, 26.45, 1.05, 4.74, 0.919},   {0.5, 0.2, 2.03, 74.94, 40.9, 3.72, 0.318},
      {0.5, 0.6, 0.319, 48.14, 8.10, 4.85, 0.730},  {0.5, 0.9, 0.0313, 23.66, 1.60, 5.69, 0.939},
      {0.25, 0.2, 7.57, 75.18, 153, 3.76, 0.330},   {0.25, 0.6, 1.07, 46.72, 26.7, 4.99, 0.746},
      {0.25, 0.9, 0.0736, 21.85, 3.50, 5.91, 0.945}};
  std::vector<Check> checks;
  for (const auto &row : table) {
    const ChartPoint chart = chart_point(row[0], row[1], true);
    const auto where       = fmt::format(", L/D {:g}, e {:g}", row[0], row[1]);
    checks.push_back(relative("S" + where, "-", chart.sommerfeld, row[2], 0.01));
    checks.push_back(verify::absolute("attitude" + where, "deg", chart.attitude / degree, row[3], 0.5));
    checks.push_back(relative("friction (R/c) f" + where, "-", chart.friction, row[4], 0.01));
    checks.push_back(relative("side flow / (R c N L)" + where, "-", chart.side_flow, row[5] * row[6], 0.01));
    const ChartPoint free = chart_point(row[0], row[1], false);
    checks.push_back(reported("S, film with free ends" + where, "-", free.sommerfeld, row[2]));
    checks.push_back(reported("attitude, film with free ends" + where, "deg", free.attitude / degree, row[3]));
  }
  return checks;
}

std::vector<Check> short_bearing()
{
  std::vector<Check> checks;
  constexpr double length_ratio = 1. / 20;
  for (const double e : {0.2, 0.5, 0.8}) {
    const ChartPoint chart = chart_point(length_ratio, e, false);
    const auto where       = fmt::format(", e {:g}", e);
    checks.push_back(relative("S" + where, "-", chart.sommerfeld,
                              bearing::sommerfeld_number(bearing::ocvirk_force(length_ratio, e)), 0.01));
    checks.push_back(relative("tangent of the attitude" + where, "-", std::tan(chart.attitude),
                              M_PI / 4 * std::sqrt(1 - e * e) / e, 0.01));
    checks.push_back(relative("side flow / (R c N L)" + where, "-", chart.side_flow, 2 * M_PI * e, 0.01));
  }
  return checks;
}

std::vector<Check> long_bearing()
{
  std::vector<Check> checks;
  for (const double e : {0.2, 0.5, 0.8, 0.95}) {
    double whole[2];
    for (int twice = 0; twice < 2; ++twice) {
      FilmProblem p;
      p.length_ratio = 5 * (1 + twice);
      p.ruptures     = false;
      p.displacement = {e, 0};
      const auto on  = [&](const int fineness) {
        return film_reactions(Film(p, film_grid(p, {30, 20, fineness}))).force.norm();
      };
      whole[twice] = (4 * on(2) - on(1)) / 3 * (1 + twice);
    }
    checks.push_back(relative(fmt::format("force of the length between L/D 5 and 10, e {:g}", e),
                              "mu w (R/c)^2 R L/2", whole[1] - whole[0], bearing::sommerfeld_force(e), 1e-3));
  }
  return checks;
}

std::vector<Check> parabola()
{
  std::vector<Check> checks;
  for (const double length_ratio : {0.25, 0.5, 1.})
    for (const double e : {0.1, 0.6, 0.9}) {
      const ChartPoint chart  = chart_point(length_ratio, e, false);
      const Eigen::Vector2d f = bearing::parabolic_force(length_ratio, e);
      const auto where        = fmt::format(", L/D {:g}, e {:g}", length_ratio, e);
      checks.push_back(relative("S" + where, "-", chart.sommerfeld, bearing::sommerfeld_number(f.norm()), 0.03));
      checks.push_back(verify::absolute("attitude" + where, "deg", chart.attitude / degree,
                                        -std::atan2(f[1], f[0]) / degree, 0.3));
    }
  return checks;
}
}  // namespace

std::vector<Case> oil_film_cases()
{
  return {
      {"oil-film-chart", "benchmark",
       "Full journal bearing, constant viscosity, film from the widest gap: Reynolds equation with rupture on two "
       "grids of 60 x 6 and 120 x 12 on half the length, extrapolated. The film with free ends is listed for "
       "comparison.",
       "A. A. Raimondi, J. Boyd, ASLE Trans. 1 (1958) 159, part III, as tabulated in textbooks",
       "1 %, 0.5 deg: the chart was computed on a coarser grid and is printed with three digits", raimondi_boyd},
      {"oil-film-short-bearing", "verification",
       "L/D 1/20, film with free ends, against the short bearing in closed form.",
       "theory.md (29.13), F. W. Ocvirk", "1 %: finite L/D", short_bearing},
      {"oil-film-long-bearing", "verification",
       "What length adds to the force of a long film that does not rupture, against the infinitely long one.",
       "theory.md 29.5, A. Sommerfeld, Z. Math. Phys. 50 (1904) 97", "1e-3: two grids", long_bearing},
      {"oil-film-parabola", "verification",
       "Film with free ends against one with a parabola along the bearing, which shares neither grid nor solver.",
       "theory.md (29.15)", "3 %, 0.3 deg: at L/D 1, e 0.9 the pressure along the bearing is not a parabola",
       parabola}};
}
}  // namespace mill::verify
