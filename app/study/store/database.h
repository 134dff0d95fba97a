#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

// One SQLite file, for one process.  Rollback journal and a full sync at every commit: what is committed is on the
// disk, and a file that was cut at any moment shows the state of its last commit.
namespace mill {
class Statement;

class Database {
public:
  enum class Open {
    read,
    write,
    write_aside  ///< a file that is thrown away when its writer ends early: its journal is in memory
  };
  /// @throws SystemError  disk or permission refuse it; InputError  not a file of SQLite
  Database(std::string path, Open how);
  ~Database();
  Database(Database &&) noexcept;

  void execute(const std::string &sql);
  Statement prepare(const std::string &sql);
  const std::string &path() const;

private:
  friend class Statement;
  struct Implementation;
  void open_copy();
  std::unique_ptr<Implementation> implementation;
};

/// A prepared statement; parameters and columns are numbered from 0.
class Statement {
public:
  ~Statement();
  Statement(Statement &&) noexcept;
  Statement &bind(int place, std::int64_t value);
  Statement &bind(int place, const std::string &text);
  Statement &bind(int place, const std::vector<double> &numbers);  ///< as bytes, eight for each number
  /// The next row; false at the end.  @throws SystemError  full or failing disk; InputError  a damaged file
  bool step();
  void run();  ///< step() to the end, and ready to be bound again
  std::int64_t integer(int column) const;
  std::string text(int column) const;
  std::vector<double> numbers(int column) const;

private:
  friend class Database;
  struct Implementation;
  explicit Statement(std::unique_ptr<Implementation> made);
  std::unique_ptr<Implementation> implementation;
};

/// BEGIN to COMMIT; without commit() everything since then is undone.
class Transaction {
public:
  explicit Transaction(Database &file);
  ~Transaction();
  void commit();

private:
  Database &file;
  bool open = true;
};
}  // namespace mill
