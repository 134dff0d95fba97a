#pragma once
#include <functional>
#include <string>
#include <vector>

// A result folder shows one run.  What a new run wrote lies complete in a folder of its own inside the result
// folder until one rename makes it a journal, DIR/.publishing: before that rename the folder holds the earlier
// run, after it the new one.  The journal is carried out at once, or by whoever opens the folder next where that
// was interrupted: first all of the earlier run leaves, then the new files take their places, so that files of two
// runs never stand side by side, whenever it stops.  Files that no run writes are not touched.
namespace mill {
/// What a run may leave at the top of its folder, files and folders; results.json first.
const std::vector<std::string> &result_names();

/// Holds the folder for one process: runs that end together publish one after the other, and a reader sees a whole
/// folder.  The lock is the kernel's and goes with the process.
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

/// std::rename, or what stands in for it in a test: 0, or -1 and errno.
using Rename = std::function<int(const char *from, const char *to)>;

/// @throws SystemError  folders of the earlier run could not leave, being another user's
void require_replaceable(const std::string &directory);

/// Puts what `staged`, a folder inside `directory`, holds under result_names() in the place of the earlier run,
/// and removes `staged`.  The folder's lock is held by the caller.
/// @throws SystemError  with path and reason; until the switch the earlier results are as they were, from then on
/// the
///                     new ones are complete in DIR/.publishing and finish_publishing() puts them in their places
void publish_results(const std::string &staged, const std::string &directory, const Rename &rename = {});

/// Carries out the journal that an interrupted run left in a folder; nothing where there is none.  The folder's
/// lock is held by the caller.  @throws SystemError  with path and reason; may be called again
void finish_publishing(const std::string &directory, const Rename &rename = {});

/// @throws InputError  the folder holds a journal: what is read there may be of the earlier run or missing
void require_published(const std::string &directory);

/// A folder DIR/.run-<random> in which a run collects its files.  It belongs to a living process as long as the
/// lock on its file .lock is held, in whatever container and of whatever user.
class Staging {
public:
  /// Made while the caller holds the folder's lock.  @throws InputError  it cannot be made
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

/// Removes the staging folders of runs that are no longer alive and what they wrote aside; one that cannot be told
/// from a living one stays. The folder's lock is held by the caller.
void remove_leftovers(const std::string &directory);
}  // namespace mill
