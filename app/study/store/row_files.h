#pragma once
#include "app/study/store/database.h"
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

// Rows of a study on the disk.  Each process writes one file of its own,
// DIR/rows/<shard>-<host>-<pid>-<random>.db, and reads those of others; nothing is written by two.  A row is known
// by its key, the hash of its resolved case.
namespace mill {
/// A row that is over: results in the order of the study's watched names, or the sentence of its failure.
struct FinishedRow {
  std::int64_t key = 0;
  std::vector<double> results;  ///< in the units of the study; NaN: not given; empty where the row failed
  std::string failure;
};

/// The file of this process.
class RowFile {
public:
  /// Creates it.  @throws SystemError
  explicit RowFile(const std::string &path);
  const std::string &path() const;
  /// In one transaction: rows that are over, and rows that are started now with the number of the attempt.
  /// @throws SystemError  a full disk; everything before this call is kept
  void commit(const std::vector<FinishedRow> &finished, const std::map<std::int64_t, int> &started);

private:
  Database file;
};

/// What is read of one file.
struct ReadRows {
  std::size_t damaged     = 0;  ///< rows whose checksum is wrong: computed again
  std::int64_t last_place = 0;  ///< of the last row, for the next reading
  std::string fault;            ///< the file is damaged from here on; empty: it is not
};

/// Reads the rows of a file behind a place, in the order in which they were written.
/// @throws what `take` throws; a fault of the file is in the answer
ReadRows read_rows(const std::string &path, std::int64_t after, const std::function<void(FinishedRow &&)> &take);

/// Number of rows in a file; 0 where it cannot be read now.
long rows_in(const std::string &path);

/// Keys of rows that a file has begun and not finished.
std::vector<std::int64_t> begun_rows(const std::string &path);

/// Name of the file by which a process says that it crashed by itself, and was not killed from outside.
std::string crash_mark(const std::string &row_file);

/// Files of rows of a study; only those of one shard where it is named ("3-of-8").
std::vector<std::string> row_files(const std::string &folder, const std::string &shard = "");

/// Name for a new file.  @param shard  "3-of-8"
std::string new_row_file(const std::string &folder, const std::string &shard);

/// DIR/finished.db, all rows of all files, each key once; what it lacks of them is added.  Files that cannot be
/// read and rows with a wrong checksum are named in the answer and left out.
/// @throws SystemError
std::vector<std::string> merge_rows(const std::string &folder);

/// Path of the merged rows; it need not exist.
std::string merged_file(const std::string &folder);
}  // namespace mill
