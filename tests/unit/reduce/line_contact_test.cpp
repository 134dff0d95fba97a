#include "core/base/errors.h"
#include "reduce/chain/line_contact.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"

using namespace mill;
using namespace mill::reduce;

namespace {
const CylinderPair demo_pair{0.420, 1.450, 1.4, {210e9, 0.28, 7700}};
}  // namespace

TEST(LineContact, MeetsTheReferenceTableOfTheDemoRolls)
{
  const auto closed = within(1e-8, "closed form, reference at full double precision");
  for (const auto &row : reference("line_contact")) {
    const double load         = row[0];
    const LineContact contact = line_contact(demo_pair, load);
    const SecantLaws laws     = secant_laws(demo_pair, load);
    EXPECT_TRUE(near(contact.half_width, row[1], closed));
    EXPECT_TRUE(near(contact.peak_pressure, row[2], closed));
    EXPECT_TRUE(near(contact.approach, row[3], closed));
    EXPECT_TRUE(near(contact.secant, row[4], closed));
    EXPECT_TRUE(near(contact.tangent, row[5], closed));
    EXPECT_TRUE(near(laws.johnson, row[4], closed));
    EXPECT_TRUE(near(laws.foeppl, row[6], closed));
    EXPECT_TRUE(near(laws.half_space, row[7], closed));
    EXPECT_TRUE(near(laws.palmgren, row[8], closed));
  }
}

// Radii 200 and 650 mm, E 210 GPa, nu 0.3, from Johnson (1985) eq. 4.43, 4.45 and 5.57 evaluated by hand to five
// digits.
TEST(LineContact, MeetsJohnsonForTwoSteelRolls)
{
  const CylinderPair pair{0.4, 1.3, 0.1, {210e9, 0.3, 7700}};
  const auto printed          = within(1e-4, "reference printed with four to five digits");
  const double expected[3][5] = {{200e3, 0.5810e-3, 219.16e6, 8.074e-6, 26587e6},
                                 {1000e3, 1.2991e-3, 490.05e6, 35.931e-6, 30146e6},
                                 {5000e3, 2.9049e-3, 1095.78e6, 157.453e-6, 34804e6}};
  for (const auto &row : expected) {
    const LineContact contact = line_contact(pair, row[0] * pair.length);
    EXPECT_TRUE(near(contact.half_width, row[1], printed));
    EXPECT_TRUE(near(contact.peak_pressure, row[2], printed));
    EXPECT_TRUE(near(contact.approach, row[3], printed));
    EXPECT_TRUE(near(contact.tangent / pair.length, row[4], printed));
  }
}

TEST(LineContact, TangentIsTheSlopeOfTheApproach)
{
  const double load = 976217.5, step = 1e-4 * load;
  const double slope =
      2 * step / (line_contact(demo_pair, load + step).approach - line_contact(demo_pair, load - step).approach);
  EXPECT_TRUE(near(line_contact(demo_pair, load).tangent, slope,
                   within(1e-8, "central difference, truncation step^2 / 6")));
}

// The four laws differ in their datum only; the band is the accuracy of the notion of an axis-to-axis stiffness.
TEST(LineContact, FourSecantLawsSpanNinePercent)
{
  const SecantLaws laws = secant_laws(demo_pair, 976217.5);
  EXPECT_TRUE(near(laws.johnson / laws.palmgren, 1.094, within(2e-3, "stated as nine percent of the largest")));
}

TEST(LineContact, RefusesWhatIsNoContact)
{
  EXPECT_THROW(line_contact(demo_pair, 0), InputError);
  EXPECT_THROW(line_contact(demo_pair, -1e3), InputError);
  EXPECT_THROW(secant_laws({0.42, 0, 1.4, {}}, 1e6), InputError);
}
