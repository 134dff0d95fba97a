// The live stepper against the batch integrator and an exported unit; a change on the run against its definition.
#include "dynamics/fmu/runtime/motion.h"
#include "dynamics/response/response.h"
#include "dynamics/response/state_space.h"
#include "tests/support/live_samples.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include "twin/live/engine/engine.h"
#include <algorithm>
#include <cmath>

using namespace mill;

namespace {
live::TwinModel model_of(const std::string &set)
{
  const ParameterSet parameters = parameter_set(set);
  return {"test", "as published", parameters.stand, parameters.dynamics, "hash"};
}

// The chain as an exported unit holds it.
fmu::ModalSystem unit_system(const dynamics::MillModel &chain, const double damping)
{
  fmu::ModelData data;
  data.kind             = fmu::StandKind::chain;
  data.modal_damping    = damping;
  data.load_cell_spring = 6;
  data.mass.assign(chain.M.begin(), chain.M.end());
  data.bite_row.assign(chain.b.begin(), chain.b.end());
  for (const dynamics::Spring &spring : chain.springs)
    data.springs.push_back({spring.name, spring.from, spring.to, spring.stiffness});
  return fmu::modal_system(data, fmu::start_of(data));
}

double largest_difference(const Eigen::MatrixXd &a, const Eigen::MatrixXd &b)
{
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}
}  // namespace

// TW-26
TEST(LiveMotion, EqualsSimulateAtAnyLengthOfBlocks)
{
  const auto model         = model_of("R1");
  const ForceRecord record = twelve_tones();
  const double rate        = 1 / (record.time[1] - record.time[0]);
  const auto simulated     = dynamics::mill_response(live::tuned(model, {}), record, rate);
  for (const Eigen::Index length : {1, 2, 7, 100, 1000, 4097, 8192}) {
    LiveSamples run(model, rate);
    run.send(record.force, length);
    ASSERT_EQ(run.simulated().rows(), record.force.size());
    EXPECT_LT(largest_difference(run.simulated(), simulated.acceleration), 1e-12) << "blocks of " << length;
  }
}

// TW-26: the motion of an exported unit shares no line with the integrator.
TEST(LiveMotion, EqualsTheExportedUnit)
{
  const auto model         = model_of("R1");
  const ForceRecord record = twelve_tones();
  const double step = record.time[1] - record.time[0], mean = record.force.mean();
  const auto chain  = live::tuned(model, {});
  const auto system = unit_system(chain, model.dynamics.modal_damping);
  fmu::Motion motion(system);
  fmu::ModalState state = motion.equilibrium(record.force[0] - mean);
  Eigen::MatrixXd unit(record.force.size(), 6);
  std::vector<double> q(6);
  for (Eigen::Index k = 0; k < record.force.size(); ++k) {
    if (k > 0)
      motion.advance(state, step, {record.force[k - 1] - mean, (record.force[k] - record.force[k - 1]) / step});
    motion.acceleration(state, record.force[k] - mean, q);
    for (Eigen::Index i = 0; i < 6; ++i) {
      unit(k, i) = 0;
      for (std::size_t m = 0; m < 6; ++m)
        unit(k, i) += system.point(std::size_t(i), m) * q[m];
    }
  }
  LiveSamples run(model, 1 / step);
  run.send(record.force, 512);
  EXPECT_LT(largest_difference(run.simulated(), unit), 1e-12);
}

// TW-27: y and y' go on, y'' jumps by what the new springs and dampers do to them.
TEST(LiveMotion, AChangeOnTheRunCarriesDisplacementAndVelocityOver)
{
  const auto model         = model_of("R1");
  const auto before        = live::tuned(model, {});
  const ForceRecord record = twelve_tones();
  const double rate        = 1 / (record.time[1] - record.time[0]);
  for (const std::string key : {"K3", "K1", "damping"}) {
    live::Tuning tuning;
    live::set_factor(tuning, key, 1.1);
    const auto after = live::tuned(model, tuning);
    live::TwinStepper stepper(live::stepped_stand(before), rate, record.force[0]);
    for (Eigen::Index k = 1; k < 5000; ++k)
      stepper.advance(record.force[k]);
    stepper.refer_to(record.force.mean());
    const Eigen::VectorXd y = stepper.displacement(), v = stepper.velocity();
    Eigen::VectorXd a(6), b(6);
    stepper.acceleration(a);
    stepper.change(live::stepped_stand(after));
    stepper.acceleration(b);
    EXPECT_LT(largest_difference(stepper.displacement(), y), 1e-12) << key;
    EXPECT_LT(largest_difference(stepper.velocity(), v), 1e-12) << key;
    const Eigen::VectorXd jump = -((after.K - before.K) * y + (after.C - before.C) * v).cwiseQuotient(before.M);
    EXPECT_LT((b - a - jump).cwiseAbs().maxCoeff() / a.cwiseAbs().maxCoeff(), 1e-12) << key;
    EXPECT_GT(jump.cwiseAbs().maxCoeff() / a.cwiseAbs().maxCoeff(), 1e-4) << key << ": nothing was tested";
  }
}

// Counting displacements from another force moves the origin and nothing else.
TEST(LiveMotion, AnotherReferenceLeavesAccelerationsAsTheyAre)
{
  const auto chain         = live::tuned(model_of("R1"), {});
  const ForceRecord record = twelve_tones();
  const double rate        = 1 / (record.time[1] - record.time[0]);
  const auto stand         = live::stepped_stand(chain);
  live::TwinStepper one(stand, rate, record.force[0]), other(stand, rate, record.force[0]);
  Eigen::VectorXd a(6), b(6);
  double peak = 0, worst = 0;
  for (Eigen::Index k = 1; k < 4000; ++k) {
    if (k == 1000)
      other.refer_to(1.1 * record.force[0]);
    one.advance(record.force[k]);
    other.advance(record.force[k]);
    one.acceleration(a);
    other.acceleration(b);
    peak  = std::max(peak, a.cwiseAbs().maxCoeff());
    worst = std::max(worst, (a - b).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(worst / peak, 1e-12);
  const Eigen::VectorXd shift = dynamics::static_displacement(chain) * (1.1 * record.force[0] - record.force[0]);
  EXPECT_TRUE(near(one.displacement()[2] - other.displacement()[2], shift[2],
                   within(1e-6, "static shift, difference of two motions of the same size")));
}

// A program that is stopped and started again goes on as if it had not been.
TEST(LiveMotion, GoesOnFromItsState)
{
  const auto model         = model_of("R1");
  const ForceRecord record = twelve_tones();
  const double rate        = 1 / (record.time[1] - record.time[0]);
  LiveSamples whole(model, rate);
  whole.send(record.force, 333);
  LiveSamples first(model, rate);
  first.send(record.force.head(20000), 333);
  const auto state = first.engine().state();
  LiveSamples second(model, rate, &state);
  EXPECT_EQ(second.engine().resumed_at(), 20000);
  second.send(record.force.tail(record.force.size() - 20000), 500, 20000);
  EXPECT_LT(largest_difference(second.simulated(), whole.simulated().bottomRows(record.force.size() - 20000)),
            1e-12);
  EXPECT_FALSE(second.any_gap());
  EXPECT_EQ(second.engine().book()->channels()[0].processed, record.force.size());
}
