#include "app/stages/response/contact_curves.h"
#include "app/stages/contact/contact_stage.h"
#include "app/stages/response/dynamics_stage.h"
#include "app/stages/stand/mode_results.h"
#include "core/model/pass.h"
#include "core/records/chain_number.h"
#include "core/records/stand_place.h"
#include "dynamics/nonlinear/contact_law.h"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <optional>

namespace mill {
namespace {
using dynamics::ConnectionCurve;
using dynamics::SpringLaw;

constexpr double most_correction =
    0.05;  // of a slope, beyond which the curve and the number are not one contact's

SpringLaw law_of(const std::vector<double> &load, const std::vector<double> &compression, const std::string &what)
{
  const SpringLaw law(load, compression);
  if (!law.usable())
    throw InputError(
        fmt::format("dynamics.contact = \"curve\": the computed curve of {} does not rise from sample "
                    "to sample; set \"linear\"",
                    what));
  return law;
}

SpringLaw law_of(const ChainCurves::Curve &pairs)
{
  std::vector<double> load, compression;
  for (const auto &pair : pairs) {
    load.push_back(pair[0]);
    compression.push_back(pair[1]);
  }
  return SpringLaw(load, compression);
}

double slope_at(const SpringLaw &law, const double load)
{
  return law.at(law.compression(load)).stiffness;
}

/// A law with the slope of the linear model at its load.
struct Fitted {
  SpringLaw law;
  double corrected = 0;  // -, slope of the linear model over that of the samples, less 1
  double smoothed  = 0;  // -, largest deviation of the curve from the samples
};

Fitted with_slope(const SpringLaw &law, const double load, const double stiffness, const std::string &what)
{
  const double slope = slope_at(law, load);
  Fitted fitted{law.in_series_with(1 / stiffness - 1 / slope), stiffness / slope - 1};
  if (!fitted.law.usable())
    throw InputError(
        fmt::format("dynamics.contact = \"curve\": {} has the slope {:.4g} N/m at {}, its curve {:.4g}; "
                    "they are not of one contact",
                    what, stiffness, in_kN(load), slope));
  return fitted;
}

void require_load(const Pass &pass, const double load)
{
  if (!(load > 0))
    throw InputError(
        pass.force_place,
        fmt::format("{}: dynamics.contact = \"curve\" needs the load of the contacts at rest, and the "
                    "mean of the force record is {}; give pass.load",
                    pass.name, in_kN(load)));
}

NonlinearSpring spring_record(const ConnectionCurve &curve, const Fitted &fitted, const double stiffness)
{
  NonlinearSpring spring;
  spring.name      = curve.name;
  spring.rest      = curve.load;
  spring.stiffness = stiffness;
  spring.corrected = fitted.corrected;
  spring.smoothed  = fitted.smoothed;
  spring.low       = curve.law.least_load();
  spring.high      = curve.law.largest_load();
  return spring;
}

// "K2" of the chain; in a detailed stand the spring that holds the bearings.
const Connection *bearing_connection(const StandModel &stand, const bool upper)
{
  for (const Connection &c : stand.connections)
    if (c.name == word_of(upper ? ChainNumber::K2 : ChainNumber::K6) ||
        has_spring(c.name, upper ? SeatSpring::upper : SeatSpring::lower))
      return &c;
  return nullptr;
}

std::vector<std::string> names_of(const reduce::StandWithModes &stand)
{
  std::vector<std::string> names;
  for (const reduce::ModeName &mode : stand.names)
    names.push_back(mode.name);
  return names;
}

// A roll contact, with the slope that the chain has for it.
Fitted contact_law(const ContactCurve &contact, const reduce::LumpedStand &chain, const bool upper,
                   const double load)
{
  const char *name   = upper ? "K3" : "K5";
  const auto samples = dynamics::smooth_contact(contact.load, contact.approach);
  Fitted fitted =
      with_slope(law_of(samples.load, samples.compression, name), load, chain.model.K[upper ? 2 : 4].value, name);
  fitted.smoothed = samples.deviation;
  return fitted;
}

// Both bearings of a roll, with the slope that the chain has for them.
std::optional<Fitted> bearing_law(const StandCurves &curves, const reduce::LumpedStand &chain, const bool upper,
                                  const double load)
{
  if (!curves.bearings || (*curves.bearings)[upper ? 0 : 1].load.size() < 2)
    return std::nullopt;
  const reduce::LoadDeflection &samples = (*curves.bearings)[upper ? 0 : 1];
  const std::string what = upper ? "the upper backup-roll bearings" : "the lower backup-roll bearings";
  return with_slope(law_of({samples.load.begin(), samples.load.end()},
                           {samples.deflection.begin(), samples.deflection.end()}, what),
                    load, (upper ? chain.K_Zy_upper : chain.K_Zy_lower).value, what);
}

// The stand on its curves, in the modes in which it is driven: all six of a chain.
void finish(CurveDrive &made, const std::vector<ConnectionCurve> &curves, const reduce::StandWithModes &stand,
            const LumpedModel &chain, DynamicsSettings settings, const bool detailed)
{
  if (!detailed)
    settings.frequency_limit = std::numeric_limits<double>::infinity();
  made.modal      = driven_modes(stand, chain, settings);
  made.stand      = dynamics::curve_stand(stand.model, stand.modes.frequency, stand.modes.shape, curves,
                                          made.modal.damping, 2 * settings.frequency_limit, made.modal.gap_damper);
  made.mode_names = names_of(stand);
  made.highest    = settings.frequency_limit;
}
}  // namespace

CurveDrive curve_drive(RunContext &run, const StandCurves &curves, const reduce::LumpedStand &chain,
                       const reduce::StandWithModes *detailed, const DynamicsSettings &settings, const Pass &pass,
                       const double load)
{
  require_load(pass, load);
  const reduce::StandWithModes six = detailed ? reduce::StandWithModes() : chain_with_modes(chain.model, settings);
  const reduce::StandWithModes &driven = detailed ? *detailed : six;
  CurveDrive made;
  std::vector<ConnectionCurve> all;
  const auto add = [&](const std::string &connection, const char *name, const Fitted &fitted, const double K) {
    all.push_back({connection, name, fitted.law, load});
    made.springs.push_back(spring_record(all.back(), fitted, K));
    if (std::abs(fitted.corrected) > most_correction)
      run.warn({WarningId::curve_slope,
                pass.name,
                fmt::format("{} has a slope {:+.1f} % off that of its curve at {}", name, 100 * fitted.corrected,
                            in_kN(load)),
                fmt::format("the response on the curve takes the curve's shape and the slope of {}", name),
                "",
                {name, pass.name}});
  };
  const auto add_bearings = [&](const bool upper) {
    const auto bearing     = bearing_law(curves, chain, upper, load);
    const Connection *line = bearing_connection(driven.model, upper);
    if (!bearing || !line)
      return run.assume(
          fmt::format("{}: the bearings of the {} backup roll stay linear, no curve of them is computed "
                      "for this pass",
                      pass.name, upper ? "upper" : "lower"));
    const double whole = line->stiffness.sum(), K_Zy = (upper ? chain.K_Zy_upper : chain.K_Zy_lower).value;
    add(line->name, upper ? "K2" : "K6",
        {bearing->law.in_series_with(1 / whole - 1 / K_Zy), bearing->corrected, bearing->smoothed}, whole);
  };
  const auto add_contact = [&](const bool upper) {
    const ContactCurve *contact = upper ? curves.upper : curves.lower;
    const char *name            = upper ? "K3" : "K5";
    if (!contact)
      throw InputError(
          fmt::format("dynamics.contact = \"curve\": no curve of {} is computed; leave given.{} out", name, name));
    add(name, name, contact_law(*contact, chain, upper, load), chain.model.K[upper ? 2 : 4].value);
  };
  add_bearings(true);
  add_contact(true);
  add_contact(false);
  add_bearings(false);
  finish(made, all, driven, chain.model, settings, detailed != nullptr);
  made.load = load;
  return made;
}

LumpedModel at_load(RunContext &run, LumpedModel model, const ChainCurves &curves,
                    const DynamicsSettings &settings, const Pass &pass, const double load)
{
  require_load(pass, load);
  std::string linear;
  for (int i = 2; i <= 6; ++i) {
    if (i == 4 && settings.force_meaning == ForceMeaning::measured)
      continue;
    if (curves.of(i).empty()) {
      linear += fmt::format("{}K{}", linear.empty() ? "" : ", ", i);
      continue;
    }
    Parameter &K       = model.K[std::size_t(i - 1)];
    const double slope = slope_at(law_of(curves.of(i)), load);
    if (std::abs(slope / K.value - 1) > most_correction)
      run.warn({WarningId::given_off_curve,
                pass.name,
                fmt::format("given.K{} is {:+.1f} % off the slope of curve.K{} at {}", i,
                            100 * (K.value / slope - 1), i, in_kN(load)),
                "f1 to f6 are of the first, the response of the second",
                "",
                {fmt::format("K{}", i), pass.name},
                fmt::format("given.K{}", i)});
    K.value = slope;
  }
  if (!linear.empty())
    run.assume(fmt::format("{}: {} stay linear, because [curve] does not contain them", pass.name, linear));
  return model;
}

CurveDrive curve_drive(const ChainCurves &curves, const DynamicsSettings &settings, const LumpedModel &given,
                       const LumpedModel &model, const double load)
{
  CurveDrive made;
  std::vector<ConnectionCurve> all;
  for (int i = 2; i <= 6; ++i) {
    if (curves.of(i).empty() || (i == 4 && settings.force_meaning == ForceMeaning::measured))
      continue;
    const std::string name = fmt::format("K{}", i);
    all.push_back({name, name, law_of(curves.of(i)), load});
    const double slope = slope_at(all.back().law, load);
    made.springs.push_back(
        spring_record(all.back(), {all.back().law, given.K[std::size_t(i - 1)].value / slope - 1, 0}, slope));
  }
  finish(made, all, chain_with_modes(model, settings), model, settings, false);
  made.load = load;
  return made;
}

ChainCurves chain_curves_of(const StandCurves &curves, const reduce::LumpedStand &chain, const double load)
{
  ChainCurves made;
  const auto add = [&](ChainCurves::Curve &into, const Eigen::VectorXd &loads, const SpringLaw &law) {
    for (const double F : loads)
      into.push_back({F, law.compression(F)});
  };
  for (const bool upper : {true, false}) {
    if (const auto bearing = bearing_law(curves, chain, upper, load)) {
      const double whole = chain.model.K[upper ? 1 : 5].value,
                   K_Zy  = (upper ? chain.K_Zy_upper : chain.K_Zy_lower).value;
      add(upper ? made.K2 : made.K6, (*curves.bearings)[upper ? 0 : 1].load,
          bearing->law.in_series_with(1 / whole - 1 / K_Zy));
    }
    if (const ContactCurve *contact = upper ? curves.upper : curves.lower)
      add(upper ? made.K3 : made.K5, contact->load, contact_law(*contact, chain, upper, load).law);
  }
  return made;
}
}  // namespace mill
