// Welch spectra of signals whose spectrum is known.
#include "dynamics/response/spectrum.h"
#include "tests/support/near.h"
#include <cmath>
#include <random>

using namespace mill::dynamics;

namespace {
Eigen::VectorXd sine(const Eigen::Index n, const double rate, const double f, const double amplitude)
{
  return amplitude * (2 * M_PI * f / rate * Eigen::ArrayXd::LinSpaced(n, 0, double(n - 1))).sin();
}

double power(const Spectrum &spectrum)
{
  return spectrum.density.squaredNorm() * spectrum.frequency[1];
}
}  // namespace

TEST(Spectrum, ASineOnALineHasItsAmplitude)
{
  const double rate = 1024, amplitude = 3, f = 128;
  const Spectrum spectrum = amplitude_spectral_density(sine(8192, rate, f, amplitude), rate, 1024);
  Eigen::Index line       = 0;
  const double peak       = spectrum.density.maxCoeff(&line);
  EXPECT_EQ(spectrum.frequency[line], f);
  // A Hann window spreads a line of power A^2/2 over 1.5 lines of 1 Hz: density A / sqrt(2 * 1.5 Hz).
  EXPECT_TRUE(
      near(peak, amplitude / std::sqrt(3), within(1e-12, "exact for a whole number of periods per segment")));
  EXPECT_TRUE(near(power(spectrum), amplitude * amplitude / 2, within(1e-12, "Parseval, whole periods")));
  EXPECT_EQ(spectrum.n_segments, 15);
}

TEST(Spectrum, MeanIsRemovedAndWhiteNoiseIsFlat)
{
  std::mt19937_64 engine(5);
  Eigen::VectorXd noise(1 << 16);
  for (double &value : noise)
    value = 7 + std::ldexp(double(engine() >> 11), -53);  // uniform: variance 1/12
  const double rate       = 20e3;
  const Spectrum spectrum = amplitude_spectral_density(noise, rate, 256);
  EXPECT_EQ(spectrum.n_segments, 511);
  const double expected = std::sqrt(2 / (12 * rate));
  // a line is a mean over about 511 * 0.75 independent powers: 5.1 % of power, 2.6 % of amplitude; the largest of
  // 127 lines stays within 4.5 of these
  EXPECT_TRUE(near(spectrum.density.segment(2, 126), Eigen::VectorXd::Constant(126, expected),
                   within(0.12, "4.5 standard deviations of 2.6 %, seed 5")));
  EXPECT_LT(spectrum.density[0], 2 * expected) << "a mean of 7 left in would be 200 times this";
}

TEST(Spectrum, ChoosesAPowerOfTwoOfWhichEightFit)
{
  EXPECT_EQ(amplitude_spectral_density(sine(200001, 20e3, 50, 1), 20e3).segment_length, 16384);
  EXPECT_EQ(amplitude_spectral_density(sine(300, 20e3, 50, 1), 20e3).segment_length, 256);
  EXPECT_EQ(amplitude_spectral_density(sine(3, 20e3, 50, 1), 20e3).segment_length, 2);
}
