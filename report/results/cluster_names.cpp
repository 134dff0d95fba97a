#include "core/records/cluster_names.h"
#include "core/base/digits.h"
#include "core/records/result_words.h"
#include "core/records/schedule_record.h"
#include "report/results/names.h"
#include <map>

// The results of a run of kind "cluster" in words, in the order in which a reader asks for them.
namespace mill::report {
namespace {
const std::map<std::string, std::string> quantity_words{
    {"force", "force"},
    {"approach", "approach of the axes"},
    {"tangent", "tangent dF/d\u03b4"},
    {"secant", "secant F/\u03b4"},
    {"x", "displacement along the rolling direction"},
    {"y", "displacement upwards"},
    {"buckling_factor", "factor on the force at which the stack buckles"},
    {"leaving_force", "horizontal force at which a contact opens"},
    {"least_guide", "smallest stiffness of the guide"},
    {"velocity", "velocity amplitude under the dynamic force"},
    {"acceleration", "acceleration amplitude under the dynamic force"},
    {"roller_load", "load of one roller of the support"},
    {"mode", "natural frequency"}};

bool leads(const std::vector<std::string> &parts)
{
  const auto third = choice_named<ResultWord>(parts[2]);
  return parts[1] == cluster_fit || third == ResultWord::mode || third == ResultWord::buckling_factor ||
         third == ResultWord::leaving_force || (third == ResultWord::force && parts.size() == 3);
}
}  // namespace

std::string cluster_meaning(const std::string &name)
{
  const auto parts = parts_of(name);
  if (parts.size() < 3 || parts[0] != family::cluster)
    return "";
  if (const std::string of_pass = schedule_meaning(parts[2]); parts.size() == 3 && !of_pass.empty())
    return parts[1] == schedule_subject ? of_pass : parts[1] + ", " + of_pass;
  std::string text = parts[1] == cluster_fit ? "fitted in variant " + parts[2] : parts[1];
  for (std::size_t i = parts[1] == cluster_fit ? 3 : 2; i < parts.size(); ++i) {
    const std::string &part = parts[i];
    const auto known        = quantity_words.find(part);
    if (parts[1] == cluster_fit)
      text += (i == 3 ? ", " : ".") + part;
    else if (parts.size() == 3 && is_word(part, ResultWord::force))
      text += ", rolling force";
    else if (parts.size() == 3 && part[0] == 'f' && is_digits(part.substr(1)))
      text += ", natural frequency " + part.substr(1);
    else if (i + 1 == parts.size() && parts.size() == 5)
      text += (is_word(parts[2], ResultWord::roller_load) ? ", roller " : " along ") +
              part;  // cluster.PASS.velocity.W.y
    else
      text += ", " + (known == quantity_words.end() ? part : known->second);
  }
  return text;
}

std::vector<Group> cluster_groups(const Run &run)
{
  std::vector<Group> groups;
  for (const Result &result : run.results) {
    const auto parts = parts_of(result.name);
    if (parts.size() < 3 || parts[0] != family::cluster || !leads(parts))
      continue;
    const std::string title = parts[1] == cluster_fit ? "Fitted, variant " + parts[2] : "Stack under " + parts[1];
    if (groups.empty() || groups.back().title != title)
      groups.push_back({title, {}});
    groups.back().results.push_back(&result);
  }
  return groups;
}
}  // namespace mill::report
