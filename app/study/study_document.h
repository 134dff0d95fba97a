#pragma once
#include "app/study/study_statistics.h"
#include <nlohmann/json_fwd.hpp>

namespace mill {
/// All that a study says, from which its page is made (report.json): keys, results with statistics, indices and
/// linear estimate, optimum, points for drawings, failures.
/// @throws InputError  fewer than three finished rows of a method that draws
nlohmann::ordered_json study_document(const Study &study, const StudyRows &rows);
}  // namespace mill
