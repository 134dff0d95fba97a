// The recorded force of a unit: when it is played, and what copies of the state know of it.
#include "tests/support/near.h"
#include "tests/support/unit_client.h"
#include <cmath>
#include <filesystem>
#include <memory>
#include <vector>

using namespace mill;
namespace fs = std::filesystem;

TEST(UnitForce, AMissingRecordIsAnErrorWhenItIsNeeded)
{
  SampleStand with = sample_stand();
  carry(with.model, sample_force(100, 1e-3));
  Client2 client(with.model);
  ASSERT_TRUE(client.c) << client.logged();
  fs::remove(client.unit->resources() + "force.csv");
  const unsigned use = client.at("use_stored_force");
  const int yes      = 1;
  ASSERT_EQ(FMI2(client, SetBoolean)(client.c, &use, 1, &yes), fmi2OK);
  FMI2(client, SetupExperiment)(client.c, 0, 0, 0, 0, 0);
  FMI2(client, EnterInitializationMode)(client.c);
  EXPECT_EQ(FMI2(client, ExitInitializationMode)(client.c), fmi2Error);
  EXPECT_NE(client.logged().find("fmi2ExitInitializationMode: cannot read "), std::string::npos);
  EXPECT_EQ(FMI2(client, Reset)(client.c), fmi2OK) << "and the instance can be used without it";
  EXPECT_EQ(client.start(976e3), fmi2OK);
}

// A copy taken in the middle of a stored force goes on in an instance that has not read it yet.
TEST(UnitForce, CopiesKnowWhereTheStoredForceIs)
{
  SampleStand with = sample_stand(ForceMeaning::disturbance, 0.01, 2e6);
  carry(with.model, sample_force(1000, 1e-3));
  Client2 client(with.model);
  ASSERT_TRUE(client.c) << client.logged();
  const unsigned use = client.at("use_stored_force");
  const int yes      = 1;
  ASSERT_EQ(FMI2(client, SetBoolean)(client.c, &use, 1, &yes), fmi2OK);
  ASSERT_EQ(client.start(0), fmi2OK) << client.logged();
  ASSERT_EQ(client.step(0, 0.1234), fmi2OK);
  fmi2FMUstate state = nullptr, second = nullptr;
  ASSERT_EQ(FMI2(client, GetFMUstate)(client.c, &state), fmi2OK);
  std::size_t size = 0;
  FMI2(client, SerializedFMUstateSize)(client.c, state, &size);
  std::vector<char> bytes(size);
  ASSERT_EQ(FMI2(client, SerializeFMUstate)(client.c, state, bytes.data(), size), fmi2OK);
  ASSERT_EQ(client.step(0.1234, 0.3), fmi2OK);
  const double straight = client.get("a_lower_work_roll");
  Client2 other(client.unit, with.model, with.model.data.guid, "");
  ASSERT_EQ(FMI2(other, DeSerializeFMUstate)(other.c, bytes.data(), size, &second), fmi2OK);
  ASSERT_EQ(FMI2(other, SetFMUstate)(other.c, second), fmi2OK) << other.logged();
  ASSERT_EQ(other.step(0.1234, 0.3), fmi2OK) << other.logged();
  EXPECT_EQ(other.get("a_lower_work_roll"), straight);
  FMI2(other, FreeFMUstate)(other.c, &second);
  FMI2(client, FreeFMUstate)(client.c, &state);
}

// A unit as it comes: without an input the recorded force is played, and the input drives from the moment at which
// a client sets it.  use_stored_force decides where it is set.
TEST(UnitForce, TheStoredForcePlaysUntilTheInputIsSet)
{
  SampleStand with = sample_stand(ForceMeaning::disturbance, 0.01, 2e6);
  carry(with.model, sample_force(1000, 1e-3));
  Client2 first(with.model);
  ASSERT_TRUE(first.c) << first.logged();
  const auto instance = [&] {
    return std::make_unique<Client2>(first.unit, with.model, with.model.data.guid, "");
  };
  const auto begin = [](Client2 &client) {
    return FMI2(client, SetupExperiment)(client.c, 0, 0, 0, 0, 0) +
           FMI2(client, EnterInitializationMode)(client.c) + FMI2(client, ExitInitializationMode)(client.c);
  };
  const auto moved = [](Client2 &client, const double from, const double to) {
    EXPECT_EQ(client.step(from, to - from), fmi2OK) << client.logged();
    return client.get("a_upper_work_roll");
  };
  const auto chosen = instance(), as_it_comes = instance(), off = instance(), driven = instance();
  chosen->choose("use_stored_force", true);
  off->choose("use_stored_force", false);
  driven->set("F_roll", with.model.data.mean_force);
  for (Client2 *client : {chosen.get(), as_it_comes.get(), off.get(), driven.get()})
    ASSERT_EQ(begin(*client), 0) << client->logged();
  const double played = moved(*chosen, 0, 0.1234);
  EXPECT_GT(std::abs(played), 1e-3);
  EXPECT_EQ(moved(*as_it_comes, 0, 0.1234), played) << "the record";
  EXPECT_LT(std::abs(moved(*off, 0, 0.1234)), 1e-9) << "F_roll, which is the mean";
  EXPECT_LT(std::abs(moved(*driven, 0, 0.1234)), 1e-9) << "an input that is set before the run";
  // A copy knows that the input is not set; one of afterwards that it is.
  fmi2FMUstate before = nullptr, after = nullptr, read = nullptr;
  ASSERT_EQ(FMI2(*as_it_comes, GetFMUstate)(as_it_comes->c, &before), fmi2OK);
  ASSERT_EQ(as_it_comes->set("F_roll", 990e3), fmi2OK);
  ASSERT_EQ(FMI2(*as_it_comes, GetFMUstate)(as_it_comes->c, &after), fmi2OK);
  const double input = moved(*as_it_comes, 0.1234, 0.2), record = moved(*chosen, 0.1234, 0.2);
  EXPECT_NE(input, record);
  ASSERT_EQ(FMI2(*as_it_comes, SetFMUstate)(as_it_comes->c, before), fmi2OK);
  EXPECT_EQ(moved(*as_it_comes, 0.1234, 0.2), record);
  std::size_t size = 0;
  FMI2(*as_it_comes, SerializedFMUstateSize)(as_it_comes->c, after, &size);
  std::vector<char> bytes(size);
  ASSERT_EQ(FMI2(*as_it_comes, SerializeFMUstate)(as_it_comes->c, after, bytes.data(), size), fmi2OK);
  const auto other = instance();
  ASSERT_EQ(FMI2(*other, DeSerializeFMUstate)(other->c, bytes.data(), size, &read), fmi2OK) << other->logged();
  ASSERT_EQ(FMI2(*other, SetFMUstate)(other->c, read), fmi2OK);
  EXPECT_EQ(moved(*other, 0.1234, 0.2), input) << "in another instance";
  FMI2(*other, FreeFMUstate)(other->c, &read);
  FMI2(*as_it_comes, FreeFMUstate)(as_it_comes->c, &before);
  FMI2(*as_it_comes, FreeFMUstate)(as_it_comes->c, &after);
  // Where use_stored_force is true the input does nothing; Reset forgets both.
  ASSERT_EQ(chosen->set("F_roll", 5e5), fmi2OK);
  const auto again = instance();
  again->choose("use_stored_force", true);
  ASSERT_EQ(begin(*again), 0);
  EXPECT_TRUE(near(moved(*chosen, 0.2, 0.3), moved(*again, 0, 0.3), within(1e-10, "rounding of other steps")));
  ASSERT_EQ(FMI2(*driven, Reset)(driven->c), fmi2OK);
  ASSERT_EQ(begin(*driven), 0);
  EXPECT_EQ(moved(*driven, 0, 0.1234), played);
  // A derivative alone sets the input too.
  const auto sloped = instance();
  ASSERT_EQ(begin(*sloped), 0);
  ASSERT_EQ(sloped->slope(1e6), fmi2OK);
  EXPECT_NE(moved(*sloped, 0, 0.1234), played);
}

// FMI 3: whoever asks for the force inside the steps brings one; everybody else hears the record.
TEST(UnitForce, VersionThreePlaysTheRecordUnlessTheForceIsAsked)
{
  SampleStand with = sample_stand();
  carry(with.model, sample_force(1000, 1e-3));
  Client3 plain(with.model);
  ASSERT_TRUE(plain.c) << plain.logged();
  Client3 asking(plain.unit, with.model, true);
  for (Client3 *client : {&plain, &asking}) {
    client->force_at_end = with.model.data.mean_force;
    ASSERT_EQ(FMI3(*client, EnterInitializationMode)(client->c, false, 0, 0, false, 0), fmi3OK);
    ASSERT_EQ(FMI3(*client, ExitInitializationMode)(client->c), fmi3OK);
    ASSERT_EQ(client->step(0, 0.05), fmi3OK) << client->logged();
  }
  EXPECT_GT(std::abs(plain.get("a_upper_work_roll")), 1e-3);
  EXPECT_LT(std::abs(asking.get("a_upper_work_roll")), 1e-9) << "the mean";
  // By the time, as the description says: the rate of the record times 1/M3.
  const unsigned unknown = plain.at("a_upper_work_roll"), time = 0;
  const double one = 1, force[] = {with.model.series.force[50], with.model.series.force[51]};
  double slope = 0;
  ASSERT_EQ(FMI3(plain, GetDirectionalDerivative)(plain.c, &unknown, 1, &time, 1, &one, 1, &slope, 1), fmi3OK)
      << plain.logged();
  EXPECT_TRUE(
      near(slope, (force[1] - force[0]) / 1e-3 / with.chain.M[2], within(1e-9, "rounding of differences")));
}
