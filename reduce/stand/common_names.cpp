#include "reduce/stand/mode_names.h"
#include "reduce/stand/mode_verdict.h"
#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <set>
#include <utility>

namespace mill::reduce {
namespace {
/// Modes of all models under one number each, joined to groups of one mode.
class CommonModes {
public:
  explicit CommonModes(const std::vector<std::size_t> &mode_numbers)
  {
    for (const std::size_t n : mode_numbers) {
      first.push_back(model_of.size());
      model_of.insert(model_of.end(), n, first.size() - 1);
    }
    group.resize(model_of.size());
    std::iota(group.begin(), group.end(), std::size_t(0));
  }
  std::size_t number(const std::size_t model, const std::size_t mode) const
  {
    return first[model] + mode;
  }
  /// A group has one mode of each model: a link that would bring in a second one is left out.
  void join(const std::size_t a, const std::size_t b)
  {
    const std::size_t from = group[b], to = group[a];
    std::set<std::size_t> models;
    for (std::size_t i = 0; i < group.size(); ++i)
      if ((group[i] == from || group[i] == to) && from != to && !models.insert(model_of[i]).second)
        return;
    std::replace(group.begin(), group.end(), from, to);
  }
  /// Model and mode that gives the name: of the most detailed model of the group.
  std::pair<std::size_t, std::size_t> leader(const std::size_t model, const std::size_t mode) const
  {
    const std::size_t own_group = group[number(model, mode)];
    const auto lead             = std::size_t(std::find(group.begin(), group.end(), own_group) - group.begin());
    return {model_of[lead], lead - first[model_of[lead]]};
  }

private:
  std::vector<std::size_t> first, model_of, group;
};

CommonModes common_modes(const std::vector<const StandWithModes *> &stands,
                         const std::vector<ModelLikeness> &likeness)
{
  std::vector<std::size_t> mode_numbers;
  for (const StandWithModes *stand : stands)
    mode_numbers.push_back(std::size_t(stand->modes.frequency.size()));
  CommonModes common(mode_numbers);
  struct Link {
    double mac;
    std::size_t a, b;
  };
  std::vector<Link> links;
  for (const ModelLikeness &pair : likeness)
    for (Eigen::Index i = 0; i < pair.mac.rows(); ++i)
      for (Eigen::Index j = 0; j < pair.mac.cols(); ++j)
        if (pair.mac(i, j) > same_mode)
          links.push_back({pair.mac(i, j), common.number(pair.detailed, std::size_t(i)),
                           common.number(pair.other, std::size_t(j))});
  std::stable_sort(links.begin(), links.end(), [](const Link &x, const Link &y) { return x.mac > y.mac; });
  for (const Link &link : links)
    common.join(link.a, link.b);
  return common;
}
}  // namespace

std::vector<std::vector<ModeName>> common_names(const std::vector<const StandWithModes *> &stands,
                                                const std::vector<ModelLikeness> &likeness)
{
  const CommonModes common = common_modes(stands, likeness);
  std::vector<std::vector<ModeName>> own, names;
  for (const StandWithModes *stand : stands)
    own.push_back(own_names(*stand));
  for (std::size_t m = 0; m < stands.size(); ++m) {
    std::vector<ModeName> mine = own[m];
    std::vector<bool> common_one(mine.size(), false);
    std::set<std::string> keys;
    for (std::size_t k = 0; k < mine.size(); ++k) {
      const auto [model, mode] = common.leader(m, k);
      if (model == m)
        continue;
      const ModeName theirs = names[model][mode];
      const bool agree      = own[model][mode].key == mine[k].key;
      common_one[k]         = true;
      keys.insert(theirs.key);
      if (!agree) {
        mine[k].own     = mine[k].name;
        mine[k].decided = fmt::format("mode {} of {}: {}; by its own shares {}: {}", mode + 1,
                                      stands[model]->model.name, theirs.decided, mine[k].name, mine[k].decided);
      }
      mine[k].name = theirs.name;
      mine[k].key  = theirs.key;
    }
    number_names(mine, common_one, std::move(keys));
    names.push_back(std::move(mine));
  }
  return names;
}
}  // namespace mill::reduce
