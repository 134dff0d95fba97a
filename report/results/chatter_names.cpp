#include "core/records/rows_of_bite.h"
#include "core/records/rows_of_chatter.h"
#include "report/page/curves.h"
#include "report/results/names.h"
#include <algorithm>

// The results of a run of kind "chatter", in words and in the order in which one asks for them.
namespace mill::report {
bool is_slope_by_one_input(const std::string &name)
{
  const auto id = result_id(name);
  return id && (id->is_of(row::chatter::friction_slope) || id->is_of(row::chatter::speed_slope));
}

namespace {
const ResultRow *const chatter_first[]{&row::chatter::critical_speed, &row::chatter::critical_speed_highest,
                                       &row::chatter::frequency, &row::chatter::growth_rate,
                                       &row::chatter::margin};
const ResultRow *const bite_first[]{&row::bite::force, &row::bite::friction, &row::bite::film_thickness,
                                    &row::bite::flattened_radius};

// Results of these rows by condition, "Chatter, condition 2".
template <std::size_t n>
std::vector<Group> groups_of(const Run &run, const char *subject, const ResultRow *const (&rows)[n])
{
  std::vector<Group> groups;
  for (const Result &result : run.results) {
    const auto id = result_id(result.name);
    if (!id || !id->is_of(rows))
      continue;
    const std::string name  = id->place("pass");
    const std::string title = subject + std::string(name == tandem_item ? ", " : ", condition ") + name;
    const auto known =
        std::find_if(groups.begin(), groups.end(), [&](const Group &group) { return group.title == title; });
    if (known == groups.end())
      groups.push_back({title, {&result}});
    else
      known->results.push_back(&result);
  }
  return groups;
}
}  // namespace

std::vector<Group> condition_groups(const Run &run)
{
  return groups_of(run, "Chatter", chatter_first);
}

std::vector<Group> chatter_groups(const Run &run)
{
  std::vector<Group> groups = condition_groups(run);
  for (const Group &group : groups_of(run, "Bite", bite_first))
    groups.push_back(group);
  return groups;
}
}  // namespace mill::report
