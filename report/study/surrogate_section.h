#pragma once
#include "report/page/page.h"
#include <nlohmann/json_fwd.hpp>

namespace mill::report {
/// Polynomial chaos of a study: errors, prediction of the rows that were held out, maps over the two strongest
/// inputs.  Nothing where the method is another one.
void surrogate_section(Page &page, const nlohmann::json &document);
}  // namespace mill::report
