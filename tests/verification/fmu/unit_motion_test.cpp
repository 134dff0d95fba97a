// What a unit computes, through its C interface, against the integrator of this program and closed forms.
#include "dynamics/fmu/runtime/motion.h"
#include "dynamics/response/response.h"
#include "tests/support/near.h"
#include "tests/support/unit_client.h"
#include <cmath>
#include <map>
#include <vector>

using namespace mill;

namespace {
const char *const accelerations[] = {"a_upper_frame",     "a_upper_backup_roll", "a_upper_work_roll",
                                     "a_lower_work_roll", "a_lower_backup_roll", "a_lower_frame"};

// Largest difference of accelerations and load cell from a response at the same times, relative to the largest of
// each.
template <class Client>
double difference_at(Client &client, const dynamics::Response &response, const Eigen::Index row)
{
  double most = 0;
  for (Eigen::Index j = 0; j < 6; ++j)
    most = std::max(most, std::abs(client.get(accelerations[j]) - response.acceleration(row, j)) /
                              response.acceleration.col(j).cwiseAbs().maxCoeff());
  return std::max(most, std::abs(client.get("F_cell") - response.load_cell[row]) /
                            response.load_cell.cwiseAbs().maxCoeff());
}

struct Setting {
  ForceMeaning meaning;
  double damping, gap_damper;
};
// Separate modes, undamped, coupled by a damper, as published, and one mode so near to critical that the matrix
// exponential is used.
const Setting all_settings[] = {{ForceMeaning::measured, 0.01, 0},
                                {ForceMeaning::measured, 0, 0},
                                {ForceMeaning::disturbance, 0.01, 2e6},
                                {ForceMeaning::published, 0.02, 5e6},
                                {ForceMeaning::disturbance, 0, 1e9}};
}  // namespace

// The recorded force played inside: the result does not depend on the communication step, from 1e-5 s to 1 s.
TEST(UnitMotion, StoredForceAgreesWithSimulateAtAnyStep)
{
  for (const Setting &set : all_settings) {
    SampleStand stand       = sample_stand(set.meaning, set.damping, set.gap_damper);
    const ForceRecord force = sample_force(1501, 1e-3);  // 1.5 s
    carry(stand.model, force);
    const auto response = dynamics::mill_response(stand.chain, force, 20e3);
    Client2 first(stand.model);
    ASSERT_TRUE(first.c) << first.logged();
    for (const double h : {1e-5, 5e-5, 1.3e-4, 1e-3, 0.0125, 0.25, 1.0}) {
      const double end = h < 1e-4 ? 0.05 : 1;
      Client2 client(first.unit, stand.model, stand.model.data.guid, "");
      const unsigned use = client.at("use_stored_force");
      const int yes      = 1;
      ASSERT_EQ(FMI2(client, SetBoolean)(client.c, &use, 1, &yes), fmi2OK) << client.logged();
      ASSERT_EQ(client.start(0), fmi2OK) << client.logged();
      double time = 0, worst = 0;
      for (int i = 1; double(i) * h <= end + 1e-12; ++i) {
        ASSERT_EQ(client.step(time, double(i) * h - time), fmi2OK) << client.logged();
        time                 = double(i) * h;
        const double outputs = time * 20e3;
        const auto row       = Eigen::Index(std::llround(outputs));
        if (std::abs(outputs - double(row)) < 1e-6 && (i % 20 == 0 || h > 1e-3))
          worst = std::max(worst, difference_at(client, response, row));
      }
      EXPECT_LT(worst, 1e-10) << word_of(set.meaning) << " C " << set.gap_damper << " h " << h;
    }
  }
}

// A held input: in steps of any length the same as the exact response to that staircase, built from one step of
// force.
TEST(UnitMotion, HeldInputAgreesWithAnExactStaircase)
{
  for (const Setting &set : all_settings) {
    const SampleStand stand = sample_stand(set.meaning, set.damping, set.gap_damper);
    Client2 coarse(stand.model);
    Client2 fine(coarse.unit, stand.model, stand.model.data.guid, "");
    ASSERT_EQ(coarse.start(970e3), fmi2OK) << coarse.logged();
    ASSERT_EQ(fine.start(970e3), fmi2OK);
    const ForceRecord held{Eigen::Vector3d(0, 1e-3, 1.001), Eigen::Vector3d(970e3, 980e3, 980e3), {}};
    const auto response = dynamics::mill_response(stand.chain, held, 1e3);
    for (Client2 *client : {&coarse, &fine}) {
      client->slope(1e7);
      ASSERT_EQ(client->step(0, 1e-3), fmi2OK) << client->logged();
      client->set("F_roll", 980e3);
    }
    double worst = 0, at = 1e-3, fine_at = 1e-3;
    for (int k = 0; k < 5; ++k) {
      const double end = 1e-3 + 0.2 * (k + 1);
      ASSERT_EQ(coarse.step(at, end - at), fmi2OK) << coarse.logged();
      at = at + (end - at);
      for (int i = 1; i <= 200; ++i) {
        const double to = 1e-3 + 0.2 * k + 1e-3 * i;
        ASSERT_EQ(fine.step(fine_at, to - fine_at), fmi2OK) << fine.logged();
        fine_at = fine_at + (to - fine_at);
      }
      // the mean of the record is not F_mean, which the load cell alone notices where springs share the force
      for (Eigen::Index j = 0; j < 6; ++j) {
        const double scale = response.acceleration.col(j).cwiseAbs().maxCoeff();
        const double exact = response.acceleration(200 * (k + 1) + 1, j);
        worst              = std::max({worst, std::abs(coarse.get(accelerations[j]) - exact) / scale,
                                       std::abs(fine.get(accelerations[j]) - exact) / scale});
      }
    }
    EXPECT_LT(worst, 1e-10) << word_of(set.meaning) << " C " << set.gap_damper;
  }
}

// A smooth force: held, the error is of first order in the step; as chords, of second order.
TEST(UnitMotion, InputDerivativesAreOfSecondOrder)
{
  const SampleStand stand = sample_stand();
  const auto force        = [](const double t) { return 976e3 + 5e3 * std::sin(2 * M_PI * 60 * t); };
  Client2 base(stand.model);
  Client3 third(stand.model, true);
  ASSERT_TRUE(third.c) << third.logged();
  const auto end_value = [&](const int n, const bool chords) {
    Client2 client(base.unit, stand.model, stand.model.data.guid, "");
    EXPECT_EQ(client.start(force(0)), fmi2OK);
    const double h = 0.1 / n;
    for (int i = 0; i < n; ++i) {
      client.set("F_roll", force(i * h));
      if (chords)
        client.slope((force((i + 1) * h) - force(i * h)) / h);
      EXPECT_EQ(client.step(i * h, h), fmi2OK) << client.logged();
    }
    return client.get("y_upper_work_roll");
  };
  const double exact = end_value(20000, true);
  for (const bool chords : {false, true}) {
    const double coarse = std::abs(end_value(200, chords) - exact),
                 fine   = std::abs(end_value(400, chords) - exact);
    const double order  = std::log2(coarse / fine);
    EXPECT_TRUE(near(order, chords ? 2 : 1, within(chords ? 0.05 : 0.1, "order measured at two steps")))
        << (chords ? "chords" : "held");
  }
  // FMI 3: the client says the force at the end of each step.
  ASSERT_EQ(third.start(force(0)), fmi3OK) << third.logged();
  for (int i = 0; i < 400; ++i) {
    third.force_at_end = force((i + 1) * 0.1 / 400);
    ASSERT_EQ(third.step(i * 0.1 / 400, 0.1 / 400), fmi3OK) << third.logged();
  }
  EXPECT_TRUE(near(third.get("y_upper_work_roll"), end_value(400, true), within(1e-11, "the same chords")));
}

// One mass on a spring: the answer to a step of force in closed form, in steps of odd lengths.
TEST(UnitMotion, OneMassAnswersAStepInClosedForm)
{
  fmu::ModelData data;
  data.kind           = fmu::StandKind::modal;
  data.points         = {"mass"};
  data.frequency      = {40};
  data.shape          = {0.01};
  data.bite_mode      = {0.01};
  data.load_cell_mode = {0};
  for (const double zeta : {0.0, 0.01, 0.3}) {
    data.modal_damping = zeta;
    const auto system  = fmu::modal_system(data, fmu::start_of(data));
    fmu::Motion motion(system);
    auto state     = motion.equilibrium(0);
    const double w = 2 * M_PI * 40, wd = w * std::sqrt(1 - zeta * zeta), force = 1e4;
    long double clock = 0;  // the sum of the lengths, not rounded
    double worst      = 0;
    for (int i = 0; i < 3000; ++i) {
      const double h = i % 7 == 0 ? 3.1e-3 : i % 3 == 0 ? 1e-5 : 1.7e-4;
      motion.advance(state, h, {force, 0});
      clock += h;
      const double time = double(clock);
      const double e    = std::exp(-zeta * w * time);
      const double q =
          0.01 * force / (w * w) * (1 - e * (std::cos(wd * time) + zeta * w / wd * std::sin(wd * time)));
      worst = std::max(worst, std::abs(state.q[0] - q) * w * w / (0.01 * force));
    }
    EXPECT_LT(worst, 2e-12) << "damping " << zeta;
  }
}

// A ramp over short steps, where the closed form would cancel: q = b f1 (t - sin(w t)/w)/w^2, relative to its own
// size.
TEST(UnitMotion, ShortStepsLoseNoDigits)
{
  fmu::ModelData data;
  data.kind           = fmu::StandKind::modal;
  data.points         = {"mass"};
  data.frequency      = {5};
  data.shape          = {1};
  data.bite_mode      = {1};
  data.load_cell_mode = {0};
  const double w      = 2 * M_PI * 5;
  for (const double h : {1e-7, 1e-5, 1e-3, 1e-2}) {
    fmu::Motion motion(fmu::modal_system(data, fmu::start_of(data)));
    auto state = motion.equilibrium(0);
    motion.advance(state, h, {0, 1});
    const double x = w * h, terms = 1 - x * x / 72 * (1 - x * x / 110 * (1 - x * x / 156 * (1 - x * x / 210)));
    const double series = x * x * x / 6 * (1 - x * x / 20 * (1 - x * x / 42 * terms));
    EXPECT_TRUE(near(state.q[0], series / (w * w * w), within(1e-14, "rounding"))) << h;
  }
}

// The three ways of a step against each other where more than one is right.
TEST(UnitMotion, ModesPolesAndExponentialAreOneSolution)
{
  const SampleStand stand = sample_stand(ForceMeaning::disturbance, 0.01, 2e6);
  fmu::Tuning tuning      = fmu::start_of(stand.model.data);
  std::map<double, fmu::Motion::Form> forms;
  for (const double damper : {0.0, 2e6, 1e9}) {
    tuning.gap_damper = damper;
    forms.insert({damper, fmu::Motion(fmu::modal_system(stand.model.data, tuning)).form()});
  }
  EXPECT_EQ(forms[0], fmu::Motion::Form::separate_modes);
  EXPECT_EQ(forms[2e6], fmu::Motion::Form::poles);
  tuning.gap_damper = 1e-9;  // coupled in name only: the poles must give what the separate modes give
  fmu::Motion coupled(fmu::modal_system(stand.model.data, tuning));
  tuning.gap_damper = 0;
  fmu::Motion separate(fmu::modal_system(stand.model.data, tuning));
  auto a = separate.equilibrium(1e4), b = a;
  coupled.begin(b);
  for (int i = 0; i < 500; ++i) {
    const double h = i % 2 ? 1e-4 : 2.7e-3, slope = std::sin(i) * 1e6;
    separate.advance(a, h, {1e3, slope});
    coupled.advance(b, h, {1e3, slope});
  }
  coupled.end(b);
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_TRUE(near(b.q[k], a.q[k], within(1e-10, "two eigenvalue problems", std::abs(a.q[0])))) << k;
}

// A detailed stand comes in its modes; here those of the chain, which must move as the chain does.
TEST(UnitMotion, GivenModesMoveAsTheirChain)
{
  const SampleStand stand        = sample_stand(ForceMeaning::published, 0.02, 5e6);
  const fmu::ExportedModel modal = in_modes(stand);
  Client2 chain(stand.model), modes(modal);
  ASSERT_EQ(chain.start(980e3), fmi2OK) << chain.logged();
  ASSERT_EQ(modes.start(980e3), fmi2OK) << modes.logged();
  for (int i = 0; i < 100; ++i) {
    const double force = 976e3 + 1e4 * std::sin(0.3 * i);
    chain.set("F_roll", force), modes.set("F_roll", force);
    ASSERT_EQ(chain.step(i * 1e-3, 1e-3), fmi2OK);
    ASSERT_EQ(modes.step(i * 1e-3, 1e-3), fmi2OK);
  }
  for (const char *name : {"a_upper_work_roll", "y_upper_backup_roll", "F_cell", "f3"})
    EXPECT_TRUE(near(modes.get(name), chain.get(name), within(1e-10, "two eigensolvers"))) << name;
}

// A spring changed between steps: masses go on where they are; the new run is that of the new stand from that
// state.
TEST(UnitMotion, AChangedSpringKeepsPlacesAndMovesFrequencies)
{
  const SampleStand stand = sample_stand();
  Client2 client(stand.model);
  ASSERT_EQ(client.start(980e3), fmi2OK);
  client.set("F_roll", 970e3);
  ASSERT_EQ(client.step(0, 0.0123), fmi2OK);
  std::vector<double> y;
  for (const char *name : {"y_upper_frame", "y_upper_backup_roll", "y_upper_work_roll", "y_lower_work_roll",
                           "y_lower_backup_roll", "y_lower_frame"})
    y.push_back(client.get(name));
  const double a_before = client.get("a_upper_work_roll"), f6 = client.get("f6");
  ASSERT_EQ(client.set("K3", 2e10), fmi2OK) << client.logged();
  EXPECT_EQ(client.get("a_upper_work_roll"), a_before) << "what is read belongs to the last step";
  EXPECT_LT(client.get("f6"), 0.99 * f6);
  ASSERT_EQ(client.step(0.0123, 1e-9), fmi2OK);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_TRUE(
        near(client.get("y_" + stand.model.data.points[i]), y[i], within(1e-9, "a step of 1 ns at 1 m/s", 1)))
        << i;
  // M3 a3 = F - K3 (y3 - y2) - ..., undamped part: the force of the changed spring is seen at once
  const double K3 = stand.chain.springs[2].stiffness, M3 = stand.chain.M[2];
  EXPECT_TRUE(near(client.get("a_upper_work_roll") - a_before, (2e10 - K3) * (y[1] - y[2]) / M3,
                   within(0.05, "modal damping follows the spring", std::abs(a_before))));
}
