// What clients of both versions rely on: order of calls, refusals, copies, several instances, places of files.
#include "dynamics/fmu/archive.h"
#include "dynamics/fmu/dependencies.h"
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
  EXPECT_NEAR(time, 2.5, 1e-10);
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

TEST(UnitClient, AForceThatIsMissingIsToldWhenItIsWanted)
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

// A copy taken in the middle of a stored force goes on in an instance that has not read it yet.
TEST(UnitClient, CopiesKnowWhereTheStoredForceIs)
{
  SampleStand with = sample_stand("disturbance", 0.01, 2e6);
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

TEST(UnitClient, DerivativesAreThoseOfTheEquations)
{
  Client2 client(unit(), model(), guid(), "");
  ASSERT_EQ(client.start(976e3), fmi2OK);
  run_of(client, 37, 0);
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
  EXPECT_TRUE(near(force[0], 1 / stand().chain.M[2], within(1e-12, "1/M3")));
  EXPECT_TRUE(near(force[3], -1 / stand().chain.M[3], within(1e-12, "-1/M4")));
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

TEST(UnitClient, OutputDerivativesAreThoseInTime)
{
  Client2 client(unit(), model(), guid(), "");
  ASSERT_EQ(client.start(976e3), fmi2OK);
  const double h = 1e-6;
  run_of(client, 37, 0);
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

TEST(UnitClient, VersionThreeKeepsItsOwnRules)
{
  Client3 client(model());
  ASSERT_TRUE(client.c) << client.logged();
  EXPECT_STREQ(FMI3(client, GetVersion)(), "3.0");
  ASSERT_EQ(client.start(976e3, 1), fmi3OK) << client.logged();
  EXPECT_EQ(client.get("time"), 1);
  EXPECT_EQ(client.step(1, 0.5), fmi3OK);
  EXPECT_EQ(client.get("time"), 1.5);
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
  EXPECT_FALSE(FMI3(client, InstantiateCoSimulation)("one", model().data.guid.c_str(), nullptr, false, false,
                                                     false, false, nullptr, 0, nullptr, nullptr, nullptr));
  EXPECT_FALSE(FMI3(client, InstantiateCoSimulation)("one", model().data.guid.c_str(),
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

// A unit as it comes: without an input the recorded force is played, and the input drives from the moment at which
// a client sets it.  use_stored_force decides where it is set.
TEST(UnitClient, TheStoredForcePlaysUntilTheInputIsSet)
{
  SampleStand with = sample_stand("disturbance", 0.01, 2e6);
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
  EXPECT_EQ(moved(*chosen, 0.2, 0.3), [&] {
    const auto again = instance();
    again->choose("use_stored_force", true);
    begin(*again);
    return moved(*again, 0, 0.3);
  }()) << "steps do not matter";
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
TEST(UnitClient, VersionThreePlaysTheRecordUnlessTheForceIsAsked)
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
      near(slope, (force[1] - force[0]) / 1e-3 / stand().chain.M[2], within(1e-9, "rounding of differences")));
}

// What an unknown does not depend on by its description has no derivative, at rest and in motion.
TEST(UnitClient, WhatIsNotADependencyHasNoDerivative)
{
  const SampleStand coupled = sample_stand("published", 0.02, 3e6);
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
          const double found = derivative(u, k);
          if (std::find(listed.begin(), listed.end(), k) == listed.end()) {
            ++independent;
            EXPECT_LT(found, 1e-7) << variables[u].name << " by " << variables[k].name << at_start
                                   << ": rounding of differences of fourth order";
          } else
            dependent += found > 1e-7;
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

TEST(UnitClient, VersionThreeShowsStartValuesBeforeInitialization)
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

TEST(UnitClient, VersionThreeIsSilentWithLoggingOffAndDoublesTheSignOfReferences)
{
  Client3 quiet(model(), false, false);
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

TEST(UnitClient, DerivativesMayBeAskedAfterTermination)
{
  Client2 two(unit(), model(), guid(), "");
  Client3 three(model());
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
    EXPECT_TRUE(near(derivative, 1 / stand().chain.M[2], within(1e-12, "1/M3")));
  EXPECT_EQ(rate[0], rate[1]);
  EXPECT_NE(rate[0], 0);
}
