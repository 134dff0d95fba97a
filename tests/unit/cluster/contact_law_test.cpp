#include "dynamics/cluster/contact_law.h"
#include "dynamics/cluster/stack.h"
#include "tests/support/near.h"
#include "tests/support/reference.h"
#include <gtest/gtest.h>

using namespace mill::cluster;

namespace {
const Tolerance closed_form = within(1e-9, "closed form");

ContactBody body(const double radius)
{
  return {radius, {2.07e11, 0.29, 7801}};
}
}  // namespace

TEST(ContactLaws, StepIsTheCubicOfTheImpactFunction)
{
  EXPECT_TRUE(near(step(0.25, 0, 1, 1, 0), reference("vector.step", "cluster"), closed_form));
  EXPECT_EQ(step(-1, 0, 1, 1, 0), 1);
  EXPECT_EQ(step(2, 0, 1, 1, 0), 0);
}

TEST(ContactLaws, AnImpactForceIsNeverATension)
{
  ContactLaw law;
  law.k             = 1e10;
  law.p             = 1.5;
  const auto values = reference_vector("vector.impact", "cluster");
  EXPECT_TRUE(near(impact_force(law, 1e-4, 0.01, 1e5, 2e-4), values[0], closed_form));
  EXPECT_EQ(impact_force(law, 1e-4, -2, 1e5, 2e-4), 0) << "parting faster than the spring follows";
  EXPECT_EQ(impact_force(law, -1e-9, 5, 1e5, 2e-4), 0) << "open";
}

TEST(ContactLaws, AgreeWithTheReferenceTableOfThePairs)
{
  for (const auto &row : reference("contact_laws", "cluster")) {
    const std::string pair = row[0];
    const double load      = row[1];
    const ContactBody a = body(pair == "I-E" ? 0.069975 : 0.0348), b = body(pair == "W-I"   ? 0.069975
                                                                            : pair == "I-E" ? 0.225155
                                                                                            : 0.0255);
    const ContactLaw laws[] = {palmgren_law(0.505, 3.84e-5), line_law(LineForm::foeppl, a, b, 0.505),
                               line_law(LineForm::johnson, a, b, 0.505)};
    for (std::size_t i = 0; i < 3; ++i) {
      const double d = approach(laws[i], load);
      EXPECT_TRUE(near(d, row[2 + 2 * i], closed_form)) << pair << " law " << i;
      EXPECT_TRUE(near(tangent(laws[i], d), row[3 + 2 * i], closed_form)) << pair << " law " << i;
      EXPECT_TRUE(near(force(laws[i], d), load, within(1e-12, "inverse of itself"))) << pair << " law " << i;
      const double h = 1e-4 * d;
      EXPECT_TRUE(near((energy(laws[i], d + h) - energy(laws[i], d - h)) / (2 * h), load,
                       within(1e-7, "central difference of the energy")))
          << pair << " law " << i;
    }
  }
}

TEST(ContactLaws, FitToSamplesOfALineContactReturnsItsConstants)
{
  const ContactLaw law = line_law(LineForm::johnson, body(0.0348), body(0.069975), 0.505);
  std::vector<double> loads, approaches;
  for (double load = 1e3; load < 2e6; load *= 2) {
    loads.push_back(load);
    approaches.push_back(approach(law, load));
  }
  double misfit           = 1;
  const ContactLaw fitted = fitted_line_law(loads.data(), approaches.data(), int(loads.size()), 0.505, misfit);
  EXPECT_LT(misfit, 1e-12);
  EXPECT_TRUE(near(fitted.S, law.S, within(1e-11, "least squares of a straight line")));
  EXPECT_TRUE(near(fitted.T, law.T, within(1e-11, "least squares of a straight line")));
}

TEST(ContactLaws, SpringGoesThroughItsLoad)
{
  const ContactLaw law = power_law_through(1.7e10, 1.148e6, 10. / 9);
  const double d       = approach(law, 1.148e6);
  EXPECT_TRUE(near(tangent(law, d), 1.7e10, closed_form));
  EXPECT_TRUE(near(force(law, d), 1.148e6, closed_form));
}

TEST(BearingLaws, AgreeWithTheReferenceVectors)
{
  for (const auto &[q, name] :
       {std::pair{2. / 3, "vector.bearing.ball"}, std::pair{0.9, "vector.bearing.roller"}}) {
    const auto values    = reference_vector(name, "cluster");
    const BearingLaw law = {1e-8, q};
    const double d       = 1e-8 * std::pow(5000, q);
    EXPECT_TRUE(near(d, values[0], closed_form)) << name;
    EXPECT_TRUE(near(bearing_secant(law, d), values[1], closed_form)) << name;
    EXPECT_TRUE(near(bearing_tangent(law, d), values[2], closed_form)) << name;
    EXPECT_TRUE(near(bearing_through(values[2], 5000, q).kappa, 1e-8, closed_form)) << name;
  }
}
