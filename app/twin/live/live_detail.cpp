#include "app/twin/live/live_detail.h"
#include "app/stages/stand/mode_results.h"
#include "app/stages/stand/model_files.h"
#include "app/twin/stand/detail_parts.h"
#include "core/base/files.h"
#include "core/base/force_text.h"
#include "core/model/case.h"
#include "core/records/detailed_model.h"
#include "reduce/stand/mode_names.h"
#include "reduce/stand/stand_modes.h"
#include <cmath>
#include <filesystem>
#include <iterator>

namespace mill {
namespace {
// Names of the modes up to the limit that the gap or a sensor sees; empty text for the others.
std::vector<std::string> listed_names(const reduce::StandWithModes &stand, const double limit)
{
  std::vector<std::string> listed;
  const auto names = reduce::mode_names(stand);
  for (std::size_t i = 0; i < names.size() && stand.modes.frequency[Eigen::Index(i)] <= limit; ++i)
    listed.push_back(names[i].listed ? names[i].name : "");
  return listed;
}
}  // namespace

void add_detail(live::TwinModel &model, const Case &the_case)
{
  reduce::StandWithModes stand;
  double damper = 0;
  if (const auto *drawn = std::get_if<FourHigh>(&the_case.spec)) {
    const CaseChain chain   = case_chain(the_case, "live");
    const DetailParts parts = detail_parts(*drawn, chain);
    stand.model             = reduce::beam_stand(parts.stand, parts.springs);
    damper                  = parts.gap_damper;
    model.six_masses        = model.chain;
    model.source            = "rolls as beams, springs by closed forms at " + force_text(chain.load);
  } else {
    const ModelFiles &files        = std::get<Lumped>(the_case.spec).model;
    stand.model                    = detailed_model_of(files);
    model.dynamics.frequency_limit = files.frequency_limit;
    model.source                   = "model " + files.name + " of its files";
    LumpedModel with_damper;
    with_damper.C.value = files.gap_damper;
    damper              = gap_damper_of(with_damper, model.dynamics);
  }
  const double limit = model.dynamics.frequency_limit;
  stand.modes        = reduce::stand_modes(stand.model);
  auto names         = listed_names(stand, limit);
  auto detail =
      live::detailed_twin(std::move(stand.model), stand.modes.frequency, stand.modes.shape, limit, damper);
  detail.mode_names = std::move(names);
  live::take_springs(detail, model.chain);
  model.detailed = std::make_shared<const live::DetailedTwin>(std::move(detail));
}

std::array<double, 7> detail_at_load(const Case &the_case, const live::TwinModel &model, const double load)
{
  const live::DetailedTwin &detailed = *model.detailed;
  const DetailParts parts = detail_parts(std::get<FourHigh>(the_case.spec), case_chain(the_case, "live", load));
  const StandModel there  = reduce::beam_stand(parts.stand, parts.springs);
  std::array<double, 7> factor{1, 1, 1, 1, 1, 1, 1};
  for (std::size_t j = 0; j < factor.size(); ++j)
    if (detailed.stiffness[j] > 0)
      factor[j] = live::stiffness_of_connection(there, detailed.connection[j]) / detailed.stiffness[j];
  return factor;
}

twin::FittedStand fitted_detail(const live::TwinModel &model, const LumpedModel &chain, const double damping)
{
  const live::DetailedTwin &detail = *model.detailed;
  StandModel stand                 = live::with_springs(detail.stand, detail, chain);
  for (std::size_t j = 0; j < detail.connection.size(); ++j)
    for (Connection &connection : stand.connections)
      if (!detail.connection[j].empty() && connection.name == detail.connection[j])
        connection.name = "K" + std::to_string(j + 1);  // as the twin names its springs
  const auto modes = reduce::stand_modes(stand);
  twin::FittedStand fitted;
  fitted.detailed = twin::reduced_stand(stand, modes.frequency, modes.shape, detail.highest);
  fitted.damping  = Eigen::VectorXd::Constant(fitted.detailed->kept, damping);
  return fitted;
}

std::string adopted_detail(const live::TwinModel &model, const live::Proposal &proposal, const Case &origin,
                           const std::string &folder)
{
  reduce::StandWithModes stand{live::with_springs(model.detailed->whole, *model.detailed, proposal.chain), {}};
  stand.modes             = reduce::stand_modes(stand.model, model.detailed->highest);
  const std::string named = std::filesystem::path(proposal.file).stem().string();
  ModelFiles files        = model_case_files(stand, model.dynamics.frequency_limit, model.detailed->gap_damper);
  for (std::string *path : {&files.mass, &files.stiffness, &files.force, &files.readings, &files.names,
                            &files.connections, &files.strains})
    if (!path->empty())
      *path = named + "/" + std::filesystem::path(*path).filename().string();
  std::filesystem::create_directories(folder + "/" + named);
  for (const auto &[path, text] : texts_of(stand.model, files))
    write_atomically(folder + "/" + path, text);
  return live::recalibration_comment(proposal) +
         detailed_model_toml(files, live::with_damping(origin, proposal.damping), folder);
}
}  // namespace mill
