// Faults of roll-neck bearings in the envelope: TW-09, each rule by itself, faults of every kind and what is none.
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include "tests/support/synthetic_record.h"
#include "twin/bearings/fault_lines.h"
#include <algorithm>
#include <cmath>
#include <functional>

using namespace mill;
using namespace mill::twin;

namespace {
TurningBearing bearing_of_reference()
{
  const auto orders = reference("envelope.orders", "twin")["classic"];
  return {"trb", "work_roll", 0.42, orders["FTF"], orders["BPFO"], orders["BPFI"], orders["BSF"]};
}

double shaft_of_reference()
{
  return reference("envelope.orders", "twin")["shaft_hz"];
}

// Impacts at a frequency, each beside its time by a share of the spacing, with a strength that moves; ring-down, a
// strong tone and noise.  The reference has strength 1 and the outer ring.
Eigen::VectorXd record(const std::uint64_t seed, const double T, const double frequency,
                       const std::function<double(double)> &strength)
{
  const auto in     = reference("envelope.inputs", "twin");
  const double rate = in["fs"], w = 2 * M_PI * in["ring_f"].get<double>(), z = in["ring_z"];
  const auto n                = Eigen::Index(T * rate);
  Eigen::VectorXd x           = synthetic::white(seed, n, rate, in["density"]);
  const Eigen::VectorXd slips = synthetic::normals(seed + 1, Eigen::Index(T * frequency) + 50);
  for (Eigen::Index i = 0; i < slips.size(); ++i) {
    const double t   = (double(i + 1) + in["slip"].get<double>() * slips[i]) / frequency;
    const auto first = Eigen::Index(std::ceil(t * rate));
    const double a   = strength(t);
    for (Eigen::Index k = first; k < std::min(n, first + Eigen::Index(0.02 * rate)); ++k) {
      const double since = double(k) / rate - t;
      x[k] += a * std::exp(-z * w * since) * std::sin(w * since);
    }
  }
  for (Eigen::Index k = 0; k < n; ++k)
    x[k] += in["tone"][1].get<double>() * std::cos(2 * M_PI * in["tone"][0].get<double>() * double(k) / rate);
  return x;
}

std::vector<FaultLines> lines_of(const Eigen::VectorXd &x)
{
  const auto in = reference("envelope.inputs", "twin");
  Fourier fourier;
  return fault_lines(envelope_spectrum(x, in["fs"], in["band"][0], in["band"][1], fourier), bearing_of_reference(),
                     shaft_of_reference());
}

// A spectrum of noise (Rayleigh) with lines, and a bearing of simple orders at a shaft of 10 Hz.
constexpr double shaft = 10;
EnvelopeSpectrum noise_with(const std::vector<std::pair<double, double>> &lines)
{
  EnvelopeSpectrum s;
  s.resolution            = 0.05;
  const Eigen::VectorXd u = synthetic::uniforms(77, 40000);
  s.magnitude             = (-2 * (1 - u.array()).log()).sqrt().matrix();
  for (const auto &[frequency, size] : lines)
    s.magnitude[Eigen::Index(std::lround(frequency / s.resolution))] = size * std::sqrt(2 * std::log(2.0));
  return s;
}

FaultLines family_of(const std::vector<FaultLines> &found, const std::string &family)
{
  return *std::find_if(found.begin(), found.end(), [&](const FaultLines &f) { return f.family == family; });
}

const TurningBearing simple{"b", "work_roll", 0.4, 0.41, 4.37, 5.63, 2.79};
}  // namespace

TEST(FaultLines, RatiosOfTheReference)
{
  const auto in = reference("envelope.inputs", "twin"), known = reference("envelope.lines", "twin");
  const double bpfo = known["BPFO"]["hz"];
  for (const bool healthy : {false, true}) {
    const auto x        = record(601, in["T"], bpfo, [&](double) { return healthy ? 0.0 : 1.0; });
    const auto families = lines_of(x);
    ASSERT_EQ(families.size(), 4u);
    if (!healthy) {
      EXPECT_EQ(families[0].family, "BPFO");
      EXPECT_TRUE(families[0].indicated());
      EXPECT_FALSE(families[0].strong());
      EXPECT_TRUE(near(families[0].frequency, bpfo, within_absolute(1e-9, "frequency without slip, as given")));
      EXPECT_TRUE(near(families[0].slip, 0,
                       within_absolute(0.001, "largest step of the searched slip is 0.002; half of it")));
      for (std::size_t h = 0; h < 4; ++h)
        EXPECT_TRUE(near(families[0].ratio[h], known["BPFO"]["ratio"][h], within(0.02, "TW-09, asked for")));
    }
    for (std::size_t i = healthy ? 0 : 1; i < 4; ++i)
      EXPECT_LT(families[i].score, 5) << families[i].family;
  }
  // the plain spectrum of the faulty record shows nothing there
  const auto x = record(601, in["T"], bpfo, [](double) { return 1.0; });
  EnvelopeSpectrum plain;
  Fourier fourier;
  std::vector<double> values(x.data(), x.data() + x.size());
  std::vector<std::complex<double>> half;
  for (Eigen::Index k = 0; k < x.size(); ++k)
    values[std::size_t(k)] *= 0.5 - 0.5 * std::cos(2 * M_PI * double(k) / double(x.size()));
  fourier.forward(values, half);
  plain.resolution = in["fs"].get<double>() / double(x.size());
  plain.magnitude.resize(20000);
  for (Eigen::Index k = 0; k < plain.magnitude.size(); ++k)
    plain.magnitude[k] = std::abs(half[std::size_t(k)]);
  EXPECT_LT(family_of(fault_lines(plain, bearing_of_reference(), shaft_of_reference()), "BPFO").score, 5);
}

TEST(FaultLines, EveryKindOfFaultIsNamedFirst)
{
  const TurningBearing b = bearing_of_reference();
  const double turn      = shaft_of_reference();
  struct Kind {
    std::string family;
    double frequency;  // of the impacts, Hz
    double moves;      // Hz, the strength goes through the loaded zone so often; 0: it stays there
  };
  for (const Kind &kind : {Kind{"BPFO", b.outer * turn, 0}, Kind{"BPFI", b.inner * turn, turn},
                           Kind{"2 BSF", 2 * b.roller * turn, b.cage * turn}, Kind{"FTF", b.cage * turn, 0}})
    for (const std::uint64_t seed : {611}) {
      const auto families = lines_of(record(seed, 20, kind.frequency, [&](const double t) {
        return kind.moves > 0 ? 1 + std::cos(2 * M_PI * kind.moves * t) : kind.family == "FTF" ? 6.0 : 1.0;
      }));
      EXPECT_EQ(families[0].family, kind.family) << "seed " << seed;
      EXPECT_TRUE(families[0].indicated()) << kind.family << " " << families[0].score;
      for (std::size_t i = 1; i < 4; ++i)
        EXPECT_LT(families[i].score, 7) << families[i].family << " beside " << kind.family << ", seed " << seed;
    }
}

TEST(FaultLines, AHealthyBearingWithAKnockOfTheRollShowsNone)
{
  const double turn = shaft_of_reference();
  for (const std::uint64_t seed : {621, 721})
    for (const FaultLines &f : lines_of(record(seed, 20, turn, [](double) { return 2.0; })))
      EXPECT_LT(f.score, 5) << f.family << ", seed " << seed;
}

TEST(FaultLines, TheThirdBestHarmonicCounts)
{
  const double f = simple.outer * shaft;
  EXPECT_LT(family_of(fault_lines(noise_with({{f, 40}, {2 * f, 40}}), simple, shaft), "BPFO").score, 5)
      << "two harmonics";
  const auto three = fault_lines(noise_with({{f, 40}, {2 * f, 30}, {4 * f, 8}}), simple, shaft)[0];
  EXPECT_EQ(three.family, "BPFO");
  EXPECT_TRUE(
      near(three.score, 8, within_absolute(0.4, "5 %: the median of the noise near the line is estimated")));
  EXPECT_TRUE(three.indicated());
  EXPECT_FALSE(three.strong());
  EXPECT_TRUE(fault_lines(noise_with({{f, 40}, {2 * f, 30}, {4 * f, 25}}), simple, shaft)[0].strong());
}

TEST(FaultLines, OneSlipForAllHarmonics)
{
  const double f = simple.outer * shaft;
  const auto at  = [&](const double a, const double b, const double c) {
    return family_of(
         fault_lines(noise_with({{f * (1 + a), 40}, {2 * f * (1 + b), 40}, {3 * f * (1 + c), 40}}), simple, shaft),
         "BPFO");
  };
  const FaultLines common = at(-0.012, -0.012, -0.012);
  EXPECT_GT(common.score, 20);
  EXPECT_TRUE(
      near(common.slip, -0.012, within_absolute(0.001, "largest step of the searched slip is 0.002; half of it")));
  EXPECT_LT(at(-0.012, 0.004, -0.005).score, 5) << "each harmonic with a slip of its own";
  EXPECT_LT(at(0.014, 0.014, 0.014).score, 5) << "faster than rolling";
}

TEST(FaultLines, WhatTheShaftExplainsIsNoFault)
{
  TurningBearing whole = simple;
  whole.outer          = 4;  // its lines are those of the shaft
  std::vector<std::pair<double, double>> lines;
  for (int k = 1; k <= 20; ++k)
    lines.emplace_back(k * shaft, 40);
  for (const FaultLines &f : fault_lines(noise_with(lines), whole, shaft))
    EXPECT_LT(f.score, 5) << f.family;
}

TEST(FaultLines, WhatOneFamilyExplainsIsNoEvidenceForTheNext)
{
  TurningBearing b = simple;
  b.inner          = 5.4;
  b.outer          = 4.4;  // one turn below the inner ring's: 8.8 = 10.8 - 2, 13.2 = 16.2 - 3
  std::vector<std::pair<double, double>> lines;
  for (int h = 1; h <= 4; ++h)
    for (int k = -3; k <= 3; ++k)
      lines.emplace_back((h * b.inner + k) * shaft, k == 0 ? 40 : 25);
  const auto families = fault_lines(noise_with(lines), b, shaft);
  EXPECT_EQ(families[0].family, "BPFI");
  EXPECT_TRUE(families[0].strong());
  EXPECT_LT(family_of(families, "BPFO").score, 5) << "all of its lines are side bands";
  TurningBearing rolling = simple;
  rolling.roller         = 2.5;  // 2 BSF = 5; side bands at the cage's turns
  rolling.outer          = 5 - 0.41;
  lines.clear();
  for (int h = 1; h <= 4; ++h)
    for (int k = -3; k <= 3; ++k)
      lines.emplace_back((h * 5.13 + k * 0.41) * shaft, k == 0 ? 40 : 25);
  rolling.roller       = 2.565;
  rolling.outer        = 5.13 - 0.41;
  const auto of_roller = fault_lines(noise_with(lines), rolling, shaft);
  EXPECT_EQ(of_roller[0].family, "2 BSF");
  EXPECT_LT(family_of(of_roller, "BPFO").score, 5);
}

TEST(FaultLines, TheBandIsFoundByItsKurtosis)
{
  Fourier fourier;
  const auto s = envelope_spectrum(record(601, 10, 55.24, [](double) { return 1.0; }), 20000, 0, 0, fourier);
  EXPECT_LT(s.low, 3200);
  EXPECT_GT(s.high, 3200);
  EXPECT_GT(s.kurtosis, 3.2) << "noise has 3 with a standard deviation of 0.03";
}

TEST(FaultLines, WithoutPitchNothingIsGuessed)
{
  Fourier fourier;
  const double nan = std::nan("");
  const auto s     = envelope_spectrum(synthetic::normals(1, 40000), 20000, 2000, 5000, fourier);
  EXPECT_TRUE(fault_lines(s, {"trb", "work_roll", 0.42, nan, nan, nan, nan}, 3).empty());
  EXPECT_EQ(quick_length(1000003), 1000000);
}
