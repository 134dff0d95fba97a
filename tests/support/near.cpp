#include "tests/support/near.h"
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace {
struct Use {
  double share;  // deviation over tolerance, 1 = just passed
  std::string what;
};
std::vector<Use> uses;

// Says after the run which comparisons were closest to failing: a tolerance that is never used is too wide.
class TightestFive : public testing::EmptyTestEventListener {
  void OnTestProgramEnd(const testing::UnitTest &) override
  {
    std::sort(uses.begin(), uses.end(), [](const Use &a, const Use &b) { return a.share > b.share; });
    for (std::size_t i = 0; i < std::min<std::size_t>(5, uses.size()); ++i)
      std::printf("  used %5.1f %% of its tolerance: %s\n", 100 * uses[i].share, uses[i].what.c_str());
  }
};
const bool registered = [] {
  testing::UnitTest::GetInstance()->listeners().Append(new TightestFive);
  return true;
}();

std::string digits(const double value)
{
  char text[40];
  std::snprintf(text, sizeof text, "%.12g", value);
  return text;
}
}  // namespace

Tolerance within(const double relative, std::string why, const double scale)
{
  return {relative, std::move(why), scale};
}

Tolerance within_absolute(const double absolute, std::string why)
{
  return {0, std::move(why), 0, absolute};
}

testing::AssertionResult near(const double actual, const double expected, const Tolerance &tolerance)
{
  if (tolerance.why.empty())
    return testing::AssertionFailure() << "a tolerance needs a reason";
  const double allowed   = tolerance.absolute + tolerance.relative * std::max(std::abs(expected), tolerance.scale);
  const double deviation = std::abs(actual - expected);
  const auto *test       = testing::UnitTest::GetInstance()->current_test_info();
  if (deviation <= allowed) {
    if (allowed > 0)
      uses.push_back({deviation / allowed, std::string(test ? test->name() : "") + ", " + digits(actual) +
                                               " against " + digits(expected) + " (" + tolerance.why + ")"});
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << digits(actual) << " against " << digits(expected) << ", deviation "
                                     << deviation << ", allowed " << allowed << ": " << tolerance.why;
}

testing::AssertionResult near(const Eigen::VectorXd &actual, const Eigen::VectorXd &expected,
                              const Tolerance &tolerance)
{
  if (actual.size() != expected.size())
    return testing::AssertionFailure() << actual.size() << " values against " << expected.size();
  for (Eigen::Index i = 0; i < actual.size(); ++i)
    if (const auto result = near(actual[i], expected[i], tolerance); !result)
      return testing::AssertionFailure() << "component " << i << ": " << result.message();
  return testing::AssertionSuccess();
}
