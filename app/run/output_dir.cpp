#include "app/run/output_dir.h"
#include "app/run/run_setup.h"
#include "core/base/errors.h"
#include "core/base/file_ending.h"
#include "core/base/files.h"
#include "core/case/kinds.h"
#include "core/records/run_identity.h"
#include "core/records/source_location.h"
#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>

namespace fs = std::filesystem;

namespace mill {
namespace {
// A text of a JSON file of a folder; empty when it is not there.
std::string text_in(const std::string &file, const char *key)
{
  if (!fs::exists(file))
    return "";
  const auto json  = nlohmann::json::parse(read_text(file), nullptr, false);
  const bool named = json.is_object() && json.contains(key) && json[key].is_string();
  return named ? json[key].get<std::string>() : "";
}

// Nothing but what an interrupted run left behind.
bool is_free(const std::string &directory)
{
  const auto names = names_in(directory);
  return std::all_of(names.begin(), names.end(),
                     [](const std::string &name) { return is_staging(name) || name == usual_cache; });
}
}  // namespace

OutputDir::OutputDir(std::string path, const Case &the_case, const bool overwrite, std::string run_id)
    : directory(std::move(path)), id(std::move(run_id))
{
  const auto require = [&](const std::error_code &error) {
    if (error)
      refuse_file(error.value(), "the folder " + directory + " cannot be created: " + error.message() +
                                     "; choose another with -o");
  };
  std::error_code error;
  const fs::file_status status = fs::status(directory, error);
  if (error && status.type() != fs::file_type::not_found)
    refuse_file(error.value(),
                directory + " cannot be inspected: " + error.message() + "; choose another with -o");
  if (fs::exists(status) && !fs::is_directory(status))
    throw InputError(directory + " is a file, not a folder; choose another with -o");
  fs::create_directories(directory, error);
  require(error);
  target = fs::canonical(directory, error).string();
  require(error);
  const FolderLock alone(target);  // no run is in the middle of publishing here
  finish_publishing(target);
  if (!is_free(directory) && !overwrite) {
    const std::string manifest = directory + "/run.json";
    const std::string owner    = text_in(manifest, "case");
    if (owner.empty())
      throw InputError("the folder " + directory +
                       " holds files that no run wrote; choose another with -o, or give --force-overwrite");
    if (owner != the_case.name)
      throw InputError("the folder " + directory + " holds the results of the case '" + owner +
                       "'; choose another with -o, or give --force-overwrite");
    if (const std::string other = other_source(manifest, the_case.path); !other.empty())
      throw InputError("the folder " + directory + " holds the results of another case file of this name, " +
                       other + "; choose another with -o, or give --force-overwrite");
  }
  require_replaceable(target);
  if (alone.held())
    remove_leftovers(target);
  staged = std::make_unique<Staging>(target);
  for (const char *part : {"curves", "response", "fields", "models"}) {
    fs::create_directory(file(part), error);
    require(error);
  }
}

const std::string &OutputDir::path() const
{
  return directory;
}

const std::string &OutputDir::run_id() const
{
  return id;
}

const std::string &OutputDir::staging() const
{
  return staged->path();
}

std::string OutputDir::file(const std::string &name) const
{
  return staging() + "/" + name;
}

void OutputDir::write(const std::string &name, const std::string &text) const
{
  if (has_ending(name, FileEnding::toml))
    write_atomically(file(name), run_id_line(id) + text);
  else
    write_atomically(file(name), text);
  if (is_summed(name)) {
    const std::string sum = hash_of(text);
    const std::lock_guard lock(written->access);
    written->sums[name] = sum;
  }
}

void OutputDir::write_table(const std::string &name, Table table) const
{
  write(name + ".csv", csv_text(table));
  const std::lock_guard lock(written->access);
  written->tables[name] = std::move(table);
}

std::map<std::string, Table> OutputDir::take_tables() const
{
  const std::lock_guard lock(written->access);
  return std::exchange(written->tables, {});
}

std::map<std::string, std::string> OutputDir::checksums() const
{
  const std::lock_guard lock(written->access);
  return checksums_below(staging(), written->sums);
}

void OutputDir::publish() const
{
  const FolderLock alone(target);
  publish_results(staging(), target);
}

void require_result_folder(const std::string &folder, const std::string &proof, const std::string &what,
                           const bool overwrite)
{
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error))
    throw InputError(folder + " is a file, not a folder; choose another with -o");
  fs::create_directories(folder, error);
  if (error)
    refuse_file(error.value(),
                "the folder " + folder + " cannot be made: " + error.message() + "; choose another with -o");
  const WholeRun complete(folder);
  if (!overwrite && !is_free(folder) && !fs::exists(folder + "/" + proof))
    throw InputError("the folder " + folder + " holds files that no " + what +
                     " wrote; choose another with -o, or give --force-overwrite");
}

void replace_results(const std::string &folder, const std::vector<std::string> &names,
                     const std::function<void(const std::string &)> &write)
{
  const FolderLock alone(folder);
  finish_publishing(folder);
  if (alone.held())
    remove_leftovers(folder);
  const Staging staged(folder);
  write(staged.path());
  publish_results(staged.path(), folder, {}, names);
}

void check_file_names(const Case &the_case)
{
  std::map<std::string, Pass> written;  // file name -> pass that writes it
  std::vector<Problem> problems;
  for (const Pass &pass : all_passes(the_case)) {
    if (pass.name.size() > 100)
      problems.push_back(
          {pass.place, "pass.name is longer than 100 characters; it names the files of the pass", {}});
    for (const char *ending : {"", "-spectrum", "-measured"}) {
      const std::string file = "response/" + slug(pass.name) + ending + ".csv";
      if (const auto other = written.find(file); other != written.end()) {
        problems.push_back({pass.place,
                            "pass.name = \"" + pass.name + "\" and \"" + other->second.name + "\" both write " +
                                file + "; rename one of them",
                            {other->second.place}});
        break;
      }
      written[file] = pass;
    }
  }
  if (!problems.empty())
    throw InputError(problems);
}
}  // namespace mill
