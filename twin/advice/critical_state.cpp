#include "twin/advice/critical_state.h"
#include "core/base/errors.h"

namespace mill::twin {
CriticalState critical_state(const dynamics::ChatterStandModel &stand, const bite::RollBite &bite,
                             const Linearisation scheme, const dynamics::SpeedRange &range,
                             const double working_speed)
{
  using dynamics::Verdict;
  CriticalState s;
  s.search   = dynamics::critical_speed(stand, bite, scheme, range);
  s.at_least = s.search.verdict == Verdict::stable;
  s.speed    = s.search.verdict == Verdict::crossing ? s.search.speed
               : s.at_least                          ? s.search.highest_bite
                                                     : range.from;
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
