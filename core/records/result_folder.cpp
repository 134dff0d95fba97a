#include "core/records/result_folder.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/base/uninterrupted.h"
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
const char *const list_name      = ".names";       // in it: which names the run has, one a line
const char *const lock_name      = ".lock";        // in a staging folder: its owner holds it

bool lock(const int file, const int how)
{
  return file >= 0 && lock_file(file, how);
}

// Is there such an entry?  Not knowing is not a no.
bool stands(const std::string &path)
{
  struct stat found {};
  if (::lstat(path.c_str(), &found) == 0)
    return true;
  if (errno == ENOENT || errno == ENOTDIR)
    return false;
  refuse_file(errno, Place{path}, std::string("cannot be looked at: ") + std::strerror(errno));
}

std::string said_with_remedy(const std::string &directory, const std::string &why)
{
  return why + "; the new results are complete in " + directory + "/" + journal_name + ", `millstand report " +
         directory + "` puts them in their places";
}

// An interrupted rename is made again.
int moved(const Rename &rename, const std::string &from, const std::string &to)
{
  int failed = 0;
  do
    failed = rename ? rename(from.c_str(), to.c_str()) : std::rename(from.c_str(), to.c_str());
  while (failed && errno == EINTR);
  return failed;
}

// One journal while it is carried out.
struct Journal {
  const std::string directory;
  const Rename &rename;
  std::string path = directory + "/" + journal_name;

  void move(const std::string &from, const std::string &to) const
  {
    if (moved(rename, from, to) != 0)
      refuse_file(errno, Place{to},
                  said_with_remedy(directory, std::string("cannot be written: ") + std::strerror(errno)));
  }

  std::set<std::string> names() const
  {
    const auto text = text_if_readable(path + "/" + list_name);
    if (!text)
      throw InputError(Place{path}, "is not the journal of a run: it has no readable list " +
                                        std::string(list_name) + "; move it out of the way");
    std::set<std::string> names;
    std::istringstream lines(*text);
    for (std::string line; std::getline(lines, line);)
      names.insert(line);
    return names;
  }

  // Every entry that is not of the new run leaves, results.json first.
  void clear(const std::set<std::string> &names) const
  {
    const std::string earlier = path + "/.earlier-" + random_name();
    if (::mkdir(earlier.c_str(), 0777) != 0)
      refuse_file(errno, Place{earlier},
                  said_with_remedy(directory, std::string("cannot be made: ") + std::strerror(errno)));
    for (const std::string &name : result_names()) {
      const bool placed = names.count(name) && !stands(path + "/" + name);
      if (!placed && stands(directory + "/" + name))
        move(directory + "/" + name, earlier + "/" + name);
    }
  }

  // results.json last: a folder that has one is whole.
  void place(const std::set<std::string> &names) const
  {
    for (auto name = result_names().rbegin(); name != result_names().rend(); ++name)
      if (names.count(*name) && stands(path + "/" + *name))
        move(path + "/" + *name, directory + "/" + *name);
  }
};

// Names of the staged run; an empty folder is none.
std::vector<std::string> staged_names(const std::string &staged)
{
  std::vector<std::string> names;
  for (const std::string &name : result_names()) {
    const std::string path = staged + "/" + name;
    if (stands(path) && !(fs::is_directory(path) && fs::is_empty(path)))
      names.push_back(name);
  }
  return names;
}

void sync_all(const std::string &staged, const std::vector<std::string> &names)
{
  for (const std::string &name : names) {
    const std::string path = staged + "/" + name;
    if (fs::is_directory(path))
      for (const auto &entry : fs::recursive_directory_iterator(path))
        sync_to_disk(entry.path().string());
    sync_to_disk(path);
  }
  sync_to_disk(staged);
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
    : folder(uninterrupted([&] { return ::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); })),
      locked(lock(folder, LOCK_EX))
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
  if (!stands(journal.path))
    return;
  const auto names = journal.names();
  journal.clear(names);
  journal.place(names);
  sync_to_disk(directory);
  const std::string done = directory + "/" + staging_prefix + random_name();
  journal.move(journal.path, done);  // the end of the journal; what is left of it belongs to nobody
  std::error_code ignored;
  fs::remove_all(done, ignored);
}

void require_replaceable(const std::string &directory)
{
  for (const std::string &name : result_names()) {
    const std::string path = directory + "/" + name;
    std::error_code ignored;
    if (fs::is_directory(fs::symlink_status(path, ignored)) && ::access(path.c_str(), W_OK) != 0)
      refuse_file(errno, Place{path},
                  std::string("cannot be replaced: ") + std::strerror(errno) +
                      "; the earlier results are as they were, choose another folder with -o");
  }
}

void publish_results(const std::string &staged, const std::string &directory, const Rename &rename)
{
  finish_publishing(directory, rename);  // of a run that ended here before
  require_replaceable(directory);
  const auto names = staged_names(staged);
  std::string list;
  for (const std::string &name : names)
    list += name + "\n";
  write_atomically(staged + "/" + list_name, list);
  sync_all(staged, names);
  const std::string journal = directory + "/" + journal_name;
  if (moved(rename, staged, journal) != 0)
    refuse_file(errno, Place{directory},
                std::string("cannot be written: ") + std::strerror(errno) +
                    "; the earlier results are as they were, choose another folder with -o");
  sync_to_disk(directory);
  finish_publishing(directory, rename);
}

void require_published(const std::string &directory)
{
  const std::string folder = directory.empty() ? "." : directory;
  const FolderLock alone(folder);  // a run that publishes now is waited for
  if (stands(folder + "/" + journal_name))
    throw InputError("a run was interrupted while its results took their places in " + folder +
                     "; `millstand report " + folder + "` puts them there");
}

Staging::Staging(const std::string &directory) : folder(directory + "/" + staging_prefix + random_name()), lock(-1)
{
  if (::mkdir(folder.c_str(), 0777) == 0)
    lock = uninterrupted([&] {
      return ::open((folder + "/" + lock_name).c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    });
  if (lock < 0) {
    const int error = errno;
    ::rmdir(folder.c_str());
    refuse_file(error, "the folder " + directory + " cannot be made: " + std::strerror(error) +
                           "; choose another with -o");
  }
  mill::lock(lock, LOCK_EX | LOCK_NB);  // where there are no locks, nothing is ever removed either
}

Staging::~Staging()
{
  std::error_code ignored;
  fs::remove_all(folder, ignored);
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
  for (const auto &entry : fs::directory_iterator(directory, error)) {
    if (!is_staging(entry.path().filename().string()))
      continue;
    const std::string name = (entry.path() / lock_name).string();
    int file = uninterrupted([&] { return ::open(name.c_str(), O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC); });
    if (file < 0 && errno == EACCES)
      file = uninterrupted([&] { return ::open(name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC); });
    const bool dead = file < 0 ? errno == ENOENT : lock(file, LOCK_EX | LOCK_NB);
    if (dead)
      fs::remove_all(entry.path(), error);
    if (file >= 0)
      ::close(file);
  }
}
}  // namespace mill
