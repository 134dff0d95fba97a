#pragma once
#include "core/base/files.h"
#include "core/records/csv.h"
#include "core/records/result_folder.h"
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace mill {
struct Case;

/// Folder of a run.  Nothing of another case is overwritten by surprise, and what a folder shows belongs to one
/// run: files are written into a staging folder inside it and take the place of the earlier ones together, in
/// publish() (core/records/result_folder.h).
class OutputDir {
public:
  /// Creates the folder and its staging folder with curves/, response/, fields/ and models/; what was staged and
  /// not published goes with this object.
  /// @throws InputError  the folder holds files of another case or of no run (unless `overwrite`), or its name is
  /// wrong
  /// @throws SystemError  disk or permission refuse it
  OutputDir(std::string path, const Case &the_case, bool overwrite, std::string run_id);

  const std::string &path() const;                  ///< of the folder
  const std::string &run_id() const;                ///< of what is staged here (core/records/run_identity.h)
  const std::string &staging() const;               ///< where files are until they are published
  std::string file(const std::string &name) const;  ///< path of a staged file
  void write(const std::string &name, const std::string &text) const;  ///< a TOML file begins with the run_id

  /// A long table as CSV, which the report then need not read again.
  void write_table(const std::string &name, Table table) const;
  /// Those written so far, by name without ".csv"; they are given away.
  std::map<std::string, Table> take_tables() const;
  /// Checksums of the staged files in curves/, response/, fields/ and models/, as checksums_below(); what write()
  /// wrote is not read again.
  std::map<std::string, std::string> checksums() const;

  /// Puts the staged files in the place of those of the earlier run; what that run wrote and this one did not is
  /// removed.
  void publish() const;

private:
  // What stages that run side by side have written.
  struct Written {
    std::mutex access;
    std::map<std::string, std::string> sums;
    std::map<std::string, Table> tables;
  };
  std::string directory, id;
  std::string target;  // the folder itself, where `directory` is a symbolic link or leads through one
  std::unique_ptr<Staging> staged;
  std::unique_ptr<Written> written = std::make_unique<Written>();
};

/// Makes the folder of a verb; one that holds other things is refused.
/// @param proof  file that this verb leaves in its folders, "analysis.json"
/// @param what   "analysis"
/// @throws InputError, SystemError
void require_result_folder(const std::string &folder, const std::string &proof, const std::string &what,
                           bool overwrite);

/// Replaces what a verb left in its folder by new files: all of them, or, where something goes wrong, none.
/// @param names  files and folders that it may leave at the top of its folder, the one it is known by first
/// @param write  (folder) writes the new ones
/// @throws SystemError  with path and reason; the earlier ones are unchanged
void replace_results(const std::string &folder, const std::vector<std::string> &names,
                     const std::function<void(const std::string &)> &write);

/// @throws InputError  two passes whose names lead to the same file names, or a name too long for one
void check_file_names(const Case &the_case);
}  // namespace mill
