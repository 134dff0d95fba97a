#include "app/twin/calibrate/calibrated_case.h"
#include "app/twin/stand/case_chain.h"
#include "core/case/fields.h"
#include "core/case/lumped_model_toml.h"
#include "core/model/case.h"
#include "twin/calibration/words.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace mill {
namespace {
constexpr double given_sd = 0.10, contact_sd = 0.05, least_sd = 0.01;
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
    if (const twin::ShownChange shown = twin::shown_change(u); u.told)
      text += fmt::format("# {:<5} {} (95 % {} .. {})\n", u.name, shown.kept, shown.low, shown.high);
    else
      text += fmt::format("# {:<5} kept: {}\n", u.name, u.why_not);
  for (const std::string &direction : result.unseen)
    text += "# " + direction + "\n";
  if (accepted)
    for (const std::string &reason : result.refusals)
      text += "# REFUSED, written because of --accept: " + reason + "\n";
  return text;
}

double prior_of_spring(const std::string &name, const double error, const bool computed)
{
  const bool contact = computed && (name == "K3" || name == "K5");
  if (!std::isfinite(error))
    return contact ? contact_sd : given_sd;
  return std::max(error, contact ? contact_sd : least_sd);
}

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
  if (settings.force_meaning != "measured")
    chain.notes.push_back("force_meaning = \"" + settings.force_meaning +
                          "\" of the case: a record's force is the whole bite force, so K4 and C have no part in "
                          "the calibration and stay as they are");
  settings.force_meaning = "measured";
  const double damping   = damping_to_start_from(settings);
  chain.stand.chain      = dynamics::mill_model(chain.model, settings);
  chain.stand.damping    = Eigen::VectorXd::Constant(chain.stand.chain.M.size(), damping);
  for (const std::string &label : chain.stand.chain.labels)
    chain.places.push_back(place_name(label));
  for (std::size_t j = 0; j < chain.stand.chain.springs.size(); ++j) {
    const auto &spring = chain.stand.chain.springs[j];
    if (!(spring.stiffness > 0) || j >= chain.model.K.size())
      continue;
    const Parameter &value = chain.model.K[j];
    const bool computed    = value.source == Source::computed || value.source == Source::estimated;
    chain.springs.push_back({spring.name, prior_of_spring(spring.name, value.error_estimate, computed), 0});
  }
  chain.springs.push_back({"zeta", std::log(2.0), 0});
  return chain;
}

std::vector<twin::Unknown> chosen(const PriorChain &chain, const std::string &free)
{
  if (free.empty())
    return chain.springs;
  std::vector<twin::Unknown> unknowns;
  std::vector<std::string> known;
  for (const twin::Unknown &unknown : chain.springs)
    known.push_back(unknown.name);
  for (Eigen::Index i = 0; i < chain.stand.damping.size(); ++i)
    known.push_back("zeta" + std::to_string(i + 1));
  for (const std::string &name : split(free, ",")) {
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError("--free " + free + ": " + name + " is nothing that can be fitted" +
                       suggestion(name, known));
    const auto twice =
        std::any_of(unknowns.begin(), unknowns.end(), [&](const auto &u) { return u.name == name; });
    if (twice)
      throw InputError("--free " + free + ": " + name + " is there twice");
    const auto spring = std::find_if(chain.springs.begin(), chain.springs.end(),
                                     [&](const twin::Unknown &u) { return u.name == name; });
    unknowns.push_back(spring != chain.springs.end() ? *spring : twin::Unknown{name, std::log(2.0), 0});
  }
  return unknowns;
}

DynamicsSettings &dynamics_of(Case &the_case)
{
  return std::holds_alternative<FourHigh>(the_case.spec) ? std::get<FourHigh>(the_case.spec).dynamics
                                                         : std::get<Lumped>(the_case.spec).dynamics;
}

Case with_damping(const Case &origin, const twin::Calibration &result)
{
  Case changed = origin;
  for (const twin::Calibrated &u : result.unknowns)
    if (u.name == "zeta" && u.told)
      dynamics_of(changed).modal_damping *= std::exp(u.kept);
  return changed;
}

std::string calibrated_toml(const PriorChain &chain, const Case &origin, const twin::Calibration &result,
                            const std::vector<std::string> &files, const bool accepted,
                            const std::string &directory)
{
  std::string method = "records ", not_told;
  for (std::size_t i = 0; i < files.size(); ++i)
    method += (i ? ", " : "") + files[i];
  for (const twin::Calibrated &u : result.unknowns)
    if (!u.told)
      not_told += (not_told.empty() ? "" : ", ") + u.name;
  if (!result.force_recorded())
    method += "; no force recorded";
  method += "; not told: " + (not_told.empty() ? "none" : not_told);
  if (accepted)
    method += "; refused, accepted by the user";
  LumpedModel model = chain.model;
  for (const twin::Calibrated &u : result.unknowns) {
    if (u.name.size() != 2 || u.name[0] != 'K' || !u.told)
      continue;
    Parameter &spring     = model.K[std::size_t(u.name[1] - '1')];
    const double before   = spring.value;
    spring.value          = before * std::exp(u.kept);
    spring.source         = Source::measured;
    spring.method         = "calibrated: " + method;
    spring.error_estimate = u.sd;
    spring.error_lacks    = {};
    spring.checks         = {
                {"95 % from", before * std::exp(u.low),  ""                       },
                {"95 % to",   before * std::exp(u.high), ""                       },
                {"before",    before,                    "value of the given case"}
    };
  }
  return calibration_comment(origin, result, files, accepted) +
         lumped_model_toml(model, with_damping(origin, result), directory);
}
}  // namespace mill
