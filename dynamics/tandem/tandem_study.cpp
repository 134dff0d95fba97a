#include "core/base/errors.h"
#include "dynamics/tandem/tandem.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

// Which part of the chatter of a tandem comes from where.
namespace mill::dynamics {
namespace {
using Complex = std::complex<double>;

/// Steady states by speed: every search of a study asks for the same ones.
class Points {
public:
  explicit Points(const TandemLine &line) : line_(line) {}
  const TandemPoint &at(const double speed)
  {
    const auto known = points_.find(speed);
    return known != points_.end() ? known->second
                                  : points_.emplace(speed, tandem_point(line_, speed)).first->second;
  }

private:
  const TandemLine &line_;
  std::map<double, TandemPoint> points_;
};

// A root with its conjugate, as crossings_of_roots wants them.
Eigen::VectorXcd pair_of(const Complex root)
{
  if (root.imag() == 0)
    return Eigen::VectorXcd::Constant(1, root);
  Eigen::VectorXcd both(2);
  both << root, std::conj(root);
  return both;
}

TandemCurves curves(const TandemLine &line, Points &points, const Eigen::VectorXd &speeds)
{
  const Eigen::Index stands = Eigen::Index(line.stands.size());
  std::vector<double> with_bite;
  for (const double speed : speeds)
    try {
      points.at(speed);
      with_bite.push_back(speed);
    } catch (const InputError &) {
    } catch (const SolverError &) {  // no steady bite: left out
    }
  const Eigen::Index k = Eigen::Index(with_bite.size());
  TandemCurves c;
  c.speed = Eigen::Map<const Eigen::VectorXd>(with_bite.data(), k);
  c.roll_speed.resize(stands, k);
  c.delay.resize(stands - 1, k);
  c.alone = c.tension = c.full = c.frequency = c.loop_gain = Eigen::VectorXd(k);
  c.unstable.resize(k);
  std::vector<Complex> near;
  for (Eigen::Index j = 0; j < k; ++j) {
    const TandemPoint &point = points.at(with_bite[j]);
    for (Eigen::Index i = 0; i < stands; ++i)
      c.roll_speed(i, j) = point.stands[i].bite.roll_speed;
    for (Eigen::Index i = 0; i + 1 < stands; ++i)
      c.delay(i, j) = point.delay[i];
    c.alone[j] = -INFINITY;
    for (Eigen::Index i = 0; i < stands; ++i)
      c.alone[j] = std::max(c.alone[j], growth_rate(stand_alone(line, point, std::size_t(i))));
    c.tension[j] = growth_rate(tandem_matrix(line, point, TandemCoupling::tension));
    c.full[j] = c.frequency[j] = c.loop_gain[j] = not_given;
    c.unstable[j]                               = -1;
    try {
      const DelaySpectrum spectrum(tandem_system(line, point));
      c.loop_gain[j]     = spectrum.loop_gain();
      const Complex root = spectrum.rightmost(near);
      near               = {root};
      c.full[j]          = root.real();
      c.frequency[j]     = std::abs(root.imag()) / (2 * M_PI);
      c.unstable[j]      = root.real() > 0 ? spectrum.roots_right_of(0) : 0;
    } catch (const InputError &) {   // more stands than the roots are searched for
    } catch (const SolverError &) {  // what was found before stays
    }
  }
  return c;
}

std::vector<TandemShare> shares(const TandemLine &line, const DelayRoot &root)
{
  std::vector<TandemShare> all;
  std::vector<Complex> gap;
  Eigen::Index index = 0;
  for (const TandemStand &stand : line.stands) {
    const Eigen::Index n = stand.structure.n();
    gap.push_back(stand.structure.b.dot(root.shape.segment(index, n)));
    index += 2 * n;
  }
  const Complex largest =
      *std::max_element(gap.begin(), gap.end(), [](auto a, auto b) { return std::abs(a) < std::abs(b); });
  for (std::size_t i = 0; i < gap.size(); ++i)
    all.push_back({line.stands[i].name.empty() ? "stand " + std::to_string(i + 1) : line.stands[i].name,
                   std::abs(gap[i] / largest), std::arg(gap[i] / largest) * 180 / M_PI});
  return all;
}

// Waves on the longest piece of strip between two stands at the full critical speed; zero without one.
double waves_between(const TandemStudy &s)
{
  double most = 0;
  for (const double delay : s.point.delay)
    most = std::max(most, s.full.frequency * delay);
  return most;
}

// What a search found, without the reasons for missing bites, which are the same in all of them.
std::string summary(CriticalSpeed search, const SpeedRange &range)
{
  if (search.verdict == Verdict::no_bite)  // the reason is all that is known
    return sentence(search, range);
  search.below.clear();
  search.above.clear();
  return sentence(search, range);
}

std::vector<std::string> conclusions(const TandemStudy &s, const SpeedRange &range)
{
  std::vector<std::string> text;
  const auto edge = [&](const char *side, const double speed, const std::string &reason) {
    if (!reason.empty())
      text.push_back(fmt::format("No steady rolling {} {:.2f} m/s of the last stand: {}.", side, speed, reason));
  };
  edge("below", s.full.lowest_bite, s.full.below);
  edge("above", s.full.highest_bite, s.full.above);
  for (std::size_t i = 0; i < s.stand.size(); ++i)
    text.push_back(fmt::format("{} alone: {}.", s.names[i], summary(s.stand[i], range)));
  if (s.stand.size() == 1)
    return text;
  text.push_back("Sharing the tension between them: " + summary(s.tension, range) + ".");
  text.push_back("With the waviness that reaches the next stand later: " + summary(s.full, range) + ".");
  if (s.tension.verdict == Verdict::crossing && s.full.verdict == Verdict::crossing)
    text.push_back(fmt::format(
        "The waviness that arrives later (regeneration) moves the critical speed by {:+.2f} m/s ({:+.1f} %).",
        s.full.speed - s.tension.speed, 100 * (s.full.speed / s.tension.speed - 1)));
  if (const auto without = (s.curves.unstable.array() < 0).count(); without > 0)
    text.push_back(fmt::format("At {} of {} speeds the roots with the delay of the strip were not found; their "
                               "growth is left out.",
                               without, s.curves.unstable.size()));
  if (std::isfinite(s.any_delay))
    text.push_back(
        fmt::format("Up to {:.2f} m/s the tandem is stable for any distances between its stands.", s.any_delay));
  if (const double waves = waves_between(s); waves > 0)
    text.push_back(
        fmt::format("At {:.2f} m/s and {:.1f} Hz up to {:.1f} waves lie on the strip between two stands: "
                    "lobes follow each other every {:.2f} m/s.",
                    s.full.speed, s.full.frequency, waves, s.full.speed / waves));
  return text;
}

// The search for the full tandem.  Only the rightmost pair is followed: there are as many roots near the axis as
// waves on the strip, and the tandem as a whole changes where the first of them crosses.
CriticalSpeed search_full(const TandemLine &line, Points &points, const SpeedRange &range)
{
  std::vector<Complex> near;
  return crossings_of_roots(
      [&](const double speed) {
        const Complex root = DelaySpectrum(tandem_system(line, points.at(speed))).rightmost(near);
        near               = {root};
        return pair_of(root);
      },
      range);
}
}  // namespace

TandemStudy tandem_study(const TandemLine &line, const SpeedRange &range, const int n_points)
{
  check_tandem(line);
  Points points(line);
  TandemStudy study;
  for (std::size_t i = 0; i < line.stands.size(); ++i) {
    study.names.push_back(line.stands[i].name.empty() ? "stand " + std::to_string(i + 1) : line.stands[i].name);
    study.stand.push_back(crossings_of_roots(
        [&](const double speed) { return eigenvalues(stand_alone(line, points.at(speed), i)); }, range));
  }
  study.tension = crossings_of_roots(
      [&](const double speed) {
        return eigenvalues(tandem_matrix(line, points.at(speed), TandemCoupling::tension));
      },
      range);
  SpeedRange fine = range;
  fine.step       = std::min(range.step, 0.5);
  study.full      = search_full(line, points, fine);
  if (line.stands.size() > 1) {
    // Stable for any delay as long as the loop gain is below one and the undelayed part is stable.
    const CriticalSpeed safe = crossings_of_roots(
        [&](const double speed) {
          const DelaySpectrum spectrum(tandem_system(line, points.at(speed)));
          Eigen::VectorXcd both(2);
          both << std::log(std::max(spectrum.loop_gain(), 1e-300)), spectrum.poles().real().maxCoeff();
          return both;
        },
        range);
    if (safe.verdict == Verdict::crossing && safe.crossings.front().upward)
      study.any_delay = safe.speed;
    if (safe.verdict == Verdict::unstable_beyond_gap && safe.crossings.empty())
      study.any_delay = safe.gap[0];
  }
  if (study.full.verdict == Verdict::crossing) {
    study.point = points.at(study.full.speed);
    // A lobe that peeps over the axis below the crossing: looked for with eight points per lobe.
    const double lobe = waves_between(study) > 2 ? study.full.speed / waves_between(study) : 0;
    const double from = std::max({range.from, study.full.speed - 8 * lobe,
                                  std::isfinite(study.any_delay) ? study.any_delay - 1e-3 : range.from});
    if (lobe > 0 && from < study.full.speed - 0.1 * lobe) {
      SpeedRange near             = fine;
      near.from                   = from;
      near.to                     = study.full.speed - 1e-6;
      near.step                   = lobe / 8;
      near.finest                 = lobe / 64;
      const CriticalSpeed earlier = search_full(line, points, near);
      if (earlier.verdict == Verdict::crossing) {
        study.full.crossings.insert(study.full.crossings.begin(), earlier.crossings.begin(),
                                    earlier.crossings.end());
        study.full.speed     = earlier.speed;
        study.full.frequency = earlier.frequency;
        study.point          = points.at(study.full.speed);
      }
    }
    try {
      const DelaySpectrum spectrum(tandem_system(line, study.point));
      const DelayRoot top = spectrum.polished(spectrum.rightmost());
      study.critical_root = top.value;
      study.share         = shares(line, top);
    } catch (const SolverError &) {  // the critical speed stands without its shape
    }
    if (lobe > 0)
      study.lobes = curves(line, points,
                           Eigen::VectorXd::LinSpaced(81, std::max(range.from, study.full.speed - 4 * lobe),
                                                      std::min(range.to, study.full.speed + 4 * lobe)));
  }
  study.curves    = curves(line, points, Eigen::VectorXd::LinSpaced(n_points, range.from, range.to));
  study.sentences = conclusions(study, range);
  return study;
}
}  // namespace mill::dynamics
