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

TEST_F(Estimated, NecksAndSpansFollowBearingAndWindow)
{
  const FourHigh s =
      stand(without("work_roll", {"neck_diameter", "total_length", "bearing_span"}, "estimate = true\n"));
  EXPECT_EQ(s.work_roll.neck_diameter, 0.2667) << "the bore of its bearing";
  EXPECT_TRUE(near(s.work_roll.neck_length, 1.95 * 0.2667, by_hand));
  EXPECT_TRUE(near(s.work_roll.bearing_span, 0.97 * 2.45, by_hand)) << "in the window of the backup roll";
  EXPECT_TRUE(near(of(s, "work_roll.total_length").high, 1.4 + 2 * 2.5 * 0.2667, by_hand));
  const FourHigh t = stand(without("work_roll", {"total_length"}, "estimate = true\n"));
  EXPECT_TRUE(near(t.work_roll.neck_length, 0.3 + 0.85 * 0.2667, by_hand)) << "its span is drawn";
  const FourHigh b = stand(without("backup_roll", {"neck_diameter", "neck_length"}, "estimate = true\n"));
  EXPECT_TRUE(near(b.backup_roll.neck_diameter, 0.6 * 1.45, by_hand)) << "its bearing is not drawn";
  EXPECT_TRUE(near(b.backup_roll.neck_length, 0.525 + 0.75 * 0.6 * 1.45, by_hand));
  EXPECT_TRUE(near(of(b, "backup_roll.neck_diameter").low, 0.5 * 1.45, by_hand));
  const FourHigh c = stand(without("backup_roll", {"bearing_span"}, "estimate = true\n"));
  EXPECT_TRUE(near(c.backup_roll.bearing_span, 1.4 + 2 * (0.375 + 0.12) * 0.95, by_hand));
  EXPECT_TRUE(near(of(c, "backup_roll.bearing_span").high, 1.4 + 2 * (0.375 + 0.25) * 0.95, by_hand))
      << "less than the neck less half a bearing, 0.594 m";
}

TEST_F(Estimated, AChockIsWhatRemainsOfItsBoxNextToBearingAndNeck)
{
  const FourHigh s =
      stand(without("work_roll", {"bearing_mass", "chock_mass_upper", "chock_mass_lower"}, "estimate = true\n"));
  const double ring = pi / 4 * (0.3556 * 0.3556 - 0.2667 * 0.2667) * 0.230188;
  EXPECT_TRUE(near(s.work_roll.bearing_mass, 0.85 * 7850 * ring, by_hand));
  const double l   = 0.3 + 0.8 * 0.230188;  // the neck is 0.46 m
  const double box = 0.6 * 0.56 * std::min(l, 0.46) - pi / 4 * 0.3556 * 0.3556 * 0.230188 -
                     pi / 4 * 0.2667 * 0.2667 * (std::min(l, 0.46) - 0.230188);
  EXPECT_TRUE(near(s.work_roll.chock_mass_lower, 1.05 * 7700 * box, by_hand));
  EXPECT_TRUE(near(of(s, "work_roll.chock_mass_upper").high, 1.80 * 7700 * box, by_hand));
  EXPECT_EQ(of(s, "work_roll.chock_mass_upper").source, of(s, "work_roll.chock_mass_lower").source);
}

// A box that is not drawn is bounded by the window and by the axes of the rolls.
TEST_F(Estimated, AnUndrawnChockFitsIntoTheStand)
{
  const FourHigh s    = stand(without("backup_roll", {"chock_mass_upper"}, "estimate = true\n"));
  const double window = 1.07 * 1.45, height = 0.95 * 1.45, l = 0.95;
  const double room = window * height * l;
  EXPECT_LT(of(s, "backup_roll.chock_mass_upper").value, 1.05 * 7700 * room);
  const double D = 1.33 * 0.95, B = 0.75 * 0.95;
  EXPECT_TRUE(near(of(s, "backup_roll.chock_mass_upper").value,
                   1.05 * 7700 * (room - pi / 4 * (D * D * B + 0.95 * 0.95 * (l - B))), by_hand));
}

TEST_F(Estimated, AFrameIsSizedByTheForceOfItsNecks)
{
  const FourHigh s = stand(without(
      "frame",
      {"upper_post_mass", "upper_beam_stiffness", "upper_post_stiffness", "oil_column_stiffness", "cylinder_mass"},
      "estimate = true\nmodulus = \"2.06 MN/mm\"\n"));
  const double F = 2 * 110e6 * pi / 32 * std::pow(0.95, 3) / 0.525, A = F / 2 / 21e6, d = std::sqrt(4 * A / pi);
  EXPECT_TRUE(near(s.frame.oil_column_stiffness, 2 * 1.4e9 * A / 0.075, by_hand));
  EXPECT_TRUE(near(of(s, "frame.oil_column_stiffness").low, 0.58 * 2 * 1.4e9 * A / 0.075, by_hand));
  EXPECT_TRUE(near(s.frame.cylinder_mass, 1.25 * 7700 * A * d, by_hand));
  const double section = F / 4 / 14e6, b = std::sqrt(section), H = 3 * (0.42 + 1.45), l = 1.1 * 1.45 + b;
  EXPECT_TRUE(near(s.frame.upper_post_stiffness, 4 * 210e9 * section / (0.86 * H), by_hand));
  const double G = 210e9 / 2 / 1.28, I = b * 8 * b * b * b / 12;
  EXPECT_TRUE(near(s.frame.upper_beam_stiffness,
                   2 / (l * l * l / (96 * 210e9 * I) + 1.2 * l / (4 * G * 2 * section)), by_hand));
  const double screw = 1 / s.frame.upper_post_stiffness + 1 / s.frame.upper_beam_stiffness,
               M1    = screw + 1 / 4.0e11 + 1 / 4.5e11;
  EXPECT_TRUE(
      near(s.frame.upper_post_mass, 0.49 * 7700 * 4 * section * 0.86 * H * std::pow(screw / M1, 2), by_hand));
  EXPECT_EQ(s.frame.piston_mass, 1000) << "given";
  EXPECT_EQ(s.estimates.size(), 5u);
  EXPECT_TRUE(near(s.frame.tolerance.at("oil_column_stiffness"), 0.5 * (1.70 - 0.58), by_hand));
  EXPECT_EQ(s.frame.closing,
            (std::set<std::string>{"oil_column_stiffness", "upper_beam_stiffness", "upper_post_stiffness"}));
  EXPECT_EQ(s.frame.modulus, 2.06e9);
  EXPECT_TRUE(near(s.frame.modulus_error, 0.03, by_hand)) << "of a calibration";
}

TEST_F(Estimated, AStiffnessOfTheHousingIsSharedByPostsAndBeams)
{
  std::string text = without("frame",
                             {"upper_post_stiffness", "upper_beam_stiffness", "lower_post_stiffness",
                              "lower_beam_stiffness", "oil_column_stiffness"},
                             "estimate = true\nmodulus = \"2.06 MN/mm\"\n");
  const FourHigh s = stand(text + "\n[housing]\nstiffness = \"18 MN/mm\"\n");
  EXPECT_FALSE(s.housing.present());
  EXPECT_TRUE(near(1 / s.frame.upper_post_stiffness + 1 / s.frame.upper_beam_stiffness +
                       1 / s.frame.lower_post_stiffness + 1 / s.frame.lower_beam_stiffness,
                   1 / 36e9, within(1e-12, "a sum of four")));
  EXPECT_EQ(s.frame.closing, std::set<std::string>{"oil_column_stiffness"}) << "the housing is known";
  EXPECT_EQ(refusals([&] { stand(text + "\n[housing]\nstiffness = \"18 MN/mm\"\npost_width = \"1 m\"\n"); }),
            "housing.post_width = \"1 m\" has no effect with housing.stiffness, which is in place of the drawing");
  EXPECT_EQ(refusals([&] { stand(without("frame", {}) + "\n[housing]\nstiffness = \"18 MN/mm\"\n"); }),
            "housing.stiffness = \"18 MN/mm\" has no effect without frame.estimate = true");
}

TEST_F(Estimated, TheResolvedCaseMarksEstimatesAndGivesTheSameStand)
{
  const FourHigh first = stand(without("work_roll", {"bearing_span"}, "estimate = true\n"));
  const Case c         = read_case(path);
  EXPECT_NE(c.resolved.find("# bearing_span is not given"), std::string::npos) << c.resolved;
  EXPECT_NE(c.resolved.find("# work_roll.bearing_span = 2090 mm (1960 .. 2090): 0.97 (0.80 .. 1.06) of the backup "
                            "roll's, in whose window it lies (34.5)"),
            std::string::npos)
      << c.resolved;
  write_atomically(path, c.resolved);
  EXPECT_EQ(std::get<FourHigh>(read_case(path).spec).work_roll.bearing_span, first.work_roll.bearing_span);
}

TEST_F(Estimated, AnEstimateNamesTheKeysThatItNeeds)
{
  EXPECT_EQ(refusals([&] { stand(without("frame", {}, "modulus = \"5 MN/mm\"\n")); }),
            "frame.modulus = \"5 MN/mm\" has no effect without estimate = true");
  EXPECT_EQ(refusals([&] { stand(without("frame", {}, "estimate = true\nmodulus = \"5 MN/mm\"\n")); }),
            "frame.modulus = \"5 MN/mm\" has no effect: every stiffness of the frame is given or drawn; leave out "
            "those that are least known");
  EXPECT_EQ(
      refusals([&] {
        stand(without("frame", {"piston_stiffness"}, "estimate = true\nmodulus_tolerance = \"2 %\"\n"));
      }),
      "frame.modulus_tolerance = \"2 %\" belongs to frame.modulus, which is not given; give both or neither");
  EXPECT_EQ(
      refusals([&] { stand(without("frame", {"piston_mass"})); }),
      "[frame] has no 'piston_mass'; add for example piston_mass = \"1000 kg\", or M1 in [given], or estimate = "
      "true");
}
