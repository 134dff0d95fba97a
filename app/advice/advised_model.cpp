#include "app/advice/advised_model.h"
#include "app/case_chain.h"
#include "app/stages/detailed_model_stage.h"
#include "app/trace/closed_form_chain.h"
#include "app/trace/closed_form_parts.h"
#include "core/model/case.h"
#include "dynamics/response/modal_model.h"
#include "reduce/stand/beam_stand.h"
#include "reduce/stand/stand_modes.h"
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
// "calibrated: records .., not told: K1, K2": those it names, or the value itself where it names none.
bool says_untold(const std::string &name, const std::string &text)
{
  const std::string words = "not told";
  const auto at           = text.find(words);
  if (at == std::string::npos)
    return false;
  const std::string rest = text.substr(at + words.size());
  if (rest.empty() || rest[0] != ':')
    return true;
  const auto is_word = [&](const std::size_t i) {
    return i < rest.size() && std::isalnum(static_cast<unsigned char>(rest[i]));
  };
  for (auto found = rest.find(name); found != std::string::npos; found = rest.find(name, found + 1))
    if (!is_word(found - 1) && !is_word(found + name.size()))
      return true;
  return false;
}

void add_errors(AdvisedModel &model, const LumpedModel &chain)
{
  for (std::size_t j = 0; j < chain.K.size(); ++j) {
    const std::string name   = "K" + std::to_string(j + 1);
    const Parameter &spring  = chain.K[j];
    const std::string source = source_text(spring);
    if (std::isfinite(spring.error_estimate))
      model.spring_error[name] = spring.error_estimate;
    if (says_untold(name, source))
      model.untold.push_back({name, "which the records do not tell (" + source + ")"});
  }
}

twin::VibratingStand in_its_modes(const StandModel &stand, const reduce::StandModes &modes, const double damping,
                                  const double highest, const double gap_damper)
{
  return twin::vibrating_stand(
      dynamics::modal_model(stand, modes.frequency, modes.shape, damping, highest, gap_damper));
}

double gap_damper_of(const LumpedModel &chain, const DynamicsSettings &settings)
{
  return settings.force_meaning == "measured" || std::isnan(chain.C.value) ? 0 : chain.C.value;
}

// What the beams are made of, by the same closed forms as the chain.
struct BeamParts {
  FourHigh stand;
  reduce::StandSprings springs;
  double gap_damper = 0;
};

BeamParts beam_parts(const FourHigh &drawn, const CaseChain &chain)
{
  BeamParts parts{with_drawn_frame(drawn), {}, gap_damper_of(chain.model, chain.dynamics)};
  reduce::ChainInputs inputs;
  reduce::each_spring(
      [&](const std::string &name, Parameter &spring) {
        if (const ClosedFormResult *found = find(chain.results, name))
          spring = found->parameter;
      },
      inputs);
  // Chocks of the work rolls on their bearings: these are the modes that six masses lack.
  parts.springs = reduce::stand_springs(parts.stand, reduce::lumped_stand(parts.stand, inputs), true);
  return parts;
}

std::optional<twin::VibratingStand> beams_of(const BeamParts &parts,
                                             const std::vector<std::pair<std::string, double>> &factors)
{
  reduce::StandSprings springs = parts.springs;
  for (const auto &[name, factor] : factors)
    if (name == "K1")
      springs.K1 *= factor;
    else if (name == "K3")
      springs.K3 *= factor;
    else if (name == "K5")
      springs.K5 *= factor;
    else if (name == "K7")
      springs.K7 *= factor;
    else
      return std::nullopt;
  const StandModel beams = reduce::beam_stand(parts.stand, springs);
  const double highest   = 2 * parts.stand.dynamics.frequency_limit;
  return in_its_modes(beams, reduce::stand_modes(beams, highest), parts.stand.dynamics.modal_damping, highest,
                      parts.gap_damper);
}

std::vector<std::string> asked_places(const StandAdvice &asked)
{
  std::vector<std::string> names{asked.place};
  for (const DamperProposal &damper : asked.dampers) {
    names.push_back(damper.from);
    names.push_back(damper.to);
  }
  for (const TunedDamperProposal &tuned : asked.tuned)
    names.push_back(tuned.at);
  names.erase(std::remove_if(names.begin(), names.end(),
                             [](const std::string &name) { return name.empty() || name == "ground"; }),
              names.end());
  return names;
}

// Places that only the beams have make them the stand.
void take_beams_for_their_places(AdvisedModel &model, const StandAdvice &asked)
{
  for (const std::string &name : asked_places(asked))
    if (model.beam && model.advised.stand.place(name) < 0 && model.beam->place(name) >= 0) {
      model.notes.push_back("six masses have no place " + name +
                            ": all is computed with rolls as beams, and springs are not tried");
      model.source  = "rolls as beams, springs by closed forms";
      model.advised = {std::move(*model.beam), {}};
      model.beam.reset();
      return;
    }
}
}  // namespace

AdvisedModel advised_model(const Case &the_case, const StandAdvice &asked)
{
  AdvisedModel model;
  if (const auto *lumped = std::get_if<Lumped>(&the_case.spec); lumped && lumped->detailed) {
    const auto files    = model_from_files(lumped->model);
    const double damper = std::isnan(lumped->model.gap_damper) ? 0 : lumped->model.gap_damper;
    model.limit         = lumped->model.frequency_limit;
    model.source        = "model " + lumped->model.name + " of its files";
    model.advised.stand =
        in_its_modes(files.model, files.modes, lumped->dynamics.modal_damping, 2 * model.limit, damper);
    model.notes.push_back("the stand comes from files: dampers are tried, springs are not");
    return model;
  }
  const CaseChain chain = case_chain(the_case, "advise");
  const auto mill_model = dynamics::mill_model(chain.model, chain.dynamics);
  const auto n          = mill_model.M.size();
  model.limit           = chain.dynamics.frequency_limit;
  model.source          = chain.source;
  model.advised = {twin::vibrating_stand(mill_model, Eigen::VectorXd::Constant(n, chain.dynamics.modal_damping),
                                         gap_damper_of(chain.model, chain.dynamics)),
                   mill_model};
  if (chain.dynamics.contact == "curve")
    model.notes.push_back("contacts on curves count with their slopes at the working load");
  add_errors(model, chain.model);
  if (const auto *four = std::get_if<FourHigh>(&the_case.spec)) {
    model.beam_with = [parts = beam_parts(*four, chain)](const auto &factors) { return beams_of(parts, factors); };
    model.beam      = model.beam_with({});
    take_beams_for_their_places(model, asked);
  }
  return model;
}
}  // namespace mill
