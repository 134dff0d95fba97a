#pragma once
#include "core/case/case_file.h"
#include "core/case/fields.h"

namespace mill {
/// Keys that were renamed are accepted under their old name: the tree gets the present name, and `reading` a
/// warning that says so.  Where both names are given the old one stays, and is refused as an unknown key.
void accept_old_keys(Node &root, Reading &reading);
}  // namespace mill
