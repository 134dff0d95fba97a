#include "twin/calibration/force_spectrum.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill::twin {
namespace {
constexpr double knots_an_octave = 3, knot_sd = 3;
}

ForceSpectrum force_spectrum(const double low, const double high)
{
  const double octaves = std::log2(high / low);
  const auto n         = Eigen::Index(std::ceil(knots_an_octave * octaves)) + 1;
  ForceSpectrum spectrum;
  spectrum.knots = Eigen::VectorXd::NullaryExpr(
      n, [&](const Eigen::Index i) { return low * std::exp2(octaves * double(i) / double(n - 1)); });
  return spectrum;
}

std::vector<Unknown> unknowns_of(const ForceSpectrum &spectrum)
{
  std::vector<Unknown> unknowns;
  for (const double knot : spectrum.knots)
    unknowns.push_back({fmt::format("force at {:.4g} Hz", knot), knot_sd, 0});
  return unknowns;
}

BetweenKnots between_knots(const ForceSpectrum &spectrum, const double frequency)
{
  const Eigen::Index n = spectrum.knots.size();
  const double step    = std::log(spectrum.knots[n - 1] / spectrum.knots[0]) / double(n - 1),
               x       = std::clamp(std::log(frequency / spectrum.knots[0]) / step, 0.0, double(n - 1));
  const auto below     = std::min(n - 2, Eigen::Index(x));
  return {below, x - double(below)};
}

double density(const ForceSpectrum &spectrum, const Eigen::VectorXd &at_knots, const double frequency)
{
  const BetweenKnots between = between_knots(spectrum, frequency);
  return spectrum.level *
         std::exp((1 - between.share) * at_knots[between.below] + between.share * at_knots[between.below + 1]);
}
}  // namespace mill::twin
