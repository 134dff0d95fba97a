#include "app/export_command.h"
#include "app/case_kinds.h"
#include "app/console.h"
#include "app/run_log.h"
#include "app/run_setup.h"
#include "app/stages/exported_stand.h"
#include "core/case/visible_text.h"
#include "core/model/case.h"
#include "core/records/files.h"
#include "fmu/archive.h"
#include "fmu/embedded.h"
#include "fmu/unit_archive.h"
#include <filesystem>
#include <fmt/format.h>

namespace fs = std::filesystem;

namespace mill {
namespace {
// Folder for what the stages write and nobody keeps.
class ScratchFolder {
public:
  ScratchFolder() : path_((fs::temp_directory_path() / ("millstand-export-" + random_name())).string()) {}
  ~ScratchFolder()
  {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const std::string &path() const
  {
    return path_;
  }

private:
  std::string path_;
};

// Is it the archive of an earlier export of the same model?
bool is_earlier_export(const std::string &path, const std::string &identifier)
{
  const auto bytes = text_if_readable(path);
  if (!bytes)
    return false;
  try {
    for (const fmu::ArchiveEntry &entry : fmu::entries_of(*bytes))
      if (entry.name == "modelDescription.xml")
        return entry.bytes.find("modelIdentifier=\"" + identifier + "\"") != std::string::npos;
  } catch (const std::runtime_error &) {
    return false;  // no archive
  }
  return false;
}

void require_output(const std::string &path, const std::string &identifier, const bool overwrite)
{
  if (fs::path(path).extension() != ".fmu")
    throw InputError("-o " + path + ": a functional mock-up unit is an archive whose name ends with .fmu");
  std::error_code error;
  const auto found = fs::status(path, error);
  if (fs::is_directory(found))
    throw InputError("-o " + path + " is a folder; name the archive, for example " + path + "/" + identifier +
                     ".fmu");
  if (fs::exists(found) && !overwrite && !is_earlier_export(path, identifier))
    throw InputError("the file " + path +
                     " exists and is no earlier export of this case; choose another with -o, or "
                     "give --force-overwrite");
}

DrivenStand driven_stand(const CommandLine &command, const Case &the_case)
{
  const ScratchFolder scratch;
  const OutputDir out(scratch.path(), the_case, true, run_id_of(the_case, "export", ""));
  const RunLog log(out, command.log, command.verbose);
  RunContext run{the_case, out, cache_folder(command, scratch.path() + "/cache"), command.fresh};
  open_cache(run, out.staging());
  set_up_threads(run, command);
  run.started = local_time();
  console::ProgressBar bar(run_kind(the_case).stages(the_case), command.quiet);
  run.progress.step  = [&](const std::string &stage, const double fraction) { bar.show(stage, fraction); };
  run.progress.log   = [&](const std::string &line) { log.line(line); };
  DrivenStand driven = run_kind(the_case).driven(run, command.pass);
  bar.finish();
  for (const std::string &warning : run.results.warnings)
    console::say("warning: " + visible(warning, true) + "\n");
  return driven;
}

std::string platforms()
{
  return fmu::named_file("win64").empty()
             ? "Linux; no library for Windows was built with this program (package g++-mingw-w64-x86-64-posix), "
               "build its sources/ there"
             : "Linux and Windows";
}
}  // namespace

int export_command(const CommandLine &command, const Case &the_case)
{
  if (!run_kind(the_case).driven)
    throw InputError("millstand export fmu: kind = \"" + the_case.kind + "\" has no stand that vibrates (" +
                     the_case.path + "); it exports cases of kind four-high and lumped");
  const std::string path = command.output.empty() ? "out/" + the_case.name + ".fmu" : command.output;
  require_output(path, fmu::identifier_of(the_case.name), command.force_overwrite);
  const fmu::ExportedModel model = exported_model(driven_stand(command, the_case), the_case);
  const std::string archive      = fmu::unit_archive(model, command.fmi);
  fmu::check_unit(archive, model, command.fmi);
  if (command.output.empty())
    fs::create_directories("out");
  write_atomically(path, archive);
  if (!command.quiet)
    console::print(
        fmt::format("{}: {}, FMI {}.0 co-simulation, {}\n", path, model.method, command.fmi, platforms()));
  return 0;
}
}  // namespace mill
