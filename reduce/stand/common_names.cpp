#include "reduce/stand/mode_names.h"
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

bool alike_for_the_gap(const double a, const double b)
{
  return a <= same_share * b && b <= same_share * a;
}

CommonModes common_modes(const std::vector<std::vector<GapMotion>> &motions,
                         const std::vector<ModelLikeness> &likeness)
{
  std::vector<std::size_t> mode_numbers;
  for (const auto &modes : motions)
    mode_numbers.push_back(modes.size());
  CommonModes common(mode_numbers);
  struct Link {
    double mac;
    std::size_t a, b;
  };
  std::vector<Link> links;
  for (const ModelLikeness &pair : likeness)
    for (Eigen::Index i = 0; i < pair.mac.rows(); ++i)
      for (Eigen::Index j = 0; j < pair.mac.cols(); ++j)
        if (pair.mac(i, j) > same_mode && alike_for_the_gap(motions[pair.detailed][std::size_t(i)].gap_share,
                                                            motions[pair.other][std::size_t(j)].gap_share))
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
  std::vector<std::vector<GapMotion>> motions;
  for (const StandWithModes *stand : stands)
    motions.push_back(gap_motions(*stand));
  const CommonModes common = common_modes(motions, likeness);
  std::vector<std::vector<ModeName>> names;
  for (std::size_t m = 0; m < stands.size(); ++m) {
    const std::vector<ModeName> gap_names = gap_mode_names(motions[m]);
    std::vector<ModeName> given(gap_names.size());
    for (std::size_t k = 0; k < gap_names.size(); ++k) {
      const auto [model, mode] = common.leader(m, k);
      if (model == m || names[model][mode].key.empty())
        continue;
      given[k]          = names[model][mode];
      given[k].own_name = "";
      given[k].decided  = gap_names[k].decided;
      if (!named_alike(motions[model][mode], motions[m][k])) {
        given[k].own_name = gap_names[k].name;
        given[k].decided =
            fmt::format("mode {} of {}: {}; by its own shares {}: {}", mode + 1, stands[model]->model.name,
                        names[model][mode].decided, gap_names[k].name, gap_names[k].decided);
      }
    }
    names.push_back(gap_mode_names(motions[m], given));
    mark_listed(*stands[m], names.back());
  }
  return names;
}
}  // namespace mill::reduce
