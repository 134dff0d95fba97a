#include "app/output_dir.h"
#include "core/errors.h"
#include "core/files.h"
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace mill {
namespace {
// Name of the case a folder belongs to; empty when it is no folder of a run.
std::string owner_of(const std::string &directory)
{
  const std::string manifest = directory + "/run.json";
  if (!fs::exists(manifest))
    return "";
  const auto json = nlohmann::json::parse(read_text(manifest), nullptr, false);
  return json.is_object() ? json.value("case", "") : "";
}

// Everything a run may leave at the top of its folder.
const char *const files[]   = {"resolved.toml",
                               "results.json",
                               "lumped_model.toml",
                               "lumped_model-beam.toml",
                               "lumped_model-craig-bampton.toml",
                               "run.json",
                               "millstand.log",
                               "report.html"};
const char *const folders[] = {"curves", "response", "fields"};

bool is_staging(const fs::path &entry)
{
  return entry.filename().string().rfind(".run-", 0) == 0;
}

// Nothing but what an interrupted run left behind.
bool is_free(const std::string &directory)
{
  std::error_code error;
  for (const auto &entry : fs::directory_iterator(directory, error))
    if (!is_staging(entry.path()) && entry.path().filename() != "cache")
      return false;
  return true;
}

// Staging folders of runs that are no longer alive.
void remove_leftovers(const std::string &directory)
{
  std::error_code error;
  for (const auto &entry : fs::directory_iterator(directory, error))
    if (is_staging(entry.path())) {
      const int pid = std::atoi(entry.path().filename().string().substr(5).c_str());
      if (pid > 0 && ::kill(pid, 0) != 0)
        fs::remove_all(entry.path(), error);
    }
}

// Runs of one case that end together publish one after the other, and one that starts sees a whole folder. The
// lock is the kernel's and goes with the process; a file system that knows no locks leaves the renames unguarded,
// as they were.
class PublishLock {
public:
  explicit PublishLock(const std::string &directory)
      : folder(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC))
  {
    if (folder >= 0)
      ::flock(folder, LOCK_EX);
  }
  ~PublishLock()
  {
    if (folder >= 0)
      ::close(folder);
  }
  PublishLock(const PublishLock &)            = delete;
  PublishLock &operator=(const PublishLock &) = delete;

private:
  int folder;
};
}  // namespace

OutputDir::OutputDir(std::string path, const Case &of, const bool overwrite)
    : directory(std::move(path)), staged(directory + "/.run-" + std::to_string(::getpid()))
{
  std::error_code error;
  if (fs::exists(directory, error) && !fs::is_directory(directory, error))
    throw InputError(directory + " is a file, not a folder; choose another with -o");
  const PublishLock complete(directory);  // no run is in the middle of publishing here
  if (fs::exists(directory, error) && !is_free(directory) && !overwrite) {
    const std::string owner = owner_of(directory);
    if (owner.empty())
      throw InputError("the folder " + directory +
                       " holds files that no run wrote; choose another with -o, or give --force-overwrite");
    if (owner != of.name)
      throw InputError("the folder " + directory + " holds the results of the case '" + owner +
                       "'; choose another with -o, or give --force-overwrite");
  }
  remove_leftovers(directory);
  for (const char *part : {"", "/curves", "/response", "/fields"}) {
    fs::create_directories(staged + part, error);
    if (error)
      throw InputError("the folder " + directory + " cannot be made: " + error.message() +
                       "; choose another with -o");
  }
}

OutputDir::~OutputDir()
{
  std::error_code ignored;
  fs::remove_all(staged, ignored);
}

const std::string &OutputDir::path() const
{
  return directory;
}

const std::string &OutputDir::staging() const
{
  return staged;
}

std::string OutputDir::file(const std::string &name) const
{
  return staged + "/" + name;
}

void OutputDir::write(const std::string &name, const std::string &text) const
{
  write_atomically(file(name), text);
}

void OutputDir::publish() const
{
  const PublishLock alone(directory);
  std::error_code error;
  const auto fail = [&](const std::string &name) {
    throw InputError(directory + "/" + name + " cannot be written: " + error.message() +
                     "; choose another folder with -o");
  };
  for (const char *folder : folders) {
    const std::string target = directory + "/" + folder, old = staged + "/." + folder;
    if (fs::exists(target, error))
      fs::rename(target, old, error);
    if (!error && !fs::is_empty(file(folder), error))
      fs::rename(file(folder), target, error);
    if (error)
      fail(folder);
    fs::remove_all(old, error);
  }
  for (const char *name : files) {
    const std::string target = directory + "/" + name;
    if (fs::exists(file(name), error))
      fs::rename(file(name), target, error);
    else
      fs::remove(target, error);
    if (error)
      fail(name);
  }
}

void check_file_names(const Case &the_case)
{
  std::vector<Pass> passes;
  if (const auto *stand = std::get_if<FourHigh>(&the_case.spec))
    passes = stand->passes;
  if (const auto *lumped = std::get_if<Lumped>(&the_case.spec))
    passes = lumped->passes;
  if (const auto *bite = std::get_if<BiteCase>(&the_case.spec))
    passes = bite->passes;
  std::map<std::string, Pass> written;  // file name -> pass that writes it
  std::vector<Problem> problems;
  for (const Pass &pass : passes) {
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
