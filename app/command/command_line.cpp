#include "app/command/command_line.h"
#include "app/command/option_words.h"
#include "app/process/console.h"
#include "app/process/version.h"
#include "core/case/fields.h"
#include "core/numerics/sparse.h"
#include "fem/body/elastic_body.h"
#include "meshes/common/mesher.h"
#include <CLI/CLI.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <sstream>

namespace mill {
namespace {
std::string version_text()
{
  return "millstand " + version() + "\ndeal.II " + fem::library_version() + ", Gmsh " + meshes::library_version() +
         ", BLAS " + blas_in_use() +
         "\nLicence: GPL-3.0-or-later; so is every binary, since Debian's deal.II links Gmsh and others.";
}

void add_output(CLI::App *verb, CommandLine &c, const char *what)
{
  verb->add_option("-o,--output", c.output, what);
}

void add_cache(CLI::App *verb, CommandLine &c)
{
  verb->add_flag("--fresh", c.fresh, "compute everything again, ignore the cache");
  verb->add_option("--cache", c.cache, "folder of condensed rolls (default: the user's cache folder)");
}

void add_memory(CLI::App *verb, CommandLine &c)
{
  verb->add_option("--memory", c.memory,
                   "memory that may be used, 8GB: a condensation that needs more is refused before it begins");
}

void add_common(CLI::App *verb, CommandLine &c)
{
  add_output(verb, c, "folder of the results (default out/<case name>)");
  verb->add_flag("--force-overwrite", c.force_overwrite, "write into a folder that holds other files");
  add_cache(verb, c);
  verb->add_flag("-q,--quiet", c.quiet, "no progress, no table");
  verb->add_flag("-v,--verbose", c.verbose, "print what is reused and what is computed");
  verb->add_option("--log", c.log, "log file (in addition to DIR/millstand.log)");
  verb->add_option("--threads", c.threads, "threads (default: all processors)")->check(CLI::Range(1, 1024));
  add_memory(verb, c);
  verb->add_option("--set", c.sets, "override section.key=value, repeatable")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_kind(CLI::App *verb, CommandLine &c)
{
  verb->add_option("--as", c.as_kind, "stack: take a case of kind four-high as a stack of rolls that bend");
}

// For a program that holds the case and starts this one (studio); without a word in the help.
void add_held_case(CLI::App *verb, CommandLine &c)
{
  verb->add_option("--text", c.text, "file whose content stands in the place of that of CASE")->group("");
  verb->add_option("--progress-step", c.progress_step, "per cent between two lines of progress")
      ->check(CLI::Range(1, 100))
      ->group("");
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

void add_simulate(CLI::App *verb, CommandLine &c)
{
  verb->add_option("--force", c.force, "force record that replaces those of the passes (CSV)");
  verb->add_flag(
      "--stream", c.stream,
      "read the record of --force in blocks, for one of any length: rows, spectrum and levels, no report");
  verb->add_option("--pass", c.pass, "with --stream: pass whose stand is driven (default: the first)");
}

void add_repeatable(CLI::App *verb, const char *option, std::vector<std::string> &into, const char *what)
{
  verb->add_option(option, into, what)->expected(1)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void add_record_options(CLI::App *verb, CommandLine &c)
{
  verb->add_option("--rate", c.record_rate, "samples per second of records without times");
  verb->add_option("--zone", c.zone, "time zone of local times, Europe/Berlin");
  add_repeatable(verb, "--channel", c.channels, "a column and its place, AI_07=upper_work_roll, repeatable");
  add_repeatable(verb, "--unit", c.channel_units,
                 "a column and its unit, AI_07=g, where the source names no unit, repeatable");
  add_repeatable(verb, "--scale", c.scales,
                 "sensitivity of the sensors behind voltages, \"50 mV/g\", or of one column, \"AI_07=50 mV/g\"");
}

// What verbs that read records or give advice have in common behind their own options.
void add_folder_of_records(CLI::App *verb, CommandLine &c, const char *folder, const char *quiet)
{
  add_repeatable(verb, "--set", c.sets, "override section.key=value of the case, repeatable");
  add_output(verb, c, folder);
  verb->add_flag("--force-overwrite", c.force_overwrite, "write into a folder that holds other files");
  verb->add_flag("-q,--quiet", c.quiet, quiet);
  verb->add_option("--threads", c.threads, "threads (default: all processors)")->check(CLI::Range(1, 1024));
}

// Which model of a drawing leaves the house.
void add_model(CLI::App *verb, CommandLine &c, const std::vector<std::string> &models, const char *what)
{
  verb->add_option("--model", c.model, what)->check(CLI::IsMember(models));
}

void add_calibrate(CLI::App &app, CommandLine &c)
{
  auto *verb =
      app.add_subcommand("calibrate", "springs, masses and damping of a stand from records, with their intervals");
  CalibrateOptions &o = c.calibrate;
  verb->add_option("CASE", c.target, "stand, kind four-high or lumped")->required();
  verb->add_option("--measured", o.measured, "folder of the records, with records.toml where they have roles");
  verb->add_option(
      "--free", o.free,
      "unknowns of the fit, \"K1, M2/M5, frame, zeta\": names, groups with one factor, or frame, springs, "
      "masses, ratios (default: all springs, masses with a stated error, zeta)");
  add_model(verb, c, {"six-mass", "beam", "craig-bampton"},
            "of a case of kind four-high (default: dynamics.model of the case, else the model that leads a run)");
  verb->add_option("--model-error", o.model_error,
                   "error that the model may have in each third octave, of its level (default \"5 %\")");
  verb->add_flag("--plan", o.plan, "which unknowns a record would identify, before anyone measures");
  verb->add_flag("--accept", o.accept, "write calibrated.toml although it is refused, and say so in it");
  verb->add_flag("--align", o.align, "force and vibration have two clocks: fit their delay");
  verb->add_option("--sensors", o.sensors,
                   "with --plan: places of the sensors (default: upper_work_roll,lower_work_roll)");
  verb->add_option("--duration", o.duration, "with --plan: duration of the record (default \"20 s\")");
  verb->add_option("--noise", o.noise, "with --plan: noise of a sensor, per root Hz (default \"0.005 m/s2\")");
  verb->add_option("--force-rms", o.force, "with --plan: rms of the force (default \"1 kN\")");
  verb->add_option("--force-up-to", o.highest,
                   "with --plan: highest frequency of the force (default \"1500 Hz\")");
  verb->add_flag("--without-force", o.without_force, "with --plan: the force is not recorded");
  add_record_options(verb, c);
  add_folder_of_records(verb, c, "folder of the results (default out/<case name>-calibration)",
                        "no progress, no table");
}

void add_advise(CLI::App &app, CommandLine &c)
{
  auto *advise = app.add_subcommand(
      "advise", "actions that would lower the vibration: each recomputed, ranked, with its cost");
  advise
      ->add_option("CASE", c.target,
                   "case file of kind four-high or lumped (level of a place) or chatter "
                   "(critical speed); [advice] says what may be tried")
      ->required();
  advise->add_option("--measured", c.measured, "folder of records with the rolling force that shakes the stand");
  add_record_options(advise, c);
  add_cache(advise, c);
  add_folder_of_records(advise, c, "folder of the results (default out/<case name>-advice)", "no table");
}

void add_analyse(CLI::App &app, CommandLine &c)
{
  auto *analyse = app.add_subcommand(
      "analyse", "records of a mill: spectra, modes, what follows the speed, source of each peak");
  analyse->add_option("RECORD", c.names, "CSV, .npy with .json, .npz, .uff, .mat, .wav or .lvm")->required();
  analyse->add_option("--case", c.case_file, "stand of the record, kind four-high or lumped");
  add_model(analyse, c, {"six-mass", "beam"}, "of a case of kind four-high: six-mass or beam (default)");
  add_record_options(analyse, c);
  analyse->add_option("--speed", c.speed, "surface speed of the rolls, if it was not recorded, \"4 m/s\"");
  analyse->add_option("--limit", c.limit, "vibration limit of this mill, 0-peak, \"2 g\"");
  add_repeatable(analyse, "--severity", c.severity,
                 "upper end of a zone, \"2.3 mm/s\", repeatable; none is built in");
  analyse->add_flag("--align", c.align, "take the delay between the clocks of force and vibrations out of H1");
  add_repeatable(analyse, "--baseline", c.baseline,
                 "folder of an earlier analysis, for changes and bearings, repeatable");
  add_folder_of_records(analyse, c, "folder of the results (default out/<record>-analysis)",
                        "no progress, no table");
}

void add_live(CLI::App &app, CommandLine &c)
{
  auto *live =
      app.add_subcommand("live", "the model of a stand, driven by the measured rolling force while the mill runs");
  LiveOptions &o = c.live;
  live->add_option("CASE", c.target, "case file of kind four-high, chatter or lumped")->required();
  add_model(live, c, {"six-mass", "beam"}, "of a case of kind four-high: six-mass or beam (default)");
  live->add_option(
      "--input", o.input,
      "FILE.csv (played), tail:FILE.csv (growing), - (lines on standard input), tcp:ADDR:PORT (default "
      "tcp:127.0.0.1:8461) or mqtt:HOST:PORT/STAND");
  live->add_option("--listen", o.listen, "address of the page, ADDR:PORT (default 127.0.0.1:8460), or none");
  live->add_option("--record", o.record, "folder for recordings and the state for a restart");
  live->add_option("--keep", o.keep, "how much of the recordings is kept: 24h, 7d, 50GB (default: all)");
  live->add_option("--speed", o.speed, "speed at which a record is played: times real time, or max (default 1)");
  live->add_option("--limit", c.limit,
                   "vibration limit of this mill in a band, 0-peak, \"2 g\" (default monitoring.limit)");
  live->add_option("--token-file", o.token_file,
                   "file with the token of page and data port; needed for addresses that are not loopback");
  live->add_option("--host", o.host, "host name that a reverse proxy uses for the page");
  live->add_option("--response", o.response, "write the accelerations of the twin into this file (CSV)");
  add_record_options(live, c);
  add_repeatable(live, "--set", c.sets, "override section.key=value of the case, repeatable");
  live->add_flag("--fresh", c.fresh, "start without the state of an earlier program");
  live->add_flag("--force-overwrite", c.force_overwrite, "replace an existing --response file");
  live->add_flag("-q,--quiet", c.quiet, "no lines on the console");
}

void add_model(CLI::App *verb, CommandLine &c)
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

void add_sweep(CLI::App &app, CommandLine &c)
{
  auto *sweep =
      app.add_subcommand("sweep", "one table and one page: results for every combination of some values");
  sweep->add_option("CASE", c.target, "case file")->required();
  add_repeatable(sweep, "--vary", c.sweep.vary,
                 "key and its values, KEY=a,b,c or KEY=lo..hi:n, with a unit behind each value or behind the last "
                 "one, repeatable");
  sweep->get_option("--vary")->required();
  add_model(sweep, c);
  add_cache(sweep, c);
  add_cache_limit(sweep, c);
  add_memory(sweep, c);
  add_folder_of_records(sweep, c, "folder of the results (default out/<case name>-sweep)",
                        "no progress, no table");
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
  stack->add_option("--set", c.sets, "override section.key=value, repeatable")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  stack->add_flag("-q,--quiet", c.quiet, "no progress");
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
  add_model(study, c);
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
  add_folder_of_records(study, c, "new: folder of the study (default out/<case name>-study)",
                        "no progress, no table");
}

// "--output" of "--output=DIR"
std::string option_name(const std::string &argument)
{
  return argument.substr(0, argument.find('='));
}

// An unknown verb or option, with the nearest one; empty when something else is wrong.
std::string mistyped(const CLI::App &app, const int argc, char **argv)
{
  std::vector<std::string> verbs;
  for (const CLI::App *verb : app.get_subcommands([](const CLI::App *) { return true; }))
    verbs.push_back(verb->get_name());
  const std::string first = argc > 1 ? argv[1] : "";
  if (first.empty() || first[0] == '-')
    return "";
  if (std::find(verbs.begin(), verbs.end(), first) == verbs.end())
    return fmt::format("unknown verb '{}'{}", first, suggestion(first, verbs));
  std::vector<std::string> known;
  for (const CLI::Option *option : app.get_subcommand(first)->get_options()) {
    for (const std::string &name : option->get_lnames())
      known.push_back("--" + name);
    for (const std::string &name : option->get_snames())
      known.push_back("-" + name);
  }
  for (int i = 2; i < argc; ++i) {
    const std::string name = option_name(argv[i]);
    if (name.size() > 2 && is_long(name) && std::find(known.begin(), known.end(), name) == known.end())
      return fmt::format("millstand {} has no option {}{}", first, name, suggestion(name, known));
  }
  return "";
}

// What else the arguments lack, in the words of CLI11.
std::string refusal_of_arguments(const CLI::App &app, const CLI::ParseError &error)
{
  const auto verbs          = app.get_subcommands();
  const std::string program = verbs.empty() ? "millstand" : "millstand " + verbs.front()->get_name();
  return fmt::format("{}: {}; {} --help lists what it takes", program, error.what(), program);
}
}  // namespace

std::optional<CommandLine> parse_command_line(const int argc, char **argv, int &exit_code)
{
  CommandLine c;
  c.arguments = argv;
  CLI::App app("From the drawing of a rolling-mill stand to the vibration of its rolls.", "millstand");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);

  auto *fresh = app.add_subcommand("new", "write a commented case file that runs as it is");
  fresh
      ->add_option("KIND", c.target,
                   "four-high, two-cylinders, bearing, bite, chatter, cluster, stack, stack-2, stack-4, stack-6, "
                   "stack-20 or "
                   "lumped")
      ->required();
  add_output(fresh, c, "file (default: standard output)");
  fresh->add_flag("--force-overwrite", c.force_overwrite, "replace an existing file");
  fresh->add_option("--from", c.from, "sheet (CSV) of rows key, value[, unit] that fills the template");

  auto *check = app.add_subcommand("check", "list every input error of a case, compute nothing");
  check->add_option("CASE", c.target, "case file")->required();
  add_kind(check, c);
  check->add_option("--set", c.sets, "override section.key=value, repeatable")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);

  const std::pair<Verb, const char *> chain[] = {
      {Verb::run, "the whole chain and the report"},
      {Verb::stiffness, "K3, K4, K5, Kzc with their curves"},
      {Verb::masses, "equivalent masses with their shapes"},
      {Verb::modes, "natural frequencies, shapes, energy shares"},
      {Verb::chatter, "critical speed, sensitivities, stability map"},
      {Verb::simulate, "drive the lumped model with the recorded force"}};
  for (const auto &[verb, what] : chain) {
    auto *command = app.add_subcommand(word_of(verb), what);
    command->add_option("CASE", c.target, "case file")->required();
    add_common(command, c);
    add_kind(command, c);
    add_held_case(command, c);
    if (verb == Verb::simulate)
      add_simulate(command, c);
  }

  auto *unit =
      app.add_subcommand("export", "the driven model for other programs: as a unit (FMI 2 or 3), in Modelica, "
                                   "MATLAB, or as state-space matrices");
  unit->add_option("FORMAT", c.format, "fmu, modelica, matlab or statespace")
      ->required()
      ->check(CLI::IsMember(word_list<ExportFormat>()));
  unit->add_option("CASE", c.target, "case file of kind four-high, cluster, stack or lumped; chatter for fmu")
      ->required();
  unit->add_option("--fmi", c.fmi, "fmu: version of the FMI standard, 2 or 3")
      ->check(CLI::IsMember({2, 3}))
      ->capture_default_str();
  add_model(
      unit, c, {"six-mass", "beam", "craig-bampton"},
      "six-mass, beam or craig-bampton (default: dynamics.model of the case, else the model that leads a run)");
  unit->add_option("--pass", c.pass,
                   "pass whose load and force are used, or condition of a chatter case (default: the first)");
  add_common(unit, c);
  add_kind(unit, c);
  add_held_case(unit, c);
  unit->get_option("--output")
      ->description("file to write, a folder for statespace (default out/<case name>.fmu, .mo, .m, -statespace)");

  auto *marks =
      app.add_subcommand("marks", "marks at equal distances: the rolls, bearings and modes that may cause them");
  marks->add_option("CASE", c.target, "case file")->required();
  marks->add_option("--spacing", c.marks.spacing, "distance of the marks along the strip, \"2 mm\"");
  marks->add_option("--frequency", c.marks.frequency,
                    "of a vibration that would leave the marks, \"315 Hz\", instead of --spacing");
  marks->add_option("--speed", c.marks.speed, "speed of the strip behind the stand, \"500 m/min\"")->required();
  marks->add_option("--forward-slip", c.marks.forward_slip,
                    "forward slip of the strip over the rolls (default 0 %)");
  marks->add_option("--accuracy", c.marks.accuracy,
                    "uncertainty of spacing and diameters together (default 1 %), within which a number of marks "
                    "is taken as whole");
  marks->add_option("--side-bands", c.marks.side_bands, "distance of side bands in a spectrum, \"49 Hz\"");
  marks->add_option("--run", c.marks.run, "folder of a run whose modes are taken (default out/<case name>)");
  add_output(marks, c, "folder of the results (default out/<case name>-marks)");
  marks->add_flag("--force-overwrite", c.force_overwrite, "write into a folder that holds other files");
  marks->add_flag("-q,--quiet", c.quiet, "no table");
  marks->add_option("--set", c.sets, "override section.key=value, repeatable")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);

  add_analyse(app, c);
  add_calibrate(app, c);
  add_advise(app, c);
  add_live(app, c);
  add_studio(app, c);
  add_sweep(app, c);
  add_study(app, c);
  add_stack(app, c);
  auto *trace =
      app.add_subcommand("trace", "which results one input reaches, through which relation, with elasticities");
  trace->add_option("CASE", c.target, "case file")->required();
  trace->add_option("KEY", c.key, "input as --set names it, backup_roll.barrel_diameter")->required();
  trace->add_flag("--full", c.full,
                  "springs of the last stored run; their change is that of closed forms, "
                  "finite elements are not solved again");
  add_output(trace, c, "folder of the last run, to compare with (default out/<case name>)");
  trace->add_flag("-q,--quiet", c.quiet, "the table alone");
  trace->add_option("--set", c.sets, "override section.key=value, repeatable")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);

  auto *verify = app.add_subcommand("verify", "run the verification manual: result, reference, tolerance");
  verify->add_option("NAME", c.names, "cases to run (default: all)");
  verify->add_flag("--list", c.list, "list the cases, run nothing");
  verify->add_option("--markdown", c.markdown, "write the manual as a page, after running all cases");
  verify->add_flag("-q,--quiet", c.quiet, "no progress, no table of a case that passes");
  verify->add_option("--threads", c.threads, "threads (default: all processors)")->check(CLI::Range(1, 1024));

  auto *report =
      app.add_subcommand("report", "write DIR/report.html again from the stored results, or compare runs");
  report->add_option("DIR", c.target, "folder of a run")->required();
  report->add_option("MORE", c.names, "further runs or analyses: what differs is written to DIR/comparison.html");
  report->add_option("-o", c.output, "file of the comparison");

  auto *help =
      app.add_subcommand("help", "explain a task, a verb, a term, a result or a key; without a topic list them");
  help->add_option("TOPIC", c.names, "chatter-heard, sweep, \"gap mode\", K3, work_roll.crown");
  help->add_flag("--manual-page", c.manual_page, "print the manual page of all verbs, for man");
  app.add_subcommand("schema", "print the JSON Schema of the case file");
  auto *completion = app.add_subcommand("completion", "print the completion of a shell");
  completion->add_option("SHELL", c.target, "bash, fish or zsh")->required();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError &e) {
    std::ostringstream out, err;
    exit_code = app.exit(e, out, err) == 0 ? 0 : 2;
    if (const std::string slip = exit_code == 2 ? mistyped(app, argc, argv) : ""; !slip.empty())
      throw InputError(slip);
    if (exit_code == 2)
      throw InputError(refusal_of_arguments(app, e));
    console::print(out.str());
    console::say(err.str());
    return {};
  }
  c.verb = *choice_named<Verb>(app.get_subcommands().front()->get_name());
  if (c.verb == Verb::completion || c.verb == Verb::help) {
    c.summary = app.get_description();
    c.verbs   = described_verbs(app);
  }
  return c;
}
}  // namespace mill
