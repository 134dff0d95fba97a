#include "report/results/names.h"
#include "core/base/choice.h"
#include "core/records/open_rows.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_bearing.h"
#include <algorithm>

// The results of a run of kind "bearing" in the order in which one asks for them.
namespace mill::report {
namespace {
enum class BearingGroup { stiffness, rows, rollers, from_rollers, motion, film, rating, others };
constexpr auto words_of(BearingGroup)
{
  return choice_words<BearingGroup>("Stiffness of one bearing", "Rows", "Rollers",
                                    "From one roller to the bearing", "A mass on the bearing", "Oil film",
                                    "Ratings and life", "Others");
}

const ResultRow *const of_rows[]{&row::bearing::row_share, &row::bearing::row_axial};
const ResultRow *const of_rollers[]{&row::bearing::roller_secant,  &row::bearing::roller_tangent,
                                    &row::bearing::roller_max,     &row::bearing::heaviest_angle,
                                    &row::bearing::loaded_rollers, &row::bearing::rib_max};
const ResultRow *const from_rollers[]{&row::bearing::load_that_fits_tangent, &row::bearing::load_that_fits_secant,
                                      &row::bearing::rollers_times_Z5, &row::bearing::rollers_times_stribeck};

BearingGroup group_of(const std::string &name)
{
  const auto id = result_id_or_open(name);
  if (!id)
    return BearingGroup::others;
  if (id->is_of(row::film::all) || id->is_of(row::open::film))
    return BearingGroup::film;
  if (id->is_of(row::rating::all) || id->is_of(row::open::rating))
    return BearingGroup::rating;
  if (id->is_of(row::motion::all))
    return BearingGroup::motion;
  if (id->is_of(row::open::one_bearing))
    return BearingGroup::stiffness;
  if (family::bearing != id->place("bearing_spring"))
    return BearingGroup::others;
  return id->is_of(of_rows)        ? BearingGroup::rows
         : id->is_of(of_rollers)   ? BearingGroup::rollers
         : id->is_of(from_rollers) ? BearingGroup::from_rollers
                                   : BearingGroup::stiffness;
}
}  // namespace

std::vector<Group> bearing_groups(const Run &run)
{
  std::vector<Group> groups;
  for (const char *title : words_of(BearingGroup()))
    groups.push_back({title, {}});
  for (const Result &result : run.results)
    groups[std::size_t(group_of(result.name))].results.push_back(&result);
  groups.erase(std::remove_if(groups.begin(), groups.end(), [](const Group &g) { return g.results.empty(); }),
               groups.end());
  return groups;
}
}  // namespace mill::report
