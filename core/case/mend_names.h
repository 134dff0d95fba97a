#pragma once
#include "core/case/fields.h"
#include <string>

namespace mill {
/// One typo, one error.  A name of a section or of a key that is no known one but near to one that is missing
/// becomes a problem ("did you mean 'barrel_diameter'?") and is renamed in the tree, so that what stands under it
/// is read and checked and nothing else is said to be missing.  Names that are near to nothing, or to a name that
/// is there too, stay for the readers. Cost: product of the keys of the file and those of the kind.
void mend_names(Node &root, const std::string &kind, Reading &reading);

/// The same for the values above all sections, which say what kind the case is.
void mend_head(Node &root, Reading &reading);
}  // namespace mill
