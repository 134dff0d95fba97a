#include "app/study/store/row_files.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include <algorithm>
#include <cstdio>
#include <exception>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>
#include <zlib.h>

namespace fs = std::filesystem;

namespace mill {
namespace {
const char *const row_table =
    "CREATE TABLE row(place INTEGER PRIMARY KEY, key INTEGER UNIQUE NOT NULL, results BLOB, "
    "failure TEXT, crc INTEGER NOT NULL);";

// Pages of SQLite have no checksum: this one is over all that the row holds.
std::int64_t checksum(const FinishedRow &row)
{
  uLong sum      = crc32(0, nullptr, 0);
  const auto add = [&](const void *bytes, const std::size_t size) {
    if (size > 0)
      sum = crc32(sum, static_cast<const Bytef *>(bytes), uInt(size));
  };
  add(&row.key, sizeof row.key);
  add(row.results.data(), 8 * row.results.size());
  add(row.failure.data(), row.failure.size());
  return std::int64_t(sum);
}

void insert(Statement &statement, const FinishedRow &row)
{
  statement.bind(0, row.key).bind(1, row.results).bind(2, row.failure).bind(3, checksum(row)).run();
}

Statement insertion(Database &file)
{
  return file.prepare("INSERT OR IGNORE INTO row(key, results, failure, crc) VALUES(?, ?, ?, ?)");
}
}  // namespace

RowFile::RowFile(const std::string &path) : file(path, Database::Open::write)
{
  file.execute(std::string(row_table) + "CREATE TABLE attempt(key INTEGER PRIMARY KEY, number INTEGER NOT NULL)");
}

void RowFile::commit(const std::vector<FinishedRow> &finished, const std::map<std::int64_t, int> &started)
{
  Transaction all(file);
  Statement row = insertion(file), attempt = file.prepare("INSERT OR REPLACE INTO attempt VALUES(?, ?)");
  for (const FinishedRow &one : finished)
    insert(row, one);
  for (const auto &[key, number] : started)
    attempt.bind(0, key).bind(1, std::int64_t(number)).run();
  all.commit();
}

ReadRows read_rows(const std::string &path, const std::int64_t after,
                   const std::function<void(FinishedRow &&)> &take)
{
  ReadRows read;
  read.last_place = after;
  std::exception_ptr not_taken;
  try {
    Database file(path, Database::Open::read);
    Statement rows =
        file.prepare("SELECT place, key, results, failure, crc FROM row WHERE place > ? ORDER BY place");
    rows.bind(0, after);
    while (rows.step()) {
      read.last_place = rows.integer(0);
      FinishedRow row{rows.integer(1), rows.numbers(2), rows.text(3)};
      if (checksum(row) != rows.integer(4)) {
        ++read.damaged;
        continue;
      }
      try {
        take(std::move(row));
      } catch (...) {  // not a fault of this file: a row that was not taken is not passed over
        not_taken = std::current_exception();
        break;
      }
    }
  } catch (const InputError &e) {  // a file that was cut before its first commit has no table
    if (fs::exists(path) && fs::file_size(path) > 0)
      read.fault = e.what();
  }
  if (not_taken)
    std::rethrow_exception(not_taken);
  return read;
}

long rows_in(const std::string &path)
{
  try {
    Database file(path, Database::Open::read);
    Statement last = file.prepare("SELECT max(place) FROM row");
    return last.step() ? long(last.integer(0)) : 0;
  } catch (const InputError &) {  // not yet made
    return 0;
  }
}

std::vector<std::int64_t> begun_rows(const std::string &path)
{
  std::vector<std::int64_t> keys;
  try {
    Database file(path, Database::Open::read);
    Statement rows = file.prepare("SELECT key FROM attempt WHERE key NOT IN (SELECT key FROM row)");
    while (rows.step())
      keys.push_back(rows.integer(0));
  } catch (const InputError &) {  // as above; merging names it
  }
  return keys;
}

std::string crash_mark(const std::string &row_file)
{
  return row_file + ".crashed";
}

const std::string &RowFile::path() const
{
  return file.path();
}

std::vector<std::string> row_files(const std::string &folder, const std::string &shard)
{
  std::vector<std::string> files;
  std::error_code none;
  for (const std::string &name : names_in(folder + "/rows", none))
    if (name.size() > 3 && text_ends_with(name, ".db") && (shard.empty() || name.rfind(shard + "-", 0) == 0))
      files.push_back(folder + "/rows/" + name);
  return files;
}

std::string new_row_file(const std::string &folder, const std::string &shard)
{
  std::error_code error;
  fs::create_directories(folder + "/rows", error);
  if (error)
    refuse_file(error.value(), folder + "/rows cannot be created: " + error.message());
  char host[64] = "";
  ::gethostname(host, sizeof host - 1);
  return fmt::format("{}/rows/{}-{}-{}-{}.db", folder, shard, slug(host), ::getpid(), random_name());
}

std::string merged_file(const std::string &folder)
{
  return folder + "/finished.db";
}

namespace {
std::string damaged_rows(const std::size_t n)
{
  return (n == 1 ? "1 row" : fmt::format("{} rows", n)) + " with a wrong checksum";
}

// How far each file has been merged, by its name.
std::map<std::string, std::int64_t> merged_places(Database &merged)
{
  std::map<std::string, std::int64_t> places;
  Statement rows = merged.prepare("SELECT file, place FROM merged");
  while (rows.step())
    places[rows.text(0)] = rows.integer(1);
  return places;
}

// Rows of the merged file whose checksum is wrong leave it; what their files have of them comes again.
void remove_damaged(Database &merged, const std::string &path, std::vector<std::string> &notes)
{
  std::vector<std::int64_t> damaged;
  {
    Statement rows = merged.prepare("SELECT place, key, results, failure, crc FROM row");
    while (rows.step())
      if (checksum({rows.integer(1), rows.numbers(2), rows.text(3)}) != rows.integer(4))
        damaged.push_back(rows.integer(0));
  }
  if (damaged.empty())
    return;
  Transaction all(merged);
  Statement row = merged.prepare("DELETE FROM row WHERE place = ?");
  for (const std::int64_t place : damaged)
    row.bind(0, place).run();
  merged.execute("DELETE FROM merged");
  all.commit();
  notes.push_back(path + ": " + damaged_rows(damaged.size()) + " removed");
}

// Adds what the files have in addition.
void add_new_rows(Database &merged, const std::vector<std::string> &files, std::vector<std::string> &notes)
{
  const auto places = merged_places(merged);
  Transaction all(merged);
  Statement row = insertion(merged), place = merged.prepare("INSERT OR REPLACE INTO merged VALUES(?, ?)");
  for (const std::string &path : files) {
    const std::string name = fs::path(path).filename().string();
    const auto known       = places.find(name);
    const ReadRows read    = read_rows(path, known == places.end() ? 0 : known->second,
                                       [&](FinishedRow &&finished) { insert(row, finished); });
    if (read.damaged > 0)
      notes.push_back(path + ": " + damaged_rows(read.damaged) + ", computed again");
    if (!read.fault.empty())
      notes.push_back(read.fault + "; the rows behind it are computed again");
    place.bind(0, name).bind(1, read.last_place).run();
  }
  all.commit();
}

// Is a row of the merged file damaged, or the file itself?
bool is_damaged(const std::string &path)
{
  const ReadRows read = read_rows(path, 0, [](FinishedRow &&) {});
  return read.damaged > 0 || !read.fault.empty();
}

bool has_new_rows(const std::string &path, const std::vector<std::string> &files)
{
  if (!fs::exists(path))
    return true;
  Database merged(path, Database::Open::read);
  const auto places = merged_places(merged);
  return std::any_of(files.begin(), files.end(), [&](const std::string &file) {
    const auto known = places.find(fs::path(file).filename().string());
    if (known == places.end())
      return true;
    try {
      Database rows(file, Database::Open::read);
      Statement last = rows.prepare("SELECT max(place) FROM row");
      return last.step() && last.integer(0) > known->second;
    } catch (const InputError &) {
      return false;
    }
  });
}
}  // namespace

// Shows others that whoever writes aside is alive: remove_stale_parts() leaves the file.
class AsideLock {
public:
  explicit AsideLock(const std::string &path) : file(open_file(path, O_RDWR | O_CREAT | O_EXCL))
  {
    if (file >= 0)
      lock_file(file, LOCK_EX);
  }
  ~AsideLock()
  {
    if (file >= 0)
      ::close(file);
  }
  AsideLock(const AsideLock &)            = delete;
  AsideLock &operator=(const AsideLock &) = delete;

private:
  int file;
};

// All of the merged file, or all of the workers' files again where it cannot be read.
void merge_aside(const std::string &path, const std::string &aside, const bool damaged,
                 const std::vector<std::string> &files, std::vector<std::string> &notes)
{
  bool there = fs::exists(path);
  if (there)
    fs::copy_file(path, aside, fs::copy_options::overwrite_existing);
  for (int attempt = 0; attempt < 2; ++attempt) {
    try {
      Database merged(aside, Database::Open::write_aside);
      if (!there)
        merged.execute(std::string(row_table) +
                       "CREATE TABLE merged(file TEXT PRIMARY KEY, place INTEGER NOT NULL)");
      else if (damaged)
        remove_damaged(merged, path, notes);
      add_new_rows(merged, files, notes);
      return;
    } catch (const SystemError &) {
      throw;
    } catch (const InputError &e) {  // damaged pages
      if (!there)
        throw;
      notes.push_back(path + " is damaged and made again from the files of the workers");
      there = false;
      fs::resize_file(aside, 0);
    }
  }
}

// Written aside and renamed, so that two that merge at once leave one whole file.
std::vector<std::string> merge_rows(const std::string &folder)
{
  std::vector<std::string> notes;
  const std::string path = merged_file(folder);
  const auto files       = row_files(folder);
  remove_stale_parts(folder);
  const bool damaged = fs::exists(path) && is_damaged(path);
  if (!damaged && !has_new_rows(path, files))
    return notes;
  const std::string aside = name_aside(path);
  const AsideLock lock(aside);
  try {
    merge_aside(path, aside, damaged, files, notes);
  } catch (...) {
    std::error_code ignored;
    fs::remove(aside, ignored);
    throw;
  }
  std::error_code error;
  fs::rename(aside, path, error);
  if (error)
    refuse_file(error.value(), path + " cannot be written: " + error.message());
  return notes;
}
}  // namespace mill
