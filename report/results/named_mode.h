#pragma once
#include "core/records/named_mode.h"
#include "report/page/run.h"
#include <string>

namespace mill::report {
/// "contact FEM" of "computed: contact FEM"; of what is not computed the whole source.
std::string method_of(const Result &result);

/// Of a result mode.*.
NamedMode named_mode(const Result &mode);
}  // namespace mill::report
