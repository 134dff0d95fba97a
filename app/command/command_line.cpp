#include "app/command/command_line.h"
#include "app/command/verb_declarations.h"
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
  add_case_verbs(app, c);
  add_record_verbs(app, c);
  add_table_verbs(app, c);
  add_other_verbs(app, c);
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
