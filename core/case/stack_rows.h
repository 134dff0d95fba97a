#pragma once
#include "core/case/stand_rows.h"
#include "core/model/stack_input.h"

// Rows of kind = "stack".
namespace mill {
const std::vector<Field<StackSettings>> &stack_settings_rows();
const std::vector<Field<StackRollInput>> &stack_roll_rows();
const std::vector<Field<StackSaddles>> &stack_saddle_rows();
const std::vector<Field<StackStripInput>> &stack_strip_rows();
const std::vector<Field<StackEngine>> &stack_engine_rows();
const std::vector<Field<StackWindow>> &stack_window_rows();
const std::vector<Field<DynamicsSettings>> &stack_dynamics_rows();
const std::vector<Field<StackMaterial>> &stack_material_rows();
}  // namespace mill
