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
}  // namespace

std::vector<Group> chatter_groups(const Run &run)
{
  std::vector<Group> groups;
  for (const Result &result : run.results) {
    const bool chatter = is_made_by(chatter_first, result.name);
    if (!chatter && !is_made_by(bite_first, result.name))
      continue;
    const std::string name = result_id(result.name)->place("pass");
    const std::string title =
        std::string(chatter ? "Chatter" : "Bite") + (name == tandem_item ? ", " : ", condition ") + name;
    const auto known =
        std::find_if(groups.begin(), groups.end(), [&](const Group &group) { return group.title == title; });
    if (known == groups.end())
      groups.push_back({title, {&result}});
    else
      known->results.push_back(&result);
  }
  std::stable_partition(groups.begin(), groups.end(),
                        [](const Group &group) { return group.title.rfind("Chatter", 0) == 0; });
  return groups;
}
}  // namespace mill::report
