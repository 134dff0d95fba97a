#include "app/trace/closed_form_response.h"
#include "app/stages/response/dynamics_stage.h"
#include "core/numerics/gauss.h"
#include "dynamics/response/frequency_response.h"
#include "dynamics/response/mill_model.h"
#include "dynamics/response/modes.h"
#include "dynamics/response/response.h"
#include "dynamics/response/rolling_force.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double g = dynamics::standard_gravity;

std::string name_of_force(const Pass &pass)
{
  if (!pass.force_file.empty())
    return pass.force_file;
  return fmt::format("noise {} {} {} {} {}", pass.synthetic_range[0], pass.synthetic_range[1],
                     pass.synthetic_duration, pass.synthetic_bandwidth, pass.synthetic_seed);
}

// Everything that a response depends on except its force.
std::vector<double> chain_numbers(const LumpedModel &model, const DynamicsSettings &settings)
{
  const bool measured = settings.force_meaning == ForceMeaning::measured;
  std::vector<double> numbers{settings.modal_damping, settings.output_rate,
                              settings.frame == FrameForm::closed ? 1. : 0.,
                              measured                                            ? 0.
                              : settings.force_meaning == ForceMeaning::published ? 1.
                                                                                  : 2.};
  for (const Parameter &mass : model.M)
    numbers.push_back(mass.value);
  for (std::size_t i = 0; i < model.K.size(); ++i)
    numbers.push_back(measured && i == 3 ? 0 : model.K[i].value);
  numbers.push_back(measured || std::isnan(model.C.value) ? 0 : model.C.value);
  return numbers;
}

// Variance of the force per hertz, and how far it reaches.
struct WhiteForce {
  double density;  // N2/Hz
  double reach;    // Hz
};

WhiteForce white_force(const Pass &pass, ClosedFormMemory &memory)
{
  const std::string name = name_of_force(pass);
  const auto known       = memory.white.find(name);
  if (known != memory.white.end())
    return {known->second[0], known->second[1]};
  const auto s      = dynamics::force_statistics(remembered_force(pass, memory));
  const auto &white = memory.white[name] = {s.content > 0 ? s.rms * s.rms / s.content : not_given, s.content};
  return {white[0], white[1]};
}
// g, rms of one mass, from mode to mode with f = f_k + zeta f_k tan(t), which makes a resonance flat.  (24.3)
double white_level(const dynamics::MillModel &chain, const int mass, const WhiteForce &force, const double damping)
{
  static const GaussRule rule = gauss_legendre(48);
  const auto modes            = dynamics::modes(chain);
  std::vector<double> peaks;  // of the modes in which this mass moves; the other half of the stand is not included
  for (Eigen::Index k = 0; k < modes.frequency.size(); ++k)
    if (modes.kinetic_share(k, mass) > 1e-12)
      peaks.push_back(modes.frequency[k]);
  double variance = 0, from = 0;
  for (std::size_t k = 0; k < peaks.size() && from < force.reach; ++k) {
    const double to = k + 1 == peaks.size() ? force.reach : std::min(force.reach, (peaks[k] + peaks[k + 1]) / 2);
    const double width = damping * peaks[k];
    const double begin = std::atan((from - peaks[k]) / width), end = std::atan((to - peaks[k]) / width);
    const Eigen::VectorXd t = ((begin + end) / 2 + (end - begin) / 2 * rule.node.array()).matrix();
    const auto H = dynamics::frequency_response(chain, (peaks[k] + width * t.array().tan()).matrix()).acceleration;
    for (Eigen::Index i = 0; i < t.size(); ++i)
      variance += force.density * std::norm(H(i, mass)) * (end - begin) / 2 * rule.weight[i] * width /
                  std::pow(std::cos(t[i]), 2);
    from = to;
  }
  return std::sqrt(variance) / g;
}
}  // namespace

const ForceRecord &remembered_force(const Pass &pass, ClosedFormMemory &memory)
{
  const std::string name = name_of_force(pass);
  const auto known       = memory.forces.find(name);
  return known != memory.forces.end() ? known->second : memory.forces.emplace(name, force_of(pass)).first->second;
}

std::array<double, 4> driven_levels(const LumpedModel &model, const DynamicsSettings &settings, const Pass &pass,
                                    ClosedFormMemory &memory)
{
  const auto key   = std::pair(name_of_force(pass), chain_numbers(model, settings));
  const auto known = memory.driven.find(key);
  if (known != memory.driven.end())
    return known->second;
  const auto response       = dynamics::mill_response(dynamics::mill_model(model, settings),
                                                      remembered_force(pass, memory), settings.output_rate);
  const auto upper          = dynamics::level(response.acceleration.col(dynamics::upper_work_roll));
  const auto lower          = dynamics::level(response.acceleration.col(dynamics::lower_work_roll));
  return memory.driven[key] = {upper.peak / g, upper.rms / g, lower.peak / g, lower.rms / g};
}

std::array<double, 2> white_levels(const LumpedModel &model, const DynamicsSettings &settings, const Pass &pass,
                                   ClosedFormMemory &memory)
{
  const WhiteForce force = white_force(pass, memory);
  const auto chain       = dynamics::mill_model(model, settings);
  if (std::isnan(force.density) || !(settings.modal_damping > 0))
    return {not_given, not_given};
  return {white_level(chain, dynamics::upper_work_roll, force, settings.modal_damping),
          white_level(chain, dynamics::lower_work_roll, force, settings.modal_damping)};
}
}  // namespace mill
