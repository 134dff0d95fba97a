#include "app/verbs/driven_case.h"
#include "app/process/console.h"
#include "app/run/run_kind.h"
#include "app/run/run_log.h"
#include "app/run/run_setup.h"
#include "app/run/scratch_folder.h"
#include "core/base/visible_text.h"
#include "core/model/case.h"

namespace mill {
void run_in_scratch(const CommandLine &command, const Case &the_case,
                    const std::vector<std::pair<std::string, double>> &stages,
                    const std::function<void(RunContext &run)> &work)
{
  const ScratchFolder scratch("millstand-export");
  const OutputDir out(scratch.path(), the_case, true, run_id_of(the_case, word_of(command.verb), ""));
  const RunLog log(out, command.log, command.verbose);
  RunContext run{the_case, out, cache_folder(command, scratch.path() + "/" + usual_cache), command.fresh};
  open_cache(run, out.staging());
  set_up_threads(run, command);
  run.started = local_time();
  console::ProgressBar bar(stages, command.quiet);
  run.progress.step = [&](const std::string &stage, const double fraction) { bar.show(stage, fraction); };
  run.progress.log  = [&](const std::string &line) { log.line(line); };
  work(run);
  bar.finish();
}

DrivenStand driven_case(const CommandLine &command, const Case &the_case)
{
  DrivenStand driven;
  const RunKind &kind = run_kind(the_case);
  run_in_scratch(command, the_case, kind.stages(the_case), [&](RunContext &run) {
    driven          = kind.driven(run, command.pass);
    driven.warnings = run.results.warnings;
  });
  return driven;
}

void say_warnings(const std::vector<Warning> &warnings)
{
  for (const Warning &warning : warnings)
    console::say("warning: " + visible(text_of(warning), true) + "\n");
}
}  // namespace mill
