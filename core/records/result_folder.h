#pragma once
#include <functional>
#include <string>
#include <vector>

// A result folder shows one run.  The files of a new run are collected in a folder of their own inside the result
// folder until one rename makes that folder a journal, DIR/.publishing: before this rename the result folder holds
// the earlier run, after it the new one.  The journal is carried out at once.  Where that was interrupted, the
// next program that opens the folder completes it, whether it writes or only reads (WholeRun).  First every file
// of the earlier run is moved away, then the new files are moved into place, so that files of two runs are never
// visible together, wherever it stops.  Files that no run writes are not touched.  A result folder may be a
// symbolic link: it is followed.
namespace mill {
/// Files and folders that a run may leave at the top of its folder; results.json first.
const std::vector<std::string> &result_names();

/// Holds the folder for one process: runs that end together publish one after the other, and a reader sees a whole
/// folder.  The kernel keeps the lock and releases it when the process ends.
class FolderLock {
public:
  explicit FolderLock(const std::string &directory);  ///< waits for its turn
  ~FolderLock();
  FolderLock(const FolderLock &)            = delete;
  FolderLock &operator=(const FolderLock &) = delete;
  bool held() const;  ///< false: no such folder, or its file system knows no locks

private:
  int folder;
  bool locked;
};

/// std::rename, or its substitute in a test: 0, or -1 and errno.
using Rename = std::function<int(const char *from, const char *to)>;

/// @throws SystemError  folders of the earlier run belong to another user and could not be moved away
void require_replaceable(const std::string &directory, const std::vector<std::string> &names = result_names());

/// Replaces the earlier run by the entries of `staged`, a folder inside `directory`, that are in `names`,
/// and removes `staged`.  The caller holds the folder's lock.
/// @param names  what a folder of this kind may hold at its top, the file that says it is whole first
/// @throws SystemError  with path and reason; until the switch the earlier results are unchanged, from then on the
/// new
///                      ones are complete in DIR/.publishing and finish_publishing() moves them into place
void publish_results(const std::string &staged, const std::string &directory, const Rename &rename = {},
                     const std::vector<std::string> &names = result_names());

/// Carries out the journal that an interrupted run left in a folder; does nothing where there is no journal.  The
/// caller holds the folder's lock.  @throws SystemError  with path and reason; may be called again
void finish_publishing(const std::string &directory, const Rename &rename = {});

/// Holds a folder while files of its run are read: a run that publishes now is waited for, and the journal of an
/// interrupted one is carried out first.  One process holds a folder once.
/// @throws InputError  there is a journal and it cannot be carried out, for instance in a folder that is
/// read-only: no
///                     run is complete there
class WholeRun {
public:
  explicit WholeRun(const std::string &directory);

private:
  FolderLock lock;
};

/// A folder DIR/.run-<random> in which a run collects its files.  It belongs to a living process as long as the
/// lock on its file .lock is held, in any container and by any user.
class Staging {
public:
  /// Created while the caller holds the folder's lock.  @throws InputError  it cannot be created
  explicit Staging(const std::string &directory);
  ~Staging();  ///< removes what was not published
  Staging(const Staging &)            = delete;
  Staging &operator=(const Staging &) = delete;
  const std::string &path() const;

private:
  std::string folder;
  int lock;
};

/// Is this the name of a staging folder?
bool is_staging(const std::string &name);

/// Removes the staging folders of runs that are no longer alive and their temporary files; one that may belong to
/// a living run stays.  The caller holds the folder's lock.
void remove_leftovers(const std::string &directory);
}  // namespace mill
