// What a record has wrong is counted, dated and listed: TW-05, and each fault by itself.
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include "tests/support/synthetic_record.h"
#include "twin/cleaning/clean_record.h"
#include "twin/cleaning/spline.h"
#include <array>

using namespace mill;
using namespace mill::twin;

namespace {
RawRecord even(const Eigen::VectorXd &value, const double rate)
{
  RawRecord record;
  record.file = "r.csv";
  record.rate = rate;
  record.channels.push_back({"a", "a", "m/s2", Quantity::acceleration, true, {"r.csv", 1, 10}, value});
  return record;
}

Eigen::VectorXd noise(const Eigen::Index n)
{
  return synthetic::normals(5, n);
}

std::string refusal(RawRecord record)
{
  try {
    clean_record(std::move(record));
  } catch (const InputError &error) {
    const Place &place = error.problems.at(0).place;
    return std::to_string(place.line) + ":" + std::to_string(place.column) + ": " + error.problems.at(0).message;
  }
  return "accepted";
}
}  // namespace

TEST(Cleaning, FactsOfTheRecordOfLines)
{
  const auto in = reference("lines.inputs", "twin"), facts = reference("clean.facts", "twin");
  const double rate = in["fs"];
  const int n       = in["n"];
  Eigen::VectorXd x = synthetic::lines_record(in["lines"].get<std::vector<std::array<double, 3>>>(), in["offset"],
                                              in["drift"], in["density"], in["seed"].get<int>(), n, rate);
  const double clip = in["clip"];
  x                 = x.cwiseMin(clip).cwiseMax(-clip);
  for (int i = 0; i < in["nan_n"].get<int>(); ++i)
    x[in["nan0"].get<int>() + i * in["nan_step"].get<int>()] = std::nan("");
  const Eigen::VectorXd jitter = in["jitter"].get<double>() * synthetic::normals(in["jitter_seed"].get<int>(), n);
  const int gap = in["gap"][0], lost = in["gap"][1];
  RawRecord raw = even(Eigen::VectorXd(n - lost), 0);
  raw.time.resize(n - lost);
  for (int i = 0, k = 0; k < n; ++k) {
    if (k >= gap && k < gap + lost)
      continue;
    raw.time[i]                = k / rate + jitter[k];
    raw.channels[0].value[i++] = x[k];
  }
  const CleanRecord clean     = clean_record(std::move(raw));
  const CleanChannel &channel = clean.channels[0];
  EXPECT_EQ(channel.missing, facts["nan"].get<int>());
  EXPECT_EQ(channel.clipped, facts["clipped"].get<int>());
  EXPECT_EQ(channel.clip_high, facts["clip_level"].get<double>());
  EXPECT_EQ(channel.clip_low, -facts["clip_level"].get<double>());
  EXPECT_TRUE(near(clean.rate, facts["rate"], within(1e-8, "same line through the times")));
  EXPECT_TRUE(near(clean.jitter, facts["jitter_rms"], within(0.02, "asked for")));
  EXPECT_TRUE(near(channel.drift, facts["drift"], within(0.02, "asked for")));
  EXPECT_TRUE(clean.interpolated);
  ASSERT_FALSE(clean.events.empty());
  EXPECT_EQ(clean.events[0].fault, CleaningFault::gap);
  EXPECT_EQ(clean.events[0].count, facts["gap_samples"].get<int>());
  EXPECT_TRUE(near(clean.events[0].from, facts["gap_start"].get<double>(),
                   within_absolute(1e-6, "half of the jitter of the times")));
  ASSERT_EQ(channel.pieces.size(), 2u);
  EXPECT_EQ(channel.pieces[0].end, gap);
  EXPECT_EQ(channel.pieces[1].begin, gap + lost);
}

TEST(Cleaning, ASplineIsExactForACubicAndInBlocks)
{
  const Eigen::Index m = 100000;
  Eigen::VectorXd x(m), y(m);
  for (Eigen::Index i = 0; i < m; ++i) {
    x[i] = double(i) + 0.3 * std::sin(double(i));
    y[i] = std::sin(0.05 * x[i]);
  }
  const Eigen::VectorXd values = spline_on_grid(x, y, 0, 1, m - 1);
  double worst                 = 0;
  for (Eigen::Index k = 60; k < m - 61; ++k)
    worst = std::max(worst, std::abs(values[k] - std::sin(0.05 * double(k))));
  EXPECT_LT(worst, 5 * std::pow(0.05 * 1.6, 4) / 384)
      << "error of a cubic spline: 5/384 h^4 of the fourth derivative";
}

TEST(Cleaning, ShortGapsAreFilledLongOnesCut)
{
  Eigen::VectorXd x = noise(5000);
  x[100] = x[101] = std::nan("");
  x.segment(2000, 3).setConstant(std::nan(""));
  const double before = x[99], after = x[102];
  const CleanRecord clean = clean_record(even(x, 1000));
  const CleanChannel &c   = clean.channels[0];
  EXPECT_EQ(c.missing, 5);
  EXPECT_EQ(c.filled, 2);
  ASSERT_EQ(c.pieces.size(), 2u);
  EXPECT_EQ(c.pieces[0].end, 2000);
  EXPECT_EQ(c.pieces[1].begin, 2003);
  EXPECT_TRUE(near(c.value[100] - c.value[99], (after - before) / 3,
                   within_absolute(1e-3, "the drift of the record over one sample is taken away")))
      << "less the drift";
  ASSERT_EQ(clean.events.size(), 2u);
  EXPECT_EQ(clean.events[0].done, "filled linearly");
  EXPECT_EQ(clean.events[1].done, "record cut here");
  EXPECT_TRUE(near(clean.events[1].from, 2.0, within_absolute(1e-9, "sample number over the rate, rounding")));
}

// Every fifth row is missing for all channels: each gap of the rows is looked up once.
TEST(Cleaning, GapsOfTheRowsAreNotListedForEachChannelAgain)
{
  const Eigen::Index n = 400000, n_gaps = n / 4 - 1;
  RawRecord record = even(noise(n), 0);
  record.time      = Eigen::VectorXd(n);
  for (Eigen::Index i = 0; i < n; ++i)
    record.time[i] = 1e-3 * double(i + i / 4);
  Eigen::VectorXd &x = record.channels[0].value;
  x[1] = x[3] = x[4]      = std::nan("");  // a cell, and two on both sides of a gap
  const CleanRecord clean = clean_record(std::move(record));
  std::vector<CleaningEvent> of_rows, of_channel;
  for (const CleaningEvent &event : clean.events)
    (event.channel.empty() ? of_rows : of_channel).push_back(event);
  EXPECT_EQ(of_rows.size(), 200u);
  EXPECT_EQ(clean.notes.back(),
            "rows: " + std::to_string(n_gaps) + " faults were found, the first 200 are listed");
  ASSERT_EQ(of_channel.size(), 2u);
  EXPECT_EQ(of_channel[0].count, 1);
  EXPECT_TRUE(near(of_channel[0].from, 1e-3, within_absolute(1e-9, "sample number over the rate, rounding")));
  EXPECT_EQ(of_channel[1].count, 3);
  EXPECT_TRUE(near(of_channel[1].from, 3e-3, within_absolute(1e-9, "sample number over the rate, rounding")));
}

// Of a record whose times are uneven a spline fills one and two empty cells; it ends at more, and at the ends.
TEST(Cleaning, EmptyCellsOfUnevenTimesAreFilledOrCut)
{
  const Eigen::Index n = 20000;
  RawRecord record     = even(noise(n), 0);
  record.time          = 1e-3 * Eigen::VectorXd::LinSpaced(n, 0, double(n - 1)) + 5e-5 * synthetic::normals(7, n);
  Eigen::VectorXd &x   = record.channels[0].value;
  x.segment(100, 1).setConstant(std::nan(""));
  x.segment(2000, 2).setConstant(std::nan(""));
  x.segment(5000, 3).setConstant(std::nan(""));
  x.tail(4).setConstant(std::nan(""));
  const CleanRecord clean = clean_record(std::move(record));
  const CleanChannel &c   = clean.channels[0];
  ASSERT_TRUE(clean.interpolated);
  EXPECT_EQ(c.missing, 10);
  EXPECT_EQ(c.filled, 3);
  ASSERT_EQ(c.pieces.size(), 2u);
  EXPECT_EQ(c.pieces[0].end, 5000);
  EXPECT_EQ(c.pieces[1].begin, 5003);
  EXPECT_EQ(c.pieces[1].end, n - 4);
  std::vector<CleaningEvent> events;
  for (const CleaningEvent &event : clean.events)
    if (event.channel == "a")
      events.push_back(event);
  ASSERT_EQ(events.size(), 4u);
  const char *done[] = {"filled by the cubic spline", "filled by the cubic spline", "record cut here",
                        "record cut here"};
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(events[i].count, Eigen::Index(i) + 1);
    EXPECT_EQ(events[i].done, done[i]);
  }
}

// A gap of 300 s at 1 MHz would be 2.4 GB of missing samples for each channel.
TEST(Cleaning, ShortensAGapThatIsMuchLongerThanTheRecord)
{
  const Eigen::Index n = 20000;
  RawRecord record     = even(noise(n), 0);
  record.time          = 1e-6 * Eigen::VectorXd::LinSpaced(n, 0, double(n - 1));
  record.time.tail(n / 2).array() += 300;
  const CleanRecord clean = clean_record(std::move(record));
  EXPECT_TRUE(near(clean.rate, 1e6, within(1e-6, "times of 300 s resolve 4e-14 s")));
  EXPECT_LT(clean.n, Eigen::Index(1) << 21);
  ASSERT_EQ(clean.channels[0].pieces.size(), 2u);
  EXPECT_EQ(clean.channels[0].n_used(), n);
  ASSERT_EQ(clean.notes.size(), 1u);
  EXPECT_EQ(clean.notes[0].rfind("the gap of 300 s at 0.009999 s is shortened to 1.04858 s", 0), 0u)
      << clean.notes[0];
  // a gap that costs little stays as it is
  RawRecord slow = even(noise(n), 0);
  slow.time      = 1e-3 * Eigen::VectorXd::LinSpaced(n, 0, double(n - 1));
  slow.time.tail(n / 2).array() += 300;
  const CleanRecord kept = clean_record(std::move(slow));
  EXPECT_EQ(kept.n, n + 300000);
  EXPECT_TRUE(kept.notes.empty());
}

TEST(Cleaning, WhatStandsStillIsRemoved)
{
  Eigen::VectorXd x = noise(20000);
  x.segment(5000, 60).setConstant(0.25);
  x.segment(9000, 40).setConstant(0.5);  // too short: 4 ms
  const CleanRecord clean = clean_record(even(x, 10000));
  EXPECT_EQ(clean.channels[0].stuck, 60);
  ASSERT_EQ(clean.channels[0].pieces.size(), 2u);
  EXPECT_EQ(clean.channels[0].pieces[0].end, 5000);
  EXPECT_EQ(clean.channels[0].pieces[1].begin, 5060);
}

TEST(Cleaning, ASpeedMayStandStill)
{
  RawRecord raw = even(noise(4000), 1000);
  raw.channels.push_back(
      {"speed", "speed", "m/s", Quantity::speed, true, {}, Eigen::VectorXd::Constant(4000, 4.0)});
  const CleanRecord clean = clean_record(std::move(raw));
  EXPECT_EQ(clean.channels[1].pieces.size(), 1u);
  EXPECT_EQ(clean.channels[1].value[77], 4.0);
  EXPECT_EQ(clean.channels[1].clipped, 0);
}

TEST(Cleaning, NoiseHasNoFault)
{
  for (int seed = 1; seed <= 20; ++seed) {
    const CleanRecord clean = clean_record(even(synthetic::normals(std::uint64_t(seed), 20000), 20000));
    EXPECT_TRUE(clean.events.empty()) << "seed " << seed;
  }
}

TEST(Cleaning, Refusals)
{
  EXPECT_EQ(refusal(even(Eigen::VectorXd::Constant(3000, 1.5), 1000)),
            "1:10: every channel stands still or is empty (a: constant, 1.5 m/s2); check cables and amplifiers, "
            "or choose "
            "another record");
  RawRecord coarse  = even(noise(3000), 0);
  coarse.time_place = {"r.csv", 1, 1};
  coarse.time.resize(3000);
  for (int i = 0; i < 3000; ++i)
    coarse.time[i] = std::floor(i / 20.0) * 1e-3;
  EXPECT_EQ(refusal(coarse),
            "1:1: the time column is too coarse, most samples have the time of their neighbour; give --rate");
  for (int i = 0; i < 3000; ++i)
    coarse.time[i] = (i % 20 == 19 ? i - 1 : i) * 1e-3;
  EXPECT_EQ(
      refusal(coarse),
      "1:1: the time column is too coarse, 150 of 3000 samples have the time of their neighbour; give --rate");
  const Eigen::VectorXd away = synthetic::uniforms(3, 3000);
  for (int i = 0; i < 3000; ++i)
    coarse.time[i] = (i + 0.5 * std::sin(1e-2 * i) * 3) * 1e-3;
  EXPECT_EQ(refusal(coarse),
            "1:1: the time column is too coarse, samples are 1.1 steps away from an even grid; give --rate");
}
