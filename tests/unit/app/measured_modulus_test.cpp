// A measured mill modulus by the closed forms of trace and check: the stand has it, and follows it one to one.
#include "app/review/closed_form_modes.h"
#include "app/trace/closed_form_chain.h"
#include "core/base/files.h"
#include "core/case/estimates.h"
#include "core/case/input_reference.h"
#include "core/model/case.h"
#include "tests/support/near.h"
#include "tests/support/refusal.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>

using namespace mill;

namespace {
// The case with a frame of which only the modulus is known, without drawings of housing and screw-down.
std::string on_modulus(const std::string &text, const double MN_per_mm)
{
  std::istringstream lines(text);
  std::string all, line;
  bool skipped = false;
  while (std::getline(lines, line)) {
    if (!line.empty() && line[0] == '[')
      skipped =
          line.rfind("[frame]", 0) == 0 || line.rfind("[housing]", 0) == 0 || line.rfind("[screwdown]", 0) == 0;
    if (!skipped)
      all += line + "\n";
  }
  for (std::size_t i; (i = all.find("\"data/")) != std::string::npos;)
    all.replace(i, 6, "\"" MILLSTAND_SOURCE_DIR "/cases/data/");
  return all + fmt::format("[frame]\nestimate = true\nmodulus = \"{} MN/mm\"\n", MN_per_mm);
}

FourHigh stand_of(const std::string &text)
{
  const std::string path = (std::filesystem::path(testing::TempDir()) / "millstand_modulus.toml").string();
  write_atomically(path, text);
  const FourHigh stand = std::get<FourHigh>(read_case(path).spec);
  std::filesystem::remove(path);
  return stand;
}

double value_of(const std::vector<ClosedFormResult> &results, const std::string &name)
{
  const ClosedFormResult *result = find(results, name);
  return result ? result->parameter.value : not_given;
}

struct Measured {
  const char *name;
  double modulus, load;  // MN/mm, N
};
const Measured stands[] = {{"", 2.06, 976e3},
                           {"cold-tandem-2030", 4.6, 12e6},
                           {"cold-tandem-2030", 5.2, 12e6},
                           {"hot-strip-2050", 5.5, 13.5e6},
                           {"plate-4300", 7, 38e6}};

std::string text_of(const Measured &m)
{
  return m.name[0] ? read_text(std::string("cases/") + m.name + ".toml") : template_of("four-high");
}
}  // namespace

TEST(MeasuredModulus, IsThatOfTheStandWithTouchingRolls)
{
  for (const Measured &m : stands) {
    const FourHigh stand = stand_of(on_modulus(text_of(m), m.modulus));
    EXPECT_TRUE(near(value_of(closed_form_stand(stand, m.load), "stand.modulus.kiss"), 1e9 * m.modulus,
                     within(1e-9, "the frame takes what the rest leaves")))
        << m.name;
  }
}

// The template names the demo stand, whose frame is drawn in its case.
TEST(MeasuredModulus, OfTheTemplateIsThatOfTheStandItNames)
{
  const double of_template = stand_of(template_of("four-high")).frame.modulus;
  const double drawn =
      value_of(closed_form_stand(std::get<FourHigh>(read_case("cases/four-high-1400.toml").spec), 976e3),
               "stand.modulus.kiss");
  EXPECT_TRUE(near(of_template, drawn, within(0.03, "the error of a calibration")));
}

TEST(MeasuredModulus, IsFollowedOneToOne)
{
  for (const Measured &m : stands) {
    FourHigh more = stand_of(on_modulus(text_of(m), m.modulus)), less = more;
    more.frame.modulus *= 1.001;
    less.frame.modulus *= 0.999;
    const double slope = std::log(value_of(closed_form_stand(more, m.load), "stand.modulus.kiss") /
                                  value_of(closed_form_stand(less, m.load), "stand.modulus.kiss")) /
                         std::log(1.001 / 0.999);
    EXPECT_TRUE(near(slope, 1, within(0.01, "the acceptance of this result"))) << m.name;
    const auto results           = closed_form_stand(more, m.load);
    const ClosedFormResult *kiss = find(results, "stand.modulus.kiss");
    ASSERT_TRUE(kiss);
    EXPECT_TRUE(holds(kiss->closed, "frame.modulus"));
  }
}

TEST(MeasuredModulus, ThatIsTooStiffForTheRollsIsRefusedAtItsKey)
{
  const std::string text = on_modulus(template_of("four-high"), 12);
  const FourHigh stand   = stand_of(text);
  try {
    closed_form_stand(stand, 976e3);
    ADD_FAILURE() << "not refused";
  } catch (const InputError &e) {
    ASSERT_EQ(e.problems.size(), 1u);
    EXPECT_EQ(e.problems[0].place.line, std::count(text.begin(), text.end(), '\n'));
    EXPECT_NE(e.problems[0].message.find("frame.modulus = 12 MN/mm leaves nothing for the frame"),
              std::string::npos)
        << e.problems[0].message;
  }
}
