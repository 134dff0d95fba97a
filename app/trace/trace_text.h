#pragma once
#include "app/trace/trace.h"
#include <string>

namespace mill {
/// The trace as a table: the key with its place, then a line for every result it reaches, relation by relation.
/// @param notes  also what stands in for finite elements, and how far the last run is
std::string trace_text(const Trace &trace, bool notes = true);
}  // namespace mill
