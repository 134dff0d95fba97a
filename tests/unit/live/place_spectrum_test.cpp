#include "tests/support/near.h"
#include "twin/live/display/place_spectrum.h"
#include <cmath>
#include <gtest/gtest.h>

namespace live = mill::live;

namespace {
constexpr double rate = 20000, df = rate / 16384;

live::LiveSource source()
{
  live::LiveSource out;
  out.rate     = rate;
  out.channels = {{"force", "N"}, {"upper_work_roll", "m/s2"}};
  out.places   = {"upper_frame", "upper_work_roll"};
  return out;
}

// Lines of 3 m/s2 at bin 611 of the twin's work roll and 0.003 at bin 700 of the measured one, over offsets.
live::LiveBlock block(const std::int64_t first, const Eigen::Index n)
{
  live::LiveBlock out;
  out.first     = first;
  out.rate      = rate;
  out.force     = Eigen::VectorXd::Constant(n, 1e6);
  out.measured  = Eigen::MatrixXd::Zero(n, 2);
  out.simulated = Eigen::MatrixXd::Zero(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double t      = double(first + i) / rate;
    out.measured(i, 1)  = 0.003 * std::cos(2 * M_PI * 700 * df * t) - 4;
    out.simulated(i, 1) = 3 * std::cos(2 * M_PI * 611 * df * t + 1) + 9;
  }
  return out;
}

// A second and a half in blocks of 20 ms; the last that was shown.
live::PageSpectrum last_of(live::PlaceSpectrum &display, std::int64_t &s, int *shown = nullptr)
{
  live::PageSpectrum out;
  for (int k = 0; k < 75; ++k, s += 400)
    if (const auto spectrum = display.take(block(s, 400), double(s) / rate)) {
      out = *spectrum;
      if (shown)
        ++*shown;
    }
  return out;
}
}  // namespace

TEST(PlaceSpectrum, BothSignalsHaveTheirOwnLines)
{
  live::PlaceSpectrum display;
  display.begin(source());
  EXPECT_EQ(display.place(), "upper_work_roll");  // the first that is measured
  std::int64_t s  = 0;
  int shown       = 0;
  const auto seen = last_of(display, s, &shown);
  EXPECT_GE(shown, 2);  // after 0.82 s, then four times a second
  EXPECT_LE(shown, 4);
  EXPECT_EQ(seen.simulated.size(), 1024u);
  EXPECT_EQ(seen.measured.size(), 1024u);
  EXPECT_TRUE(near(seen.df, df, within(1e-15, "the same division")));
  // A line of amplitude A in a bin: density A^2/2 over the noise bandwidth 1.5 df.
  const Tolerance rounding = within(1e-6, "single precision");
  EXPECT_TRUE(near(seen.simulated[611], 3 / std::sqrt(2 * 1.5 * df), rounding));
  EXPECT_TRUE(near(seen.measured[700], 0.003 / std::sqrt(2 * 1.5 * df), rounding));
  EXPECT_LT(seen.measured[611], 1e-9);
  EXPECT_LT(seen.simulated[700], 1e-9);
  EXPECT_LT(seen.simulated[0], 1e-9);  // the mean is taken off
  EXPECT_EQ(seen.wave_simulated.size(), 512u);
  EXPECT_TRUE(near(seen.wave_measured.back(), -4, within(1e-3, "the line beside it")));
}

TEST(PlaceSpectrum, TheNumbersMayBeginBelowZero)
{
  live::PlaceSpectrum display;
  display.begin(source());
  live::PageSpectrum seen;
  std::int64_t s = -50007, last = 0;  // 75 blocks of 400 end below zero
  for (int k = 0; k < 75; ++k, s += 400)
    if (const auto spectrum = display.take(block(s, 400), k * 0.02)) {
      seen = *spectrum;
      last = s + 399;
    }
  ASSERT_LT(s, 0);
  EXPECT_GE(seen.segments, 2) << "pieces are averaged there too";
  const Tolerance rounding = within(1e-6, "single precision");
  EXPECT_TRUE(near(seen.simulated.at(611), 3 / std::sqrt(2 * 1.5 * df), rounding));
  EXPECT_TRUE(near(seen.measured.at(700), 0.003 / std::sqrt(2 * 1.5 * df), rounding));
  EXPECT_LT(seen.measured.at(611), 1e-9);
  EXPECT_EQ(seen.wave_simulated.size(), 512u);
  EXPECT_TRUE(near(seen.wave_simulated.back(), block(last, 1).simulated(0, 1), rounding));
}

TEST(PlaceSpectrum, APlaceWithoutSensorHasTheTwinAlone)
{
  live::PlaceSpectrum display;
  display.choose("upper_frame");
  display.begin(source());
  std::int64_t s  = 0;
  const auto seen = last_of(display, s);
  EXPECT_EQ(seen.place, "upper_frame");
  EXPECT_TRUE(seen.measured.empty() && seen.wave_measured.empty());
  EXPECT_EQ(seen.simulated.size(), 1024u);
  display.choose("nothing of this name");
  EXPECT_EQ(display.place(), "upper_frame");
  display.choose("upper_work_roll");  // the samples of all places are kept
  const auto next = display.take(block(s, 400), 100);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->place, "upper_work_roll");
  EXPECT_EQ(next->segments, 1);
}

TEST(PlaceSpectrum, DoesNotAverageSamplesFromBeforeAChange)
{
  live::PlaceSpectrum display;
  display.begin(source());
  std::int64_t s = 0;
  EXPECT_GE(last_of(display, s).segments, 3);
  display.twin_changed();
  const std::int64_t change = s;
  int whole                 = 0;
  for (int k = 0; k < 75; ++k, s += 400)
    if (const auto spectrum = display.take(block(s, 400), double(s) / rate)) {
      if (s + 400 - change >= 16384)  // nothing of before is in the piece
        ++whole;
      EXPECT_EQ(spectrum->segments, std::max(1, whole)) << double(s - change) / rate << " s after the change";
    }
  EXPECT_GE(whole, 2);
  for (int k = 0; k < 5; ++k)
    last_of(display, s);
  EXPECT_EQ(last_of(display, s).segments, 24);
}

TEST(PlaceSpectrum, MissingSamplesAndGapsAreNotBridged)
{
  live::PlaceSpectrum display;
  display.begin(source());
  std::int64_t s = 0;
  last_of(display, s);
  auto missing           = block(s, 400);
  missing.measured(7, 1) = NAN;
  display.twin_changed();
  const auto holed = display.take(missing, 100);
  ASSERT_TRUE(holed);
  EXPECT_TRUE(holed->measured.empty());
  EXPECT_EQ(holed->simulated.size(), 1024u);
  auto after      = block(s + 400, 16000);
  after.after_gap = true;
  EXPECT_FALSE(display.take(after, 200));  // 0.8 s are not there yet
  EXPECT_TRUE(display.take(block(s + 16400, 400), 300));
}
