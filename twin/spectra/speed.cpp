#include "twin/spectra/speed.h"
#include "twin/cleaning/spline.h"
#include <algorithm>
#include <cmath>

namespace mill::twin {
namespace {
constexpr double exponent_low = -0.5, exponent_high = 1.5, exponent_step = 0.005;
constexpr double tolerance_of_exponent = 0.1, spans_needed = 5;

// ln of the density between two bins.
double log_level(const Waterfall &map, const Eigen::Index frame, const double frequency)
{
  const double bin = frequency * double(map.L) / map.rate;
  const auto k     = Eigen::Index(bin);
  if (k < 1 || k + 1 >= map.density.rows())
    return std::numeric_limits<double>::quiet_NaN();
  const double tiny = 1e-30, part = bin - double(k);
  return (1 - part) * std::log(double(map.density(k, frame)) + tiny) +
         part * std::log(double(map.density(k + 1, frame)) + tiny);
}
}  // namespace

Eigen::Index frame_length(const double rate)
{
  Eigen::Index L = 256;
  while (double(2 * L) <= 0.9 * rate)
    L *= 2;
  return L;
}

Waterfall waterfall(const Eigen::VectorXd &value, const std::vector<Span> &pieces, const double rate,
                    const Eigen::VectorXd &speed, const Eigen::Index L, const Eigen::Index most, Fourier &fourier)
{
  std::vector<Eigen::Index> starts;
  for (const Span &piece : pieces)
    for (Eigen::Index first = piece.begin; first + L <= piece.end; first += L / 2)
      starts.push_back(first);
  Waterfall map;
  map.rate           = rate;
  map.L              = L;
  const auto n       = Eigen::Index(starts.size());
  const auto group   = std::max<Eigen::Index>(1, (n + most - 1) / std::max<Eigen::Index>(1, most));
  const auto columns = (n + group - 1) / group;
  map.time           = Eigen::VectorXd::Zero(columns);
  map.speed          = Eigen::VectorXd::Zero(speed.size() > 0 ? columns : 0);
  map.density        = Eigen::MatrixXf::Zero(L / 2 + 1, columns);
  for (Eigen::Index i = 0; i < columns; ++i) {
    const Eigen::Index first = i * group, last = std::min(first + group, n);
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(L / 2 + 1);
    for (Eigen::Index k = first; k < last; ++k) {
      const Eigen::Index begin = starts[std::size_t(k)];
      mean += welch(value, {{begin, begin + L}}, rate, L, fourier).density;
      map.time[i] += (double(begin) + double(L) / 2) / rate / double(last - first);
      if (speed.size() > 0)
        map.speed[i] += speed.segment(begin, L).mean() / double(last - first);
    }
    map.density.col(i) = (mean / double(last - first)).cast<float>();
  }
  return map;
}

OverLength over_length(const Eigen::VectorXd &value, const std::vector<Span> &pieces, const Eigen::VectorXd &speed,
                       const double rate)
{
  OverLength result;
  const double still = speed.maxCoeff() / 20;
  std::vector<Span> running;
  double slowest = std::numeric_limits<double>::infinity();
  for (const Span &piece : pieces)
    for (Eigen::Index i = piece.begin; i < piece.end;) {
      Eigen::Index end = i;
      while (end < piece.end && speed[end] > still) {
        slowest = std::min(slowest, speed[end]);
        ++end;
      }
      if (end - i > 256)
        running.push_back({i, end});
      i = std::max(end, i + 1);
    }
  if (running.empty() || !(slowest > 0))
    return result;
  const double step = slowest / rate;
  result.rate       = 1 / step;
  std::vector<Eigen::VectorXd> parts;
  Eigen::Index n = 0;
  for (const Span &piece : running) {
    Eigen::VectorXd s(piece.size());
    s[0] = 0;
    for (Eigen::Index i = 1; i < s.size(); ++i)
      s[i] = s[i - 1] + 0.5 * (speed[piece.begin + i - 1] + speed[piece.begin + i]) / rate;
    const auto m = Eigen::Index(s[s.size() - 1] / step) + 1;
    parts.push_back(spline_on_grid(s, value.segment(piece.begin, piece.size()), 0, step, m));
    result.pieces.push_back({n, n + m});
    n += m;
  }
  if (parts.size() == 1) {  // a long record is not held twice
    result.value = std::move(parts.front());
    return result;
  }
  result.value.resize(n);
  for (std::size_t i = 0; i < parts.size(); ++i)
    result.value.segment(result.pieces[i].begin, parts[i].size()) = parts[i];
  return result;
}

SpeedExponent speed_exponent(const Waterfall &map, const double frequency, const double reference_speed)
{
  std::vector<double> levels;
  double best = -std::numeric_limits<double>::infinity(), best_q = 0;
  for (int i = 0; exponent_low + i * exponent_step <= exponent_high + 1e-9; ++i) {
    const double q = exponent_low + i * exponent_step;
    double sum     = 0;
    int n          = 0;
    for (Eigen::Index frame = 0; frame < map.time.size(); ++frame)
      if (map.speed[frame] > reference_speed / 20)
        if (const double level =
                log_level(map, frame, frequency * std::pow(map.speed[frame] / reference_speed, q));
            std::isfinite(level)) {
          sum += level;
          ++n;
        }
    if (n == 0)
      continue;
    levels.push_back(sum / n);
    if (sum / n > best) {
      best   = sum / n;
      best_q = q;
    }
  }
  if (levels.empty())
    return {std::numeric_limits<double>::quiet_NaN(), 0};
  const auto middle = levels.begin() + std::ptrdiff_t(levels.size() / 2);
  std::nth_element(levels.begin(), middle, levels.end());
  return {best_q, best - *middle};
}

const char *name_of(const Follows follows)
{
  switch (follows) {
  case Follows::fixed:
    return "fixed";
  case Follows::locked:
    return "locked to the speed";
  case Follows::neither:
    return "neither fixed nor locked to the speed";
  case Follows::cannot_tell:
    return "not distinguishable";
  }
  return "";
}

Follows follows_speed(const SpeedExponent &exponent, const double span, const double relative_width)
{
  if (!(span > spans_needed * relative_width) || !std::isfinite(exponent.q))
    return Follows::cannot_tell;
  if (std::abs(exponent.q) <= tolerance_of_exponent)
    return Follows::fixed;
  return std::abs(exponent.q - 1) <= tolerance_of_exponent ? Follows::locked : Follows::neither;
}
}  // namespace mill::twin
