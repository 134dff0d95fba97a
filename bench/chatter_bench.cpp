// Timing of chatter on the published stand.  Goals: one search for the critical speed 20 ms, a map of 200 x 200
// cells 5 s on two processors, one second of nonlinear motion one second.
#include "dynamics/chatter_map.h"
#include "dynamics/chatter_run.h"
#include "dynamics/chatter_sensitivity.h"
#include "dynamics/chatter_speed.h"
#include <benchmark/benchmark.h>

using namespace mill;
using namespace mill::dynamics;

namespace {
constexpr auto in_sequence = bite::Linearisation::sequential;

// Condition 2 of Liu et al. (2017).
bite::RollBite film_bite()
{
  bite::RollBite b;
  b.roll_radius                 = 0.3;
  b.roll                        = {2.1e11, 0.3, 7850};
  Strip &s                      = b.strip;
  s.width                       = 1.206;
  s.entry_thickness             = 0.789e-3;
  s.exit_thickness              = 0.577e-3;
  s.entry_tension               = 180e6;
  s.exit_tension                = 189e6;
  s.initial_thickness           = 3e-3;
  s.flow_stress                 = {"reduction-power", 829.64259e6, 0.00817, 0.3};
  s.friction.law                = "film";
  s.friction.mu0                = 0.012;
  s.friction.mu1                = 0.142;
  s.friction.decay              = 2.43e6;
  s.friction.viscosity          = 0.005;
  s.friction.pressure_viscosity = 2e-8;
  return b;
}

constexpr std::array<double, 6> mass{119e3, 75e3, 9.2e3, 9.2e3, 75e3, 36.5e3};
constexpr std::array<double, 6> stiffness{6.9e10, 3.0e10, 6.06e10, 6.06e10, 4.4e10, 10.1e10};
constexpr std::array<double, 6> damping{6.05e5, 4.25e5, 6.05e5, 6.05e5, 4.25e5, 6.05e5};

ChatterStandModel stand()
{
  return {six_mass_structure(mass, stiffness, damping), 4.95, 4.95, 210e9};
}

void search(benchmark::State &state)
{
  for (auto _ : state)
    benchmark::DoNotOptimize(critical_speed(stand(), film_bite(), in_sequence).speed);
}
BENCHMARK(search)->Unit(benchmark::kMillisecond);

void map_200_by_200(benchmark::State &state)
{
  const Eigen::VectorXd speed = Eigen::VectorXd::LinSpaced(200, 5, 30);
  for (auto _ : state)
    benchmark::DoNotOptimize(stability_map(stand(), film_bite(), in_sequence, speed, MapQuantity::viscosity,
                                           Eigen::VectorXd::LinSpaced(200, 0.002, 0.01), 2)
                                 .growth.sum());
}
BENCHMARK(map_200_by_200)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

// Speed in tenths of m/s, start of the gap in nm.
void second_of_motion(benchmark::State &state)
{
  const auto model = stand();
  const auto point = working_point(film_bite(), 0.1 * double(state.range(0)), in_sequence);
  ChatterRunOptions options;
  options.duration = 1;
  options.contacts = roll_contacts(model.structure, point.state.force);
  const auto start = displaced_rolls(model.structure, 0.5e-9 * double(state.range(1)));
  for (auto _ : state)
    benchmark::DoNotOptimize(nonlinear_run(model, point, in_sequence, start, options).end);
}
BENCHMARK(second_of_motion)
    ->Args({182, 200})
    ->Args({190, 186000})
    ->Args({250, 205000})
    ->Unit(benchmark::kSecond)
    ->Iterations(3);

void sensitivities(benchmark::State &state)
{
  SensitivityRequest request;
  request.working_speed = 18.2;
  const auto numbers    = six_mass_numbers(mass, stiffness, damping);
  for (auto _ : state)
    benchmark::DoNotOptimize(chatter_sensitivities(stand(), numbers, film_bite(), request).critical_speed);
}
BENCHMARK(sensitivities)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();
}  // namespace
