// Derivatives of a unit by its inputs, its parameters and the time, and the dependencies of its description.
#include "dynamics/fmu/dependencies.h"
#include "dynamics/fmu/runtime/variables.h"
#include "tests/support/near.h"
#include "tests/support/unit_client.h"
#include <algorithm>
#include <cmath>
#include <vector>

using namespace mill;

namespace {
// A force that swings by 10 kN, over steps of 1 ms.
void swing(Client2 &client, const int steps)
{
  for (int i = 0; i < steps; ++i) {
    client.set("F_roll", 976e3 + 1e4 * std::sin(0.1 * i));
    EXPECT_EQ(client.step(1e-3 * i, 1e-3), fmi2OK) << client.logged();
  }
}
}  // namespace

TEST(UnitDerivatives, DerivativesAreThoseOfTheEquations)
{
  const SampleStand stand = sample_stand();
  Client2 client(stand.model);
  ASSERT_EQ(client.start(976e3), fmi2OK);
  swing(client, 37);
  const unsigned outputs[] = {client.at("a_upper_work_roll"), client.at("y_upper_work_roll"), client.at("f3"),
                              client.at("a_lower_work_roll")};
  const auto by            = [&](const char *known) {
    const unsigned vr = client.at(known);
    const double one  = 1;
    std::vector<double> result(4);
    EXPECT_EQ(FMI2(client, GetDirectionalDerivative)(client.c, outputs, 4, &vr, 1, &one, result.data()), fmi2OK)
        << client.logged();
    return result;
  };
  const auto force = by("F_roll");
  EXPECT_TRUE(near(force[0], 1 / stand.chain.M[2], within(1e-12, "1/M3")));
  EXPECT_TRUE(near(force[3], -1 / stand.chain.M[3], within(1e-12, "-1/M4")));
  EXPECT_EQ(force[1], 0);
  EXPECT_EQ(force[2], 0);
  const auto K3     = by("K3");  // frequency by the strain energy: df/dK = phi^2 / (8 pi^2 f)
  const double step = 1e4, f = client.get("f3");
  client.set("K3", 4.02e10 + step);
  const double above = client.get("f3");
  client.set("K3", 4.02e10 - step);
  EXPECT_TRUE(near(K3[2], (above - client.get("f3")) / (2 * step), within(1e-5, "rounding of the difference")));
  EXPECT_GT(f, 0);
  client.set("K3", 4.02e10);
  const unsigned y_frame = client.at("y_upper_frame");
  const double one       = 1;
  double result          = 0;
  EXPECT_EQ(FMI2(client, GetDirectionalDerivative)(client.c, &y_frame, 1, &y_frame, 1, &one, &result), fmi2Error);
  EXPECT_EQ(client.logged(), "fmi2GetDirectionalDerivative: y_upper_frame is not a known\n");
}

TEST(UnitDerivatives, OutputDerivativesAreThoseInTime)
{
  const SampleStand stand = sample_stand();
  Client2 client(stand.model);
  ASSERT_EQ(client.start(976e3), fmi2OK);
  const double h = 1e-6;
  swing(client, 37);
  const double t = 0.037, F = 976e3 + 1e4 * std::sin(3.6);
  std::vector<double> a, y, cell;
  const unsigned vr[] = {client.at("a_upper_work_roll"), client.at("y_upper_work_roll"), client.at("F_cell")};
  const int orders[]  = {1, 1, 1};
  double derived[3]   = {};
  for (int i = 0; i < 3; ++i) {
    client.set("F_roll", F + 2e6 * h * i);
    client.slope(2e6);
    ASSERT_EQ(client.step(t + h * i, h), fmi2OK) << client.logged();
    a.push_back(client.get("a_upper_work_roll"));
    y.push_back(client.get("y_upper_work_roll"));
    cell.push_back(client.get("F_cell"));
    if (i == 1) {
      ASSERT_EQ(FMI2(client, GetRealOutputDerivatives)(client.c, vr, 3, orders, derived), fmi2OK)
          << client.logged();
    }
  }
  EXPECT_TRUE(near(derived[0], (a[2] - a[0]) / (2 * h), within(1e-5, "difference over 2 us")));
  EXPECT_TRUE(near(derived[1], (y[2] - y[0]) / (2 * h), within(1e-5, "difference over 2 us")));
  EXPECT_TRUE(near(derived[2], (cell[2] - cell[0]) / (2 * h), within(1e-4, "difference over 2 us")));
  const int two[] = {2};
  EXPECT_EQ(FMI2(client, GetRealOutputDerivatives)(client.c, vr, 1, two, derived), fmi2Error);
  EXPECT_EQ(client.logged(),
            "fmi2GetRealOutputDerivatives: derivative of order 2 of a_upper_work_roll; only order 1 "
            "is known\n");
}

// What an unknown does not depend on by its description has no derivative, at rest and in motion.
TEST(UnitDerivatives, WhatIsNotADependencyHasNoDerivative)
{
  const SampleStand coupled = sample_stand(ForceMeaning::published, 0.02, 3e6);
  for (const fmu::ExportedModel &of : {coupled.model, in_modes(coupled)}) {
    const fmu::Dependencies depends(of.data);
    const auto variables = fmu::variables_of(of.data);
    Client3 client(of);
    ASSERT_TRUE(client.c) << client.logged();
    // A derivative by its own size: typical change of the unknown for a typical change of the known.
    const auto derivative = [&](const unsigned unknown, const unsigned known) {
      const double one = 1;
      double result    = 0;
      EXPECT_EQ(FMI3(client, GetDirectionalDerivative)(client.c, &unknown, 1, &known, 1, &one, 1, &result, 1),
                fmi3OK)
          << client.logged();
      const std::string unit = variables[known].unit;
      const double change    = variables[known].start != 0 ? std::abs(variables[known].start) : 1;
      const double size = variables[unknown].nominal > 0 ? variables[unknown].nominal : 100;  // frequencies, Hz
      return std::abs(result) * change / size;
    };
    int dependent = 0, independent = 0;
    const auto check = [&](const bool at_start) {
      for (unsigned u = 0; u < variables.size(); ++u) {
        const bool output = variables[u].causality == fmu::Causality::output;
        if (!output && !(at_start && variables[u].causality == fmu::Causality::calculated_parameter))
          continue;
        const auto listed = at_start ? depends.at_start(variables[u]) : depends.at_communication(variables[u]);
        for (unsigned k = 1; k < variables.size(); ++k) {
          if (!variables[k].has_start() || variables[k].type != fmu::Type::real)
            continue;
          const double slope = derivative(u, k);
          if (std::find(listed.begin(), listed.end(), k) == listed.end()) {
            ++independent;
            EXPECT_LT(slope, 1e-7) << variables[u].name << " by " << variables[k].name << at_start
                                   << ": rounding of differences of fourth order";
          } else
            dependent += slope > 1e-7;
        }
      }
    };
    ASSERT_EQ(FMI3(client, EnterInitializationMode)(client.c, false, 0, 0, false, 0), fmi3OK);
    ASSERT_EQ(client.set("F_roll", 1.2e6), fmi3OK);
    check(true);
    ASSERT_EQ(FMI3(client, ExitInitializationMode)(client.c), fmi3OK);
    ASSERT_EQ(client.set("F_roll", 2e6), fmi3OK);
    ASSERT_EQ(client.step(0, 7e-3), fmi3OK);
    check(false);
    EXPECT_GT(dependent, 15);
    EXPECT_GT(independent, 50);
  }
}

TEST(UnitDerivatives, DerivativesMayBeAskedAfterTermination)
{
  const SampleStand stand = sample_stand();
  Client2 two(stand.model);
  Client3 three(stand.model);
  ASSERT_EQ(two.start(976e3), fmi2OK);
  ASSERT_EQ(three.start(976e3), fmi3OK);
  const unsigned unknown = two.at("a_upper_work_roll"), known = 1;
  const int order  = 1;
  const double one = 1;
  double along[2] = {}, back[2] = {}, rate[2] = {};
  ASSERT_EQ(two.set("F_roll", 990e3) + three.set("F_roll", 990e3), 0);
  ASSERT_EQ(two.step(0, 0.01) + three.step(0, 0.01), 0);
  ASSERT_EQ(FMI2(two, Terminate)(two.c), fmi2OK);
  ASSERT_EQ(FMI3(three, Terminate)(three.c), fmi3OK);
  EXPECT_EQ(FMI2(two, GetDirectionalDerivative)(two.c, &unknown, 1, &known, 1, &one, &along[0]), fmi2OK);
  EXPECT_EQ(FMI3(three, GetDirectionalDerivative)(three.c, &unknown, 1, &known, 1, &one, 1, &along[1], 1), fmi3OK);
  EXPECT_EQ(FMI3(three, GetAdjointDerivative)(three.c, &unknown, 1, &known, 1, &one, 1, &back[1], 1), fmi3OK);
  EXPECT_EQ(FMI2(two, GetRealOutputDerivatives)(two.c, &unknown, 1, &order, &rate[0]), fmi2OK);
  EXPECT_EQ(FMI3(three, GetOutputDerivatives)(three.c, &unknown, 1, &order, &rate[1], 1), fmi3OK);
  for (const double derivative : {along[0], along[1], back[1]})
    EXPECT_TRUE(near(derivative, 1 / stand.chain.M[2], within(1e-12, "1/M3")));
  EXPECT_EQ(rate[0], rate[1]);
  EXPECT_NE(rate[0], 0);
}
