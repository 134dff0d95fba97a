#include "dynamics/chatter/speed.h"
#include "core/base/errors.h"
#include "core/numerics/root_search.h"
#include "dynamics/chatter/excess_growth.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>
#include <utility>

namespace mill::dynamics {
namespace {
struct Sample : SpeedPoint {
  Eigen::VectorXd
      excess;  ///< (s) 1/s, real parts less the noise, falling: rank k is a continuous function of speed
};

std::string reason(const SolverError &error)
{
  const auto &r = error.report;
  return r.what + (r.where.empty() ? "" : ": " + r.where) + (r.cause.empty() ? "" : "; " + r.cause);
}

// Excess of every root with its root, by falling excess.
void rank(Sample &s, const Eigen::VectorXcd &roots)
{
  const double largest = roots.size() ? roots.cwiseAbs().maxCoeff() : 0;
  const auto excess    = [&](const std::complex<double> r) { return excess_growth(r, largest); };
  s.roots              = roots;
  std::sort(s.roots.begin(), s.roots.end(), [&](const auto a, const auto b) {
    return excess(a) != excess(b) ? excess(a) > excess(b) : a.imag() > b.imag();
  });
  s.excess.resize(roots.size());
  for (Eigen::Index i = 0; i < roots.size(); ++i)
    s.excess[i] = excess(s.roots[i]);
  s.unstable = int((s.excess.array() > 0).count());
  if (roots.size() == 0)
    return;
  Eigen::Index leading;
  s.growth    = s.roots.real().maxCoeff(&leading);
  s.frequency = std::abs(s.roots[leading].imag()) / (2 * M_PI);
}

Sample sample(const RootsAtSpeed &roots, const double speed)
{
  Sample s;
  s.speed = speed;
  try {
    rank(s, roots(speed));
  } catch (const InputError &error) {
    s.no_bite = error.problems.empty() ? error.what() : error.problems[0].message;
  } catch (const SolverError &error) {
    s.no_bite = reason(error);
  }
  return s;
}

bool has_bite(const Sample &s)
{
  return s.no_bite.empty();
}

using Samples = std::vector<Sample>;

// Change of rank k over the interval between samples i and i + 1, per m/s; nan: not known.
double slope(const Samples &samples, const std::size_t i, const Eigen::Index k)
{
  const Sample &a = samples[i], &b = samples[i + 1];
  if (!has_bite(a) || !has_bite(b) || k >= std::min(a.excess.size(), b.excess.size()))
    return not_given;
  return (b.excess[k] - a.excess[k]) / (b.speed - a.speed);
}

// Whether a rank may touch zero between two samples unseen: its excess may leave the straight line between them by
// the change of slope to the neighbouring intervals times the length, eight times what a parabola does.
bool may_cross(const Samples &samples, const std::size_t i)
{
  const Sample &a = samples[i], &b = samples[i + 1];
  if (!has_bite(a) || !has_bite(b))
    return false;
  for (Eigen::Index k = 0; k < std::min(a.excess.size(), b.excess.size()); ++k) {
    const double here   = slope(samples, i, k);
    const double before = i > 0 ? slope(samples, i - 1, k) : not_given;
    const double after  = i + 2 < samples.size() ? slope(samples, i + 1, k) : not_given;
    const double turn = std::fmax(std::abs(here - before), std::abs(after - here));  // of a nan and a number: that
    const double bow  = (std::isnan(turn) ? std::abs(here) : turn) * (b.speed - a.speed);
    if (std::min(std::abs(a.excess[k]), std::abs(b.excess[k])) < bow)
      return true;
  }
  return false;
}

void refine(Samples &samples, const RootsAtSpeed &roots, const double finest)
{
  for (bool halved = true; halved;) {
    halved = false;
    Samples next;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      next.push_back(samples[i]);
      if (i + 1 == samples.size() || samples[i + 1].speed - samples[i].speed < 1.5 * finest ||
          !may_cross(samples, i))
        continue;
      next.push_back(sample(roots, 0.5 * (samples[i].speed + samples[i + 1].speed)));
      halved = true;
    }
    samples = std::move(next);
  }
}

// Puts the edges of the range with a bite among the samples: halving between one that has it and one that has not.
// The sample without a bite stays, moved to the edge, so that its reason is that of the edge.
void find_edges(Samples &samples, const RootsAtSpeed &roots)
{
  constexpr double fine = 1e-3;  // m/s, finer than any speed is known
  Samples next;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    next.push_back(samples[i]);
    if (i + 1 == samples.size() || has_bite(samples[i]) == has_bite(samples[i + 1]))
      continue;
    Sample a = samples[i], b = samples[i + 1];
    while (b.speed - a.speed > fine) {
      Sample middle                             = sample(roots, 0.5 * (a.speed + b.speed));
      (has_bite(middle) == has_bite(a) ? a : b) = std::move(middle);
    }
    if (a.speed > samples[i].speed)
      next.push_back(a);
    if (b.speed < samples[i + 1].speed)
      next.push_back(b);
  }
  samples = std::move(next);
}

std::complex<double> nearest(const Eigen::VectorXcd &roots, const std::complex<double> to)
{
  Eigen::Index i;
  (roots.array() - to).abs().minCoeff(&i);
  return roots[i];
}

// Crossing of rank k between two samples.
Crossing solve_crossing(const RootsAtSpeed &roots, const Sample &a, const Sample &b, const Eigen::Index k,
                        const double tolerance)
{
  std::map<double, Sample> tried;
  const auto point = [&](const double speed) -> const Sample & {
    const auto match = tried.find(speed);
    return match != tried.end() ? match->second : tried.emplace(speed, sample(roots, speed)).first->second;
  };
  const auto excess = [&](const double speed) {
    const Sample &s = point(speed);
    return k < s.excess.size() ? s.excess[k] : -1.;  // a list of roots that ends before is one of decaying ones
  };
  Crossing c;
  c.speed = root_between({a.speed, a.excess[k]}, {b.speed, b.excess[k]}, excess, tolerance / b.speed)
                .value_or(0.5 * (a.speed + b.speed));
  c.upward            = b.excess[k] > 0;
  const Sample &there = point(c.speed);
  if (k >= there.roots.size())  // no bite between two speeds with one
    return c;
  // The rank crossed the noise, the root crosses the axis close by: Newton's steps along its own path.
  c.root           = there.roots[k];
  const double d   = std::min(1e-4, 0.25 * (b.speed - a.speed));
  const Sample &up = point(c.speed + d), &down = point(c.speed - d);
  if (up.roots.size() && down.roots.size()) {
    const auto above = nearest(up.roots, c.root), below = nearest(down.roots, c.root);
    c.slope          = (above - below).real() / (2 * d);
    const double far = 0.25 * (b.speed - a.speed);
    for (int i = 0; i < 2; ++i) {
      const double step = -c.root.real() / c.slope;
      if (!(std::abs(step) > tolerance && std::abs(step) < far))
        break;
      const Sample &moved = point(c.speed + step);
      if (moved.roots.size() == 0)
        break;
      c.speed += step;
      c.root = nearest(moved.roots, c.root);
    }
  }
  c.frequency = std::abs(c.root.imag()) / (2 * M_PI);
  return c;
}

std::vector<Crossing> solve_crossings(const Samples &samples, const RootsAtSpeed &roots, const double tolerance)
{
  std::vector<Crossing> crossings;
  for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
    const Sample &a = samples[i], &b = samples[i + 1];
    if (!has_bite(a) || !has_bite(b))
      continue;
    for (Eigen::Index k = std::min(a.unstable, b.unstable); k < std::max(a.unstable, b.unstable); ++k) {
      if (k >= std::min(a.excess.size(), b.excess.size()))
        break;
      crossings.push_back(solve_crossing(roots, a, b, k, tolerance));
      crossings.back().of_stand = k == 0;
      if (crossings.back().root.imag() != 0)
        ++k;  // its conjugate
    }
  }
  std::sort(crossings.begin(), crossings.end(), [](const auto &a, const auto &b) { return a.speed < b.speed; });
  return crossings;
}

// Extreme growth near the sample where it is extreme, by golden sections.  @param sign  1: largest, -1: smallest
Sample extreme_growth(const Samples &samples, const RootsAtSpeed &roots, const double sign, const double fine)
{
  std::size_t best = samples.size();
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (has_bite(samples[i]) && (best == samples.size() || sign * samples[i].growth > sign * samples[best].growth))
      best = i;
  Sample extreme = samples[best];
  if (best == 0 || best + 1 == samples.size() || !has_bite(samples[best - 1]) || !has_bite(samples[best + 1]))
    return extreme;
  double low = samples[best - 1].speed, high = samples[best + 1].speed;
  const double ratio = 0.5 * (3 - std::sqrt(5.));
  while (high - low > fine) {
    const bool right = high - extreme.speed > extreme.speed - low;
    const Sample s   = sample(roots, extreme.speed + ratio * (right ? high - extreme.speed : low - extreme.speed));
    if (!has_bite(s))
      break;
    if (sign * s.growth > sign * extreme.growth) {
      (right ? low : high) = extreme.speed;
      extreme              = s;
    } else
      (right ? high : low) = s.speed;
  }
  return extreme;
}

// The lowest pair of samples, stable and unstable, with nothing but samples without a bite between them.
std::optional<std::pair<std::size_t, std::size_t>> gap_to_growth(const Samples &samples)
{
  std::size_t last = samples.size();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (!has_bite(samples[i]))
      continue;
    if (last + 1 < i && samples[last].unstable == 0 && samples[i].unstable > 0)
      return std::make_pair(last, i);
    last = i;
  }
  return std::nullopt;
}

void judge(CriticalSpeed &result, const Samples &samples, const RootsAtSpeed &roots, const SpeedRange &range)
{
  const auto bite_of = [](const Sample &s) { return has_bite(s); };
  const auto first   = std::find_if(samples.begin(), samples.end(), bite_of);
  if (first == samples.end()) {
    result.below = samples.front().no_bite;
    result.above = samples.back().no_bite;
    return;
  }
  const auto last     = std::find_if(samples.rbegin(), samples.rend(), bite_of);
  result.lowest_bite  = first->speed;
  result.highest_bite = last->speed;
  if (first != samples.begin())
    result.below = std::prev(first)->no_bite;
  if (last != samples.rbegin())
    result.above = std::prev(last)->no_bite;
  const auto upward  = std::find_if(result.crossings.begin(), result.crossings.end(),
                                    [](const Crossing &c) { return c.of_stand && c.upward; });
  const auto gap     = gap_to_growth(samples);
  const bool crosses = upward != result.crossings.end();
  if (gap && !(crosses && upward->speed < samples[gap->first].speed)) {
    result.verdict    = Verdict::unstable_beyond_gap;
    result.gap        = {samples[gap->first].speed, samples[gap->second].speed};
    result.gap_reason = samples[gap->first + 1].no_bite;
    return;
  }
  if (crosses) {
    result.verdict   = Verdict::crossing;
    result.speed     = upward->speed;
    result.frequency = upward->frequency;
    return;
  }
  const auto grows     = [](const Sample &s) { return has_bite(s) && s.unstable > 0; };
  const auto rests     = [](const Sample &s) { return has_bite(s) && s.unstable == 0; };
  const bool some_grow = std::any_of(samples.begin(), samples.end(), grows),
             some_rest = std::any_of(samples.begin(), samples.end(), rests);
  result.verdict       = some_grow && some_rest ? Verdict::unstable_below
                         : some_grow            ? Verdict::unstable
                                                : Verdict::stable;
  if (result.verdict == Verdict::unstable_below)
    return;
  const Sample nearest_to_change = extreme_growth(samples, roots, some_grow ? -1 : 1, 0.01 * range.step);
  result.margin                  = nearest_to_change.growth;
  result.margin_speed            = nearest_to_change.speed;
}

void require(const SpeedRange &r)
{
  if (!(r.from > 0) || !(r.to > r.from) || !std::isfinite(r.to))
    throw InputError(fmt::format(
        "speeds from {:g} to {:g} m/s are not a range; both must be above zero and the second one larger", r.from,
        r.to));
  if (!(r.step > 0) || !(r.finest > 0) || !(r.tolerance > 0))
    throw InputError(fmt::format("steps of {:g} and {:g} m/s and a tolerance of {:g} m/s have to be above zero",
                                 r.step, r.finest, r.tolerance));
}
}  // namespace

CriticalSpeed crossings_of_roots(const RootsAtSpeed &roots, const SpeedRange &range)
{
  require(range);
  Samples samples;
  const int steps = std::max(1, int(std::ceil((range.to - range.from) / range.step - 1e-9)));
  for (int i = 0; i <= steps; ++i)
    samples.push_back(sample(roots, i == steps ? range.to : range.from + i * range.step));
  find_edges(samples, roots);
  refine(samples, roots, range.finest);
  CriticalSpeed result;
  result.crossings = solve_crossings(samples, roots, range.tolerance);
  judge(result, samples, roots, range);
  result.points.assign(samples.begin(), samples.end());
  return result;
}

CriticalSpeed critical_speed(const MatrixAtSpeed &matrix, const SpeedRange &range)
{
  return crossings_of_roots([&](const double speed) { return eigenvalues(matrix(speed)); }, range);
}

MatrixAtSpeed matrix_at_speed(const ChatterStandModel &stand, const bite::RollBite &bite,
                              const Linearisation scheme)
{
  return [=](const double speed) { return chatter_matrix(stand, working_point(bite, speed, scheme).by); };
}

StandSpeed critical_speed(const ChatterStandModel &stand, const bite::RollBite &bite, const Linearisation scheme,
                          const SpeedRange &range)
{
  std::map<double, bite::BiteState> states;
  const auto matrix = [&](const double speed) {
    const WorkingPoint point = working_point(bite, speed, scheme);
    states[speed]            = point.state;
    return chatter_matrix(stand, point.by);
  };
  StandSpeed result;
  static_cast<CriticalSpeed &>(result) = critical_speed(matrix, range);
  for (const SpeedPoint &point : result.points)
    result.states.push_back(states[point.speed]);
  if (result.verdict == Verdict::crossing)
    result.at = working_point(bite, result.speed, scheme);
  return result;
}

std::string sentence(const CriticalSpeed &critical, const SpeedRange &range)
{
  const auto edges = [&] {
    std::string text;
    if (!critical.below.empty())
      text += fmt::format("; no steady bite below {:.2f} m/s", critical.lowest_bite);
    if (!critical.above.empty())
      text += fmt::format("; no steady bite above {:.2f} m/s", critical.highest_bite);
    return text;
  };
  const std::string speeds = fmt::format("from {:.4g} to {:.4g} m/s",
                                         std::isnan(critical.lowest_bite) ? range.from : critical.lowest_bite,
                                         std::isnan(critical.highest_bite) ? range.to : critical.highest_bite);
  switch (critical.verdict) {
  case Verdict::crossing: {
    std::string text = fmt::format("unstable above {:.3f} m/s ({:.1f} Hz)", critical.speed, critical.frequency);
    for (const Crossing &c : critical.crossings)
      if (c.of_stand && c.speed != critical.speed)
        text += fmt::format(", {} above {:.3f} m/s", c.upward ? "unstable again" : "stable", c.speed);
    return text + edges();
  }
  case Verdict::stable:
    return fmt::format("stable {}; the slowest decay is {:.3g} 1/s at {:.4g} m/s", speeds, -critical.margin,
                       critical.margin_speed) +
           edges();
  case Verdict::unstable:
    return fmt::format("unstable {}; the slowest growth is {:.3g} 1/s at {:.4g} m/s", speeds, critical.margin,
                       critical.margin_speed) +
           edges();
  case Verdict::unstable_below: {
    double last = critical.lowest_bite;
    for (const SpeedPoint &point : critical.points)  // where a gap without a bite hides the change
      if (point.unstable > 0)
        last = point.speed;
    for (const Crossing &c : critical.crossings)
      if (c.of_stand)
        last = std::max(last, c.speed);
    return fmt::format("unstable up to {:.3f} m/s and stable above, so that no speed is critical", last) + edges();
  }
  case Verdict::unstable_beyond_gap:
    return fmt::format("stable at {:.3f} m/s and unstable from {:.3f} m/s; the critical speed lies between them, "
                       "where the search has no answer ({})",
                       critical.gap[0], critical.gap[1], critical.gap_reason) +
           edges();
  case Verdict::no_bite:
    return fmt::format("no steady bite from {:.4g} to {:.4g} m/s ({})", range.from, range.to, critical.below);
  }
  return "";
}
}  // namespace mill::dynamics
