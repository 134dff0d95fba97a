#include "core/numerics/root_search.h"
#include "core/base/errors.h"
#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill {
namespace {
bool is_narrow(const double a, const double b, const double within)
{
  return std::abs(b - a) <= within * std::max(std::abs(a), std::abs(b));
}
}  // namespace

std::optional<double> root_between(Evaluated low, Evaluated high, const std::function<double(double)> &f,
                                   const double within)
{
  if (low.value == 0)
    return low.argument;
  if (high.value == 0)
    return high.argument;
  if (!(low.value < 0 && high.value > 0) && !(low.value > 0 && high.value < 0))
    return {};
  if (low.argument > high.argument)
    std::swap(low, high);
  constexpr std::uintmax_t most = 500;
  std::uintmax_t evaluations    = most;
  const auto [below, above]     = boost::math::tools::toms748_solve(
          f, low.argument, high.argument, low.value, high.value,
          [&](const double a, const double b) { return is_narrow(a, b, within); }, evaluations);
  if (evaluations >= most)
    throw SolverError({"a root in one unknown was not found",
                       fmt::format("between {:.17g} and {:.17g} after {} evaluations", below, above, most),
                       "an input that is not a number, or far outside of what is usual",
                       "read the case with millstand check", ""});
  return 0.5 * (below + above);
}

std::optional<double> root_between(const double low, const double high, const std::function<double(double)> &f,
                                   const double within)
{
  return root_between({low, f(low)}, {high, f(high)}, f, within);
}

Evaluated minimum_between(const double low, const double high, const std::function<double(double)> &f)
{
  // In shares of the interval, since the stop rule of Boost has an absolute part.
  const auto place          = [&](const double share) { return low + share * (high - low); };
  std::uintmax_t most       = 200;
  const auto [share, least] = boost::math::tools::brent_find_minima(
      [&](const double s) { return f(place(s)); }, 0., 1., std::numeric_limits<double>::digits / 2, most);
  return {place(share), least};
}

Border border_between(double holds, double fails, const std::function<bool(double)> &property, const double within)
{
  while (!is_narrow(holds, fails, within)) {
    const double middle = 0.5 * (holds + fails);
    if (middle == holds || middle == fails)
      break;  // neighbouring numbers
    (property(middle) ? holds : fails) = middle;
  }
  return {holds, fails};
}
}  // namespace mill
