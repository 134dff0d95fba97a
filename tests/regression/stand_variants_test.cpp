// One change at a time against the published stand, and the readings of its damping number.  Values: reference file.
#include "dynamics/modes.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include "tests/support/reference.h"
#include <functional>
#include <utility>

using namespace mill;
using namespace mill::dynamics;

const Tolerance eigenvalues = within(1e-6, "eigenvalues in double precision");

Eigen::VectorXd frequencies(const LumpedModel &stand)
{
  return modes(mill_model(stand, settings("published", 0))).frequency;
}

TEST(StandVariants, SixFrequenciesOfEachChange)
{
  const double K_line = reference("regression.R1.system").at("K").get<std::vector<double>>()[2];
  using Change        = std::function<void(std::array<Parameter, 6> &, std::array<Parameter, 7> &)>;
  const std::vector<std::pair<const char *, Change>> changes = {
      {"as_published", [](auto &, auto &) {}},
      {"roll_modulus_2.1e5_MPa", [](auto &, auto &K) { for (int i : {2, 3, 4}) K[std::size_t(i)].value *= 2.1 / 2.7; }},
      {"K3_K5_line_contact", [&](auto &, auto &K) { K[2].value = K[4].value = K_line; }},
      {"K4_plastic_slope", [](auto &, auto &K) { K[3].value = 3e8; }},
      {"K4_zero", [](auto &, auto &K) { K[3].value = 0; }},
      {"K3_K5_line_contact_K4_plastic_slope", [&](auto &, auto &K) { K[2].value = K[4].value = K_line, K[3].value = 3e8; }},
      {"K3_K5_line_contact_K4_zero", [&](auto &, auto &K) { K[2].value = K[4].value = K_line, K[3].value = 0; }},
      {"M3_M4_exchanged", [](auto &M, auto &) { std::swap(M[2], M[3]); }},
      {"M3_M4_both_3094.684", [](auto &M, auto &) { M[2] = M[3]; }},
      {"M3_M4_both_1888.705", [](auto &M, auto &) { M[3] = M[2]; }},
      {"M2_equal_M5_42200.563", [](auto &M, auto &) { M[1] = M[4]; }},
      {"M6_equal_M1_9321.943", [](auto &M, auto &) { M[5] = M[0]; }},
      {"density_7850", [](auto &M, auto &) { for (int i : {1, 2, 3, 4}) M[std::size_t(i)].value *= 7850.0 / 7700; }}};
  for (const auto &[name, change] : changes) {
    auto stand = published_stand();
    change(stand.M, stand.K);
    EXPECT_TRUE(near(frequencies(stand), reference_vector(std::string("variants.") + name), eigenvalues)) << name;
  }
}

TEST(StandVariants, ClosedFrame)
{
  auto closed  = settings("published", 0);
  closed.frame = "closed";
  EXPECT_TRUE(near(modes(mill_model(published_stand(), closed)).frequency,
                   reference_vector("modes.closed_frame.frequencies"), eigenvalues));
}

void expect_poles(const std::vector<Pole> &found, const nlohmann::json &expected, const std::string &name)
{
  ASSERT_EQ(found.size(), expected.size()) << name;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double frequency = expected[i][0], damping = expected[i][1];
    const Tolerance tolerance =
        damping == 1 ? within(1e-4, "real pole of a stiff spectrum: 2e5 times the slowest")
                     : within(1e-5, "stiff spectrum, lightly damped: the ratio is a small part of the pole");
    EXPECT_TRUE(near(found[i].frequency, frequency, tolerance)) << name << ", pole " << i;
    EXPECT_TRUE(near(found[i].damping, damping, tolerance)) << name << ", pole " << i;
  }
}

TEST(StandVariants, PolesOfEveryReadingOfTheDamper)
{
  const auto readings = reference("damping_readings");
  for (const auto &[name, expected] : readings.items()) {
    auto stand    = published_stand();
    stand.C.value = std::stod(name.substr(2));  // "c=1.91141e8"
    expect_poles(poles(mill_model(stand, settings("published", 0))), expected, name);
  }
}

TEST(StandVariants, PolesWithALossFactorOnTheBite)
{
  const auto model = mill_model(published_stand(), settings("published", 0));
  expect_poles(loss_factor_poles(model, "K4", 0.01), reference("damping_readings.loss_factor_0.01"), "0.01");
  expect_poles(loss_factor_poles(model, "K4", 0.001), reference("damping_readings.loss_factor_0.001"), "0.001");
}
