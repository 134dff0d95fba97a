#include "app/export/exported_stand.h"
#include "app/process/version.h"
#include "app/run/run_context.h"
#include "app/stages/stand/mode_results.h"
#include "core/base/files.h"
#include "core/model/case.h"
#include "core/records/chain_number.h"
#include "dynamics/fmu/model_text.h"
#include "dynamics/fmu/unit_archive.h"
#include "dynamics/response/modes.h"
#include "dynamics/response/response.h"
#include "reduce/stand/stand_comparison.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
std::vector<double> entries(const Eigen::VectorXd &v)
{
  return {v.begin(), v.end()};
}

std::vector<std::string> variable_names(std::vector<std::string> labels)
{
  for (std::string &label : labels) {
    label = slug(label);
    std::replace(label.begin(), label.end(), '-', '_');
  }
  return labels;
}

fmu::ModelData chain_data(const dynamics::MillModel &chain, const DrivenStand &stand)
{
  fmu::ModelData data;
  data.kind               = fmu::StandKind::chain;
  data.points             = variable_names(chain.labels);
  data.mass               = entries(chain.M);
  data.bite_row           = entries(chain.b);
  data.share_from_statics = stand.dynamics.force_meaning == ForceMeaning::published;
  data.load_cell_share    = chain.load_cell_share;
  data.modal_damping      = stand.dynamics.modal_damping;
  const bool measured     = stand.dynamics.force_meaning == ForceMeaning::measured;
  data.gap_damper         = measured || std::isnan(stand.chain.C.value) ? 0 : stand.chain.C.value;
  for (std::size_t i = 0; i < chain.springs.size(); ++i) {
    const dynamics::Spring &spring = chain.springs[i];
    data.springs.push_back({spring.name, spring.from, spring.to, spring.stiffness,
                            spring.name == word_of(ChainNumber::K4), spring.damper});
  }
  // The spring that carries the rolling force to the ground, or through the posts of a closed frame (6.8).
  data.load_cell_spring = stand.dynamics.frame == FrameForm::closed ? 0 : int(chain.springs.size()) - 1;
  return data;
}

std::vector<double> rows_of(const Eigen::MatrixXd &matrix)
{
  std::vector<double> all;
  for (Eigen::Index r = 0; r < matrix.rows(); ++r)
    for (Eigen::Index k = 0; k < matrix.cols(); ++k)
      all.push_back(matrix(r, k));
  return all;
}
}  // namespace

fmu::ModelData modal_data(const dynamics::ModalModel &modes)
{
  fmu::ModelData data;
  data.kind            = fmu::StandKind::modal;
  data.points          = variable_names(modes.labels);
  data.frequency       = entries(modes.frequency);
  data.bite_mode       = entries(modes.force);
  data.load_cell_mode  = entries(modes.load_cell);
  data.load_cell_share = modes.load_cell_share;
  data.modal_damping   = modes.damping;
  data.gap_damper      = modes.gap_damper;
  for (Eigen::Index p = 0; p < modes.point.rows(); ++p)
    for (Eigen::Index k = 0; k < modes.point.cols(); ++k)
      data.shape.push_back(modes.point(p, k));
  if (modes.dampers.size() > 0)
    data.damper_rows = rows_of(dynamics::damper_rows(modes.dampers));
  return data;
}

namespace {
std::map<std::string, std::string> sources(const DrivenStand &stand)
{
  std::map<std::string, std::string> all;
  all["modal_damping"] = "dynamics.modal_damping";
  all["F_mean"] = stand.force.force.size() > 0 ? "mean of the force of " + stand.pass.name : "load of the pass";
  if (std::isnan(stand.chain.M[0].value))  // a stand in files has no numbers of a chain
    return all;
  const auto add = [&](const std::string &name, const Parameter &p) {
    all[name] = name + " of the case, " + source_text(p) + (p.at.empty() ? "" : ", at " + p.at.text());
  };
  for (std::size_t i = 0; i < 6; ++i)
    add("M" + std::to_string(i + 1), stand.chain.M[i]);
  for (std::size_t i = 0; i < 7; ++i)
    add("K" + std::to_string(i + 1), stand.chain.K[i]);
  add("C", stand.chain.C);
  if (stand.dynamics.force_meaning == ForceMeaning::measured)
    all["K4"] = all["C"] = "zero: dynamics.force_meaning is measured";
  else if (std::isnan(stand.chain.C.value))
    all["C"] = "zero: the case gives none";
  return all;
}

// Ten steps about the mean force, as much above as below, so that their mean is the mean.
fmu::CheckRun check_run(const dynamics::DrivenModel &driven, const double mean, const double rate)
{
  constexpr Eigen::Index n = 11;
  fmu::CheckRun check;
  check.step  = 1 / rate;
  check.force = Eigen::VectorXd::Constant(n, mean);
  for (Eigen::Index i = 0; i < n / 2; ++i) {
    const double swing = 1e4 + 1e5 * std::sin(0.9 * double(i));
    check.force[i] += swing;
    check.force[n - 1 - i] -= swing;
  }
  const ForceRecord record{Eigen::VectorXd::LinSpaced(n, 0, double(n - 1) * check.step), check.force, {}};
  const auto response = dynamics::mill_response(driven, record, rate);
  check.acceleration  = response.acceleration;
  check.load_cell     = response.load_cell;
  return check;
}
}  // namespace

namespace {
std::string method_of(const DrivenStand &stand)
{
  if (!stand.modes)
    return "chain of six masses";
  if (!stand.rest)
    return fmt::format("stand in {} modes up to {:.0f} Hz", stand.modes->frequency.size(),
                       stand.modes->frequency.tail(1)[0]);
  const StaticRest &rest = *stand.rest;
  return fmt::format("{} in {} modes up to {:.0f} Hz and the static rest of the {} others, {} states; the gap "
                     "responds within {:.2g} % of all modes up to {:g} Hz ({:.2g} % of its static compliance "
                     "would be missing without the rest)",
                     title_of(stand.detailed->model.name), rest.kept, rest.fastest, rest.all - rest.kept,
                     2 * stand.modes->frequency.size(), 100 * rest.error, rest.limit, 100 * rest.missing);
}
}  // namespace

dynamics::DrivenModel driven_of(const DrivenStand &stand)
{
  return stand.modes ? dynamics::driven_model(*stand.modes)
                     : dynamics::driven_model(dynamics::mill_model(stand.chain, stand.dynamics));
}

double held_step(const double output_rate, const double highest)
{
  constexpr double per_period = 20;
  return 1 / (output_rate * std::max(1., std::ceil(per_period * highest / output_rate)));
}

double film_damping(const DrivenStand &stand)
{
  const auto largest = [&](const Eigen::MatrixXd &C, const Eigen::VectorXd &frequency) {
    double damping = 0;
    for (Eigen::Index k = 0; k < frequency.size(); ++k)
      if (frequency[k] > 0) {
        const double locked = std::pow(stand.chain.film_frequency / frequency[k], 2);  // (29.19)
        damping             = std::max(damping, locked * C(k, k) / (4 * M_PI * frequency[k]));
      }
    return damping;
  };
  if (stand.modes)
    return stand.modes->dampers.size() > 0 ? largest(stand.modes->dampers, stand.modes->frequency) : 0;
  DynamicsSettings undamped = stand.dynamics;
  undamped.modal_damping    = 0;
  undamped.force_meaning    = ForceMeaning::measured;  // without the damper of the gap
  const auto chain          = dynamics::mill_model(stand.chain, undamped);
  const auto modes          = dynamics::modes(chain);
  return largest(modes.shape.transpose() * chain.C * modes.shape, modes.frequency);
}

fmu::ExportedModel exported_model(const DrivenStand &stand, const Case &of)
{
  fmu::ExportedModel model;
  model.identifier    = fmu::identifier_of(of.name);
  model.title         = of.title.empty() ? of.name : of.title;
  model.force_meaning = stand.dynamics.force_meaning;
  model.program       = "millstand " + version();
  model.source        = sources(stand);
  model.origin        = "case " + of.name + (stand.pass.name.empty() ? "" : ", " + stand.pass.name) +
                 (stand.chain.at.empty() ? "" : " at " + stand.chain.at.text());
  const auto driven = driven_of(stand);
  model.data        = stand.modes ? modal_data(*stand.modes)
                                  : chain_data(dynamics::mill_model(stand.chain, stand.dynamics), stand);
  model.method      = method_of(stand);
  model.step        = held_step(
             stand.dynamics.output_rate,
      stand.rest    ? stand.rest->fastest
             : stand.modes ? stand.modes->frequency.maxCoeff()
                           : dynamics::modes(dynamics::mill_model(stand.chain, stand.dynamics)).frequency.maxCoeff());
  model.series          = stand.force;
  model.data.runtime    = fmu::runtime_version;
  model.data.has_series = stand.force.force.size() > 0;
  model.data.mean_force = model.data.has_series ? stand.force.force.mean() : stand.load;
  model.check           = check_run(driven, model.data.mean_force, stand.dynamics.output_rate);
  model.data.guid       = fmu::identity_of(model);
  return model;
}
}  // namespace mill
