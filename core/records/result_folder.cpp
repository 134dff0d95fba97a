#include "core/records/result_folder.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <set>
#include <sstream>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace mill {
namespace {
const std::string staging_prefix = ".run-";
const char *const journal_name   = ".publishing";  // folder of a run between its switch and its end
const char *const list_name      = ".names";       // in the journal: the names that the run has, one on each line
const char *const replaced_name  = ".replaced";    // in the journal: names that such a folder may hold, likewise
const char *const lock_name      = ".lock";        // in a staging folder: its owner holds the lock of this file

bool lock(const int file, const int how)
{
  return file >= 0 && lock_file(file, how);
}

// Is there such an entry?  Where the system gives no answer, this throws.
bool exists(const std::string &path)
{
  struct stat status {};
  if (::lstat(path.c_str(), &status) == 0)
    return true;
  if (errno == ENOENT || errno == ENOTDIR)
    return false;
  refuse_file(errno, Place{path}, std::string("cannot be inspected: ") + std::strerror(errno));
}

std::string with_remedy(const std::string &directory, const std::string &reason)
{
  return reason + "; the new results are complete in " + directory + "/" + journal_name + ", `millstand report " +
         directory + "` moves them into place";
}

std::string lines_of(const std::vector<std::string> &names)
{
  std::string text;
  for (const std::string &name : names)
    text += name + "\n";
  return text;
}

// The name of an entry of a folder, and not a way out of it.
bool is_plain(const std::string &name)
{
  return !name.empty() && name[0] != '.' && name.find('/') == std::string::npos;
}

// Repeats a rename that a signal interrupted.
int moved(const Rename &rename, const std::string &from, const std::string &to)
{
  int failed = 0;
  do
    failed = rename ? rename(from.c_str(), to.c_str()) : std::rename(from.c_str(), to.c_str());
  while (failed && errno == EINTR);
  return failed;
}

// A journal that is being carried out.
struct Journal {
  const std::string directory;
  const Rename &rename;
  std::string path = directory + "/" + journal_name;

  void move(const std::string &from, const std::string &to) const
  {
    if (moved(rename, from, to) != 0)
      refuse_file(errno, Place{to},
                  with_remedy(directory, std::string("cannot be written: ") + std::strerror(errno)));
  }

  std::vector<std::string> listed(const char *list) const
  {
    const auto text = text_if_readable(path + "/" + list);
    if (!text)
      throw InputError(Place{path}, "is not the journal of a run: it has no readable list " + std::string(list) +
                                        "; move it out of the way");
    std::vector<std::string> names;
    std::istringstream lines(*text);
    for (std::string line; std::getline(lines, line);)
      if (is_plain(line))
        names.push_back(line);
    return names;
  }
  std::set<std::string> names() const
  {
    const auto names = listed(list_name);
    return {names.begin(), names.end()};
  }
  // A journal without this list is of a run.
  std::vector<std::string> replaced() const
  {
    return exists(path + "/" + replaced_name) ? listed(replaced_name) : result_names();
  }

  // Moves away every entry that is not of the new run, the one that says the folder is whole first.
  void clear(const std::set<std::string> &names, const std::vector<std::string> &all) const
  {
    const std::string earlier = path + "/.earlier-" + random_name();
    if (::mkdir(earlier.c_str(), 0777) != 0)
      refuse_file(errno, Place{earlier},
                  with_remedy(directory, std::string("cannot be created: ") + std::strerror(errno)));
    for (const std::string &name : all) {
      const bool placed = names.count(name) && !exists(path + "/" + name);
      if (!placed && exists(directory + "/" + name))
        move(directory + "/" + name, earlier + "/" + name);
    }
  }

  // Moves the new entries into place, the same one last: a folder that has it is complete.
  void place(const std::set<std::string> &names, const std::vector<std::string> &all) const
  {
    for (auto name = all.rbegin(); name != all.rend(); ++name)
      if (names.count(*name) && exists(path + "/" + *name))
        move(path + "/" + *name, directory + "/" + *name);
  }
};

// Names of the staged run; an empty folder is not one of them.
std::vector<std::string> staged_names(const std::string &staged, const std::vector<std::string> &all)
{
  std::vector<std::string> names;
  for (const std::string &name : all) {
    const std::string path = staged + "/" + name;
    if (exists(path) && !(fs::is_directory(path) && names_in(path).empty()))
      names.push_back(name);
  }
  return names;
}

void sync_with_content(const std::string &path)
{
  if (fs::is_directory(fs::symlink_status(path)))
    for (const std::string &name : names_in(path))
      sync_with_content(path + "/" + name);
  sync_to_disk(path);
}

// The folder itself, also where its name is a symbolic link.
void sync_folder(const std::string &directory)
{
  sync_to_disk(directory + "/.");
}

void sync_all(const std::string &staged, const std::vector<std::string> &names)
{
  for (const std::string &name : names)
    sync_with_content(staged + "/" + name);
  sync_folder(staged);
}
}  // namespace

const std::vector<std::string> &result_names()
{
  static const std::vector<std::string> names{"results.json",
                                              "report.html",
                                              "run.json",
                                              "resolved.toml",
                                              "lumped_model.toml",
                                              "lumped_model-beam.toml",
                                              "lumped_model-craig-bampton.toml",
                                              "lumped_model-six-of-beam.toml",
                                              "lumped_model-six-of-craig-bampton.toml",
                                              "campbell.csv",
                                              "millstand.log",
                                              "curves",
                                              "response",
                                              "fields",
                                              "models"};
  return names;
}

FolderLock::FolderLock(const std::string &directory)
    : folder(open_file(directory, O_RDONLY | O_DIRECTORY)), locked(lock(folder, LOCK_EX))
{
}

FolderLock::~FolderLock()
{
  if (folder >= 0)
    ::close(folder);
}

bool FolderLock::held() const
{
  return locked;
}

void finish_publishing(const std::string &directory, const Rename &rename)
{
  const Journal journal{directory, rename};
  if (!exists(journal.path))
    return;
  const auto names = journal.names();
  const auto all   = journal.replaced();
  journal.clear(names, all);
  journal.place(names, all);
  sync_folder(directory);
  const std::string done = directory + "/" + staging_prefix + random_name();
  journal.move(journal.path, done);  // the end of the journal; remove_leftovers() removes what stays of it
  remove_folder(done);
}

void require_replaceable(const std::string &directory, const std::vector<std::string> &names)
{
  for (const std::string &name : names) {
    const std::string path = directory + "/" + name;
    std::error_code ignored;
    if (fs::is_directory(fs::symlink_status(path, ignored)) && ::access(path.c_str(), W_OK) != 0)
      refuse_file(errno, Place{path},
                  std::string("cannot be replaced: ") + std::strerror(errno) +
                      "; the earlier results are unchanged, choose another folder with -o");
  }
}

void publish_results(const std::string &staged, const std::string &directory, const Rename &rename,
                     const std::vector<std::string> &all)
{
  finish_publishing(directory, rename);  // of a run that ended here before
  require_replaceable(directory, all);
  const auto names = staged_names(staged, all);
  write_atomically(staged + "/" + replaced_name, lines_of(all));
  write_atomically(staged + "/" + list_name, lines_of(names));
  sync_all(staged, names);
  const std::string journal = directory + "/" + journal_name;
  if (moved(rename, staged, journal) != 0)
    refuse_file(errno, Place{directory},
                std::string("cannot be written: ") + std::strerror(errno) +
                    "; the earlier results are unchanged, choose another folder with -o");
  sync_folder(directory);
  finish_publishing(directory, rename);
}

WholeRun::WholeRun(const std::string &directory) : lock(directory.empty() ? "." : directory)
{
  const std::string folder = directory.empty() ? "." : directory;
  if (!exists(folder + "/" + journal_name))
    return;
  std::string reason = "this file system has no locks, so that the run may still be at work";
  if (lock.held())
    try {
      finish_publishing(folder);
      return;
    } catch (const SystemError &error) {
      reason = error.what();
    }
  throw InputError("a run was interrupted while it replaced the results in " + folder +
                   ", and the replacement cannot be completed (" + reason + "); `millstand report " + folder +
                   "` completes it where the folder may be written");
}

Staging::Staging(const std::string &directory) : folder(directory + "/" + staging_prefix + random_name()), lock(-1)
{
  if (::mkdir(folder.c_str(), 0777) == 0)
    lock = open_file(folder + "/" + lock_name, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW);
  if (lock < 0) {
    const int error = errno;
    ::rmdir(folder.c_str());
    refuse_file(error, "the folder " + directory + " cannot be created: " + std::strerror(error) +
                           "; choose another with -o");
  }
  mill::lock(lock, LOCK_EX | LOCK_NB);  // where there are no locks, nothing is ever removed either
}

Staging::~Staging()
{
  remove_folder(folder);
  ::close(lock);
}

const std::string &Staging::path() const
{
  return folder;
}

bool is_staging(const std::string &name)
{
  return name.rfind(staging_prefix, 0) == 0;
}

void remove_leftovers(const std::string &directory)
{
  remove_stale_parts(directory);
  std::error_code error;
  for (const std::string &entry : names_in(directory, error)) {
    if (!is_staging(entry))
      continue;
    const std::string staging = directory + "/" + entry, name = staging + "/" + lock_name;
    int file = open_file(name, O_RDWR | O_NOFOLLOW | O_NONBLOCK);
    if (file < 0 && errno == EACCES)
      file = open_file(name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK);
    const bool dead = file < 0 ? errno == ENOENT : lock(file, LOCK_EX | LOCK_NB);
    if (dead)
      remove_folder(staging);
    if (file >= 0)
      ::close(file);
  }
}
}  // namespace mill
