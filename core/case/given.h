#pragma once
#include "core/base/parameter.h"
#include "core/case/stand_rows.h"

namespace mill {
/// Keys of a value of [given] or [published] that keeps where it comes from: value, source, ...
std::vector<std::string> given_table_keys();

/// "published", "computed: contact FEM", "assumed: F/20" -> source and method.  False for anything else.
bool parse_source(const std::string &text, Parameter &parameter);

/// One value of [given] as TOML: a plain quantity when nothing is known but that it was given, else an inline
/// table with value, source, at, error_estimate and inputs.
std::string given_toml(const Row &row, const Parameter &parameter);
}  // namespace mill
