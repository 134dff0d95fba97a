// Families of lines, side bands, combs of lost samples, and images only where chance does not make them.
#include "tests/support/near.h"
#include "tests/support/synthetic_record.h"
#include "twin/analysis/analysis.h"
#include "twin/analysis/owner.h"
#include "twin/detection/line_families.h"
#include "twin/detection/lost_samples.h"
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

using namespace mill;
using namespace mill::twin;

namespace {
std::vector<SeenLine> seen(const std::vector<double> &frequencies, const double deviation = 0.005)
{
  std::vector<SeenLine> lines;
  for (std::size_t i = 0; i < frequencies.size(); ++i)
    lines.push_back({frequencies[i], deviation, 1.0 / double(1 + i)});
  return lines;
}

Eigen::VectorXd sum_of_lines(const std::vector<std::pair<double, double>> &lines, const double noise,
                             const std::uint64_t seed, const double rate, const Eigen::Index n)
{
  Eigen::VectorXd x = noise * synthetic::normals(seed, n);
  for (const auto &[f, a] : lines)
    for (Eigen::Index k = 0; k < n; ++k)
      x[k] += a * std::sin(2 * M_PI * std::fmod(f * double(k) / rate, 1.0) + f);
  return x;
}

Analysis analysis_of_one(const Eigen::VectorXd &x, const double rate)
{
  RawRecord raw;
  raw.file = "record.csv";
  raw.rate = rate;
  raw.channels.push_back({"motor", "motor", "m/s2", Quantity::acceleration, true, {}, x});
  return analyse(clean_record(std::move(raw)), nullptr, {}, {});
}
}  // namespace

TEST(LineFamilies, HarmonicsAreOneFamilyWhoseFundamentalIsTheLargest)
{
  std::vector<double> f{17.77, 205.3};
  for (int h = 1; h <= 25; ++h)
    f.push_back(31.21 * h + (h % 2 ? 0.003 : -0.003));
  const auto families = lines_in_families(seen(f), {});
  ASSERT_EQ(families.families.size(), 1u);
  EXPECT_TRUE(near(families.families[0].fundamental, 31.21, within(1e-5, "mean of 25 lines known to 0.005 Hz")));
  EXPECT_EQ(families.families[0].orders.size(), 25u);
  EXPECT_EQ(families.free.size(), 2u);
}

TEST(LineFamilies, MainsOfTheMeasuredFrequency)
{
  const std::vector<KnownFundamental> known{{"mains, 50 Hz", 50, 0.004, 2}, {"mains, 60 Hz", 60, 0.004, 2}};
  const auto families = lines_in_families(seen({60.01, 120.02, 180.03, 360.06, 29.93, 299.3}), known);
  ASSERT_EQ(families.families.size(), 1u);
  EXPECT_EQ(families.families[0].name, "mains, 60 Hz");
  EXPECT_EQ(families.families[0].orders, (std::vector<int>{1, 2, 3, 6}));
  EXPECT_EQ(families.free.size(), 2u) << "29.93 and 299.3 Hz are not mains";
}

TEST(LineFamilies, LinesOfNoFamilyAreNone)
{
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Eigen::VectorXd u = synthetic::uniforms(seed, 30);
    std::vector<double> f;
    for (const double part : u)
      f.push_back(10 + 800 * part);
    const auto families = lines_in_families(seen(f, 0.003), {});
    EXPECT_EQ(families.families.size() + families.side_bands.size(), 0u) << "seed " << seed;
  }
}

TEST(LineFamilies, SideBandsOfHarmonicsHaveOneCarrierAndOneSpacing)
{
  std::vector<double> f;
  for (int h = 1; h <= 6; ++h)
    for (int j = -2; j <= 2; ++j)
      f.push_back(243.19 * h + 29.95 * j);
  f.push_back(29.95);
  const auto families = lines_in_families(seen(f), {});
  ASSERT_EQ(families.families.size(), 1u);
  EXPECT_TRUE(near(families.families[0].fundamental, 243.19,
                   within_absolute(0.01, "hertz; lines known to 0.005 Hz, two deviations")));
  ASSERT_GE(families.side_bands.size(), 1u);
  EXPECT_TRUE(near(families.side_bands[0].spacing, 29.95,
                   within_absolute(0.01, "hertz; lines known to 0.005 Hz, two deviations")));
  EXPECT_GE(families.side_bands[0].places.size(), 20u) << "of 24";
}

// Sixty harmonics of a shaft, all below half the rate: one finding, and no image among the chance hits of h x
// line.
TEST(LineFamilies, HarmonicsOfAShaftAreOneFinding)
{
  std::vector<std::pair<double, double>> lines;
  for (int h = 1; h <= 60; ++h)
    lines.push_back({24.37 * h, 0.2 + 0.8 * std::abs(std::sin(3.0 * h))});
  const auto analysis = analysis_of_one(sum_of_lines(lines, 0.02, 3, 4000, 40000), 4000);
  ASSERT_EQ(analysis.findings.size(), 1u);
  const Finding &family = analysis.findings[0];
  EXPECT_EQ(family.kind, FindingKind::family);
  EXPECT_TRUE(near(family.frequency, 24.37,
                   within_absolute(0.005, "hertz; sixty harmonics, each known to a part of a bin")));
  EXPECT_EQ(family.members.size(), 60u);
  EXPECT_EQ(family.owner, "harmonics 1 to 60 of 24.37 Hz");
  EXPECT_GT(analysis.channels[0].account.families, 0.99);
}

// A recorder that loses samples behind every block: a comb of rate over block.
TEST(LostSamplesOfARecorder, AreNamedAsOneComb)
{
  for (const auto &[block, lost] : std::vector<std::pair<int, int>>{{64, 8}, {100, 7}, {256, 30}}) {
    const double rate = 6000;
    Eigen::VectorXd x = 0.02 * synthetic::normals(9, 60000);
    for (Eigen::Index k = 0; k < x.size(); ++k)
      x[k] += std::sin(2 * M_PI * 137 * double(k + lost * (k / block)) / rate);
    const auto analysis = analysis_of_one(x, rate);
    const auto comb = std::find_if(analysis.findings.begin(), analysis.findings.end(), [](const Finding &finding) {
      return finding.kind == FindingKind::lost_samples;
    });
    ASSERT_NE(comb, analysis.findings.end()) << block;
    EXPECT_NE(comb->owner.find("blocks of " + std::to_string(block) + " samples"), std::string::npos)
        << comb->owner;
    EXPECT_GE(comb->members.size(), 3u);
    for (const Finding &finding : analysis.findings)
      EXPECT_EQ(finding.owner.find("image"), std::string::npos) << finding.owner;
  }
}

// A tone that is modulated at rate/240 is not a recorder that loses samples: nothing jumps.
TEST(LostSamplesOfARecorder, ModulationAtAWholePartOfTheRateIsNone)
{
  const double rate = 6000;
  Eigen::VectorXd x = 0.02 * synthetic::normals(9, 60000);
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const double t = double(k) / rate;
    x[k] +=
        (1 + 0.5 * std::sin(2 * M_PI * 25 * t) + 0.3 * std::sin(2 * M_PI * 50 * t)) * std::sin(2 * M_PI * 411 * t);
  }
  for (const Finding &finding : analysis_of_one(x, rate).findings)
    EXPECT_NE(finding.kind, FindingKind::lost_samples) << finding.owner;
}

TEST(Images, AreNamedOnlyWhereChanceDoesNotMakeThem)
{
  const TurningPeak peak{348.1, 0.05, true};
  const std::string image = "image of 3 x 217.30 Hz, which lies above half of the 1000 samples per second";
  EXPECT_EQ(turning_owner(peak, nullptr, std::nan(""), {217.3, 348.1}, 1000), image);
  std::vector<double> many(40);
  std::iota(many.begin(), many.end(), 200.3);
  many.push_back(217.3);
  EXPECT_EQ(turning_owner(peak, nullptr, std::nan(""), many, 1000), "")
      << "41 lines and their harmonics hit anything";
}
