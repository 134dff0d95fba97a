#include "app/study/optimum_search.h"
#include "core/base/errors.h"
#include "tests/support/near.h"
#include <cmath>
#include <gtest/gtest.h>

namespace {
using namespace mill;

std::vector<TriedRow> starts(const SearchSettings &settings, const Objective &f, const int per_axis)
{
  std::vector<TriedRow> rows;
  for (int i = 0; i < per_axis; ++i)
    for (int j = 0; j < per_axis; ++j) {
      const double u = (i + 0.5) / per_axis, v = (j + 0.5) / per_axis;
      std::vector<double> inputs{settings.low[0] + u * (settings.high[0] - settings.low[0])};
      if (settings.low.size() > 1)
        inputs.push_back(settings.low[1] + v * (settings.high[1] - settings.low[1]));
      rows.push_back({inputs, f(inputs)});
    }
  return rows;
}

TEST(OptimumSearch, FindsTheEndOfANarrowValley)
{
  const SearchSettings settings{{-2, -1}, {2, 3}, false, true};
  const Objective rosenbrock = [](const std::vector<double> &x) {
    return 100 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1 - x[0], 2);
  };
  const Optimum optimum = search_optimum(settings, starts(settings, rosenbrock, 5), rosenbrock);
  EXPECT_TRUE(
      near(optimum.best.inputs[0], 1, within_absolute(0.01, "last step 1e-4 of a range of 4 in a curved valley")));
  EXPECT_LT(optimum.best.value, 1e-4);
  EXPECT_FALSE(optimum.at_bound[0]);
  // Along x the best y is x^2: the valley follows it.
  ASSERT_EQ(optimum.valley[0].size(), 11u);
  for (const ValleyPoint &point : optimum.valley[0])
    if (std::abs(point.inputs[0]) < std::sqrt(3))
      EXPECT_TRUE(near(point.inputs[1], point.inputs[0] * point.inputs[0],
                       within_absolute(0.02, "search of one input to 1e-4 of a range of 4")))
          << point.inputs[0];
}

TEST(OptimumSearch, AnOptimumOnItsBoundIsSaid)
{
  const SearchSettings settings{{0, 0}, {1, 10}, true, false};
  const Objective f     = [](const std::vector<double> &x) { return 5 * x[0] - std::pow(x[1] - 4, 2); };
  const Optimum optimum = search_optimum(settings, starts(settings, f, 4), f);
  EXPECT_EQ(optimum.best.inputs[0], 1);
  EXPECT_TRUE(optimum.at_bound[0]);
  EXPECT_FALSE(optimum.at_bound[1]);
  EXPECT_TRUE(near(optimum.best.inputs[1], 4, within_absolute(0.01, "last step 1e-4 of a range of 10")));
}

TEST(OptimumSearch, OneInputAndFailedRows)
{
  const SearchSettings settings{{0}, {10}, false, true};
  const Objective f = [](const std::vector<double> &x) { return x[0] < 2 ? std::nan("") : std::pow(x[0] - 3, 2); };
  const Optimum optimum = search_optimum(settings, starts(settings, f, 6), f);
  EXPECT_TRUE(near(optimum.best.inputs[0], 3, within_absolute(0.01, "last step 1e-4 of a range of 10")));
  EXPECT_TRUE(std::isnan(optimum.valley[0][0].value)) << "a failed row is a gap of the valley";
}

TEST(OptimumSearch, TheSameValuesGiveTheSameRows)
{
  const SearchSettings settings{{-1, -1}, {1, 1}, false, true};
  const Objective f = [](const std::vector<double> &x) {
    return std::cosh(x[0] - 0.3) + std::pow(x[1], 2) * x[0];
  };
  const auto first  = search_optimum(settings, starts(settings, f, 3), f),
             second = search_optimum(settings, starts(settings, f, 3), f);
  ASSERT_EQ(first.tried.size(), second.tried.size());
  for (std::size_t i = 0; i < first.tried.size(); ++i)
    EXPECT_EQ(first.tried[i].inputs, second.tried[i].inputs) << "a search that was cut is replayed";
}

TEST(OptimumSearch, WithoutAValueItIsRefused)
{
  const SearchSettings settings{{0}, {1}, false, false};
  EXPECT_THROW(search_optimum(settings, {{{0.5}, std::nan("")}}, [](const auto &) { return 0.0; }), InputError);
}

TEST(OptimumSearch, WhatTheObjectiveThrowsEndsTheSearch)
{
  const SearchSettings settings{{0, 0}, {1, 1}, false, false};
  int calls         = 0;
  const Objective f = [&](const std::vector<double> &) -> double {
    if (++calls == 7)
      throw InputError("stopped");
    return calls;
  };
  EXPECT_THROW(search_optimum(settings, {{{0.5, 0.5}, 1}}, f), InputError);
  EXPECT_EQ(calls, 7);
}
}  // namespace
