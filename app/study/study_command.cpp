#include "app/study/study_command.h"
#include "app/command/option_words.h"
#include "app/study/study_new.h"
#include "app/study/study_report.h"
#include "app/study/study_run.h"
#include "app/study/study_work.h"
#include "core/base/errors.h"

namespace mill {
int study_command(const CommandLine &command)
{
  switch (choice_named<StudyAction>(command.study.action).value()) {
  case StudyAction::new_study:
    return study_new(command);
  case StudyAction::run:
    return study_run(command);
  case StudyAction::work:
    return study_work(command);
  case StudyAction::status:
    return study_status(command);
  case StudyAction::merge:
    return study_merge(command);
  case StudyAction::report:
    return study_report(command);
  }
  return 2;
}
}  // namespace mill
