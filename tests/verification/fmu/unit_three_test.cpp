// What clients of FMI 3 rely on.
#include "tests/support/near.h"
#include "tests/support/unit_client.h"
#include <cmath>

using namespace mill;

TEST(UnitThree, KeepsItsOwnRules)
{
  const SampleStand stand = sample_stand();
  Client3 client(stand.model);
  ASSERT_TRUE(client.c) << client.logged();
  EXPECT_STREQ(FMI3(client, GetVersion)(), "3.0");
  ASSERT_EQ(client.start(976e3, 1), fmi3OK) << client.logged();
  EXPECT_EQ(client.get("time"), 1);
  EXPECT_EQ(client.step(1, 0.5), fmi3OK);
  EXPECT_EQ(client.get("time"), 1.5);
  client.logged();
  const unsigned two[] = {1, 2};
  double values[2];
  EXPECT_EQ(FMI3(client, GetFloat64)(client.c, two, 2, values, 1), fmi3Error);
  EXPECT_EQ(client.logged(), "fmi3GetFloat64: 2 variables and 1 values; every variable is a scalar\n");
  EXPECT_EQ(FMI3(client, EnterEventMode)(client.c), fmi3Error);
  EXPECT_EQ(client.logged(), "fmi3EnterEventMode: this FMU has no event mode (hasEventMode)\n");
  EXPECT_EQ(FMI3(client, SetTime)(client.c, 1), fmi3Error);
  EXPECT_EQ(client.logged(), "fmi3SetTime: this FMU is for co-simulation only, not for model exchange\n");
  EXPECT_EQ(client.set("time", 3), fmi3Error);
  EXPECT_EQ(client.logged(), "fmi3SetFloat64: time is given by the steps and cannot be set\n");
  bool flag[3] = {true, true, true};
  double last  = 0;
  EXPECT_EQ(FMI3(client, DoStep)(client.c, 7, 1, true, &flag[0], &flag[1], &flag[2], &last), fmi3Error);
  EXPECT_FALSE(flag[0] || flag[1] || flag[2]);
  EXPECT_EQ(last, 1.5);
  EXPECT_FALSE(FMI3(client, InstantiateCoSimulation)("one", stand.model.data.guid.c_str(), nullptr, false, false,
                                                     false, false, nullptr, 0, nullptr, nullptr, nullptr));
  EXPECT_FALSE(FMI3(client, InstantiateCoSimulation)("one", stand.model.data.guid.c_str(),
                                                     client.unit->resources().c_str(), false, false, true, false,
                                                     nullptr, 0, nullptr, nullptr, nullptr));
  EXPECT_FALSE(FMI3(client, InstantiateModelExchange)("one", "", "", false, false, nullptr, nullptr));
  // adjoint and directional derivatives are one matrix
  const unsigned unknowns[] = {client.at("a_upper_work_roll"), client.at("a_lower_work_roll")}, known = 1;
  const double seeds[] = {2, 3}, one = 1;
  double along[2], back              = 0;
  ASSERT_EQ(FMI3(client, GetDirectionalDerivative)(client.c, unknowns, 2, &known, 1, &one, 1, along, 2), fmi3OK);
  ASSERT_EQ(FMI3(client, GetAdjointDerivative)(client.c, unknowns, 2, &known, 1, seeds, 2, &back, 1), fmi3OK);
  EXPECT_TRUE(near(back, 2 * along[0] + 3 * along[1], within(1e-14, "transposed")));
}

TEST(UnitThree, ShowsStartValuesBeforeInitialization)
{
  SampleStand with = sample_stand();
  carry(with.model, sample_force(100, 1e-3));
  Client3 client(with.model);
  ASSERT_TRUE(client.c) << client.logged();
  EXPECT_EQ(client.get("K3"), 4.02e10);
  EXPECT_EQ(client.get("F_roll"), with.model.data.mean_force);
  EXPECT_EQ(client.get("time"), 0);
  const unsigned use = client.at("use_stored_force");
  bool truth         = true;
  EXPECT_EQ(FMI3(client, GetBoolean)(client.c, &use, 1, &truth, 1), fmi3OK);
  EXPECT_FALSE(truth);
  ASSERT_EQ(client.set("K3", 3e10), fmi3OK);
  EXPECT_EQ(client.get("K3"), 3e10) << "as it was set";
  const double f3 = client.get("f3"), y = client.get("y_upper_work_roll");
  ASSERT_EQ(client.start(with.model.data.mean_force), fmi3OK) << client.logged();
  EXPECT_EQ(client.get("f3"), f3);
  EXPECT_NE(client.get("y_upper_work_roll"), y) << "the record was the force before F_roll was set";
}

TEST(UnitThree, IsSilentWithLoggingOffAndDoublesTheSignOfReferences)
{
  const SampleStand stand = sample_stand();
  Client3 quiet(stand.model, false, false);
  ASSERT_TRUE(quiet.c);
  EXPECT_EQ(quiet.step(0, 1), fmi3Error);
  EXPECT_EQ(quiet.set("K3", -1), fmi3Discard);
  EXPECT_FALSE(FMI3(quiet, InstantiateCoSimulation)(
      "one", "no token", quiet.unit->resources().c_str(), false, false, false, false, nullptr, 0, &quiet,
      [](fmi3InstanceEnvironment, fmi3Status, fmi3String, fmi3String) {
        ADD_FAILURE() << "a message with logging off";
      },
      nullptr));
  EXPECT_EQ(quiet.logged(), "");
  ASSERT_EQ(FMI3(quiet, SetDebugLogging)(quiet.c, true, 0, nullptr), fmi3OK);
  EXPECT_EQ(quiet.step(0, 1), fmi3Error);
  EXPECT_EQ(quiet.logged(), "fmi3DoStep is not allowed after instantiation\n");
  struct Journal {
    std::string text;
  } journal;
  EXPECT_FALSE(FMI3(quiet, InstantiateCoSimulation)(
      "one", "token", "/a %20#12#/", false, true, false, false, nullptr, 0, &journal,
      [](fmi3InstanceEnvironment to, fmi3Status, fmi3String, fmi3String text) {
        static_cast<Journal *>(to)->text = text;
      },
      nullptr));
  EXPECT_EQ(journal.text,
            "fmi3InstantiateCoSimulation: cannot read /a %20##12##/model.json: No such file or directory");
}
