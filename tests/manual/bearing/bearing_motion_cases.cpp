#include "core/model/case.h"
#include "dynamics/bearing/dynamics.h"
#include "tests/manual/check/verification.h"
#include <algorithm>
#include <cmath>

// A mass on a bearing.  900 kg on some 1e10 N/m, the size of a work roll's end.
namespace mill::verify {
namespace {
using dynamics::BearingOscillator;
using Eigen::Vector2d;
using Eigen::VectorXd;
constexpr double m = 900;  // kg

// F = k (d - clearance)^n
BearingOscillator on_power_law(const double k, const double n, const double clearance)
{
  const VectorXd depth = VectorXd::LinSpaced(6, std::log(1e-6), std::log(1e-3)).array().exp();
  BearingOscillator o;
  o.mass               = m;
  o.curve.clearance    = clearance;
  o.curve.displacement = depth.array() + clearance;
  o.curve.force        = k * depth.array().pow(n);
  o.curve.tangent      = n * k * depth.array().pow(n - 1);
  return o;
}

std::vector<Check> damped()
{
  constexpr double k = 1.5e10, c = 2e5, P = 1e6, f = 400, A = 2e5;
  BearingOscillator o = on_power_law(k, 1, 0);
  o.damping           = c;
  o.mean_load         = {P, 0};
  o.amplitude         = A;
  o.frequency         = f;
  const auto motion   = simulate(o, 0.05, 20e3);
  const double w = 2 * M_PI * f, decay = c / (2 * m), wd = std::sqrt(k / m - decay * decay);
  const double p = k - m * w * w, q = c * w, a = A * p / (p * p + q * q), b = -A * q / (p * p + q * q);
  const double C = -b, D = (-a * w + decay * C) / wd;
  double worst = 0, largest = 0;
  for (Eigen::Index i = 0; i < motion.time.size(); ++i) {
    const double t = motion.time[i];
    const double x = a * std::sin(w * t) + b * std::cos(w * t) +
                     std::exp(-decay * t) * (C * std::cos(wd * t) + D * std::sin(wd * t));
    worst   = std::max(worst, std::abs(motion.position(i, 0) - P / k - x));
    largest = std::max(largest, std::abs(x));
  }
  return {at_most("largest difference from the closed form / amplitude", "-", worst / largest, 1e-6)};
}

std::vector<Check> period()
{
  std::vector<Check> checks;
  for (const double n : {10.0 / 9, 1.5}) {
    const double k = 1e10 * std::pow(1e-5, 1 - n), A = 4e-5, r = 1 / (n + 1);
    const double T = 4 * std::sqrt(m * (n + 1) / (2 * k)) * std::pow(A, (1 - n) / 2) * std::sqrt(M_PI) * r *
                     std::tgamma(r) / std::tgamma(r + 0.5);
    BearingOscillator o    = on_power_law(k, n, 0);
    o.start                = dynamics::BearingState{{A, 0}, Vector2d::Zero()};
    constexpr int quarters = 81;
    const auto motion      = simulate(o, quarters * T / 4 * (1 + 1e-9), 4 / T);
    // 20 1/4 periods after its start the mass passes the middle; its distance from there over its speed is how
    // late.
    const double late = motion.position(quarters, 0) / motion.velocity(quarters, 0);
    checks.push_back(relative(n < 1.2 ? "period, exponent 10/9" : "period, exponent 3/2", "ms",
                              1e3 * T * (1 + late / (quarters * T / 4)), 1e3 * T, 1e-6));
  }
  return checks;
}

std::vector<Check> bouncing()
{
  constexpr double k = 1e10, gap = 5e-5, v = 0.05;
  BearingOscillator o = on_power_law(k, 1, gap);
  o.start             = dynamics::BearingState{Vector2d::Zero(), Vector2d(0.6 * v, 0.8 * v)};
  const double touch = M_PI * std::sqrt(m / k), cycle = 2 * gap / v + touch;
  const auto motion = simulate(o, 10 * cycle, 1000 / cycle);
  double slowest    = v;
  for (Eigen::Index i = 0; i < motion.time.size(); ++i)
    if (motion.force[i] == 0)
      slowest = std::min(slowest, motion.velocity.row(i).norm());
  return {relative("losses and returns of the contact", "-", double(motion.events.size()), 20, 0),
          relative("instant of the last loss", "ms", 1e3 * motion.events.back().time,
                   1e3 * (gap / v + 9 * cycle + touch), 1e-6),
          relative("share of the time without contact", "-", motion.without_contact, 2 * gap / v / cycle, 1e-6),
          relative("lowest speed in free flight", "mm/s", 1e3 * slowest, 1e3 * v, 1e-6),
          at_most("pull of the bearing", "N", -motion.force.minCoeff(), 0)};
}
}  // namespace

std::vector<Case> bearing_motion_cases()
{
  std::vector<Case> cases;
  cases.push_back({"bearing-oscillator", "verification",
                   "A mass of 900 kg on a bearing whose force is proportional to its displacement, 15 GN/m, "
                   "damped to 2.7 %, starts "
                   "at rest under 1 MN and is driven by 200 kN at 400 Hz. Four unknowns, Adams formulas of order "
                   "1 to 12 with an "
                   "error bound of 1e-11 per step, 32 periods.",
                   "closed form of the damped oscillator: free motion and steady state",
                   "acceptance of the issue; 1600 steps of 1e-11 leave some 1e-9", damped});
  cases.push_back({"bearing-period", "verification",
                   "The same mass swings freely and undamped about the middle of a bearing without clearance and "
                   "with a force that "
                   "is a power of the displacement, k |x|^n, for 20 1/4 periods. Four unknowns; the passage "
                   "through the middle "
                   "gives the period.",
                   "integral of dx over the speed: T = 4 sqrt(m (n+1)/(2k)) A^((1-n)/2) sqrt(pi) G(1/(n+1)) / "
                   "((n+1) G(1/(n+1) + 1/2))",
                   "3000 steps of 1e-11; at the middle the slope of the force is zero to the power 1/9 and the "
                   "formulas lose order",
                   period});
  cases.push_back(
      {"bearing-bouncing", "verification",
       "The same mass flies through a radial clearance of 50 um at 50 mm/s and is thrown back by a bearing that "
       "is "
       "linear beyond it, ten times. Four unknowns; loss and return of the contact are found as zeros, and the "
       "formulas start again there.",
       "straight flight of 2 s/v and half a period of the linear spring, pi sqrt(m/k), in turn",
       "20 restarts at 1e-11 each; the count is exact", bouncing});
  return cases;
}
}  // namespace mill::verify
