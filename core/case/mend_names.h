#pragma once
#include "core/case/fields.h"
#include <string>

namespace mill {
/// One typo, one error.  An unknown name of a section or of a key that is near to one that is missing
/// becomes a problem ("did you mean 'barrel_diameter'?") and is renamed in the tree, so that what stands under it
/// is read and checked and no further key is reported as missing.  Names that are near to no known name, or to a
/// name that is there too, stay for the readers. Cost: product of the keys of the file and those of the kind.
void mend_names(Node &root, const std::string &kind, Reading &reading);

/// The same for the values above all sections, which say what kind the case is.
void mend_head(Node &root, Reading &reading);
}  // namespace mill
