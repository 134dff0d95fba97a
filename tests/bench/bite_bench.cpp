// Timing of the slab theories of the bite.  Goals: a state with all derivatives in 20 us on a given arc and in 200
// us with the flattening; a map of 10 000 K4 in 2 s.
#include "reduce/bite/linear/linear_coefficients.h"
#include "reduce/bite/linear/stiffness_map.h"
#include "reduce/bite/slab/bland_ford.h"
#include "tests/support/demo_pass.h"
#include "tests/support/film_pass.h"
#include <benchmark/benchmark.h>

using namespace mill;
using namespace mill::bite;

namespace {
void solve(benchmark::State &state, const RollBite &bite, const SlabModel &model)
{
  for (auto _ : state)
    benchmark::DoNotOptimize(solve_slab(bite, model).force_by[0]);
}

/// Arguments: arc (0 rigid, 1 Hitchcock), points of the curves on each side.
void constant_stress(benchmark::State &state)
{
  solve(state, demo_pass(), {Theory::bland_ford, Arc(state.range(0)), int(state.range(1))});
}
BENCHMARK(constant_stress)->ArgsProduct({{0, 1}, {0, 101}})->Unit(benchmark::kMicrosecond);

void hardening_under_a_film(benchmark::State &state)
{
  RollBite bite = film_pass();
  if (state.range(0) == 0)
    bite.roll_radius = 0.526;  // flattened already
  solve(state, bite, {Theory::bland_ford, Arc(state.range(0)), int(state.range(1))});
}
BENCHMARK(hardening_under_a_film)->ArgsProduct({{0, 1}, {0, 101}})->Unit(benchmark::kMicrosecond);

void unhardened_power_law(benchmark::State &state)
{
  RollBite bite          = demo_pass();
  bite.strip.flow_stress = {FlowStressLaw::swift, 28e6, 0.01, 0.2, 0, {}};
  solve(state, bite, {Theory::bland_ford, Arc(state.range(0)), 0});
}
BENCHMARK(unhardened_power_law)->Arg(0)->Arg(1)->Unit(benchmark::kMicrosecond);

void friction_factors(benchmark::State &state)
{
  RollBite bite = factor_pass();
  if (state.range(1))
    bite.strip.flow_stress = {FlowStressLaw::swift, 1.3e9, 0.05, 0.15, 0, {}};
  solve(state, bite, {Theory::hu_ehmann, Arc(state.range(0)), 0});
}
BENCHMARK(friction_factors)->ArgsProduct({{0, 1}, {0, 1}})->Unit(benchmark::kMicrosecond);

void coefficients_of_chatter(benchmark::State &state)
{
  const RollBite bite  = film_pass();
  const BiteState rest = solve_slab(bite, {Theory::bland_ford, Arc::hitchcock});
  for (auto _ : state)
    benchmark::DoNotOptimize(linear_coefficients(bite, rest, Linearisation::implicit).force[0]);
}
BENCHMARK(coefficients_of_chatter)->Unit(benchmark::kMicrosecond);

/// The price of nine derivatives: the same state in plain numbers.
void plain_numbers(benchmark::State &state)
{
  const RollBite bite = film_pass();
  const auto in       = pass_inputs<double>(bite, 0.526);
  double speed        = 13;
  for (auto _ : state)
    benchmark::DoNotOptimize(bland_ford_state(bite, in, speed, hill_rules(bite)).force);
}
BENCHMARK(plain_numbers)->Unit(benchmark::kMicrosecond);

void map_of_ten_thousand(benchmark::State &state)
{
  RollBite bite       = film_pass();
  bite.strip.friction = {};
  const MapAxis reduction{MapQuantity::reduction, Eigen::VectorXd::LinSpaced(100, 0.05, 0.4)};
  const MapAxis friction{MapQuantity::friction, Eigen::VectorXd::LinSpaced(100, 0.01, 0.1)};
  for (auto _ : state)
    benchmark::DoNotOptimize(
        stiffness_map(bite, {Theory::bland_ford, Arc::hitchcock}, reduction, friction, int(state.range(0)))
            .slope(0, 0));
}
BENCHMARK(map_of_ten_thousand)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->UseRealTime();
}  // namespace
