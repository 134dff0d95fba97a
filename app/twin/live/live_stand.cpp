#include "app/twin/live/live_stand.h"
#include "app/process/version.h"
#include "app/run/run_setup.h"
#include "app/twin/calibrate/stated_errors.h"
#include "app/twin/live/live_detail.h"
#include "app/twin/stand/case_chain.h"
#include "app/twin/stand/mode_errors.h"
#include "core/base/files.h"
#include "core/model/assumed_error.h"
#include "core/model/case.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace mill {
namespace {
const char *label_of(const std::string &key, const bool detailed)
{
  static const std::map<std::string, const char *> bearings{{"K2", "bearings of the upper backup roll"},
                                                            {"K6", "bearings of the lower backup roll"}};
  if (const auto bearing = bearings.find(key); detailed && bearing != bearings.end())
    return bearing->second;  // the rolls bend by themselves
  static const std::map<std::string, const char *> labels{
      {"K1", "upper frame"}, {"K2", "upper backup roll"},  {"K3", "upper roll contact"},
      {"K4", "roll bite"},   {"K5", "lower roll contact"}, {"K6", "lower backup roll"},
      {"K7", "lower frame"}, {"damping", "modal damping"}};
  return labels.at(key);
}

// Who sets another limit or names a channel has the same twin still: what was learned of it stays.
std::string without_monitoring(const std::string &resolved)
{
  const auto begin = resolved.find("\n[monitoring]\n");
  if (begin == std::string::npos)
    return resolved;
  const auto end = resolved.find("\n[", begin + 1);
  return resolved.substr(0, begin) + (end == std::string::npos ? "" : resolved.substr(end));
}

void add_roll_sizes(live::PageStand &stand, const std::string &roll, const double diameter, const double length)
{
  for (live::StandPlace &place : stand.places)
    if (place.place.size() > roll.size() && place.place.find(roll) != std::string::npos) {
      place.diameter = diameter;
      place.length   = length;
    }
}
}  // namespace

live::TwinModel live_model(const Case &the_case, const bool six_masses)
{
  const std::string hash = hash_of(without_monitoring(the_case.resolved));
  if (const auto *lumped = std::get_if<Lumped>(&the_case.spec); lumped && lumped->detailed) {
    live::TwinModel model{the_case.name, "", {}, lumped->dynamics, hash, not_given};
    add_detail(model, the_case);
    return model;
  }
  CaseChain chain           = case_chain(the_case, "live");
  const StatedErrors stated = stated_errors(the_case, chain.model, chain.load);
  for (std::size_t j = 0; j < chain.model.K.size(); ++j)
    if (const auto error = stated.error.find("K" + std::to_string(j + 1)); error != stated.error.end())
      chain.model.K[j].error_estimate = error->second;
  const bool drawn = std::holds_alternative<FourHigh>(the_case.spec);
  live::TwinModel model{
      the_case.name, std::move(chain.source), std::move(chain.model), std::move(chain.dynamics), hash, chain.load,
      drawn};
  if (drawn && !six_masses)
    add_detail(model, the_case);
  return model;
}

namespace {
// Of six masses; a detailed stand is drawn as the same chain, whatever its frame is.
void add_springs(live::PageStand &stand, const live::TwinModel &model)
{
  if (!model.detailed) {
    for (const dynamics::Spring &spring : live::tuned(model, {}).springs)
      stand.springs.push_back({spring.name, spring.stiffness, spring.from, spring.to});
    return;
  }
  for (int j = 0; j < 7; ++j)
    stand.springs.push_back(
        {"K" + std::to_string(j + 1), model.chain.K[std::size_t(j)].value, j - 1, j < 6 ? j : dynamics::ground});
}
}  // namespace

live::PageStand page_stand(const Case &the_case, const live::TwinModel &model)
{
  const auto stepped = live::stepped(model, {});
  live::PageStand stand;
  stand.name        = model.name;
  stand.source      = model.source;
  stand.version     = version();
  const auto places = live::places_of(stepped);
  for (std::size_t i = 0; i < places.size(); ++i) {
    live::StandPlace place;
    place.place = places[i];
    place.label = stepped.labels[i];
    place.drawn = i < model.chain.M.size();
    if (place.drawn)
      place.mass = model.chain.M[i].value;
    stand.places.push_back(place);
  }
  if (const auto *four = std::get_if<FourHigh>(&the_case.spec)) {
    add_roll_sizes(stand, "work_roll", four->work_roll.barrel_diameter, four->work_roll.barrel_length);
    add_roll_sizes(stand, "backup_roll", four->backup_roll.barrel_diameter, four->backup_roll.barrel_length);
  }
  add_springs(stand, model);
  const bool detailed = model.detailed != nullptr;
  for (const live::StandSpring &spring : stand.springs)
    if (spring.value > 0)
      stand.sliders.push_back({spring.key, label_of(spring.key, detailed), "N/m", spring.value});
  stand.sliders.push_back({"damping", label_of("damping", detailed), "-", model.dynamics.modal_damping});
  const Eigen::VectorXd frequency = live::watched_modes(model, {}).frequency;
  for (Eigen::Index i = 0; i < frequency.size(); ++i) {
    const bool named = detailed && std::size_t(i) < model.detailed->mode_names.size();
    stand.modes.push_back(
        {frequency[i], model.dynamics.modal_damping, named ? model.detailed->mode_names[std::size_t(i)] : ""});
  }
  return stand;
}

LumpedModel chain_at_load(const Case &the_case, const live::TwinModel &model, const double load)
{
  LumpedModel chain = model.chain;
  if (!std::holds_alternative<FourHigh>(the_case.spec) || !model.follows_load || !(load > 0))
    return chain;
  if (model.detailed) {
    const auto factor = detail_at_load(the_case, model, load);
    for (std::size_t j = 0; j < chain.K.size(); ++j)
      chain.K[j].value *= factor[j];
    return chain;
  }
  // what the load does to the closed forms, on the springs of the model as it is
  const CaseChain chain_here = case_chain(the_case, "live"), there = case_chain(the_case, "live", load);
  for (std::size_t j = 0; j < chain.K.size(); ++j)
    if (chain_here.model.K[j].value > 0)
      chain.K[j].value *= there.model.K[j].value / chain_here.model.K[j].value;
  return chain;
}

twin::ModesAtLoad modes_at_load(const Case &the_case, const live::TwinModel &model, const live::Tuning &tuning)
{
  const auto modes     = live::watched_modes(model, tuning);
  const Eigen::Index n = modes.frequency.size();
  twin::ModesAtLoad at;
  at.damping = Eigen::VectorXd::Constant(n, model.dynamics.modal_damping * tuning.damping);
  at.sd      = Eigen::VectorXd::Zero(n);
  for (std::size_t j = 0; j < model.chain.K.size(); ++j) {
    const double error = model.chain.K[j].error_estimate;
    at.sd.array() +=
        (modes.strain_share.col(Eigen::Index(j)).array() * (std::isfinite(error) ? error : assumed_spring_error))
            .square() /
        4;
  }
  at.sd                        = at.sd.cwiseSqrt();
  const Eigen::VectorXd of_run = mode_errors_of_run(the_case, modes.frequency);
  for (Eigen::Index i = 0; i < n; ++i)
    if (of_run[i] > 0)
      at.sd[i] = of_run[i];
  const auto *four = std::get_if<FourHigh>(&the_case.spec);
  if (!four || !model.follows_load) {
    at.load      = Eigen::VectorXd::Constant(1, 1);
    at.frequency = modes.frequency.transpose();
    return at;
  }
  const Eigen::ArrayXd factor = Eigen::ArrayXd::LinSpaced(7, std::log(0.25), std::log(4)).exp();
  at.load                     = model.load * factor;
  at.frequency.resize(at.load.size(), n);
  for (Eigen::Index i = 0; i < at.load.size(); ++i) {
    live::TwinModel loaded = model;
    loaded.chain           = chain_at_load(the_case, model, at.load[i]);
    // a mode that leaves the watched range at this load is kept as it is
    const Eigen::VectorXd now                         = live::watched_modes(loaded, tuning).frequency;
    at.frequency.row(i)                               = modes.frequency.transpose();
    at.frequency.row(i).head(std::min(n, now.size())) = now.head(std::min(n, now.size())).transpose();
  }
  return at;
}

std::string assumed_errors_note(const live::TwinModel &model)
{
  std::string silent;
  for (std::size_t j = 0; j < model.chain.K.size(); ++j)
    if (model.chain.K[j].value > 0 && !std::isfinite(model.chain.K[j].error_estimate))
      silent += fmt::format("{}K{}", silent.empty() ? "" : ", ", j + 1);
  return silent.empty()
             ? ""
             : fmt::format("no error is stated for {}: {:g} % is assumed in the accuracy of the modes and "
                           "in what a re-calibration may change; run the case first, or state a tolerance",
                           silent, 100 * assumed_spring_error);
}

live::PageParameters page_parameters(const live::TwinModel &model, const live::Tuning &tuning,
                                     const std::string &origin, const std::string &place)
{
  live::PageParameters now;
  now.origin = origin;
  now.place  = place;
  for (const std::string &key : live::slider_keys())
    now.sliders.push_back({key, live::factor_of(tuning, key)});
  const Eigen::VectorXd frequency = live::watched_modes(model, tuning).frequency;
  now.frequencies.assign(frequency.begin(), frequency.end());
  return now;
}
}  // namespace mill
