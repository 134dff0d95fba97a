#include "core/base/errors.h"
#include "dynamics/tandem/delay.h"
#include "dynamics/tandem/tandem.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <Eigen/LU>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

// Stands in a row with the delay of the strip between them: what the cases of `millstand verify chatter` do not
// cover.
namespace mill::dynamics {
namespace {
using Complex = std::complex<double>;

// A pass under an oil film, SI.
bite::RollBite pass(const double entry, const double exit, const double back, const double front)
{
  bite::RollBite b;
  b.roll_radius                       = 0.28;
  b.roll                              = {2.1e11, 0.3, 7850};
  b.strip.width                       = 1.1;
  b.strip.entry_thickness             = entry;
  b.strip.exit_thickness              = exit;
  b.strip.entry_tension               = back;
  b.strip.exit_tension                = front;
  b.strip.initial_thickness           = 2.8e-3;
  b.strip.flow_stress.law             = FlowStressLaw::reduction_power;
  b.strip.flow_stress.k               = 800e6;
  b.strip.flow_stress.eps0            = 0.01;
  b.strip.flow_stress.n               = 0.25;
  b.strip.friction.law                = FrictionLaw::film;
  b.strip.friction.mu0                = 0.012;
  b.strip.friction.mu1                = 0.142;
  b.strip.friction.decay              = 2.43e6;
  b.strip.friction.viscosity          = 0.006;
  b.strip.friction.pressure_viscosity = 1.8e-8;
  return b;
}

StandStructure structure(const double scale = 1)
{
  return six_mass_structure({119e3 * scale, 75e3, 9.2e3, 9.2e3, 75e3 * scale, 36.5e3},
                            {6.9e10, 3e10, 6.06e10, 6.06e10, 4.4e10, 10.1e10}, {6e5, 4e5, 6e5, 6e5, 4e5, 6e5});
}

TandemLine three_stands()
{
  TandemLine line;
  line.stands         = {{"", structure(), pass(0.80e-3, 0.60e-3, 150e6, 160e6)},
                         {"four", structure(1.1), pass(0.60e-3, 0.46e-3, 160e6, 170e6)},
                         {"five", structure(0.9), pass(0.46e-3, 0.37e-3, 170e6, 100e6)}};
  line.distance       = {4.5, 4.2};
  line.entry_distance = 4.7;
  line.exit_distance  = 5.1;
  return line;
}

Eigen::MatrixXd column(const std::initializer_list<double> &values)
{
  Eigen::MatrixXd c(Eigen::Index(values.size()), 1);
  std::copy(values.begin(), values.end(), c.data());
  return c;
}

TEST(Tandem, MassFlowTiesTheSpeeds)
{
  const TandemLine line   = three_stands();
  const TandemPoint point = tandem_point(line, 17);
  ASSERT_EQ(point.stands.size(), 3u);
  EXPECT_EQ(point.stands[2].bite.roll_speed, 17);
  for (int i = 0; i < 2; ++i) {
    const auto &leaves = point.stands[i], &enters = point.stands[i + 1];
    EXPECT_TRUE(near(leaves.state.exit_speed / enters.state.entry_speed, 1,
                     within(1e-13, "the speeds are solved to 1e-14")));
    EXPECT_TRUE(
        near(point.delay[i], line.distance[i] / leaves.state.exit_speed, within(1e-15, "one division", 1)));
    EXPECT_LT(leaves.bite.roll_speed, enters.bite.roll_speed);
  }
  const double in = point.stands[0].state.entry_speed * 0.80e-3, out = point.stands[2].state.exit_speed * 0.37e-3;
  EXPECT_TRUE(near(in / out, 1, within(1e-12, "mass flow through three stands, each to 1e-13")));
}

TEST(Tandem, BlocksOfTheSystemAreAtTheirPlaces)
{
  const TandemLine line    = three_stands();
  const TandemPoint point  = tandem_point(line, 17);
  const DelaySystem system = tandem_system(line, point);
  ASSERT_EQ(system.A.rows(), 3 * 12 + 4);
  ASSERT_EQ(system.U.cols(), 2);
  // The tension between stands 1 and 2 changes with what the second draws in less what the first lets out, (28.2).
  const double rate = line.strip_modulus / 4.5;
  const auto &Q = point.stands[0].by.exit_speed, &P = point.stands[1].by.entry_speed;
  EXPECT_EQ(system.A(37, 2), -rate * Q[0]);
  EXPECT_EQ(system.A(37, 14), rate * P[0]);
  EXPECT_EQ(system.A(37, 36), -rate * Q[2]);
  EXPECT_EQ(system.A(37, 37), rate * P[2] - rate * Q[3]);
  EXPECT_EQ(system.A(37, 38), rate * P[3]);
  EXPECT_EQ(system.U(37, 0), rate * P[4]);
  EXPECT_EQ(system.U(37, 1), 0);
  // The waviness drives the stand it enters, and the tension behind that.
  EXPECT_TRUE(near(system.U(12 + 8, 0), point.stands[1].by.force[4] / 9.2e3,
                   within(1e-6 / std::abs(point.stands[1].by.force[4] / 9.2e3),
                          "rounding of a product of 1e9 N/m and a mass")));
  EXPECT_NE(system.U(38, 0), 0);
  EXPECT_EQ(system.W.col(1).sum(), 2);
  // With every tension of its own a stand is chatter_matrix.
  const Eigen::MatrixXd alone = tandem_matrix(line, point, TandemCoupling::alone);
  EXPECT_EQ(alone.rows(), 3 * 14);
  EXPECT_EQ(alone.block(14, 14, 14, 14), stand_alone(line, point, 1));
  EXPECT_EQ(alone.block(0, 14, 14, 28).norm(), 0);
}

TEST(Tandem, RefusesStripThatDoesNotFit)
{
  TandemLine line                           = three_stands();
  line.stands[1].bite.strip.entry_thickness = 0.61e-3;
  EXPECT_EQ(refusal([&] { tandem_point(line, 17); }), "tandem: the thickness behind stand 1 is 0.6 mm and before "
                                                      "four 0.61 mm; it is the same strip, give both the "
                                                      "same");
  line                                   = three_stands();
  line.stands[1].bite.strip.exit_tension = 175e6;
  line.stands[2].bite.strip.width        = 1.2;
  EXPECT_EQ(refusals([&] { check_tandem(line); }),
            "tandem: the tension behind four is 175 MPa and before five 170 "
            "MPa; it is the same strip, give both the same\n"
            "tandem: the width behind four is 1100 mm and before five 1200 "
            "mm; it is the same strip, give both the same");
  line = three_stands();
  line.distance.pop_back();
  line.entry_distance = 0;
  EXPECT_EQ(refusals([&] { check_tandem(line); }),
            "tandem: 3 stands have 2 distances between them, not 1\n"
            "tandem: the distance before stand 1 is 0 m; it must be above 0");
  EXPECT_EQ(refusal([&] { check_tandem({}); }), "tandem: no stand");
  EXPECT_EQ(refusal([&] { tandem_point(three_stands(), -1); }),
            "tandem: the rolls of the last stand at -1 m/s; the speed must be above 0");
}

TEST(Tandem, NamesTheStandWithoutABite)
{
  TandemLine line                         = three_stands();
  line.stands[0].bite.strip.entry_tension = 2e9;
  const std::string text                  = refusal([&] { tandem_point(line, 17); });
  EXPECT_EQ(text.rfind("tandem: stand 1 at ", 0), 0u) << text;
  EXPECT_NE(text.find("of its rolls (last stand at 17 m/s): "), std::string::npos) << text;
}

TEST(Tandem, EveryRootIsFoundForThreeStands)
{
  const TandemLine line = three_stands();
  for (const double speed : {12., 17., 23.}) {
    const DelaySpectrum spectrum(tandem_system(line, tandem_point(line, speed)));
    const auto roots = spectrum.roots(-1.5, 1e5);
    EXPECT_EQ(int(roots.size()), spectrum.roots_right_of(-1.5)) << speed;
    ASSERT_FALSE(roots.empty()) << speed;
    for (const Complex &s : roots)
      EXPECT_LT(spectrum.polished(s).residual, 1e-14);  // rounding of 40 states
    const Complex first = spectrum.rightmost();
    EXPECT_TRUE(near(first.real(), roots[0].real(),
                     within(1e-9 * std::abs(first) / std::abs(roots[0].real()),
                            "both polished: rounding of a root of this size")));
    EXPECT_EQ(spectrum.roots_right_of(first.real() + 1e-6), 0) << speed;
    EXPECT_EQ(spectrum.roots_right_of(first.real() - 1e-6), 2) << speed;
    EXPECT_EQ(tandem_root(line, speed), first);
  }
}

// Random systems with two delays, small enough for the determinant itself.
TEST(DelaySpectrum, NumberOfRootsIsThatOfTheTurnsOfTheDeterminant)
{
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 20; ++trial) {
    const auto matrix = [&](const int n, const int m) {
      return Eigen::MatrixXd::NullaryExpr(n, m, [&] { return normal(random); }).eval();
    };
    DelaySystem system{2 * matrix(5, 5), matrix(5, 2), matrix(5, 2), column({0.7, 1.3})};
    system.A.diagonal().array() -= 1;
    const DelaySpectrum spectrum(system);
    const double c = -0.2;
    // det(s - A - sum U_k W_k^T exp(-s delay_k)) grows as s^5: half a turn per unit of degree less two per root.
    const auto determinant = [&](const Complex s) {
      Eigen::MatrixXcd T = -system.A.cast<Complex>();
      T.diagonal().array() += s;
      for (int k = 0; k < 2; ++k)
        T -= std::exp(-s * system.delay[k]) * (system.U.col(k) * system.W.col(k).transpose()).cast<Complex>();
      return T.determinant();
    };
    double turned  = 0;
    Complex before = determinant({c, 0});
    for (int i = 1; i <= 30000; ++i) {
      const Complex now = determinant({c, 1e-2 * i});
      turned += std::arg(now / before);
      before = now;
    }
    // from 0 to infinity the argument changes by (5 - 2 roots) pi/2; what the end at 300 rad/s lacks is small
    const int counted = int(std::lround(0.5 * (5 - 2 * turned / M_PI)));
    EXPECT_EQ(spectrum.roots_right_of(c), counted) << trial;
    const auto roots = spectrum.roots(c, 1e4);
    EXPECT_EQ(int(roots.size()), counted) << trial;
    for (const Complex &s : roots)
      EXPECT_LT(spectrum.polished(s).residual, 1e-14);
  }
}

TEST(DelaySpectrum, FindsRootsThatCoincide)
{
  // Two equal decoupled oscillators, of which the delayed signal knows only the sum: the difference keeps its
  // poles.
  DelaySystem system;
  system.A = Eigen::MatrixXd::Zero(4, 4);
  for (const int i : {0, 2}) {
    system.A(i, i + 1)     = 1;
    system.A(i + 1, i)     = -100;
    system.A(i + 1, i + 1) = -0.4;
  }
  system.U     = column({0, 3, 0, 3});
  system.W     = column({1, 0, 1, 0});
  system.delay = Eigen::VectorXd::Constant(1, 0.9);
  const DelaySpectrum spectrum(system);
  const auto roots = spectrum.roots(-0.5, 1e3);
  EXPECT_EQ(int(roots.size()), spectrum.roots_right_of(-0.5));
  const Complex kept(-0.2, std::sqrt(100 - 0.04));
  double nearest = INFINITY;
  for (const Complex &s : roots)
    nearest = std::min(nearest, std::abs(s - kept));
  EXPECT_LT(nearest, 1e-9);  // sensitivity of a double eigenvalue of the undelayed part
  // Two signals that are the two oscillators: every root twice.
  system.U       = Eigen::MatrixXd::Zero(4, 2);
  system.W       = Eigen::MatrixXd::Zero(4, 2);
  system.U(1, 0) = system.U(3, 1) = 3;
  system.W(0, 0) = system.W(2, 1) = 1;
  system.delay                    = column({0.9, 0.9});
  const DelaySpectrum twice(system);
  const auto all = twice.roots(-0.5, 1e3);
  EXPECT_EQ(int(all.size()), twice.roots_right_of(-0.5));
  EXPECT_EQ(all.size() % 4, 0u);
}

TEST(DelaySpectrum, LoopGainBelowOneIsStableForAnyDelay)
{
  // x'' + 0.4 x' + 100 x = g x(t - delay): resonance with |G| = g/(0.4 sqrt(100 - 0.04))
  DelaySystem system;
  system.A = (Eigen::MatrixXd(2, 2) << 0, 1, -100, -0.4).finished();
  system.W = column({1, 0});
  for (const double gain : {0.98, 1.02}) {
    system.U     = column({0, gain * 0.4 * std::sqrt(100 - 0.04)});
    double worst = -INFINITY;
    for (double delay = 2; delay < 2.63; delay += 0.01) {  // a whole wave
      system.delay = Eigen::VectorXd::Constant(1, delay);
      const DelaySpectrum spectrum(system);
      EXPECT_TRUE(near(spectrum.loop_gain(), gain,
                       within(1e-12 / gain, "the gain does not depend on the delay: rounding")));
      worst = std::max(worst, spectrum.rightmost().real());
    }
    EXPECT_EQ(worst > 0, gain > 1);
  }
}

TEST(DelaySpectrum, RefusesWrongShapesDelaysAndNumbers)
{
  DelaySystem system{Eigen::MatrixXd::Identity(3, 3), Eigen::MatrixXd::Ones(3, 1), Eigen::MatrixXd::Ones(2, 1),
                     Eigen::VectorXd::Ones(1)};
  EXPECT_EQ(refusal([&] { DelaySpectrum{system}; }),
            "delay system: 3 states and 1 delays need U and W of that shape");
  system.W     = Eigen::MatrixXd::Ones(3, 1);
  system.delay = Eigen::VectorXd::Constant(1, -0.5);
  EXPECT_EQ(refusal([&] { DelaySpectrum{system}; }),
            "delay system: a delay of -0.500000 s; it must be finite and not below 0");
  system.delay[0] = 0.1;
  system.A(0, 0)  = NAN;
  EXPECT_EQ(refusal([&] { DelaySpectrum{system}; }), "delay system: a number in it is not finite");
}

TEST(DelayMotion, IsExactForASignalThatIsACubic)
{
  // y' = -b y(t - 1) with y = 1 before 0: y = 1 - b t, then a parabola, then a cubic.
  const auto one = [](const double x) { return Eigen::MatrixXd::Constant(1, 1, x); };
  const DelaySystem system{one(0), one(-0.5), one(1), Eigen::VectorXd::Ones(1)};
  const DelayMotion motion = delay_motion(system, Eigen::VectorXd::Ones(1), 3, 0.3,
                                          [](double) { return (Eigen::MatrixXd(1, 2) << 1, 0).finished(); });
  EXPECT_TRUE(near(motion.time[1], 0.25, within(4e-15, "four steps per delay of 1 s")));
  for (Eigen::Index i = 0; i < motion.time.size(); ++i) {
    const double t = motion.time[i];
    double y       = 1 - 0.5 * t;
    if (t > 1)
      y += std::pow(0.5 * (t - 1), 2) / 2;
    if (t > 2)
      y -= std::pow(0.5 * (t - 2), 3) / 6;
    EXPECT_LT(std::abs(motion.signal(0, i) - y), 1e-14)
        << "polynomials in each delay are exact but for rounding, t = " << t;
  }
  EXPECT_EQ(refusal([&] { delay_motion(system, Eigen::VectorXd::Ones(1), 3, 0); }),
            "motion with delay: step 0.000000 s and duration 3.000000 s have to be above 0");
}

// Fourteen stands have thirteen delays, one more than the roots are searched for: what does not need them stays.
TEST(Tandem, WithoutRootsOfTheDelayTheRestOfAStudyStays)
{
  TandemLine line;
  double thickness = 2e-3;
  for (int i = 0; i < 14; ++i) {
    const double exit = 0.93 * thickness;
    line.stands.push_back({"", structure(), pass(thickness, exit, 150e6, 150e6)});
    thickness = exit;
  }
  line.distance.assign(13, 4.5);
  line.entry_distance = line.exit_distance = 4.5;
  SpeedRange range;
  range.from          = 10;
  range.to            = 12;
  const TandemStudy s = tandem_study(line, range, 3);
  EXPECT_EQ(s.full.verdict, Verdict::no_bite);
  ASSERT_EQ(s.stand.size(), 14u);
  for (const CriticalSpeed &alone : s.stand)
    EXPECT_NE(alone.verdict, Verdict::no_bite);
  EXPECT_NE(s.tension.verdict, Verdict::no_bite);
  ASSERT_EQ(s.curves.speed.size(), 3);
  for (Eigen::Index j = 0; j < 3; ++j) {
    const double tension =
        growth_rate(tandem_matrix(line, tandem_point(line, s.curves.speed[j]), TandemCoupling::tension));
    EXPECT_TRUE(near(s.curves.tension[j], tension,
                     within(1e-8 / std::abs(tension), "1/s: eigenvalues of one matrix, states settled to 1e-10")));
    EXPECT_TRUE(std::isfinite(s.curves.alone[j]));
    EXPECT_TRUE(std::isnan(s.curves.full[j]) && std::isnan(s.curves.loop_gain[j]));
    EXPECT_EQ(s.curves.unstable[j], -1);
  }
  EXPECT_EQ(s.sentences[s.sentences.size() - 2],
            "With the waviness that reaches the next stand later: no steady bite from 10 to 12 m/s "
            "(delay system: 13 delays; at most 12).");
  EXPECT_EQ(s.sentences.back(), "At 3 of 3 speeds the roots with the delay of the strip were not found; their "
                                "growth is left out.");
}

TEST(Tandem, StudyStatesTheEffectOfTensionAndDelay)
{
  TandemLine line = three_stands();
  line.stands.pop_back();
  line.distance.pop_back();
  line.exit_distance = 4.2;
  SpeedRange range;
  range.from          = 6;
  const TandemStudy s = tandem_study(line, range, 9);
  ASSERT_EQ(s.full.verdict, Verdict::crossing);
  ASSERT_EQ(s.names, (std::vector<std::string>{"stand 1", "four"}));
  EXPECT_LE(s.any_delay, s.full.speed);
  EXPECT_TRUE(
      near(s.critical_root.real(), 0,
           within(1e-6, "growth 1 1/s per m/s times a crossing to 1e-10 m/s, and iterations of the root", 1)));
  EXPECT_TRUE(near(s.critical_root.imag() / (2 * M_PI), s.full.frequency,
                   within(1e-6 / s.full.frequency, "one root, solved by two functions")));
  EXPECT_EQ(std::max(s.share[0].gap, s.share[1].gap), 1);
  for (Eigen::Index j = 0; j < s.curves.speed.size(); ++j) {
    if (s.curves.speed[j] < s.full.speed)
      EXPECT_LT(s.curves.full[j], 0);
    EXPECT_EQ(s.curves.unstable[j] > 0, s.curves.full[j] > 0);
    const double tension =
        growth_rate(tandem_matrix(line, tandem_point(line, s.curves.speed[j]), TandemCoupling::tension));
    EXPECT_TRUE(near(s.curves.tension[j], tension,
                     within(1e-8 / std::abs(tension), "1/s: eigenvalues of one matrix, states settled to 1e-10")));
  }
  ASSERT_GE(s.sentences.size(), 4u);
  EXPECT_EQ(s.sentences[0].rfind("stand 1 alone: ", 0), 0u) << s.sentences[0];
  EXPECT_EQ(s.sentences[2].rfind("Sharing the tension between them: ", 0), 0u) << s.sentences[2];
}
}  // namespace
}  // namespace mill::dynamics
