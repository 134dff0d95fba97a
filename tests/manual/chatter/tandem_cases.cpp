#include "core/model/case.h"
#include "dynamics/tandem/delay.h"
#include "dynamics/tandem/tandem.h"
#include "tests/manual/bite/slab_models.h"
#include "tests/manual/chatter/models.h"
#include "tests/manual/check/verification.h"
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

// Several stands with the delay of the strip between them, and delay systems whose roots are known.
namespace mill::verify {
namespace {
using namespace dynamics;
using Complex = std::complex<double>;
using Roots   = std::vector<Complex>;

// s + a + b exp(-s delay) = 0
DelaySystem scalar(const double a, const double b, const double delay)
{
  const auto one = [](const double x) { return Eigen::MatrixXd::Constant(1, 1, x); };
  return {one(-a), one(-b), one(1), Eigen::VectorXd::Constant(1, delay)};
}

// Largest distance of a root of one list to the nearest of the other, relative to its modulus.
double apart(const Roots &from, const Roots &to)
{
  double largest = 0;
  for (const Complex &a : from) {
    double nearest = INFINITY;
    for (const Complex &b : to)
      nearest = std::min(nearest, std::abs(a - b));
    largest = std::max(largest, nearest / (1 + std::abs(a)));
  }
  return largest;
}

Roots right_of(const Eigen::VectorXcd &values, const double c, const double limit = INFINITY)
{
  Roots list;
  for (const Complex &s : values)
    if (s.real() > c && std::abs(s.imag()) <= limit)
      list.push_back(s);
  return list;
}

// Branch k of Lambert's W at a real argument by Halley's method.
Complex lambert(const int k, const double x)
{
  const Complex l1 = std::log(Complex(x)) + Complex(0, 2 * M_PI * k);
  Complex w        = std::abs(l1) > 1 ? l1 - std::log(l1) : l1;
  for (int i = 0; i < 60; ++i) {
    const Complex e = std::exp(w), f = w * e - x;
    w -= f / (e * (w + 1.) - (w + 2.) * f / (2. * w + 2.));
  }
  return w;
}

// Stand D twice: condition 2 (0.789 to 0.577 mm) and a pass to 0.44 mm behind it.
TandemLine tandem_of_two(const double distance = 4.95)
{
  const ChatterStandModel stand = chatter_stand("D");
  TandemLine line;
  bite::RollBite first = film_bite(2, 18.2), second = first;
  second.strip.entry_thickness = first.strip.exit_thickness;
  second.strip.exit_thickness  = 0.44e-3;
  second.strip.entry_tension   = first.strip.exit_tension;
  second.strip.exit_tension    = 150e6;
  line.stands         = {{"first stand", stand.structure, first}, {"second stand", stand.structure, second}};
  line.distance       = {distance};
  line.entry_distance = line.exit_distance = 4.95;
  return line;
}

std::vector<Check> one_stand()
{
  TandemLine line = tandem_of_two();
  line.stands.pop_back();
  line.distance.clear();
  const TandemPoint point = tandem_point(line, 18.2);
  const DelaySpectrum spectrum(tandem_system(line, point));
  const ChatterStandModel alone = chatter_stand("D");
  const Eigen::VectorXcd known  = eigenvalues(chatter_matrix(alone, point.stands[0].by));
  const Roots here              = spectrum.roots(-1e5, 1e6), there(known.begin(), known.end());
  return {relative("roots", "-", double(here.size()), 14, 0),
          at_most("largest distance to an eigenvalue of the stand", "-", apart(here, there), 1e-10),
          at_most("and back", "-", apart(there, here), 1e-10),
          {"growth", "1/s", spectrum.rightmost().real(), -0.0254, 5e-5, Judged::absolute},
          {"frequency", "Hz", spectrum.rightmost().imag() / (2 * M_PI), 128.1174, 5e-5, Judged::absolute}};
}

std::vector<Check> lambert_roots()
{
  std::vector<Check> checks;
  for (const auto &[a, b, delay] :
       {std::array<double, 3>{1, 3, 0.5}, std::array<double, 3>{1, 3, 20}, std::array<double, 3>{5, -2, 1}}) {
    const double c = -3 / delay;
    Roots known;
    for (int k = -400; k <= 400; ++k)
      if (const Complex s = -a + lambert(k, -b * delay * std::exp(a * delay)) / delay;
          s.real() > c && std::abs(s.imag()) < 1000 && (known.empty() || apart({s}, known) > 1e-9))
        known.push_back(s);
    const DelaySpectrum spectrum(scalar(a, b, delay));
    const Roots all_roots  = spectrum.roots(c, 1000);
    const std::string name = fmt::format("a {:g}, b {:g}, delay {:g} s: ", a, b, delay);
    checks.push_back(relative(name + "roots found", "-", double(all_roots.size()), double(known.size()), 0));
    checks.push_back(relative(name + "roots counted", "-", spectrum.roots_right_of(c), double(known.size()), 0));
    checks.push_back(at_most(name + "largest distance", "-", apart(known, all_roots), 1e-12));
    double right = -INFINITY;
    for (const Complex &s : known)
      right = std::max(right, s.real());
    checks.push_back({name + "rightmost", "1/s", spectrum.rightmost().real(), right, 1e-12, Judged::absolute});
  }
  return checks;
}

std::vector<Check> hayes_boundary()
{
  double off = 0, turned = 0, inside = 0, outside = 0;
  int places = 0;
  for (double w = 0.1; w < 3.1; w += 0.2, ++places) {
    const double a = -w / std::tan(w), b = w / std::sin(w);
    const Complex s = DelaySpectrum(scalar(a, b, 1)).rightmost();
    off             = std::max(off, std::abs(s.real()));
    turned          = std::max(turned, std::abs(s.imag() - w));
    inside += DelaySpectrum(scalar(a, b - 1e-3, 1)).roots_right_of(0);
    outside += DelaySpectrum(scalar(a, b + 1e-3, 1)).roots_right_of(0);
  }
  return {at_most("distance of the rightmost root from the axis", "1/s", off, 1e-12),
          at_most("deviation of its frequency", "rad/s", turned, 1e-12),
          relative("growing roots inside, sum", "-", inside, 0, 0),
          relative("growing roots outside, sum", "-", outside, 2. * places, 0)};
}

std::vector<Check> no_feedback()
{
  const TandemLine line   = tandem_of_two();
  const TandemPoint point = tandem_point(line, 20);
  DelaySystem system      = tandem_system(line, point);
  const Eigen::MatrixXd A = system.A;
  system.U.setZero();
  const Eigen::VectorXcd tension = eigenvalues(A);
  const Roots without            = DelaySpectrum(system).roots(-60, 1e4);
  // The stands in blocks, each with tensions of its own; the waviness reaches the second one.
  DelaySystem cascade          = {tandem_matrix(line, point, TandemCoupling::alone), Eigen::MatrixXd::Zero(28, 1),
                                  Eigen::MatrixXd::Zero(28, 1), system.delay};
  const auto &by               = point.stands[1].by;
  const auto &stand            = line.stands[1].structure;
  cascade.U.block(20, 0, 6, 1) = by.force[4] * stand.M.inverse() * stand.b;
  cascade.U(26, 0)             = line.strip_modulus / line.distance[0] * by.entry_speed[4];
  cascade.U(27, 0)             = -line.strip_modulus / line.exit_distance * by.exit_speed[4];
  cascade.W.block(0, 0, 6, 1)  = stand.b;
  const DelaySpectrum late(cascade);
  Roots alone;
  for (const std::size_t i : {0, 1})
    for (const Complex &s : right_of(eigenvalues(stand_alone(line, point, i)), -60))
      alone.push_back(s);
  const Roots all_roots = late.roots(-60, 1e4);
  return {
      at_most("no waviness: distance to the eigenvalues with shared tension", "-",
              std::max(apart(without, right_of(tension, -60)), apart(right_of(tension, -60), without)), 1e-10),
      relative("waviness without shared tension: roots", "-", double(all_roots.size()), double(alone.size()), 0),
      at_most("their distance to the roots of single stands", "-",
              std::max(apart(all_roots, alone), apart(alone, all_roots)), 1e-10),
      relative("growing ones", "-", late.roots_right_of(0),
               double(std::count_if(alone.begin(), alone.end(), [](auto s) { return s.real() > 0; })), 0)};
}

std::vector<Check> no_delay()
{
  const TandemLine line = tandem_of_two();
  DelaySystem system    = tandem_system(line, tandem_point(line, 16));
  const Roots known     = right_of(eigenvalues(without_delay(system)), -100);
  system.delay[0]       = 0;
  const Roots undelayed = DelaySpectrum(system).roots(-100, 1e5);
  const Complex fast    = DelaySpectrum(system).rightmost();
  system.delay[0]       = 1e-7;
  const Complex slow    = DelaySpectrum(system).rightmost();
  system.delay[0]       = 2e-7;
  const Complex slower  = DelaySpectrum(system).rightmost();
  return {relative("roots", "-", double(undelayed.size()), double(known.size()), 0),
          at_most("largest distance to the eigenvalues of A + U W^T", "-",
                  std::max(apart(undelayed, known), apart(known, undelayed)), 1e-10),
          relative("shift by 0.2 us over that by 0.1 us", "-", std::abs(slower - fast) / std::abs(slow - fast), 2,
                   1e-3)};
}

// Eigenvalues of the system with the delayed signal discretised along the strip: Chebyshev's points 0..N from
// -delay to 0, at which its derivative along the strip is its derivative in time.
Eigen::VectorXcd collocated(const DelaySystem &system, const int N)
{
  const Eigen::Index n = system.A.rows();
  Eigen::VectorXd x(N + 1), c(N + 1);
  for (int i = 0; i <= N; ++i) {
    x[i] = 0.5 * system.delay[0] * (std::cos(M_PI * i / N) - 1);
    c[i] = (i == 0 || i == N ? 2 : 1) * (i % 2 ? -1 : 1);
  }
  Eigen::MatrixXd D(N + 1, N + 1);
  for (int i = 0; i <= N; ++i) {
    double sum = 0;
    for (int j = 0; j <= N; ++j)
      if (i != j)
        sum += D(i, j) = c[i] / (c[j] * (x[i] - x[j]));
    D(i, i) = -sum;
  }
  Eigen::MatrixXd all           = Eigen::MatrixXd::Zero(n + N, n + N);
  all.topLeftCorner(n, n)       = system.A;
  all.block(0, n + N - 1, n, 1) = system.U;
  all.block(n, 0, N, n)         = D.block(1, 0, N, 1) * system.W.transpose();
  all.block(n, n, N, N)         = D.block(1, 1, N, N);
  return eigenvalues(all);
}

std::vector<Check> collocation()
{
  const TandemLine line    = tandem_of_two(0.8);
  const DelaySystem system = tandem_system(line, tandem_point(line, 16));
  const double limit = 2 * M_PI * 180, c = -30;
  const Roots known = right_of(collocated(system, 140), c, limit);
  const DelaySpectrum spectrum(system);
  const Roots all_roots = spectrum.roots(c, limit);
  return {relative("roots", "-", double(all_roots.size()), double(known.size()), 0),
          at_most("largest distance to the collocated ones", "-",
                  std::max(apart(all_roots, known), apart(known, all_roots)), 1e-9),
          {"growth", "1/s", spectrum.rightmost().real(), known[0].real(), 1e-6, Judged::absolute}};
}

std::vector<Check> counting()
{
  const TandemLine line = tandem_of_two();
  std::vector<Check> checks;
  for (const double speed : {12., 16., 20., 24.}) {
    const DelaySpectrum spectrum(tandem_system(line, tandem_point(line, speed)));
    const Roots all_roots = spectrum.roots(-3, 1e5);
    double residual       = 0;
    for (const Complex &s : all_roots)
      residual = std::max(residual, spectrum.polished(s).residual);
    const std::string name = std::to_string(int(speed)) + " m/s: ";
    checks.push_back(relative(name + "roots right of -3 1/s found", "-", double(all_roots.size()),
                              spectrum.roots_right_of(-3), 0));
    checks.push_back(at_most(name + "largest residual", "-", residual, 1e-14));
    checks.push_back(relative(name + "roots right of the rightmost", "-",
                              spectrum.roots_right_of(spectrum.rightmost().real() + 1e-6), 0, 0));
  }
  return checks;
}

// Growth and frequency of a record that is one decaying or growing vibration: y_{i+q} + y_{i-q} e = d y_i.
Complex vibration(const Eigen::VectorXd &y, const double step, const Eigen::Index q)
{
  const Eigen::Index k = y.size() - 2 * q;
  Eigen::MatrixXd past(k, 2);
  past << y.segment(q, k), -y.head(k);
  const Eigen::VectorXd fit = past.colPivHouseholderQr().solve(y.tail(k));
  const double growth       = 0.5 * std::log(fit[1]) / (double(q) * step);
  return {growth, std::acos(0.5 * fit[0] / std::sqrt(fit[1])) / (double(q) * step)};
}

std::vector<Check> motion()
{
  const TandemLine line    = tandem_of_two();
  const TandemPoint point  = tandem_point(line, 24);
  const DelaySystem system = tandem_system(line, point);
  const DelaySpectrum spectrum(system);
  const DelayRoot root = spectrum.polished(spectrum.rightmost());
  Eigen::VectorXd kick = Eigen::VectorXd::Zero(27);
  kick[2] = kick[3] = kick[14] = kick[15] = 1e-7;
  const DelayMotion free                  = delay_motion(system, kick, 1.2, 1e-4);
  const double step                       = free.time[1];
  const Eigen::VectorXd gap               = free.state.row(14) + free.state.row(15);
  const Complex seen                      = vibration(gap.tail(3000), step, 20);
  // From the shape of the root with its history the motion is exp(s t).
  const auto value_at = [&](const double t) -> Eigen::VectorXcd { return root.shape * std::exp(root.value * t); };
  const DelayMotion pure =
      delay_motion(system, root.shape.real(), 0.5, 1e-4, [&](const double t) -> Eigen::MatrixXd {
        Eigen::MatrixXd y(1, 2);
        const Complex s = (system.W.transpose().cast<Complex>() * value_at(t))(0);
        y << s.real(), (root.value * s).real();
        return y;
      });
  double off = 0;
  for (Eigen::Index i = 0; i < pure.time.size(); ++i)
    off = std::max(off, std::abs(pure.state(14, i) - value_at(pure.time[i])[14].real()) /
                            std::abs(value_at(pure.time[i])[14]));
  return {relative("growth after a kick", "1/s", seen.real(), root.value.real(), 0.01),
          relative("frequency after a kick", "Hz", seen.imag() / (2 * M_PI), root.value.imag() / (2 * M_PI), 1e-4),
          at_most("deviation from exp(s t) in 0.5 s from the shape of the root", "-", off, 1e-4)};
}

std::vector<Check> study()
{
  const TandemLine line = tandem_of_two();
  const TandemStudy s   = tandem_study(line, {}, 2);
  const auto growing    = [&](const double speed) {
    return double(DelaySpectrum(tandem_system(line, tandem_point(line, speed))).roots_right_of(0));
  };
  const double v       = s.full.speed;
  const double lowest  = std::min(s.stand[0].speed, s.stand[1].speed);
  const double flow_in = s.point.stands[1].state.entry_speed, flow_out = s.point.stands[0].state.exit_speed;
  std::vector<Check> checks{
      reported("first stand alone: critical speed (of the last stand)", "m/s", s.stand[0].speed, lowest),
      reported("tension shared", "m/s", s.tension.speed, lowest),
      reported("tension shared, waviness arriving later", "m/s", v, lowest),
      reported("its frequency", "Hz", s.full.frequency, s.tension.frequency),
      reported("stable for any distance up to", "m/s", s.any_delay, lowest),
      reported("gap of the first stand over that of the second", "-", s.share[0].gap, 1),
      relative("growing roots 0.1 mm/s below", "-", growing(v - 1e-4), 0, 0),
      relative("growing roots 0.1 mm/s above", "-", growing(v + 1e-4), 2, 0),
      relative("speed of the strip between the stands", "m/s", flow_in, flow_out, 1e-12)};
  double early = 0;
  for (const double speed : Eigen::VectorXd::LinSpaced(25, 5, v - 1e-3))
    early += growing(speed);
  checks.push_back(relative("growing roots at 25 speeds below, sum", "-", early, 0, 0));
  // No delay makes the tandem grow below that speed; some delay does just above it.
  double worst_below = -INFINITY, worst_above = -INFINITY;
  for (int i = 0; i < 60; ++i)
    for (const double offset : {-0.02, 0.02}) {
      const TandemPoint point = tandem_point(line, s.any_delay + offset);
      DelaySystem system      = tandem_system(line, point);
      system.delay[0] *= 1 + 0.03 * i / 60;  // more than a wave of the critical root
      double &worst = offset < 0 ? worst_below : worst_above;
      worst         = std::max(worst, DelaySpectrum(system).rightmost().real());
    }
  checks.push_back(at_most("growth 0.02 m/s below it, worst of 60 distances", "1/s", worst_below, 0));
  checks.push_back(
      {"growth 0.02 m/s above it, worst of 60 distances", "1/s", worst_above, 0, 0, Judged::at_least});
  return checks;
}
}  // namespace

std::vector<Case> chatter_tandem_cases()
{
  const std::string two = "Stand D twice, 4.95 m apart: 0.789 to 0.577 mm (condition 2) and 0.577 to 0.44 mm with "
                          "150 MPa behind it; the "
                          "tension between the stands is one, the thickness that leaves the first enters the "
                          "second after the transport "
                          "time of the strip. ";
  std::vector<Case> cases;
  const auto add = [&](const char *name, const char *kind, const std::string &problem, const char *source,
                       const char *reason, std::vector<Check> (*run)()) {
    cases.push_back({name, kind, problem, source, reason, run});
  };
  add("chatter-tandem-one", "unit",
      "A tandem of one stand (condition 2 at 18.2 m/s, stand D) is that stand: all 14 roots.",
      "eigenvalues of the matrix of the single stand; of the critical pair also X. Liu et al., J. "
      "Vibroengineering 19 "
      "(2017), values by an independent program, entry eigenvalues.condition_2 in four decimals",
      "1e-10: two eigenvalue problems of the same matrix; 5e-5: the decimals given.", one_stand);
  add("chatter-delay-lambert", "verification",
      "s + a + b exp(-s delay) = 0 for a, b, delay = (1, 3, 0.5), (1, 3, 20), (5, -2, 1): all roots right of "
      "-3/delay.",
      "s = -a + W_k(-b delay exp(a delay))/delay with the branches of Lambert's W, by Halley's method (R. M. "
      "Corless et "
      "al., Adv. Comput. Math. 5 (1996) 329)",
      "1e-12: both to rounding; numbers of roots exact.", lambert_roots);
  add("chatter-delay-hayes", "verification",
      "s + a + b exp(-s) = 0 on the edge of its stable region, a = -w cot w, b = w/sin w, for 15 w between 0 and "
      "pi: the "
      "rightmost root is i w; with b smaller by 0.001 nothing grows, with b larger one pair does.",
      "N. D. Hayes, J. London Math. Soc. 25 (1950) 226", "1e-12: rounding; numbers of roots exact.",
      hayes_boundary);
  add("chatter-tandem-no-feedback", "unit",
      two + "At 20 m/s with constant thickness at the entry only the shared tension is left; with delayed "
            "waviness but "
            "tensions of its own for each stand the second cannot act on the first, and no delay changes a root.",
      "eigenvalues of the systems without delay",
      "1e-10: eigenvalues of the same matrices; numbers of roots exact.", no_feedback);
  add("chatter-tandem-no-delay", "unit",
      two + "At 16 m/s with the transport time set to zero, and to 0.1 and 0.2 us.",
      "eigenvalues of A + U W^T; for small delays a root moves in proportion to them",
      "1e-10: two ways to the same roots; 1e-3: curvature and rounding of a shift of 1e-6.", no_delay);
  add("chatter-tandem-collocation", "verification",
      two + "Here 0.8 m apart, at 16 m/s: all roots right of -30 1/s below 180 Hz against the eigenvalues of the "
            "system "
            "whose strip carries Chebyshev's points (141, spectral accuracy).",
      "D. Breda, S. Maset, R. Vermiglio, SIAM J. Sci. Comput. 27 (2005) 482",
      "1e-9 of the modulus: rounding of the collocated matrix; numbers of roots exact.", collocation);
  add("chatter-tandem-count", "verification",
      two + "Number of roots found by Newton's method against the argument principle, at four speeds; residual of "
            "each.",
      "argument principle with steps that are bounded by the residues, theory.md (28.7)",
      "Numbers exact; 1e-14: rounding of 27 states.", counting);
  add("chatter-tandem-motion", "verification",
      two + "At 24 m/s, time steps of 0.1 ms with the strip's history: growth and frequency of the second gap 0.9 "
            "to 1.2 "
            "s after a kick, and the motion from the shape of the root.",
      "rightmost root of the same system",
      "1 %: what other roots leave in the record; 1e-4: cubics over a fifteenth of a radian.", motion);
  add("chatter-tandem-two", "verification",
      two + "Critical speeds of the stands alone, with shared tension, and with the delayed waviness "
            "(regeneration), "
            "in speed of the last stand's rolls, compared with the lowest of the stands alone. Judged: growing "
            "roots "
            "counted "
            "around the critical speed and at 25 speeds below, and the speed up to which no distance between the "
            "stands is unstable.",
      "argument principle; mass flow; loop gain of one. The effect is that of P.-H. Hu, H. Zhao, K. F. Ehmann, "
      "Proc. "
      "Inst. Mech. Eng. B 220 (2006) 1293; no numbers are published for this tandem",
      "Numbers of roots exact; 1e-12: mass flow is solved to 1e-14.", study);
  return cases;
}
}  // namespace mill::verify
