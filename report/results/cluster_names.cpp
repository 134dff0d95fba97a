#include "core/records/rows_of_cluster.h"
#include "report/results/names.h"

// The results of a run of kind "cluster" in the order in which a reader asks for them.
namespace mill::report {
namespace {
const ResultRow *const stack_first[]{&row::cluster::fit, &row::cluster::mode, &row::cluster::buckling_factor,
                                     &row::cluster::leaving_force, &row::cluster::force};
}  // namespace

std::vector<Group> cluster_groups(const Run &run)
{
  std::vector<Group> groups;
  for (const Result &result : run.results) {
    if (!is_made_by(stack_first, result.name))
      continue;
    const ResultId id = *result_id(result.name);
    const std::string title =
        id.is_of(row::cluster::fit) ? "Fitted, variant " + id.place("variant") : "Stack under " + id.place("pass");
    if (groups.empty() || groups.back().title != title)
      groups.push_back({title, {}});
    groups.back().results.push_back(&result);
  }
  return groups;
}
}  // namespace mill::report
