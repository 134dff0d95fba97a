// Spacing of marks, rolls, events and modes behind it.
#include "core/records/json_archive.h"
#include "dynamics/marks/marks.h"
#include "dynamics/response/campbell.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include "tests/support/refusal.h"
#include <chrono>
#include <cmath>

using namespace mill;
using namespace mill::dynamics;

namespace {
MarksQuestion question()
{
  MarksQuestion q;
  q.spacing   = 2e-3;
  q.speed     = 500. / 60;
  q.side_band = 49;
  return q;
}

// Work, intermediate, external and control roll of a cluster mill with its printed frequencies.
MarkSources z_mill()
{
  MarkSources s;
  const auto radii    = reference("input.radii", "cluster");
  const char *names[] = {"work roll", "intermediate roll", "external roll", "control roll"};
  for (std::size_t i = 0; i < 4; ++i)
    s.rolls.push_back({names[i], 2 * double(radii[i])});
  int mode = 1;
  for (const double f : reference("published.frequencies", "cluster")) {
    const std::string name = "mode " + std::to_string(mode++);
    s.modes.push_back({name, name, f, 0.01});
  }
  return s;
}
}  // namespace

TEST(Marks, NumbersOfTheZMillAreThoseOfTheReference)
{
  const auto expected      = reference("marks", "cluster");
  const MarksRecord record = marks_of(question(), z_mill());
  const Tolerance closed   = within(1e-12, "closed form");
  for (std::size_t i = 0; i < 4; ++i)
    EXPECT_TRUE(near(record.rolls[i].rotation, expected[i], closed));
  EXPECT_TRUE(near(mark_spacing(question().speed, 49), expected[4], closed));
  EXPECT_TRUE(near(record.frequency, expected[5], closed));
  EXPECT_TRUE(near(record.rolls[3].per_turn, expected[6], closed));
  // Side bands of 49 Hz: 5.8 % below the control roll, exact at 471 m/min or 54.1 mm.
  EXPECT_TRUE(near(record.side_bands[3].off, -0.058, within(0.005, "printed in two digits")));
  EXPECT_TRUE(near(record.side_bands[3].exact_speed * 60, 471, within(0.001, "printed in three digits")));
  EXPECT_TRUE(near(record.side_bands[3].exact_diameter, 54.1e-3, within(0.001, "printed in three digits")));
}

TEST(Marks, PublishedSpacingsOfOtherMills)
{
  // 470 m/min and 315 Hz; 128.1 Hz at 18.2 m/s, as published.
  EXPECT_TRUE(near(mark_spacing(470. / 60, 315), 24.87e-3, within(2e-4, "printed in four digits")));
  EXPECT_TRUE(near(mark_spacing(18.2, 128.1), 142.1e-3, within(4e-4, "printed in four digits")));
  EXPECT_TRUE(near(mark_frequency(18.2, mark_spacing(18.2, 128.1)), 128.1, within(1e-15, "inverse")));
}

TEST(Marks, AWholeNumberIsAcceptedOnlyWhereItIsDistinguishable)
{
  MarkSources s;
  s.rolls         = {{"small", 20 * 2e-3 / M_PI}, {"off", 20.4 * 2e-3 / M_PI}, {"large", 80.11 * 2e-3 / M_PI}};
  const auto with = [&](const double accuracy) {
    MarksQuestion q = question();
    q.accuracy      = accuracy;
    std::string verdicts;
    for (const RollMarks &roll : marks_of(q, s).rolls)
      verdicts += roll.verdict + "; ";
    return verdicts;
  };
  EXPECT_EQ(with(0.001), "whole; between; between; ");
  EXPECT_EQ(with(0.002), "whole; between; whole; ");
  EXPECT_EQ(with(0.01), "whole; between; not distinguishable; ");
  EXPECT_EQ(with(0.03), "not distinguishable; not distinguishable; not distinguishable; ");
  EXPECT_TRUE(near(marks_of(question(), s).rolls[0].chance, 0.4, within(1e-12, "2 x 1 % x 20")));
}

TEST(Marks, ForwardSlipStretchesTheSpacing)
{
  MarksQuestion q          = question();
  const double without     = marks_of(q, z_mill()).rolls[0].per_turn;
  q.forward_slip           = 0.05;
  const MarksRecord record = marks_of(q, z_mill());
  EXPECT_TRUE(near(record.rolls[0].per_turn, 1.05 * without, within(1e-14, "the strip runs ahead")));
  EXPECT_TRUE(
      near(record.frequency / record.rolls[0].rotation, record.rolls[0].per_turn, within(1e-14, "(40.2)")));
}

TEST(Marks, EventsPerTurnAreCompared)
{
  MarkSources s = z_mill();
  // 4.1667 kHz over 49.8 of them in a second
  s.events                 = {line_of("cage", "bearing", "work roll", 0.4, 0.0696)};
  const MarksRecord record = marks_of(question(), s);
  ASSERT_EQ(record.events.size(), 1u);
  EXPECT_TRUE(near(record.events[0].multiple, record.rolls[0].per_turn / 0.4, within(1e-13, "definition")));
  EXPECT_EQ(record.events[0].verdict, "not distinguishable");
}

TEST(Marks, MeetingsLieOnModeAndRollNextToTheSpeed)
{
  const MarksQuestion q    = question();
  const MarksRecord record = marks_of(q, z_mill());
  EXPECT_EQ(record.meetings.size(), 4u * 8 * 2);
  for (const MarkMeeting &m : record.meetings) {
    const double D = record.rolls[std::size_t(m.roll)].diameter, f = record.modes[std::size_t(m.mode)].frequency;
    EXPECT_TRUE(near(m.waves * m.speed / (M_PI * D), f, within(1e-13, "(40.4)")));
    EXPECT_TRUE(near(m.speed, q.speed * (1 + m.distance), within(1e-13, "definition")));
    // one wave more or less leads to the other side
    const double other = m.distance > 0 ? m.waves + 1 : m.waves - 1;
    EXPECT_LE((M_PI * D * f / other - q.speed) * m.distance, 1e-12);
  }
  EXPECT_TRUE(near(record.modes[4].speed, 2475 * 2e-3, within(1e-14, "mode times spacing")));
  EXPECT_FALSE(record.modes[4].near);
}

TEST(Marks, MapPeaksWhereAModeIsMet)
{
  const MarksQuestion q = question();
  const MarkSources s   = z_mill();
  const MapAxes axes{Eigen::VectorXd::LinSpaced(400, 4, 12), Eigen::VectorXd::LinSpaced(400, 1, 400)};
  const auto start  = std::chrono::steady_clock::now();
  const MarkMap map = mark_map(q, s.rolls[3], s, axes);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 1.0) << "400 x 400";
  EXPECT_EQ(map.gain.rows(), 400);
  EXPECT_EQ(map.gain.cols(), 400);
  // By hand at one cell: 77 waves at 10 m/s are 4806 Hz, next modes 2475 and 6123 Hz.
  MarksQuestion one = q;
  const MarkMap cell =
      mark_map(one, s.rolls[3], s, {Eigen::VectorXd::Constant(1, 10), Eigen::VectorXd::Constant(1, 77)});
  const double r    = 77 * 10 / (M_PI * 0.051) / 6123;
  const double by_6 = -10 * std::log10(std::pow(1 - r * r, 2) + std::pow(2 * 0.01 * r, 2));
  EXPECT_TRUE(near(cell.gain(0, 0), by_6, within(1e-12, "(40.5)")));
  // On a meeting it is 1/(2 zeta).
  const MarksRecord record = marks_of(q, s);
  const MarkMeeting &m     = record.meetings[6];
  const MarkMap peak       = mark_map(q, {"", record.rolls[std::size_t(m.roll)].diameter}, s,
                                      {Eigen::VectorXd::Constant(1, m.speed), Eigen::VectorXd::Constant(1, m.waves)});
  EXPECT_TRUE(near(peak.gain(0, 0), 20 * std::log10(50), within(1e-10, "damping of 1 %")));
}

TEST(Marks, AxesOfTheMapCoverTheRequestOrTheModes)
{
  const MarksQuestion q = question();
  const auto modes      = z_mill().modes;
  const auto none       = std::vector<CampbellMode>();
  const auto holds      = [](const MapAxes &axes, const double n) {
    return axes.waves[0] <= n && axes.waves[axes.waves.size() - 1] >= n;
  };
  for (const double diameter : {0.02, 0.051, 0.25, 1.45}) {
    const double n     = marks_per_turn(q.spacing, diameter);
    const MapAxes axes = map_axes(q, diameter, modes);
    EXPECT_LE(axes.waves.size(), 400);
    EXPECT_EQ(axes.speed.size(), 400);
    EXPECT_TRUE(holds(axes, n)) << "the modes reach to 10 kHz";
    EXPECT_GE(axes.waves[0], 1);
    EXPECT_TRUE(holds(map_axes(q, diameter, none), std::min(n, 400.0)));
  }
  // 2278 waves at 4.2 kHz, the only mode at 100 Hz: the map shows where that one is met.
  const MapAxes low = map_axes(q, 1.45, {{"a", "a", 100, 0.01}});
  EXPECT_EQ(low.waves[0], 1);
  EXPECT_TRUE(holds(low, M_PI * 1.45 * 100 / q.speed));
}

TEST(Marks, RefusesWrongInputAndNotesLimits)
{
  MarksQuestion q = question();
  q.spacing       = -1;
  EXPECT_EQ(refusal([&] { marks_of(q, z_mill()); }), "the spacing of the marks must be positive");
  EXPECT_EQ(refusal([&] { marks_of(question(), {}); }),
            "marks: no roll of the case has a diameter, so that no spacing can be laid around it");
  MarkSources s = z_mill();
  s.modes.clear();
  s.rolls.push_back({"spare roll", not_given});
  const MarksRecord record = marks_of(question(), s);
  EXPECT_EQ(record.notes, (std::vector<std::string>{
                              "the diameter of the spare roll is not known: it is left out",
                              "no mode of the stand is known: the spacing is laid around the rolls only"}));
}

TEST(Marks, RecordGoesThroughJson)
{
  MarkSources s      = z_mill();
  MarksRecord record = marks_of(question(), s);
  record.maps.push_back(mark_map(question(), s.rolls[0], s, map_axes(question(), 0.0696, s.modes, 5, 6)));
  EXPECT_EQ(json_of_record(record), json_of_record(record_of_json<MarksRecord>(json_of_record(record))));
}
