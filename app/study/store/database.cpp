#include "app/study/store/database.h"
#include "core/base/errors.h"
#include "core/base/files.h"
#include <cstring>
#include <filesystem>
#include <sqlite3.h>

namespace fs = std::filesystem;

namespace mill {
struct Database::Implementation {
  std::string path;
  sqlite3 *file = nullptr;
};

struct Statement::Implementation {
  sqlite3_stmt *statement = nullptr;
  sqlite3 *file           = nullptr;
  std::string path;
};

namespace {
[[noreturn]] void refuse(sqlite3 *file, const int code, const std::string &path)
{
  const int primary        = code & 0xff;
  const std::string reason = file ? sqlite3_errmsg(file) : sqlite3_errstr(code);
  const std::string text   = path + ": " + reason;
  if (primary == SQLITE_FULL)
    throw SystemError(text + "; what was finished before is kept: make room and run the same command again");
  if (primary == SQLITE_CORRUPT || primary == SQLITE_NOTADB)
    throw InputError(text + "; the file is damaged");
  throw SystemError(text);
}

// SQLite wants to undo what a killed writer has begun.
bool has_cut_transaction(sqlite3 *file)
{
  return (sqlite3_exec(file, "SELECT count(*) FROM sqlite_master", nullptr, nullptr, nullptr) & 0xff) ==
         SQLITE_READONLY;
}
}  // namespace

Database::Database(std::string path, const Open how) : implementation(std::make_unique<Implementation>())
{
  implementation->path = std::move(path);
  const int flags      = how == Open::read ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  const int code       = sqlite3_open_v2(implementation->path.c_str(), &implementation->file, flags, nullptr);
  if (code != SQLITE_OK) {
    const std::string reason = implementation->file ? sqlite3_errmsg(implementation->file) : sqlite3_errstr(code);
    sqlite3_close(implementation->file);
    implementation->file = nullptr;
    throw SystemError(implementation->path + " cannot be opened: " + reason);
  }
  sqlite3_busy_timeout(implementation->file, 60000);
  if (how == Open::write)
    execute("PRAGMA journal_mode=DELETE; PRAGMA synchronous=FULL");
  else if (how == Open::write_aside)
    execute("PRAGMA journal_mode=MEMORY; PRAGMA synchronous=FULL");
  else if (has_cut_transaction(implementation->file))
    open_copy();
}

// A reader never writes into the file of another process: the cut transaction is undone in a copy, which has no
// name from then on, so that nothing is left of a reader that is killed.
void Database::open_copy()
{
  sqlite3_close(implementation->file);
  implementation->file   = nullptr;
  const std::string copy = (fs::temp_directory_path() / ("millstand-rows-" + random_name() + ".db")).string();
  std::error_code error, ignored;
  fs::copy_file(implementation->path, copy, error);
  if (!error)
    fs::copy_file(implementation->path + "-journal", copy + "-journal", error);
  const bool undone =
      !error &&
      sqlite3_open_v2(copy.c_str(), &implementation->file, SQLITE_OPEN_READWRITE, nullptr) == SQLITE_OK &&
      !has_cut_transaction(implementation->file);
  for (const char *ending : {"", "-journal"})
    fs::remove(copy + ending, ignored);
  if (!undone) {
    sqlite3_close(implementation->file);
    implementation->file = nullptr;
    throw SystemError(implementation->path + " cannot be copied to " + copy +
                      ", which undoes its cut transaction");
  }
}

Database::~Database()
{
  if (!implementation)
    return;
  sqlite3_close(implementation->file);
}

Database::Database(Database &&) noexcept = default;

const std::string &Database::path() const
{
  return implementation->path;
}

void Database::execute(const std::string &sql)
{
  const int code = sqlite3_exec(implementation->file, sql.c_str(), nullptr, nullptr, nullptr);
  if (code != SQLITE_OK)
    refuse(implementation->file, code, implementation->path);
}

Statement Database::prepare(const std::string &sql)
{
  auto made      = std::make_unique<Statement::Implementation>();
  made->file     = implementation->file;
  made->path     = implementation->path;
  const int code = sqlite3_prepare_v2(implementation->file, sql.c_str(), -1, &made->statement, nullptr);
  if (code != SQLITE_OK)
    refuse(implementation->file, code, implementation->path);
  return Statement(std::move(made));
}

Statement::Statement(std::unique_ptr<Implementation> made) : implementation(std::move(made)) {}

Statement::~Statement()
{
  if (implementation)
    sqlite3_finalize(implementation->statement);
}

Statement::Statement(Statement &&) noexcept = default;

Statement &Statement::bind(const int place, const std::int64_t value)
{
  sqlite3_bind_int64(implementation->statement, place + 1, value);
  return *this;
}

Statement &Statement::bind(const int place, const std::string &text)
{
  sqlite3_bind_text(implementation->statement, place + 1, text.data(), int(text.size()), SQLITE_TRANSIENT);
  return *this;
}

Statement &Statement::bind(const int place, const std::vector<double> &numbers)
{
  sqlite3_bind_blob(implementation->statement, place + 1,
                    numbers.empty() ? "" : static_cast<const void *>(numbers.data()), int(8 * numbers.size()),
                    SQLITE_TRANSIENT);
  return *this;
}

bool Statement::step()
{
  const int code = sqlite3_step(implementation->statement);
  if (code != SQLITE_ROW && code != SQLITE_DONE)
    refuse(implementation->file, code, implementation->path);
  return code == SQLITE_ROW;
}

void Statement::run()
{
  while (step()) {
  }
  sqlite3_reset(implementation->statement);
}

std::int64_t Statement::integer(const int column) const
{
  return sqlite3_column_int64(implementation->statement, column);
}

std::string Statement::text(const int column) const
{
  const auto *bytes = reinterpret_cast<const char *>(sqlite3_column_text(implementation->statement, column));
  return bytes ? std::string(bytes, std::size_t(sqlite3_column_bytes(implementation->statement, column))) : "";
}

std::vector<double> Statement::numbers(const int column) const
{
  const void *bytes = sqlite3_column_blob(implementation->statement, column);
  std::vector<double> values(std::size_t(sqlite3_column_bytes(implementation->statement, column)) / 8);
  if (bytes)
    std::memcpy(values.data(), bytes, 8 * values.size());
  return values;
}

Transaction::Transaction(Database &opened) : file(opened)
{
  file.execute("BEGIN IMMEDIATE");
}

Transaction::~Transaction()
{
  if (!open)
    return;
  try {
    file.execute("ROLLBACK");
  } catch (const InputError &) {  // a full disk has undone it already
  }
}

void Transaction::commit()
{
  file.execute("COMMIT");
  open = false;
}
}  // namespace mill
