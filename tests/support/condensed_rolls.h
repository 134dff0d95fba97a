#pragma once
#include "fem/stack/roll_kernel.h"
#include <memory>
#include <vector>

/// How coarse the rolls are meshed.
enum class CondensedMesh { as_run, coarse };

/// Every roll of a stack condensed, or a beam where its shaft is not a solid with one neck; each shape once in a
/// program.
std::vector<std::shared_ptr<const mill::fem::RollKernel>> condensed_rolls(const mill::Stack &stack,
                                                                          CondensedMesh mesh);
