#include "core/base/files.h"
#include "core/records/csv.h"
#include "tests/support/near.h"
#include "tests/support/obstacles.h"
#include "tests/support/program.h"
#include "tests/support/run_results.h"
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

// Contacts as a user meets them: what the results say of themselves, and a cache that was damaged.
namespace fs = std::filesystem;

namespace {
nlohmann::json run(const std::string &what, const std::string &name, const std::string &more)
{
  const std::string out = scratch(name);
  const auto outcome    = millstand(what + " -q -o " + out + " " + more);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  return nlohmann::json::parse(std::ifstream(out + "/results.json")).at("values");
}

const std::string cylinders = "run cases/two-cylinders.toml";
}  // namespace

// Loads between which nodes join: the exact tangent of the active set steps, the reported one does not.
TEST(ContactCommand, TangentOfTwoCylindersIsTheFittedSlope)
{
  for (const double q : {800., 1000., 1250.}) {
    const auto values =
        run(cylinders, "slope",
            "--cache " + shared_cache() + " --set contact.line.at='" + std::to_string(q) + " N/mm'");
    const double johnson = check_of(values, "contact.line.tangent", "Johnson, axis to axis (3.5b)"),
                 exact   = check_of(values, "contact.line.tangent", "active set of this one load (2.8)"),
                 tangent = of(values, "contact.line.tangent");
    EXPECT_TRUE(near(tangent, johnson, within(0.002, "fit of a smooth curve; b/R = 0.006"))) << q;
    EXPECT_GE(of(values, "contact.line.tangent", "error_estimate"), std::abs(exact / tangent - 1)) << q;
  }
}

TEST(ContactCommand, ADamagedCacheChangesNothing)
{
  const std::string cache = scratch("damaged"), plain = scratch("plain");
  const std::string coarse = " --set contact.line.elements_per_half_width=2";
  run(cylinders, "plain", "--cache " + cache + coarse);
  const auto values_in = [](const std::string &folder) {
    return nlohmann::json::parse(std::ifstream(folder + "/results.json")).at("values");
  };
  const auto values        = values_in(plain);
  const std::string fields = mill::read_text(plain + "/fields/contact-line-upper.vtu").substr(400);
  std::vector<std::string> entries;
  for (const auto &entry : fs::directory_iterator(cache))
    entries.push_back(entry.path());
  ASSERT_EQ(entries.size(), 4u) << "two cylinders on two meshes, and nothing else";
  std::vector<std::string> whole;
  for (const std::string &entry : entries)
    whole.push_back(mill::read_text(entry));
  const auto expect_same = [&](const std::string &damage) {
    run(cylinders, "again", "--cache " + cache + coarse);
    EXPECT_EQ(values_in(scratch("again")), values) << damage;
    EXPECT_EQ(mill::read_text(scratch("again") + "/fields/contact-line-upper.vtu").substr(400), fields) << damage;
  };
  for (std::size_t i = 0; i < entries.size(); ++i)
    mill::write_atomically(entries[i], whole[i].substr(0, whole[i].size() / (i + 2)));
  expect_same("cut short");
  for (std::size_t i = 0; i < entries.size(); ++i) {
    std::string broken = whole[i];
    broken[broken.size() - 1 - 100 * i] ^= 4;
    mill::write_atomically(entries[i], broken);
  }
  expect_same("a flipped bit");
  for (std::size_t i = 0; i < entries.size(); ++i)
    put_obstacle(entries[i], obstacles[i]);
  expect_same("empty, a folder, a pipe, a device");
}

namespace {
// The demo stand on a coarse mesh, up to the stiffness.
const std::string stand = "stiffness cases/four-high-1400.toml --set bearing.trb.roller_law=iso --set "
                          "bearing.trb.rings=rigid --set bite.method=slab --set "
                          "contact.upper.elements_per_half_width=2 --set contact.lower.elements_per_half_width=2 "
                          "--set contact.upper.friction=1e-4 --set contact.lower.friction=1e-4 --cache ";
}  // namespace

// A friction too small to matter leaves the tangent what it is without: one mesh, one definition of the slope.
// What a large one does: frictional_pair_test.
TEST(ContactCommand, FrictionTangentIsTheTangentTimesAnEffect)
{
  const auto values    = run(stand + shared_cache(), "stand", "");
  const double tangent = of(values, "K3.tangent");
  EXPECT_TRUE(near(of(values, "K3.friction_tangent"), tangent, within(1e-4, "of the order of the friction")));
  EXPECT_GE(of(values, "K3.friction_tangent", "error_estimate"), of(values, "K3.tangent", "error_estimate"));
  // The joint: the same tangent by its own way on the same mesh, and errors of its own for every entry.
  EXPECT_TRUE(near(
      of(values, "contact.upper.joint.yy"), tangent,
      within(of(values, "contact.upper.joint.yy", "error_estimate") + of(values, "K3.tangent", "error_estimate"),
             "two fits of one stepping slope")));
  EXPECT_EQ(of(values, "contact.upper.joint.xx", "error_estimate"), 0)
      << "statics: F over the distance of the axes";
  EXPECT_NE(of(values, "contact.upper.joint.rx_rx", "error_estimate"),
            of(values, "contact.upper.joint.yy", "error_estimate"));
  for (const char *name : {"contact.upper.joint.yy", "contact.upper.joint.rx_rx", "K3.in_stand_tangent",
                           "K3.in_stand_secant", "contact.upper.largest_pressure"})
    EXPECT_GE(of(values, name, "error_estimate") * (1 + 1e-12),
              std::abs(check_of(values, name, "mesh twice as coarse") / of(values, name) - 1))
        << name;
}
