#pragma once
#include "core/case/bearing_inputs.h"
#include "core/case/bite_inputs.h"
#include "core/case/chain_inputs.h"
#include "core/case/contact_inputs.h"
#include "core/case/response_inputs.h"
#include "core/model/dynamics_settings.h"
#include "core/model/given.h"
#include "core/model/pass.h"
#include "core/model/roll_kind.h"
#include "core/records/chain_number.h"
#include "core/records/key_list.h"
#include <string>
#include <vector>

// Which keys of the case stand behind a result.  A run writes these lists as `inputs`, a trace follows the same
// ones.  A list is the rows that move the inputs of a stage, or is joined from such lists.
namespace mill {
class MovingKeys;

/// What the working load of a pass is made from: its own key, or the record whose mean it is.
KeyList load_keys(const Pass &pass, std::size_t p);

/// A spring that the chain of a stand takes from elsewhere: K3, K4, K5, a bearing, or both of a backup roll.
KeyList spring_keys(MovingKeys &keys, const NamedSpring &spring, std::size_t p);

/// A mode or a response of the six-mass chain follows the whole chain; with the measured force the bite has no
/// spring, and in an open frame nothing else joins the upper half to the lower one.
enum class Half { upper, lower };
/// Masses M1 .. M6 and springs K1 .. K7 of the chain.
std::vector<ChainNumber> chain_parts(const DynamicsSettings &dynamics, Half half);
/// The keys behind those numbers.
KeyList chain_number_keys(const LumpedModel &model, const DynamicsSettings &dynamics, Half half);
/// And what joins them to modes.
KeyList chain_mode_keys(MovingKeys &keys, const LumpedModel &model, const DynamicsSettings &dynamics, Half half);
/// Of a horizontal mode: mass and bearing of its roll; the seat of its chocks comes on top where the stand is
/// drawn.
KeyList horizontal_mode_keys(const LumpedModel &model, RollPlace roll);

/// A given value has its own key as its only input.
void set_given_inputs(GivenValues &given);
void set_given_inputs(LumpedModel &model);
}  // namespace mill
