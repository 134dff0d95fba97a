#include "app/run/error_warnings.h"

namespace mill {
Warning warning_of(const WarningId id, const InputError &error)
{
  const Problem &problem = error.problems.front();
  return {id, "", problem.message, "", "", {}, "", problem.place, problem.related};
}

Warning warning_of(const WarningId id, const SolverError &error)
{
  return {id, "", error.report.what, error.report.cause, error.report.remedy};
}

Warning speed_not_searched(const std::string &pass, const SolverError &error)
{
  return {WarningId::critical_speed_not_searched,
          "pass \"" + pass + "\"",
          "critical speed not searched",
          error.report.what,
          error.report.remedy,
          {pass}};
}

Warning not_kept(const std::string &what, const InputError &error)
{
  return {WarningId::not_kept, "", what + " could not be kept for the next run", error.what()};
}
}  // namespace mill
