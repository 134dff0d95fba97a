// [monitoring] of a case: what it gives, and what is refused word for word.
#include "core/case/monitoring.h"
#include "core/model/case.h"
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

using namespace mill;

namespace {
class MonitoringSection : public testing::Test {
protected:
  std::string path = testing::TempDir() + "millstand_monitoring_test.toml";
  void TearDown() override
  {
    std::filesystem::remove(path);
  }
  // A case of given masses and springs with lines of [monitoring].
  std::string with(const std::string &lines)
  {
    std::ofstream out(path);
    out << "schema = 1\nkind = \"lumped\"\n[given]\n";
    for (int i = 1; i <= 6; ++i)
      out << "M" << i << " = \"5000 kg\"\n";
    for (int i = 1; i <= 7; ++i)
      out << "K" << i << " = \"1e4 kN/mm\"\n";
    out << "[monitoring]\n" << lines;
    return path;
  }
  std::string refusal(const std::string &lines)
  {
    try {
      read_case(with(lines));
    } catch (const InputError &error) {
      return error.problems.at(0).message;
    }
    return "accepted";
  }
};
}  // namespace

TEST_F(MonitoringSection, NamesZonesAndBands)
{
  with("channels = { \"AI_07\" = \"upper_work_roll\", \"Kraft 1\" = \"force\" }\n"
       "severity = [\"2.3 mm/s\", \"4.5 mm/s\"]\nthird_octave = [\"100 Hz\", \"300 Hz\"]\nlimit = \"2 "
       "g\"\nbaseline = \"before\"\n");
  const Monitoring m = monitoring_of(path);
  EXPECT_EQ(m.channels(),
            (std::map<std::string, std::string>{{"AI_07", "upper_work_roll"}, {"Kraft 1", "force"}}));
  ASSERT_EQ(m.zones().size(), 2u);
  EXPECT_DOUBLE_EQ(m.zones()[1], 4.5e-3);
  EXPECT_EQ(m.third_octave, (std::array<double, 2>{100, 300}));
  EXPECT_EQ(m.fifth_octave, (std::array<double, 2>{550, 650})) << "when absent";
  EXPECT_DOUBLE_EQ(m.limit, 2 * 9.80665);
  EXPECT_EQ(std::filesystem::path(m.baseline).filename(), "before");
  const Case the_case = read_case(path);
  EXPECT_NE(the_case.resolved.find("channels = { \"AI_07\" = \"upper_work_roll\", \"Kraft 1\" = \"force\" }"),
            std::string::npos);
  ASSERT_EQ(the_case.warnings.size(), 1u);
  EXPECT_EQ(the_case.warnings[0].key, "monitoring.baseline");
  EXPECT_EQ(the_case.warnings[0].fact, "monitoring.baseline = \"before\" holds no analysis.json");
  EXPECT_TRUE(monitoring_of(with("severity = [\"2.3 mm/s\"]\n")).channels().empty());
}

TEST_F(MonitoringSection, Refusals)
{
  EXPECT_EQ(refusal("channels = \"AI_07\"\n"),
            "monitoring.channels = \"AI_07\" is not a list of names; a table of names such as "
            "{ \"AI_07\" = \"upper_work_roll\", \"AI_08\" = \"lower_work_roll\" } is needed");
  EXPECT_EQ(refusal("channels = { AI_07 = \"force\", AI_08 = \"force\" }\n"),
            "monitoring.channels.AI_08 = \"force\" appears twice");
  EXPECT_EQ(refusal("channels = { AI_07 = 3 }\n"),
            "monitoring.channels.AI_07 = 3 is not a name; a table of names such as "
            "{ \"AI_07\" = \"upper_work_roll\", \"AI_08\" = \"lower_work_roll\" } is needed");
  EXPECT_EQ(refusal("severity = [\"2.3 mm\"]\n"), "monitoring.severity = [\"2.3 mm\"] holds '2.3 mm'; a velocity "
                                                  "above zero is needed, for example \"2.3 mm/s\"");
  EXPECT_EQ(refusal("severity = [\"4.5 mm/s\", \"2.3 mm/s\"]\n"),
            "monitoring.severity = [\"4.5 mm/s\", \"2.3 mm/s\"] does not increase; write the upper end of the "
            "lowest zone first");
  EXPECT_EQ(
      refusal("fifth_octave = [\"650 Hz\", \"550 Hz\"]\n"),
      "monitoring.fifth_octave = [\"650 Hz\", \"550 Hz\"] does not increase; write the lower frequency first");
  EXPECT_EQ(refusal("limit = \"20 mm/s\"\n"), "monitoring.limit = \"20 mm/s\" is a speed; an acceleration is "
                                              "needed, for example \"20 m/s2\"");
  EXPECT_EQ(refusal("limit = \"0 g\"\n"), "monitoring.limit = \"0 g\" is outside 0.001 m/s2 .. 100000 m/s2");
  EXPECT_EQ(refusal("third_octave = \"125 Hz\"\n").find("monitoring.third_octave = \"125 Hz\" is not a pair"), 0u);
  EXPECT_NE(refusal("chanels = { AI_07 = \"force\" }\n").find("did you mean 'channels'?"), std::string::npos);
}

TEST_F(MonitoringSection, BallBearings)
{
  const std::string whole =
      "[[monitoring.ball_bearing]]\nname = \"axial\"\nroll = \"backup roll\"\nballs = 14\n"
      "ball_diameter = \"38.1 mm\"\npitch_diameter = \"240 mm\"\ncontact_angle = \"40 deg\"\n";
  const Monitoring m = monitoring_of(with(whole));
  ASSERT_EQ(m.ball_bearings.size(), 1u);
  EXPECT_EQ(m.ball_bearings[0].name, "axial");
  EXPECT_EQ(m.ball_bearings[0].roll, RollKind::backup_roll);
  EXPECT_EQ(m.ball_bearings[0].balls, 14);
  EXPECT_DOUBLE_EQ(m.ball_bearings[0].ball_diameter, 0.0381);
  EXPECT_DOUBLE_EQ(m.ball_bearings[0].pitch_diameter, 0.24);
  EXPECT_DOUBLE_EQ(m.ball_bearings[0].contact_angle, 40 * std::acos(-1) / 180);
  EXPECT_NE(read_case(path).resolved.find("[[monitoring.ball_bearing]]"), std::string::npos);

  const auto changed = [&](const std::string &from, const std::string &to) {
    std::string text = whole;
    text.replace(text.find(from), from.size(), to);
    return refusal(text);
  };
  EXPECT_EQ(changed("\"240 mm\"", "\"30 mm\"")
                .find("monitoring.ball_bearing.0.ball_diameter = \"38.1 mm\" is not "
                      "below the pitch diameter"),
            0u);
  EXPECT_EQ(changed("balls = 14", "balls = 20")
                .find("monitoring.ball_bearing.0.balls = 20 do not fit on the pitch "
                      "circle"),
            0u)
      << "20 balls of 38.1 mm touch on a circle of 243.6 mm";
  EXPECT_EQ(changed("balls = 14", "balls = 2").find("monitoring.ball_bearing.0.balls = 2 is outside 3 .. 200"),
            0u);
  EXPECT_EQ(changed("\"38.1 mm\"", "\"38.1 kN\"")
                .find("monitoring.ball_bearing.0.ball_diameter = \"38.1 kN\" is a "
                      "force"),
            0u);
  EXPECT_EQ(changed("\"40 deg\"", "\"70 deg\"")
                .find("monitoring.ball_bearing.0.contact_angle = \"70 deg\" is "
                      "outside 0 deg .. 60 deg"),
            0u);
  EXPECT_NE(changed("balls = 14\n", "").find("has no 'balls'; add for example balls = 14"), std::string::npos)
      << changed("balls = 14\n", "");
  EXPECT_NE(changed("\"backup roll\"", "\"motor\"").find("work roll"), std::string::npos);
  EXPECT_EQ(refusal(whole + whole).find("monitoring.ball_bearing.1.name = \"axial\" names two bearings"), 0u);
  EXPECT_EQ(refusal("ball_bearing = 3\n").find("[[monitoring.ball_bearing]] is written in double brackets"), 0u);
}
