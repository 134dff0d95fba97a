#include "app/verbs/run_command.h"
#include "app/command/command_line.h"
#include "app/kinds/pipeline.h"
#include "app/process/out_of_memory.h"
#include "app/process/version.h"
#include "app/run/run_kind.h"
#include "app/run/run_log.h"
#include "app/run/run_setup.h"
#include "core/numerics/sparse.h"
#include "report/front/html.h"
#include <algorithm>
#include <fmt/format.h>
#include <new>

namespace mill {
namespace {
Goal goal_of(const Verb verb)
{
  return verb == Verb::stiffness ? Goal::stiffness
         : verb == Verb::masses  ? Goal::masses
         : verb == Verb::chatter ? Goal::chatter
         : verb == Verb::modes   ? Goal::modes
                                 : Goal::simulate;
}

// A verb that the kind of the case cannot answer.
void require_fitting(const Verb verb, const Case &the_case)
{
  const RunKind &kind = run_kind(the_case);
  if (std::find(kind.verbs.begin(), kind.verbs.end(), verb) != kind.verbs.end())
    return;
  if (const std::string why = kind.refusal ? kind.refusal(the_case, verb) : ""; !why.empty())
    throw InputError(why);
  throw InputError(std::string("millstand ") + word_of(verb) + " has nothing to compute for kind = \"" +
                   the_case.kind + "\" (" + the_case.path + "); use millstand run");
}

// What is published at the end, whatever the end is.
class Publication {
public:
  Publication(RunContext &of_run, const OutputDir &folder, const RunLog &of_log)
      : run(of_run), out(folder), log(of_log)
  {
    out.write("resolved.toml", run.the_case.resolved);
    out.write("run.json", manifest_json(run));
  }
  std::map<std::string, Table> store(const std::string &status)
  {
    out.write("results.json", results_json(run.results, run.the_case.name, status, out.run_id()));
    out.write("run.json", manifest_json(run));
    report::Run stored;
    {
      StageTimer timer(run, "report");
      stored = report::read_own_run(out.staging(), out.take_tables());
      out.write("report.html", report::html_page(stored));
      out.publish();
    }
    log.require_complete();
    return std::move(stored.tables);
  }
  [[noreturn]] void fail(const SolverError &error)
  {
    run.warn({WarningId::solver_failed, "", error.report.what, "", error.report.remedy});
    store("failed: " + error.report.what);
    throw SolverError(error);
  }

private:
  RunContext &run;
  const OutputDir &out;
  const RunLog &log;
};

void note_beginning(RunContext &run, const CommandLine &command, const CheckedCase &checked, const int wanted)
{
  if (run.threads < wanted)
    run.progress.note(
        fmt::format("{} threads in place of {}: more do not fit (ulimit -v) or do not start (ulimit -u)",
                    run.threads, wanted));
  run.progress.note("millstand " + version() + " " + word_of(command.verb) + " " + command.target);
  run.progress.note("BLAS " + blas_in_use());
  if (is_reference_blas(blas_in_use()))
    run.warn({WarningId::reference_blas, "",
              "the BLAS in use is the reference one (" + blas_in_use() + "), 6 to 20 times slower than OpenBLAS",
              "", "install libopenblas0-openmp"});
  for (const auto *warnings : {&run.the_case.warnings, &checked.review.warnings})
    for (const Warning &warning : *warnings)
      run.warn(warning);
  run.results.left_at_template = run.the_case.left_at_template;
}
}  // namespace

std::string folder_of_run(const CommandLine &command, const Case &the_case)
{
  return command.output.empty() ? "out/" + the_case.name : command.output;
}

FinishedRun carry_out_run(const CommandLine &command, const CheckedCase &checked, const Progress &shown)
{
  const Case &the_case = checked.the_case;
  require_fitting(command.verb, the_case);
  const OutputDir out(folder_of_run(command, the_case), the_case, command.force_overwrite,
                      run_id_of(the_case, word_of(command.verb), command.force));
  const RunLog log(out, command.log, command.verbose);
  RunContext run{the_case, out, cache_folder(command, out.path() + "/" + usual_cache), command.fresh};
  open_cache(run, out.staging());
  const int wanted  = set_up_threads(run, command);
  run.started       = local_time();
  run.asked         = std::make_shared<AskedSpeeds>();
  run.progress.step = shown.step;
  run.progress.log  = [&](const std::string &line) {
    log.line(line);
    shown.note(line);
  };
  note_beginning(run, command, checked, wanted);
  Publication publication(run, out, log);
  try {
    run_stages(run, goal_of(command.verb), command.force);
  } catch (const SolverError &e) {
    publication.fail(e);
  } catch (const std::bad_alloc &) {
    publication.fail(out_of_memory(stage_in_progress()));
  }
  auto tables = publication.store(run.results.warnings.empty() ? "ok" : "warnings");
  return {std::move(run.results), std::move(tables), run.summary, out.path(), run.asked->all()};
}
}  // namespace mill
