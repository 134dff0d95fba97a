#pragma once
#include "app/command/command_line.h"
#include "core/model/dynamics_settings.h"
#include <optional>

namespace mill {
struct Case;

/// The model of the stand that export, live, analyse and calibrate take:
/// --model, else dynamics.model where the case gives it, else the leading model of `run`.
/// Absent: the case has no drawing, and one model.
/// @throws InputError  --model with a case without a drawing
std::optional<StandModelKind> leading_model(const Case &the_case, const CommandLine &command);

/// The case with that model.
Case with_leading_model(Case the_case, const CommandLine &command);
}  // namespace mill
