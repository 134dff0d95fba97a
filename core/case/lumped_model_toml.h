#pragma once
#include "core/model/lumped_model.h"
#include "core/model/pass.h"
#include <string>

namespace mill {
/// A given model of kind = "lumped": every missing M1..M6, K1..K7 has been reported by the reader.
struct Case;
LumpedModel lumped_model_of(const Case &lumped_case);

/// lumped_model.toml: a valid kind = "lumped" case with value, unit, source, at, inputs of every entry and the
/// passes, dynamics and Campbell diagram of the case it came from.  Returns the text; passes' paths are made
/// relative to `directory`.
std::string lumped_model_toml(const LumpedModel &model, const Case &origin, const std::string &directory);

/// "[[pass]]" and its lines.
/// @param directory  that its paths are made relative to
std::string pass_toml(const Pass &pass, const std::string &directory);
}  // namespace mill
