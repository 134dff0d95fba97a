#pragma once
#include "report/page/page.h"
#include <nlohmann/json_fwd.hpp>

namespace mill::report {
/// Optimum of a study: inputs with their bounds, results there, the valley along each input, progress of the
/// search.
void optimum_section(Page &page, const nlohmann::json &document);
}  // namespace mill::report
