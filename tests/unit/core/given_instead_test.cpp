// What is given makes what lies behind it optional, and a message names what could be given instead.
#include "core/base/files.h"
#include "core/case/given_instead.h"
#include "core/case/stand_rows.h"
#include "core/model/case.h"
#include "core/model/four_high.h"
#include "tests/support/given_stand.h"
#include "tests/support/refusal.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

using namespace mill;

namespace {
class GivenInstead : public testing::Test {
protected:
  std::string path = (std::filesystem::path(testing::TempDir()) / "millstand_given_test.toml").string();
  void TearDown() override
  {
    std::filesystem::remove(path);
  }
  /// The stand without the lines that begin with one of these words.
  std::string without(const std::vector<std::string> &keys)
  {
    std::string text, line;
    std::istringstream lines(given_stand());
    while (std::getline(lines, line)) {
      const std::string key = line.substr(0, line.find(' '));
      if (std::find(keys.begin(), keys.end(), key) == keys.end())
        text += line + "\n";
    }
    return text;
  }
  std::string refused(const std::vector<std::string> &keys)
  {
    write_atomically(path, without(keys));
    return refusals([&] { read_case(path); });
  }
};
}  // namespace

TEST_F(GivenInstead, AStandWithEverythingGivenIsRead)
{
  write_atomically(path, given_stand());
  const Case c      = read_case(path);
  const auto &stand = std::get<FourHigh>(c.spec);
  EXPECT_TRUE(std::isnan(stand.frame.oil_column_stiffness));
  EXPECT_TRUE(std::isnan(stand.strip.entry_thickness));
  EXPECT_EQ(stand.frame.cylinder_mass, 0);
  EXPECT_EQ(stand.backup_roll.chock_mass_upper, 0);
  EXPECT_TRUE(stand.backup_roll.bearing.empty());
  EXPECT_EQ(stand.given.at("Kzc1").parameter.value, 5.1e10) << "half of both";
  EXPECT_EQ(stand.given.at("Kzc4").parameter.value, 5.1e10);
  write_atomically(path, c.resolved);
  const auto again = std::get<FourHigh>(read_case(path).spec);
  EXPECT_TRUE(std::isnan(again.frame.oil_column_stiffness));
  EXPECT_EQ(again.given.at("Kzc1").parameter.value, 5.1e10);
}

TEST_F(GivenInstead, AMissingValueNamesWhatWouldBeNeededOtherwise)
{
  EXPECT_EQ(refused({"K1"}),
            "the section [frame] is missing; it needs upper_post_stiffness, upper_beam_stiffness, "
            "piston_stiffness, upper_packing_stiffness; or K1 in [given], or estimate = true");
  EXPECT_EQ(refused({"K6", "M6"}),
            "the section [frame] is missing; it needs lower_post_mass, lower_beam_mass, load_cell_mass, "
            "lower_packing_mass, lower_chock_stiffness; or M6, K6 in [given], or estimate = true");
  EXPECT_EQ(refused({"Kzc3"}),
            "[work_roll] has no 'bearing'; add for example bearing = \"trb\", or Kzc2 and Kzc3 in [given]");
  EXPECT_EQ(refused({"K_Zy"}),
            "[backup_roll] has no 'bearing'; add for example bearing = \"crb\", or Kzc1 and Kzc4, "
            "or K_Zy, in [given]");
  EXPECT_EQ(
      refused({"M3"}),
      "[work_roll] has no 'bearing_mass'; add for example bearing_mass = \"90 kg\", or M3 and M4 in [given], or "
      "estimate = true\n"
      "[work_roll] has no 'chock_mass_upper'; add for example chock_mass_upper = \"0 kg\", or M3 in [given], "
      "or estimate = true");
  EXPECT_EQ(refused({"K4"}),
            "the section [strip.flow_stress] is missing; it needs law\n"
            "[strip] has no 'entry_thickness'; add for example entry_thickness = \"8 mm\", or K4 in [given]\n"
            "[strip] has no 'exit_thickness'; add for example exit_thickness = \"5 mm\", or K4 in [given]\n"
            "[strip] has no 'friction'; add for example friction = 0.2, or K4 in [given]");
}

// Every key of the table is a row of its section that would be required.
TEST(BehindGiven, RowsReplacedByAGivenValueExist)
{
  for (const BehindGiven &one : behind_given()) {
    for (const std::string &name : one.given) {
      const auto &rows = given_rows("four-high");
      EXPECT_TRUE(std::any_of(rows.begin(), rows.end(), [&](const Row &row) { return row.key == name; })) << name;
    }
    for (const SectionRows &section : sections_of("four-high"))
      if (section.name == one.section)
        for (const std::string &key : one.keys) {
          const auto row =
              std::find_if(section.rows.begin(), section.rows.end(), [&](const Row &r) { return r.key == key; });
          EXPECT_TRUE(key == "flow_stress" ||
                      (row != section.rows.end() && row->fallback.kind == Fallback::Kind::required))
              << one.section << "." << key;
        }
  }
}
