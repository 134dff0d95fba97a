#pragma once
#include "core/model/frame.h"
#include "core/model/roll_kind.h"
#include "core/records/key_list.h"
#include <vector>

// What stands behind masses, springs and modes of a stand, part by part; as core/case/contact_inputs.h.
// reduce/chain/chain_keys joins the parts of a drawing.
namespace mill {
class MovingKeys;

/// Who answers: a run, or the closed forms of a trace, which know no meshes and no fillets.
enum class ChainReading { run, closed_form };

/// Stiffnesses or masses of the frame; those that [housing] or [screwdown] draws have the keys of the drawing.
/// @param keys  of a four-high stand, here and below
KeyList frame_keys(MovingKeys &keys, const std::vector<double Frame::*> &parts, ChainReading reading);

/// Stiffnesses or masses of a drawn [housing]; what it does not give is that of the rolls.
KeyList housing_keys(MovingKeys &keys, bool masses, ChainReading reading);

/// Modes of one housing by itself, up to the limit of the case.
KeyList bare_housing_keys(MovingKeys &keys);

/// The stiffness that the modulus of a frame leaves for its parts, but for the springs of the chain.
KeyList closure_keys(MovingKeys &keys);

/// A backup roll that bends on its bearing centres: a beam (4.8a), or its meshes (22.13).
/// @param scaled  its stiffness is given: its shape does not depend on the modulus
KeyList bent_backup_keys(MovingKeys &keys, bool solid, bool scaled);

/// What moves with a roll, but for its static shape.
KeyList moving_roll_keys(MovingKeys &keys, RollPlace roll);
/// Where the shapes behind M2..M5 come from.
KeyList mass_shape_keys(MovingKeys &keys);

/// What joins masses and springs of the chain to modes, of a stand drawn or lumped.
KeyList frame_form_keys(MovingKeys &keys);
/// Beams and reduced finite elements, in addition to the chain.
KeyList detailed_model_keys(MovingKeys &keys);
}  // namespace mill
