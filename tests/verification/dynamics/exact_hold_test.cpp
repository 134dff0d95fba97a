// The integration against an independent matrix exponential in long double, in both forms and on uneven samples.
#include "dynamics/response/response.h"
#include "tests/support/exact_hold.h"
#include "tests/support/near.h"
#include "tests/support/published_stand.h"
#include <cmath>
#include <random>
#include <vector>

using namespace mill;
using namespace mill::dynamics;

const char *const all_sets[] = {"P1", "P2", "P3", "P4", "Q1", "R1", "R2", "R3"};

namespace {
MillModel model_of(const char *set)
{
  const auto chosen = parameter_set(set);
  return mill_model(chosen.stand, chosen.dynamics);
}

double largest_difference(const Eigen::MatrixXd &a, const Eigen::MatrixXd &b)
{
  return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
}
}  // namespace

// Samples at random times, on straight lines of 1..9 ms.
namespace {
ForceRecord uneven_record(const double duration)
{
  std::mt19937_64 engine(11);
  const auto uniform = [&] { return std::ldexp(double(engine() >> 11), -53); };
  std::vector<double> time{0}, force{976e3};
  while (time.back() < duration) {
    time.push_back(std::min(duration, time.back() + 1e-3 + 8e-3 * uniform()));
    force.push_back(976e3 + 3e3 * (2 * uniform() - 1));
  }
  const auto n = Eigen::Index(time.size());
  return {Eigen::Map<Eigen::VectorXd>(time.data(), n), Eigen::Map<Eigen::VectorXd>(force.data(), n), {}};
}
}  // namespace

// The same polyline with `per_line` more samples on it, which do not change it.
namespace {
ForceRecord with_points_between(const ForceRecord &record, const Eigen::Index per_line)
{
  const Eigen::Index n = (record.time.size() - 1) * per_line + 1;
  ForceRecord denser{Eigen::VectorXd(n), Eigen::VectorXd(n), {}};
  for (Eigen::Index k = 0; k < n; ++k) {
    const Eigen::Index i = std::min(k / per_line, record.time.size() - 2);
    const double part    = double(k - i * per_line) / double(per_line);
    denser.time[k]       = record.time[i] + part * (record.time[i + 1] - record.time[i]);
    denser.force[k]      = record.force[i] + part * (record.force[i + 1] - record.force[i]);
  }
  return denser;
}
}  // namespace

TEST(ExactHold, BothFormsMeetAnIndependentMatrixExponential)
{
  ForceRecord force = twelve_tones();
  force.time.conservativeResize(4001);
  force.force.conservativeResize(4001);
  const double mean = force.force.mean();
  for (const char *set : all_sets) {
    const MillModel model = model_of(set);
    const Eigen::MatrixXd expected =
        exact_hold(model.M, model.K, model.C, model.b, force.force.array() - mean, 1e-4);
    for (const HoldForm form : {HoldForm::modal, HoldForm::matrix_exponential}) {
      const Response response = mill_response(model, force, 10e3, form);
      EXPECT_EQ(response.form, form) << set << " " << response.note;
      for (const Mass roll : {upper_work_roll, lower_work_roll})
        EXPECT_LT(largest_difference(response.acceleration.col(roll), expected.col(roll)), 1e-9)
            << set << ", roll " << roll << ", form " << int(form) << ": both are exact, of the peak";
    }
  }
}

TEST(ExactHold, ModalFormIsTheMatrixExponential)
{
  for (const char *set : all_sets) {
    const Response modal  = mill_response(model_of(set), twelve_tones(), 10e3, HoldForm::modal);
    const Response matrix = mill_response(model_of(set), twelve_tones(), 10e3, HoldForm::matrix_exponential);
    EXPECT_LT(largest_difference(modal.acceleration, matrix.acceleration), 1e-9) << set << ": both are exact";
    EXPECT_LT(largest_difference(modal.load_cell, matrix.load_cell), 1e-9) << set << ": both are exact";
  }
}

TEST(ExactHold, OutputRateDoesNotChangeTheMotion)
{
  const MillModel model = model_of("R1");
  const Response coarse = mill_response(model, twelve_tones(), 2e3);  // five samples inside one output step
  const Response fine   = mill_response(model, twelve_tones(), 30e3);
  const Response odd    = mill_response(model, twelve_tones(), 15e3);  // two outputs for three half samples
  for (Eigen::Index k = 0; k < coarse.time.size(); ++k) {
    ASSERT_TRUE(near(coarse.time[k], fine.time[15 * k], within(1e-12, "common times", 1)));
    ASSERT_TRUE(near(coarse.acceleration(k, upper_work_roll), fine.acceleration(15 * k, upper_work_roll),
                     within(1e-9, "exact at any step, of the peak", 6.4)));
  }
  for (Eigen::Index k = 0; k < odd.time.size(); ++k)
    ASSERT_TRUE(near(odd.acceleration(k, upper_work_roll), fine.acceleration(2 * k, upper_work_roll),
                     within(1e-9, "exact at any step, of the peak", 6.4)));
}

TEST(ExactHold, ARateWithoutCommonGridIsAsExact)
{
  // 10 kHz samples, 12.34 kHz outputs: a common grid would need 500 steps per output; every 617th output meets
  // every 500th sample
  const MillModel model = model_of("P3");
  const Response odd    = mill_response(model, twelve_tones(), 12.34e3);
  const Response even   = mill_response(model, twelve_tones(), 10e3);
  const double peak     = even.acceleration.col(upper_work_roll).cwiseAbs().maxCoeff();
  for (Eigen::Index k = 0; 500 * k < even.time.size(); ++k)
    ASSERT_TRUE(near(odd.acceleration(617 * k, upper_work_roll), even.acceleration(500 * k, upper_work_roll),
                     within(1e-9, "exact at any step, of the peak", peak)));
}

TEST(ExactHold, UnevenSamplesAreHonouredExactly)
{
  const ForceRecord few = uneven_record(2);
  for (const char *set : {"P3", "R1"}) {
    const MillModel model   = model_of(set);
    const Response response = mill_response(model, few, 20e3);
    for (const Eigen::Index per_line : {2, 7}) {
      const Response same = mill_response(model, with_points_between(few, per_line), 20e3);
      EXPECT_LT(
          largest_difference(same.acceleration.col(upper_work_roll), response.acceleration.col(upper_work_roll)),
          1e-10)
          << set << ": same polyline, " << per_line << " points per line";
    }
  }
}

TEST(ExactHold, ASampleATenthOfTheSpacingLateIsHonoured)
{
  // every other sample of a 1 ms record comes 0.1 ms late; on an even 0.1 ms grid the same polyline has no late
  // ones
  ForceRecord late = twelve_tones();
  late.time.conservativeResize(1001);
  late.force.conservativeResize(1001);
  late.time = Eigen::ArrayXd::LinSpaced(1001, 0, 1000) * 1e-3;
  for (Eigen::Index i = 1; i < 1000; i += 2)
    late.time[i] += 1e-4;
  ForceRecord even{Eigen::ArrayXd::LinSpaced(10001, 0, 10000) * 1e-4, Eigen::VectorXd(10001), {}};
  for (Eigen::Index i = 0; i < 1000; ++i) {
    const Eigen::Index first = 10 * i + i % 2, last = 10 * (i + 1) + (i + 1) % 2;
    for (Eigen::Index k = first; k <= last; ++k)
      even.force[k] =
          late.force[i] + (late.force[i + 1] - late.force[i]) * double(k - first) / double(last - first);
  }
  const MillModel model = model_of("R1");
  EXPECT_LT(largest_difference(mill_response(model, late, 20e3).acceleration,
                               mill_response(model, even, 20e3).acceleration),
            1e-10);
}

TEST(ExactHold, UnevenPathIsTheEvenPath)
{
  // One sample moved along its line by 2e-6 of the spacing is enough for the uneven path, which makes the
  // exponentials of every step again; up to the line before that sample the polyline is the same.
  const ForceRecord even = twelve_tones();
  ForceRecord moved      = even;
  const double share     = 2e-6;
  moved.time[10000] += share * 1e-4;
  moved.force[10000] += share * (even.force[10001] - even.force[10000]);
  const MillModel model = model_of("R1");
  const Response a = mill_response(model, even, 20e3), b = mill_response(model, moved, 20e3);
  EXPECT_LT(largest_difference(b.acceleration.topRows(19000), a.acceleration.topRows(19000)), 1e-10);
}

TEST(ExactHold, RepeatedPolesAreIntegratedAsExactly)
{
  // critical damping: every mode has a double pole with one shape, where the modal form has nothing to stand on
  ForceRecord force = twelve_tones();
  force.time.conservativeResize(2001);
  force.force.conservativeResize(2001);
  const MillModel model   = mill_model(published_stand(), settings(ForceMeaning::measured, 1));
  const Response response = mill_response(model, force, 10e3);
  const Eigen::MatrixXd expected =
      exact_hold(model.M, model.K, model.C, model.b, force.force.array() - force.force.mean(), 1e-4);
  EXPECT_EQ(response.form, HoldForm::matrix_exponential);
  for (const Mass roll : {upper_work_roll, lower_work_roll})
    EXPECT_LT(largest_difference(response.acceleration.col(roll), expected.col(roll)), 1e-9);
}

// Preparing a step costs ten times what making it does: every sample behind a gap may not have one of its own.
TEST(ExactHold, StepsOfOneLengthArePreparedOnce)
{
  std::vector<double> times;
  for (int k = 0; k < 50000; ++k)  // 100 us apart for 5 s, 0.3 s missing in every second
    if (k % 10000 < 7000)
      times.push_back(3.7 + 1e-4 * k);
  ForceRecord record;
  record.time      = Eigen::Map<const Eigen::VectorXd>(times.data(), Eigen::Index(times.size()));
  record.force     = (40 * record.time.array()).sin();
  const auto model = model_of("P1");
  for (const auto form : {HoldForm::modal, HoldForm::matrix_exponential})
    for (const double rate : {20e3, 7e3}) {
      const auto held = first_order_hold(state_space(model), record, rate, form);
      EXPECT_EQ(held.form, form);
      EXPECT_LT(held.n_prepared, 200) << "of " << held.time.size() << " steps and more";
    }
}
