// The chatter unit: its bite and its motion compared with those of the program, and what clients do with it.
#include "core/base/files.h"
#include "dynamics/chatter/chatter.h"
#include "dynamics/chatter/history.h"
#include "dynamics/chatter/run.h"
#include "dynamics/fmu/archive.h"
#include "dynamics/fmu/model_text.h"
#include "dynamics/fmu/runtime/chatter_motion.h"
#include "dynamics/fmu/unit_archive.h"
#include "dynamics/response/matrix_exponential.h"
#include "tests/support/chatter_unit.h"
#include "tests/support/near.h"
#include "tests/support/program.h"
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <random>

using namespace mill;
using mill::Linearisation;

namespace {
// Strips, laws and speeds of a bite.
std::vector<bite::RollBite> bites()
{
  const bite::RollBite film = tandem_bite();
  std::vector<bite::RollBite> all{film};
  for (const FlowStressLaw law : flow_stress_laws()) {
    bite::RollBite one             = film;
    one.strip.friction.law         = FrictionLaw::coulomb;
    one.strip.friction.coefficient = 0.05;
    one.strip.flow_stress          = {};
    one.strip.flow_stress.law      = law;
    one.strip.flow_stress.k        = 600e6;
    one.strip.flow_stress.n        = law == FlowStressLaw::voce ? 3 : 0.25;
    one.strip.flow_stress.eps0     = 0.01;
    one.strip.flow_stress.k0       = 300e6;
    one.strip.flow_stress.table    = {{0, 400e6}, {0.5, 600e6}, {1.5, 750e6}, {1.6, 760e6}, {3, 800e6}};
    all.push_back(one);
  }
  bite::RollBite by_speed               = all[1];
  by_speed.strip.initial_thickness      = not_given;
  by_speed.strip.entry_tension          = 30e6;
  by_speed.strip.flow_stress.law        = FlowStressLaw::swift;
  by_speed.strip.friction.law           = FrictionLaw::speed;
  by_speed.strip.friction.at_unit_speed = 0.08;
  by_speed.strip.friction.per_log_speed = -0.008;
  all.push_back(by_speed);
  return all;
}

struct Vibrating {
  dynamics::ChatterStandModel stand;
  dynamics::WorkingPoint point;
  dynamics::ChatterRunOptions options;
  fmu::ChatterData data;
};

Vibrating vibrating(const double speed, const Linearisation scheme = Linearisation::sequential)
{
  const auto &spec = std::get<ChatterCase>(tandem().spec);
  Vibrating v;
  v.stand.structure = dynamics::six_mass_structure(spec.stand.masses, spec.stand.stiffnesses, spec.stand.dampings);
  v.stand.entry_distance = v.stand.exit_distance = 4.95;
  v.point                                        = dynamics::working_point(bites()[0], speed, scheme);
  v.options.contacts                             = dynamics::roll_contacts(v.stand.structure, v.point.state.force);
  v.data                                         = chatter_data(v.stand, v.point, scheme, v.options, 1e-7);
  return v;
}
}  // namespace

TEST(ChatterUnit, IsHeldAgainstTheProgramWithEveryLawThatSlides)
{
  const auto all = bites();
  for (const FrictionLaw law : friction_laws())
    if (row_of(law).slides)
      EXPECT_TRUE(std::any_of(all.begin(), all.end(), [&](const auto &b) { return b.strip.friction.law == law; }))
          << name_of(law) << " is in none of bites()";
}

TEST(ChatterUnit, ItsBiteIsThatOfTheProgram)
{
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> any(-1, 1);
  for (const bite::RollBite &b : bites())
    for (const Linearisation scheme :
         {Linearisation::sequential, Linearisation::implicit, Linearisation::frozen_friction}) {
      SCOPED_TRACE(name_of(b.strip.flow_stress.law) + " " + name_of(b.strip.friction.law) +
                   std::to_string(int(scheme)));
      const auto point = dynamics::working_point(b, b.roll_speed, scheme);
      Vibrating v      = vibrating(18.2, scheme);
      v.point          = point;
      const auto own   = chatter_data(v.stand, point, scheme, v.options, 0);
      const fmu::RollBite theirs(own.pass);
      const auto u = bite::unsteady_bite(point.bite, point.state, scheme);
      EXPECT_TRUE(near(theirs.flattened_radius(), point.state.flattened_radius, within(1e-12, "two iterations")));
      EXPECT_TRUE(near(theirs.steady().force, point.state.force, within(1e-11, "two iterations")));
      const auto steady = bite::steady_moment(u);
      int touching      = 0;
      for (int i = 0; i < 60; ++i) {
        bite::Moment m = steady;
        m[0] += 0.1e-3 * any(engine);
        m[1] += 0.05 * any(engine);
        m[2] *= 1 + 0.6 * any(engine);
        m[3] *= 1 + 0.6 * any(engine);
        m[4] += 0.05e-3 * any(engine);
        const auto wanted = bite::bite_at(u, m);
        const auto found  = theirs.at(m);
        ASSERT_EQ(found.contact, wanted.contact);
        EXPECT_TRUE(near(theirs.contact_reserve(m), bite::contact_reserve(u, m),
                         within(1e-12, "rounding of a difference of thicknesses of 1 mm", 1e-3)));
        if (!wanted.contact)
          continue;
        ++touching;
        EXPECT_TRUE(near(found.force, wanted.force, within(1e-10, "sums in another order", point.state.force)));
        EXPECT_TRUE(near(found.entry_speed, wanted.entry_speed, within(1e-10, "rounding")));
        EXPECT_TRUE(near(found.exit_speed, wanted.exit_speed, within(1e-10, "rounding")));
        EXPECT_TRUE(near(found.friction, wanted.friction, within(1e-10, "rounding")));
        EXPECT_TRUE(near(found.from_exit, wanted.from_exit, within(1e-9, "rounding of an angle of 1 rad", 1)));
        EXPECT_TRUE(near(found.from_entry, wanted.from_entry, within(1e-9, "rounding of an angle of 1 rad", 1)));
        const auto whole = theirs.yield_reserve(m), limit = bite::yield_reserve(u, m);
        EXPECT_TRUE(near(whole[0], limit[0], within(1e-11, "rounding of a difference from 1", 1)));
        EXPECT_TRUE(near(whole[1], limit[1], within(1e-11, "rounding of a difference from 1", 1)));
      }
      EXPECT_GT(touching, 20);
    }
}

// Growing vibration up to slack strip and skidding: CVODE in the program, Runge and Kutta in the unit.
TEST(ChatterUnit, ItsMotionIsThatOfTheProgramThroughTheEdges)
{
  const double speed = 22;
  const Vibrating v  = vibrating(speed);
  auto options       = v.options;
  options.duration   = 0.06;
  options.rate       = 2000;
  const auto run     = dynamics::nonlinear_run(v.stand, v.point, Linearisation::sequential,
                                               dynamics::displaced_rolls(v.stand.structure, 300e-6), options);
  ASSERT_EQ(run.stopped, "");
  EXPECT_GT(run.events.size(), 4u);
  const fmu::ChatterMotion motion(v.data, v.data.pass);
  fmu::ChatterState state = motion.displaced(300e-6);
  const double largest    = run.history.gap.cwiseAbs().maxCoeff();
  double worst            = 0;
  for (Eigen::Index k = 0; k < run.history.time.size(); ++k) {
    if (k > 0) {
      double length = 1 / options.rate;
      ASSERT_EQ(motion.advance(state, length, {}), "");
    }
    worst = std::max(worst, std::abs(motion.read(state, {}).gap - run.history.gap[k]) / largest);
  }
  EXPECT_LT(worst, 1e-5) << "two integrators at a tolerance of 1e-8";
  std::printf("  differs by %.2g of the largest gap change, %d events, %zu in the program\n", worst,
              int(state.events), run.events.size());
  EXPECT_GE(state.events, double(run.events.size()) / 2) << "edges crossed together count once";
  EXPECT_LE(state.events, double(run.events.size()));
}

// Small motion under a force that grows: the linear equations with the force as one more state.
TEST(ChatterUnit, SmallMotionUnderAForceIsLinear)
{
  const Vibrating v       = vibrating(18);
  const Eigen::MatrixXd A = dynamics::chatter_matrix(v.stand, v.point.by);
  const Eigen::Index s = A.rows(), n = v.stand.structure.n();
  Eigen::MatrixXd G      = Eigen::MatrixXd::Zero(s + 2, s + 2);
  G.topLeftCorner(s, s)  = A;
  G.col(s).segment(n, n) = v.stand.structure.M.inverse() * v.stand.structure.b;
  G(s, s + 1)            = 1;
  const double force = 20, slope = 5e3, h = 1e-3;
  const Eigen::VectorXd unit = Eigen::Map<const Eigen::VectorXd>(v.data.magnitude.data(), s);
  Eigen::VectorXd scale(s + 2);
  scale << unit, 1e12, 1e15;
  const Eigen::MatrixXd E =
      dynamics::matrix_exponential(h * scale.cwiseInverse().asDiagonal() * G * scale.asDiagonal());
  Eigen::VectorXd z = Eigen::VectorXd::Zero(s + 2);
  const fmu::ChatterMotion motion(v.data, v.data.pass);
  fmu::ChatterState state = motion.displaced(0);
  double worst = 0, largest = 0;
  for (int k = 0; k < 20; ++k) {
    z[s]          = force / scale[s];
    z[s + 1]      = slope / scale[s + 1];
    z             = E * z;
    double length = h;
    fmu::ChatterInput input;
    input.force = force, input.slope = slope;
    ASSERT_EQ(motion.advance(state, length, input), "");
    const double gap = v.stand.structure.b.dot(z.head(n).cwiseProduct(unit.head(n)));
    largest          = std::max(largest, std::abs(gap));
    worst            = std::max(worst, std::abs(motion.read(state, {}).gap - gap));
  }
  EXPECT_LT(worst, 1e-4 * largest) << "what bends at an amplitude of " << largest << " m";
  EXPECT_GT(largest, 1e-10);
}

TEST(ChatterUnit, TheUnitPassesTheCheckInBothVersions)
{
  for (const int version : {2, 3}) {
    const std::string archive = fmu::unit_archive(unit_2(), version);
    EXPECT_EQ(archive, fmu::unit_archive(unit_of("2"), version)) << "the same bytes";
    EXPECT_NO_THROW(fmu::check_unit(archive, unit_2(), version));
  }
  fmu::ExportedModel wrong = unit_2();
  wrong.check.values.col(1) *= 1.01;
  EXPECT_THROW(fmu::check_unit(fmu::unit_archive(wrong, 2), wrong, 2), std::logic_error);
}

TEST(ChatterUnit, TheWorkingPointFollowsItsParameters)
{
  Client2 client(unit_2());
  ASSERT_TRUE(client.c) << client.logged();
  ASSERT_EQ(begin(client), 0) << client.logged();
  const auto steady = [](const double speed) {
    return dynamics::working_point(bites()[0], speed, Linearisation::sequential).state;
  };
  EXPECT_TRUE(near(client.get("F_steady"), steady(18.2).force, within(1e-10, "the case")));
  EXPECT_EQ(client.step(0, 1e-2), fmi2OK) << client.logged();
  const double gap = client.get("dh");
  EXPECT_EQ(client.set("roll_speed", 12), fmi2OK) << client.logged();
  EXPECT_TRUE(near(client.get("F_steady"), steady(12).force, within(1e-10, "solved again")));
  EXPECT_TRUE(near(client.get("mu_steady"), steady(12).friction, within(1e-10, "solved again")));
  EXPECT_EQ(client.get("dh"), gap) << "what is read before the next step belongs to the last one";
  EXPECT_EQ(client.step(1e-2, 1e-2), fmi2OK) << client.logged();
  EXPECT_EQ(client.set("viscosity", NAN), fmi2Discard);
  EXPECT_EQ(client.logged(),
            "fmi2SetReal: viscosity = nan Pa.s is out of range (1e-09 .. 100 Pa.s); it stays 0.005 Pa.s\n");
  EXPECT_EQ(client.set("start_displacement", 0), fmi2Error);
  EXPECT_EQ(client.logged(),
            "fmi2SetReal: start_displacement is fixed: it can only be set before the first step\n");
  double value[2];
  const unsigned outputs[] = {client.at("dh"), client.at("a_upper_work_roll")};
  const int orders[]       = {1, 1};
  EXPECT_EQ(FMI2(client, GetRealOutputDerivatives)(client.c, outputs, 2, orders, value), fmi2Error);
  EXPECT_EQ(client.logged(), "fmi2GetRealOutputDerivatives: outputs of this model have no derivatives\n");
  EXPECT_EQ(client.step(2e-2, 1e-3), fmi2OK) << "and the run goes on";
}

TEST(ChatterUnit, CopiesStepsAndResetGiveTheSameRun)
{
  const auto run = [](Client2 &client, const double from, const double h, const int n) {
    for (int i = 0; i < n; ++i)
      EXPECT_EQ(client.step(from + i * h, h), fmi2OK) << client.logged();
    return client.get("dh");
  };
  Client2 fine(unit_2()), coarse(fine.unit, unit_2(), unit_2().data.guid, "");
  for (Client2 *client : {&fine, &coarse}) {
    client->set("start_displacement", 300e-6);
    client->set("roll_speed", 22);
    ASSERT_EQ(begin(*client), 0) << client->logged();
  }
  const double whole = run(coarse, 0, 0.05, 1), small = run(fine, 0, 1e-4, 500);
  EXPECT_GT(coarse.whole("events"), 0) << "through edges";
  EXPECT_TRUE(near(small, whole, within(1e-5, "the tolerance of 1e-8 per step over some thousand steps", 300e-6)));
  fmi2FMUstate state = nullptr;
  ASSERT_EQ(FMI2(fine, GetFMUstate)(fine.c, &state), fmi2OK);
  std::size_t size = 0;
  ASSERT_EQ(FMI2(fine, SerializedFMUstateSize)(fine.c, state, &size), fmi2OK);
  std::vector<char> bytes(size);
  ASSERT_EQ(FMI2(fine, SerializeFMUstate)(fine.c, state, bytes.data(), size), fmi2OK);
  const double on = run(fine, 0.05, 1e-3, 20);
  ASSERT_EQ(FMI2(fine, SetFMUstate)(fine.c, state), fmi2OK);
  EXPECT_EQ(run(fine, 0.05, 1e-3, 20), on) << "to the last digit";
  Client2 fresh(fine.unit, unit_2(), unit_2().data.guid, "");
  fmi2FMUstate second = nullptr;
  ASSERT_EQ(FMI2(fresh, DeSerializeFMUstate)(fresh.c, bytes.data(), size, &second), fmi2OK) << fresh.logged();
  ASSERT_EQ(FMI2(fresh, SetFMUstate)(fresh.c, second), fmi2OK);
  EXPECT_EQ(run(fresh, 0.05, 1e-3, 20), on) << "in another instance";
  FMI2(fresh, FreeFMUstate)(fresh.c, &second);
  FMI2(fine, FreeFMUstate)(fine.c, &state);
  ASSERT_EQ(FMI2(fine, Reset)(fine.c), fmi2OK);
  ASSERT_EQ(begin(fine), 0);
  EXPECT_TRUE(near(fine.get("dh"), 2e-7,
                   within(5e-6, "both rolls start displaced by 0.1 um; rounding of the gap of 1 mm")));
}

TEST(ChatterUnit, AMotionThatCannotGoOnEndsTheRunWithAReason)
{
  Client2 client(unit_2());
  client.set("start_displacement", -250e-6);
  client.set("entry_tension", 150e6);
  ASSERT_EQ(begin(client), 0) << client.logged();
  client.set("dh_entry", 1e-2);  // strip that no roll of this mill can take
  EXPECT_EQ(client.step(0, 0.01), fmi2Error);
  const std::string logged = client.logged();
  EXPECT_EQ(logged.find("fmi2DoStep: at "), 0u) << logged;
  EXPECT_EQ(client.step(0.01, 1e-3), fmi2Error);
  EXPECT_EQ(client.logged(), "fmi2DoStep is not allowed after a failure\n");
  ASSERT_EQ(FMI2(client, Reset)(client.c), fmi2OK);
  ASSERT_EQ(begin(client), 0);
  EXPECT_EQ(client.step(0, 1e-3), fmi2OK) << client.logged();
  Client2 closed(client.unit, unit_2(), unit_2().data.guid, "");
  closed.set("start_displacement", -0.284e-3);
  ASSERT_EQ(begin(closed), 0);
  EXPECT_EQ(closed.step(0, 1e-3), fmi2Error);
  EXPECT_EQ(closed.logged(), "fmi2DoStep: at 0 s the gap closes: the rolls would meet\n");
}

// A force that tears the work rolls open until the strip is pulled apart, inside a step.
TEST(ChatterUnit, AStripThatTearsInsideAStepDiscardsItsRest)
{
  Client2 client(unit_2());
  ASSERT_EQ(begin(client), 0) << client.logged();
  client.set("F_disturbance", 1e8);
  ASSERT_EQ(client.step(0, 0.1), fmi2Discard) << client.logged();
  EXPECT_NE(client.logged().find(" s the exit tension reaches the flow stress of the strip: it tears\n"),
            std::string::npos);
  double time = 0;
  int ended   = 0;
  ASSERT_EQ(FMI2(client, GetRealStatus)(client.c, fmi2LastSuccessfulTime, &time), fmi2OK);
  ASSERT_EQ(FMI2(client, GetBooleanStatus)(client.c, fmi2Terminated, &ended), fmi2OK);
  EXPECT_TRUE(time > 0 && time < 0.1) << time;
  EXPECT_EQ(ended, 1);
  const double gap = client.get("dh");
  EXPECT_GT(gap, 1e-3) << "at that moment";
  EXPECT_EQ(client.step(time, 1e-3), fmi2Error) << "there is no way on";
  EXPECT_EQ(client.logged().find("fmi2DoStep: the run has ended at "), 0u);
  const double part = 0.5 * time;
  Client3 three(unit_2());
  ASSERT_EQ(FMI3(three, EnterInitializationMode)(three.c, false, 0, 0, false, 0), fmi3OK) << three.logged();
  ASSERT_EQ(FMI3(three, ExitInitializationMode)(three.c), fmi3OK) << three.logged();
  three.set("F_disturbance", 1e8);
  ASSERT_EQ(three.step(0, part), fmi3OK) << three.logged();
  EXPECT_FALSE(three.terminated);
  const double half_way = three.get("dh");
  Client2 again(client.unit, unit_2(), unit_2().data.guid, "");
  ASSERT_EQ(begin(again), 0) << again.logged();
  again.set("F_disturbance", 1e8);
  ASSERT_EQ(again.step(0, part), fmi2OK);
  ASSERT_EQ(FMI2(again, GetBooleanStatus)(again.c, fmi2Terminated, &ended), fmi2OK);
  EXPECT_EQ(ended, 0);
  EXPECT_EQ(again.get("dh"), half_way);
  // Version 3 asks the client to end the run, which keeps the rows before; the instance is at that moment.
  ASSERT_EQ(three.step(part, 0.1), fmi3OK) << three.logged();
  EXPECT_TRUE(three.terminated);
  const double inner = unit_2().data.chatter.longest_step;
  EXPECT_TRUE(near(three.last_time, time, within(inner / time, "the tear is seen at the end of an inner step")));
  EXPECT_EQ(three.get("time"), three.last_time);
  EXPECT_TRUE(near(three.get("dh"), gap, within(3 * inner / time, "a gap that grows with the cube of the time")));
  EXPECT_NE(three.logged().find(" s the exit tension reaches the flow stress of the strip: it tears\n"),
            std::string::npos);
  EXPECT_EQ(three.step(three.last_time, 1e-3), fmi3Error) << "there is no way on";
  EXPECT_EQ(FMI3(three, Terminate)(three.c), fmi3OK);
  EXPECT_TRUE(near(three.get("dh"), gap, within(3 * inner / time, "a gap that grows with the cube of the time")))
      << "and can be read";
}

TEST(ChatterUnit, ASecondOfVibrationCosts)
{
  Client2 client(unit_2());
  client.set("roll_speed", 19);
  client.set("start_displacement", 20e-6);
  ASSERT_EQ(begin(client), 0);
  const std::clock_t before = std::clock();
  for (int i = 0; i < 1000; ++i)
    ASSERT_EQ(client.step(i * 1e-3, 1e-3), fmi2OK) << client.logged();
  const double seconds = double(std::clock() - before) / CLOCKS_PER_SEC;
  std::printf("  1 s of motion with %d events: %.3f s\n", client.whole("events"), seconds);
  EXPECT_LT(seconds, 3);
}

// docs/examples/chatter_step.c as a reader would use it.
TEST(ChatterUnit, TheProgramWritesItAndTheExampleInCRuns)
{
  const std::string folder = scratch("chatter-unit");
  const auto made          = millstand("export fmu cases/chatter-tandem.toml --pass 2 -o " + folder + "/c.fmu");
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(
      made.out.find(folder + "/c.fmu: stand, bite and strip, six masses as given, FMI 2.0 co-simulation, Linux"),
      0u)
      << made.out;
  for (const auto &file : fmu::entries_of(read_text(folder + "/c.fmu"))) {
    const std::filesystem::path path = std::filesystem::path(folder) / "unit" / file.name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << file.bytes;
  }
  const std::string build = "cd '" + folder +
                            "' && cc -o chatter_step '" MILLSTAND_SOURCE_DIR
                            "/docs/examples/chatter_step.c' -ldl -lm && ./chatter_step unit >example.txt";
  ASSERT_EQ(std::system(build.c_str()), 0);
  const std::string text = read_text(folder + "/example.txt");
  const Vibrating v      = vibrating(22);
  double growth          = 0;
  ASSERT_NE(text.find("22 m/s"), std::string::npos) << text;
  ASSERT_EQ(
      std::sscanf(text.c_str() + text.find("22 m/s"), "22 m/s: swings of %*f m, then %*f m: growth %lf", &growth),
      1);
  EXPECT_TRUE(near(growth, dynamics::growth_rate(dynamics::chatter_matrix(v.stand, v.point.by)),
                   within(0.05, "largest swings of 0.15 s, one digit behind the point")));
  const auto wrong = millstand("export fmu cases/chatter-tandem.toml --pass 9 -o " + folder + "/d.fmu");
  EXPECT_EQ(wrong.err,
            "error: --pass \"9\": the case has no condition of this name; it has \"1\", \"2\", \"3\"\n");
}
