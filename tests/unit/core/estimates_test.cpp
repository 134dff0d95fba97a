// What a drawing hides, by rules; numbers by hand from the equations of theory 34.3.
#include "core/base/files.h"
#include "core/case/estimates.h"
#include "core/model/case.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <cmath>
#include <filesystem>

using namespace mill;

namespace {
constexpr double pi = 3.14159265358979323846;

class Estimated : public testing::Test {
protected:
  std::string path = (std::filesystem::path(testing::TempDir()) / "millstand_estimates_test.toml").string();
  void TearDown() override
  {
    std::filesystem::remove(path);
  }
  /// The demo stand with `estimate = true` in a section in place of these keys.
  std::string without(const std::string &section, const std::vector<std::string> &keys,
                      const std::string &more = "")
  {
    std::string text = read_text("cases/four-high-1400.toml");
    for (const std::string &key : keys) {
      const auto begin = text.find("\n" + key, text.find("\n[" + section + "]"));
      EXPECT_NE(begin, std::string::npos) << key;
      text.erase(begin, text.find('\n', begin + 1) - begin);
    }
    for (std::size_t i; (i = text.find("\"data/")) != std::string::npos;)
      text.replace(i, 6, "\"" MILLSTAND_SOURCE_DIR "/cases/data/");
    const auto header = text.find("[" + section + "]"), end = text.find('\n', header);
    text.insert(end + 1, more);
    return text;
  }
  FourHigh stand(const std::string &text)
  {
    write_atomically(path, text);
    return std::get<FourHigh>(read_case(path).spec);
  }
};

const Estimate &of(const FourHigh &stand, const std::string &key)
{
  static const Estimate none;
  for (const Estimate &e : stand.estimates)
    if (e.key == key)
      return e;
  ADD_FAILURE() << key << " is not estimated";
  return none;
}

const auto by_hand = within(1e-12, "the same product");
}  // namespace

TEST_F(Estimated, NecksAndSpansFollowBarrelAndBearing)
{
  const FourHigh s =
      stand(without("work_roll", {"neck_diameter", "total_length", "bearing_span"}, "estimate = true\n"));
  EXPECT_EQ(s.work_roll.neck_diameter, 0.2667) << "the bore of its bearing";
  EXPECT_TRUE(near(s.work_roll.neck_length, 1.6 * 0.2667, by_hand));
  EXPECT_TRUE(near(s.work_roll.bearing_span, 1.4 + 2 * 0.6 * 1.6 * 0.2667, by_hand));
  EXPECT_TRUE(near(of(s, "work_roll.total_length").value, 1.4 + 2 * 1.6 * 0.2667, by_hand));
  EXPECT_TRUE(near(of(s, "work_roll.total_length").high, 1.4 + 2 * 2.0 * 0.2667, by_hand));
  const FourHigh b = stand(without("backup_roll", {"neck_diameter", "neck_length"}, "estimate = true\n"));
  EXPECT_TRUE(near(b.backup_roll.neck_diameter, 0.6 * 1.45, by_hand)) << "its bearing is not drawn";
  EXPECT_TRUE(near(b.backup_roll.neck_length, 0.6 * 1.45, by_hand));
  EXPECT_TRUE(near(of(b, "backup_roll.neck_diameter").low, 0.5 * 1.45, by_hand));
}

TEST_F(Estimated, MassesFollowBoxAndBore)
{
  const FourHigh s =
      stand(without("work_roll", {"bearing_mass", "chock_mass_upper", "chock_mass_lower"}, "estimate = true\n"));
  const double ring = pi / 4 * (0.3556 * 0.3556 - 0.2667 * 0.2667) * 0.230188;
  EXPECT_TRUE(near(s.work_roll.bearing_mass, 0.85 * 7850 * ring, by_hand));
  const double box = (0.6 * 0.56 - pi / 4 * 0.3556 * 0.3556) * 0.26;  // as drawn in [bearing.trb]
  EXPECT_TRUE(near(s.work_roll.chock_mass_lower, 0.8 * 7700 * box, by_hand));
  EXPECT_TRUE(near(of(s, "work_roll.chock_mass_upper").high, 0.85 * 7700 * box, by_hand));
}

TEST_F(Estimated, AFrameHasItsShareOfTheModulus)
{
  const FourHigh s = stand(without(
      "frame",
      {"upper_post_mass", "upper_beam_stiffness", "upper_post_stiffness", "oil_column_stiffness", "cylinder_mass"},
      "estimate = true\nmodulus = \"5 MN/mm\"\n"));
  EXPECT_TRUE(near(s.frame.upper_beam_stiffness, 5e9 / 0.12, by_hand));
  EXPECT_TRUE(near(s.frame.oil_column_stiffness, 5e9 / 0.08, by_hand));
  EXPECT_TRUE(near(of(s, "frame.oil_column_stiffness").low, 5e9 / 0.13, by_hand));
  EXPECT_TRUE(near(of(s, "frame.oil_column_stiffness").high, 5e9 / 0.03, by_hand));
  const double K = 5e9 / 0.04, H = 3 * (0.42 + 1.45), area = K * H / (8 * 210e9);
  EXPECT_TRUE(near(s.frame.upper_post_mass, 7700 * 4 * area * H / 2 / 3, by_hand));
  const double roll = 7700 * pi / 4 * (1.45 * 1.45 * 1.4 + 2 * 0.95 * 0.95 * 0.95);
  EXPECT_TRUE(near(s.frame.cylinder_mass, 0.12 * roll, by_hand));
  EXPECT_EQ(s.frame.piston_mass, 1000) << "given";
  EXPECT_EQ(s.estimates.size(), 5u);
  EXPECT_TRUE(near(s.frame.tolerance.at("oil_column_stiffness"), 0.08 * 0.5 * (1 / 0.03 - 1 / 0.13), by_hand));
}

// The rules together leave the stand about half of its compliance for rolls, contacts and bearings.
TEST_F(Estimated, TheSharesOfAFrameLeaveHalfForTheRolls)
{
  const FourHigh s = stand(
      without("frame",
              {"upper_post_stiffness", "upper_beam_stiffness", "piston_stiffness", "upper_packing_stiffness",
               "oil_column_stiffness", "cylinder_body_stiffness", "upper_chock_stiffness", "lower_chock_stiffness",
               "lower_post_stiffness", "lower_beam_stiffness", "lower_packing_stiffness"},
              "estimate = true\nmodulus = \"5 MN/mm\"\n"));
  double compliance = 0;
  for (const Estimate &e : s.estimates)
    if (e.unit == "kN/mm")
      compliance += 1 / e.value;
  EXPECT_GT(compliance * 5e9, 0.35);
  EXPECT_LT(compliance * 5e9, 0.65);
}

TEST_F(Estimated, TheResolvedCaseMarksEstimatesAndGivesTheSameStand)
{
  const FourHigh first = stand(without("work_roll", {"bearing_span"}, "estimate = true\n"));
  const Case c         = read_case(path);
  EXPECT_NE(c.resolved.find("# bearing_span is not given"), std::string::npos) << c.resolved;
  EXPECT_NE(
      c.resolved.find("# work_roll.bearing_span = 1952 mm (1860 .. 2044): bearing centres 0.60 (0.50 .. 0.70) of "
                      "the neck from the barrel, rule of thumb (34.5)"),
      std::string::npos)
      << c.resolved;
  write_atomically(path, c.resolved);
  EXPECT_EQ(std::get<FourHigh>(read_case(path).spec).work_roll.bearing_span, first.work_roll.bearing_span);
}

TEST_F(Estimated, AnEstimateNamesTheKeysThatItNeeds)
{
  EXPECT_EQ(
      refusals([&] { stand(without("frame", {"piston_stiffness"}, "estimate = true\n")); }),
      "frame.estimate = true estimates stiffnesses from the modulus of the stand; add for example modulus = \"5 "
      "MN/mm\", of a calibration with touching rolls or of a stand of this type");
  EXPECT_EQ(refusals([&] { stand(without("frame", {}, "modulus = \"5 MN/mm\"\n")); }),
            "frame.modulus = \"5 MN/mm\" has no effect without estimate = true");
  EXPECT_EQ(
      refusals([&] { stand(without("frame", {"piston_mass"})); }),
      "[frame] has no 'piston_mass'; add for example piston_mass = \"1000 kg\", or M1 in [given], or estimate = "
      "true");
}
