#include "core/case/provenance.h"
#include "core/base/require.h"
#include "core/case/moving_keys.h"
#include "core/case/stand_rows.h"
#include "core/model/case.h"
#include "core/model/lumped_model.h"
#include "core/records/contact_name.h"
#include "core/records/number_in_chain.h"
#include "core/records/record_text.h"
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace mill {
// Of one pass, whatever case it belongs to.
KeyList load_keys(const Pass &pass, const std::size_t p)
{
  Pass changed = pass;
  CaseRows rows;
  add_pass_rows(rows, p, pass_rows(), changed);
  return rows.moving([&] { return record_text(inputs_of_load(changed)); });
}

// Chain

KeyList spring_keys(MovingKeys &keys, const NamedSpring &spring, const std::size_t p)
{
  const BearingReading reading{spring.across ? BearingAsks::across : BearingAsks::along};
  const auto seat = [&](const RollPlace place) { return seat_keys(keys, std::size_t(place), p, reading); };
  switch (spring.number) {
  case ChainNumber::K3:
    return contact_keys(keys, word_of(ContactName::upper), p);
  case ChainNumber::K5:
    return contact_keys(keys, word_of(ContactName::lower), p);
  case ChainNumber::K4:
    return bite_keys(keys, p);
  case ChainNumber::K_Zy:
  case ChainNumber::Kzc1:
    return seat(RollPlace::upper_backup);
  case ChainNumber::Kzc2:
    return seat(RollPlace::upper_work);
  case ChainNumber::Kzc3:
    return seat(RollPlace::lower_work);
  case ChainNumber::K_Zy_lower:
  case ChainNumber::Kzc4:
    return seat(RollPlace::lower_backup);
  case ChainNumber::M1:
  case ChainNumber::M2:
  case ChainNumber::M3:
  case ChainNumber::M4:
  case ChainNumber::M5:
  case ChainNumber::M6:
  case ChainNumber::K1:
  case ChainNumber::K2:
  case ChainNumber::K6:
  case ChainNumber::K7:
  case ChainNumber::K_ZW:
    break;
  }
  require(false, std::string("the chain makes ") + word_of(spring.number) + " itself");
  return {};
}

std::vector<ChainNumber> chain_parts(const DynamicsSettings &dynamics, const Half half)
{
  const bool measured = dynamics.force_meaning == ForceMeaning::measured,
             apart    = measured && dynamics.frame == FrameForm::open;
  std::vector<ChainNumber> parts;
  const auto add = [&](const ChainNumber number, const bool upper) {
    if (!apart || upper == (half == Half::upper))
      parts.push_back(number);
  };
  for (int i = 0; i < 6; ++i)
    add(ChainNumber(int(ChainNumber::M1) + i), i < 3);
  for (int i = 0; i < 7; ++i)
    if (const auto spring = ChainNumber(int(ChainNumber::K1) + i); spring != ChainNumber::K4 || !measured)
      add(spring, i < 3);
  return parts;
}

KeyList chain_number_keys(const LumpedModel &model, const DynamicsSettings &dynamics, const Half half)
{
  KeyList keys;
  for (const ChainNumber part : chain_parts(dynamics, half))
    keys = joined(std::move(keys), number_in_chain(model, part)->inputs);
  return keys;
}

KeyList chain_mode_keys(MovingKeys &keys, const LumpedModel &model, const DynamicsSettings &dynamics,
                        const Half half)
{
  return joined(chain_number_keys(model, dynamics, half), frame_form_keys(keys));
}

KeyList horizontal_mode_keys(const LumpedModel &model, const RollPlace roll)
{
  const auto i           = std::size_t(roll);
  const Parameter across = model.Kzc_across[i];
  return joined(model.M[i + 1].inputs, std::isnan(across.value) ? model.Kzc[i].inputs : across.inputs);
}

void set_given_inputs(GivenValues &given)
{
  for (auto &[name, value] : given)
    value.parameter.inputs = {"given." + name};
}

void set_given_inputs(LumpedModel &model)
{
  const auto set = [](auto &list, const char *letter, const char *ending = "") {
    for (std::size_t i = 0; i < list.size(); ++i)
      list[i].inputs = {fmt::format("given.{}{}{}", letter, i + 1, ending)};
  };
  set(model.M, "M");
  set(model.K, "K");
  set(model.Kzc, "Kzc");
  set(model.Kzc_across, "Kzc", "_across");
  model.C.inputs = {"given.C"};
}
}  // namespace mill
