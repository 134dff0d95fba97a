#include "twin/cleaning/time_grid.h"
#include "core/base/input_file.h"
#include "twin/records/sampling_rate.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double least_jitter = 0.02, most_jitter = 0.5;  // samples
constexpr double most_doubled             = 0.01;         // share of the samples
constexpr Eigen::Index most_sampled_steps = 1 << 20;      // the median is taken of

[[noreturn]] void too_coarse(const RawRecord &record, const std::string &why)
{
  throw InputError(record.time_place, "the time column is too coarse, " + why + "; give --rate");
}

}  // namespace

double median_step(const RawRecord &record)
{
  const Eigen::Index n = record.time.size() - 1, stride = std::max<Eigen::Index>(1, n / most_sampled_steps);
  std::vector<double> steps;
  for (Eigen::Index i = 0; i < n; i += stride)
    steps.push_back(record.time[i + 1] - record.time[i]);
  const auto middle = steps.begin() + std::ptrdiff_t(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

namespace {

// Line t = offset + k / rate through all samples that count; jitter about it.
void fit_line(TimeGrid &grid, const Eigen::VectorXd &time)
{
  double n = 0, mean_k = 0, mean_t = 0, kk = 0, kt = 0;
  for (Eigen::Index i = 0; i < time.size(); ++i) {
    const Eigen::Index k = grid.position[std::size_t(i)];
    if (k < 0)
      continue;
    n += 1;
    const double dk = double(k) - mean_k, dt = time[i] - mean_t;
    mean_k += dk / n;
    mean_t += dt / n;
    kk += dk * (double(k) - mean_k);
    kt += dk * (time[i] - mean_t);
  }
  const double step = kt / kk;
  grid.rate         = 1 / step;
  grid.offset       = mean_t - step * mean_k;
  double squares    = 0;
  for (Eigen::Index i = 0; i < time.size(); ++i)
    if (const Eigen::Index k = grid.position[std::size_t(i)]; k >= 0) {
      const double away = time[i] - grid.offset - step * double(k);
      squares += away * away;
    }
  grid.jitter = std::sqrt(squares / n);
}
}  // namespace

TimeGrid time_grid(const RawRecord &record)
{
  TimeGrid grid;
  grid.n = record.n_samples();
  if (record.time.size() == 0) {
    grid.rate = record.rate;
    return grid;
  }
  const double step = median_step(record);
  if (!(step > 0))
    too_coarse(record, "most samples have the time of their neighbour");
  require_possible_rate(1 / step, record.file);
  const double length = (record.time[grid.n - 1] - record.time[0]) / step;
  require_memory(record.file, 8.0 * double(grid.n), 8.0 * length * double(record.channels.size() + 1));
  grid.position.resize(std::size_t(grid.n));
  Eigen::Index k   = 0;
  grid.position[0] = 0;
  bool gap         = false;
  for (Eigen::Index i = 1; i < grid.n; ++i) {
    const auto steps = Eigen::Index(std::llround((record.time[i] - record.time[i - 1]) / step));
    k += steps;
    gap = gap || steps != 1;
    grid.doubled += steps == 0;
    grid.position[std::size_t(i)] = steps == 0 ? -1 : k;
  }
  if (double(grid.doubled) > most_doubled * double(grid.n))
    too_coarse(record, fmt::format("{} of {} samples have the time of their neighbour", grid.doubled, grid.n));
  grid.n = k + 1;
  fit_line(grid, record.time);
  const double jitter = grid.jitter * grid.rate;
  if (jitter > most_jitter)
    too_coarse(record, fmt::format("samples are {:.2g} steps away from an even grid", jitter));
  grid.uneven = jitter >= least_jitter;
  if (!gap && !grid.uneven)
    grid.position = {};
  return grid;
}
}  // namespace mill::twin
