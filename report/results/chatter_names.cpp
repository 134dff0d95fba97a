#include "core/records/result_words.h"
#include "report/page/curves.h"
#include "report/results/names.h"
#include <algorithm>

// The results of a run of kind "chatter", in words and in the order in which one asks for them.
namespace mill::report {
namespace {
struct ChatterWords {
  const char *name;
  const char *meaning;
};
const ChatterWords words[] = {
    {"critical_speed", "roll speed at which vibration begins to grow"},
    {"critical_speed_highest", "the same by the most stable model of the stand"},
    {"critical_speed_low", "lower end of its 95 % interval"},
    {"critical_speed_high", "upper end of its 95 % interval"},
    {"frequency", "frequency of the critical mode"},
    {"gap_mode_frequency", "frequency of the gap mode at the working speed"},
    {"gap_mode_damping", "damping of the gap mode at the working speed, of critical"},
    {"growth_rate", "growth rate at the working speed"},
    {"working_frequency", "frequency of the least stable mode at the working speed"},
    {"unstable_roots", "roots that grow at the working speed, both of a pair"},
    {"margin", "growth rate nearest to the other verdict"},
    {"margin_speed", "roll speed at which that is"},
    {"lowest_speed_with_bite", "lowest roll speed with a steady bite"},
    {"work_roll_ratio", "amplitude of the upper over that of the lower work roll"},
    {"force_phase", "phase of the force against the gap"},
    {"entry_tension_phase", "phase of the back tension against the gap"},
    {"exit_tension_phase", "phase of the front tension against the gap"},
    {"friction_phase", "phase of the friction against the gap"},
    {"process_damping", "damping that strip and bite take away (positive) or add"},
    {"limit_cycle_amplitude", "limit cycle, half the gap's peak to peak"},
    {"limit_cycle_frequency", "limit cycle, frequency"},
    {"critical_speed_without_delay", "the same with shared tension alone"},
    {"speed_stable_for_any_distance", "roll speed that is stable whatever the distance of the stands"},
    {"friction_slope", "relative change of the friction per relative change of"},
    {"speed_slope", "relative change of the critical speed per relative change of"},
    {"P", "speed of the strip at the entry, derivative by"},
    {"Q", "speed of the strip at the exit, derivative by"},
    {"F", "roll force, derivative by"},
    {"gap", "gap"},
    {"gap_rate", "opening rate of the gap"},
    {"entry_tension", "back tension"},
    {"exit_tension", "front tension"},
    {"entry_thickness", "entry thickness"},
};

std::string words_of_part(const std::string &part)
{
  const auto result =
      std::find_if(std::begin(words), std::end(words), [&](const ChatterWords &w) { return part == w.name; });
  return result == std::end(words) ? part : result->meaning;
}
}  // namespace

std::string chatter_meaning(const std::string &name)
{
  const std::size_t first = name.find('.'), second = name.find('.', first + 1);
  if (first == std::string::npos || second == std::string::npos)
    return "";
  const std::string subject = name.substr(0, first);
  std::string meaning       = subject + ", " + name.substr(first + 1, second - first - 1),
              rest          = name.substr(second + 1);
  const bool derivative =
      rest.size() > 2 && rest[1] == '.' && std::string("PQF").find(rest[0]) != std::string::npos;
  if (subject != family::chatter && !(subject == family::bite && derivative))
    return "";
  for (std::string joint = ", "; !rest.empty();) {
    const std::size_t dot  = rest.find('.');
    const std::string part = rest.substr(0, dot);
    meaning += joint + words_of_part(part);
    rest  = dot == std::string::npos ? "" : rest.substr(dot + 1);
    joint = derivative ? " " : ", ";
    if (ends_with(part, "_slope") && !rest.empty())
      return meaning + " " + rest;  // a key of the case
  }
  return meaning;
}

bool is_slope_by_one_input(const std::string &name)
{
  const auto parts = parts_of(name);
  const auto third = parts.size() > 3 ? choice_named<ResultWord>(parts[2]) : std::nullopt;
  return parts[0] == family::chatter && (third == ResultWord::friction_slope || third == ResultWord::speed_slope);
}

namespace {
const char *const asked_first[] = {
    "critical_speed", "critical_speed_highest", "frequency",       "growth_rate", "margin", "force",
    "friction",       "film_thickness",         "flattened_radius"};
}  // namespace

std::vector<Group> chatter_groups(const Run &run)
{
  std::vector<Group> groups;
  for (const Result &result : run.results) {
    const bool chatter = is_of(result.name, family::chatter);
    if (!chatter && !is_of(result.name, family::bite))
      continue;
    const std::size_t start = result.name.find('.') + 1, end = result.name.find('.', start);
    if (end == std::string::npos || std::find(std::begin(asked_first), std::end(asked_first),
                                              result.name.substr(end + 1)) == std::end(asked_first))
      continue;
    const std::string name = result.name.substr(start, end - start);
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
