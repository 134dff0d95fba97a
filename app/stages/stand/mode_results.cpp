#include "app/stages/stand/mode_results.h"
#include "app/run/curve_files.h"
#include "core/base/files.h"
#include "core/model/dynamics_settings.h"
#include "core/records/csv.h"
#include "core/records/named_mode.h"
#include "core/records/number_in_chain.h"
#include "core/records/result_names.h"
#include "core/records/rows_of_stand.h"
#include "reduce/stand/mode_names.h"
#include "reduce/stand/six_masses.h"
#include "reduce/stand/stand_errors.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <utility>

namespace mill {
const char *word_of_state(const GapState state)
{
  return state == GapState::open ? family::open : "";
}

void assume_open(RunContext &run, const std::string &key)
{
  run.assume(key +
             " is not given: the modes are those of the open stand, without the strip between the work rolls; "
             "the modes of the stand as it rolls are not known");
}

bool knows_strip(const LumpedModel &chain)
{
  return chain.K[3].value > 0;
}

ResultName frequency_result(const StandModel &model, const std::size_t mode, const GapState state)
{
  const std::string number = std::to_string(mode + 1);
  return model.name == word_of(StandModelKind::six_mass)
             ? row::modes::vertical.of(word_of_state(state), number)
             : row::modes::of_model.of(word_of_state(state), model.name, number);
}

const char *title_of(const std::string &model)
{
  static const std::map<std::string, const char *> titles{
      {word_of(StandModelKind::six_mass), "six masses"},
      {word_of(StandModelKind::beam), "rolls as beams"},
      {word_of(StandModelKind::craig_bampton), "rolls as reduced finite elements"},
      {"stack", "rolls as beams about the solved state"},
      {"stack-lumped", "one mass for each roll"}};
  const auto title = titles.find(model);
  return title == titles.end() ? titles.at(word_of(StandModelKind::craig_bampton)) : title->second;
}

reduce::StandWithModes chain_with_modes(LumpedModel model, const DynamicsSettings &dynamics)
{
  if (dynamics.force_meaning == ForceMeaning::measured)
    model.K[3].value = 0;
  reduce::StandWithModes s{reduce::chain_stand(model, dynamics.frame), {}};
  s.modes = reduce::stand_modes(s.model);
  s.names = reduce::mode_names(s);
  return s;
}

std::vector<ChainNumber> gap_compliance_parts(const DynamicsSettings &settings)
{
  std::vector<ChainNumber> springs;
  for (const Half half : {Half::upper, Half::lower})
    for (const ChainNumber part : chain_parts(settings, half))
      if (is_spring_of_chain(part) && std::find(springs.begin(), springs.end(), part) == springs.end())
        springs.push_back(part);
  return springs;
}

KeyList gap_compliance_keys(const LumpedModel &model, const DynamicsSettings &settings)
{
  KeyList keys;
  for (const ChainNumber spring : gap_compliance_parts(settings))
    keys = joined(std::move(keys), number_in_chain(model, spring)->inputs);
  return keys;
}

namespace {
// The share of a mode in the compliance of the gap, next to its frequency.
Parameter share_of(const reduce::StandWithModes &best, const std::size_t i, const Parameter &frequency,
                   const reduce::FrequencyErrors &errors)
{
  const reduce::ModeName &mode = best.names[i];
  Parameter p;
  p.value  = mode.gap_share;
  p.unit   = "1";
  p.method = "share of the static compliance of the gap (22.23); " + std::string(title_of(best.model.name));
  p.at     = frequency.at;
  p.inputs = frequency.inputs;
  p.error_estimate = errors.error[Eigen::Index(i)];
  p.error_lacks    = errors.lacks[i];
  return p;
}
}  // namespace

void add_named_modes(RunContext &run, const NamedModes &named)
{
  const reduce::StandWithModes &best   = *named.models.front();
  const reduce::FrequencyErrors of_gap = reduce::gap_share_errors(best, named.uncertain);
  for (std::size_t i = 0; i < best.names.size() && best.modes.frequency[Eigen::Index(i)] <= named.limit; ++i) {
    const reduce::ModeName &mode = best.names[i];
    const Parameter *frequency   = run.results.find(frequency_result(best.model, i, named.state));
    if (mode.key.empty() || !mode.listed || !frequency)
      continue;
    Parameter p = *frequency, share = share_of(best, i, p, of_gap);
    share.inputs = joined(std::move(share.inputs), named.of_gap);
    p.method     = mode_method({mode.name, mode.decided, p.method});
    p.checks.clear();
    for (std::size_t m = 1; m < named.models.size(); ++m) {
      const reduce::StandWithModes &model = *named.models[m];
      for (std::size_t k = 0; k < model.names.size(); ++k)
        if (const reduce::ModeName &other = model.names[k]; other.key == mode.key) {
          p.checks.push_back({title_of(model.model.name), model.modes.frequency[Eigen::Index(k)], other.decided});
          share.checks.push_back({title_of(model.model.name), other.gap_share, other.name});
        }
    }
    const char *state = word_of_state(named.state);
    run.results.add(row::modes::frequency.of(state, mode.key), p);
    run.results.add(row::modes::gap_share.of(state, mode.key), share);
  }
}

void write_mode_table(RunContext &run, const reduce::StandWithModes &s, const GapState state)
{
  const auto n = s.modes.frequency.size();
  Table table;
  table.add("mode", "", Eigen::VectorXd::LinSpaced(n, 1, double(n))).add("frequency", "Hz", s.modes.frequency);
  table.add("gap_share", "", reduce::gap_shares(s));
  for (const StandPoint &point : s.model.points) {
    Eigen::VectorXd y = s.modes.shape.transpose() * point.row;
    for (Eigen::Index i = 0; i < n; ++i) {
      double largest = 0;
      for (const StandPoint &any : s.model.points)
        largest = std::max(largest, std::abs(any.row.dot(s.modes.shape.col(i))));
      y[i] /= largest;
    }
    table.add(slug(point.name), "", y);
  }
  write_curve(run, curve::modes_of_model, s.model.name + (state == GapState::open ? "-open" : ""), table);
}
}  // namespace mill
