#include "report/page/names.h"
#include <algorithm>

// The results of a run of kind "bite" in the order in which one asks for them.
namespace mill::report {
bool is_of_one_model(const std::string &name)
{
  return name.rfind("bite.", 0) == 0 && std::count(name.begin(), name.end(), '.') == 3;
}

std::vector<Group> bite_groups(const Run &run)
{
  std::vector<Group> groups{
      {"Stiffness between the work rolls", {}}
  };
  for (const Result &result : run.results) {
    if (result.name.rfind("K4", 0) == 0)
      groups.front().results.push_back(&result);
    if (result.name.rfind("bite.", 0) != 0 || is_of_one_model(result.name))
      continue;
    const std::string title = "Bite of " + result.name.substr(5, result.name.find('.', 5) - 5);
    if (groups.back().title != title)
      groups.push_back({title, {}});
    groups.back().results.push_back(&result);
  }
  return groups;
}
}  // namespace mill::report
