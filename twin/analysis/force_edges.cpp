#include "twin/analysis/findings.h"
#include "twin/records/known_channel.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
constexpr double least_fall = 10;  // of the density, 10 dB

double median_between(const WelchSpectrum &s, const double low, const double high)
{
  const auto first = std::max<Eigen::Index>(1, Eigen::Index(std::ceil(low / s.resolution()))),
             last  = std::min(Eigen::Index(high / s.resolution()), s.density.size() - 1);
  if (last < first + 2)
    return std::nan("");
  std::vector<double> part(s.density.data() + first, s.density.data() + last + 1);
  const auto middle = part.begin() + std::ptrdiff_t(part.size() / 2);
  std::nth_element(part.begin(), middle, part.end());
  return *middle;
}

// Factor by which the density falls at f, within 5 % and also from the third of an octave before to the one
// behind: a resonance of the force falls on both sides.  Above 1 for an upper end, below for a lower one.
double fall_at(const WelchSpectrum &s, const double f)
{
  const double tiny = 1e-300;
  const double near =
      (median_between(s, 0.95 * f, 0.995 * f) + tiny) / (median_between(s, 1.005 * f, 1.05 * f) + tiny);
  const double wide =
      (median_between(s, 0.77 * f, 0.97 * f) + tiny) / (median_between(s, 1.03 * f, 1.3 * f) + tiny);
  if (near > least_fall && wide > least_fall)
    return std::min(near, wide);
  return near < 1 / least_fall && wide < 1 / least_fall ? std::max(near, wide) : 1;
}
// Where the density crosses a tenth of its level on the side of the band; NaN: a flank farther out.
double crossing_near(const WelchSpectrum &s, const double f)
{
  const bool upper = fall_at(s, f) > 1;
  const double level =
      0.1 * (upper ? median_between(s, 0.77 * f, 0.93 * f) : median_between(s, 1.07 * f, 1.3 * f));
  const auto first = Eigen::Index(0.93 * f / s.resolution()),
             last  = std::min(Eigen::Index(1.07 * f / s.resolution()), s.density.size() - 1);
  if (upper) {
    for (Eigen::Index k = last; k > first; --k)
      if (s.density[k] > level)
        return s.at(k);
  } else
    for (Eigen::Index k = first; k < last; ++k)
      if (s.density[k] > level)
        return s.at(k);
  return std::nan("");
}
}  // namespace

bool is_force(const ChannelAnalysis &channel)
{
  return channel.quantity == Quantity::force && channel.name != word_of(KnownChannel::load_cell);
}

std::vector<double> force_edges(const Analysis &analysis)
{
  std::vector<double> edges;
  for (const ChannelAnalysis &channel : analysis.channels) {
    if (!is_force(channel) || channel.spectrum.n == 0)
      continue;
    double best = 0, place = 0;
    const auto add = [&] {
      if (const double edge = crossing_near(channel.spectrum, place); std::isfinite(edge))
        edges.push_back(edge);
      best = place = 0;
    };
    for (double f = 20; f * 1.31 < channel.spectrum.rate / 2; f *= 1.005) {
      const double fall = std::abs(std::log(fall_at(channel.spectrum, f)));
      if (fall > best) {
        best  = fall;
        place = f;
      } else if (place > 0 && f > 1.1 * place)
        add();
    }
    if (place > 0)
      add();
  }
  return edges;
}

bool is_edge(const std::vector<double> &edges, const double frequency, const double damping)
{
  return std::any_of(edges.begin(), edges.end(),
                     [&](const double edge) { return std::abs(edge / frequency - 1) < std::max(0.02, damping); });
}
}  // namespace mill::twin
