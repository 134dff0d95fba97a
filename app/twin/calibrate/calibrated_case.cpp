#include "app/twin/calibrate/calibrated_case.h"
#include "app/twin/calibrate/stated_errors.h"
#include "app/twin/stand/case_chain.h"
#include "core/case/fields.h"
#include "core/case/lumped_model_toml.h"
#include "core/model/assumed_error.h"
#include "core/model/case.h"
#include "core/records/number_in_chain.h"
#include "twin/calibration/words.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double contact_sd = 0.05, least_sd = 0.01;
}  // namespace

std::string calibration_comment(const Case &origin, const twin::Calibration &result,
                                const std::vector<std::string> &files, const bool accepted)
{
  std::string text = "# Calibrated case: " + origin.path + " with\n";
  for (const std::string &file : files)
    text += "#   " + file + "\n";
  if (!result.force_recorded())
    text += "# " + twin::without_force_words() + "\n";
  for (const twin::Calibrated &u : result.unknowns)
    if (const twin::ShownChange shown = twin::shown_change(u, true); u.taken)
      text += fmt::format("# {:<5} {} (95 % {} .. {}){}\n", u.name, shown.value, shown.low, shown.high,
                          u.identified ? "" : ": " + u.why_not);
    else
      text += fmt::format("# {:<5} kept: {}\n", u.name, u.why_not);
  for (const std::string &direction : result.unseen)
    text += "# " + direction + "\n";
  for (const std::string &mode : twin::open_mode_words(result.modes))
    text += "# " + mode + "\n";
  if (accepted)
    for (const std::string &reason : result.refusals)
      text += "# REFUSED, written because of --accept: " + reason + "\n";
  return text;
}

double prior_of_spring(const std::string &name, const double error, const bool computed)
{
  const bool contact = computed && is_roll_contact(name);
  if (!std::isfinite(error))
    return contact ? contact_sd : assumed_spring_error;
  return std::max(error, contact ? contact_sd : least_sd);
}

double prior_of_mass(const double error)
{
  return std::isfinite(error) ? std::max(error, least_sd / 2) : assumed_spring_error;
}

namespace {
void add_prior_notes(PriorChain &chain, const StatedErrors &errors)
{
  if (!errors.source.empty())
    chain.notes.push_back("deviations before the records are the errors stated by " + errors.source);
  std::string silent;
  for (const twin::Unknown &spring : chain.springs)
    if (twin::moves(spring) == twin::Moves::parts && errors.error.count(spring.name) == 0)
      silent += (silent.empty() ? "" : ", ") + spring.name;
  if (!silent.empty())
    chain.notes.emplace_back(NoteId::error_not_stated, "", "no error is stated for " + silent,
                             "the deviation before the records is that of a value without one",
                             "run the case first, or state a tolerance");
}
}  // namespace

double damping_to_start_from(const DynamicsSettings &dynamics)
{
  if (!(dynamics.modal_damping > 0))
    throw InputError("dynamics.modal_damping = 0: a calibration starts from a damping ratio above zero, for "
                     "example 0.01");
  return dynamics.modal_damping;
}

std::string place_name(std::string label)
{
  std::replace_if(
      label.begin(), label.end(), [](const char c) { return c == ' ' || c == '-'; }, '_');
  return label;
}

PriorChain prior_chain(const Case &the_case, const double load)
{
  if (!std::holds_alternative<FourHigh>(the_case.spec) && !std::holds_alternative<Lumped>(the_case.spec))
    throw InputError("millstand calibrate: the case " + the_case.path +
                     " has no chain of six masses; name a case of kind four-high, or of kind lumped with [given]");
  PriorChain chain;
  const CaseChain analysed  = case_chain(the_case, "calibrate", load);
  chain.model               = analysed.model;
  chain.source              = analysed.source;
  DynamicsSettings settings = analysed.dynamics;
  if (settings.force_meaning != ForceMeaning::measured)
    chain.notes.emplace_back(
        NoteId::force_meaning, "",
        std::string("force_meaning = \"") + word_of(settings.force_meaning) + "\" of the case",
        "a record's force is the whole bite force, so K4 and C have no part in the calibration "
        "and stay as they are",
        "", std::vector<std::string>{}, "dynamics.force_meaning");
  settings.force_meaning = ForceMeaning::measured;
  const double damping   = damping_to_start_from(settings);
  chain.stand.chain      = dynamics::mill_model(chain.model, settings);
  chain.stand.damping    = Eigen::VectorXd::Constant(chain.stand.chain.M.size(), damping);
  for (const std::string &label : chain.stand.chain.labels)
    chain.places.push_back(place_name(label));
  const StatedErrors errors = stated_errors(the_case, chain.model, analysed.load);
  for (std::size_t j = 0; j < chain.stand.chain.springs.size(); ++j) {
    const auto &spring = chain.stand.chain.springs[j];
    if (!(spring.stiffness > 0) || j >= chain.model.K.size())
      continue;
    const Parameter &value = chain.model.K[j];
    const bool computed    = value.source == Source::computed || value.source == Source::estimated;
    const auto error       = errors.error.find(spring.name);
    chain.springs.push_back(
        {spring.name,
         prior_of_spring(spring.name, error == errors.error.end() ? not_given : error->second, computed), 0});
  }
  chain.springs.push_back({twin::ratios_name, std::log(2.0), 0});
  for (std::size_t i = 0; i < chain.model.M.size(); ++i) {
    const std::string name = "M" + std::to_string(i + 1);
    const auto error       = errors.error.find(name);
    chain.masses.push_back({name, prior_of_mass(error == errors.error.end() ? not_given : error->second), 0});
    if (error != errors.error.end())
      chain.stated.push_back(name);
  }
  add_prior_notes(chain, errors);
  return chain;
}

DynamicsSettings &dynamics_of(Case &the_case)
{
  return std::holds_alternative<FourHigh>(the_case.spec) ? std::get<FourHigh>(the_case.spec).dynamics
                                                         : std::get<Lumped>(the_case.spec).dynamics;
}

Case with_damping(const Case &origin, const twin::Calibration &result)
{
  Case changed  = origin;
  double change = 0;  // ln of the geometric mean over all modes; the ratio of a mode that is not freed stays
  for (const twin::Calibrated &u : result.unknowns)
    if (u.taken && twin::moves_damping(u))
      change += twin::moves(u) == twin::Moves::ratios
                    ? u.kept
                    : u.kept / double(std::max<std::size_t>(1, result.modes.size()));
  dynamics_of(changed).modal_damping *= std::exp(change);
  return changed;
}

namespace {
/// K or M of a model by its name; null: it has no such number.
Parameter *number_of(LumpedModel &model, const std::string &name)
{
  const auto number = choice_named<ChainNumber>(name);
  return number ? number_in_chain(model, *number) : nullptr;
}

void calibrate(Parameter &number, const twin::Calibrated &u, const std::string &method)
{
  const twin::ChangeInterval change = twin::change_interval(u, true);
  const double before               = number.value;
  number.value                      = before * std::exp(change.value);
  number.source                     = Source::measured;
  number.method                     = method;
  number.error_estimate             = twin::deviation_of(change);
  number.error_lacks                = {};
  number.checks                     = {{"95 % from", before * std::exp(change.low), ""},
                                       {"95 % to", before * std::exp(change.high), ""},
                                       {"before", before, "value of the given case"}};
}
}  // namespace

std::string calibrated_toml(const PriorChain &chain, const Case &origin, const twin::Calibration &result,
                            const std::vector<std::string> &files, const bool accepted,
                            const std::string &directory)
{
  std::string method = "records ", not_identified;
  for (std::size_t i = 0; i < files.size(); ++i)
    method += (i ? ", " : "") + files[i];
  for (const twin::Calibrated &u : result.unknowns)
    if (!u.identified)
      not_identified += (not_identified.empty() ? "" : ", ") + u.name;
  if (!result.force_recorded())
    method += "; no force recorded";
  method += "; not identified: " + (not_identified.empty() ? "none" : not_identified);
  if (accepted)
    method += "; refused, accepted by the user";
  LumpedModel model = chain.model;
  for (const twin::Calibrated &u : result.unknowns)
    if (u.taken)
      for (const std::string &member : twin::members_of(u.name))
        if (Parameter *number = number_of(model, member))
          calibrate(*number, u, "calibrated: " + method);
  return calibration_comment(origin, result, files, accepted) +
         lumped_model_toml(model, with_damping(origin, result), directory);
}
}  // namespace mill
