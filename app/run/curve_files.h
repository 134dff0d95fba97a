#pragma once
#include "app/run/run_context.h"
#include "core/records/result_names.h"

namespace mill {
/// Writes a table as a curve of its kind.
/// @param item  contact, bearing or condition, as file names have it
/// @param of    what of, where the ending of the kind is open
/// @throws std::logic_error  columns that the kind does not have
void write_curve(const RunContext &run, const CurveKind &kind, const std::string &item, const Table &table,
                 const std::string &quantity = "");
}  // namespace mill
