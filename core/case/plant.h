#pragma once
#include "core/case/kinds.h"
#include "core/case/stand_rows.h"
#include "core/model/plant.h"
#include <string>
#include <vector>

// [plant] of a case: no run of a stand uses it, so that it is not part of a Case.
namespace mill {
const std::vector<Field<Plant>> &plant_rows();
SectionRows plant_section();
TemplateNote plant_note();  ///< the template leaves the section out: both mains are tried without it

/// Reads and checks the section; echoes it where it is there.
Plant read_plant(const Node &root, Reading &reading);

/// The section of a case file that read_case() has accepted.
/// @throws InputError as read_case()
Plant plant_of(const std::string &path, const std::vector<std::string> &sets = {});
}  // namespace mill
