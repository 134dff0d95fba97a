#include "core/base/files.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include "tests/support/reference.h"
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

// The static half of a cluster mill as a user meets it: forces, fits, one hardening law, dynamic force.
namespace {
const std::string z_mill = "cases/z-mill.toml";

nlohmann::json json_in(const std::string &file)
{
  return nlohmann::json::parse(mill::read_text(file));
}

const std::string &stiffness_run()
{
  static const std::string folder = [] {
    const std::string path = scratch("pass-forces");
    const Outcome run      = millstand("stiffness " + z_mill + " -q -o " + path);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return path;
  }();
  return folder;
}

// What `check` says of the case with pieces of its text replaced.
std::string refused(const std::vector<std::pair<std::string, std::string>> &changes)
{
  std::string text = mill::read_text(std::string(MILLSTAND_SOURCE_DIR) + "/" + z_mill);
  for (const auto &[from, to] : changes) {
    const auto position = text.find(from);
    EXPECT_NE(position, std::string::npos) << from;
    text.replace(position, from.size(), to);
  }
  const std::string file = scratch("z-mill-changed") + ".toml";
  mill::write_atomically(file, text);
  const Outcome run = millstand("check " + file);
  EXPECT_EQ(run.exit_code, 2) << run.out;
  std::filesystem::remove(file);
  return run.err;
}
}  // namespace

TEST(PassForcesCommand, FitsOfTheReferenceAreResults)
{
  const auto all          = json_in(stiffness_run() + "/results.json").at("values");
  const Tolerance regress = within(1e-7, "root finding; fitted, a regression");
  const auto value        = [&](const std::string &name) { return all.at(name).at("value").get<double>(); };
  for (const int pass : {1, 3, 5}) {
    const auto entry       = reference("tuned_k.pass_" + std::to_string(pass), "cluster");
    const std::string name = "cluster.pass " + std::to_string(pass) + ".";
    EXPECT_TRUE(near(value(name + "flow_stress"), entry["flattened"]["k"], regress));
    EXPECT_TRUE(near(value(name + "flow_stress_unflattened"), entry["unflattened"]["k"], regress));
    EXPECT_TRUE(near(value(name + "flattened_radius"), entry["flattened"]["R"], regress));
    EXPECT_TRUE(near(value(name + "deformation_power"), entry["power"]["P_w"], regress));
    EXPECT_TRUE(near(value(name + "deformation_torque"), entry["power"]["torque"], regress));
    const std::string source = all.at(name + "flow_stress").at("source");
    EXPECT_NE(source.find("fit of one unknown"), std::string::npos) << source;
    EXPECT_TRUE(all.at(name + "flow_stress").at("error_estimate").is_null())
        << "a fit that must agree has no error";
  }
  EXPECT_TRUE(
      near(value("cluster.schedule.hardening_stress"), reference("hardening.flattened", "cluster")["Y"], regress));
  EXPECT_TRUE(near(value("cluster.schedule.hardening_exponent"), reference("hardening.flattened", "cluster")["n"],
                   regress));
  EXPECT_TRUE(
      near(value("cluster.schedule.dynamic_constant"), reference("P_d.flattened.common_G", "cluster"), regress));
  EXPECT_TRUE(near(value("cluster.pass 5.dynamic_force"), reference("P_d.flattened", "cluster")[2][4], regress));
}

TEST(PassForcesCommand, BlindPassesAreMarkedOnThePage)
{
  const auto record = json_in(stiffness_run() + "/curves/schedule.json");
  EXPECT_EQ(record.at("passes").size(), 5u);
  EXPECT_FALSE(record.at("passes")[1].at("in_common_fit").get<bool>());
  EXPECT_FALSE(record.at("dynamics")[1].at("passes")[3].at("in_fit").get<bool>());
  EXPECT_EQ(record.at("laws")[1].at("data").get<int>(), 3);
  const std::string page = mill::read_text(stiffness_run() + "/report.html");
  EXPECT_NE(page.find("Rolling force of the passes"), std::string::npos);
  EXPECT_NE(page.find("Fits of one unknown"), std::string::npos);
}

TEST(PassForcesCommand, RefusesWithThePlaceOfThePass)
{
  const std::string friction = refused({{"per_log_speed = -0.00662", "per_log_speed = -0.0662"}});
  EXPECT_NE(friction.find(
                ": error: pass \"pass 1\": strip.friction: the speed law gives mu = -0.005265 at 2.967 m/s; it "
                "must be positive\n"),
            std::string::npos)
      << friction;
  const std::string none =
      refused({{"load = \"1302 kN\"\n", ""},
               {"law = \"power\"\nk = \"1604 MPa\"\nn = 0.290", "law = \"constant\"\nk = \"2000 MPa\""},
               {"at_unit_speed = 0.066723", "at_unit_speed = 0.114037"}});
  EXPECT_NE(none.find(": error: pass \"pass 5\": roll bite: no flattened radius: R'/R = "), std::string::npos)
      << none;
  EXPECT_NE(none.find("a smaller work roll, less friction, more tension, or a thicker strip.exit_thickness"),
            std::string::npos);
}

TEST(PassForcesCommand, MarksOfAClusterNameItsRolls)
{
  const std::string folder = scratch("z-mill-marks");
  const Outcome run =
      millstand("marks " + z_mill + " --spacing '2 mm' --speed '500 m/min' --side-bands '49 Hz' -o " + folder);
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto expected = reference("marks", "cluster");
  const auto all      = json_in(folder + "/results.json").at("values");
  const auto value    = [&](const std::string &name) { return all.at(name).at("value").get<double>(); };
  EXPECT_TRUE(near(value("marks.roll_W.rotation"), expected[0], within(1e-6, "closed form")));
  EXPECT_TRUE(near(value("marks.roll_L.rotation"), expected[3], within(1e-6, "closed form")));
  EXPECT_TRUE(near(value("marks.frequency"), expected[5], within(1e-6, "closed form")));
  EXPECT_TRUE(near(value("marks.roll_L.per_turn"), expected[6], within(1e-6, "closed form")));
  EXPECT_NE(run.out.find("roll L"), std::string::npos);
  EXPECT_NE(run.out.find("-5.79 %"), std::string::npos) << "side bands against the control roll: " << run.out;
}
