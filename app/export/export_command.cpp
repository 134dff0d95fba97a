#include "app/export/export_command.h"
#include "app/export/exchanged_stand.h"
#include "app/export/exported_chatter.h"
#include "app/export/exported_curves.h"
#include "app/export/exported_files.h"
#include "app/export/exported_stand.h"
#include "app/export/static_rest.h"
#include "app/process/console.h"
#include "app/run/run_kind.h"
#include "app/verbs/driven_case.h"
#include "app/verbs/leading_model.h"
#include "core/base/file_ending.h"
#include "core/base/files.h"
#include "core/model/case.h"
#include "dynamics/fmu/archive.h"
#include "dynamics/fmu/embedded.h"
#include "dynamics/fmu/unit_archive.h"
#include <filesystem>
#include <fmt/format.h>

namespace fs = std::filesystem;

namespace mill {
namespace {
// Is it the archive of an earlier export of the same model?
bool is_earlier_export(const std::string &path, const std::string &identifier)
{
  const auto bytes = text_if_readable(path);
  if (!bytes)
    return false;
  try {
    for (const fmu::ArchiveEntry &entry : fmu::entries_of(*bytes))
      if (entry.name == fmu::description_file)
        return entry.bytes.find("modelIdentifier=\"" + identifier + "\"") != std::string::npos;
  } catch (const std::runtime_error &) {
    return false;  // not an archive
  }
  return false;
}

void require_output(const std::string &path, const std::string &identifier, const bool overwrite)
{
  if (!has_ending(path, FileEnding::fmu))
    throw InputError("-o " + path + ": a functional mock-up unit is an archive whose name ends with .fmu");
  std::error_code error;
  const auto file_status = fs::status(path, error);
  if (fs::is_directory(file_status))
    throw InputError("-o " + path + " is a folder; name the archive, for example " + path + "/" + identifier +
                     ".fmu");
  if (fs::exists(file_status) && !overwrite && !is_earlier_export(path, identifier))
    throw InputError("the file " + path +
                     " exists and is not an earlier export of this case; choose another with -o, or "
                     "give --force-overwrite");
}

std::string platforms()
{
  return fmu::named_file("win64").empty()
             ? "Linux; this program was built without a library for Windows (package g++-mingw-w64-x86-64-posix), "
               "build the files of sources/ there"
             : "Linux and Windows";
}
}  // namespace

namespace {
// A unit follows the curves; an export that has slopes alone gives a warning.
void warn_of_slopes(const DynamicsSettings &settings)
{
  if (settings.contact == ContactSprings::curve)
    console::say("warning: dynamics.contact = \"curve\" holds for run, simulate and export fmu with a pass; this "
                 "model is linear, with the slopes of the springs at the working load\n");
}

// A unit on curves has the springs of the locked films; their dampers belong to the linear unit.  (29.19)
void warn_of_films(const DrivenStand &driven)
{
  constexpr double small = 0.1;  // of the modal damping
  const double films = film_damping(driven), modal = driven.dynamics.modal_damping;
  if (films > small * modal)
    console::say(fmt::format("warning: the oil films add {:.2g} % of critical to the modal damping of {:.2g} %; a "
                             "unit on curves leaves them out, dynamics.contact = \"tangent\" has them\n",
                             100 * films, 100 * modal));
}

fmu::ExportedModel unit_of(const DrivenStand &driven, const Case &the_case)
{
  if (driven.curves) {
    warn_of_films(driven);
    return exported_curves(driven, the_case);
  }
  warn_of_slopes(driven.dynamics);
  return exported_model(driven, the_case);
}

// A name that other programs cannot write becomes another one there.
void say_name(const Case &the_case, const std::string &name)
{
  if (fmu::is_transliterated(the_case.name))
    console::say("note: other programs cannot write the name of the case \"" + the_case.name +
                 "\"; the model is called " + name + " there\n");
}

DrivenStand driven_with_warnings(const CommandLine &command, const Case &the_case)
{
  DrivenStand driven = driven_case(command, with_leading_model(the_case, command));
  add_static_rest(driven);
  say_warnings(driven.warnings);
  return driven;
}

void export_unit(const CommandLine &command, const Case &the_case)
{
  const std::string path = command.output.empty() ? "out/" + the_case.name + ".fmu" : command.output;
  require_output(path, fmu::identifier_of(the_case.name), command.force_overwrite);
  const auto *chatter            = std::get_if<ChatterCase>(&the_case.spec);
  const fmu::ExportedModel model = chatter ? exported_chatter(*chatter, command.pass, the_case)
                                           : unit_of(driven_with_warnings(command, the_case), the_case);
  const std::string archive      = fmu::unit_archive(model, command.fmi);
  fmu::check_unit(archive, model, command.fmi);
  write_together({{path, archive}}, command.output.empty() ? "out" : "");
  say_name(the_case, model.identifier);
  if (!command.quiet)
    console::print(
        fmt::format("{}: {}, FMI {}.0 co-simulation, {}\n", path, model.method, command.fmi, platforms()));
}

// The command line takes no other word.
ExportFormat format_of(const CommandLine &command)
{
  return choice_named<ExportFormat>(command.format).value();
}

void export_matrices(const CommandLine &command, const Case &the_case)
{
  const ExportFormat format = format_of(command);
  const std::string path    = command.output.empty() ? usual_output(format, the_case.name) : command.output;
  const std::string name    = exchange_name(format, path);
  if (!command.force_overwrite)
    require_own(format, path, the_case.name);
  const DrivenStand driven = driven_with_warnings(command, the_case);
  warn_of_slopes(driven.dynamics);
  dynamics::ExchangedStand stand = exchanged_stand(driven, exported_model(driven, the_case));
  stand.name                     = name;
  const auto files               = exchange_files(format, stand, path);
  if (!command.force_overwrite)
    require_own_companions(format, files);
  std::string names;
  for (const ExportedFile &file : files)
    names += (names.empty() ? "" : ", ") + file.path;
  write_together(files, format == ExportFormat::statespace ? path : command.output.empty() ? "out" : "");
  if (command.output.empty())
    say_name(the_case, name);
  if (!command.quiet)
    console::print(fmt::format("{}: {}, {}\n", format == ExportFormat::statespace ? path : names, stand.method,
                               stand.origin));
}
}  // namespace

int export_command(const CommandLine &command, const Case &the_case)
{
  const bool unit = format_of(command) == ExportFormat::fmu;
  if (!run_kind(the_case).driven && !(unit && std::holds_alternative<ChatterCase>(the_case.spec)))
    throw InputError("millstand export " + command.format + ": kind = \"" + the_case.kind +
                     "\" has no stand that a force can drive (" + the_case.path + "); it exports cases of kind " +
                     (unit ? "four-high, lumped, cluster and chatter" : "four-high, lumped and cluster"));
  if (unit)
    export_unit(command, the_case);
  else
    export_matrices(command, the_case);
  return 0;
}
}  // namespace mill
