#include "app/study/study_command.h"
#include "app/study/study_new.h"
#include "app/study/study_report.h"
#include "app/study/study_run.h"
#include "app/study/study_work.h"
#include "core/base/errors.h"

namespace mill {
int study_command(const CommandLine &command)
{
  const std::string &action = command.study.action;
  if (action == "new")
    return study_new(command);
  if (action == "run")
    return study_run(command);
  if (action == "work")
    return study_work(command);
  if (action == "status")
    return study_status(command);
  return action == "merge" ? study_merge(command) : study_report(command);
}
}  // namespace mill
