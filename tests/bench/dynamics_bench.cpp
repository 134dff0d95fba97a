// Timing of the lumped model.  Goal: 10 s of force at 20 kHz through six masses in at most 0.1 s.
#include "dynamics/response/response.h"
#include "dynamics/response/rolling_force.h"
#include "dynamics/response/spectrum.h"
#include <benchmark/benchmark.h>

using namespace mill;
using namespace mill::dynamics;

namespace {
// Published masses and frame, line contacts between the rolls.
MillModel stand()
{
  LumpedModel lumped;
  const double M[] = {9321.943, 59716.884, 1888.705, 3094.684, 42200.563, 4663.290};
  const double K[] = {6.3086e9, 1.0233e10, 4.0192e10, 0, 4.0192e10, 2.9301e10, 6.8789e9};
  for (std::size_t i = 0; i < 6; ++i)
    lumped.M[i].value = M[i];
  for (std::size_t i = 0; i < 7; ++i)
    lumped.K[i].value = K[i];
  return mill_model(lumped, DynamicsSettings{});
}

ForceRecord ten_seconds(const double rate)
{
  NoiseSettings settings;
  settings.range = {972898, 979537};
  settings.rate  = rate;
  return synthetic_force(settings);
}

// Every other sample a tenth of the spacing late: no common grid with the outputs.
ForceRecord uneven(ForceRecord record)
{
  const double late = 0.1 * record.time[1];
  for (Eigen::Index i = 1; i + 1 < record.time.size(); i += 2)
    record.time[i] += late;
  return record;
}

void ten_seconds_modal(benchmark::State &state)
{
  const MillModel model   = stand();
  const ForceRecord force = ten_seconds(double(state.range(0)));
  for (auto _ : state)
    benchmark::DoNotOptimize(mill_response(model, force, 20e3).acceleration(1, upper_work_roll));
}
BENCHMARK(ten_seconds_modal)->Arg(10000)->Arg(20000)->Unit(benchmark::kMillisecond);

void ten_seconds_matrix_exponential(benchmark::State &state)
{
  const MillModel model   = stand();
  const ForceRecord force = ten_seconds(10e3);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        mill_response(model, force, 20e3, HoldForm::matrix_exponential).acceleration(1, upper_work_roll));
}
BENCHMARK(ten_seconds_matrix_exponential)->Unit(benchmark::kMillisecond);

void ten_seconds_uneven_samples(benchmark::State &state)
{
  const MillModel model   = stand();
  const ForceRecord force = uneven(ten_seconds(10e3));
  for (auto _ : state)
    benchmark::DoNotOptimize(mill_response(model, force, 20e3).acceleration(1, upper_work_roll));
}
BENCHMARK(ten_seconds_uneven_samples)->Unit(benchmark::kMillisecond);

void synthetic_record(benchmark::State &state)
{
  for (auto _ : state)
    benchmark::DoNotOptimize(ten_seconds(10e3).force[0]);
}
BENCHMARK(synthetic_record)->Unit(benchmark::kMillisecond);

void spectrum_of_a_response(benchmark::State &state)
{
  const Eigen::VectorXd signal = mill_response(stand(), ten_seconds(10e3), 20e3).acceleration.col(upper_work_roll);
  for (auto _ : state)
    benchmark::DoNotOptimize(amplitude_spectral_density(signal, 20e3).density[1]);
}
BENCHMARK(spectrum_of_a_response)->Unit(benchmark::kMillisecond);
}  // namespace
