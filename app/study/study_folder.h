#pragma once
#include "app/study/row_model.h"
#include "app/study/spread.h"
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

// A study on the disk: study.toml says what is asked, study.db holds every row before the first is computed.
namespace mill {
struct Case;

/// A result that a study keeps.
struct WatchedResult {
  std::string name, unit, meaning;
  double base           = not_given;  ///< in `unit`, of the base case
  double error_estimate = not_given;  ///< relative, of the base case
  std::vector<double> slopes;         ///< (keys) `unit` per unit of the key, at the means; empty: not known
};

struct Study {
  std::string folder;
  std::string case_path;  ///< absolute
  std::string case_name, title;
  std::vector<std::string> sets;
  std::vector<UncertainKey> keys;
  std::vector<std::string> correlations;  ///< "KEY1,KEY2=0.5"
  std::vector<WatchedResult> watched;
  StudyMethod method = StudyMethod::latin_hypercube;
  long samples       = 0;  ///< as asked for
  int seed           = 1;
  std::string objective;    ///< optimise: name of the watched result
  bool greatest   = false;  ///< optimise: the greatest value is searched, not the least
  ModelKind model = ModelKind::full;
  std::string work;            ///< RowModel::work()
  std::string version;         ///< of the program that made it
  std::string base;            ///< hash of the resolved base case
  double seconds = not_given;  ///< s, of one row in one process, from the base case
  long rows      = 0;          ///< of study.db
};

/// One row of the design.
struct DesignRow {
  std::int64_t place = 0;       ///< in the order of work: rows that share rolls are neighbours
  std::int64_t row   = 0;       ///< number in the design, from 1
  std::int64_t key   = 0;       ///< hash of its resolved case
  std::vector<double> numbers;  ///< (keys), as set_value() takes them
};

/// Rows at the end of the design of `chaos` that are not fitted: a quarter of the others, 20 at least.  Otherwise
/// 0.
long held_out_rows(const Study &study);

/// Text of study.toml.
std::string study_toml(const Study &study);

/// Lines of study.toml that one study has and another has not, some of each; empty: they ask for the same.
std::string differences(const Study &before, const Study &now);

/// Reads DIR/study.toml.  @throws InputError  no study there, or one of another version of the format
Study read_study(const std::string &folder);

/// Writes study.db and then study.toml; @throws SystemError
void write_study(const Study &study, const std::vector<DesignRow> &rows);

/// The rows of study.db from one place to another, in the order of work.
/// @param from, to  first place and the one behind the last
void read_design(const Study &study, std::int64_t from, std::int64_t to,
                 const std::function<void(DesignRow &&)> &take);

/// The same in the order of the design.
void read_design_by_row(const Study &study, const std::function<void(DesignRow &&)> &take);

/// The base case as it is now.
/// @throws InputError  it differs from that of the study; names the lines
Case base_case(const Study &study);

/// Overrides of one row.
std::vector<std::string> sets_of(const Study &study, const std::vector<double> &numbers);

/// Key of a row from its resolved case.
std::int64_t row_key(const Case &row);

/// The same from inputs.  @throws InputError  the case refuses them
std::int64_t row_key_of(const Study &study, const std::vector<double> &inputs);

/// "row 7 (backup_roll.crown = 300 um)"
std::string row_name(const Study &study, const DesignRow &row);

/// Where the rows of shard I of N begin, and where those of the next shard do.
std::pair<std::int64_t, std::int64_t> shard_places(const Study &study, long shard, long of);
}  // namespace mill
