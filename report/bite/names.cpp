#include "report/results/names.h"
#include "report/page/curves.h"
#include <algorithm>

// The results of a run of kind "bite" in the order in which one asks for them.
namespace mill::report {
bool is_of_one_model(const std::string &name)
{
  return is_of(name, family::bite) && parts_of(name).size() == 4 && parts_of(name)[1] != bite_fit;
}

std::vector<Group> bite_groups(const Run &run)
{
  std::vector<Group> groups{{"Stiffness between the work rolls", {}}};
  for (const Result &result : run.results) {
    if (is_of(result.name, family::bite_spring))
      groups.front().results.push_back(&result);
    if (!is_of(result.name, family::bite) || is_of_one_model(result.name))
      continue;
    const bool fit          = parts_of(result.name)[1] == bite_fit;
    const std::string title = fit ? "Fit to measured values" : "Bite of " + parts_of(result.name)[1];
    if (groups.back().title != title)
      groups.push_back({title, {}});
    groups.back().results.push_back(&result);
  }
  return groups;
}
}  // namespace mill::report
