#include "core/case/response_inputs.h"
#include "core/base/require.h"
#include "core/case/moving_keys.h"
#include "core/case/pass_inputs.h"
#include "core/model/case.h"
#include "core/model/four_high.h"
#include "core/model/lumped.h"
#include "core/records/record_text.h"
#include <fmt/format.h>
#include <type_traits>

namespace mill {
namespace {
// Calls one of the kinds of case that vibrate as a stand.
template <class Call> std::string of_stand(const CaseSpec &spec, const Call &call)
{
  return std::visit(
      [&](const auto &one) -> std::string {
        using Spec = std::decay_t<decltype(one)>;
        if constexpr (std::is_same_v<Spec, FourHigh> || std::is_same_v<Spec, Lumped>)
          return call(one);
        else
          require(false, "a case of this kind has no response of a stand");
        return "";
      },
      spec);
}

// Springs on curves are those at the working load.
std::string text_of_curves(const FourHigh &, const Pass &pass)
{
  return record_text(inputs_of_load(pass));
}
std::string text_of_curves(const Lumped &lumped, const Pass &pass)
{
  const ChainCurves &curves = lumped.curves;
  const bool strip          = lumped.dynamics.force_meaning != ForceMeaning::measured;
  return record_text(inputs_of_load(pass), curves.K2, curves.K3, strip ? curves.K4 : ChainCurves::Curve(),
                     curves.K5, curves.K6);
}

// A drawn housing is already closed; six masses and beams are not.
bool reads_frame(const FourHigh &stand)
{
  return stand.dynamics.model != StandModelKind::craig_bampton || !stand.housing.present();
}
bool reads_frame(const Lumped &)
{
  return true;
}

template <class Stand> std::string text_of_model(const Stand &stand, const Pass &pass)
{
  const DynamicsSettings &dynamics = stand.dynamics;
  std::string text                 = record_text(dynamics.model, dynamics.contact);
  if (reads_frame(stand))
    text += record_text(dynamics.frame);
  if (dynamics.contact == ContactSprings::curve)
    text += text_of_curves(stand, pass);
  if (dynamics.model != StandModelKind::six_mass)
    text += record_text(dynamics.frequency_limit, dynamics.elements_per_radius);
  return text;
}

// Matrices know no frame and no curves.
std::string text_of_files(const ModelFiles &files, const ForceMeaning force)
{
  const double damper = force == ForceMeaning::measured ? not_given : files.gap_damper;
  return record_text(files.mass, files.stiffness, files.force, files.readings, damper, files.frequency_limit);
}
}  // namespace

std::string text_of_response(const CaseSpec &spec, const std::size_t p, const ResponseReading reading)
{
  return of_stand(spec, [&](const auto &stand) {
    const DynamicsSettings &dynamics = stand.dynamics;
    const Pass &pass                 = stand.passes[p];
    std::string text = record_text(inputs_of_force(pass), dynamics.modal_damping, dynamics.force_meaning);
    if (reading != ResponseReading::white)
      text += record_text(dynamics.output_rate);
    if (reading != ResponseReading::model)
      return text + record_text(dynamics.frame);
    if constexpr (std::is_same_v<std::decay_t<decltype(stand)>, Lumped>)
      if (stand.detailed)
        return text + text_of_files(stand.model, dynamics.force_meaning);
    return text + text_of_model(stand, pass);
  });
}

std::string text_of_frequency_response(const CaseSpec &spec)
{
  return of_stand(spec, [](const auto &stand) {
    return record_text(stand.dynamics.modal_damping, int(driven_state(stand.dynamics)),
                       stand.frequency_response.range, stand.frequency_response.resolution);
  });
}

std::string text_of_campbell(const CaseSpec &spec)
{
  return of_stand(spec, [](const auto &stand) {
    const CampbellSettings &settings = stand.campbell;
    std::string text =
        record_text(settings.speeds, settings.working_speeds, settings.roll_orders, settings.bearing_harmonics,
                    settings.work_roll_diameter, settings.backup_roll_diameter);
    for (const DriveOrder &order : stand.drive)
      text += record_text(order.per_turn_of, order.count);
    return text;
  });
}

KeyList response_keys(MovingKeys &keys, const std::size_t p, const ResponseReading reading)
{
  return keys.of(fmt::format("response {} {}", p, int(reading)),
                 [&](const CaseSpec &spec) { return text_of_response(spec, p, reading); });
}

KeyList frequency_response_keys(MovingKeys &keys)
{
  return keys.of("frequency response", text_of_frequency_response);
}

KeyList campbell_keys(MovingKeys &keys)
{
  return keys.of("campbell", text_of_campbell);
}
}  // namespace mill
