#include "app/command/command_line.h"
#include "app/command/common_options.h"
#include "app/command/option_words.h"
#include "app/command/verb_declarations.h"
#include <CLI/CLI.hpp>

namespace mill {
namespace {
// Which results a row has, and what computes them.
void add_rows_model(CLI::App *verb, CommandLine &c)
{
  add_repeatable(verb, "--watch", c.sweep.watch,
                 "name of a result, as in results.json, repeatable (default: springs and modes)");
  verb->add_option("--model", c.sweep.model, "full: as a run; quick: the closed forms of trace")
      ->check(CLI::IsMember(word_list<ModelKind>()))
      ->capture_default_str();
}

void add_cache_limit(CLI::App *verb, CommandLine &c)
{
  verb->add_option("--cache-limit", c.sweep.cache_limit,
                   "largest size of the cache folder, 20GB; what was not used for longest is removed first");
}

void add_studio(CLI::App &app, CommandLine &c)
{
  auto *studio     = app.add_subcommand("studio", "the stand in a browser: values, drawing, quick answer, run");
  StudioOptions &o = c.studio;
  studio->add_option("CASE", c.target,
                     "case file; a new one of kind four-high where it does not exist "
                     "(default stand.toml)");
  studio->add_option("--listen", o.listen, "address of the page, ADDR:PORT (default 127.0.0.1:8470)");
  studio->add_option("--token-file", o.token_file,
                     "file with the token of the page; needed for addresses that are not loopback");
  studio->add_option("--host", o.host, "host name that a reverse proxy uses for the page");
  add_output(studio, c, "folder of the runs (default out/<case name>-studio)");
  add_cache(studio, c);
}

void add_sweep(CLI::App &app, CommandLine &c)
{
  auto *sweep =
      app.add_subcommand("sweep", "one table and one page: results for every combination of some values");
  sweep->add_option("CASE", c.target, "case file")->required();
  add_repeatable(sweep, "--vary", c.sweep.vary,
                 "key and its values, KEY=a,b,c or KEY=lo..hi:n, with a unit behind each value or behind the last "
                 "one, repeatable");
  sweep->get_option("--vary")->required();
  add_rows_model(sweep, c);
  add_cache(sweep, c);
  add_cache_limit(sweep, c);
  add_memory(sweep, c);
  add_folder(sweep, c, "folder of the results (default out/<case name>-sweep)", "no progress, no table");
}

void add_study(CLI::App &app, CommandLine &c)
{
  auto *study =
      app.add_subcommand("study", "many runs of one case: drawn or listed inputs, on this machine or others");
  StudyOptions &o = c.study;
  study->add_option("ACTION", o.action, "new, run, work, status, merge or report")
      ->required()
      ->check(CLI::IsMember(word_list<StudyAction>()));
  study->add_option("CASE", c.target, "new: case file; otherwise the folder of the study")->required();
  add_repeatable(study, "--vary", c.sweep.vary,
                 "new: key and its distribution, 'KEY~normal(5, 0.2) MN/mm', uniform, truncated, triangular, "
                 "tolerance; with --method grid its values, KEY=a,b,c; repeatable");
  add_repeatable(study, "--correlate", o.correlate, "new: correlation of two inputs, KEY1,KEY2=0.5, repeatable");
  study
      ->add_option("--method", o.method, "new: grid, list, latin-hypercube, monte-carlo, sobol, chaos or optimise")
      ->check(CLI::IsMember(word_list<StudyMethod>()))
      ->default_val("latin-hypercube");
  study->add_option("--samples", o.samples,
                    "new: number of rows; with sobol of a group, a power of two; with optimise of start rows");
  auto *least = study->add_option("--minimise", o.minimise, "new: result whose least value optimise searches");
  study->add_option("--maximise", o.maximise, "new: result whose greatest value optimise searches")
      ->excludes(least);
  study->add_option("--seed", o.seed, "new: the same seed draws the same rows")->capture_default_str();
  study->add_option("--list", o.list, "new: CSV file of rows, its header names keys with units");
  study->add_flag("--yes", o.yes, "new: accept more than ten million rows");
  add_rows_model(study, c);
  study->add_option("--engine", o.engine, "run: here, parallel (GNU parallel, ssh) or slurm")
      ->check(CLI::IsMember(word_list<StudyEngine>()))
      ->capture_default_str();
  study->add_option("--jobs", o.jobs, "run: processes at a time; with slurm elements of the array")
      ->check(CLI::Range(1, 100000));
  study->add_option("--hosts", o.hosts, "run: file of machines for parallel, one a line");
  study->add_flag("--dry-run", o.dry_run, "run: print the script that would start");
  study->add_option("--shard", o.shard, "work: part I of N of the rows, I/N")->capture_default_str();
  study->add_flag("--allow-failed", o.allow_failed,
                  "report: statistics although more than 5 % of the rows failed");
  study->add_flag("--keep", o.keep,
                  "run, work: keep all files of each row of a full model, not results.json alone");
  add_cache(study, c);
  add_cache_limit(study, c);
  add_memory(study, c);
  add_folder(study, c, "new: folder of the study (default out/<case name>-study)", "no progress, no table");
}

void add_stack(CLI::App &app, CommandLine &c)
{
  auto *stack =
      app.add_subcommand("stack", "optimise: settings of the actuators of a roll stack for a wanted profile");
  stack->add_option("ACTION", c.stack.action, "optimise")->required();
  stack->add_option("CASE", c.target, "case file of kind stack")->required();
  add_repeatable(stack, "--target", c.stack.targets, "crown, edge_drop or wedge, crown=20um, repeatable");
  stack->get_option("--target")->required();
  add_repeatable(stack, "--bound", c.stack.bounds,
                 "what may be changed and between which values, \"W.bending_force=-200 kN..600 kN\", "
                 "\"I.shift=0 mm..150 mm\", \"B.eccentric3=0 um..200 um\", repeatable");
  stack->get_option("--bound")->required();
  add_cache(stack, c);
  add_sets(stack, c);
  stack->add_flag("-q,--quiet", c.quiet, "no progress");
}

void add_trace(CLI::App &app, CommandLine &c)
{
  auto *trace =
      app.add_subcommand("trace", "which results one input reaches, through which relation, with elasticities");
  trace->add_option("CASE", c.target, "case file")->required();
  trace->add_option("KEY", c.key, "input as --set names it, backup_roll.barrel_diameter")->required();
  trace->add_flag("--full", c.full,
                  "springs of the last stored run; their change is that of closed forms, "
                  "finite elements are not solved again");
  add_output(trace, c, "folder of the last run, to compare with (default out/<case name>)");
  trace->add_flag("-q,--quiet", c.quiet, "the table alone");
  add_sets(trace, c);
}
}  // namespace

void add_table_verbs(CLI::App &app, CommandLine &c)
{
  add_studio(app, c);
  add_sweep(app, c);
  add_study(app, c);
  add_stack(app, c);
  add_trace(app, c);
}
}  // namespace mill
