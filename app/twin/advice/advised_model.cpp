#include "app/twin/advice/advised_model.h"
#include "app/stages/response/detailed_model_stage.h"
#include "app/trace/closed_form_chain.h"
#include "app/trace/closed_form_parts.h"
#include "app/twin/advice/asked_choices.h"
#include "app/twin/calibrate/stated_errors.h"
#include "app/twin/stand/case_chain.h"
#include "app/twin/stand/chatter_model.h"
#include "app/twin/stand/detail_parts.h"
#include "core/model/assumed_error.h"
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
// "calibrated: records .., not identified: K1, K2": those it names, or the value itself where it names none.
bool says_unidentified(const std::string &name, const std::string &text)
{
  const std::string words = "not identified";
  const auto begin        = text.find(words);
  if (begin == std::string::npos)
    return false;
  const std::string rest = text.substr(begin + words.size());
  if (rest.empty() || rest[0] != ':')
    return true;
  const auto is_word = [&](const std::size_t i) {
    return i < rest.size() && std::isalnum(static_cast<unsigned char>(rest[i]));
  };
  for (auto position = rest.find(name); position != std::string::npos; position = rest.find(name, position + 1))
    if (!is_word(position - 1) && !is_word(position + name.size()))
      return true;
  return false;
}

// Errors that the case or its run states; where nothing states one, the advice says what it assumes.
void add_errors(AdvisedModel &model, const Case &the_case, const LumpedModel &chain, const double load)
{
  std::string silent;
  const StatedErrors stated = stated_errors(the_case, chain, load);
  for (std::size_t j = 0; j < chain.K.size(); ++j) {
    const std::string name   = "K" + std::to_string(j + 1);
    const Parameter &spring  = chain.K[j];
    const std::string source = source_text(spring);
    if (const auto error = stated.error.find(name); error != stated.error.end())
      model.spring_error[name] = error->second;
    else if (spring.value > 0)
      silent += (silent.empty() ? "" : ", ") + name;
    if (says_unidentified(name, source))
      model.unidentified.push_back({name, "which the records do not identify (" + source + ")"});
  }
  if (!stated.source.empty())
    model.notes.push_back("the spread of a change takes the errors of springs stated by " + stated.source);
  if (!silent.empty())
    model.notes.emplace_back(NoteId::error_not_stated, "", "no error is stated for " + silent,
                             fmt::format("the spread of a change assumes {:g} %", 100 * assumed_spring_error));
}

twin::VibratingStand in_its_modes(const StandModel &stand, const reduce::StandModes &modes, const double damping,
                                  const double highest, const double gap_damper)
{
  return twin::vibrating_stand(
      dynamics::modal_model(stand, modes.frequency, modes.shape, damping, highest, gap_damper));
}

bool scale_spring(reduce::StandSprings &springs, const std::string &name, const double factor)
{
  for (const auto &[known, spring] :
       {std::pair{"K1", &springs.K1}, {"K3", &springs.K3}, {"K5", &springs.K5}, {"K7", &springs.K7}})
    if (name == known) {
      *spring *= factor;
      return true;
    }
  return false;
}

using MakeStand = std::function<StandModel(const FourHigh &, const reduce::StandSprings &)>;

std::optional<twin::VibratingStand> detailed_after(DetailParts parts, const MakeStand &make,
                                                   const twin::StandChange &change, const bool with_bite)
{
  for (const auto &[name, factor] : change.springs)
    if (!scale_spring(parts.springs, name, factor))
      return std::nullopt;
  if (!with_bite)
    parts.springs.K4 = parts.gap_damper = 0;
  const StandModel stand           = make(parts.stand, parts.springs);
  const double highest             = 2 * parts.stand.dynamics.frequency_limit;
  twin::VibratingStand modal_stand = in_its_modes(stand, reduce::stand_modes(stand, highest),
                                                  parts.stand.dynamics.modal_damping, highest, parts.gap_damper);
  modal_stand.damping *= change.damping;
  return modal_stand;
}

DetailedStand detailed_stand(const Case &the_case, const FourHigh &four, const CaseChain &chain,
                             const StandModelKind model, const Components &components)
{
  DetailedStand detailed;
  MakeStand make;
  if (model == StandModelKind::craig_bampton) {
    detailed.name = "component modes";
    make          = [rolls = components()](const FourHigh &stand, const reduce::StandSprings &springs) {
      return reduce::component_stand(stand, springs, rolls);
    };
  } else {
    detailed.name = "beams";
    make          = [](const FourHigh &stand, const reduce::StandSprings &springs) {
      return reduce::beam_stand(stand, springs);
    };
  }
  detailed.after = [&the_case, &four, load = chain.load, parts = detail_parts(four, chain),
                    make](const twin::StandChange &change, const bool with_bite) {
    return detailed_after(
        change.force == 1 ? parts : detail_parts(four, case_chain(the_case, "advise", load * change.force)), make,
        change, with_bite);
  };
  detailed.as_it_is = *detailed.after({}, true);
  return detailed;
}

// The pass of the drawing whose level is asked, where the case says enough of it.
void add_pass(AdvisedModel &model, const Case &the_case, const FourHigh &four, const RolledAdvice &asked,
              const CaseChain &chain)
{
  const Pass &pass         = four.passes.front();
  const std::string beyond = "process actions and the critical speed are not judged";
  if (const std::string missing = missing_of_bite(the_case); !missing.empty()) {
    model.notes.emplace_back(NoteId::pass_not_judged, "", "the case has no " + missing, beyond);
    return;
  }
  if (std::isnan(pass.speed)) {
    model.notes.emplace_back(NoteId::pass_not_judged, "", "pass.0.speed is not given", beyond, "",
                             std::vector<std::string>{}, "pass.0.speed");
    return;
  }
  const FreeStrip strip = free_strip(four);
  for (const std::string &assumed : strip.assumed)
    model.notes.emplace_back(NoteId::assumed, "", assumed);
  twin::RolledPass rolled;
  rolled.model               = chatter_model(four, pass, chain.model, chain.dynamics, strip);
  rolled.working_speed       = pass.speed;
  rolled.process             = asked;
  rolled.process.flow_stress = {1, 1};
  if (asked.wanted_speed > pass.speed)  // a level belongs to the force of the present speed
    rolled.process.wanted_speed = not_given;
  rolled.nearer_chatter = asked.nearer_chatter;
  rolled.disturbance    = chain.dynamics.force_meaning != ForceMeaning::measured;
  model.pass            = rolled;
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
                             [](const std::string &name) { return name.empty() || is_ground(name); }),
              names.end());
  return names;
}

// Places that only the detailed stand has make it the stand.
void take_detailed_for_its_places(AdvisedModel &model, const StandAdvice &asked)
{
  for (const std::string &name : asked_places(asked))
    if (model.detailed && model.advised.stand.place(name) < 0 && model.detailed->as_it_is.place(name) >= 0) {
      model.source = "rolls as " + model.detailed->name;
      model.notes.emplace_back(NoteId::springs_not_tried, "", "six masses have no place " + name,
                               "all is computed with " + model.source + ", and springs are not tried");
      model.source += ", springs by closed forms";
      model.advised.stand = std::move(model.detailed->as_it_is);
      model.advised.chain.reset();
      model.advised.open = [after = model.detailed->after](const twin::StandChange &change) {
        return after(change, false);
      };
      model.detailed.reset();
      return;
    }
}
}  // namespace

AdvisedModel advised_model(const Case &the_case, const StandAdvice &asked, const RolledAdvice &rolled,
                           const Components &components)
{
  AdvisedModel model;
  if (const auto *lumped = std::get_if<Lumped>(&the_case.spec); lumped && lumped->detailed) {
    const auto files    = model_from_files(lumped->model);
    const double damper = std::isnan(lumped->model.gap_damper) ? 0 : lumped->model.gap_damper;
    model.limit         = lumped->model.frequency_limit;
    model.source        = "model " + lumped->model.name + " of its files";
    model.advised.stand =
        in_its_modes(files.model, files.modes, lumped->dynamics.modal_damping, 2 * model.limit, damper);
    model.notes.emplace_back(NoteId::springs_not_tried, "", "the stand comes from files",
                             "dampers are tried, springs are not");
    return model;
  }
  const CaseChain chain         = case_chain(the_case, "advise");
  const auto mill_model         = dynamics::mill_model(chain.model, chain.dynamics);
  const auto n                  = mill_model.M.size();
  model.limit                   = chain.dynamics.frequency_limit;
  model.source                  = chain.source;
  const Eigen::VectorXd damping = Eigen::VectorXd::Constant(n, chain.dynamics.modal_damping);
  model.advised.stand = twin::vibrating_stand(mill_model, damping, gap_damper_of(chain.model, chain.dynamics));
  model.advised.chain = mill_model;
  if (chain.dynamics.contact == ContactSprings::curve)
    model.notes.push_back("contacts on curves count with their slopes at the working load");
  add_errors(model, the_case, chain.model, chain.load);
  if (const auto *four = std::get_if<FourHigh>(&the_case.spec)) {
    model.advised.open = [&the_case, load = chain.load, mill_model, damping](const twin::StandChange &change) {
      if (change.force == 1)
        return std::optional(twin::open_stand(mill_model, damping, change));
      const CaseChain there = case_chain(the_case, "advise", load * change.force);
      return std::optional(twin::open_stand(dynamics::mill_model(there.model, there.dynamics), damping, change));
    };
    add_pass(model, the_case, *four, rolled, chain);
    model.detailed = detailed_stand(the_case, *four, chain, rolled.model, components);
    take_detailed_for_its_places(model, asked);
  }
  return model;
}
}  // namespace mill
