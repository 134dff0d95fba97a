#pragma once
#include "core/case/fields.h"

namespace mill {
/// Names that a user gives to passes, conditions, bearings, rolls and the like become parts of the names of keys,
/// results and files (name_part()), where they are given and where they are referred to.
void make_names_parts(Node &root);
}  // namespace mill
