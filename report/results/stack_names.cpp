#include "core/records/result_words.h"
#include "core/records/rows_of_stack.h"
#include "report/results/names.h"

// The results of a run of kind "stack" in the order in which a reader asks for them.
namespace mill::report {
namespace {
const ResultRow *const pair_first[]{&row::pair::force, &row::pair::q_max, &row::pair::peak_pressure};
}  // namespace

std::vector<Group> stack_groups(const Run &run)
{
  std::vector<Group> groups{
      {"Strip and stack", {}}, {"Contacts of the rolls", {}}, {"What moves the profile", {}}};
  for (const Result &result : run.results) {
    if (is_made_by(row::stack::all, result.name))
      groups[0].results.push_back(&result);
    if (is_made_by(pair_first, result.name))
      groups[1].results.push_back(&result);
    if (is_made_by(row::influence::all, result.name) &&
        result_id(result.name)->place("profile") == word_of(ResultWord::crown))
      groups[2].results.push_back(&result);
  }
  return groups;
}
}  // namespace mill::report
