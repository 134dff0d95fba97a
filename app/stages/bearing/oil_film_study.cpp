#include "app/stages/bearing/oil_film_study.h"
#include "core/model/case.h"
#include "core/process/parallel.h"
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
using bearing::OilFilmLoad;

// No film carries: what is asked of it, and from which speed on it does.
[[noreturn]] void refuse_film(const RunContext &run, const OilFilmQuestion &q, const std::string &why)
{
  const double least = bearing::least_speed(q.bearing, q.load);
  const auto place   = run.the_case.places.find(q.speed_key);
  throw InputError(place == run.the_case.places.end() ? Place{run.the_case.path} : place->second,
                   fmt::format("bearing.{}: at {} no film carries {:.5g} kN: {}; {}", q.bearing.name,
                               speed_text(q, q.load.speed), q.load.load / 1e3, why,
                               std::isnan(least)
                                   ? "none does at any speed: give less load, tilt or pressure_viscosity, or a "
                                     "thicker oil"
                                   : "a film carries from " + speed_text(q, least) + " on"));
}
}  // namespace

StatedQuantity shown_speed(const OilFilmQuestion &q, const double speed)
{
  return std::isnan(q.surface_radius) ? StatedQuantity{speed / (2 * M_PI), "rpm", ".4g"}
                                      : StatedQuantity{speed * q.surface_radius, "m/s", ".4g"};
}

std::string speed_text(const OilFilmQuestion &q, const double speed)
{
  return OperatingPoint("{}", {shown_speed(q, speed)}).text();
}

OilFilmStudy study_oil_film(RunContext &run, const OilFilmQuestion &q)
{
  StageTimer timer(run, "bearing " + q.bearing.name);
  OilFilmStudy s;
  s.question = q;
  bearing::OilFilmSolution solution;
  if (!(q.load.speed > 0))
    refuse_film(run, q, "a sleeve at rest drags no oil into it");
  try {
    solution = bearing::solve_oil_film(q.bearing, q.load);
  } catch (const SolverError &e) {
    refuse_film(run, q, e.report.cause);
  }
  if (!bearing::carries(q.bearing, solution.at))
    refuse_film(
        run, q,
        fmt::format("it would be {:.3g} um thin, {:.3g} um are needed (three times bearing.{}.roughness, and "
                    "2 % of the clearance)",
                    1e6 * solution.at.least_film, 1e6 * bearing::least_carrying_film(q.bearing), q.bearing.name));
  s.numbers = bearing::film_numbers(q.bearing, q.load, std::move(solution));
  s.by_load.resize(q.loads.size());
  s.by_speed.resize(q.speeds.size());
  share_tasks(long(q.loads.size() + q.speeds.size()), run.threads, [&](const long i) {
    OilFilmLoad load                                         = q.load;
    const auto k                                             = std::size_t(i);
    const bool a_load                                        = k < q.loads.size();
    (a_load ? load.load : load.speed)                        = a_load ? q.loads[k] : q.speeds[k - q.loads.size()];
    (a_load ? s.by_load[k] : s.by_speed[k - q.loads.size()]) = bearing::carrying_state(q.bearing, load);
  });
  return s;
}
}  // namespace mill
