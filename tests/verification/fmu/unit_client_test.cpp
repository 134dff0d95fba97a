// What clients of both versions rely on: order of calls, refusals, copies, several instances, places of files.
#include "dynamics/fmu/archive.h"
#include "dynamics/fmu/runtime/variables.h"
#include "dynamics/fmu/unit_archive.h"
#include "tests/support/near.h"
#include "tests/support/unit_client.h"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>
#include <vector>

using namespace mill;
namespace fs = std::filesystem;

namespace {
const SampleStand &stand()
{
  static const SampleStand made = sample_stand();
  return made;
}
const fmu::ExportedModel &model()
{
  return stand().model;
}
std::shared_ptr<fmu::UnpackedUnit> unit()
{
  static const auto made =
      std::make_shared<fmu::UnpackedUnit>(fmu::unit_archive(model(), 2), model().identifier, 2);
  return made;
}
std::string guid()
{
  return model().data.guid;
}

double run_of(Client2 &client, const int n, const double phase)
{
  for (int i = 0; i < n; ++i) {
    client.set("F_roll", 976e3 + 1e4 * std::sin(0.1 * i + phase));
    EXPECT_EQ(client.step(1e-3 * i, 1e-3), fmi2OK) << client.logged();
  }
  return client.get("a_upper_work_roll");
}
}  // namespace

TEST(UnitClient, AnotherIdentityOrKindOrFolderGivesNoInstance)
{
  {
    Client2 client(unit(), model(), "{00000000-0000-0000-0000-000000000000}", "");
    EXPECT_FALSE(client.c);
    EXPECT_EQ(client.logged(), "fmi2Instantiate: the model has the identity " + guid() +
                                   ", the description has {00000000-0000-0000-0000-000000000000}; they belong to "
                                   "different exports\n");
  }
  {
    Client2 client(unit(), model(), guid(), "file:///nowhere/resources");
    EXPECT_FALSE(client.c);
    EXPECT_EQ(client.logged(),
              "fmi2Instantiate: cannot read /nowhere/resources/model.json: No such file or directory\n");
  }
  {
    Client2 client(unit(), model(), guid(), "http://nowhere/resources");
    EXPECT_FALSE(client.c);
    EXPECT_EQ(client.logged(), "fmi2Instantiate: resourceLocation http://nowhere/resources is not a file: URI\n");
  }
  Client2 client(unit(), model(), guid(), "");
  EXPECT_FALSE(FMI2(client, Instantiate)("one", fmi2ModelExchange, guid().c_str(),
                                         ("file://" + unit()->resources()).c_str(), &client.callbacks, 0, 0));
  EXPECT_EQ(client.logged(), "fmi2Instantiate: this FMU is for co-simulation only\n");
  EXPECT_FALSE(FMI2(client, Instantiate)("one", fmi2CoSimulation, guid().c_str(), nullptr, nullptr, 0, 0));
}

TEST(UnitClient, CallsOutOfOrderAreToldAndHarmless)
{
  Client2 client(unit(), model(), guid(), "");
  ASSERT_TRUE(client.c);
  double value           = 0;
  const unsigned y_frame = client.at("y_upper_frame");
  EXPECT_EQ(client.step(0, 1e-3), fmi2Error);
  EXPECT_EQ(client.logged(), "fmi2DoStep is not allowed after instantiation\n");
  EXPECT_EQ(FMI2(client, GetReal)(client.c, &y_frame, 1, &value), fmi2Error);
  EXPECT_EQ(client.logged(), "fmi2GetReal is not allowed after instantiation\n");
  EXPECT_EQ(FMI2(client, EnterInitializationMode)(client.c), fmi2Error);
  EXPECT_EQ(client.logged(), "fmi2EnterInitializationMode is not allowed after instantiation\n");
  EXPECT_EQ(FMI2(client, ExitInitializationMode)(client.c), fmi2Error);
  EXPECT_EQ(FMI2(client, Terminate)(client.c), fmi2Error);
  client.logged();
  ASSERT_EQ(client.start(976e3), fmi2OK);
  EXPECT_EQ(FMI2(client, SetupExperiment)(client.c, 0, 0, 0, 0, 0), fmi2Error);
  EXPECT_EQ(client.logged(), "fmi2SetupExperiment is not allowed between steps\n");
  EXPECT_EQ(client.step(0, 1e-3), fmi2OK);
  EXPECT_EQ(FMI2(client, CancelStep)(client.c), fmi2Error);
  EXPECT_EQ(client.logged(), "fmi2CancelStep: no step is under way, every step ends before it returns\n");
  EXPECT_EQ(FMI2(client, Terminate)(client.c), fmi2OK);
  EXPECT_EQ(client.step(1e-3, 1e-3), fmi2Error);
  EXPECT_EQ(client.logged(), "fmi2DoStep is not allowed after termination\n");
  EXPECT_EQ(FMI2(client, GetReal)(client.c, &y_frame, 1, &value), fmi2OK);
  EXPECT_EQ(FMI2(client, DoStep)(nullptr, 0, 1, 1), fmi2Error);
}

TEST(UnitClient, StepsThatDoNotFollowOneAnotherAreRefused)
{
  Client2 client(unit(), model(), guid(), "");
  ASSERT_EQ(client.start(976e3, 2, 2.5), fmi2OK) << client.logged();
  EXPECT_EQ(client.step(0, 0.1), fmi2Error);
  EXPECT_EQ(client.logged(), "fmi2DoStep: the step begins at 0 s, the instance is at 2 s\n");
  EXPECT_EQ(client.step(2, 0), fmi2Error);
  EXPECT_EQ(client.logged(),
            "fmi2DoStep: the step from 2 s over 0 s must have a length above zero and up to 1000000000 s\n");
  EXPECT_EQ(client.step(2, NAN), fmi2Error);
  client.logged();
  EXPECT_EQ(client.step(2, 0.25), fmi2OK);
  EXPECT_EQ(client.step(2.25 + 1e-15, 0.25 + 1e-11), fmi2OK) << "rounding of a client";
  EXPECT_EQ(client.step(2.5, 0.1), fmi2Error);
  EXPECT_EQ(client.logged(), "fmi2DoStep: the step to 2.6 s passes the stop time 2.5 s\n");
  double time = 0;
  EXPECT_EQ(FMI2(client, GetRealStatus)(client.c, fmi2LastSuccessfulTime, &time), fmi2OK);
  EXPECT_TRUE(near(time, 2.5, within(1e-11, "the client is late by 1e-11 s")));
  int value = 7;
  EXPECT_EQ(FMI2(client, GetBooleanStatus)(client.c, fmi2Terminated, &value), fmi2OK);
  EXPECT_EQ(value, 0);
  EXPECT_EQ(FMI2(client, GetIntegerStatus)(client.c, fmi2DoStepStatus, &value), fmi2Discard);
}

TEST(UnitClient, ValuesThatCannotBeAreRefusedByName)
{
  Client2 client(unit(), model(), guid(), "");
  EXPECT_EQ(client.set("M3", 0), fmi2Discard);
  EXPECT_EQ(client.logged(), "fmi2SetReal: M3 = 0 kg is out of range (0.001 .. 1000000000 kg); it stays " +
                                 std::string("1888.705 kg\n"));
  EXPECT_EQ(client.set("K3", -4e10), fmi2Discard);
  EXPECT_EQ(client.logged(),
            "fmi2SetReal: K3 = -4e+10 N/m is out of range (1000 .. 1e+15 N/m); it stays 4.02e+10 N/m\n");
  EXPECT_EQ(client.set("modal_damping", NAN), fmi2Discard);
  EXPECT_EQ(client.logged(), "fmi2SetReal: modal_damping = nan is out of range (0 .. 0.5); it stays 0.01\n");
  EXPECT_EQ(client.set("F_roll", INFINITY), fmi2Discard);
  EXPECT_EQ(client.logged(),
            "fmi2SetReal: F_roll = inf N is out of range (-1e+12 .. 1e+12 N); it stays 976000 N\n");
  EXPECT_EQ(client.set("y_upper_frame", 1), fmi2Error);
  EXPECT_EQ(client.logged(), "fmi2SetReal: y_upper_frame is computed and cannot be set\n");
  const unsigned far[]  = {1, 900};
  const double values[] = {5e5, 1};
  EXPECT_EQ(FMI2(client, SetReal)(client.c, far, 2, values), fmi2Error);
  EXPECT_EQ(client.logged(),
            "fmi2SetReal: there is no variable with the value reference 900, the last one is 36\n");
  const int number = 1;
  EXPECT_EQ(FMI2(client, SetInteger)(client.c, far, 1, &number), fmi2Error);
  EXPECT_EQ(client.logged(), "fmi2SetInteger: F_roll is of type Real (Float64)\n");
  const char *const text = "";
  EXPECT_EQ(FMI2(client, SetString)(client.c, far, 1, &text), fmi2Error);
  EXPECT_EQ(client.logged(), "fmi2SetString: F_roll is of type Real (Float64)\nfmi2SetString: the model has no "
                             "variable of type String\n");
  EXPECT_EQ(FMI2(client, SetReal)(client.c, nullptr, 1, values), fmi2Error);
  client.logged();
  ASSERT_EQ(client.start(976e3), fmi2OK);
  EXPECT_EQ(client.get("F_roll"), 976e3) << "nothing of a refused call was kept";
  EXPECT_EQ(client.set("M3", 2000), fmi2Error);
  EXPECT_EQ(client.logged(), "fmi2SetReal: M3 is fixed: it can only be set before the first step\n");
  EXPECT_EQ(client.set("K3", 3e10), fmi2OK);
  EXPECT_EQ(client.slope(NAN), fmi2Discard);
  EXPECT_EQ(client.logged(), "fmi2SetRealInputDerivatives: the derivative of F_roll, nan N/s, is out of range "
                             "(-1e+24 .. 1e+24 N/s); it stays 0 N/s\n");
}

TEST(UnitClient, MessagesAreFormatsWithoutSurprise)
{
  Client2 client(unit(), model(), guid(), "/a%20%25#/", false);
  EXPECT_FALSE(client.c);
  EXPECT_EQ(client.logged(), "fmi2Instantiate: cannot read /a%%20%%25##/model.json: No such file or directory\n")
      << "a plain path is taken as it is, both signs are doubled";
  Client2 quiet(unit(), model(), guid(), "");
  const char *const all[] = {"logAll"}, *const none[] = {"logNothing"};
  EXPECT_EQ(FMI2(quiet, SetDebugLogging)(quiet.c, 1, 1, none), fmi2Error);
  EXPECT_EQ(quiet.logged(), "fmi2SetDebugLogging: there is no category logNothing\n");
  EXPECT_EQ(FMI2(quiet, SetDebugLogging)(quiet.c, 0, 1, all), fmi2OK);
  EXPECT_EQ(quiet.step(0, 1), fmi2Error);
  EXPECT_EQ(quiet.logged(), "");
  EXPECT_EQ(FMI2(quiet, SetDebugLogging)(quiet.c, 1, 0, nullptr), fmi2OK);
  EXPECT_EQ(FMI2(quiet, Reset)(quiet.c), fmi2OK);
  EXPECT_EQ(quiet.logged(), "all values are those after instantiation\n");
}

TEST(UnitClient, InitializationShowsTheForceSetSoFar)
{
  Client2 client(unit(), model(), guid(), "");
  FMI2(client, SetupExperiment)(client.c, 0, 0, 0, 0, 0);
  FMI2(client, EnterInitializationMode)(client.c);
  EXPECT_EQ(client.get("y_upper_work_roll"), 0) << "at rest under the mean force";
  EXPECT_TRUE(near(client.get("F_cell"), 976e3, within(1e-12, "the mean")));
  client.set("F_roll", 986e3);
  const Eigen::VectorXd y = dynamics::static_displacement(stand().chain) * 1e4;
  for (int i = 0; i < 6; ++i)
    EXPECT_TRUE(near(client.get("y_" + model().data.points[std::size_t(i)]), y[i], within(1e-11, "two solvers")))
        << i;
  EXPECT_TRUE(near(client.get("F_cell"), 986e3, within(1e-12, "statics")));
}

TEST(UnitClient, ResetAndCopiesBringTheSameRunAgain)
{
  Client2 client(unit(), model(), guid(), "");
  client.set("K3", 3e10);
  ASSERT_EQ(client.start(976e3), fmi2OK);
  const double changed = run_of(client, 50, 0);
  ASSERT_EQ(FMI2(client, Reset)(client.c), fmi2OK);
  ASSERT_EQ(client.start(976e3), fmi2OK);
  const double once = run_of(client, 50, 0);
  EXPECT_NE(once, changed) << "Reset takes the parameters back";

  Client2 other(unit(), model(), guid(), "");
  ASSERT_EQ(other.start(976e3), fmi2OK);
  run_of(other, 20, 0);
  other.slope(1e5);
  fmi2FMUstate state = nullptr;
  ASSERT_EQ(FMI2(other, GetFMUstate)(other.c, &state), fmi2OK);
  std::size_t size = 0;
  ASSERT_EQ(FMI2(other, SerializedFMUstateSize)(other.c, state, &size), fmi2OK);
  std::vector<char> bytes(size);
  ASSERT_EQ(FMI2(other, SerializeFMUstate)(other.c, state, bytes.data(), size), fmi2OK);
  const auto go_on = [](Client2 &c) {
    c.set("F_roll", 980e3);
    EXPECT_EQ(c.step(0.02, 0.01), fmi2OK) << c.logged();
    return c.get("a_upper_work_roll");
  };
  const double straight = go_on(other);
  ASSERT_EQ(FMI2(other, SetFMUstate)(other.c, state), fmi2OK);
  EXPECT_EQ(go_on(other), straight) << "to the last digit";

  Client2 fresh(unit(), model(), guid(), "");
  fmi2FMUstate second = nullptr;
  ASSERT_EQ(FMI2(fresh, DeSerializeFMUstate)(fresh.c, bytes.data(), size, &second), fmi2OK) << fresh.logged();
  ASSERT_EQ(FMI2(fresh, SetFMUstate)(fresh.c, second), fmi2OK);
  EXPECT_EQ(go_on(fresh), straight) << "in another instance, in any phase";
  bytes[size / 2] ^= 1;
  EXPECT_EQ(FMI2(fresh, DeSerializeFMUstate)(fresh.c, bytes.data(), size, &second), fmi2Error);
  EXPECT_EQ(fresh.logged(),
            "fmi2DeSerializeFMUstate: the bytes are not a serialised state, or they are damaged\n");
  EXPECT_EQ(FMI2(fresh, DeSerializeFMUstate)(fresh.c, bytes.data(), 5, &second), fmi2Error);
  EXPECT_EQ(FMI2(fresh, SerializeFMUstate)(fresh.c, second, bytes.data(), 10), fmi2Error);
  EXPECT_EQ(FMI2(fresh, FreeFMUstate)(fresh.c, &second), fmi2OK);
  EXPECT_EQ(second, nullptr);
  EXPECT_EQ(FMI2(fresh, SetFMUstate)(fresh.c, nullptr), fmi2Error);
  EXPECT_EQ(FMI2(other, FreeFMUstate)(other.c, &state), fmi2OK);
}

TEST(UnitClient, InstancesShareNothingInTurnAndInThreads)
{
  Client2 alone(unit(), model(), guid(), "");
  ASSERT_EQ(alone.start(976e3), fmi2OK);
  const double expected = run_of(alone, 100, 0.5);
  Client2 a(unit(), model(), guid(), ""), b(unit(), model(), guid(), "");
  ASSERT_EQ(a.start(976e3), fmi2OK);
  ASSERT_EQ(b.start(950e3), fmi2OK);
  b.set("K3", 1e10);
  for (int i = 0; i < 100; ++i) {
    a.set("F_roll", 976e3 + 1e4 * std::sin(0.1 * i + 0.5));
    ASSERT_EQ(a.step(1e-3 * i, 1e-3), fmi2OK);
    ASSERT_EQ(b.step(2e-3 * i, 2e-3), fmi2OK);
  }
  EXPECT_EQ(a.get("a_upper_work_roll"), expected);
  std::vector<double> results(4);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < results.size(); ++t)
    threads.emplace_back([&results, t] {
      Client2 client(unit(), model(), guid(), "");
      client.start(976e3);
      results[t] = run_of(client, 100, 0.5);
    });
  for (std::thread &thread : threads)
    thread.join();
  for (const double result : results)
    EXPECT_EQ(result, expected);
}

TEST(UnitClient, FoldersMayHaveSpacesAndUmlautsAndBeReadOnly)
{
  const fs::path folder = fs::path(testing::TempDir()) / "unit with spaces und \xC3\xBC" / "resources";
  fs::create_directories(folder);
  fs::copy_file(unit()->resources() + "model.json", folder / "model.json", fs::copy_options::overwrite_existing);
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  std::string encoded;
  for (const char c : folder.string())
    encoded += c == ' ' ? std::string("%20") : c == '\xC3' ? "%C3" : c == '\xBC' ? "%bc" : std::string(1, c);
  for (const std::string &location : {"file://" + encoded, "file:" + encoded + "/", "file://localhost" + encoded,
                                      folder.string(), folder.string() + "/"}) {
    Client2 client(unit(), model(), guid(), location);
    EXPECT_TRUE(client.c) << location << client.logged();
    EXPECT_EQ(client.start(976e3), fmi2OK);
    EXPECT_EQ(client.step(0, 0.1), fmi2OK);
  }
  fs::permissions(folder, fs::perms::owner_all);
  std::ofstream(folder / "model.json") << "{\"runtime\": \"1\", \"guid\"";
  Client2 broken(unit(), model(), guid(), folder.string());
  EXPECT_FALSE(broken.c);
  EXPECT_EQ(broken.logged(), "fmi2Instantiate: " + folder.string() +
                                 "/model.json is not a model of this runtime: unexpected character at byte 23\n");
}

// Calls in any order with any values: every one returns, and what can be read is a number.
TEST(UnitClient, AnyOrderOfCallsIsSurvived)
{
  std::mt19937 engine(7);
  const auto any     = [&](const unsigned n) { return unsigned(engine() % n); };
  const double odd[] = {NAN, INFINITY, -1, 0, 1e300, 1e-300, 4e10, 1e6, 0.3, 977e3};
  long steps = 0, read = 0;
  for (int run = 0; run < 1000; ++run) {
    Client2 client(unit(), model(), guid(), "");
    ASSERT_TRUE(client.c);
    fmi2FMUstate state = nullptr;
    double time        = 0;
    for (int k = 0; k < 50; ++k) {
      const unsigned vr[] = {any(40), any(2) ? 1 : any(40)};
      const double in[]   = {odd[any(10)], odd[any(10)]};
      const int order     = int(any(3));
      double out[2];
      switch (any(14)) {
      case 0:
        FMI2(client, SetupExperiment)(client.c, 0, 0, any(3) ? 0 : in[0], 0, in[1]);
        break;
      case 1:
        FMI2(client, EnterInitializationMode)(client.c);
        break;
      case 2:
        FMI2(client, ExitInitializationMode)(client.c);
        break;
      case 3:
      case 4:
        FMI2(client, SetReal)(client.c, vr, 2, in);
        break;
      case 5:
        FMI2(client, SetRealInputDerivatives)(client.c, vr + 1, 1, &order, in);
        break;
      case 6:
        if (any(4) == 0)
          FMI2(client, Reset)(client.c), time = 0;
        break;
      case 7:
        FMI2(client, GetFMUstate)(client.c, &state);
        break;
      case 8:
        FMI2(client, SetFMUstate)(client.c, state);
        FMI2(client, GetRealStatus)(client.c, fmi2LastSuccessfulTime, &time);
        break;
      case 9:
        FMI2(client, GetDirectionalDerivative)(client.c, vr, 1, vr + 1, 1, in, out);
        break;
      case 10:
        if (FMI2(client, GetReal)(client.c, vr, 2, out) == fmi2OK) {
          ++read;
          EXPECT_TRUE(std::isfinite(out[0]) && std::isfinite(out[1])) << vr[0] << " " << vr[1];
        }
        break;
      default:
        const double length = any(8) ? std::pow(10.0, -double(any(9))) : in[0];
        if (client.step(time, length) == fmi2OK) {
          time = time + length;
          ++steps;
        }
      }
    }
    FMI2(client, FreeFMUstate)(client.c, &state);
  }
  EXPECT_GT(steps, 500);
  EXPECT_GT(read, 100);
}
