// Timing of chatter on the published stand.  Goals: one search for the critical speed 20 ms, a map of 200 x 200
// cells 5 s on two processors, one second of nonlinear motion one second.
#include "dynamics/chatter/map.h"
#include "dynamics/chatter/run.h"
#include "dynamics/chatter/sensitivity.h"
#include "dynamics/chatter/speed.h"
#include "tests/support/film_pass.h"
#include <benchmark/benchmark.h>

using namespace mill;
using namespace mill::dynamics;

namespace {
constexpr auto in_sequence = Linearisation::sequential;

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
    benchmark::DoNotOptimize(critical_speed(stand(), film_pass(), in_sequence).speed);
}
BENCHMARK(search)->Unit(benchmark::kMillisecond);

void map_200_by_200(benchmark::State &state)
{
  const Eigen::VectorXd speed = Eigen::VectorXd::LinSpaced(200, 5, 30);
  for (auto _ : state)
    benchmark::DoNotOptimize(stability_map(stand(), film_pass(), in_sequence, speed, MapQuantity::viscosity,
                                           Eigen::VectorXd::LinSpaced(200, 0.002, 0.01), 2)
                                 .growth.sum());
}
BENCHMARK(map_200_by_200)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

// Speed in tenths of m/s, start of the gap in nm.
void second_of_motion(benchmark::State &state)
{
  const auto model = stand();
  const auto point = working_point(film_pass(), 0.1 * double(state.range(0)), in_sequence);
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
    benchmark::DoNotOptimize(chatter_sensitivities(stand(), numbers, film_pass(), request).critical_speed);
}
BENCHMARK(sensitivities)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();
}  // namespace
