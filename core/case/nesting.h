#pragma once
#include "core/base/errors.h"
#include <optional>
#include <string>

namespace mill {
/// Levels that a TOML text may open within one another, and names that one dotted key may have.  No case needs
/// more than five; a parser, and every function that walks a tree, needs stack for each level.
constexpr int deepest_nesting = 16;

/// Where a TOML text first opens more than `deepest_nesting` brackets or dots more names in one key; nothing when
/// it does not.  Strings and comments are left out.  Cost: one pass over the text, before any parser sees it.
std::optional<Place> too_deep(const std::string &toml, const std::string &file);

/// The sentence that goes with that place.
std::string nesting_refusal();
}  // namespace mill
