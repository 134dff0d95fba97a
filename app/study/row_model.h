#pragma once
#include "app/command/option_words.h"
#include "app/run/driven_stand.h"
#include "core/base/parameter.h"
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace mill {
struct Case;
struct CommandLine;

struct RowModelSettings {
  ModelKind kind = ModelKind::full;
  std::string cache;           ///< folder of condensed rolls that all rows share
  bool fresh         = false;  ///< full: ignore what the cache held before the first row
  int threads        = 1;      ///< full: inside one row
  double cache_limit = 0;      ///< bytes of the cache after each full row; 0: no limit
  bool keep          = false;  ///< full: the folder of a sample holds all files of the row
};

/// Bytes of --cache-limit; 0: not given.  @throws InputError
double cache_limit(const CommandLine &command);

using NamedResults = std::vector<std::pair<std::string, Parameter>>;

/// Results of a case, row by row.  A row starts from what the cache keeps of rolls, contacts and bearings and
/// never from the row before it, so that its numbers do not depend on the order.
class RowModel {
public:
  explicit RowModel(RowModelSettings settings);
  ~RowModel();

  /// Chooses the least work that gives every watched result, by computing the base case.
  /// @param watched  names of results; empty: the usual ones of the kind are chosen
  /// @return the names, with the results of the base case
  /// @throws InputError  a name that the case does not give, with the nearest one; SolverError of the base case
  NamedResults choose(const Case &base, std::vector<std::string> watched);

  /// All results of one case by the chosen work.  Quick rows may be computed by several threads at once.
  /// @param sample  full: folder that holds results.json of this row afterwards; empty: none
  /// @throws InputError, SolverError
  NamedResults results(const Case &row, const std::string &sample = "");

  /// What the full model does for a row, "stiffness", "modes"; "closed forms" for the quick one.
  std::string work() const;
  void choose_work(const std::string &work);  ///< as work() has named it

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation;
};
}  // namespace mill
