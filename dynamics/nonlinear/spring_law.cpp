#include "spring_law.h"
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mill::dynamics {
namespace {
constexpr std::size_t n_cells = 1024;

bool increasing(const std::vector<double> &v)
{
  for (std::size_t i = 0; i < v.size(); ++i)
    if (!std::isfinite(v[i]) || !(v[i] > (i == 0 ? 0 : v[i - 1])))
      return false;
  return v.size() >= 2;
}

// Slopes of the natural cubic spline through (x, y): tridiagonal, by elimination.
std::vector<double> spline_slopes(const std::vector<double> &x, const std::vector<double> &y)
{
  const std::size_t n = x.size();
  std::vector<double> diagonal(n), upper(n), right(n), slope(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double before = i > 0 ? 1 / (x[i] - x[i - 1]) : 0, after = i + 1 < n ? 1 / (x[i + 1] - x[i]) : 0;
    diagonal[i] = 2 * (before + after);
    upper[i]    = after;
    right[i]    = 3 * ((i > 0 ? (y[i] - y[i - 1]) * before * before : 0) +
                    (i + 1 < n ? (y[i + 1] - y[i]) * after * after : 0));
    if (i > 0) {
      const double factor = before / diagonal[i - 1];
      diagonal[i] -= factor * upper[i - 1];
      right[i] -= factor * right[i - 1];
    }
  }
  for (std::size_t i = n; i-- > 0;)
    slope[i] = (right[i] - (i + 1 < n ? upper[i] * slope[i + 1] : 0)) / diagonal[i];
  return slope;
}

// Keeps the cubics rising whatever the samples: no slope below zero or above three times that of a neighbouring
// chord it. Source: F. N. Fritsch, R. E. Carlson, SIAM J. Numer. Anal. 17 (1980) 238.
void keep_rising(const std::vector<double> &x, const std::vector<double> &y, std::vector<double> &slope)
{
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const double chord = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
    for (const std::size_t k : {i, i + 1})
      slope[k] = std::min(std::max(slope[k], 0.01 * chord), 3 * chord);
  }
}
}  // namespace

SpringLaw::SpringLaw(const std::vector<double> &load, const std::vector<double> &compression)
{
  if (load.size() != compression.size() || !increasing(load) || !increasing(compression))
    return;
  load_        = load;
  compression_ = compression;
  set_slopes();
  tabulate();
}

void SpringLaw::set_slopes()
{
  std::vector<double> x, y;
  for (std::size_t i = 0; i < load_.size(); ++i) {
    x.push_back(std::log(load_[i]));
    y.push_back(std::log(compression_[i]));
  }
  slope_ = spline_slopes(x, y);
  keep_rising(x, y, slope_);
}

// m, and d compression / d load (m/N), of the samples with the linear spring in series; load between the samples.
double SpringLaw::sampled_compression(const double load, double &slope) const
{
  std::size_t i = 0;
  while (i + 2 < load_.size() && load > load_[i + 1])
    ++i;
  const double span = std::log(load_[i + 1] / load_[i]), t = std::log(load / load_[i]) / span;
  const double rise = std::log(compression_[i + 1] / compression_[i]);
  const double a = span * slope_[i], b = span * slope_[i + 1];
  // Cubic Hermite form about the left end.
  const double c2 = 3 * rise - 2 * a - b, c3 = a + b - 2 * rise;
  const double value = compression_[i] * std::exp(t * (a + t * (c2 + t * c3)));
  const double power = (a + t * (2 * c2 + 3 * t * c3)) / span;
  slope              = value * power / load + compliance_;
  return value + compliance_ * load;
}

SpringLaw SpringLaw::in_series_with(const double compliance) const
{
  SpringLaw both = *this;
  both.compliance_ += compliance;
  both.force_.clear();
  for (std::size_t i = 0; usable() && i <= 8 * load_.size(); ++i) {
    const double load =
        load_.front() * std::pow(load_.back() / load_.front(), double(i) / double(8 * load_.size()));
    double slope = 0;
    if (!(both.sampled_compression(load, slope) > 0 && slope > 0))
      return both;
  }
  if (usable())
    both.tabulate();
  return both;
}

void SpringLaw::tabulate()
{
  double first_slope = 0, last_slope = 0;
  begin_ = sampled_compression(load_.front(), first_slope);
  end_   = sampled_compression(load_.back(), last_slope);
  step_  = (end_ - begin_) / double(n_cells);
  // A spring that softened towards nothing would start with infinite stiffness: a straight line then.
  low_power_  = std::max(1.0, begin_ / (load_.front() * first_slope));
  high_power_ = end_ / (load_.back() * last_slope);
  force_.resize(n_cells + 1);
  stiffness_.resize(n_cells + 1);
  energy_.resize(n_cells + 1);
  energy_[0]  = load_.front() * begin_ / (low_power_ + 1);
  double load = load_.front();
  for (std::size_t i = 0; i <= n_cells; ++i) {
    const double wanted = i == n_cells ? end_ : begin_ + double(i) * step_;
    double low = load_.front(), high = load_.back(), slope = first_slope;
    for (int k = 0; k < 60; ++k) {  // Newton's method in a bracket
      const double error       = sampled_compression(load, slope) - wanted;
      (error > 0 ? high : low) = load;
      double next              = load - error / slope;
      if (!(next >= low && next <= high))
        next = 0.5 * (low + high);
      const bool done = std::abs(next - load) <= 1e-15 * load;
      load            = next;
      if (done)
        break;
    }
    sampled_compression(load, slope);
    force_[i]     = load;
    stiffness_[i] = 1 / slope;
    if (i > 0)
      energy_[i] = energy_[i - 1] + step_ * (force_[i - 1] + force_[i]) / 2 +
                   step_ * step_ * (stiffness_[i - 1] - stiffness_[i]) / 12;
  }
}

SpringForce SpringLaw::at(const double compression) const
{
  if (!(compression > 0))
    return {};
  if (compression < begin_) {
    const double force = force_.front() * std::pow(compression / begin_, low_power_);
    return {force, low_power_ * force / compression};
  }
  if (compression >= end_) {
    const double force = force_.back() * std::pow(compression / end_, high_power_);
    return {force, high_power_ * force / compression};
  }
  const auto i      = std::min(std::size_t((compression - begin_) / step_), n_cells - 1);
  const double t    = (compression - begin_) / step_ - double(i);
  const double rise = force_[i + 1] - force_[i], a = step_ * stiffness_[i], b = step_ * stiffness_[i + 1];
  const double c2 = 3 * rise - 2 * a - b, c3 = a + b - 2 * rise;
  return {force_[i] + t * (a + t * (c2 + t * c3)), (a + t * (2 * c2 + 3 * t * c3)) / step_};
}

double SpringLaw::energy(const double compression) const
{
  if (!(compression > 0))
    return 0;
  if (compression < begin_)
    return at(compression).force * compression / (low_power_ + 1);
  if (compression >= end_)
    return energy_.back() + (at(compression).force * compression - force_.back() * end_) / (high_power_ + 1);
  const auto i      = std::min(std::size_t((compression - begin_) / step_), n_cells - 1);
  const double t    = (compression - begin_) / step_ - double(i);
  const double rise = force_[i + 1] - force_[i], a = step_ * stiffness_[i], b = step_ * stiffness_[i + 1];
  const double c2 = 3 * rise - 2 * a - b, c3 = a + b - 2 * rise;
  return energy_[i] + step_ * t * (force_[i] + t * (a / 2 + t * (c2 / 3 + t * c3 / 4)));
}

double SpringLaw::compression(const double load) const
{
  if (!(load > 0))
    return 0;
  if (load <= force_.front())
    return begin_ * std::pow(load / force_.front(), 1 / low_power_);
  if (load >= force_.back())
    return end_ * std::pow(load / force_.back(), 1 / high_power_);
  const auto above = std::upper_bound(force_.begin(), force_.end(), load);
  double low = begin_ + double(above - force_.begin() - 1) * step_, high = low + step_;
  double where = 0.5 * (low + high);
  for (int k = 0; k < 100; ++k) {
    const SpringForce here           = at(where);
    (here.force > load ? high : low) = where;
    double next                      = where - (here.force - load) / here.stiffness;
    if (!(next >= low && next <= high))
      next = 0.5 * (low + high);
    if (std::abs(next - where) <= 1e-16 * where)
      break;
    where = next;
  }
  return where;
}
}  // namespace mill::dynamics
