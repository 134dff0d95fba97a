#include "app/command/command_line.h"
#include "app/command/common_options.h"
#include "app/command/option_words.h"
#include "app/command/verb_declarations.h"
#include "core/case/input_reference.h"
#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace mill {
namespace {
void add_new(CLI::App &app, CommandLine &c)
{
  auto *verb = app.add_subcommand("new", "write a commented case file that runs as it is");
  verb->add_option("KIND", c.target, fmt::format("{}", fmt::join(template_names(), ", ")))->required();
  add_output(verb, c, "file (default: standard output)");
  verb->add_flag("--force-overwrite", c.force_overwrite, "replace an existing file");
  verb->add_option("--from", c.from, "sheet (CSV) of rows key, value[, unit] that fills the template");
}

void add_check(CLI::App &app, CommandLine &c)
{
  auto *check = app.add_subcommand("check", "list every input error of a case, compute nothing");
  check->add_option("CASE", c.target, "case file")->required();
  add_kind(check, c);
  add_sets(check, c);
}

void add_simulate(CLI::App *verb, CommandLine &c)
{
  verb->add_option("--force", c.force, "force record that replaces those of the passes (CSV)");
  verb->add_flag(
      "--stream", c.stream,
      "read the record of --force in blocks, for one of any length: rows, spectrum and levels, no report");
  verb->add_option("--pass", c.pass, "with --stream: pass whose stand is driven (default: the first)");
}

void add_chain(CLI::App &app, CommandLine &c)
{
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
}

void add_export(CLI::App &app, CommandLine &c)
{
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
}
}  // namespace

void add_case_verbs(CLI::App &app, CommandLine &c)
{
  add_new(app, c);
  add_check(app, c);
  add_chain(app, c);
  add_export(app, c);
}
}  // namespace mill
