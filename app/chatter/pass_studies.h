#pragma once
#include "app/chatter/chatter_study.h"
#include <cstddef>
#include <functional>

namespace mill {
/// Verb chatter of a stand whose passes are studied one after the other: results, files and sentence of each.  One
/// that is refused is a warning, since the others still have an answer.
/// @throws InputError, SolverError  of the first that is refused, where none has an answer
void study_passes(RunContext &run, std::size_t n_passes,
                  const std::function<ChatterStudy(std::size_t pass)> &study);
}  // namespace mill
