#include "app/command/common_options.h"
#include "app/command/command_line.h"
#include <CLI/CLI.hpp>

namespace mill {
void add_output(CLI::App *verb, CommandLine &c, const char *what)
{
  verb->add_option("-o,--output", c.output, what);
}

void add_sets(CLI::App *verb, CommandLine &c)
{
  add_repeatable(verb, "--set", c.sets, "override section.key=value of the case, repeatable");
}

void add_overwrite(CLI::App *verb, CommandLine &c)
{
  verb->add_flag("--force-overwrite", c.force_overwrite, "write into a folder that holds other files");
}

void add_threads(CLI::App *verb, CommandLine &c)
{
  verb->add_option("--threads", c.threads, "threads (default: all processors)")->check(CLI::Range(1, 1024));
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
  add_overwrite(verb, c);
  add_cache(verb, c);
  verb->add_flag("-q,--quiet", c.quiet, "no progress, no table");
  verb->add_flag("-v,--verbose", c.verbose, "print what is reused and what is computed");
  verb->add_option("--log", c.log, "log file (in addition to DIR/millstand.log)");
  add_threads(verb, c);
  add_memory(verb, c);
  add_sets(verb, c);
}

void add_kind(CLI::App *verb, CommandLine &c)
{
  verb->add_option("--as", c.as_kind, "stack: take a case of kind four-high as a stack of rolls that bend");
}

// For a program that holds the case and starts this one (studio): the help does not list them.
void add_held_case(CLI::App *verb, CommandLine &c)
{
  verb->add_option("--text", c.text, "file whose content stands in the place of that of CASE")->group("");
  verb->add_option("--progress-step", c.progress_step, "per cent between two lines of progress")
      ->check(CLI::Range(1, 100))
      ->group("");
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

void add_folder(CLI::App *verb, CommandLine &c, const char *folder, const char *quiet)
{
  add_sets(verb, c);
  add_output(verb, c, folder);
  add_overwrite(verb, c);
  verb->add_flag("-q,--quiet", c.quiet, quiet);
  add_threads(verb, c);
}

void add_model(CLI::App *verb, CommandLine &c, const std::vector<std::string> &models, const char *what)
{
  verb->add_option("--model", c.model, what)->check(CLI::IsMember(models));
}
}  // namespace mill
