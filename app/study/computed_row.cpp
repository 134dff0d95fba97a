#include "app/study/computed_row.h"
#include "app/verbs/checked_case.h"
#include "core/model/case.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <new>

namespace mill {
namespace {
// Rows of closed forms have no folder.
std::string sample_folder(const Study &study, const DesignRow &row)
{
  if (study.model == ModelKind::quick)
    return "";
  return row.row > 0 ? fmt::format("{}/samples/row-{:06}", study.folder, row.row)
                     : fmt::format("{}/samples/search-{:016x}", study.folder, std::uint64_t(row.key));
}
}  // namespace

FinishedRow computed_row(RowModel &model, const Study &study, const DesignRow &design)
{
  FinishedRow row;
  row.key = design.key;
  try {
    const NamedResults results =
        model.results(checked_row(study.case_path, sets_of(study, design.numbers)), sample_folder(study, design));
    for (const WatchedResult &watched : study.watched) {
      const auto entry = std::find_if(results.begin(), results.end(),
                                      [&](const auto &result) { return result.first == watched.name; });
      const bool known = entry != results.end() && std::isfinite(entry->second.value);
      row.results.push_back(known ? entry->second.value : not_given);
      if (!known && row.failure.empty())
        row.failure = "no result " + watched.name +
                      (entry != results.end() && !entry->second.method.empty() ? ": " + entry->second.method : "");
    }
  } catch (const SystemError &) {  // of this machine, not of the row
    throw;
  } catch (const SolverError &e) {
    row.failure = e.report.what;
  } catch (const std::bad_alloc &) {
    row.failure = "not enough memory";
  } catch (const InputError &e) {
    row.failure = e.problems.empty() ? e.what() : e.problems.front().message;
  }
  if (!row.failure.empty())
    row.results.clear();
  return row;
}
}  // namespace mill
