#include "twin/advice/tuned_damper.h"
#include "core/base/require.h"
#include <algorithm>
#include <cmath>
#include <functional>

namespace mill::twin {
namespace {
using Point = Eigen::Vector2d;

constexpr double widest_frequency = 1.5;  // factor on the starting frequency, both ways
constexpr double least_ratio = 1e-3, most_ratio = 2;
constexpr int detunings          = 21;  // from -10 to +10 %
constexpr double widest_detuning = 0.10;

struct Vertex {
  Point corner;
  double value;
};

// Simplex search of J. A. Nelder and R. Mead, Computer J. 7 (1965) 308, in two unknowns.
Vertex least(const std::function<double(const Point &)> &f, const Point &start, const double size)
{
  const auto vertex = [&](const Point &point) { return Vertex{point, f(point)}; };
  std::array<Vertex, 3> s{vertex(start), vertex(start + Point(size, 0)), vertex(start + Point(0, size))};
  const auto by_value = [](const Vertex &a, const Vertex &b) { return a.value < b.value; };
  for (int i = 0; i < 200; ++i) {
    std::sort(s.begin(), s.end(), by_value);
    if (std::max((s[2].corner - s[0].corner).norm(), (s[1].corner - s[0].corner).norm()) < 1e-5)
      break;
    const Point middle     = 0.5 * (s[0].corner + s[1].corner);
    const Vertex reflected = vertex(2 * middle - s[2].corner);
    if (reflected.value < s[0].value) {
      const Vertex farther = vertex(3 * middle - 2 * s[2].corner);
      s[2]                 = farther.value < reflected.value ? farther : reflected;
    } else if (reflected.value < s[1].value)
      s[2] = reflected;
    else {
      const Vertex nearer =
          vertex(reflected.value < s[2].value ? 0.5 * (middle + reflected.corner) : 0.5 * (middle + s[2].corner));
      if (nearer.value < std::min(reflected.value, s[2].value))
        s[2] = nearer;
      else
        for (int j : {1, 2})
          s[std::size_t(j)] = vertex(0.5 * (s[0].corner + s[std::size_t(j)].corner));
    }
  }
  std::sort(s.begin(), s.end(), by_value);
  return s[0];
}
}  // namespace

double TunedDamper::detuned_by(const double by) const
{
  Eigen::Index nearest = 0;
  (detuning.array() - by).abs().minCoeff(&nearest);
  return detuned_change[nearest];
}

int leading_mode(const VibratingStand &stand, const int seen, const int place, const ForceBand &force)
{
  const Eigen::Index n  = stand.frequency.size();
  Eigen::VectorXd share = Eigen::VectorXd::Zero(n);
  const double most     = stand.point.row(place).cwiseAbs().maxCoeff();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (std::abs(stand.point(place, i)) < 1e-3 * most)
      continue;  // it stands still where the damper would sit
    const double natural = stand.frequency[i];
    for (Eigen::Index k = 0; k < force.frequency.size(); ++k) {
      const double w = 2 * M_PI * force.frequency[k];
      share[i] += force.square[k] * std::pow(w, 4) /
                  (std::pow((natural - w) * (natural + w), 2) + std::pow(2 * stand.damping[i] * natural * w, 2));
    }
    share[i] *= std::pow(stand.point(seen, i) * stand.force[i], 2);
  }
  Eigen::Index first = 0;
  if (!(share.maxCoeff(&first) > 0))  // nothing that moves the damper moves the place: any mode that it can feel
    stand.point.row(place).cwiseAbs().maxCoeff(&first);
  return int(first);
}

double effective_mass(const VibratingStand &stand, const int mode, const int place)
{
  return 1 / std::pow(stand.point(place, mode), 2);
}

Attachment closed_tuning(const VibratingStand &stand, const int mode, const int place, const double mu)
{
  require(mu > 0, "a tuned damper needs a mass above zero");
  Attachment a;
  a.to        = place;
  a.mass      = mu * effective_mass(stand, mode, place);
  a.frequency = stand.frequency[mode] / (2 * M_PI) * std::sqrt(1 + mu / 2) / (1 + mu);
  a.ratio     = std::sqrt(mu * (1 + 0.75 * mu) / (4 * (1 + mu) * (1 + mu / 2)));
  return a;
}

TunedDamper tune(const VibratingStand &stand, const std::vector<Attachment> &joined, const int seen,
                 const Attachment &start, const ForceBand &force, const double level)
{
  TunedDamper t;
  t.start = t.best = start;
  const TunedLevel of(stand, joined, seen, start.to, force);
  t.start_change       = of(start) / level - 1;
  const double low_f   = std::log(start.frequency / widest_frequency),
               high_f  = std::log(start.frequency * widest_frequency);
  const auto damper_of = [&](const Point &p) {
    Attachment a = start;
    a.frequency  = std::exp(p[0]);
    a.ratio      = std::exp(p[1]);
    return a;
  };
  const auto inside = [&](const Point &p) {
    return p[0] >= low_f && p[0] <= high_f && p[1] >= std::log(least_ratio) && p[1] <= std::log(most_ratio);
  };
  // Outside of the range the level of its edge, a little worse with the distance.
  const auto f = [&](const Point &p) {
    const Point q(std::clamp(p[0], low_f, high_f), std::clamp(p[1], std::log(least_ratio), std::log(most_ratio)));
    return of(damper_of(q)) * (1 + (p - q).norm());
  };
  Point best{std::log(start.frequency), std::log(start.ratio)};
  for (const double size : {0.1, 0.01})  // the second search starts again, since the simplex may have collapsed
    best = least(f, best, size).corner;
  t.inside = inside(best) && best[0] > low_f + 1e-3 && best[0] < high_f - 1e-3;
  t.best   = damper_of(
        {std::clamp(best[0], low_f, high_f), std::clamp(best[1], std::log(least_ratio), std::log(most_ratio))});
  t.change   = of(t.best) / level - 1;
  t.detuning = Eigen::VectorXd::LinSpaced(detunings, -widest_detuning, widest_detuning);
  t.detuned_change.resize(detunings);
  for (Eigen::Index i = 0; i < detunings; ++i) {
    Attachment off = t.best;
    off.frequency *= 1 + t.detuning[i];
    t.detuned_change[i] = of(off) / level - 1;
  }
  return t;
}
}  // namespace mill::twin
