#include "app/twin/calibrate/freed_unknowns.h"
#include "core/base/choice.h"
#include "core/base/errors.h"
#include "core/case/fields.h"
#include <algorithm>
#include <cmath>

namespace mill {
namespace {
const twin::Unknown *find_unknown(const std::vector<twin::Unknown> &all, const std::string &name)
{
  const auto unknown =
      std::find_if(all.begin(), all.end(), [&](const twin::Unknown &u) { return u.name == name; });
  return unknown == all.end() ? nullptr : &*unknown;
}

const twin::Unknown *part_of_stand(const PriorChain &prior, const std::string &name)
{
  const twin::Unknown *spring = find_unknown(prior.springs, name);
  return spring && twin::moves(*spring) == twin::Moves::parts ? spring : find_unknown(prior.masses, name);
}

std::vector<std::string> ratio_names(const PriorChain &prior)
{
  std::vector<std::string> names;
  for (Eigen::Index i = 0; i < prior.stand.damping.size(); ++i)
    names.push_back(twin::ratio_name(i));
  return names;
}

/// Springs and masses of the frame, as groups: "K1/K7", "M1/M6".
std::vector<std::string> frame_groups(const PriorChain &prior)
{
  const auto group = [&](const std::vector<std::string> &names) {
    std::string text;
    for (const std::string &name : names)
      if (part_of_stand(prior, name))
        text += (text.empty() ? "" : "/") + name;
    return text;
  };
  std::vector<std::string> groups{group({"K1", "K7"}),
                                  group({"M1", "M6", "mass upper frame", "mass lower frame"})};
  groups.erase(std::remove(groups.begin(), groups.end(), ""), groups.end());
  return groups;
}

// Words of --free that stand for several unknowns.
enum class FreedGroup { springs, masses, ratios, frame };
constexpr auto words_of(FreedGroup)
{
  return choice_words<FreedGroup>("springs", "masses", "ratios", "frame");
}

std::vector<std::string> names_of(const PriorChain &prior, const std::string &word)
{
  const auto group = choice_named<FreedGroup>(word);
  if (!group)
    return {word};
  if (*group == FreedGroup::ratios)
    return ratio_names(prior);
  if (*group == FreedGroup::frame)
    return frame_groups(prior);
  std::vector<std::string> names;
  for (const twin::Unknown &unknown : *group == FreedGroup::springs ? prior.springs : prior.masses)
    if (twin::moves(unknown) == twin::Moves::parts)
      names.push_back(unknown.name);
  return names;
}

/// Names that --free knows, for a suggestion.
std::vector<std::string> known_names(const PriorChain &prior)
{
  std::vector<std::string> known = word_list<FreedGroup>();
  for (const auto *all : {&prior.springs, &prior.masses})
    for (const twin::Unknown &unknown : *all)
      known.push_back(unknown.name);
  for (const std::string &name : ratio_names(prior))
    known.push_back(name);
  return known;
}

/// An unknown with its prior; of a group the widest prior of its members.
twin::Unknown unknown_of(const PriorChain &prior, const std::string &name, const std::string &list)
{
  if (const twin::Unknown *one = find_unknown(prior.springs, name))
    return *one;
  const auto ratios = ratio_names(prior);
  if (std::find(ratios.begin(), ratios.end(), name) != ratios.end())
    return {name, std::log(2.0), 0};
  twin::Unknown group{name, 0, 0};
  for (const std::string &member : twin::members_of(name)) {
    const twin::Unknown *part = part_of_stand(prior, member);
    if (!part)
      throw InputError("--free \"" + list + "\": the stand has no unknown \"" + member + "\"" +
                       suggestion(member, known_names(prior)));
    group.prior_sd = std::max(group.prior_sd, part->prior_sd);
  }
  return group;
}

std::string trimmed(std::string text)
{
  text.erase(0, text.find_first_not_of(' '));
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

void require_once(const std::vector<twin::Unknown> &unknowns, const std::string &name, const std::string &list)
{
  for (const std::string &member : twin::members_of(name))
    for (const twin::Unknown &before : unknowns) {
      const auto members = twin::members_of(before.name);
      if (std::find(members.begin(), members.end(), member) != members.end())
        throw InputError("--free \"" + list + "\": " + member + " appears twice");
    }
}
}  // namespace

std::vector<twin::Unknown> freed_unknowns(const PriorChain &prior, const std::string &list,
                                          const bool force_recorded)
{
  if (list.empty()) {
    std::vector<twin::Unknown> unknowns = prior.springs;
    const auto damping                  = unknowns.end() - 1;  // the damping stays the last one
    std::vector<twin::Unknown> stated;
    for (const twin::Unknown &mass : prior.masses)
      if (force_recorded && std::find(prior.stated.begin(), prior.stated.end(), mass.name) != prior.stated.end())
        stated.push_back(mass);
    unknowns.insert(damping, stated.begin(), stated.end());
    return unknowns;
  }
  std::vector<twin::Unknown> unknowns;
  for (const std::string &word : split(list, ","))
    for (const std::string &name : names_of(prior, trimmed(word))) {
      require_once(unknowns, name, list);
      unknowns.push_back(unknown_of(prior, name, list));
    }
  return unknowns;
}
}  // namespace mill
