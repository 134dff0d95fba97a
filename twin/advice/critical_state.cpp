#include "twin/advice/critical_state.h"
#include "core/base/errors.h"
#include <algorithm>

namespace mill::twin {
namespace {
// Nothing grows at any speed below those without an answer.
bool is_stable_up_to_gap(const dynamics::CriticalSpeed &search)
{
  return search.verdict == dynamics::Verdict::unstable_beyond_gap &&
         std::none_of(search.points.begin(), search.points.end(), [&](const dynamics::SpeedPoint &point) {
           return point.speed < search.gap[0] && point.unstable > 0;
         });
}
}  // namespace

CriticalState critical_state(const dynamics::ChatterStandModel &stand, const bite::RollBite &bite,
                             const Linearisation scheme, const dynamics::SpeedRange &range,
                             const double working_speed)
{
  using dynamics::Verdict;
  CriticalState s;
  s.search = dynamics::critical_speed(stand, bite, scheme, range);
  s.speed  = range.from;
  if (s.search.verdict == Verdict::crossing)
    s.speed = s.search.speed;
  else if (s.search.verdict == Verdict::stable || is_stable_up_to_gap(s.search)) {
    s.at_least = true;
    s.speed    = s.search.verdict == Verdict::stable ? s.search.highest_bite : s.search.gap[0];
  }
  try {
    const auto point = dynamics::working_point(bite, working_speed, scheme);
    s.force          = point.state.force;
    s.torque         = point.state.torque;
    s.friction       = point.state.friction;
    s.growth         = dynamics::growth_rate(chatter_matrix(stand, point.by));
    s.output         = point.state.exit_speed * bite.strip.exit_thickness * bite.strip.width;
  } catch (const InputError &error) {
    s.no_bite = true;
    s.why     = error.problems.front().message;
  } catch (const SolverError &error) {
    s.no_bite = true;
    s.why     = error.report.what;
  }
  return s;
}
}  // namespace mill::twin
