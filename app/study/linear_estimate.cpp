#include "app/study/linear_estimate.h"
#include "app/study/correlation.h"
#include "app/study/study_statistics.h"
#include "app/verbs/checked_case.h"
#include "core/model/case.h"
#include "core/records/chain_number.h"
#include "core/records/rows_of_bearing.h"
#include "core/records/rows_of_bite.h"
#include "core/records/rows_of_contact.h"
#include <algorithm>
#include <cmath>

namespace mill {
namespace {
constexpr double share_of_deviation = 0.1;  // larger step of the differences

// Name of a result of a run in the closed forms, which have one stiffness of a spring, "K3".
std::string quick_name(const std::string &name)
{
  const auto id = result_id(name);
  if (id && id->is_of(row::roll_contact::tangent) && id->place("pass").empty())
    return id->place("roll_contact");
  if (id && id->is_of(row::bearing::tangent))
    return id->place("bearing_spring");
  return id && id->is_of(row::bite_spring::combined) ? word_of(ChainNumber::K4) : name;
}

// Results of a row in the order of the names; all NaN where it fails.
std::vector<double> values_of(const Study &study, RowModel &model, const std::vector<std::string> &names,
                              const std::vector<double> &numbers)
{
  std::vector<double> values(names.size(), not_given);
  try {
    const NamedResults results = model.results(checked_row(study.case_path, sets_of(study, numbers)));
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto entry = std::find_if(results.begin(), results.end(),
                                      [&](const auto &result) { return result.first == names[i]; });
      if (entry != results.end())
        values[i] = entry->second.value;
    }
  } catch (const SystemError &) {
    throw;
  } catch (const InputError &) {  // a step outside of what the case allows
  } catch (const SolverError &) {
  }
  return values;
}

// Names of closed forms for the watched results; "": there is none.
std::vector<std::string> closed_names(const Study &study, RowModel &quick, const Case &base)
{
  std::vector<std::string> names;
  const NamedResults results = quick.results(base);
  for (const WatchedResult &watched : study.watched) {
    const auto has = [&](const std::string &name) {
      return std::any_of(results.begin(), results.end(), [&](const auto &result) { return result.first == name; });
    };
    names.push_back(has(watched.name)               ? watched.name
                    : has(quick_name(watched.name)) ? quick_name(watched.name)
                                                    : "");
  }
  return names;
}

void add_slopes_of(Study &study, RowModel &model, const std::vector<std::string> &names)
{
  std::vector<double> means;
  for (const UncertainKey &key : study.keys)
    means.push_back(mean_of(key.spread));
  for (std::size_t k = 0; k < study.keys.size(); ++k) {
    const double step     = share_of_deviation * deviation_of(study.keys[k].spread);
    const auto difference = [&](const double h) {
      auto up = means, down = means;
      up[k] += h, down[k] -= h;
      const auto above = values_of(study, model, names, up), below = values_of(study, model, names, down);
      std::vector<double> slopes;
      for (std::size_t r = 0; r < names.size(); ++r)
        slopes.push_back((above[r] - below[r]) / (up[k] - down[k]));
      return slopes;
    };
    const auto wide = difference(step), narrow = difference(step / 2);
    for (std::size_t r = 0; r < names.size(); ++r)
      study.watched[r].slopes.push_back((4 * narrow[r] - wide[r]) / 3);
  }
}
}  // namespace

void add_slopes(Study &study, RowModel &model)
{
  for (WatchedResult &watched : study.watched)
    watched.slopes.clear();
  std::vector<std::string> names;
  if (study.model == ModelKind::quick) {
    for (const WatchedResult &watched : study.watched)
      names.push_back(watched.name);
    add_slopes_of(study, model, names);
    return;
  }
  RowModel quick({ModelKind::quick, "", false, 1});
  const Case base = read_case(study.case_path, study.sets);
  try {
    names = closed_names(study, quick, base);
  } catch (const InputError &) {  // the closed forms refuse this case
    return;
  } catch (const SolverError &) {
    return;
  }
  const auto closed = [&] {
    std::vector<double> values;
    const NamedResults results = quick.results(base);
    for (const std::string &name : names) {
      const auto entry =
          std::find_if(results.begin(), results.end(), [&](const auto &result) { return result.first == name; });
      values.push_back(entry == results.end() ? not_given : entry->second.value);
    }
    return values;
  }();
  add_slopes_of(study, quick, names);
  for (std::size_t r = 0; r < names.size(); ++r)
    for (double &slope : study.watched[r].slopes)
      slope *= study.watched[r].base / closed[r];
}

LinearEstimate linear_estimate(const Study &study, const WatchedResult &result)
{
  const std::size_t n = study.keys.size();
  LinearEstimate estimate;
  if (result.slopes.size() != n || std::any_of(result.slopes.begin(), result.slopes.end(),
                                               [](const double slope) { return !std::isfinite(slope); }))
    return estimate;
  std::vector<double> part, joint;
  for (std::size_t k = 0; k < n; ++k)
    part.push_back(result.slopes[k] * deviation_of(study.keys[k].spread));
  joint = part;
  for (const KeyCorrelation &c : correlations_of(study)) {
    joint[c.a] += c.value * part[c.b];
    joint[c.b] += c.value * part[c.a];
  }
  double variance = 0;
  for (std::size_t k = 0; k < n; ++k)
    variance += part[k] * joint[k];
  if (!(variance > 0))
    return estimate;
  estimate.sd = std::sqrt(variance);
  for (std::size_t k = 0; k < n; ++k)
    estimate.shares.push_back(part[k] * joint[k] / variance);
  return estimate;
}
}  // namespace mill
