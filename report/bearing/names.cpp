#include "report/results/names.h"
#include <algorithm>

// The results of a run of kind "bearing" in the order in which one asks for them.
namespace mill::report {
namespace {
struct Place {
  const char *begin, *end;  // how the name goes on after "Kzc." and how it ends; empty: any
  int group;
};
// The first entry that matches is taken.
const Place places[] = {
    {"motion.", "", 4},
    {"load_that_fits", "", 3},
    {"rollers_times", "", 3},
    {"row", "_share", 1},
    {"row", "_axial", 1},
    {"row", "", 1},
    {"roller", "", 2},
    {"heaviest", "", 2},
    {"loaded_rollers", "", 2},
    {"rib_", "", 2},
    {"", "", 0},
};
const char *const titles[] = {
    "Stiffness of one bearing", "Rows",     "Rollers",          "From one roller to the bearing",
    "A mass on the bearing",    "Oil film", "Ratings and life", "Others"};

bool fits(const Place &place, const std::string &name)
{
  const std::string begin = place.begin, end = place.end;
  return name.size() >= begin.size() + end.size() && name.compare(0, begin.size(), begin) == 0 &&
         name.compare(name.size() - end.size(), end.size(), end) == 0;
}
}  // namespace

std::vector<Group> bearing_groups(const Run &run)
{
  std::vector<Group> groups;
  for (const char *title : titles)
    groups.push_back({title, {}});
  const std::string prefix = "Kzc.";
  for (const Result &result : run.results) {
    if (result.name.rfind(prefix, 0) != 0) {
      const bool film  = result.name.find(".film.") != std::string::npos;
      const bool rated = result.name.rfind("bearing.", 0) == 0;
      groups[groups.size() - (film ? 3 : rated ? 2 : 1)].results.push_back(&result);
      continue;
    }
    const std::string name = result.name.substr(prefix.size());
    const auto *place =
        std::find_if(std::begin(places), std::end(places), [&](const Place &p) { return fits(p, name); });
    groups[std::size_t(place->group)].results.push_back(&result);
  }
  groups.erase(std::remove_if(groups.begin(), groups.end(), [](const Group &g) { return g.results.empty(); }),
               groups.end());
  return groups;
}
}  // namespace mill::report
