// One change at a time against the published stand, and the readings of its damping number.  Values: reference
// file.
#include "dynamics/response/modes.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include "tests/support/reference.h"
#include <map>
#include <string>
#include <vector>

using namespace mill;
using namespace mill::dynamics;

const Tolerance eigenvalues = within(1e-6, "eigenvalues in double precision");

namespace {
Eigen::VectorXd frequencies(const LumpedModel &stand)
{
  return modes(mill_model(stand, settings(ForceMeaning::published, 0))).frequency;
}
}  // namespace

struct Variant {
  const char *name;
  std::map<std::string, double> changed;  // "K3" -> N/m, "M3" -> kg
};

namespace {
std::vector<Variant> variants()
{
  const Eigen::VectorXd M = reference_vector("published.M"), K = reference_vector("published.K");
  const double line    = reference("regression.R1.system").at("K")[2];  // N/m, tangent of a line contact at 976 kN
  const double modulus = 2.1 / 2.7;  // -, steel against the published roll modulus
  const double density = 1.0195;     // -, 7850/7700, entered in the reference with five digits
  return {{"as_published", {}},
          {"roll_modulus_2.1e5_MPa", {{"K3", K[2] * modulus}, {"K4", K[3] * modulus}, {"K5", K[4] * modulus}}},
          {"K3_K5_line_contact", {{"K3", line}, {"K5", line}}},
          {"K4_plastic_slope", {{"K4", 3e8}}},
          {"K4_zero", {{"K4", 0}}},
          {"K3_K5_line_contact_K4_plastic_slope", {{"K3", line}, {"K5", line}, {"K4", 3e8}}},
          {"K3_K5_line_contact_K4_zero", {{"K3", line}, {"K5", line}, {"K4", 0}}},
          {"M3_M4_exchanged", {{"M3", M[3]}, {"M4", M[2]}}},
          {"M3_M4_both_3094.684", {{"M3", 3094.684}}},
          {"M3_M4_both_1888.705", {{"M4", 1888.705}}},
          {"M2_equal_M5_42200.563", {{"M2", 42200.563}}},
          {"M6_equal_M1_9321.943", {{"M6", 9321.943}}},
          {"density_7850",
           {{"M2", M[1] * density}, {"M3", M[2] * density}, {"M4", M[3] * density}, {"M5", M[4] * density}}}};
}
}  // namespace

TEST(StandVariants, SixFrequenciesOfEachChangeAreThoseOfTheReference)
{
  for (const Variant &variant : variants()) {
    auto stand = published_stand();
    for (const auto &[symbol, value] : variant.changed) {
      const auto i                                       = std::size_t(symbol[1] - '1');
      (symbol[0] == 'M' ? stand.M[i] : stand.K[i]).value = value;
    }
    EXPECT_TRUE(near(frequencies(stand), reference_vector(std::string("variants.") + variant.name), eigenvalues))
        << variant.name;
  }
}

TEST(StandVariants, AClosedFrameHasTheFrequenciesOfTheReference)
{
  auto closed  = settings(ForceMeaning::published, 0);
  closed.frame = FrameForm::closed;
  EXPECT_TRUE(near(modes(mill_model(published_stand(), closed)).frequency,
                   reference_vector("modes.closed_frame.frequencies"), eigenvalues));
}

namespace {
void expect_poles(const std::vector<Pole> &all_poles, const Reference &expected, const std::string &name)
{
  ASSERT_EQ(all_poles.size(), expected.size()) << name;
  for (std::size_t i = 0; i < all_poles.size(); ++i) {
    const double frequency = expected[i][0], damping = expected[i][1];
    const Tolerance tolerance =
        damping == 1 ? within(1e-4, "real pole of a stiff spectrum: 2e5 times the slowest")
                     : within(1e-5, "stiff spectrum, lightly damped: the ratio is a small part of the pole");
    EXPECT_TRUE(near(all_poles[i].frequency, frequency, tolerance)) << name << ", pole " << i;
    EXPECT_TRUE(near(all_poles[i].damping, damping, tolerance)) << name << ", pole " << i;
  }
}
}  // namespace

TEST(StandVariants, PolesOfEveryReadingOfTheDamper)
{
  const auto readings = reference("damping_readings");
  for (const auto &[name, expected] : readings.items()) {
    auto stand    = published_stand();
    stand.C.value = std::stod(name.substr(2));  // "c=1.91141e8"
    expect_poles(poles(mill_model(stand, settings(ForceMeaning::published, 0))), expected, name);
  }
}

TEST(StandVariants, PolesWithALossFactorOnTheBite)
{
  const auto model = mill_model(published_stand(), settings(ForceMeaning::published, 0));
  expect_poles(loss_factor_poles(model, "K4", 0.01), reference("damping_readings.loss_factor_0.01"), "0.01");
  expect_poles(loss_factor_poles(model, "K4", 0.001), reference("damping_readings.loss_factor_0.001"), "0.001");
}
