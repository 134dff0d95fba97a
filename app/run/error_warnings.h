#pragma once
#include "core/base/errors.h"
#include "core/base/warning.h"
#include <string>

// Warnings of errors that do not end a run: a part without an answer, where the others go on.
namespace mill {
/// The first problem with its place.
Warning warning_of(WarningId id, const InputError &error);
/// What failed, its cause and its remedy.
Warning warning_of(WarningId id, const SolverError &error);
/// "pass "1": critical speed not searched: .."
Warning speed_not_searched(const std::string &pass, const SolverError &error);
/// A good result that could not be kept for the next run.
Warning not_kept(const std::string &what, const InputError &error);
}  // namespace mill
