// Working point, inputs and variables of the chatter unit.
#include "dynamics/chatter/chatter.h"
#include "dynamics/fmu/dependencies.h"
#include "dynamics/fmu/description.h"
#include "dynamics/fmu/runtime/variables.h"
#include "tests/support/chatter_unit.h"
#include "tests/support/near.h"
#include <algorithm>
#include <climits>
#include <cmath>
#include <ctime>
#include <set>

using namespace mill;

// Values that are feasible only together may come in any order, before the run and between steps: the working
// point is solved where it is needed.
TEST(ChatterPoint, ValuesThatFitOnlyTogetherMayComeInAnyOrder)
{
  const std::pair<const char *, double> one[] = {{"entry_thickness", 3e-3}, {"reduction", 0.3},
                                                 {"exit_tension", 60e6},    {"entry_tension", 30e6},
                                                 {"roll_speed", 6},         {"viscosity", 0.02}};
  std::vector<std::size_t> order{0, 1, 2, 3, 4, 5};
  Client2 first(unit_2());
  ASSERT_TRUE(first.c) << first.logged();
  double force = 0;
  int orders   = 0;
  do {
    Client2 client(first.unit, unit_2(), unit_2().data.guid, "");
    for (const std::size_t k : order)
      ASSERT_EQ(client.set(one[k].first, one[k].second), fmi2OK) << one[k].first << client.logged();
    ASSERT_EQ(begin(client), 0) << client.logged();
    if (orders == 0)
      force = client.get("F_steady");
    EXPECT_EQ(client.get("F_steady"), force);
    ++orders;
  } while (std::next_permutation(order.begin(), order.end()) && orders < 60);
  EXPECT_GT(force, 1e6);
  // The same between steps, through a point without a steady bite.
  Client2 client(first.unit, unit_2(), unit_2().data.guid, "");
  ASSERT_EQ(begin(client), 0);
  ASSERT_EQ(client.step(0, 1e-3), fmi2OK);
  ASSERT_EQ(client.set("exit_tension", 1.9e9), fmi2OK) << client.logged();
  ASSERT_EQ(client.set("exit_tension", 190e6), fmi2OK) << client.logged();
  EXPECT_EQ(client.step(1e-3, 1e-3), fmi2OK) << client.logged();
}

// Without a steady bite nothing is lost: the call that needs it says so, and other values go on.
TEST(ChatterPoint, APointWithoutASteadyBiteStopsWhereItIsNeeded)
{
  Client2 client(unit_2());
  ASSERT_EQ(client.set("exit_tension", 1.9e9), fmi2OK) << client.logged();
  EXPECT_EQ(FMI2(client, SetupExperiment)(client.c, 0, 0, 0, 0, 0), fmi2OK);
  EXPECT_EQ(FMI2(client, EnterInitializationMode)(client.c), fmi2OK);
  EXPECT_EQ(client.get("exit_tension"), 1.9e9) << "what is set can be read";
  EXPECT_TRUE(std::isnan(client.get("F_steady"))) << "Discard";
  EXPECT_EQ(client.logged(), "fmi2GetReal: a tension reaches the flow stress of the strip\n");
  EXPECT_EQ(FMI2(client, ExitInitializationMode)(client.c), fmi2Error);
  EXPECT_EQ(client.logged(), "fmi2ExitInitializationMode: a tension reaches the flow stress of the strip\n");
  ASSERT_EQ(client.set("exit_tension", 189e6), fmi2OK);
  ASSERT_EQ(FMI2(client, ExitInitializationMode)(client.c), fmi2OK) << client.logged();
  ASSERT_EQ(client.step(0, 1e-3), fmi2OK);
  const double gap = client.get("dh");
  ASSERT_EQ(client.set("exit_tension", 1.9e9), fmi2OK);
  EXPECT_EQ(client.get("dh"), gap) << "of the last step";
  EXPECT_EQ(client.step(1e-3, 1e-3), fmi2Error);
  EXPECT_EQ(client.logged(),
            "fmi2DoStep: a tension reaches the flow stress of the strip; the instance stays at 0.001 s\n");
  ASSERT_EQ(client.set("exit_tension", 189e6), fmi2OK);
  EXPECT_EQ(client.step(1e-3, 1e-3), fmi2OK) << client.logged();
  Client3 three(unit_2());
  ASSERT_EQ(FMI3(three, EnterInitializationMode)(three.c, false, 0, 0, false, 0), fmi3OK) << three.logged();
  ASSERT_EQ(FMI3(three, ExitInitializationMode)(three.c), fmi3OK) << three.logged();
  ASSERT_EQ(three.set("exit_tension", 1.9e9), fmi3OK);
  EXPECT_EQ(three.step(0, 1e-3), fmi3Discard) << "the state is that before the call";
  ASSERT_EQ(three.set("exit_tension", 189e6), fmi3OK);
  EXPECT_EQ(three.step(0, 1e-3), fmi3OK) << three.logged();
}

// Speed, tensions and thickness are inputs; three of them set one by one before every step cost one working point.
TEST(ChatterPoint, InputsOfTheDriveMoveTheWorkingPointAtEveryStep)
{
  const std::string description = fmu::model_description(unit_2(), 2);
  for (const char *name : {"roll_speed", "entry_tension", "exit_tension", "entry_thickness", "dh_entry"}) {
    const std::size_t position = description.find(std::string("<ScalarVariable name=\"") + name + "\"");
    ASSERT_NE(position, std::string::npos) << name;
    EXPECT_LT(description.find("causality=\"input\" variability=\"continuous\"", position),
              description.find("</", position))
        << name;
  }
  for (const char *name : {"reduction", "viscosity"})
    EXPECT_NE(description.find("causality=\"parameter\" variability=\"tunable\"",
                               description.find(std::string("<ScalarVariable name=\"") + name + "\"")),
              std::string::npos);
  Client2 client(unit_2());
  ASSERT_EQ(begin(client), 0) << client.logged();
  const int n         = 200;
  const auto speed_at = [](const int i) { return 18 + 0.01 * i; };
  const auto passed   = [&](const bool ramp) {
    const std::clock_t before = std::clock();
    FMI2(client, Reset)(client.c);
    begin(client);
    for (int i = 0; i < n; ++i) {
      if (ramp) {
        EXPECT_EQ(client.set("roll_speed", speed_at(i)), fmi2OK) << client.logged();
        EXPECT_EQ(client.set("entry_tension", 180e6 + 1e4 * i), fmi2OK) << client.logged();
        EXPECT_EQ(client.set("exit_tension", 189e6 + 1e4 * i), fmi2OK) << client.logged();
      }
      EXPECT_EQ(client.step(i * 1e-4, 1e-4), fmi2OK) << client.logged();
    }
    return double(std::clock() - before) / CLOCKS_PER_SEC / n;
  };
  const double held = passed(false), ramp = passed(true);
  std::printf("  a step %.1f us, with three inputs set before it %.1f us\n", 1e6 * held, 1e6 * ramp);
  EXPECT_LT(ramp - held, 0.6e-3) << "s, one working point; three would be 1.2 ms";
  bite::RollBite last      = tandem_bite();
  last.strip.entry_tension = 180e6 + 1e4 * (n - 1);
  last.strip.exit_tension  = 189e6 + 1e4 * (n - 1);
  const auto steady        = dynamics::working_point(last, speed_at(n - 1), Linearisation::sequential).state;
  EXPECT_TRUE(near(client.get("F_steady"), steady.force, within(1e-10, "two iterations")));
  const unsigned speed = client.at("roll_speed");
  const int order      = 1;
  const double rate    = 1;
  EXPECT_EQ(FMI2(client, SetRealInputDerivatives)(client.c, &speed, 1, &order, &rate), fmi2Warning);
  EXPECT_EQ(client.logged(),
            "fmi2SetRealInputDerivatives: roll_speed is held over each step; its derivative is not used\n");
}

TEST(ChatterPoint, EventsAreAnInteger)
{
  EXPECT_NE(fmu::model_description(unit_2(), 2).find("variability=\"discrete\" initial=\"calculated\"><Integer/>"),
            std::string::npos);
  EXPECT_NE(fmu::model_description(unit_2(), 3).find("<Int32 name=\"events\""), std::string::npos);
  Client2 two(unit_2());
  Client3 three(unit_2());
  two.set("start_displacement", 300e-6), two.set("roll_speed", 22);
  three.set("start_displacement", 300e-6), three.set("roll_speed", 22);
  ASSERT_EQ(begin(two), 0) << two.logged();
  ASSERT_EQ(FMI3(three, EnterInitializationMode)(three.c, false, 0, 0, false, 0), fmi3OK) << three.logged();
  ASSERT_EQ(FMI3(three, ExitInitializationMode)(three.c), fmi3OK) << three.logged();
  EXPECT_EQ(two.whole("events"), 0);
  ASSERT_EQ(two.step(0, 0.05) + three.step(0, 0.05), 0) << two.logged() << three.logged();
  EXPECT_GT(two.whole("events"), 0);
  EXPECT_EQ(three.whole("events"), two.whole("events"));
  EXPECT_TRUE(std::isnan(two.get("events")));
  EXPECT_EQ(two.logged(), "fmi2GetReal: events is of type Integer (Int32)\n");
  EXPECT_EQ(two.whole("dh"), INT_MIN);
  const unsigned events = two.at("events");
  const int none        = 0;
  EXPECT_EQ(FMI2(two, SetInteger)(two.c, &events, 1, &none), fmi2Error);
  EXPECT_EQ(two.logged(), "fmi2GetInteger: dh is of type Real (Float64)\n"
                          "fmi2SetInteger: events is computed and cannot be set\n");
}

// Dependencies of the description: a bite input moves the force at once, the motion does not follow at once.
TEST(ChatterPoint, DependenciesAreThoseOfTheBite)
{
  const auto variables = fmu::variables_of(unit_2().data);
  const fmu::Dependencies depends(unit_2().data);
  const auto names = [&](const std::vector<unsigned> &places) {
    std::set<std::string> all;
    for (const unsigned place : places)
      all.insert(variables[place].name);
    return all;
  };
  const auto of = [&](const std::string &name) { return variables[reference_of(unit_2(), name)]; };
  using Names   = std::set<std::string>;
  const Names point{"roll_speed", "reduction", "entry_thickness", "entry_tension", "exit_tension", "viscosity"};
  Names bite = point;
  bite.insert("dh_entry");
  Names pushed = bite;
  pushed.insert("F_disturbance");
  EXPECT_EQ(names(depends.at_communication(of("dh"))), Names());
  EXPECT_EQ(names(depends.at_communication(of("F"))), bite);
  EXPECT_EQ(names(depends.at_communication(of("a_upper_work_roll"))), pushed);
  EXPECT_EQ(names(depends.at_communication(of("sigma_entry"))), Names{"entry_tension"});
  EXPECT_EQ(names(depends.at_communication(of("y_upper_work_roll"))), Names());
  EXPECT_EQ(names(depends.at_start(of("F_steady"))), point);
  EXPECT_EQ(names(depends.at_start(of("dh"))), Names{"start_displacement"});
  EXPECT_EQ(names(depends.at_start(of("events"))), Names());
  EXPECT_EQ(names(depends.at_communication(of("a_upper_backup_roll"))), Names())
      << "the bite acts on the work rolls";
}
