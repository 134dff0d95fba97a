// Time of a unit through its C interface, in processor time, so that a busy machine gives the same.
#include "tests/support/unit_client.h"
#include <cmath>
#include <ctime>

using namespace mill;

namespace {
template <class Work> double seconds_of(const Work &work)
{
  const std::clock_t begin = std::clock();
  work();
  return double(std::clock() - begin) / CLOCKS_PER_SEC;
}
}  // namespace

// 10 s of force at 20 kHz within 0.6 s: set, slope, step and get in every step; loading within 20 ms.
TEST(UnitSpeed, TenSecondsAtTwentyKilohertz)
{
  for (const double damper : {0.0, 2e6}) {
    const SampleStand stand = sample_stand(ForceMeaning::disturbance, 0.01, damper);
    Client2 first(stand.model);
    ASSERT_TRUE(first.c) << first.logged();
    const unsigned F = 1, outputs[] = {first.at("a_upper_work_roll"), first.at("a_lower_work_roll")};
    const int order     = 1;
    const auto set      = FMI2(first, SetReal);
    const auto slope    = FMI2(first, SetRealInputDerivatives);
    const auto step     = FMI2(first, DoStep);
    const auto get      = FMI2(first, GetReal);
    const double loaded = seconds_of([&] {
      Client2 client(first.unit, stand.model, stand.model.data.guid, "");
      ASSERT_EQ(client.start(976e3), fmi2OK);
    });
    EXPECT_LT(loaded, 0.02);
    ASSERT_EQ(first.start(976e3), fmi2OK);
    double last         = 0;
    const double passed = seconds_of([&] {
      for (int i = 0; i < 200000; ++i) {
        const double force = 976e3 + (i % 97) * 10.0, rate = 1e4;
        double values[2];
        if (set(first.c, &F, 1, &force) + slope(first.c, &F, 1, &order, &rate) + step(first.c, i * 5e-5, 5e-5, 1) +
                get(first.c, outputs, 2, values) !=
            0)
          FAIL() << first.logged();
        last = values[0];
      }
    });
    EXPECT_TRUE(std::isfinite(last));
    EXPECT_LT(passed, 0.6) << "damper " << damper;
    RecordProperty("microseconds per step", std::to_string(1e6 * passed / 200000));
    std::printf("  damper %g: loading %.2f ms, %.3f us a step with its calls\n", damper, 1e3 * loaded,
                1e6 * passed / 200000);
  }
}

// Steps of a length that is new each time cost functions, not decompositions.
TEST(UnitSpeed, ChangingStepsCostLittleMore)
{
  const SampleStand stand = sample_stand();
  Client2 client(stand.model);
  ASSERT_EQ(client.start(976e3), fmi2OK);
  const auto step     = FMI2(client, DoStep);
  double time         = 0;
  const double passed = seconds_of([&] {
    for (int i = 0; i < 20000; ++i) {
      const double h = 5e-5 * (1 + 0.37 * std::sin(i));
      if (step(client.c, time, h, 1) != 0)
        FAIL() << client.logged();
      time = time + h;
    }
  });
  EXPECT_LT(1e6 * passed / 20000, 5) << "microseconds";
  std::printf("  %.3f us a step of changing length\n", 1e6 * passed / 20000);
}
