#include "twin/modes/force_delay.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
using Complex = std::complex<double>;

constexpr double longest_delay = 0.05;  // s
constexpr double least_phase   = 0.02;  // rad, what damping that is not proportional does to a phase
constexpr double clear_lead    = 0.8;   // of the best: a second delay that fits as well leaves it open

// Phase of one residue relative to that of a real mode, known up to half a turn.
struct Phase {
  double phase, frequency, weight;  // rad, rad/s, 1/rad^2
};

std::vector<Phase> phases_of(const std::vector<ForcedMode> &modes, const int order)
{
  std::vector<Phase> phases;
  for (const ForcedMode &mode : modes) {
    if (!mode.confirmed)
      continue;
    const Complex real_mode = std::pow(mode.pole.lambda, order) / Complex(0, 2 * mode.pole.lambda.imag());
    double sum              = 0;
    Complex direction       = 0;  // of all channels together, twice the angle: half turns do not count
    for (Eigen::Index c = 0; c < mode.pole.residue.size(); ++c) {
      const Complex a = mode.pole.residue[c] / real_mode;
      const double w  = std::norm(mode.pole.residue[c]) / std::pow(mode.pole.sd_residue[c], 2);
      direction += w * a * a / std::max(1e-300, std::norm(a));
      sum += w;
    }
    phases.push_back(
        {0.5 * std::arg(direction), mode.pole.lambda.imag(), 1 / (1 / sum + least_phase * least_phase)});
  }
  return phases;
}

double agreement(const std::vector<Phase> &phases, const double tau)
{
  double sum = 0, all = 0;
  for (const Phase &p : phases) {
    sum += p.weight * std::cos(2 * (p.phase + p.frequency * tau));
    all += p.weight;
  }
  return sum / all;
}
}  // namespace

ForceDelay force_delay(const std::vector<ForcedMode> &modes, const int order)
{
  const auto phases = phases_of(modes, order);
  if (phases.size() < 2)
    return {};
  double highest = 0, information = 0;
  for (const Phase &p : phases) {
    highest = std::max(highest, p.frequency);
    information += p.weight * p.frequency * p.frequency;
  }
  const double step = M_PI / highest / 32;
  double best = -2, second = -2, delay = 0;
  std::vector<double> level;
  for (double tau = -longest_delay; tau <= longest_delay; tau += step)
    level.push_back(agreement(phases, tau));
  for (std::size_t i = 1; i + 1 < level.size(); ++i)
    if (level[i] >= level[i - 1] && level[i] > level[i + 1]) {
      if (level[i] > best) {
        second = best;
        best   = level[i];
        delay  = -longest_delay + step * double(i);
      } else
        second = std::max(second, level[i]);
    }
  if (best < -1)
    return {};
  for (double width = step; width > 1e-10; width /= 2)
    for (const double tried : {delay - width, delay + width})
      if (agreement(phases, tried) > agreement(phases, delay))
        delay = tried;
  return {delay, 1 / std::sqrt(information), best > 0.9 && second < clear_lead * best};
}

void align(ForceResponse &response, const double seconds)
{
  for (Eigen::Index k = 0; k < response.H.rows(); ++k)
    response.H.row(k) *= std::polar(1.0, 2 * M_PI * double(k) * response.resolution() * seconds);
}
}  // namespace mill::twin
