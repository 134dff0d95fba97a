// How far the working speeds are from the critical ones.
#include "report/front/stability.h"
#include "core/base/digits.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_chatter.h"
#include "report/page/curves.h"
#include "report/plot/number.h"
#include <cmath>
#include <limits>

namespace mill::report {
namespace {
double value_or_not(const Result *result)
{
  return result ? result->value : std::numeric_limits<double>::quiet_NaN();
}

// @param growth  chatter.CONDITION.growth_rate
SpeedVerdict of_condition(const Run &run, const std::string &condition, const Result &growth)
{
  const auto value = [&](const char *quantity) {
    return value_or_not(run.find(result_name({family::chatter, condition, quantity})));
  };
  SpeedVerdict v;
  v.pass      = condition;
  v.speed     = quantity_at(growth, "m/s");
  v.critical  = value("critical_speed");
  v.low       = v.critical;  // without an interval
  v.high      = v.critical;
  v.growth    = growth.value;
  v.frequency = value("frequency");
  v.mode      = std::isfinite(v.frequency) ? "mode at " + fixed(v.frequency, 0) + " Hz" : "least damped mode";
  v.finding   = growth.value > 0 ? SpeedFinding::unstable
                : v.speed < v.critical || (std::isnan(v.speed) && std::isfinite(v.critical)) ? SpeedFinding::below
                                                                                             : SpeedFinding::stable;
  return v;
}
}  // namespace

std::vector<SpeedVerdict> speed_verdicts(const Run &run)
{
  std::vector<SpeedVerdict> all = run.manifest.speeds;
  if (!all.empty())
    return all;
  for (const Result &result : run.results)
    if (const auto id = result_id(result.name);
        id && id->is_of(row::chatter::growth_rate) && std::isfinite(result.value))
      all.push_back(of_condition(run, id->place("pass"), result));
  worst_first(all);
  return all;
}

std::string title_of_pass(const Run &run, const std::string &name)
{
  if (!is_digits(name))
    return name;
  return (run.manifest.kind == KindOfCase::chatter ? "condition " : "pass ") + name;
}
}  // namespace mill::report
